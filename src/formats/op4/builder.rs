//! What binary and ASCII files share: the checks of a header and of runs.

use super::matrix::{Op4Matrix, Run};

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
