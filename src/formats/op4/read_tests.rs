//! Files of pyYeti in all its ways of writing, files built by hand, damage.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;

use super::super::superelement::samples::dense;
use super::*;
use crate::numerics::linalg::DenseMatrix;

/// Files of tests/data/op4, which its make.py wrote with pyYeti 1.4.7.
fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/op4");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "op4"))
        .collect();
    files.sort();
    assert_eq!(files.len(), 9);
    files
}

/// As make.py has it.
fn stiff() -> DenseMatrix {
    DenseMatrix::from_fn(6, 6, |i, j| {
        if (i + j) % 3 == 1 || i == 2 || j == 2 {
            return 0.0;
        }
        let sign = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
        ((1 + i) * (1 + j)) as f64 / 3.0 * sign
    })
}

fn rect() -> DenseMatrix {
    dense(&[[0.0, 1e-30, 0.0, 4.0], [0.0, -1e30, 0.5, 0.0], [0.0, 3.0, 0.0, -1.0 / 7.0]])
}

#[test]
fn files_of_pyyeti_are_read_bit_by_bit() {
    for path in files() {
        let matrices = read_op4(&path).unwrap();
        let names: Vec<&str> = matrices.iter().map(Op4Matrix::name).collect();
        assert_eq!(names, ["STIFF", "CPLX", "RECT"], "{}", path.display());
        assert_eq!(matrices[0].dense().unwrap(), stiff(), "{}", path.display());
        assert_eq!(matrices[2].dense().unwrap(), rect(), "{}", path.display());
        let forms: Vec<i64> = matrices.iter().map(Op4Matrix::form).collect();
        assert_eq!(forms, [6, 6, 2]);
        assert!(matrices[1].is_complex() && !matrices[0].is_complex());
        assert_eq!(
            matrices[1].dense().unwrap_err().to_string(),
            "matrix \"CPLX\": expected real numbers, found complex ones (type 4)"
        );
        assert_eq!(matrices[2].shape(), (3, 4));
    }
}

/// A binary file of either byte order, of words of 4 or 8 bytes.
struct File {
    big_endian: bool,
    wide: bool,
    bytes: Vec<u8>,
}

impl File {
    fn ordered<const N: usize>(&self, mut own: [u8; N]) -> Vec<u8> {
        if self.big_endian {
            own.reverse();
        }
        own.to_vec()
    }

    fn words(&self, words: &[i64]) -> Vec<u8> {
        let word = |&word: &i64| match self.wide {
            true => self.ordered(word.to_le_bytes()),
            false => self.ordered((word as i32).to_le_bytes()),
        };
        words.iter().flat_map(word).collect()
    }

    /// Numbers of a matrix of type 1 or 2.
    fn reals(&self, kind: i64, values: &[f64]) -> Vec<u8> {
        let real = |&value: &f64| match kind == 1 && !self.wide {
            true => self.ordered((value as f32).to_le_bytes()),
            false => self.ordered(value.to_le_bytes()),
        };
        values.iter().flat_map(real).collect()
    }

    fn record(&mut self, content: &[Vec<u8>]) {
        let content = content.concat();
        let length = self.ordered((content.len() as u32).to_le_bytes());
        self.bytes.extend([length.clone(), content, length].concat());
    }

    /// A matrix of 4 rows and 3 columns, the first of zeros; the last has a gap where it is sparse.
    fn matrix(&mut self, kind: i64, sparse: bool, big: bool) {
        let name = if self.wide { "K   L           " } else { "K L     " };
        let rows = if big { -4 } else { 4 };
        self.record(&[self.words(&[3, rows, 2, kind]), name.into()]);
        let words_of_real = if kind == 1 || self.wide { 1 } else { 2 };
        let key = |row: i64, count: i64| match big {
            true => self.words(&[words_of_real * count + 1, row]),
            false => self.words(&[((words_of_real * count + 1) << 16) + row]),
        };
        let reals = |values: &[f64]| self.reals(kind, values);
        let columns = match sparse {
            false => [(2, 2, 2, vec![reals(&[0.5, -2.0])]), (3, 1, 4, vec![reals(&[1.5, 0.0, 0.0, 3.25])])],
            true => [
                (2, 0, 2, vec![key(2, 2), reals(&[0.5, -2.0])]),
                (3, 0, 2, vec![key(1, 1), reals(&[1.5]), key(4, 1), reals(&[3.25])]),
            ],
        };
        for (column, row, count, content) in columns {
            let bytes: usize = content.iter().map(Vec::len).sum();
            let length = match sparse {
                true => bytes as i64 / if self.wide { 8 } else { 4 },
                false => count * words_of_real,
            };
            let head = self.words(&[column, row, length]);
            self.record(&[vec![head], content].concat());
        }
        let last = [self.words(&[4, 1, words_of_real]), self.reals(kind, &[1.0])];
        self.record(&last);
    }
}

