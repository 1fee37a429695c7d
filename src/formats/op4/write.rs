//! Writes files, dense columns, double precision.

use std::io::{self, Write};
use std::path::Path;

use super::super::FormatError;
use super::super::fortran::exponential;
use crate::files::{Fault, write_atomic};
use crate::numerics::linalg::DenseMatrix;

/// How numbers stand in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Op4Format {
    /// Fortran records, little-endian, words of 32 bits: every bit of the numbers.
    Binary,
    /// Text, 17 digits (`1P,3E24.16`), which give back every bit of numbers from 1e-99 on; smaller ones become 0.
    Ascii,
}

/// Nastran's forms of matrices.
const SQUARE: i32 = 1;
const RECTANGULAR: i32 = 2;
const SYMMETRIC: i32 = 6;
/// Nastran's type of real double precision.
const REAL_DOUBLE: i32 = 2;

/// Writes matrices under their names, whole or not at all, in one file. A square matrix that is its own transpose gets the
/// form 6 (symmetric).
///
/// # Errors
/// [`FormatError::Data`] unless each name has 1 to 8 letters and digits, a letter first, and each matrix has finite entries,
/// at least one and not more than the format holds; [`FormatError::File`].
pub fn write_op4(path: &Path, matrices: &[(&str, &DenseMatrix)], format: Op4Format) -> Result<(), FormatError> {
    for &(name, matrix) in matrices {
        check(name, matrix, format)?;
    }
    Ok(write_atomic(path, |to| {
        matrices.iter().try_for_each(|&(name, matrix)| match format {
            Op4Format::Binary => binary(to, name, matrix),
            Op4Format::Ascii => ascii(to, name, matrix),
        })
    })?)
}

fn check(name: &str, matrix: &DenseMatrix, format: Op4Format) -> Result<(), Fault> {
    let fits = (1..=8).contains(&name.len())
        && name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric());
    let expected = "a matrix name of 1 to 8 letters and digits, a letter first";
    Fault::unless(fits, expected, format_args!("\"{name}\""))?;
    let of_matrix = |fault: Fault| fault.within(format!("matrix \"{name}\""));
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    let most = match format {
        // the length of a record, 12 bytes and 8 a row, has 31 bits
        Op4Format::Binary => (i32::MAX as usize - 12) / 8,
        Op4Format::Ascii => 9_999_999,
    };
    let fits = rows.min(columns) > 0 && rows.max(columns) <= most;
    Fault::unless(fits, format!("up to {most} rows and columns"), format_args!("{rows} x {columns}"))
        .map_err(of_matrix)?;
    for (column, values) in matrix.col_iter().enumerate() {
        if let Some((row, found)) = values.iter().enumerate().find(|(_, v)| !v.is_finite()) {
            return Err(of_matrix(Fault::new("finite numbers", format_args!("{found} at [{row}, {column}]"))));
        }
    }
    Ok(())
}

#[allow(clippy::float_cmp)] // the transpose bit by bit
fn form(matrix: &DenseMatrix) -> i32 {
    let rows = matrix.nrows();
    if rows != matrix.ncols() {
        return RECTANGULAR;
    }
    let mut lower = (0..rows).flat_map(|i| (0..i).map(move |j| (i, j)));
    if lower.all(|(i, j)| matrix[(i, j)] == matrix[(j, i)]) { SYMMETRIC } else { SQUARE }
}

/// Columns that are not zero: number, first row (both from 1), values from the first that is not zero to the last.
fn columns(matrix: &DenseMatrix) -> impl Iterator<Item = (usize, usize, Vec<f64>)> + '_ {
    matrix.col_iter().enumerate().filter_map(|(column, values)| {
        let values: Vec<f64> = values.iter().copied().collect();
        let first = values.iter().position(|&value| value != 0.0)?;
        let last = values.iter().rposition(|&value| value != 0.0)?;
        Some((column + 1, first + 1, values[first..=last].to_vec()))
    })
}

/// A number that the last record has for want of others.
const LAST: f64 = 1.0;

fn binary(to: &mut impl Write, name: &str, matrix: &DenseMatrix) -> io::Result<()> {
    // `check` keeps all of these below 2^31
    let word = |number: usize| (number as i32).to_le_bytes();
    let (rows, width) = (matrix.nrows(), matrix.ncols());
    to.write_all([word(24), word(width), word(rows)].as_flattened())?;
    to.write_all([form(matrix).to_le_bytes(), REAL_DOUBLE.to_le_bytes()].as_flattened())?;
    write!(to, "{:<8}", name.to_ascii_uppercase())?;
    to.write_all(&word(24))?;
    let mut record = |column: usize, row: usize, values: &[f64]| {
        let length = word(12 + 8 * values.len());
        to.write_all([length, word(column), word(row), word(2 * values.len())].as_flattened())?;
        values.iter().try_for_each(|value| to.write_all(&value.to_le_bytes()))?;
        to.write_all(&length)
    };
    columns(matrix).try_for_each(|(column, row, values)| record(column, row, &values))?;
    record(width + 1, 1, &[LAST])
}

fn ascii(to: &mut impl Write, name: &str, matrix: &DenseMatrix) -> io::Result<()> {
    let (rows, width) = (matrix.nrows(), matrix.ncols());
    let (form, name) = (form(matrix), name.to_ascii_uppercase());
    writeln!(to, "{width:>8}{rows:>8}{form:>8}{REAL_DOUBLE:>8}{name:<8}1P,3E24.16")?;
    let mut record = |column: usize, row: usize, values: &[f64]| {
        writeln!(to, "{column:>8}{row:>8}{:>8}", values.len())?;
        values.chunks(3).try_for_each(|line| {
            let line: String = line.iter().map(|&value| exponential(value, 24, 16, 'E')).collect();
            writeln!(to, "{line}")
        })
    };
    columns(matrix).try_for_each(|(column, row, values)| record(column, row, &values))?;
    record(width + 1, 1, &[LAST])
}
