//! A superelement as Nastran bulk data: grid points, scalar points and DMIG matrices.
//!
//! An interface node with components along and about three axes is a GRID, whose components 1 to 6 have the same
//! numbers there. Axes that are not the mesh's are a CORD2R, which is the node's displacement system. A coordinate without a place, such as the amplitude of a mode, is an SPOINT, component 0. The matrices are symmetric
//! (form 6), their lower triangles in double precision (type 2): `KAAX` stiffness, `MAAX` mass, and where there are any `BAAX`
//! viscous damping and `K4AAX` the imaginary part of the stiffness. The case control takes them by `K2GG = KAAX`,
//! `M2GG = MAAX`, `B2GG = BAAX` and `K42GG = K4AAX`.
//!
//! **Accuracy.** A field of the large format has 16 columns. The exponent takes two to four of them, the sign of a negative number
//! one: 10 to 13 significant digits are left. Use OUTPUT4 or the NumPy archive for all.
//!
//! Source: MSC Nastran Quick Reference Guide, entries CORD2R, DMIG, GRID, SPOINT, and "Format of Bulk Data Entries".

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

/// Cosine between two axes, less than one by more than which they differ: round-off of a turned frame.
const ALONG: f64 = 1e-9;

/// Point and component of every coordinate, and the points.
#[derive(Debug, Clone, PartialEq, Default)]
struct Points {
    /// \[n\]: identification number, component 0 to 6.
    rows: Vec<(u64, i64)>,
    /// Place, and number of the displacement system, 0 for the mesh's axes.
    grids: BTreeMap<u64, ([f64; 3], usize)>,
    scalars: Vec<u64>,
    /// Axes of the displacement systems 1, 2 and so on.
    systems: Vec<Axes>,
}

/// Unit vectors in the mesh's axes.
type Axes = [[f64; 3]; 3];

/// Writes a superelement, whole or not at all. A node of the mesh keeps its number, if no other node has it; others and the
/// scalar points are numbered beyond. Comments say what every row is.
///
/// # Errors
/// [`FormatError::Data`] for a record that contradicts itself, for nodes whose axes are no right-handed system, and for
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
        let mut points = Self { rows: Vec::with_capacity(labels.len()), ..Self::default() };
        let mut axes: BTreeMap<u64, [Option<[f64; 3]>; 3]> = BTreeMap::new();
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
            let axis = axis_of(row, label)?;
            let found = known.iter().find(|(body, node, _)| (*body, *node) == (label.body, label.node));
            let id = match found {
                Some((.., id)) => *id,
                None if label.body == DofBody::Housing && label.node > 0 => label.node,
                None => fresh(),
            };
            if found.is_none() {
                known.push((label.body, label.node, id));
            }
            points.grids.insert(id, (label.position, 0));
            let known = &mut axes.entry(id).or_default()[axis];
            let other = known.replace(label.axis).filter(|other| dot(*other, label.axis) < 1.0 - ALONG);
            if let Some(other) = other {
                let expected = format!("displacements and rotations of {} about the same axes", of_body(label));
                let [other, own] = [other, label.axis].map(listed);
                return Err(Fault::new(expected, format!("({other}) and ({own})")).within(format!("row {row}")));
            }
            points.rows.push((id, component(label)));
        }
        for (id, known) in axes {
            let own = whole(known).map_err(|found| {
                Fault::new(
                    "right-handed axes of every node for Nastran's grid points",
                    format!("({found}) at point {id}"),
                )
            })?;
            let turned = (0..3).any(|k| own[k][k] < 1.0 - ALONG);
            if let (true, Some(grid)) = (turned, points.grids.get_mut(&id)) {
                let same = |axes: &Axes| (0..3).all(|k| dot(axes[k], own[k]) >= 1.0 - ALONG);
                let system = points.systems.iter().position(same).unwrap_or_else(|| {
                    points.systems.push(own);
                    points.systems.len() - 1
                });
                grid.1 = system + 1;
            }
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

/// Which axis of a node with a place a displacement is along, or a rotation about.
fn axis_of(row: usize, label: &DofLabel) -> Result<usize, Fault> {
    let (DofDirection::Along(axis @ 0..3) | DofDirection::About(axis @ 0..3)) = label.direction else {
        let found = format!("\"{}\" of {}", label.direction.name(), of_body(label));
        return Err(Fault::new(
            "coordinates along x, y, z and about them for Nastran's grid points (use --to op4 or npz for others)",
            found,
        )
        .within(format!("row {row}")));
    };
    let expected = format!("the place of {} in m", of_body(label));
    Fault::unless(label.position.iter().all(|x| x.is_finite()), expected, format!("({})", listed(label.position)))?;
    let length = dot(label.axis, label.axis);
    let expected = format!("a unit vector for \"{}\" of {}", label.direction.name(), of_body(label));
    Fault::unless((length - 1.0).abs() <= ALONG, expected, format!("({})", listed(label.axis)))?;
    Ok(axis)
}

/// Three right-handed axes from those that are known: one alone is the mesh's, two give the third. Otherwise what was found.
fn whole(known: [Option<[f64; 3]>; 3]) -> Result<Axes, String> {
    let of_mesh = |k: usize| std::array::from_fn(|row| f64::from(u8::from(row == k)));
    let count = known.iter().flatten().count();
    let axes: Axes = std::array::from_fn(|k| match (known[k], known[(k + 1) % 3], known[(k + 2) % 3]) {
        (Some(own), ..) => own,
        (None, Some(a), Some(b)) => cross(a, b),
        _ => of_mesh(k),
    });
    let along = (0..3).all(|k| dot(axes[k], cross(axes[(k + 1) % 3], axes[(k + 2) % 3])) >= 1.0 - ALONG);
    let orthogonal = (0..3).all(|k| dot(axes[k], axes[(k + 1) % 3]).abs() <= ALONG);
    if along && orthogonal && (count > 1 || (0..3).all(|k| axes[k][k] >= 1.0 - ALONG)) {
        return Ok(axes);
    }
    let found: Vec<String> = known.iter().flatten().map(|axis| listed(*axis)).collect();
    Err(found.join("), ("))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

fn listed(vector: [f64; 3]) -> String {
    vector.map(|x| x.to_string()).join(", ")
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
    for (index, [x, _, z]) in points.systems.iter().enumerate() {
        // origin, a point on the third axis, and one in the plane of the third and the first
        let (origin, [zx, zy, zz], [x, y, z]) = (field(0.0), z.map(field), x.map(field));
        writeln!(to, "{:<8}{:>WIDTH$}{:>WIDTH$}{origin}{origin}", "CORD2R*", index + 1, 0)?;
        writeln!(to, "{:<8}{origin}{zx}{zy}{zz}", "*")?;
        writeln!(to, "{:<8}{x}{y}{z}", "*")?;
    }
    for (id, (place, system)) in &points.grids {
        let [x, y, z] = place.map(field);
        writeln!(to, "{:<8}{id:>WIDTH$}{:>WIDTH$}{x}{y}", "GRID*", "")?;
        match system {
            0 => writeln!(to, "{:<8}{z}{:>WIDTH$}", "*", "")?,
            _ => writeln!(to, "{:<8}{z}{system:>WIDTH$}", "*")?,
        }
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
