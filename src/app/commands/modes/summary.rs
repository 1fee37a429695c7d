//! What `modes.json` says.

use super::{FileComparison, MeshConvergence, ModesResult, Reading};
use crate::app::commands::parts::{ExpectedMode, SuperelementSummary};
use crate::fe::modal::{EnergyShares, FrequencyCount, MassProperties, Mechanisms};
use crate::numerics::linalg::{DenseMatrix, EigenTimes};
use crate::system::{LoadedModes, LoadedPass, LoadedPoint};
use schemars::JsonSchema;
use serde::Serialize;

/// The modes of a case.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ModesSummary<'a> {
    /// Degrees of freedom of ring and housing, fixed and tied ones included.
    pub dof: usize,
    /// Degrees of freedom that the modes were computed over.
    pub free_dof: usize,
    /// Mass, kg; `None` of a superelement from a file.
    pub mass_kg: Option<f64>,
    /// Centroid x, y, z, m; of a plane model without z.
    pub centroid_m: Option<[Option<f64>; 3]>,
    /// Mass, centroid and inertia.
    pub mass: Option<MassProperties>,
    /// Loaded frequencies over a ball pass and over the load, if asked for.
    pub ball_pass: Option<BallPassSummary>,
    /// Frequencies without contact, Hz, ascending.
    pub frequencies_hz: &'a [f64],
    /// How far each may be from that of the same matrices in exact arithmetic, Hz.
    pub error_bounds_hz: &'a [f64],
    /// How many of the first modes have no strain energy.
    pub rigid_modes: usize,
    /// `|K phi - lambda M phi|` relative to its terms.
    pub residuals: &'a [f64],
    /// Largest entry of `Phi^T M Phi - 1`.
    pub orthogonality: f64,
    /// The proof that no mode is missing.
    pub count_check: FrequencyCount,
    /// Shift of the factorisation, 1/s^2.
    pub shift: f64,
    /// Wall time of the eigenvalue computation, s.
    pub eigen_s: EigenTimes,
    /// Participation factors [modes x directions], kg^1/2, of rotations kg^1/2 m.
    pub participation_factors: Option<Vec<Vec<f64>>>,
    /// Effective masses [modes x directions], kg, of rotations kg m^2.
    pub effective_mass: Option<Vec<Vec<f64>>>,
    /// Their sums by direction, kg or kg m^2.
    pub effective_mass_sum: Option<&'a [f64]>,
    /// What all modes together would have, kg or kg m^2.
    pub effective_mass_total: Option<&'a [f64]>,
    /// Where the energy of each mode is; `None` where there is one place only.
    pub energy_shares: Option<&'a EnergyShares>,
    /// Why modes without strain exist; `None` for too many bodies.
    pub free_motions: Option<&'a Mechanisms>,
    /// Largest relative difference of the frequencies of the condensed model; `None` where nothing is condensed.
    pub condensation_difference: Option<f64>,
    /// The superelement in the housing's place, if there is one.
    pub superelement: Option<SuperelementSummary<'a>>,
    /// Modes linearised at the static equilibrium, if asked for.
    pub loaded: Option<&'a LoadedModes>,
    /// Expected frequencies against these.
    pub expected: &'a [ExpectedMode],
    /// These modes against those of files.
    pub comparisons: &'a [FileComparison],
    /// The same modes on other meshes.
    pub convergence: Option<&'a MeshConvergence>,
    /// What of the model may be meant otherwise, a sentence each.
    pub warnings: &'a [String],
    /// The case's variants.
    pub variants: &'a [Reading],
}

/// Loaded frequencies over a ball pass and over the load.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct BallPassSummary {
    /// Over one ball spacing, each at an angle of the cage, rad.
    pub over_angle_rad: Vec<LoadedPointSummary>,
    /// Each at a load in units of the case's.
    pub over_load: Vec<LoadedPointSummary>,
}

/// Loaded frequencies at an angle or a load.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LoadedPointSummary {
    /// The angle, rad, or the load in units of the case's.
    pub at: f64,
    /// Frequencies, Hz; `None` where no equilibrium was found.
    pub frequencies_hz: Option<Vec<f64>>,
}

impl ModesResult {
    /// What `modes.json` says of it.
    pub(crate) fn summary(&self) -> ModesSummary<'_> {
        let survey = &self.survey;
        let (basis, found) = (&survey.basis, survey.participation.as_ref());
        ModesSummary {
            dof: survey.dof,
            free_dof: survey.free_dof,
            mass_kg: survey.mass.as_ref().map(|mass| mass.mass),
            centroid_m: survey.mass.as_ref().map(MassProperties::centroid),
            mass: survey.mass,
            ball_pass: self.loaded_pass.as_ref().map(BallPassSummary::of),
            frequencies_hz: &self.base.unloaded_hz,
            error_bounds_hz: &basis.error_bounds_hz,
            rigid_modes: basis.rigid_modes,
            residuals: &basis.residuals,
            orthogonality: basis.orthogonality,
            count_check: basis.count_check,
            shift: basis.shift,
            eigen_s: basis.times,
            participation_factors: found.map(|found| rows(&found.factors)),
            effective_mass: found.map(|found| rows(&found.effective)),
            effective_mass_sum: found.map(|found| found.sums.as_slice()),
            effective_mass_total: found.map(|found| found.totals.as_slice()),
            energy_shares: survey.shares.as_ref(),
            free_motions: survey.mechanisms.as_ref(),
            condensation_difference: self.base.condensation_difference,
            superelement: self.structure.as_ref().and_then(SuperelementSummary::of),
            loaded: self.base.loaded.as_ref(),
            expected: &self.base.expected,
            comparisons: &self.comparisons,
            convergence: self.convergence.as_ref(),
            warnings: &self.doubts,
            variants: &self.variants,
        }
    }
}

impl BallPassSummary {
    fn of(pass: &LoadedPass) -> Self {
        let summary = |point: &LoadedPoint| LoadedPointSummary {
            at: point.at,
            frequencies_hz: point.modes.as_ref().map(|loaded| {
                let modes = loaded.modes.iter();
                modes.map(|mode| mode.frequency_hz).collect()
            }),
        };
        Self {
            over_angle_rad: pass.over_angle.iter().map(summary).collect(),
            over_load: pass.over_load.iter().map(summary).collect(),
        }
    }
}

fn rows(a: &DenseMatrix) -> Vec<Vec<f64>> {
    (0..a.nrows()).map(|row| a.row(row).iter().copied().collect()).collect()
}
