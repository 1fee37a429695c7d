//! A matrix of a file.
//!
//! What binary and ASCII files share: the checks of a header and of runs.

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
    pub(crate) fn is_complex(&self) -> bool {
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

/// Rows from which sparse columns are always big sparse.
const BIG: i64 = 65536;
/// Largest number of rows or columns.
const MOST: i64 = i32::MAX as i64;

/// A matrix that is being read.
#[derive(Debug)]
pub(super) struct Builder {
    /// What was read so far.
    pub(super) matrix: Op4Matrix,
    /// How sparse columns give length and first row.
    pub(super) big: bool,
    /// The last column that was begun, counted from 1.
    column: i64,
}

/// What a column's record begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Column {
    /// The matrix is complete.
    End,
    /// Numbers from this row on, counted from 1.
    Dense(i64),
    /// Runs of numbers.
    Sparse,
}

impl Builder {
    /// Begins a matrix with the numbers of its header, or says what was expected.
    pub(super) fn new([columns, rows, form, kind]: [i64; 4], name: &str) -> Result<Self, &'static str> {
        if !(1..=MOST).contains(&columns) || rows == 0 || !(-MOST..=MOST).contains(&rows) {
            return Err("numbers of columns and rows up to 2147483647");
        }
        if !(1..=4).contains(&kind) {
            return Err("a matrix of type 1 to 4");
        }
        let name: String = name.chars().filter(|c| !" \0".contains(*c)).collect();
        let big = !(0..BIG).contains(&rows);
        let (rows, columns) = (rows.unsigned_abs() as usize, columns as usize);
        let matrix = Op4Matrix { name, form, kind, rows, columns, runs: Vec::new(), values: Vec::new() };
        Ok(Self { matrix, big, column: 0 })
    }

    /// Nastran's type has odd numbers for single precision.
    pub(super) fn is_single(&self) -> bool {
        self.matrix.kind % 2 == 1
    }

    /// Real numbers that make one entry.
    pub(super) fn parts(&self) -> usize {
        if self.matrix.is_complex() { 2 } else { 1 }
    }

    /// Begins a column, or says what was expected.
    pub(super) fn column(&mut self, column: i64, row: i64) -> Result<Column, &'static str> {
        if column > self.matrix.columns as i64 {
            return Ok(Column::End);
        }
        if column <= self.column {
            return Err("a later column than the last one");
        }
        self.column = column;
        match row {
            0 => Ok(Column::Sparse),
            row if row > 0 => Ok(Column::Dense(row)),
            _ => Err("a first row >= 0"),
        }
    }

    /// Takes numbers from a row on, counted from 1, or says what was expected.
    pub(super) fn run(
        &mut self,
        row: i64,
        count: usize,
        values: impl IntoIterator<Item = f64>,
    ) -> Result<(), &'static str> {
        const ROWS: &str = "at least one number, in rows that the matrix has";
        let entries = count / self.parts();
        let first = usize::try_from(row - 1).map_err(|_| ROWS)?;
        let end = first.checked_add(entries).ok_or(ROWS)?;
        if entries == 0 || !count.is_multiple_of(self.parts()) || end > self.matrix.rows {
            return Err(ROWS);
        }
        if self.matrix.is_complex() {
            return Ok(());
        }
        // both are below 2^31, as the matrix's rows and columns are
        self.matrix.runs.push(Run { row: first as u32, column: (self.column - 1) as u32, count: entries as u32 });
        self.matrix.values.extend(values);
        Ok(())
    }
}
