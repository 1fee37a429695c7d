//! Stiffness and mass of a case over its free degrees of freedom, each with its name.

use std::collections::BTreeSet;

use super::error::StageError;
use super::imported::ImportedHousing;
use super::modal_system::Bodies;
use super::watch::Watch;
use crate::app::case::Case;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::formats::{DofBody, DofDirection, DofLabel};
use crate::numerics::linalg::{SparseMatrix, submatrix};
use crate::system::Structure;

/// `K x = (2 pi f)^2 M x` of a housing, of a ring, or of both coupled in full (nothing condensed); its f are the case's
/// eigenfrequencies.
///
/// Rows that are fixed, or that a tie or a link drives, are left out: their share is with what drives them.
#[derive(Debug, Clone)]
pub struct FreeSystem {
    /// Stiffness with springs [n x n], N/m (N for a displacement against a rotation, N m for two rotations).
    pub stiffness: SparseMatrix,
    /// Mass with point masses [n x n], kg (kg m, kg m^2).
    pub mass: SparseMatrix,
    /// What each row is \[n\].
    pub rows: Vec<DofLabel>,
}

impl FreeSystem {
    /// Assembles the matrices of a case; nothing is factorised.
    ///
    /// # Errors
    /// [`StageError`] of mesh, model, elements, ring and tie.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Self, StageError> {
        if let Some(path) = case.superelement()
            && let Some(asked) = &case.ring
        {
            watch.stage("read");
            let (imported, ring) = ImportedHousing::read(case, asked, path)?;
            imported.accept()?;
            let structure = Structure::with_housing(ring, &imported.element, [0.0; 2])?;
            let (k, m) = (structure.stiffness(), structure.mass());
            let matrices = CoupledMatrices::of_condensed(k, m, structure.ring().dof());
            let modes = (0..imported.element.modal_dof() as u64).map(DofLabel::modal);
            let mut rows = of_ring(structure.ring(), &imported.frame);
            rows.extend(modes);
            return Ok(Self {
                stiffness: matrices.stiffness,
                mass: matrices.mass,
                rows,
            });
        }
        let (bodies, matrices) = Bodies::assemble(case, watch)?;
        let mut labels = Vec::with_capacity(matrices.mass.rows());
        if let Some((_, model)) = &bodies.housing {
            labels.extend(of_housing(model, bodies.tie.as_ref()));
        }
        if let Some(ring) = &bodies.ring {
            labels.extend(of_ring(ring, &bodies.frame()));
        }
        let free = &matrices.free_dofs;
        Ok(Self {
            stiffness: submatrix(&matrices.stiffness, free, free),
            mass: submatrix(&matrices.mass, free, free),
            rows: free.iter().map(|&dof| labels[dof]).collect(),
        })
    }
}

// Names of all degrees of freedom, in the order of the matrices before anything is left out.

pub(crate) fn of_housing(model: &HousingModel, tie: Option<&RingTie>) -> Vec<DofLabel> {
    let d = model.dimension();
    // a sliding tie turns all components of the bore's nodes
    let sliding = tie.filter(|tie| tie.rotation().is_some());
    let bore: BTreeSet<usize> = sliding
        .iter()
        .flat_map(|tie| &tie.partition().driven)
        .map(|dof| dof / d)
        .collect();
    let nodes = model.coordinates().iter().zip(&model.node_tags).enumerate();
    let labels = nodes.flat_map(|(index, (&position, &node))| {
        let polar = bore.contains(&index);
        let axes = match polar {
            true => model.frame().polar_axes(position),
            false => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        (0..d).map(move |component| DofLabel {
            body: DofBody::Housing,
            node,
            direction: match polar {
                true => DofDirection::Polar(component),
                false => DofDirection::Along(component),
            },
            position,
            axis: axes[component],
        })
    });
    labels.collect()
}

/// In the order of a ring's displacements: those in its plane, then those out of it.
pub(crate) fn of_ring(ring: &Ring, frame: &RingFrame) -> Vec<DofLabel> {
    use DofDirection::{About, Along};
    let in_plane = [(Along(0), 0), (Along(1), 1), (About(2), 2)];
    let out_of_plane = [(Along(2), 2), (About(0), 0), (About(1), 1)];
    let blocks = if ring.is_in_space() {
        vec![in_plane, out_of_plane]
    } else {
        vec![in_plane]
    };
    let mut labels = Vec::with_capacity(ring.dof());
    for block in blocks {
        for node in 0..ring.nodes() {
            for (direction, axis) in block {
                let mut unit = [0.0; 3];
                unit[axis] = 1.0;
                labels.push(DofLabel {
                    body: DofBody::Ring,
                    node: node as u64,
                    direction,
                    position: frame.point_to_mesh(ring.node_position(node)),
                    axis: frame.vector_to_mesh(unit),
                });
            }
        }
    }
    labels
}
