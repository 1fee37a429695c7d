//! The eigenvectors that a modal element has, and what is written of them.

use std::path::Path;

use super::super::SuperelementRecord;
use super::nodes::nodes;
use super::write::{Body, inertia, write};
use crate::files::Fault;
use crate::formats::{DofBody, FormatError};
use crate::numerics::linalg::{DenseMatrix, acting_generalised_eigen};

/// What the shapes of a free body are relative to: where MBDyn's modal node sits. Of no account for a body that is held by
/// its supports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MbdynReference {
    /// An interface node of six motions, which is held: the modal node coincides with it (`origin node` in MBDyn's input).
    /// This is what the manual recommends.
    Node {
        /// Where the node belongs.
        body: DofBody,
        /// The node.
        node: u64,
    },
    /// The body's mean motion: free-free modes. The modal node coincides with no node of the body once it is deformed.
    Floating,
}

/// What was written.
#[derive(Debug, Clone, PartialEq)]
pub struct MbdynSummary {
    /// Frequencies of the modes, Hz, ascending.
    pub frequency_hz: Vec<f64>,
    /// Nodes.
    pub nodes: usize,
    /// Mass of a free body, kg; a held body has no record of its inertia, and MBDyn's element has to be `clamped`.
    pub mass: Option<f64>,
}

/// Eigenvalues below this part of the largest one are zero: condensing in double precision leaves 1e-15, a hundredth of a
/// hertz below 10 kHz is 1e-12.
const RIGID_LIMIT: f64 = 1e-12;

/// Writes the data of a modal element, whole or not at all: records 1, 2, 5 to 10, 12 (inertia, of a free body) and 13
/// (viscous damping, where there is any). Positions, displacements and inertia are in the mesh's axes, SI units.
///
/// - Nodes: those of the interface of which position and three displacements at right angles are known, with the rotations
///   that the interface has, then those of the field, whose rotations are zero. Of a node in both, the interface's count.
///   Names: the housing's tags; `ringN` and `interfaceN` for others.
/// - Shapes of a free body are relative to `reference`.
/// - A free body's mass, centre of mass and moments of inertia come from the superelement's mass under the rigid motions of
///   its interface, which is exact.
///
/// Not written: lumped masses (record 11), without which MBDyn neglects how deformation changes the inertia; the imaginary
/// part of the stiffness, which the format does not have.
///
/// # Errors
/// [`FormatError`]: for bodies that are neither free nor held, such as plane ones; free bodies whose interface is not fully
/// labelled; a reference that has not six coordinates; no nodes; no modes; and when the file cannot be written.
pub fn write_mbdyn_fem(
    path: &Path,
    record: &SuperelementRecord,
    reference: MbdynReference,
) -> Result<MbdynSummary, FormatError> {
    record.check()?;
    let all: Vec<usize> = (0..record.order()).collect();
    let (mut modes, rigid) = eigenmodes(record, &all)?;
    let inertia = match rigid {
        0 => None,
        6 => Some(inertia(record)?),
        found => return Err(FormatError::RigidMotions { found }),
    };
    if let (Some(_), MbdynReference::Node { body, node }) = (&inertia, reference) {
        let mut free = all;
        let held = |row: usize| record.interface.get(row).is_some_and(|label| (label.body, label.node) == (body, node));
        free.retain(|&row| !held(row));
        let found = record.order() - free.len();
        let body = body.name();
        let expected = format!("six coordinates of the interface at {body} node {node}, which is to be held");
        Fault::unless(found == 6, expected, found)?;
        let found;
        (modes, found) = eigenmodes(record, &free)?;
        if found != 0 {
            return Err(FormatError::RigidMotions { found });
        }
    }
    let (eigenvalues, vectors) = modes;
    Fault::unless(!eigenvalues.is_empty(), "at least one mode that is not rigid", "none")?;
    let nodes = nodes(record);
    let expected = "a node with a known position and three displacements, in the interface or in the field";
    Fault::unless(!nodes.is_empty(), expected, "none")?;
    let damping = record.damping.as_ref().map(|damping| vectors.transpose() * damping * &vectors);
    let body = Body { nodes, eigenvalues, vectors, damping, inertia };
    write(path, &body)?;
    let hertz = |value: &f64| value.sqrt() / std::f64::consts::TAU;
    Ok(MbdynSummary {
        frequency_hz: body.eigenvalues.iter().map(hertz).collect(),
        nodes: body.nodes.len(),
        mass: body.inertia.map(|inertia| inertia.mass),
    })
}

/// Eigenvalues, 1/s^2, and vectors \[n x modes\].
type Modes = (Vec<f64>, DenseMatrix);

/// Modes that are neither rigid nor without mass, of modal mass 1, and the number of rigid ones. Only the `free` coordinates
/// move.
///
/// Eigenvalues are quotients `v^T k v / v^T m v`, which have the square of the vectors' error: the solver's own are less
/// accurate the higher they are above the lowest.
fn eigenmodes(record: &SuperelementRecord, free: &[usize]) -> Result<(Modes, usize), FormatError> {
    let part = |matrix: &DenseMatrix| DenseMatrix::from_fn(free.len(), free.len(), |i, j| matrix[(free[i], free[j])]);
    let (stiffness, mass) = (part(&record.stiffness), part(&record.mass));
    let spectrum = acting_generalised_eigen(&stiffness, &mass).map_err(FormatError::Eigen)?;
    let finite = spectrum.values.iter().copied().filter(|v| v.is_finite());
    let limit = RIGID_LIMIT * finite.clone().fold(0.0, f64::max);
    let rigid = finite.filter(|&value| value <= limit).count();
    let kept: Vec<usize> = (0..spectrum.values.len())
        .filter(|&mode| spectrum.values[mode].is_finite() && spectrum.values[mode] > limit)
        .collect();
    let diagonal = |matrix: &DenseMatrix| -> Vec<f64> {
        let product = matrix * &spectrum.vectors;
        let sum = |&mode: &usize| (0..free.len()).map(|row| spectrum.vectors[(row, mode)] * product[(row, mode)]).sum();
        kept.iter().map(sum).collect()
    };
    let (stiffness, mass) = (diagonal(&stiffness), diagonal(&mass));
    let quotients = stiffness.iter().zip(&mass).map(|(k, m)| k / m).collect();
    let mut vectors = DenseMatrix::zeros(record.order(), kept.len());
    for (column, &mode) in kept.iter().enumerate() {
        for (place, &row) in free.iter().enumerate() {
            vectors[(row, column)] = spectrum.vectors[(place, mode)] / mass[column].sqrt();
        }
    }
    Ok(((quotients, vectors), rigid))
}
