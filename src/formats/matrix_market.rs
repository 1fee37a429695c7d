//! Symmetric matrices as Matrix Market files (`.mtx`).
//!
//! Format of sparse ones: coordinate, real, symmetric; the lower triangle column by column, rows and columns counted from 1,
//! values with 17 digits, which give back every bit. Of dense ones: array, real, symmetric; the same without rows and
//! columns. Source: R. F. Boisvert, R. Pozo, K. Remington, "The Matrix Market exchange
//! formats: initial design", NISTIR 5935, 1996.

use std::io::{self, Write};
use std::path::Path;

use super::FormatError;
use crate::files::{Fault, write_atomic};
use crate::numerics::linalg::{DenseMatrix, SparseMatrix};

/// Writes the lower triangle of a symmetric matrix, whole or not at all. `comment` goes below the banner, line by line
/// (what the matrix is, its units). That the upper triangle is the lower one transposed is not checked.
///
/// # Errors
/// [`FormatError::Data`] unless the matrix is square, [`FormatError::File`].
pub fn write_matrix_market(path: &Path, matrix: &SparseMatrix, comment: &str) -> Result<(), FormatError> {
    check_square(path, matrix.shape())?;
    Ok(write_atomic(path, |to| write_lower(to, matrix, comment))?)
}

/// As [`write_matrix_market`], of a dense matrix.
///
/// # Errors
/// As [`write_matrix_market`].
pub fn write_dense_matrix_market(path: &Path, matrix: &DenseMatrix, comment: &str) -> Result<(), FormatError> {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    check_square(path, (rows, columns))?;
    Ok(write_atomic(path, |to| {
        write_head(to, "array", comment)?;
        writeln!(to, "{rows} {columns}")?;
        let mut columns = matrix.col_iter().enumerate();
        columns.try_for_each(|(column, values)| {
            values.iter().skip(column).try_for_each(|value| writeln!(to, "{value:.16e}"))
        })
    })?)
}

fn check_square(path: &Path, (rows, columns): (usize, usize)) -> Result<(), Fault> {
    let expected = format!("a square matrix for {}", path.display());
    Fault::unless(rows == columns, expected, format_args!("{rows} x {columns}"))
}

fn write_head(to: &mut impl Write, format: &str, comment: &str) -> io::Result<()> {
    writeln!(to, "%%MatrixMarket matrix {format} real symmetric")?;
    comment.lines().try_for_each(|line| writeln!(to, "% {line}"))
}

/// Entries on and below the diagonal, column by column. A matrix in compressed rows is read as its transpose, which is
/// the same matrix.
fn lower(matrix: &SparseMatrix) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
    let columns = matrix.outer_iterator().enumerate();
    columns.flat_map(|(column, entries)| {
        let (rows, values) = entries.into_raw_storage();
        let own = rows.iter().zip(values);
        own.filter(move |&(&row, _)| row >= column).map(move |(&row, &value)| (row, column, value))
    })
}

fn write_lower(to: &mut impl Write, matrix: &SparseMatrix, comment: &str) -> io::Result<()> {
    write_head(to, "coordinate", comment)?;
    writeln!(to, "{} {} {}", matrix.rows(), matrix.cols(), lower(matrix).count())?;
    lower(matrix).try_for_each(|(row, column, value)| writeln!(to, "{} {} {value:.16e}", row + 1, column + 1))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use sprs::TriMat;
    use sprs::io::read_matrix_market;

    use super::*;
    use crate::files::FileError;

    fn sample() -> SparseMatrix {
        // symmetric, with a stored zero, an empty column and values of every size
        let values = vec![4.0 / 3.0, -1e-300, 1e300, -1e-300, -0.0, 1e300, 0.1];
        SparseMatrix::new_csc((4, 4), vec![0, 3, 5, 7, 7], vec![0, 1, 2, 0, 1, 0, 2], values)
    }

    /// Back through the reader of `sprs`.
    #[test]
    fn matrices_come_back_bit_by_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("k.mtx");
        let rows = sample().to_csr();
        for matrix in [sample(), rows] {
            write_matrix_market(&path, &matrix, "stiffness\nN/m").unwrap();
            let found: TriMat<f64> = read_matrix_market(&path).unwrap();
            let found: SparseMatrix = found.to_csc();
            let expected = sample();
            assert_eq!(found.indptr().raw_storage(), expected.indptr().raw_storage());
            assert_eq!(found.indices(), expected.indices());
            let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|v| v.to_bits()).collect() };
            // a sum with 0 that the conversion may make has no sign
            let found = bits(&found.data().iter().map(|v| v + 0.0).collect::<Vec<_>>());
            let expected = bits(&expected.data().iter().map(|v| v + 0.0).collect::<Vec<_>>());
            assert_eq!(found, expected);
        }
        let text = fs::read_to_string(&path).unwrap();
        let head = "%%MatrixMarket matrix coordinate real symmetric\n% stiffness\n% N/m\n4 4 5\n\
                    1 1 1.3333333333333333e0\n2 1 -1.0000000000000000e-300\n";
        assert!(text.starts_with(head), "{text}");
    }

    #[test]
    fn a_dense_matrix_is_its_lower_triangle_column_by_column() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("k.mtx");
        let matrix = DenseMatrix::from_fn(3, 3, |i, j| (10 * i.max(j) + i.min(j)) as f64 / 3.0);
        write_dense_matrix_market(&path, &matrix, "stiffness\nN/m").unwrap();
        let expected = "%%MatrixMarket matrix array real symmetric\n% stiffness\n% N/m\n3 3\n\
                        0.0000000000000000e0\n3.3333333333333335e0\n6.6666666666666670e0\n\
                        3.6666666666666665e0\n7.0000000000000000e0\n7.3333333333333330e0\n";
        assert_eq!(fs::read_to_string(&path).unwrap(), expected);
        let error = write_dense_matrix_market(&path, &DenseMatrix::zeros(2, 3), "").unwrap_err();
        assert!(error.to_string().ends_with("k.mtx, found 2 x 3"));
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("k.mtx");
        let wide = SparseMatrix::zero((2, 3));
        let error = write_matrix_market(&path, &wide, "").unwrap_err().to_string();
        let expected = format!("expected a square matrix for {}, found 2 x 3", path.display());
        assert_eq!(error, expected);
        let nowhere = folder.path().join("no/k.mtx");
        let error = write_matrix_market(&nowhere, &sample(), "").unwrap_err();
        assert!(matches!(error, FormatError::File(FileError::Write { path, .. }) if path == nowhere));
    }
}
