//! What `modes.json` says.

use super::{FileComparison, MeshConvergence, ModesResult, Reading};
use crate::app::commands::parts::{ExpectedMode, SuperelementSummary};
use crate::fe::modal::{EnergyShares, MassProperties, Mechanisms, ModalBasis};
use crate::numerics::linalg::DenseMatrix;
use crate::system::{LoadedModes, LoadedPass};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

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
    pub ball_pass: Option<&'a LoadedPass>,
    /// Frequencies without contact and their accuracy.
    #[serde(flatten)]
    pub basis: &'a ModalBasis,
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

impl ModesResult {
    /// What `modes.json` says of it.
    pub(crate) fn summary(&self) -> ModesSummary<'_> {
        let survey = &self.survey;
        let found = survey.participation.as_ref();
        ModesSummary {
            dof: survey.dof,
            free_dof: survey.free_dof,
            mass_kg: survey.mass.as_ref().map(|mass| mass.mass),
            centroid_m: survey.mass.as_ref().map(MassProperties::centroid),
            mass: survey.mass,
            ball_pass: self.loaded_pass.as_ref(),
            basis: &survey.basis,
            participation_factors: found.map(|found| rows(&found.factors)),
            effective_mass: found.map(|found| rows(&found.effective)),
            effective_mass_sum: found.map(|found| found.sums.as_slice()),
            effective_mass_total: found.map(|found| found.totals.as_slice()),
            energy_shares: survey.shares.as_ref(),
            free_motions: survey.mechanisms.as_ref(),
            superelement: self.bodies.as_ref().and_then(SuperelementSummary::of),
            loaded: self.base.loaded.as_ref(),
            expected: &self.base.expected,
            comparisons: &self.comparisons,
            convergence: self.convergence.as_ref(),
            warnings: &self.doubts,
            variants: &self.variants,
        }
    }
}

fn rows(a: &DenseMatrix) -> Vec<Vec<f64>> {
    (0..a.nrows()).map(|row| a.row(row).iter().copied().collect()).collect()
}

impl Serialize for ModesResult {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.summary().serialize(serializer)
    }
}
