//! Memory that reading an archive takes is bounded by the file's size, whatever the file claims.
//!
//! Reference: the bound stated with `NpzReader`.
//! Goal: a damaged or malicious archive cannot exhaust memory.
//! Sketch: archives whose headers claim more values than there are, and archives with bytes changed at random, are read
//!   under an allocator that counts.
//! Conditions: one test in this file, so that nothing else allocates.
//! Parameters: 8 times the file where stored, 4200 times where deflated, and 1 MiB for buffers.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use peak_alloc::PeakAlloc;
use plummer::exchange::{NpzReader, read_modes_npz};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

fn archive(shape: &str, count: usize, method: CompressionMethod) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for name in ["frequencies_hz", "shapes"] {
        let options = SimpleFileOptions::DEFAULT.compression_method(method);
        zip.start_file(format!("{name}.npy"), options).unwrap();
        let header = format!("{{'descr': '<f8', 'fortran_order': True, 'shape': {shape}, }}");
        zip.write_all(b"\x93NUMPY\x01\x00").unwrap();
        zip.write_all(&(header.len() as u16).to_le_bytes()).unwrap();
        zip.write_all(header.as_bytes()).unwrap();
        zip.write_all(&vec![0; 8 * count]).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// Reads everything that can be read and returns the bytes that were allocated meanwhile, at most.
fn peak(path: &Path) -> usize {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let _ = read_modes_npz(path);
    if let Ok(mut npz) = NpzReader::open(path) {
        for name in npz.names() {
            let _ = npz.f64(&name);
            let _ = npz.i64(&name);
        }
    }
    ALLOCATOR.peak_usage().saturating_sub(before)
}

/// Next number of a linear congruential sequence (Knuth's MMIX), so that failures repeat.
fn next(state: &mut u64) -> usize {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize
}

#[test]
fn memory_is_bounded_by_the_size_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    let mut state = 7;
    for (method, factor) in [
        (CompressionMethod::Stored, 8),
        (CompressionMethod::Deflated, 4200),
    ] {
        let check = |bytes: &[u8], what: &str| {
            fs::write(&path, bytes).unwrap();
            let (found, limit) = (peak(&path), factor * bytes.len() + (1 << 20));
            assert!(
                found <= limit,
                "{what}: {found} B for a file of {} B",
                bytes.len()
            );
            found
        };
        // honest arrays are really read: more than their own size is allocated
        let honest = archive("(500000,)", 500_000, method);
        assert!(check(&honest, "honest") >= 4_000_000);
        for shape in [
            "(9999999999,)",
            "(1, 1000000000000, 1)",
            "(500000, 1000000000)",
        ] {
            check(&archive(shape, 1000, method), shape);
        }
        let whole = archive("(10, 20, 3)", 600, method);
        for round in 0..400 {
            let mut bytes = whole.clone();
            for _ in 0..1 + next(&mut state) % 4 {
                // headers of entries and the directory at the end are where sizes stand
                let range = [128, bytes.len()][next(&mut state) % 2];
                let place = bytes.len() - 1 - next(&mut state) % range;
                bytes[place] = [0xff, 0, next(&mut state) as u8][next(&mut state) % 3];
            }
            check(&bytes, &format!("round {round}"));
        }
    }
}