#[test]
fn words_of_32_and_64_bits_in_both_orders_and_precisions() {
    let expected = dense(&[[0.0, 0.0, 1.5], [0.0, 0.5, 0.0], [0.0, -2.0, 0.0], [0.0, 0.0, 3.25]]);
    for (big_endian, wide) in [(false, false), (false, true), (true, false), (true, true)] {
        let mut file = File { big_endian, wide, bytes: Vec::new() };
        for kind in [1, 2] {
            file.matrix(kind, false, false);
            file.matrix(kind, true, false);
            file.matrix(kind, true, true);
        }
        let matrices = op4_from_bytes(&file.bytes, Path::new("a.op4")).unwrap();
        assert_eq!(matrices.len(), 6);
        for matrix in matrices {
            assert_eq!(matrix.name(), "KL");
            assert_eq!(matrix.dense().unwrap(), expected, "{big_endian} {wide}");
        }
    }
}

/// Single precision (a word a number), Fortran's other exponents, the format that a header leaves out, wide headers.
#[test]
fn text_in_other_spellings() {
    let text = "       2       3       2       1K       1P,5E16.9\n\
                \x20      1       0       3\n     196610\n 1.500000000E+00-2.500000000D+00\n\
                \x20      2       1       1\n 3.000000000E+00\n\
                \x20      3       1       1\n 1.000000000E+00\n\
                \x20              1           70000       2       2WIDE    1P,3E24.16|I16\n\
                \x20      1       0       8\n       3   70000\n  1.5000000000000000+100\n       3       1\n\
                \x20 2.5000000000000000E+00\n\
                \x20      2       1       1\n  1.0000000000000000E+00\n\
                \x20      1       6       2       2PLAIN   \n\
                \x20      1       1       6\n\
                \x20 1.0             2.0             3.0             4.0             5.0\n  6.0\n\
                \x20      2       1       1\n 1.000000000E+00\n\n";
    let matrices = op4_from_bytes(text.as_bytes(), Path::new("t.op4")).unwrap();
    let expected = dense(&[[0.0, 3.0], [1.5, 0.0], [-2.5, 0.0]]);
    assert_eq!(matrices[0].dense().unwrap(), expected);
    let wide: Vec<_> = matrices[1].entries().collect();
    assert_eq!(wide, [(69_999, 0, 1.5e100), (0, 0, 2.5)]);
    let plain: Vec<f64> = matrices[2].entries().map(|(_, _, value)| value).collect();
    assert_eq!(plain, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let message = |bytes: &[u8]| {
        let error = op4_from_bytes(bytes, Path::new("a.op4")).unwrap_err();
        error.to_string()
    };
    let mut whole = File { big_endian: false, wide: false, bytes: Vec::new() };
    whole.matrix(2, false, false);
    let changed = |place: usize, byte: u8| {
        let mut bytes = whole.bytes.clone();
        bytes[place] = byte;
        bytes
    };
    assert_eq!(message(&[]), "a.op4, byte 0: expected a matrix, found 0 bytes");
    assert_eq!(
        message(&[7, 0, 0, 0, 1]),
        "a.op4, byte 0: expected a record of 24 or 48 bytes, or text, found bytes [7, 0, 0, 0]"
    );
    assert_eq!(
        message(&changed(28, 25)),
        "a.op4, byte 0: expected columns, rows, form, type and name of a matrix, found a record of 24 bytes that ends as \
         one of 25"
    );
    assert_eq!(
        message(&changed(16, 9)),
        "a.op4, byte 4: expected a matrix of type 1 to 4, found 3 columns, 4 rows, type 9"
    );
    assert_eq!(
        message(&changed(8, 0)),
        "a.op4, byte 4: expected numbers of columns and rows up to 2147483647, found 3 columns, 0 rows, type 2"
    );
    // the first column: from row 4 on, of 5 words, of one word more than it has
    assert_eq!(
        message(&changed(40, 4)),
        "a.op4, byte 36: expected at least one number, in rows that the matrix has, found 2 from row 4"
    );
    assert_eq!(
        message(&changed(44, 3)),
        "a.op4, byte 36: expected whole real numbers that the column has, found 12 bytes from row 2"
    );
    assert_eq!(
        message(&changed(44, 5)),
        "a.op4, byte 36: expected as many words as the record has, found column 2 from row 2 with 5 words"
    );
    // the second column is the first again
    assert_eq!(
        message(&changed(72, 2)),
        "a.op4, byte 72: expected a later column than the last one, found column 2 from row 1 with 8 words"
    );
    assert_eq!(
        message(&whole.bytes[..whole.bytes.len() - 28]),
        "a.op4, byte 120: expected column, first row and length of a column, found the end of the file"
    );
    assert_eq!(
        message(b"       1       2       2       2K       1P,3E24.16\n       1       1       2\n 1.0"),
        "a.op4, line 3: expected the real numbers of a column, found \"1.0\""
    );
    assert_eq!(
        message(b"       1       2       2       2K       1P,3F24.16\n"),
        "a.op4, line 1: expected a format of reals such as 1P,3E24.16, found \"1       2       2       2K       1P,3F24.16\""
    );
    assert_eq!(
        message(b"nothing that\nis known\n"),
        "a.op4, line 1: expected columns, rows, form, type and name of a matrix, found \"nothing that\""
    );
    let error = read_op4(Path::new("no/such.op4")).unwrap_err().to_string();
    assert!(error.starts_with("cannot read no/such.op4: "), "{error}");
}

/// Many zeros are worth no memory; few are.
#[test]
fn a_dense_matrix_is_made_where_it_is_worth_it() {
    let matrix = |rows: usize| {
        let text = format!(
            "    2000{rows:>8}       2       2K       1P,3E24.16\n\
             \x20      1       1       1\n  1.5000000000000000E+00\n\
             \x20   2001       1       1\n  1.0000000000000000E+00\n"
        );
        let matrices = op4_from_bytes(text.as_bytes(), Path::new("k.op4")).unwrap();
        matrices[0].dense()
    };
    let small = matrix(500).unwrap();
    assert_eq!((small.nrows(), small.ncols(), small[(0, 0)]), (500, 2000, 1.5));
    assert_eq!(
        matrix(600).unwrap_err().to_string(),
        "matrix \"K\": expected a matrix that is worth its memory when dense, found 600 x 2000 with 1 numbers"
    );
}

/// Each file cut everywhere, and each byte replaced by others: an error or matrices.
#[test]
fn damaged_files_never_panic() {
    let read = |bytes: &[u8]| {
        for matrix in op4_from_bytes(bytes, Path::new("d.op4")).unwrap_or_default() {
            let _ = matrix.dense();
            assert!(matrix.entries().count() <= bytes.len());
        }
    };
    for path in files() {
        let whole = fs::read(&path).unwrap();
        for end in 0..whole.len() {
            let cut = op4_from_bytes(&whole[..end], &path);
            // text that ends with the line of a matrix's last number is whole
            assert!(cut.is_err() || cut.unwrap().len() <= 3, "{end}");
            read(&whole[..end]);
        }
        for place in 0..whole.len() {
            for byte in [0, 1, 0x7f, 0xff, b' ', b'-', b'9', b'\n'] {
                let mut bytes = whole.clone();
                bytes[place] = byte;
                read(&bytes);
            }
        }
    }
}

proptest! {
    /// Sound records of words that may or may not fit.
    #[test]
    fn random_records_never_panic(
        (columns, rows, kind) in (1..4_i32, -4..5_i32, 1..5_i32),
        records in prop::collection::vec(
            (0..5_i32, -1..5_i32, 0..9_i32, prop::collection::vec(prop_oneof![0..6_i32, 65_536..330_000_i32, any::<i32>()], 0..9)),
            0..5,
        ),
    ) {
        let bytes_of = |words: &[i32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>();
        let mut bytes = bytes_of(&[24, columns, rows, 1, kind, 75, 0, 24]);
        for (column, row, length, words) in records {
            let content = [vec![column, row, length], words].concat();
            let size = 4 * content.len() as i32;
            bytes.extend(bytes_of(&[vec![size], content, vec![size]].concat()));
        }
        for matrix in op4_from_bytes(&bytes, Path::new("r.op4")).unwrap_or_default() {
            let _ = matrix.dense();
        }
        let end = bytes_of(&[20, 99, 1, 2, 0, 0, 20]);
        for matrix in op4_from_bytes(&[bytes, end].concat(), Path::new("r.op4")).unwrap_or_default() {
            let _ = matrix.dense();
        }
    }
}
