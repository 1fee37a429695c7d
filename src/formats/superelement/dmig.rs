//! A superelement as Nastran bulk data: grid points, scalar points and DMIG matrices.
//!
//! An interface node with components along and about the mesh's axes is a GRID, whose components 1 to 6 have the same
//! numbers there. A coordinate without a place, such as the amplitude of a mode, is an SPOINT, component 0. The matrices are symmetric
//! (form 6), their lower triangles in double precision (type 2): `KAAX` stiffness, `MAAX` mass, and where there are any `BAAX`
//! viscous damping and `K4AAX` the imaginary part of the stiffness. The case control takes them by `K2GG = KAAX`,
//! `M2GG = MAAX`, `B2GG = BAAX` and `K42GG = K4AAX`.
//!
//! **Accuracy.** A field of the large format has 16 columns. The exponent takes two to four of them, the sign of a negative number
//! one: 10 to 13 significant digits are left. Use OUTPUT4 or the NumPy archive for all.
//!
//! Source: MSC Nastran Quick Reference Guide, entries DMIG, GRID, SPOINT, and "Format of Bulk Data Entries".

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::Path;

use super::SuperelementRecord;
use crate::files::{Fault, write_atomic};
use crate::formats::{DofBody, DofDirection, DofLabel, FormatError};
use crate::numerics::linalg::DenseMatrix;

/// Columns of a field.
const WIDTH: usize = 16;

/// Largest identification number of a point.
const LARGEST_ID: u64 = 99_999_999;

/// Cosine between a coordinate's axis and the mesh's, less than one by more than which they differ: round-off of a turned frame.
const ALONG: f64 = 1e-9;

/// Point and component of every coordinate, and the points.
#[derive(Debug, Clone, PartialEq)]
struct Points {
    /// \[n\]: identification number, component 0 to 6.
    rows: Vec<(u64, i64)>,
    grids: BTreeMap<u64, [f64; 3]>,
    scalars: Vec<u64>,
}

/// Writes a superelement, whole or not at all. A node of the mesh keeps its number, if no other node has it; others and the
/// scalar points are numbered beyond. Comments say what every row is.
///
/// # Errors
/// [`FormatError::Data`] for a record that contradicts itself, for coordinates that are not along the mesh's axes, and for
/// numbers beyond 99999999; [`FormatError::File`].
pub fn write_superelement_dmig(path: &Path, record: &SuperelementRecord) -> Result<(), FormatError> {
    record.check()?;
    let labels = record.labels();
    let points = Points::of(&labels).map_err(|fault| fault.of(path))?;
    let mut matrices = vec![("KAAX", "stiffness", &record.stiffness), ("MAAX", "mass", &record.mass)];
    matrices.extend(record.damping.iter().map(|c| ("BAAX", "viscous damping", c)));
    matrices.extend(record.structural.iter().map(|k4| ("K4AAX", "imaginary part of the stiffness", k4)));
    Ok(write_atomic(path, |to| {
        write_head(to, record, &labels, &points)?;
        matrices.iter().try_for_each(|(name, what, matrix)| write_matrix(to, name, what, matrix, &points.rows))?;
        writeln!(to, "$ end of superelement")
    })?)
}

impl Points {
    fn of(labels: &[DofLabel]) -> Result<Self, Fault> {
        let is_grid = |label: &&DofLabel| component(label) > 0;
        let mesh_nodes: BTreeSet<u64> = labels
            .iter()
            .filter(is_grid)
            .filter(|label| label.body == DofBody::Housing)
            .map(|label| label.node)
            .collect();
        let mut next = mesh_nodes.last().map_or(1, |last| last.saturating_add(1));
        let mut points = Self { rows: Vec::with_capacity(labels.len()), grids: BTreeMap::new(), scalars: Vec::new() };
        let mut known: Vec<(DofBody, u64, u64)> = Vec::new();
        let mut fresh = || {
            let id = next;
            next += 1;
            id
        };
        for (row, label) in labels.iter().enumerate() {
            if component(label) == 0 {
                points.scalars.push(0);
                points.rows.push((0, 0));
                continue;
            }
            check_label(row, label)?;
            let found = known.iter().find(|(body, node, _)| (*body, *node) == (label.body, label.node));
            let id = match found {
                Some((.., id)) => *id,
                None if label.body == DofBody::Housing && label.node > 0 => label.node,
                None => fresh(),
            };
            if found.is_none() {
                known.push((label.body, label.node, id));
            }
            points.grids.insert(id, label.position);
            points.rows.push((id, component(label)));
        }
        // scalar points after all grid points
        for scalar in &mut points.scalars {
            *scalar = fresh();
        }
        let mut scalars = points.scalars.iter();
        for row in points.rows.iter_mut().filter(|row| row.1 == 0) {
            if let Some(&id) = scalars.next() {
                row.0 = id;
            }
        }
        let largest = points.rows.iter().map(|row| row.0).max().unwrap_or(0);
        Fault::unless(largest <= LARGEST_ID, format!("numbers of points up to {LARGEST_ID}"), largest)?;
        Ok(points)
    }
}

