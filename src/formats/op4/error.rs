//! What can go wrong with an OUTPUT4 file.

use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::super::SuperelementError;

/// Why an OUTPUT4 file cannot be written or read.
#[derive(Debug, Error)]
pub enum Op4Error {
    /// The file system refused.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A name that other programs would not take.
    #[error(
        "expected a matrix name of 1 to 8 letters and digits, a letter first, found \"{name}\""
    )]
    Name {
        /// Name as given.
        name: String,
    },
    /// A matrix whose sizes do not fit their columns.
    #[error("matrix \"{name}\": expected up to {most} rows and columns, found {rows} x {columns}")]
    Size {
        /// Name of the matrix.
        name: String,
        /// What the format holds.
        most: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// A number that is none.
    #[error("matrix \"{name}\": expected finite numbers, found {found} at [{row}, {column}]")]
    NotFinite {
        /// Name of the matrix.
        name: String,
        /// Row, counted from 0.
        row: usize,
        /// Column, counted from 0.
        column: usize,
        /// The number.
        found: f64,
    },
    /// A superelement that contradicts itself.
    #[error("{fault}")]
    Superelement {
        /// What is wrong.
        fault: Box<SuperelementError>,
    },
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Something in the file is not what the format has there.
    #[error("{}, {place}: expected {expected}, found {found}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// Where.
        place: Op4Place,
        /// What the format has there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A matrix that is not there.
    #[error("{}: expected a matrix \"{name}\", found {known}", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// Name of the matrix.
        name: &'static str,
        /// What the file has.
        known: String,
    },
    /// A matrix of complex numbers.
    #[error("matrix \"{name}\": expected real numbers, found complex ones (type {kind})")]
    Complex {
        /// Name of the matrix.
        name: String,
        /// Nastran's type: 3 single, 4 double precision.
        kind: i64,
    },
    /// A matrix of far more zeros than numbers.
    #[error(
        "matrix \"{name}\": expected a matrix that is worth its memory when dense, found {rows} x {columns} with {values} \
         numbers"
    )]
    Sparse {
        /// Name of the matrix.
        name: String,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
        /// Numbers that the file has.
        values: usize,
    },
}

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Op4Place {
    /// Bytes before it.
    Byte(usize),
    /// Line, counted from 1.
    Line(usize),
}

impl fmt::Display for Op4Place {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Byte(byte) => write!(to, "byte {byte}"),
            Self::Line(line) => write!(to, "line {line}"),
        }
    }
}

/// What is wrong where.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) place: Op4Place,
    pub(super) expected: &'static str,
    pub(super) found: String,
}
