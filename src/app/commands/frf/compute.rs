//! `plummer frf`: transfer paths of a housing, reduced, against the full model at chosen frequencies.
//!
//! The full model's responses beside those of the reduced one.

use super::reduced::{FrfHousing, ReducedPaths, TransferPath, places};
use crate::app::case;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::damping::damping;
use crate::app::scene::doubts;
use crate::app::scene::imported::unused_damping;
use crate::app::scene::places::Place;
use crate::fe::assembly::StructuralStiffness;
use crate::fe::reduction::ResponseEstimate;
use crate::fe::reduction::frf::{BandVariant, FrequencyResponse, FrfError, ModalDamping, RankedVariant, rank_in_band};
use crate::numerics::linalg::{DenseMatrix, HarmonicDamping, HarmonicProblem, complex_columns};
use crate::numerics::{Unwatched, Watch};
use faer::c64;
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
    let (compared, not_compared) = compare(case, asked, &reduced, &response, &paths, watch)?;
    let others = variants(case, watch)?;
    let ranking = rank(&response, &others, &paths, reduced.band_hz)?;
    let (of_mesh, of_file) = match &reduced.housing {
        FrfHousing::Mesh(stage) => (Some((&stage.housing.mesh, &stage.housing.model)), None),
        FrfHousing::File(file) => (None, Some(&file.0)),
    };
    let mut doubts = doubts(case, of_mesh, None)?;
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

/// Peaks and places between them at which the full model is solved unless the case says where.
const CHECKED: usize = 4;

/// Responses at one frequency in both models.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedResponse {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Receptances of every path, path by path, m/N.
    pub reduced: Vec<c64>,
    /// The same of the full model.
    pub full: Vec<c64>,
    /// Largest `|reduced - full| / |full|` of the paths; of one that carries nothing, relative to the response at its ends.
    pub difference: f64,
    /// Estimated error; none outside the band.
    pub estimated: Option<f64>,
    /// Relative residual of the full solution.
    pub residual: f64,
}

/// Responses of the full model, and why there is none.
pub(crate) fn compare(
    case: &Case,
    asked: &case::Frf,
    reduced: &ReducedPaths<'_>,
    response: &FrequencyResponse,
    paths: &[TransferPath],
    watch: &impl Watch,
) -> Result<(Vec<ComparedResponse>, Option<String>), ComputeError> {
    let nothing = |why: &str| Ok((Vec::new(), Some(why.to_owned())));
    let FrfHousing::Mesh(stage) = &reduced.housing else {
        return nothing("the housing is a superelement from a file, of which no mesh is known");
    };
    let (alpha, beta) = match damping(case)? {
        ModalDamping::Rayleigh { alpha, beta } => (alpha, beta),
        ModalDamping::Uniform(ratio) if ratio <= 0.0 => (0.0, 0.0),
        _ => {
            return nothing(
                "the full model cannot use one damping ratio for all modes; to compare, give [damping] as ratios at two frequencies or as alpha and beta",
            );
        }
    };
    let automatic = || checked_frequencies(reduced, response, paths);
    let mut chosen = asked.check_hz.clone().unwrap_or_else(automatic);
    chosen.sort_by(f64::total_cmp);
    chosen.dedup();
    if chosen.is_empty() {
        return nothing("no frequency was asked for");
    }
    let places = [places(stage, &reduced.ends[0])?, places(stage, &reduced.ends[1])?];
    watch.stage("full model");
    let coupled = stage.full_matrices();
    let structural = StructuralStiffness::assemble(&stage.housing.model)?;
    let structural = structural.map(|k| coupled.motions.congruent(k.matrix()));
    let damping = HarmonicDamping { alpha, beta, viscous: None, structural: structural.as_ref() };
    let free = &coupled.free_dofs;
    let problem = HarmonicProblem::restricted(&coupled.stiffness, &coupled.mass, &damping, free)?;
    let rows = |places: Vec<Place>| -> Vec<Vec<f64>> {
        let whole = places.iter().map(|place| place.full(&stage.boundary, &coupled));
        whole.map(|row| free.iter().map(|&dof| row[dof]).collect()).collect()
    };
    let [from, to] = places.map(rows);
    let loads = DenseMatrix::from_fn(free.len(), from.len(), |row, load| from[load][row]);
    let loads = complex_columns(&loads);
    let own = reduced.response(&chosen)?;
    let mut compared = Vec::with_capacity(chosen.len());
    for (index, &hz) in chosen.iter().enumerate() {
        watch.fraction(index as f64 / chosen.len() as f64);
        let solution = problem.solve(TAU * hz, &loads)?;
        let mut at = ComparedResponse {
            frequency_hz: hz,
            reduced: Vec::with_capacity(paths.len()),
            full: Vec::with_capacity(paths.len()),
            difference: 0.0,
            estimated: reduced.estimate.as_ref().and_then(|estimate| estimate.at(hz)),
            residual: solution.residuals.iter().copied().fold(0.0, f64::max),
        };
        for path in paths {
            let (sensor, load) = path.place;
            let full: c64 =
                to[sensor].iter().enumerate().map(|(row, &factor)| solution.displacements[(row, load)] * factor).sum();
            let found = own.receptance()[index][(sensor, load)];
            let closed = reduced.estimate.as_ref().and_then(|all| all.closed(path.place));
            let level = closed.unwrap_or(full.norm());
            at.difference = at.difference.max((found - full).norm() / level);
            at.reduced.push(found);
            at.full.push(full);
        }
        compared.push(at);
    }
    Ok((compared, None))
}

/// The highest peaks of the first path's accelerance, where the estimated error is largest, the band's top, and places
/// between.
fn checked_frequencies(reduced: &ReducedPaths<'_>, response: &FrequencyResponse, paths: &[TransferPath]) -> Vec<f64> {
    let [low, high] = reduced.band_hz;
    let hz = response.frequencies_hz();
    let magnitude = |place: usize| {
        let of_path = |path: &TransferPath| response.receptance()[place][path.place].norm();
        paths.first().map_or(0.0, of_path) * hz[place] * hz[place]
    };
    let mut peaks: Vec<usize> = (1..hz.len().saturating_sub(1))
        .filter(|&at| magnitude(at) >= magnitude(at - 1) && magnitude(at) > magnitude(at + 1))
        .collect();
    peaks.sort_by(|&a, &b| magnitude(b).total_cmp(&magnitude(a)));
    peaks.truncate(CHECKED);
    let between = (1..=CHECKED).map(|part| low + (high - low) * part as f64 / CHECKED as f64);
    let mut chosen: Vec<f64> = peaks.into_iter().map(|at| hz[at]).chain(between).collect();
    let worst = reduced.estimate.as_ref().and_then(|estimate| estimate.largest());
    chosen.extend(worst.map(|(hz, _)| hz));
    chosen
}
