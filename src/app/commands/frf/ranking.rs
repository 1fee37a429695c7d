//! Variants of a case by what its paths transmit.

use super::path::TransferPath;
use crate::fe::reduction::frf::{BandVariant, FrequencyResponse, FrfError, RankedVariant, rank_in_band};
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

/// Ranks the case itself and its variants by the energy mean of each path's accelerance.
///
/// # Errors
/// [`FrfError`] of a band that the responses do not cover.
pub(crate) fn rank(
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
    let all =
        || std::iter::once(("as given", own)).chain(others.iter().map(|(what, response)| (what.as_str(), response)));
    let mut ranking = Vec::with_capacity(paths.len());
    for (path, transfer) in paths.iter().enumerate() {
        let magnitudes: Vec<Vec<f64>> = all().map(|(_, response)| accelerance(response, transfer.place)).collect();
        let variants: Vec<BandVariant<'_>> = all()
            .zip(&magnitudes)
            .map(|((name, response), magnitudes)| BandVariant {
                name,
                frequencies_hz: response.frequencies_hz(),
                magnitudes,
            })
            .collect();
        ranking.push(RankedPath { path, variants: rank_in_band(&variants, band_hz, 1.0)? });
    }
    Ok(ranking)
}
