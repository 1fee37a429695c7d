//! The records of a file.
//!
//! A free body's inertia.

use super::super::SuperelementRecord;
use super::nodes::Node;
use crate::files::{Fault, FileError, write_atomic};
use crate::formats::{DofDirection, FormatError};
use crate::numerics::linalg::DenseMatrix;
use std::io;
use std::io::Write;
use std::path::Path;

/// What goes into a file.
pub(super) struct Body {
    pub(super) nodes: Vec<Node>,
    /// Ascending, 1/s^2.
    pub(super) eigenvalues: Vec<f64>,
    /// \[n x modes\], modal mass 1.
    pub(super) vectors: DenseMatrix,
    /// \[modes x modes\].
    pub(super) damping: Option<DenseMatrix>,
    pub(super) inertia: Option<Inertia>,
}

pub(super) fn write(path: &Path, body: &Body) -> Result<(), FileError> {
    write_atomic(path, |to| {
        let modes = body.eigenvalues.len();
        writeln!(to, "** MBDyn modal data, SI units, axes of the mesh")?;
        head(to, 1, "HEADER")?;
        writeln!(to, "** REVISION, NODES, NORMAL, ATTACHED, CONSTRAINT, REJECTED MODES")?;
        writeln!(to, "REV0 {} {modes} 0 0 0\n**", body.nodes.len())?;
        head(to, 2, "FINITE ELEMENT NODE LIST")?;
        for names in body.nodes.chunks(6) {
            let names: Vec<&str> = names.iter().map(|node| node.name.as_str()).collect();
            writeln!(to, "{}", names.join(" "))?;
        }
        writeln!(to, "**")?;
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            head(to, 5 + axis, &format!("NODAL {name} COORDINATES"))?;
            body.nodes.iter().try_for_each(|node| line(to, &[node.position[axis]]))?;
            writeln!(to, "**")?;
        }
        shapes(to, body)?;
        let diagonal = |value: &dyn Fn(usize) -> f64| {
            DenseMatrix::from_fn(modes, modes, |i, j| if i == j { value(i) } else { 0.0 })
        };
        head(to, 9, "MODAL MASS MATRIX. COLUMN-MAJOR FORM")?;
        matrix(to, &diagonal(&|_| 1.0))?;
        head(to, 10, "MODAL STIFFNESS MATRIX. COLUMN-MAJOR FORM")?;
        matrix(to, &diagonal(&|mode| body.eigenvalues[mode]))?;
        if let Some(inertia) = &body.inertia {
            head(to, 12, "GLOBAL INERTIA PROPERTIES")?;
            line(to, &[inertia.mass])?;
            line(to, &inertia.centre)?;
            inertia.moments.iter().try_for_each(|row| line(to, row))?;
            writeln!(to, "**")?;
        }
        if let Some(damping) = &body.damping {
            head(to, 13, "MODAL DAMPING MATRIX. COLUMN-MAJOR FORM")?;
            matrix(to, damping)?;
        }
        writeln!(to, "** END OF FILE")
    })
}

fn head(to: &mut impl Write, record: usize, name: &str) -> io::Result<()> {
    writeln!(to, "** RECORD GROUP {record}, {name}")
}

/// Displacements and rotations of each node in each mode.
fn shapes(to: &mut impl Write, body: &Body) -> io::Result<()> {
    head(to, 8, "MODE SHAPES")?;
    for mode in 0..body.eigenvalues.len() {
        // MBDyn expects exactly one line before each shape, beginning with **
        writeln!(to, "** NORMAL MODE SHAPE # {}", mode + 1)?;
        for node in &body.nodes {
            let motion = |axis: usize| {
                let parts = node.motions[axis].iter();
                parts.map(|&(row, factor)| factor * body.vectors[(row, mode)]).sum()
            };
            line(to, &[0, 1, 2, 3, 4, 5].map(motion))?;
        }
    }
    writeln!(to, "**")
}

/// A symmetric matrix, six numbers a line as the format wants them.
fn matrix(to: &mut impl Write, matrix: &DenseMatrix) -> io::Result<()> {
    for column in matrix.col_iter() {
        let values: Vec<f64> = column.iter().copied().collect();
        for values in values.chunks(6) {
            line(to, values)?;
        }
    }
    writeln!(to, "**")
}

/// 17 digits, which give back every bit.
fn line(to: &mut impl Write, values: &[f64]) -> io::Result<()> {
    let values: Vec<String> = values.iter().map(|value| format!("{value:.16e}")).collect();
    writeln!(to, "{}", values.join(" "))
}

