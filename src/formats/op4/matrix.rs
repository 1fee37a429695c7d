//! A matrix of a file.

use crate::files::Fault;
use crate::numerics::linalg::DenseMatrix;

/// Dense matrices of up to so many numbers (8 MiB) are made whatever the file has of them.
const SMALL: usize = 1 << 20;
/// Zeros for each number of the file that a larger dense matrix may have: enough for a diagonal of 1000.
const MOST_ZEROS: usize = 1000;

/// A named matrix as it stands in the file: runs of numbers down its columns, zeros elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Op4Matrix {
    pub(super) name: String,
    pub(super) form: i64,
    pub(super) kind: i64,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) runs: Vec<Run>,
    /// Of all runs, one after another.
    pub(super) values: Vec<f64>,
}

/// Numbers below one another, places counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) row: u32,
    pub(super) column: u32,
    pub(super) count: u32,
}

impl Op4Matrix {
    /// Name, as the file has it without blanks.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Nastran's form: 1 square, 2 rectangular, 6 symmetric (both triangles are there), others seldom.
    pub fn form(&self) -> i64 {
        self.form
    }

    /// Whether it is complex; its numbers are then not kept.
    pub fn is_complex(&self) -> bool {
        matches!(self.kind, 3 | 4)
    }

    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// Row, column (both from 0) and value of each number, column by column.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let places = self.runs.iter().flat_map(|run| {
            let rows = run.row..run.row + run.count;
            rows.map(|row| (row as usize, run.column as usize))
        });
        let entries = places.zip(&self.values);
        entries.map(|((row, column), &value)| (row, column, value))
    }

    /// The whole matrix. A number that the file has twice counts once, the last.
    ///
    /// # Errors
    /// [`Fault`] for a complex matrix, and for one of more than 2^20 entries of which the file has less than one in a
    /// thousand, which a few damaged bytes can ask for.
    pub fn dense(&self) -> Result<DenseMatrix, Fault> {
        let (rows, columns, values) = (self.rows, self.columns, self.values.len());
        // a column takes the memory of eight numbers at least
        let size = rows.max(8).checked_mul(columns);
        let most = SMALL.max(values.saturating_mul(MOST_ZEROS));
        let complex = format_args!("complex ones (type {})", self.kind);
        let sparse = format_args!("{rows} x {columns} with {values} numbers");
        Fault::unless(!self.is_complex(), "real numbers", complex)
            .and_then(|()| {
                let worth = size.is_some_and(|size| size <= most);
                Fault::unless(worth, "a matrix that is worth its memory when dense", sparse)
            })
            .map_err(|fault| fault.within(format!("matrix \"{}\"", self.name)))?;
        let mut matrix = DenseMatrix::zeros(self.rows, self.columns);
        for (row, column, value) in self.entries() {
            matrix[(row, column)] = value;
        }
        Ok(matrix)
    }
}
