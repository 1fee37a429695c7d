//! The full model's responses beside those of the reduced one.

use super::reduced::{FrfHousing, ReducedPaths, TransferPath, places};
use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::app::scene::damping::modal_damping;
use crate::app::scene::places::Place;
use crate::fe::assembly::StructuralStiffness;
use crate::fe::reduction::frf::{FrequencyResponse, ModalDamping};
use crate::numerics::Watch;
use crate::numerics::linalg::{DenseMatrix, HarmonicDamping, HarmonicProblem, complex_columns};
use faer::c64;
use std::f64::consts::TAU;

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
    let (alpha, beta) = match modal_damping(case)? {
        ModalDamping::Rayleigh { alpha, beta } => (alpha, beta),
        ModalDamping::Uniform(ratio) if ratio <= 0.0 => (0.0, 0.0),
        _ => {
            return nothing(
                "modal damping has no matrix in the full model; give [damping] as ratios at two frequencies or as alpha and beta to compare",
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
