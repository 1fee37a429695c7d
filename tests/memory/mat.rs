//! Memory that reading a MATLAB file takes is bounded by the file's size, whatever the file claims.
//!
//! Reference: the bound stated with the reader of MATLAB files.
//! Goal: a damaged or malicious file cannot exhaust memory.
//! Sketch: files that pack long constant arrays, many arrays, fields and names, and the files of tests/data with bytes
//!   changed at random, are read under an allocator that counts.
//! Conditions: one test at a time, so that nothing else allocates.
//! Parameters: 20 times the file, 20 000 times where variables are packed, and 16 MiB.

use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::Compression;
use flate2::read::ZlibEncoder;
use plummer::formats::measured::signals_from_mat;
use plummer::formats::{MeasuredError, SignalRequest};

use super::{Random, alone, peak};

fn words(words: &[usize]) -> Vec<u8> {
    words.iter().flat_map(|&word| (word as u32).to_le_bytes()).collect()
}

/// An element of its type and bytes.
fn element(kind: usize, bytes: &[u8]) -> Vec<u8> {
    let mut all = words(&[kind, bytes.len()]);
    all.extend(bytes);
    all.resize(all.len().next_multiple_of(8), 0);
    all
}

/// An array of a class with what follows its name.
fn array(class: usize, name: &str, sizes: [usize; 2], content: &[u8]) -> Vec<u8> {
    let parts =
        [element(6, &words(&[class, 0])), element(5, &words(&sizes)), element(1, name.as_bytes()), content.to_vec()];
    element(14, &parts.concat())
}

/// Doubles stored in a byte each.
fn bytes_of(name: &str, sizes: [usize; 2]) -> Vec<u8> {
    array(6, name, sizes, &element(2, &vec![1; sizes[0] * sizes[1]]))
}

/// Structs with fields of so many bytes a name.
fn structs(name: &str, count: usize, length: usize, names: &[u8], values: &[u8]) -> Vec<u8> {
    let parts = [element(5, &words(&[length])), element(1, names), values.to_vec()];
    array(2, name, [count, 1], &parts.concat())
}

fn file(variables: &[u8], is_packed: bool) -> Vec<u8> {
    let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
    bytes.resize(124, b' ');
    bytes.extend(b"\x00\x01IM");
    if is_packed {
        let mut stream = Vec::new();
        let mut from = ZlibEncoder::new(variables, Compression::best());
        from.read_to_end(&mut stream).unwrap();
        bytes.extend(words(&[15, stream.len()]));
        bytes.extend(stream);
    } else {
        bytes.extend(variables);
    }
    bytes
}

/// Reads the first hundred signals together, and the first one at a rate of its own.
fn check(bytes: &[u8], factor: usize, what: &str) -> usize {
    let path = Path::new("a.mat");
    let mut request = SignalRequest::default();
    let found = peak(|| {
        if let Err(MeasuredError::Choose { known, .. }) = signals_from_mat(bytes, path, &request) {
            request.channels = known;
            request.channels.truncate(100);
            drop(signals_from_mat(bytes, path, &request));
            request.channels.truncate(1);
            request.rate_hz = Some(1e3);
            drop(signals_from_mat(bytes, path, &request));
        }
    });
    let limit = factor * bytes.len() + (16 << 20);
    assert!(found <= limit, "{what}: {found} B for a file of {} B", bytes.len());
    println!("{what}: {found} B for {} B, limit {limit} B", bytes.len());
    found
}

#[test]
fn memory_is_bounded_by_the_size_of_the_file() {
    let _alone = alone();
    let long = 8_000_000;
    let constant = bytes_of("x", [long, 1]);
    // honest numbers are really read: eight bytes of one
    assert!(check(&file(&constant, false), 20, "constant") >= 8 * long);
    assert!(check(&file(&constant, true), 20_000, "constant, packed") >= 8 * long);
    let two = [bytes_of("x", [long, 1]), bytes_of("t", [long, 1])].concat();
    check(&file(&two, false), 20, "with a time");
    let table = bytes_of("x", [2828, 2828]);
    check(&file(&table, false), 20, "table");
    check(&file(&table, true), 20_000, "table, packed");
    // many of what has the least to keep for its bytes
    let many: Vec<u8> = (0..70_000).flat_map(|_| bytes_of("x", [2, 1])).collect();
    check(&file(&many, false), 20, "many arrays");
    let name = "n".repeat(230);
    let field = bytes_of("", [2, 1]);
    let fields = structs(&name, 30_000, 8, b"aaaaaaaa", &field.repeat(30_000));
    check(&file(&fields, false), 20, "long paths");
    check(&file(&fields, true), 20_000, "long paths, packed");
    let nothing = element(14, &[]);
    let empty = structs("s", 1 << 20, 4096, &[b'n'; 4096], &nothing.repeat(1 << 20));
    check(&file(&empty, false), 20, "empty fields");
    check(&file(&empty, true), 20_000, "empty fields, packed");
    // sizes that are claimed only
    let mut claims = bytes_of("x", [3, 1]);
    claims[4..8].copy_from_slice(&0xffff_fff8_u32.to_le_bytes());
    check(&file(&claims, false), 20, "claims");
    check(&file(&claims, true), 20_000, "claims, packed");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/mat");
    let mut random = Random(1);
    for name in ["plain.mat", "bench.mat", "classes.mat", "big.mat"] {
        let whole = fs::read(folder.join(name)).unwrap();
        for _ in 0..2000 {
            let bytes = random.damaged(&whole, [0, 0xff], |random| random.next() % whole.len());
            let path = Path::new("a.mat");
            let any = SignalRequest::default();
            let found = peak(|| drop(signals_from_mat(&bytes, path, &any)));
            assert!(found <= 20_000 * whole.len() + (16 << 20), "{name}: {found} B");
        }
    }
}