/// 1 to 6 of a grid point; 0 of a scalar point.
fn component(label: &DofLabel) -> i64 {
    label.direction.component()
}

/// A displacement or rotation of a node with a place, along an axis of the mesh.
fn check_label(row: usize, label: &DofLabel) -> Result<(), Fault> {
    let (DofDirection::Along(axis) | DofDirection::About(axis)) = label.direction else {
        let found = format!("\"{}\" of {}", label.direction.name(), of_body(label));
        return Err(Fault::new("coordinates along x, y, z and about them for Nastran's grid points", found)
            .within(format!("row {row}")));
    };
    let place = label.position.map(|x| x.to_string()).join(", ");
    let expected = format!("the place of {} in m", of_body(label));
    Fault::unless(label.position.iter().all(|x| x.is_finite()), expected, format!("({place})"))?;
    let cosine = label.axis.get(axis).copied().unwrap_or(f64::NAN);
    let axis = label.axis.map(|x| x.to_string()).join(", ");
    let expected =
        format!("\"{}\" of {} along the mesh's axis for Nastran's grid points", label.direction.name(), of_body(label));
    Fault::unless(cosine >= 1.0 - ALONG, expected, format!("the direction ({axis})"))
}

fn of_body(label: &DofLabel) -> String {
    format!("{} {}", label.body.name(), label.node)
}

fn write_head(
    to: &mut impl Write,
    record: &SuperelementRecord,
    labels: &[DofLabel],
    points: &Points,
) -> io::Result<()> {
    let modes = record.order() - record.interface.len();
    writeln!(to, "$ condensed housing of plummer: {} interface coordinates, {modes} modes", record.interface.len())?;
    writeln!(to, "$ units: m, N, kg, s, rad; numbers have 10 to 13 significant digits")?;
    let damping = record.damping.iter().map(|_| ", B2GG = BAAX");
    let structural = record.structural.iter().map(|_| ", K42GG = K4AAX");
    let further: String = damping.chain(structural).collect();
    writeln!(to, "$ case control: K2GG = KAAX, M2GG = MAAX{further}")?;
    writeln!(to, "$ row, point, component: coordinate")?;
    for (row, (label, (id, component))) in labels.iter().zip(&points.rows).enumerate() {
        let what = match (row.checked_sub(record.interface.len()), label.direction) {
            (Some(mode), _) => {
                format!("mode {}, {:.3} Hz", mode + 1, record.modal_hz.get(mode).copied().unwrap_or(f64::NAN))
            }
            (None, DofDirection::Generalised) => of_body(label),
            (None, direction) => format!("{}, {}, {}", of_body(label), direction.name(), direction.unit()),
        };
        writeln!(to, "$ {}, {id}, {component}: {what}", row + 1)?;
    }
    for (id, place) in &points.grids {
        let [x, y, z] = place.map(field);
        writeln!(to, "{:<8}{id:>WIDTH$}{:>WIDTH$}{x}{y}", "GRID*", "")?;
        writeln!(to, "{:<8}{z}{:>WIDTH$}", "*", "")?;
    }
    for id in &points.scalars {
        writeln!(to, "{:<8}{id:>8}", "SPOINT")?;
    }
    Ok(())
}

/// The lower triangle of a symmetric matrix, column by column, without zeros.
fn write_matrix(
    to: &mut impl Write,
    name: &str,
    what: &str,
    matrix: &DenseMatrix,
    rows: &[(u64, i64)],
) -> io::Result<()> {
    writeln!(to, "$ {name}: {what}")?;
    writeln!(to, "{:<8}{name:<8}{:>8}{:>8}{:>8}{:>8}", "DMIG", 0, 6, 2, 0)?;
    for (column, (id, component)) in rows.iter().enumerate() {
        let entries = (column..rows.len()).map(|row| (rows[row], matrix[(row, column)]));
        let mut entries = entries.filter(|entry| entry.1 != 0.0).peekable();
        if entries.peek().is_some() {
            writeln!(to, "{:<8}{name:<WIDTH$}{id:>WIDTH$}{component:>WIDTH$}", "DMIG*")?;
        }
        for ((id, component), value) in entries {
            writeln!(to, "{:<8}{id:>WIDTH$}{component:>WIDTH$}{}", "*", field(value))?;
        }
    }
    Ok(())
}

/// A number of double precision in a field, with as many digits as fit: `-1.2345678901D10`.
fn field(value: f64) -> String {
    let text = |digits: usize| format!("{value:.digits$e}").replace('e', "D");
    let fitting = (1..WIDTH).rev().map(text).find(|text| text.len() <= WIDTH);
    format!("{:>WIDTH$}", fitting.unwrap_or_default())
}

#[cfg(test)]
#[path = "dmig_tests.rs"]
mod tests;
