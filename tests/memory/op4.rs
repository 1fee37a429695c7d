//! Memory that reading OUTPUT4 files and universal files takes is bounded by the file's size, whatever the file claims.
//!
//! Reference: the bound stated with `read_op4`.
//! Goal: a damaged or malicious file cannot exhaust memory.
//! Sketch: the files of tests/data with bytes changed at random are read under an allocator that counts, and files that
//!   claim more rows, columns and numbers than they have.
//! Conditions: one test at a time, so that nothing else allocates.
//! Parameters: 16 times the file and 1 MiB for buffers; a dense matrix may take 8 MiB more, or 8000 bytes a number.

use std::fs;
use std::path::Path;

use plummer::formats::uff::responses_from_bytes;
use plummer::formats::{Op4Format, op4_from_bytes, write_op4};
use plummer::numerics::linalg::DenseMatrix;

use super::{Random, alone, peak};

fn check(bytes: &[u8], what: &str) -> usize {
    let path = Path::new("a.op4");
    let limit = 16 * bytes.len() + (1 << 20);
    let found = peak(|| drop(op4_from_bytes(bytes, path)));
    assert!(found <= limit, "{what}: {found} B for a file of {} B", bytes.len());
    let dense = peak(|| {
        for matrix in op4_from_bytes(bytes, path).unwrap_or_default() {
            let _ = matrix.dense();
        }
    });
    let limit = limit + (8 << 20).max(8000 * bytes.len() / 8);
    assert!(dense <= limit, "{what}, dense: {dense} B for a file of {} B", bytes.len());
    let functions = peak(|| drop(responses_from_bytes(bytes, path)));
    assert!(functions <= limit, "{what}: {functions} B for a file of {} B", bytes.len());
    found
}

#[test]
fn memory_is_bounded_by_the_size_of_the_file() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.op4");
    // an honest matrix is really read: more than its own size is allocated
    let matrix = DenseMatrix::from_fn(500, 500, |i, j| (1 + i + j) as f64);
    for format in [Op4Format::Binary, Op4Format::Ascii] {
        write_op4(&path, &[("K", &matrix)], format).unwrap();
        let bytes = fs::read(&path).unwrap();
        assert!(check(&bytes, "honest") >= 2_000_000);
    }
    // runs of one number each, which have the most to keep for their bytes
    let mut runs = b"       1 9999999       2       1K       1P,9E8.1\n       1       0 9999999\n".to_vec();
    for row in 1..20_000 {
        runs.extend(format!("{:>8}{row:>8}\n 1.0E+00\n", 2).into_bytes());
    }
    check(&runs, "runs");
    let claims = [
        "       1 9999999       2       2K       1P,3E24.16\n       1       1 9999999\n  1.0\n",
        "99999998 9999999       2       2K       1P,3E24.16\n99999999       1       1\n  1.0\n",
        "       1-9999999       2       2K       1P,3E24.16\n       1       0 9999999\n 9999999       1\n  1.0\n",
    ];
    for claim in claims {
        check(claim.as_bytes(), claim);
    }
    let mut random = Random(7);
    for folder in ["op4", "uff"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(folder);
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let whole = fs::read(&path).unwrap();
            for round in 0..300 {
                let bytes = random.damaged(&whole, [0x7f, b'9'], |random| random.next() % whole.len());
                check(&bytes, &format!("{}, round {round}", path.display()));
            }
        }
    }
}
