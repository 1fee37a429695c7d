//! Structural damping of a housing: the stiffness of its parts weighted by their loss factors.

use super::batch::in_batches;
use super::node_graph;
use super::pattern::{BlockMatrix, Coupling};
use crate::fe::element::continuum::stiffness_into;
use crate::fe::model::{HousingModel, ModelError, RingTie};
use crate::numerics::linalg::{SparseMatrix, congruence};

/// `K_s = sum_e eta_e K_e` over the elements e: with it the stiffness under harmonic motion is `K + i K_s`. Springs lose
/// nothing. It has the pattern of the stiffness, and is assembled where a response asks for it, apart from
/// [`super::SystemMatrices`]: nothing else needs it.
#[derive(Debug, Clone)]
pub struct StructuralStiffness {
    matrix: SparseMatrix,
}

impl StructuralStiffness {
    /// Assembles a housing's; `None` if every loss factor is zero, which costs nothing.
    ///
    /// # Errors
    /// [`ModelError::Refused`] with the tag of an element that is inverted or degenerate.
    pub fn assemble(model: &HousingModel) -> Result<Option<Self>, ModelError> {
        if model.loss_factors.iter().all(|&factor| factor == 0.0) {
            return Ok(None);
        }
        let graph = node_graph(model);
        let mut sum = BlockMatrix::zeros(&graph, model.dimension, Coupling::Full);
        in_batches(
            model,
            |kind| kind.dof() * kind.dof(),
            |element, coordinates, out| {
                let factor = model.loss_factors[element.part];
                if factor == 0.0 {
                    out.fill(0.0);
                    return Ok(());
                }
                let properties = &model.properties[element.part];
                let formulation = model.formulation;
                stiffness_into(element.kind, coordinates, properties, formulation, out)?;
                for entry in out {
                    *entry *= factor;
                }
                Ok(())
            },
            |locals| sum.add(locals),
        )?;
        let matrix = sum.into_matrix();
        let matrix = match model.tie_matrix() {
            Some(tie) => congruence(&matrix, &tie),
            None => matrix,
        };
        Ok(Some(Self { matrix }))
    }

    /// The same in the displacements that a tie's partition uses.
    pub fn for_tie(self, tie: &RingTie) -> Self {
        match tie.rotation() {
            None => self,
            Some(rotation) => Self { matrix: congruence(&self.matrix, rotation) },
        }
    }

    /// K_s [dof x dof], N/m; the degrees of freedom are those of the stiffness.
    pub fn matrix(&self) -> &SparseMatrix {
        &self.matrix
    }
}
