//! How a superelement can contradict itself.

use thiserror::Error;

/// Why a superelement is none. Arrays are named as in the NumPy archive.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SuperelementError {
    /// A stiffness that is not square.
    #[error("array \"k\": expected a square matrix of at least one row, found {rows} x {columns}")]
    Square {
        /// Rows found.
        rows: usize,
        /// Columns found.
        columns: usize,
    },
    /// A matrix that does not fit the stiffness.
    #[error(
        "array \"{array}\": expected {} x {}, found {} x {}",
        expected[0], expected[1], found[0], found[1]
    )]
    Shape {
        /// Name of the array.
        array: &'static str,
        /// Rows and columns that fit.
        expected: [usize; 2],
        /// Rows and columns found.
        found: [usize; 2],
    },
    /// A list that does not fit the matrices.
    #[error("array \"{array}\": expected {expected} entries, found {found}")]
    Count {
        /// Name of the array.
        array: &'static str,
        /// Entries that fit.
        expected: usize,
        /// Entries found.
        found: usize,
    },
    /// More interface coordinates than coordinates.
    #[error("expected at most {order} interface coordinates (rows of \"k\"), found {interface}")]
    Interface {
        /// Coordinates.
        order: usize,
        /// Interface coordinates found.
        interface: usize,
    },
    /// A number that is none.
    #[error("array \"{array}\": expected finite numbers, found {found} at [{row}, {column}]")]
    NotFinite {
        /// Name of the array.
        array: &'static str,
        /// Row, counted from 0.
        row: usize,
        /// Column, counted from 0.
        column: usize,
        /// The number.
        found: f64,
    },
    /// A matrix that is not symmetric.
    #[error(
        "array \"{array}\": expected a symmetric matrix, found {found} at [{row}, {column}] and {transposed} at \
         [{column}, {row}], which differ by more than {limit}"
    )]
    Asymmetric {
        /// Name of the array.
        array: &'static str,
        /// Row, counted from 0.
        row: usize,
        /// Column, counted from 0.
        column: usize,
        /// The entry.
        found: f64,
        /// The entry across the diagonal.
        transposed: f64,
        /// Difference that is allowed.
        limit: f64,
    },
    /// A mode without mass.
    #[error("array \"m\": expected a mass > 0 of modal coordinate {coordinate}, found {found}")]
    ModalMass {
        /// The coordinate, counted from 0 with those of the interface.
        coordinate: usize,
        /// Its mass.
        found: f64,
    },
    /// A frequency that is not that of the matrices.
    #[error(
        "array \"modal_hz\": expected sqrt(k/m)/2pi = {expected} Hz at [{mode}], found {found} (interface coordinates come \
         first, modes after them)"
    )]
    ModalFrequency {
        /// The mode, counted from 0.
        mode: usize,
        /// What the matrices give, Hz.
        expected: f64,
        /// What was given, Hz.
        found: f64,
    },
    /// An interface coordinate twice.
    #[error("array \"{array}\": expected each once, found rows {first} and {second} alike")]
    Repeated {
        /// Name of the array.
        array: &'static str,
        /// The first row, counted from 0.
        first: usize,
        /// The second row.
        second: usize,
    },
    /// A direction along no axis.
    #[error("array \"{array}\": expected an axis 0, 1 or 2 in row {row}, found {axis}")]
    Axis {
        /// Name of the array.
        array: &'static str,
        /// The row, counted from 0.
        row: usize,
        /// The axis.
        axis: usize,
    },
    /// A place or an axis of which a part is missing.
    #[error(
        "array \"{array}\": expected three finite numbers or NaN for all in row {row}, found {found:?}"
    )]
    Place {
        /// Name of the array.
        array: &'static str,
        /// The row, counted from 0.
        row: usize,
        /// What it has.
        found: [f64; 3],
    },
    /// A sensor's name twice.
    #[error("array \"sensor_names\": expected each name once, found \"{name}\" twice")]
    SensorName {
        /// The name.
        name: String,
    },
    /// A node twice.
    #[error("array \"field_node_tags\": expected each node once, found {tag} twice")]
    Node {
        /// Its tag.
        tag: u64,
    },
}
