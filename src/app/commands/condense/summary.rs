//! What `condense.json` says.

use super::{CondenseResult, ReducedInterface};
use crate::app::commands::parts::CheckSummary;
use crate::app::scene::ImportedHousing;
use crate::app::scene::tie_price::{BorePrice, TiePrice};
use crate::fe::reduction::{LostFlexibility, SizeErrors};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use std::f64::consts::TAU;
use std::path::Path;

/// A condensed housing.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct CondenseSummary<'a> {
    /// Number of interface coordinates before their reduction.
    pub interface_dof: usize,
    /// Number of the superelement's coordinates.
    pub coordinates: usize,
    /// Modes in place of the interface, if asked for.
    pub interface_reduction: Option<InterfaceSummary<'a>>,
    /// Degrees of freedom of the interior.
    pub interior_dof: usize,
    /// Number of fixed-interface modes.
    pub fixed_interface_modes: usize,
    /// Number of residual vectors.
    pub residual_vectors: usize,
    /// Frequencies of the interior's vectors, Hz.
    pub interior_frequencies_hz: Vec<f64>,
    /// Frequency below which no fixed-interface mode was left out, Hz; `None`: none was.
    pub complete_below_hz: Option<f64>,
    /// Top of the band, Hz.
    pub band_hz: f64,
    /// Frequencies of the superelement in the band, Hz; `None` for one that it has too few coordinates to have.
    #[schemars(with = "Vec<Option<f64>>")]
    pub frequencies_hz: Vec<f64>,
    /// Estimates of `(reduced - full) / full` of each.
    #[schemars(with = "Vec<Option<f64>>")]
    pub estimated_relative_error: Vec<f64>,
    /// How the estimate went.
    pub estimate: EstimateSummary,
    /// The certificate.
    pub checks: Vec<CheckSummary<'a>>,
    /// Frequencies of the full model in the band, Hz; `None` where it was not computed, as of what follows.
    pub full_frequencies_hz: Option<&'a [f64]>,
    /// `(reduced - full) / full` of each; `None` for rigid modes.
    pub relative_error: Option<&'a [Option<f64>]>,
    /// Smallest and largest of estimated over true error; `None` if no error is above round-off.
    pub effectivity: Option<[f64; 2]>,
    /// Errors of reductions of other sizes.
    pub error_by_size: Option<&'a [SizeErrors]>,
    /// What the ring's rigid sections change.
    pub tie_price: Option<&'a TiePrice>,
    /// What rigid centre nodes change.
    pub bore_price: Option<&'a [BorePrice]>,
    /// What of the model may be meant otherwise, a sentence each.
    pub warnings: &'a [String],
}

/// How an estimate of errors went.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct EstimateSummary {
    /// Largest relative error in the band.
    #[schemars(with = "Option<f64>")]
    pub largest: f64,
    /// Whether the remainder became small.
    pub converged: bool,
    /// Rounds that it took.
    pub rounds: usize,
    /// How many modes the reduced model has above the band.
    pub out_of_band: usize,
}

/// Modes in place of an interface.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct InterfaceSummary<'a> {
    /// How many.
    pub modes: usize,
    /// Their frequencies, Hz.
    pub frequencies_hz: Vec<f64>,
    /// That of the first one left out, Hz; `None`: none was.
    pub first_left_out_hz: Option<f64>,
    /// What the frequencies in the band rise by, relative.
    pub relative_rise: &'a [f64],
    /// Share of the interface's static flexibility that is lost.
    pub static_flexibility_lost: LostFlexibility,
}

/// A superelement from a file, checked.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ImportedSummary<'a> {
    /// The file.
    pub superelement: &'a Path,
    /// Number of its interface coordinates.
    pub interface_dof: usize,
    /// Frequencies of its modal coordinates, Hz.
    pub interior_frequencies_hz: &'a [f64],
    /// What a reader must know of it, in sentences.
    pub notes: &'a [String],
    /// Checks of its matrices.
    pub checks: Vec<CheckSummary<'a>>,
}

/// Frequency of an eigenvalue in 1/s^2, Hz.
pub(crate) fn hz(value: f64) -> f64 {
    value.max(0.0).sqrt() / TAU
}

impl CondenseResult {
    /// What `condense.json` says of it.
    pub(crate) fn summary(&self) -> CondenseSummary<'_> {
        let (condensed, estimate) = (&self.stage.condensed, &self.estimate);
        let (basis, modes) = (&condensed.basis, estimate.modes.iter());
        let (complete, full) = (basis.complete_below, self.full.as_ref());
        CondenseSummary {
            interface_dof: condensed.superelement.interface_dof,
            coordinates: self.superelement().order(),
            interface_reduction: self.interface.as_ref().map(InterfaceSummary::of),
            interior_dof: condensed.substructure.interior_dof(),
            fixed_interface_modes: basis.count() - basis.residual_vectors,
            residual_vectors: basis.residual_vectors,
            interior_frequencies_hz: basis.values().iter().copied().map(hz).collect(),
            complete_below_hz: complete.is_finite().then(|| hz(complete)),
            band_hz: estimate.band_hz,
            frequencies_hz: modes.clone().map(|mode| mode.frequency_hz).collect(),
            estimated_relative_error: modes.map(|mode| mode.relative_error).collect(),
            estimate: EstimateSummary {
                largest: estimate.largest(),
                converged: estimate.converged,
                rounds: estimate.rounds,
                out_of_band: estimate.out_of_band,
            },
            checks: CheckSummary::of(&self.checks),
            full_frequencies_hz: full.map(|full| full.frequencies_hz.as_slice()),
            relative_error: full.map(|full| full.relative_errors.as_slice()),
            effectivity: full.and_then(|full| full.effectivity),
            error_by_size: full.map(|full| full.sizes.as_slice()),
            tie_price: self.tie_price.as_ref(),
            bore_price: self.bore_price.as_deref(),
            warnings: &self.doubts,
        }
    }
}

impl<'a> InterfaceSummary<'a> {
    fn of(interface: &'a ReducedInterface) -> Self {
        let reduction = &interface.reduction;
        Self {
            modes: reduction.kept(),
            frequencies_hz: reduction.values().iter().copied().map(hz).collect(),
            first_left_out_hz: reduction.next.map(hz),
            relative_rise: &interface.rises,
            static_flexibility_lost: interface.lost,
        }
    }
}

impl ImportedHousing {
    /// What `condense.json` says of it.
    pub(crate) fn summary(&self) -> ImportedSummary<'_> {
        ImportedSummary {
            superelement: &self.path,
            interface_dof: self.element.interface_dof,
            interior_frequencies_hz: &self.record.modal_hz,
            notes: &self.notes,
            checks: CheckSummary::of(&self.checks),
        }
    }
}

impl Serialize for CondenseResult {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.summary().serialize(serializer)
    }
}
