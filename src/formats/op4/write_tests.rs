//! Files written: byte by byte, and read back.

use std::fs;

use super::super::superelement::samples::{dense, record};
use super::super::{FormatError, read_superelement_op4, write_superelement_op4};
use super::*;
use crate::files::FileError;
use crate::numerics::linalg::DenseMatrix;

#[test]
fn binary_files_are_fortran_records() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.op4");
    let matrix = dense(&[[0.0, 0.0], [0.0, 2.0], [0.0, -0.5], [0.0, 0.0]]);
    write_op4(&path, &[("rect", &matrix)], Op4Format::Binary).unwrap();
    let words = |words: &[i32]| -> Vec<u8> { words.iter().flat_map(|w| w.to_le_bytes()).collect() };
    let reals = |reals: &[f64]| -> Vec<u8> { reals.iter().flat_map(|r| r.to_le_bytes()).collect() };
    let expected = [
        words(&[24, 2, 4, 2, 2]),
        b"RECT    ".to_vec(),
        words(&[24]),
        // the second column from row 2 on, four words
        words(&[28, 2, 2, 4]),
        reals(&[2.0, -0.5]),
        words(&[28, 20, 3, 1, 2]),
        reals(&[1.0]),
        words(&[20]),
    ];
    assert_eq!(fs::read(&path).unwrap(), expected.concat());
}

#[test]
fn text_has_three_numbers_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.op4");
    let matrix = dense(&[[0.1], [0.0], [-2.0 / 3.0], [1e100], [0.0]]);
    write_op4(&path, &[("V", &matrix)], Op4Format::Ascii).unwrap();
    let expected = "       1       5       2       2V       1P,3E24.16\n\
                    \x20      1       1       4\n\
                    \x20 1.0000000000000001E-01  0.0000000000000000E+00 -6.6666666666666663E-01\n\
                    \x201.0000000000000000E+100\n\
                    \x20      2       1       1\n\
                    \x20 1.0000000000000000E+00\n";
    assert_eq!(fs::read_to_string(&path).unwrap(), expected);
}

#[test]
fn a_superelement_comes_back_bit_by_bit_under_nastran_s_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.op4");
    let whole = record();
    for format in [Op4Format::Binary, Op4Format::Ascii] {
        write_superelement_op4(&path, &whole, format).unwrap();
        let matrices = read_op4(&path).unwrap();
        let names: Vec<&str> = matrices.iter().map(Op4Matrix::name).collect();
        assert_eq!(names, ["KAA", "MAA", "BAA", "K4AA", "BSET", "BANDHZ", "COMPLHZ"]);
        assert!(matrices.iter().filter(|matrix| matrix.name() != "BSET").all(|matrix| matrix.form() == 6));
        let found: Vec<DenseMatrix> = matrices[..4].iter().map(|m| m.dense().unwrap()).collect();
        let read = read_superelement_op4(&path, &[whole.interface.len()]).unwrap();
        assert_eq!(read.band_hz, whole.band_hz);
        assert_eq!(read.complete_hz, whole.complete_hz);
        let damping = whole.damping.clone().unwrap();
        let structural = whole.structural.clone().unwrap();
        let expected = [whole.stiffness.clone(), whole.mass.clone(), damping, structural];
        assert_eq!(found, expected);
    }
    let bare = super::super::SuperelementRecord {
        damping: None,
        structural: None,
        band_hz: None,
        complete_hz: None,
        ..whole.clone()
    };
    write_superelement_op4(&path, &bare, Op4Format::Binary).unwrap();
    assert_eq!(read_op4(&path).unwrap().len(), 3);
    let mut wrong = whole;
    wrong.modal_hz.clear();
    let error = write_superelement_op4(&path, &wrong, Op4Format::Binary).unwrap_err();
    assert_eq!(error.to_string(), "array \"modal_hz\": expected 2 entries, found 0");
}

#[test]
fn a_square_matrix_that_is_not_symmetric_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.op4");
    let matrix = dense(&[[1.0, 2.0], [2.0 + 1e-15, 1.0]]);
    write_op4(&path, &[("A", &matrix)], Op4Format::Binary).unwrap();
    assert_eq!(read_op4(&path).unwrap()[0].form(), 1);
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.op4");
    let one = dense(&[[1.0]]);
    let message = |name: &str, matrix: &DenseMatrix| {
        let error = write_op4(&path, &[(name, matrix)], Op4Format::Ascii).unwrap_err();
        assert!(!path.exists());
        error.to_string()
    };
    for name in ["", "NINECHARS", "4K", "K-1", "ä"] {
        assert_eq!(
            message(name, &one),
            format!("expected a matrix name of 1 to 8 letters and digits, a letter first, found \"{name}\"")
        );
    }
    assert_eq!(
        message("K", &DenseMatrix::zeros(0, 3)),
        "matrix \"K\": expected up to 9999999 rows and columns, found 0 x 3"
    );
    assert_eq!(
        message("K", &dense(&[[1.0, 0.0], [f64::INFINITY, 1.0]])),
        "matrix \"K\": expected finite numbers, found inf at [1, 0]"
    );
    let nowhere = folder.path().join("no/a.op4");
    let error = write_op4(&nowhere, &[("K", &one)], Op4Format::Binary).unwrap_err();
    assert!(matches!(error, FormatError::File(FileError::Write { path, .. }) if path == nowhere));
}
