//! The interface of a condensed housing on characteristic constraint modes, as a case asks for it.

use super::condensed::CondensedHousing;
use crate::app::case::{Case, InterfaceModes};
use crate::app::error::ComputeError;
use crate::fe::assembly::SystemMatrices;
use crate::fe::reduction::{CharacteristicModes, ErrorEstimate, InterfaceReduction, InterfaceSize, LostFlexibility};

/// A reduced interface and what it costs.
#[derive(Debug, Clone)]
pub struct ReducedInterface {
    /// The superelement on modes of the interface.
    pub reduction: InterfaceReduction,
    /// What the frequencies in the band rise by, relative; 0 of rigid modes.
    pub rises: Vec<f64>,
    /// Share of the interface's static flexibility that is lost.
    pub lost: LostFlexibility,
}

impl ReducedInterface {
    /// The largest rise of a frequency in the band; 0 without modes.
    pub(crate) fn largest_rise(&self) -> f64 {
        self.rises.iter().copied().fold(0.0, f64::max)
    }

    /// The interface on as many modes as the case asks for, with the estimate of both reductions; `None` if it asks for
    /// none. `estimate` is that of the whole interface.
    ///
    /// # Errors
    /// [`ComputeError::Reduction`] for too few modes, and of the dense eigenvalue solver.
    pub(crate) fn of(
        case: &Case,
        stage: &CondensedHousing,
        modes: &CharacteristicModes,
        estimate: &ErrorEstimate,
    ) -> Result<Option<(Self, ErrorEstimate)>, ComputeError> {
        let size = match case.condense.interface_modes {
            InterfaceModes::None => return Ok(None),
            InterfaceModes::Count(count) => InterfaceSize::Count(count),
            InterfaceModes::UpToHz(hz) => InterfaceSize::UpTo(hz),
        };
        let reduction = InterfaceReduction::new(&stage.condensed, modes, size)?;
        let attached = stage.boundary.attached();
        let (estimate, rises) = reduction.estimate(&stage.condensed, attached, estimate)?;
        let lost = modes.lost_flexibility(reduction.kept());
        let reduced = Self { reduction, rises, lost };
        Ok(Some((reduced, estimate)))
    }
}

/// All modes of the interface of a condensed housing with what is attached to it.
///
/// # Errors
/// [`ComputeError::Reduction`] of the dense eigenvalue solver.
pub(crate) fn characteristic_modes(
    stage: &CondensedHousing,
    matrices: &SystemMatrices,
) -> Result<CharacteristicModes, ComputeError> {
    let rigid = stage.rigid_motions().free_interface(&stage.condensed, matrices)?;
    Ok(CharacteristicModes::of(&stage.condensed.substructure, stage.boundary.attached(), &rigid)?)
}
