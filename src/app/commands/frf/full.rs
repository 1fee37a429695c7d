//! The full model's responses beside those of the reduced one.
//!
//! With one ratio for every mode, the full model's viscous matrix is `M Phi diag(2 zeta w_r) Phi^T M` over its own modes. Those up
//! to [`EXACT`] times the highest frequency are computed; Ritz vectors of the forces and sensors stand for the ones above.

use super::reduced::{FrfHousing, ReducedPaths, TransferPath, places};
use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::app::scene::damping::damping;
use crate::app::scene::places::Place;
use crate::fe::assembly::{CoupledMatrices, StructuralStiffness};
use crate::fe::modal::{ModalBasis, ModeRange};
use crate::fe::reduction::frf::{FrequencyResponse, ModalDamping};
use crate::numerics::Watch;
use crate::numerics::linalg::{
    DenseMatrix, EigenProblem, HarmonicDamping, HarmonicProblem, LinalgError, MotionDamping, SymmetricSpectrum,
    complex_columns,
};
use faer::c64;
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Peaks and places between them at which the full model is solved unless the case says where.
const CHECKED: usize = 4;

/// Modes of the full model up to so many times the highest frequency are computed.
const EXACT: f64 = 1.5;

/// Ritz vectors of each force and sensor that stand for the modes above. The damping that they lack falls by a factor of five and more
/// with each.
const BLOCKS: usize = 4;

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

/// The modes of the full model that one ratio damps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct FullDamping {
    /// Modes that were computed, and are damped each by itself.
    pub modes: usize,
    /// All modes up to here are among them, Hz.
    pub up_to_hz: f64,
    /// Ritz vectors that stand for the modes above.
    pub ritz_vectors: usize,
    /// Largest change of a response, relative as the difference is, by the last of those vectors of each force and sensor: a bound in practice of
    /// what the damping above lacks.
    pub left_out: f64,
}

/// Both models compared.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Comparison {
    pub compared: Vec<ComparedResponse>,
    /// Why nothing was compared, if nothing was.
    pub not_compared: Option<String>,
    /// Damping of the full model by one ratio.
    pub damping: Option<FullDamping>,
}

/// Responses of the full model, and why there is none.
///
/// # Errors
/// [`ComputeError`] of places and of solutions of the full model.
pub(super) fn compare(
    case: &Case,
    asked: &case::Frf,
    reduced: &ReducedPaths<'_>,
    response: &FrequencyResponse,
    paths: &[TransferPath],
    watch: &impl Watch,
) -> Result<Comparison, ComputeError> {
    let nothing = |why: &str| Ok(Comparison { not_compared: Some(why.to_owned()), ..Comparison::default() });
    let FrfHousing::Mesh(stage) = &reduced.housing else {
        return nothing("the housing is a superelement from a file, of which no mesh is known");
    };
    let automatic = || checked_frequencies(reduced, response, paths);
    let mut chosen = asked.check_hz.clone().unwrap_or_else(automatic);
    chosen.sort_by(f64::total_cmp);
    chosen.dedup();
    let Some(&top) = chosen.last() else {
        return nothing("no frequency was asked for");
    };
    let places = [places(stage, &reduced.ends[0])?, places(stage, &reduced.ends[1])?];
    let coupled = stage.full_matrices();
    let structural = StructuralStiffness::assemble(&stage.housing.model)?;
    let structural = structural.map(|k| coupled.motions.congruent(k.matrix()));
    let free = &coupled.free_dofs;
    let columns = |places: Vec<Place>| {
        let whole: Vec<Vec<f64>> = places.iter().map(|place| place.full(&stage.boundary, &coupled)).collect();
        DenseMatrix::from_fn(free.len(), whole.len(), |row, place| whole[place][free[row]])
    };
    let [from, to] = places.map(columns);
    let (alpha, beta, ratio) = match damping(case)? {
        ModalDamping::Rayleigh { alpha, beta } => (alpha, beta, 0.0),
        ModalDamping::Uniform(ratio) => (0.0, 0.0, ratio),
        // no case has them
        ModalDamping::Each(_) | ModalDamping::Points(_) => return nothing("its damping is given mode by mode"),
    };
    let every_mode = (ratio > 0.0).then(|| EveryMode::new(&coupled, ratio, top, [&from, &to], watch)).transpose();
    let every_mode = match every_mode {
        Ok(every_mode) => every_mode,
        // more modes than memory holds, for one
        Err(error) => return nothing(&format!("its modes, which have the ratio of the case, were not found: {error}")),
    };
    watch.stage("full model");
    let damping = HarmonicDamping {
        alpha,
        beta,
        viscous: None,
        structural: structural.as_ref(),
        motions: every_mode.as_ref().map(EveryMode::damping),
    };
    let problem = HarmonicProblem::restricted(&coupled.stiffness, &coupled.mass, &damping, free)?;
    let loads = complex_columns(&from);
    let own = reduced.response(&chosen)?;
    let mut compared = Vec::with_capacity(chosen.len());
    let mut left_out = 0.0_f64;
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
            let displacements = (0..free.len()).map(|row| solution.displacements[(row, load)] * to[(row, sensor)]);
            let full: c64 = displacements.sum();
            let found = own.receptance()[index][(sensor, load)];
            let closed = reduced.estimate.as_ref().and_then(|all| all.closed(path.place));
            let level = closed.unwrap_or(full.norm());
            at.difference = at.difference.max((found - full).norm() / level);
            if let Some(every_mode) = &every_mode {
                left_out = left_out.max(every_mode.change_by_last(hz, path.place).norm() / level);
            }
            at.reduced.push(found);
            at.full.push(full);
        }
        compared.push(at);
    }
    let damping = every_mode.map(|every_mode| FullDamping { left_out, ..every_mode.counts });
    Ok(Comparison { compared, not_compared: None, damping })
}

