//! What a superelement has to keep.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::fmt;

use super::{InterfaceRecovery, SuperelementRecord};
use crate::files::Fault;
use crate::formats::{DofDirection, DofLabel};
use crate::numerics::linalg::DenseMatrix;

/// Entries across the diagonal may differ by this part of the matrix's largest entry. Condensing in double precision
/// leaves 1e-12 or less; a matrix that went through single precision has 1e-7.
pub const SYMMETRY_LIMIT: f64 = 1e-6;

/// A frequency may differ from that of the matrices by this part of the largest frequency, for the same reason.
const FREQUENCY_LIMIT: f64 = 1e-6;

/// Arrays of one list of labels.
#[derive(Debug)]
pub(super) struct LabelArrays {
    /// What their names begin with: `_dofs` (node and component), `_bodies`, `_positions` of the nodes, `_axes` (unit vectors).
    prefix: &'static str,
    /// The matrix whose rows they name.
    pub(super) matrix: &'static str,
    /// What their number should be.
    pub(super) expected: &'static str,
}

impl LabelArrays {
    /// Name of one of the arrays.
    pub(super) fn array(&self, what: &str) -> String {
        format!("{}_{what}", self.prefix)
    }
}

/// Of the first coordinates.
pub(super) const INTERFACE: LabelArrays =
    LabelArrays { prefix: "interface", matrix: "k", expected: "at most as many rows as \"k\"" };

/// Of the interface that modes stand for.
pub(super) const RECOVERED: LabelArrays =
    LabelArrays { prefix: "recovered", matrix: "interface_modes", expected: "as many rows as \"interface_modes\"" };

impl SuperelementRecord {
    /// Whether everything fits: shapes, finite numbers, symmetry to [`SYMMETRY_LIMIT`] of each matrix's largest entry,
    /// modal frequencies that are those of the diagonals, labels, names and nodes that differ.
    ///
    /// # Errors
    /// [`Fault`]: the first thing that does not.
    pub fn check(&self) -> Result<(), Fault> {
        self.check_matrices()?;
        let order = self.order();
        count("modal_hz", order - self.interface.len(), self.modal_hz.len())?;
        let modal_hz = DenseMatrix::from_fn(self.modal_hz.len(), 1, |row, _| self.modal_hz[row]);
        finite("modal_hz", [self.modal_hz.len(), 1], &modal_hz)?;
        self.check_frequencies()?;
        if let Some(weight) = &self.weight {
            finite("weight", [order, 3], weight)?;
        }
        if let Some(InterfaceRecovery { labels, modes }) = &self.interface_recovery {
            finite("interface_modes", [labels.len(), self.interface.len()], modes)?;
            check_labels(labels, &RECOVERED)?;
        }
        self.check_sensors()?;
        self.check_field()
    }

    /// Matrices and labels, without which nothing else can be told.
    pub(super) fn check_matrices(&self) -> Result<(), Fault> {
        let (rows, columns) = (self.stiffness.nrows(), self.stiffness.ncols());
        square(rows, columns)?;
        let expected = format!("at most {rows} interface coordinates (rows of \"k\")");
        Fault::unless(self.interface.len() <= rows, expected, self.interface.len())?;
        let matrices = [
            ("k", Some(&self.stiffness)),
            ("m", Some(&self.mass)),
            ("c", self.damping.as_ref()),
            ("structural", self.structural.as_ref()),
        ];
        for (name, matrix) in matrices {
            if let Some(matrix) = matrix {
                finite(name, [rows, rows], matrix)?;
                symmetric(name, matrix)?;
            }
        }
        check_labels(&self.interface, &INTERFACE)
    }

    fn check_frequencies(&self) -> Result<(), Fault> {
        let expected = self.diagonal_hz()?;
        let largest = expected.iter().fold(0.0_f64, |a, &b| a.max(b));
        for (mode, (&expected, &found)) in expected.iter().zip(&self.modal_hz).enumerate() {
            if (expected - found).abs() > FREQUENCY_LIMIT * largest {
                let expected = format!("sqrt(k/m)/2pi = {expected} Hz at [{mode}]");
                let found = format!("{found} (interface coordinates come first, modes after them)");
                return Err(of_array("modal_hz", expected, found));
            }
        }
        Ok(())
    }

    fn check_sensors(&self) -> Result<(), Fault> {
        let mut names = HashSet::new();
        for (number, sensor) in self.sensors.iter().enumerate() {
            let rows = self.sensors.len();
            same_shape("sensors", [rows, self.order()], [rows, sensor.row.len()])?;
            if let Some(place) = sensor.row.iter().position(|value| !value.is_finite()) {
                return Err(not_finite("sensors", [number, place], sensor.row[place]));
            }
            if !names.insert(sensor.name.as_str()) {
                return Err(of_array("sensor_names", "each name once", format_args!("\"{}\" twice", sensor.name)));
            }
        }
        Ok(())
    }