/// Mass, centre of mass and moments of inertia.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Inertia {
    /// kg.
    pub(super) mass: f64,
    /// m, mesh axes.
    pub(super) centre: [f64; 3],
    /// About the centre of mass, kg m^2.
    pub(super) moments: [[f64; 3]; 3],
}

const MOTIONS: [&str; 2] = ["displacement along", "rotation about"];

/// Forces of a rigid motion, against the largest sum of their parts, are below this where labels belong to the matrices:
/// positions in single precision leave 1e-7.
const FORCE_LIMIT: f64 = 1e-6;

/// Inertia from `R^T m R`, where R are the superelement's coordinates in the six rigid motions. With translations t and
/// rotations w about the mesh's origin a node at p moves by `t + w x p`, so that
/// `R^T m R = [[M I, M S^T], [M S, J]]` with `S v = c x v` and, by the parallel axis theorem,
/// `J = J_c + M (c.c I - c c^T)`.
pub(super) fn inertia(record: &SuperelementRecord) -> Result<Inertia, FormatError> {
    let motions = rigid_motions(record)?;
    check_forces(record, &motions)?;
    let inertia = motions.transpose() * &record.mass * &motions;
    let mass = (inertia[(0, 0)] + inertia[(1, 1)] + inertia[(2, 2)]) / 3.0;
    // (e_k x c)_i: y about z, z about x, x about y
    let centre = [(1, 5), (2, 3), (0, 4)].map(|(i, k)| inertia[(i, k)] / mass);
    let square: f64 = centre.iter().map(|part| part * part).sum();
    let moment = |i: usize, j: usize| {
        let diagonal = if i == j { square } else { 0.0 };
        inertia[(3 + i, 3 + j)] - mass * (diagonal - centre[i] * centre[j])
    };
    Ok(Inertia { mass, centre, moments: [0, 1, 2].map(|i| [0, 1, 2].map(|j| moment(i, j))) })
}

/// Coordinates in the six rigid motions \[n x 6\]: modes with a fixed interface are zero.
fn rigid_motions(record: &SuperelementRecord) -> Result<DenseMatrix, FormatError> {
    let mut motions = DenseMatrix::zeros(record.order(), 6);
    for (coordinate, label) in record.interface.iter().enumerate() {
        let known = label.position.iter().chain(&label.axis).all(|part| part.is_finite());
        let ([x, y, z], [a, b, c]) = (label.position, label.axis);
        let row = match label.direction {
            // axis . (t + w x p) = axis . t + (p x axis) . w
            DofDirection::Along(_) | DofDirection::Polar(_) if known => {
                [a, b, c, y * c - z * b, z * a - x * c, x * b - y * a]
            }
            DofDirection::About(_) if known => [0.0, 0.0, 0.0, a, b, c],
            _ => {
                return Err(FormatError::Refused(format!(
                    "expected node, direction, position and axis of every interface coordinate of a free body, not known for \
                     coordinate {coordinate}"
                )));
            }
        };
        for (motion, value) in row.into_iter().enumerate() {
            motions[(coordinate, motion)] = value;
        }
    }
    Ok(motions)
}

fn check_forces(record: &SuperelementRecord, motions: &DenseMatrix) -> Result<(), Fault> {
    let forces = &record.stiffness * motions;
    // stiffness of a body on one node is round-off: inertia at the lowest fixed-interface frequency measures it
    let modal = record.interface.len()..record.order();
    let lowest = modal.map(|row| record.stiffness[(row, row)]).reduce(f64::min).unwrap_or(0.0);
    for motion in 0..6 {
        let (mut largest, mut sums) = (0.0_f64, 0.0_f64);
        for row in 0..record.order() {
            let sum = |matrix: &DenseMatrix| -> f64 {
                (0..record.order()).map(|column| (matrix[(row, column)] * motions[(column, motion)]).abs()).sum()
            };
            largest = largest.max(forces[(row, motion)].abs());
            sums = sums.max(sum(&record.stiffness)).max(lowest * sum(&record.mass));
        }
        if largest > FORCE_LIMIT * sums {
            let found = format!(
                "{:e} of the stiffness's magnitude: positions or axes of the interface do not belong to the matrices",
                largest / sums
            );
            let (kind, axis) = (MOTIONS[motion / 3], ["x", "y", "z"][motion % 3]);
            return Err(Fault::new(format!("no forces in {kind} {axis} of a free body"), found));
        }
    }
    Ok(())
}
