//! Stiffness and mass of a case over its free degrees of freedom, each with its name.

use super::bodies::Bodies;
use super::dof_labels::{of_housing, of_ring};
use super::imported::ImportedHousing;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::formats::DofLabel;
use crate::numerics::Watch;
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
