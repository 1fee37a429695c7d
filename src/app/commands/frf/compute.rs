//! `plummer frf`: transfer paths of a housing, reduced, against the full model at chosen frequencies.

use super::full::{ComparedResponse, Comparison, FullDamping, compare};
use super::reduced::{FrfHousing, ReducedPaths, TransferPath};
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::doubts;
use crate::app::scene::imported::unused_damping;
use crate::fe::reduction::ResponseEstimate;
use crate::fe::reduction::frf::{BandVariant, FrequencyResponse, FrfError, RankedVariant, rank_in_band};
use crate::numerics::{Unwatched, Watch};
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Variants of the case by what one path transmits.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RankedPath {
    /// Which path.
    pub path: usize,
    /// The case itself and its variants, the quietest first; energy mean of the accelerance, dB over 1 /kg.
    pub variants: Vec<RankedVariant>,
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
    /// Modes by which the full model was damped; none of damping that is not by modes.
    pub full_damping: Option<FullDamping>,
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
    let Comparison { compared, not_compared, damping: full_damping } =
        compare(case, asked, &reduced, &response, &paths, watch)?;
    let others = variants(case, watch)?;
    let ranking = rank(&response, &others, &paths, reduced.band_hz)?;
    let (of_mesh, of_file) = match &reduced.housing {
        FrfHousing::Mesh(stage) => (Some((&stage.housing.mesh, &stage.housing.model)), None),
        FrfHousing::File(file) => (None, Some(&file.0)),
    };
    let mut doubts = doubts(case, of_mesh, None)?;
    doubts.extend(not_compared.iter().map(|why| format!("nothing was compared with the full model: {why}")));
    if let Some(file) = of_file {
        doubts.extend(file.doubt(reduced.band_hz[1]));
        doubts.push(file.unknown_error());
        doubts.extend(unused_damping(&file.path, &file.record));
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
        full_damping,
        ranking,
    })
}

/// Responses of the case's variants, by what they differ in.
fn variants(case: &Case, watch: &impl Watch) -> Result<Vec<(String, FrequencyResponse)>, ComputeError> {
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

/// Ranks the case itself and its variants by the energy mean of each path's accelerance.
///
/// # Errors
/// [`FrfError`] of a band that the responses do not cover.
fn rank(
    own: &FrequencyResponse,
    others: &[(String, FrequencyResponse)],
    paths: &[TransferPath],
    band_hz: [f64; 2],
) -> Result<Vec<RankedPath>, FrfError> {
    if others.is_empty() {
        return Ok(Vec::new());
    }
    let accelerance = |response: &FrequencyResponse, place: (usize, usize)| -> Vec<f64> {
        let values = response.frequencies_hz().iter().zip(response.receptance());
        values.map(|(hz, receptance)| (TAU * hz).powi(2) * receptance[place].norm()).collect()
    };
    let others = others.iter().map(|(what, response)| (what.as_str(), response));
    let all: Vec<(&str, &FrequencyResponse)> = std::iter::once(("as given", own)).chain(others).collect();
    let mut ranking = Vec::with_capacity(paths.len());
    for (path, transfer) in paths.iter().enumerate() {
        let magnitudes: Vec<Vec<f64>> = all.iter().map(|(_, response)| accelerance(response, transfer.place)).collect();
        let variants = all.iter().zip(&magnitudes).map(|((name, response), magnitudes)| BandVariant {
            name,
            frequencies_hz: response.frequencies_hz(),
            magnitudes,
        });
        let variants: Vec<BandVariant<'_>> = variants.collect();
        ranking.push(RankedPath { path, variants: rank_in_band(&variants, band_hz, 1.0)? });
    }
    Ok(ranking)
}