    fn check_field(&self) -> Result<(), Fault> {
        let Some(field) = &self.field else {
            return Ok(());
        };
        let nodes = field.node_tags.len();
        count("field_positions", nodes, field.positions.len())?;
        let rows = nodes.saturating_mul(3);
        finite("field_recovery", [rows, self.order()], &field.recovery)?;
        let positions = field.positions.as_flattened();
        if let Some(place) = positions.iter().position(|value| !value.is_finite()) {
            return Err(not_finite("field_positions", [place / 3, place % 3], positions[place]));
        }
        let mut seen = HashSet::new();
        match field.node_tags.iter().find(|&&tag| !seen.insert(tag)) {
            Some(tag) => Err(of_array("field_node_tags", "each node once", format_args!("{tag} twice"))),
            None => Ok(()),
        }
    }
}

fn check_labels(labels: &[DofLabel], names: &LabelArrays) -> Result<(), Fault> {
    let mut seen = HashMap::new();
    for (row, label) in labels.iter().enumerate() {
        let (DofDirection::Along(axis) | DofDirection::Polar(axis) | DofDirection::About(axis)) = label.direction
        else {
            continue;
        };
        if axis > 2 {
            return Err(of_array(&names.array("dofs"), format!("an axis 0, 1 or 2 in row {row}"), axis));
        }
        if let Some(first) = seen.insert((label.body, label.node, label.direction), row) {
            return Err(of_array(&names.array("dofs"), "each once", format_args!("rows {first} and {row} alike")));
        }
    }
    for (row, label) in labels.iter().enumerate() {
        for (what, found) in [("positions", label.position), ("axes", label.axis)] {
            let known = found.iter().all(|value| value.is_finite());
            if !known && !found.iter().all(|value| value.is_nan()) {
                let expected = format!("three finite numbers or NaN for all in row {row}");
                return Err(of_array(&names.array(what), expected, format_args!("{found:?}")));
            }
        }
    }
    Ok(())
}

fn count(array: &'static str, expected: usize, found: usize) -> Result<(), Fault> {
    if expected == found { Ok(()) } else { Err(of_array(array, format!("{expected} entries"), found)) }
}

fn of_array(array: &str, expected: impl Into<Cow<'static, str>>, found: impl fmt::Display) -> Fault {
    Fault::new(expected, found).within(format!("array \"{array}\""))
}

/// Whether a stiffness is square.
pub(super) fn square(rows: usize, columns: usize) -> Result<(), Fault> {
    match rows == columns && rows > 0 {
        true => Ok(()),
        false => Err(of_array("k", "a square matrix of at least one row", format_args!("{rows} x {columns}"))),
    }
}

/// Whether an array has its shape.
pub(super) fn same_shape(array: &str, expected: [usize; 2], found: [usize; 2]) -> Result<(), Fault> {
    if expected == found {
        return Ok(());
    }
    let [expected, found] = [expected, found].map(|[rows, columns]| format!("{rows} x {columns}"));
    Err(of_array(array, expected, found))
}

fn not_finite(array: &str, [row, column]: [usize; 2], found: f64) -> Fault {
    of_array(array, "finite numbers", format_args!("{found} at [{row}, {column}]"))
}

/// Whether a matrix has its shape and finite numbers.
fn finite(array: &'static str, expected: [usize; 2], matrix: &DenseMatrix) -> Result<(), Fault> {
    same_shape(array, expected, [matrix.nrows(), matrix.ncols()])?;
    for (column, values) in matrix.col_iter().enumerate() {
        for (row, &found) in values.iter().enumerate() {
            if !found.is_finite() {
                return Err(not_finite(array, [row, column], found));
            }
        }
    }
    Ok(())
}

fn symmetric(array: &'static str, matrix: &DenseMatrix) -> Result<(), Fault> {
    let mut largest = 0.0_f64;
    for values in matrix.col_iter() {
        largest = values.iter().fold(largest, |a, b| a.max(b.abs()));
    }
    let limit = SYMMETRY_LIMIT * largest;
    for row in 0..matrix.nrows() {
        for column in 0..row {
            let (found, transposed) = (matrix[(row, column)], matrix[(column, row)]);
            // halves, as the difference of two large numbers may be infinite
            if (0.5 * found - 0.5 * transposed).abs() > 0.5 * limit {
                let found = format!(
                    "{found} at [{row}, {column}] and {transposed} at [{column}, {row}], which differ by more than {limit}"
                );
                return Err(of_array(array, "a symmetric matrix", found));
            }
        }
    }
    Ok(())
}