/// Damping of the full model with one ratio for every mode.
struct EveryMode {
    ratio: f64,
    /// Modes, then Ritz vectors [free x k].
    shapes: DenseMatrix,
    /// `2 zeta w` of each, 1/s.
    rates: Vec<f64>,
    /// Ritz vectors by their eigenvalues between loads and sensors: all, and one fewer of each force and sensor.
    above: [Above; 2],
    counts: FullDamping,
}

/// Ritz vectors where forces act and motions are read.
struct Above {
    squared: Vec<f64>,
    driven: DenseMatrix,
    seen: DenseMatrix,
}

impl EveryMode {
    /// # Errors
    /// [`LinalgError`] of factorisation, eigenvalues and memory.
    fn new(
        coupled: &CoupledMatrices,
        ratio: f64,
        top_hz: f64,
        [from, to]: [&DenseMatrix; 2],
        watch: &impl Watch,
    ) -> Result<Self, LinalgError> {
        watch.stage("modes of the full model");
        let problem = EigenProblem::restricted(&coupled.stiffness, &coupled.mass, &coupled.free_dofs)?;
        // at rest nothing is damped: any modes serve
        let up_to_hz = (EXACT * top_hz).max(1.0);
        let modes = ModalBasis::told(&problem, ModeRange::UpToHz(up_to_hz), &|part| watch.fraction(part))?;
        let ends = faer::concat![[from, to]];
        let beyond = |blocks: usize| problem.beyond(&modes.shapes, (TAU * up_to_hz).powi(2), &ends, blocks);
        let at_ends = |ritz: &SymmetricSpectrum| Above {
            squared: ritz.values.clone(),
            driven: ritz.vectors.transpose() * from,
            seen: ritz.vectors.transpose() * to,
        };
        let (all, fewer) = (beyond(BLOCKS)?, beyond(BLOCKS - 1)?);
        let squared = modes.eigenvalues.iter().chain(&all.values);
        Ok(Self {
            ratio,
            rates: squared.map(|squared| 2.0 * ratio * squared.max(0.0).sqrt()).collect(),
            above: [at_ends(&all), at_ends(&fewer)],
            counts: FullDamping { modes: modes.count(), up_to_hz, ritz_vectors: all.values.len(), left_out: 0.0 },
            shapes: faer::concat![[modes.shapes, all.vectors]],
        })
    }

    fn damping(&self) -> MotionDamping<'_> {
        MotionDamping { shapes: &self.shapes, rates: &self.rates }
    }

    /// What the last Ritz vector of each force and sensor makes of the damping above, between a sensor and a load, m/N.
    fn change_by_last(&self, hz: f64, place: (usize, usize)) -> c64 {
        let [all, fewer] = &self.above;
        all.damped(self.ratio, hz, place) - fewer.damped(self.ratio, hz, place)
    }
}

impl Above {
    /// What damping changes of a receptance, m/N: `sum (d v)(v^T f) [1 / (a + i b) - 1 / a]`.
    /// There `a = w_r^2 - w^2` and `b = 2 zeta w_r w`.
    fn damped(&self, ratio: f64, hz: f64, (sensor, load): (usize, usize)) -> c64 {
        let omega = TAU * hz;
        let vectors = self.squared.iter().enumerate();
        let parts = vectors.map(|(vector, squared)| {
            let a = squared - omega * omega;
            let damped = c64::new(a, 2.0 * ratio * squared.max(0.0).sqrt() * omega);
            (1.0 / damped - 1.0 / a) * self.seen[(vector, sensor)] * self.driven[(vector, load)]
        });
        parts.sum()
    }
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
