//! Modes of ring and housing without contact, in full or as a superelement has them.

use super::housing::AssembledHousing;
use super::structure::CoupledStructure;
use crate::app::error::ComputeError;
use crate::fe::assembly::CoupledMatrices;
use crate::fe::modal::{FullModes, ModalSurvey, ModeRange, RingShapes};
use crate::numerics::{Unwatched, Watch};

impl CoupledStructure {
    /// Modes of a ring, in a housing if the case has one.
    ///
    /// # Errors
    /// [`ComputeError`] of eigenvalue computation and analysis.
    pub(crate) fn survey(&self, extent: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        let ring = self.structure.ring();
        let range = extent;
        Ok(match (&self.housing, &self.tie) {
            (Some(AssembledHousing { mesh, model, matrices }), Some(tie)) => {
                ModalSurvey::of_coupled((mesh, model, matrices), tie, ring, range, watch)?
            }
            _ if self.imported.is_some() => self.survey_of_imported(range, watch)?,
            _ => ModalSurvey::of_ring(ring, range, watch)?,
        })
    }

    /// Of a superelement from a file there are frequencies, their proof and the ring's motion.
    fn survey_of_imported(&self, range: ModeRange, watch: &impl Watch) -> Result<ModalSurvey, ComputeError> {
        let ring = self.structure.ring();
        let modes = FullModes::of(self.full_matrices(), range, watch)?;
        let of_ring = modes.motions().ring(&modes.over_all_rows());
        Ok(ModalSurvey {
            dof: self.structure.dof(),
            free_dof: modes.free_dof(),
            basis: modes.basis,
            mass: None,
            participation: None,
            shares: None,
            mechanisms: None,
            housing: None,
            ring: Some(RingShapes::new(ring, &self.frame(), &of_ring)),
        })
    }

    /// Frequencies in full: nothing condensed, nothing analysed.
    ///
    /// # Errors
    /// [`ComputeError`] of eigenvalue computation.
    pub(crate) fn unloaded_modes(&self, extent: ModeRange) -> Result<UnloadedModes, ComputeError> {
        let basis = FullModes::of(self.full_matrices(), extent, &Unwatched)?.basis;
        Ok(UnloadedModes { frequencies_hz: basis.frequencies_hz, rigid: basis.rigid_modes })
    }

    /// Matrices of a ring, in a housing if the case has one: in full, or as a superelement has them.
    fn full_matrices(&self) -> CoupledMatrices {
        let structure = &self.structure;
        let ring = structure.ring();
        match (&self.housing, &self.tie) {
            (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, ring),
            _ if self.imported.is_some() => {
                CoupledMatrices::of_condensed(structure.stiffness(), structure.mass(), ring.dof())
            }
            _ => CoupledMatrices::of_ring(ring),
        }
    }
}

/// Frequencies of a model in full.
pub(crate) struct UnloadedModes {
    /// Ascending, Hz.
    pub frequencies_hz: Vec<f64>,
    /// How many of the first ones are rigid.
    pub rigid: usize,
}
