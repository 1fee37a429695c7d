//! What `frf.json` says.

use super::{FrfResult, FullDamping, RankedPath};
use crate::fe::reduction::frf::ModeShare;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// Transfer paths.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct FrfSummary<'a> {
    /// Unit of the receptances.
    pub unit: &'static str,
    /// Band, Hz.
    pub band_hz: [f64; 2],
    /// Number of interface coordinates.
    pub interface_dof: usize,
    /// Number of vectors of the interior.
    pub vectors: usize,
    /// Frequencies of the responses, Hz, ascending.
    pub frequency_hz: &'a [f64],
    /// The paths, sensor by sensor.
    pub paths: Vec<PathSummary<'a>>,
    /// Frequencies at which the full model was solved, Hz.
    pub full_frequency_hz: Vec<f64>,
    /// Relative residual of each of its solutions.
    pub full_residual: Vec<f64>,
    /// Largest estimated relative error of the paths at each frequency; `None` of a housing of which no mesh is known.
    #[schemars(with = "Option<Vec<Option<f64>>>")]
    pub estimated_error: Option<&'a [f64]>,
    /// Largest relative difference of the paths from the full model at each of its frequencies.
    #[schemars(with = "Vec<Option<f64>>")]
    pub difference: Vec<f64>,
    /// Largest error that passes.
    pub target: f64,
    /// Why nothing was compared with the full model, if nothing was.
    pub not_compared: Option<&'a str>,
    /// Modes by which the full model was damped where the case has one ratio for every mode.
    pub full_damping: Option<FullDamping>,
    /// What of the model may be meant otherwise, a sentence each.
    pub warnings: &'a [String],
    /// Variants of the case by path, indices from 0 into `paths`.
    pub ranking: &'a [RankedPath],
}

/// A path from a force to a sensor.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct PathSummary<'a> {
    /// Name of the force.
    pub from: &'a str,
    /// Name of the sensor.
    pub to: &'a str,
    /// Whether it carries nothing.
    pub closed: bool,
    /// Real parts of the receptances, m/N.
    pub re: Vec<f64>,
    /// Imaginary parts of the receptances, m/N.
    pub im: Vec<f64>,
    /// Real parts of the full model's receptances, m/N.
    pub full_re: Vec<f64>,
    /// Imaginary parts of the full model's receptances, m/N.
    pub full_im: Vec<f64>,
    /// What carries it in the band, the largest share first.
    pub modes: &'a [ModeShare],
}

impl FrfResult {
    /// What `frf.json` says of it.
    pub(crate) fn summary(&self) -> FrfSummary<'_> {
        let (element, compared) = (self.housing.element(), self.compared.iter());
        let paths = self.paths.iter().enumerate().map(|(index, path)| {
            let reduced = || self.response.receptance().iter().map(|at| at[path.place]);
            let full = || self.compared.iter().map(|at| at.full[index]);
            PathSummary {
                from: &path.from,
                to: &path.to,
                closed: path.is_closed(),
                re: reduced().map(|h| h.re).collect(),
                im: reduced().map(|h| h.im).collect(),
                full_re: full().map(|h| h.re).collect(),
                full_im: full().map(|h| h.im).collect(),
                modes: &path.shares.modes,
            }
        });
        let estimate = self.estimate.as_ref();
        FrfSummary {
            unit: "m/N",
            band_hz: self.band_hz,
            interface_dof: element.interface_dof,
            vectors: element.modal_dof(),
            frequency_hz: self.response.frequencies_hz(),
            paths: paths.collect(),
            full_frequency_hz: compared.clone().map(|at| at.frequency_hz).collect(),
            full_residual: compared.clone().map(|at| at.residual).collect(),
            estimated_error: estimate.map(|estimate| estimate.relative_errors.as_slice()),
            difference: compared.map(|at| at.difference).collect(),
            target: self.target,
            not_compared: self.not_compared.as_deref(),
            full_damping: self.full_damping,
            warnings: &self.doubts,
            ranking: &self.ranking,
        }
    }
}

impl Serialize for FrfResult {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.summary().serialize(serializer)
    }
}
