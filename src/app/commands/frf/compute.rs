//! `plummer frf`: transfer paths of a housing, reduced, against the full model at chosen frequencies.

use super::compared::{self, ComparedResponse};
use super::housing::FrfHousing;
use super::path::TransferPath;
use super::ranking::{self, RankedPath};
use super::reduced::ReducedPaths;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::doubts;
use crate::fe::reduction::ResponseEstimate;
use crate::fe::reduction::frf::FrequencyResponse;
use crate::numerics::{Unwatched, Watch};

impl TransferPath {
    /// What is said of a path that carries next to nothing.
    pub const CLOSED: &str = "carries less than 1e-7 of the responses at its ends, by symmetry or between bodies that hardly touch; no error is estimated there";

    /// Whether its responses are so small beside those at its ends that no mode is said to carry it.
    #[must_use]
    pub(crate) fn is_closed(&self) -> bool {
        self.shares.modes.is_empty()
    }
}

/// Result of the command.
#[derive(Debug, Clone)]
pub struct FrfResult {
    /// The condensed housing.
    pub housing: FrfHousing,
    /// Band, Hz.
    pub band_hz: [f64; 2],
    /// Receptances of the reduced model.
    pub response: FrequencyResponse,
    /// Their estimated errors; none of a housing of which no mesh is known.
    pub estimate: Option<ResponseEstimate>,
    /// The paths, sensor by sensor.
    pub paths: Vec<TransferPath>,
    /// Against the full model.
    pub compared: Vec<ComparedResponse>,
    /// Why nothing was compared, if nothing was.
    pub not_compared: Option<String>,
    /// Largest error that passes, relative to the response where it is read.
    pub target: f64,
    /// Variants by path.
    pub ranking: Vec<RankedPath>,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

impl FrfResult {
    /// Frequency and size of the largest estimated error.
    pub fn largest_estimate(&self) -> Option<(f64, f64)> {
        self.estimate.as_ref()?.largest()
    }

    /// Frequency and size of the largest difference from the full model; none where nothing was compared.
    pub(crate) fn largest_difference(&self) -> Option<(f64, f64)> {
        self.compared
            .iter()
            .map(|compared| (compared.frequency_hz, compared.difference))
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Whether the reduced response is as good as asked for: estimated in the whole band, and against the full model.
    pub fn passes(&self) -> bool {
        [self.largest_estimate(), self.largest_difference()]
            .into_iter()
            .flatten()
            .all(|(_, error)| error <= self.target)
    }
}

/// Computes the transfer paths of a case.
///
/// # Errors
/// [`ComputeError`] of the stages that it goes through.
pub fn compute_frf(case: &Case, watch: &impl Watch) -> Result<FrfResult, ComputeError> {
    let asked = case.frf.as_ref().ok_or(ComputeError::NothingToCondense)?;
    let reduced = ReducedPaths::build(case, asked, watch)?;
    watch.stage("response");
    let response = reduced.response(&reduced.frequencies_hz)?;
    let paths = reduced.transfer_paths()?;
    let (compared, not_compared) = compared::compare(case, asked, &reduced, &response, &paths, watch)?;
    let others = variants(case, watch)?;
    let ranking = ranking::rank(&response, &others, &paths, reduced.band_hz)?;
    let of_mesh = match &reduced.housing {
        FrfHousing::Mesh(stage) => Some((&stage.housing.mesh, &stage.housing.model)),
        FrfHousing::File(_) => None,
    };
    let mut doubts = doubts(case, of_mesh, None)?;
    if let FrfHousing::File(file) = &reduced.housing {
        doubts.extend(file.0.doubt(reduced.band_hz[1]));
        doubts.push(file.0.unknown_error());
        doubts.extend(file.0.unused_damping());
    }
    Ok(FrfResult {
        doubts,
        band_hz: reduced.band_hz,
        target: case.target(),
        housing: reduced.housing,
        estimate: reduced.estimate,
        response,
        paths,
        compared,
        not_compared,
        ranking,
    })
}

/// Responses of the case's variants, by what they differ in.
pub(crate) fn variants(case: &Case, watch: &impl Watch) -> Result<Vec<(String, FrequencyResponse)>, ComputeError> {
    let cases = case.frf_variants()?;
    let mut others = Vec::with_capacity(cases.len());
    if !cases.is_empty() {
        watch.stage("variants");
    }
    for (index, variant) in cases.iter().enumerate() {
        watch.fraction(index as f64 / cases.len() as f64);
        let asked = variant.case.frf.as_ref().ok_or(ComputeError::NothingToCondense)?;
        let other = ReducedPaths::build(&variant.case, asked, &Unwatched)?;
        let response = other.response(&other.frequencies_hz)?;
        others.push((variant.what.clone(), response));
    }
    Ok(others)
}
