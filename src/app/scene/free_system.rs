//! Housing and ring of a case in full (nothing condensed): the bodies, and stiffness and mass over their free degrees of freedom.

use super::dof_labels::{of_housing, of_ring};
use super::housing::AssembledHousing;
use super::imported::ImportedHousing;
use super::ring::ring_and_tie;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, ModeSet, RingShapes, mode_set};
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::formats::DofLabel;
use crate::numerics::Watch;
use crate::numerics::linalg::{SparseMatrix, submatrix};
use crate::system::Structure;

/// Housing and ring of a case, of which one may be missing.
pub(crate) struct Bodies {
    pub housing: Option<(Mesh, HousingModel)>,
    pub ring: Option<Ring>,
    pub tie: Option<RingTie>,
}

impl Bodies {
    /// The bodies and the matrices of all together; those of the housing alone are gone.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, elements, ring and tie.
    pub(crate) fn assemble(case: &Case, watch: &impl Watch) -> Result<(Self, CoupledMatrices), ComputeError> {
        let Some(asked) = &case.ring else {
            let housing = AssembledHousing::of(case, watch)?;
            let matrices = CoupledMatrices::of_housing(housing.matrices, &housing.model);
            let bodies = Self { housing: Some((housing.mesh, housing.model)), ring: None, tie: None };
            return Ok((bodies, matrices));
        };
        let housing = AssembledHousing::build(case, watch)?;
        let (ring, tie) = ring_and_tie(case, asked, housing.as_ref())?;
        watch.stage("couple");
        let matrices = match (&housing, &tie) {
            (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, &ring),
            _ => CoupledMatrices::of_ring(&ring),
        };
        let bodies = Self { housing: housing.map(|housing| (housing.mesh, housing.model)), ring: Some(ring), tie };
        Ok((bodies, matrices))
    }

    /// Modes at the nodes of the mesh and of the ring.
    pub(crate) fn mode_set(&self, modes: &FullModes) -> ModeSet {
        let all = modes.over_all_rows();
        let housing = self.housing.as_ref();
        let moved = housing.map(|(_, model)| modes.motions.housing(model, &all));
        let of_ring = self.ring.as_ref().map(|ring| RingShapes::new(ring, &self.frame(), &modes.motions.ring(&all)));
        let housing = housing.zip(moved.as_ref()).map(|((mesh, model), moved)| (mesh, model, moved));
        mode_set(&modes.basis.frequencies_hz, housing, of_ring.as_ref())
    }

    /// Where the ring sits: in the mesh's axes, or in its own.
    pub(crate) fn frame(&self) -> RingFrame {
        let housing = self.housing.as_ref();
        housing.map_or_else(RingFrame::default, |(_, model)| *model.frame())
    }
}

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
    /// [`ComputeError`] of mesh, model, elements, ring and tie.
    pub(crate) fn build(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
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
            return Ok(Self { stiffness: matrices.stiffness, mass: matrices.mass, rows });
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
