//! Memory that reading an archive takes is bounded by the file's size, whatever the file claims.
//!
//! Reference: the bound stated with `NpzReader`.
//! Goal: a damaged or malicious archive cannot exhaust memory.
//! Sketch: archives whose headers claim more values than there are, and archives with bytes changed at random, are read
//!   under an allocator that counts.
//! Conditions: one test at a time, so that nothing else allocates.
//! Parameters: 8 times the file where stored, 4200 times where deflated, and 1 MiB for buffers; twice that for numbers of
//!   4 bytes, 20 and 20000 times for text.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use plummer::formats::{NpzReader, read_modes_npz, read_superelement_npz};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::{Random, alone, peak};

fn archive(shape: &str, count: usize, method: CompressionMethod) -> Vec<u8> {
    archive_of(&["frequencies_hz", "shapes"], "<f8", shape, 8 * count, method)
}

/// Arrays of one type and shape with so many bytes.
fn archive_of(names: &[&str], descr: &str, shape: &str, bytes: usize, method: CompressionMethod) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for name in names {
        let options = SimpleFileOptions::DEFAULT.compression_method(method);
        zip.start_file(format!("{name}.npy"), options).unwrap();
        let header = format!("{{'descr': '{descr}', 'fortran_order': True, 'shape': {shape}, }}");
        zip.write_all(b"\x93NUMPY\x01\x00").unwrap();
        zip.write_all(&(header.len() as u16).to_le_bytes()).unwrap();
        zip.write_all(header.as_bytes()).unwrap();
        zip.write_all(&vec![0; bytes]).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// Reads everything that can be read.
fn peak_of_all(path: &Path) -> usize {
    peak(|| {
        let _ = read_modes_npz(path);
        if let Ok(mut npz) = NpzReader::open(path) {
            for name in npz.names() {
                let _ = npz.f64(&name);
                let _ = npz.i64(&name);
            }
        }
    })
}

/// Numbers of 4 bytes, text, superelements.
fn check_other_readers(folder: &Path, method: CompressionMethod, factor: usize) {
    let path = folder.join("other.npz");
    let read = |bytes: &[u8], factor: usize, read: &dyn Fn(&mut NpzReader)| {
        fs::write(&path, bytes).unwrap();
        let found = peak(|| {
            if let Ok(mut npz) = NpzReader::open(&path) {
                read(&mut npz);
            }
            let _ = read_superelement_npz(&path);
        });
        let limit = factor * bytes.len() + (1 << 20);
        assert!(found <= limit, "{found} B for a file of {} B", bytes.len());
        found
    };
    let one = |descr, shape, bytes| archive_of(&["a"], descr, shape, bytes, method);
    let reals = read(&one("<f4", "(500, 1000)", 2_000_000), 2 * factor, &|npz| {
        npz.real("a").unwrap();
    });
    assert!(reals >= 4_000_000);
    read(&one("<i4", "(500000,)", 2_000_000), 2 * factor, &|npz| {
        npz.whole("a").unwrap();
    });
    let text = if method == CompressionMethod::Stored { 20 } else { 20_000 };
    read(&one("<U1", "(500000,)", 2_000_000), text, &|npz| {
        npz.texts("a").unwrap();
    });
    read(&one("<U16384", "(9999999999,)", 200_000), text, &|npz| {
        npz.texts("a").unwrap_err();
    });
    // square, wide and tall: a few rows or columns of many numbers
    for shape in ["(500, 500)", "(1, 250000)", "(250000, 1)", "(0, 9999999999)"] {
        let names = ["k", "m", "weight", "sensors", "field_recovery"];
        let bytes = archive_of(&names, "<f8", shape, 2_000_000, method);
        read(&bytes, factor, &|_| ());
    }
}

#[test]
fn memory_is_bounded_by_the_size_of_the_file() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npz");
    let mut random = Random(7);
    for (method, factor) in [(CompressionMethod::Stored, 8), (CompressionMethod::Deflated, 4200)] {
        let check = |bytes: &[u8], what: &str| {
            fs::write(&path, bytes).unwrap();
            let (found, limit) = (peak_of_all(&path), factor * bytes.len() + (1 << 20));
            assert!(found <= limit, "{what}: {found} B for a file of {} B", bytes.len());
            found
        };
        check_other_readers(folder.path(), method, factor);
        // honest arrays are really read: more than their own size is allocated
        let honest = archive("(500000,)", 500_000, method);
        assert!(check(&honest, "honest") >= 4_000_000);
        for shape in ["(9999999999,)", "(1, 1000000000000, 1)", "(500000, 1000000000)"] {
            check(&archive(shape, 1000, method), shape);
        }
        let whole = archive("(10, 20, 3)", 600, method);
        for round in 0..400 {
            let bytes = random.damaged(&whole, [0xff, 0], |random| {
                // headers of entries and the directory at the end are where sizes stand
                let range = [128, whole.len()][random.next() % 2];
                whole.len() - 1 - random.next() % range
            });
            check(&bytes, &format!("round {round}"));
        }
    }
}
