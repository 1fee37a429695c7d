//! A superelement as the data of MBDyn's modal element (`.fem`).
//!
//! MBDyn carries the large rigid motion of a modal element by a node of its own and adds the element's shapes to it, so
//! that a free body's shapes must not have rigid motions in them; of a body that is clamped to the ground there are none.
//! What is written are therefore eigenvectors of the condensed housing, `k v = lambda m v`, either with one interface node
//! held, as the manual recommends, or without the rigid ones ([`MbdynReference`]). Together with the rigid motion they are
//! the same space as the interface displacements and fixed-interface modes; mass (1) and stiffness (lambda) are diagonal.
//! All count as normal modes, as the manual advises; which of them are used is chosen in MBDyn's input.
//!
//! Source: MBDyn Input File Format, appendix "Modal Element Data", section "FEM File Format" (records 1 to 13) and its
//! subsection "Usage"; section "Modal" of the joint elements for the node that is held, `origin node` and `clamped`.

mod nodes;
mod rigid;
#[cfg(test)]
mod tests;
mod write;

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{SuperelementError, SuperelementRecord};
use crate::formats::DofBody;
use crate::numerics::linalg::{DenseMatrix, LinalgError, acting_generalised_eigen};
use nodes::{Node, nodes};
use rigid::{Inertia, inertia};

/// Why a superelement cannot be written for MBDyn.
#[derive(Debug, Error)]
pub enum MbdynError {
    /// The file system refused.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A superelement that contradicts itself.
    #[error("{fault}")]
    Superelement {
        /// What is wrong.
        fault: Box<SuperelementError>,
    },
    /// Matrices without eigenvectors.
    #[error("the superelement's eigenvalue problem failed: {source}")]
    Eigen {
        /// What the solver said.
        source: LinalgError,
    },
    /// A mechanism, or a plane.
    #[error(
        "expected a body that is free (6 rigid motions) or held (none), found {found} rigid motions"
    )]
    RigidMotions {
        /// Eigenvalues that are zero.
        found: usize,
    },
    /// A free body of which the rigid motions cannot be told.
    #[error(
        "expected node, direction, position and axis of every interface coordinate of a free body, not known for coordinate \
         {coordinate}"
    )]
    Place {
        /// The interface coordinate, counted from 0.
        coordinate: usize,
    },
    /// A free body whose interface moves otherwise than its labels say.
    #[error(
        "expected no forces in {motion} of a free body, found {found:e} of the stiffness's magnitude: positions or axes of \
         the interface do not belong to the matrices"
    )]
    NotRigid {
        /// The motion.
        motion: &'static str,
        /// Largest force against the largest sum of magnitudes.
        found: f64,
    },
    /// A node that cannot be held.
    #[error("expected six coordinates of the interface at {} node {node}, which is to be held, found {found}", body.name())]
    Reference {
        /// Where the node belongs.
        body: DofBody,
        /// The node.
        node: u64,
        /// Its coordinates.
        found: usize,
    },
    /// Nothing to connect to.
    #[error(
        "expected a node with a known position and three displacements, in the interface or in the field, found none"
    )]
    NoNodes,
    /// Nothing that moves but rigidly.
    #[error("expected at least one mode that is not rigid, found none")]
    NoModes,
}

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
/// [`MbdynError`]: for bodies that are neither free nor held, such as plane ones; free bodies whose interface is not fully
/// labelled; a reference that has not six coordinates; no nodes; no modes; and when the file cannot be written.
pub fn write_mbdyn_fem(
    path: &Path,
    record: &SuperelementRecord,
    reference: MbdynReference,
) -> Result<MbdynSummary, MbdynError> {
    record.check().map_err(|fault| MbdynError::Superelement {
        fault: Box::new(fault),
    })?;
    let all: Vec<usize> = (0..record.order()).collect();
    let (mut modes, rigid) = modes(record, &all)?;
    let inertia = match rigid {
        0 => None,
        6 => Some(inertia(record)?),
        found => return Err(MbdynError::RigidMotions { found }),
    };
    if let (Some(_), MbdynReference::Node { body, node }) = (&inertia, reference) {
        let mut free = all;
        let held = |&row: &usize| {
            let label = record.interface.get(row);
            label.is_some_and(|label| (label.body, label.node) == (body, node))
        };
        free.retain(|row| !held(row));
        let found = record.order() - free.len();
        if found != 6 {
            return Err(MbdynError::Reference { body, node, found });
        }
        let found;
        (modes, found) = self::modes(record, &free)?;
        if found != 0 {
            return Err(MbdynError::RigidMotions { found });
        }
    }
    let (eigenvalues, vectors) = modes;
    if eigenvalues.is_empty() {
        return Err(MbdynError::NoModes);
    }
    let nodes = nodes(record);
    if nodes.is_empty() {
        return Err(MbdynError::NoNodes);
    }
    let body = Body {
        damping: record
            .damping
            .as_ref()
            .map(|damping| vectors.transpose() * damping * &vectors),
        eigenvalues,
        vectors,
        nodes,
        inertia,
    };
    write::write(path, &body).map_err(|source| MbdynError::Write {
        path: path.to_owned(),
        source,
    })?;
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
fn modes(record: &SuperelementRecord, free: &[usize]) -> Result<(Modes, usize), MbdynError> {
    let part = |matrix: &DenseMatrix| {
        DenseMatrix::from_fn(free.len(), free.len(), |i, j| matrix[(free[i], free[j])])
    };
    let (stiffness, mass) = (part(&record.stiffness), part(&record.mass));
    let spectrum = acting_generalised_eigen(&stiffness, &mass)
        .map_err(|source| MbdynError::Eigen { source })?;
    let finite = spectrum.values.iter().copied().filter(|v| v.is_finite());
    let limit = RIGID_LIMIT * finite.clone().fold(0.0, f64::max);
    let rigid = finite.filter(|&value| value <= limit).count();
    let kept: Vec<usize> = (0..spectrum.values.len())
        .filter(|&mode| spectrum.values[mode].is_finite() && spectrum.values[mode] > limit)
        .collect();
    let diagonal = |matrix: &DenseMatrix| -> Vec<f64> {
        let product = matrix * &spectrum.vectors;
        let sum = |&mode: &usize| {
            let rows = (0..free.len()).map(|row| (row, mode));
            rows.map(|place| spectrum.vectors[place] * product[place])
                .sum()
        };
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

/// What goes into a file.
struct Body {
    nodes: Vec<Node>,
    /// Ascending, 1/s^2.
    eigenvalues: Vec<f64>,
    /// \[n x modes\], modal mass 1.
    vectors: DenseMatrix,
    /// \[modes x modes\].
    damping: Option<DenseMatrix>,
    inertia: Option<Inertia>,
}
