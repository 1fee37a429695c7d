//! What a superelement has to keep.

use std::collections::{HashMap, HashSet};

use super::labels::{INTERFACE, LabelArrays, RECOVERED};
use super::{SuperelementError, SuperelementRecord};
use crate::formats::{DofDirection, DofLabel};
use crate::numerics::linalg::DenseMatrix;

/// Entries across the diagonal may differ by this part of the matrix's largest entry. Condensing in double precision
/// leaves 1e-12 or less; a matrix that went through single precision has 1e-7.
pub const SYMMETRY_LIMIT: f64 = 1e-6;

/// A frequency may differ from that of the matrices by this part of the largest frequency, for the same reason.
const FREQUENCY_LIMIT: f64 = 1e-6;

impl SuperelementRecord {
    /// Whether everything fits: shapes, finite numbers, symmetry to [`SYMMETRY_LIMIT`] of each matrix's largest entry,
    /// modal frequencies that are those of the diagonals, labels, names and nodes that differ.
    ///
    /// # Errors
    /// [`SuperelementError`]: the first thing that does not.
    pub fn check(&self) -> Result<(), SuperelementError> {
        self.check_matrices()?;
        let order = self.order();
        count(
            "modal_hz",
            order - self.interface.len(),
            self.modal_hz.len(),
        )?;
        finite("modal_hz", &column(&self.modal_hz))?;
        self.check_frequencies()?;
        if let Some(weight) = &self.weight {
            shape("weight", [order, 3], weight)?;
            finite("weight", weight)?;
        }
        self.check_interface_recovery()?;
        self.check_sensors()?;
        self.check_field()
    }

    /// Matrices and labels, without which nothing else can be told.
    pub(super) fn check_matrices(&self) -> Result<(), SuperelementError> {
        let (rows, columns) = (self.stiffness.nrows(), self.stiffness.ncols());
        if rows != columns || rows == 0 {
            return Err(SuperelementError::Square { rows, columns });
        }
        if self.interface.len() > rows {
            return Err(SuperelementError::Interface {
                order: rows,
                interface: self.interface.len(),
            });
        }
        let matrices = [
            ("k", Some(&self.stiffness)),
            ("m", Some(&self.mass)),
            ("c", self.damping.as_ref()),
            ("structural", self.structural.as_ref()),
        ];
        for (name, matrix) in matrices {
            if let Some(matrix) = matrix {
                shape(name, [rows, rows], matrix)?;
                finite(name, matrix)?;
                symmetric(name, matrix)?;
            }
        }
        check_labels(&self.interface, &INTERFACE)
    }

    fn check_interface_recovery(&self) -> Result<(), SuperelementError> {
        let Some(recovery) = &self.interface_recovery else {
            return Ok(());
        };
        let expected = [recovery.labels.len(), self.interface.len()];
        shape("interface_modes", expected, &recovery.modes)?;
        finite("interface_modes", &recovery.modes)?;
        check_labels(&recovery.labels, &RECOVERED)
    }

    fn check_frequencies(&self) -> Result<(), SuperelementError> {
        let expected = self.diagonal_hz()?;
        let largest = expected.iter().fold(0.0_f64, |a, &b| a.max(b));
        for (mode, (&expected, &found)) in expected.iter().zip(&self.modal_hz).enumerate() {
            if (expected - found).abs() > FREQUENCY_LIMIT * largest {
                return Err(SuperelementError::ModalFrequency {
                    mode,
                    expected,
                    found,
                });
            }
        }
        Ok(())
    }

    fn check_sensors(&self) -> Result<(), SuperelementError> {
        let mut names = HashSet::new();
        for (number, sensor) in self.sensors.iter().enumerate() {
            if sensor.row.len() != self.order() {
                return Err(SuperelementError::Shape {
                    array: "sensors",
                    expected: [self.sensors.len(), self.order()],
                    found: [self.sensors.len(), sensor.row.len()],
                });
            }
            if let Some(place) = sensor.row.iter().position(|value| !value.is_finite()) {
                return Err(SuperelementError::NotFinite {
                    array: "sensors",
                    row: number,
                    column: place,
                    found: sensor.row[place],
                });
            }
            if !names.insert(sensor.name.as_str()) {
                return Err(SuperelementError::SensorName {
                    name: sensor.name.clone(),
                });
            }
        }
        Ok(())
    }

    fn check_field(&self) -> Result<(), SuperelementError> {
        let Some(field) = &self.field else {
            return Ok(());
        };
        let nodes = field.node_tags.len();
        count("field_positions", nodes, field.positions.len())?;
        let rows = nodes.saturating_mul(3);
        shape("field_recovery", [rows, self.order()], &field.recovery)?;
        finite("field_recovery", &field.recovery)?;
        for (row, position) in field.positions.iter().enumerate() {
            if let Some(column) = position.iter().position(|value| !value.is_finite()) {
                return Err(SuperelementError::NotFinite {
                    array: "field_positions",
                    row,
                    column,
                    found: position[column],
                });
            }
        }
        let mut seen = HashSet::new();
        match field.node_tags.iter().find(|&&tag| !seen.insert(tag)) {
            Some(&tag) => Err(SuperelementError::Node { tag }),
            None => Ok(()),
        }
    }
}

fn check_labels(labels: &[DofLabel], names: &LabelArrays) -> Result<(), SuperelementError> {
    let mut seen = HashMap::new();
    for (row, label) in labels.iter().enumerate() {
        let (DofDirection::Along(axis) | DofDirection::Polar(axis) | DofDirection::About(axis)) =
            label.direction
        else {
            continue;
        };
        if axis > 2 {
            let array = names.dofs;
            return Err(SuperelementError::Axis { array, row, axis });
        }
        if let Some(first) = seen.insert((label.body, label.node, label.direction), row) {
            return Err(SuperelementError::Repeated {
                array: names.dofs,
                first,
                second: row,
            });
        }
    }
    for (row, label) in labels.iter().enumerate() {
        for (array, found) in [(names.positions, label.position), (names.axes, label.axis)] {
            let known = found.iter().all(|value| value.is_finite());
            if !known && !found.iter().all(|value| value.is_nan()) {
                return Err(SuperelementError::Place { array, row, found });
            }
        }
    }
    Ok(())
}

fn column(values: &[f64]) -> DenseMatrix {
    DenseMatrix::from_fn(values.len(), 1, |row, _| values[row])
}

fn count(array: &'static str, expected: usize, found: usize) -> Result<(), SuperelementError> {
    if expected == found {
        return Ok(());
    }
    Err(SuperelementError::Count {
        array,
        expected,
        found,
    })
}

fn shape(
    array: &'static str,
    expected: [usize; 2],
    matrix: &DenseMatrix,
) -> Result<(), SuperelementError> {
    let found = [matrix.nrows(), matrix.ncols()];
    if expected == found {
        return Ok(());
    }
    Err(SuperelementError::Shape {
        array,
        expected,
        found,
    })
}

fn finite(array: &'static str, matrix: &DenseMatrix) -> Result<(), SuperelementError> {
    for (column, values) in matrix.col_iter().enumerate() {
        for (row, &found) in values.iter().enumerate() {
            if !found.is_finite() {
                return Err(SuperelementError::NotFinite {
                    array,
                    row,
                    column,
                    found,
                });
            }
        }
    }
    Ok(())
}

fn symmetric(array: &'static str, matrix: &DenseMatrix) -> Result<(), SuperelementError> {
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
                return Err(SuperelementError::Asymmetric {
                    array,
                    row,
                    column,
                    found,
                    transposed,
                    limit,
                });
            }
        }
    }
    Ok(())
}
