//! `plummer frf`: transfer paths of a housing, reduced, against the full model at chosen frequencies.

use super::condensed::{CondensedStage, basis_choice};
use super::damping::{modal_damping, viscous_matrix};
use super::places::{Place, PlaceBodies};
use super::{StageError, Watch};
use crate::assembly::StructuralStiffness;
use crate::case::{self, Case};
use crate::linalg::{DenseMatrix, HarmonicDamping, HarmonicProblem, complex_columns};
use crate::reduction::frf::{
    BandVariant, FrequencyGrid, FrequencyResponse, FrfPaths, ModalBasis, ModalDamping,
    ModalSuperposition, PathShares, RankedVariant, ReducedSystem, Resonance, direct_response,
    frequency_list, rank_in_band,
};
use crate::reduction::{BasisChoice, BasisSize};
use faer::c64;
use std::f64::consts::TAU;

/// Equal intervals of the band in which the response is computed, beside its resonances.
const INTERVALS: usize = 400;

/// Peaks and places between them at which the full model is solved unless the case says where.
const CHECKED: usize = 4;

/// A frequency that is wrong by one bandwidth share `eps / zeta` changes the response beside a resonance by that share;
/// this much of the target is left to it.
const FREQUENCY_SHARE: f64 = 0.25;

/// Shares of the frequency target where nothing damps: only far from resonances is such a response of use.
const UNDAMPED: f64 = 1e-3;

/// Responses at one frequency in both models.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedResponse {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Receptances of every path, path by path, m/N.
    pub reduced: Vec<c64>,
    /// The same of the full model.
    pub full: Vec<c64>,
    /// Largest `|reduced - full| / |full|` of the paths.
    pub difference: f64,
    /// Relative residual of the full solution.
    pub residual: f64,
}

/// A path from a force to a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct TransferPath {
    /// Name of the force.
    pub from: String,
    /// Name of the sensor.
    pub to: String,
    /// Which load and which sensor of the response.
    pub place: (usize, usize),
    /// What carries it in the band.
    pub shares: PathShares,
}

/// Variants of the case by what one path transmits.
#[derive(Debug, Clone, PartialEq)]
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
    pub stage: CondensedStage,
    /// Band, Hz.
    pub band_hz: [f64; 2],
    /// Receptances of the reduced model.
    pub response: FrequencyResponse,
    /// The paths, sensor by sensor.
    pub paths: Vec<TransferPath>,
    /// Against the full model.
    pub compared: Vec<ComparedResponse>,
    /// Why nothing was compared, if nothing was.
    pub not_compared: Option<String>,
    /// Largest difference that passes.
    pub target: f64,
    /// Variants by path.
    pub ranking: Vec<RankedPath>,
}

impl FrfResult {
    /// Whether the reduced response agrees with the full one within the target.
    pub fn passes(&self) -> bool {
        self.compared
            .iter()
            .all(|compared| compared.difference <= self.target)
    }
}

/// Computes the transfer paths of a case.
///
/// # Errors
/// [`StageError`] of the stages that it goes through.
pub fn compute_frf(case: &Case, watch: &impl Watch) -> Result<FrfResult, StageError> {
    let asked = case.frf.as_ref().ok_or(StageError::NothingToCondense)?;
    let mut reduced = Reduced::build(case, asked, watch)?;
    watch.stage("response");
    let response = direct_response(&reduced.system, &reduced.paths, &reduced.frequencies_hz)?;
    let paths = reduced.transfer_paths()?;
    let (compared, not_compared) = compare(case, asked, &reduced, &response, &paths, watch)?;
    let cases = case.frf_variants()?;
    let mut others = Vec::with_capacity(cases.len());
    if !cases.is_empty() {
        watch.stage("variants");
    }
    for (index, variant) in cases.iter().enumerate() {
        watch.fraction(index as f64 / cases.len() as f64);
        let asked = variant
            .case
            .frf
            .as_ref()
            .ok_or(StageError::NothingToCondense)?;
        let other = Reduced::build(&variant.case, asked, &super::Unwatched)?;
        let response = direct_response(&other.system, &other.paths, &other.frequencies_hz)?;
        others.push((variant.what.clone(), response));
    }
    let ranking = rank(&response, &others, &paths, reduced.band_hz)?;
    Ok(FrfResult {
        band_hz: reduced.band_hz,
        target: case.target(),
        stage: reduced.stage.take().ok_or(StageError::NothingToCondense)?,
        response,
        paths,
        compared,
        not_compared,
        ranking,
    })
}

/// The reduced model of a case with its paths.
struct Reduced {
    stage: Option<CondensedStage>,
    names: [Vec<String>; 2],
    places: [Vec<Place>; 2],
    system: ReducedSystem,
    basis: ModalBasis,
    paths: FrfPaths,
    band_hz: [f64; 2],
    frequencies_hz: Vec<f64>,
}

impl Reduced {
    fn build(case: &Case, asked: &case::Frf, watch: &impl Watch) -> Result<Self, StageError> {
        let band_hz = asked
            .band_hz
            .or(case.band_hz())
            .unwrap_or([0.0, basis_choice(case).band_hz]);
        let damping = modal_damping(case)?;
        let choice = choice(case, &damping, band_hz);
        let stage = CondensedStage::with_basis(case, choice, watch)?
            .ok_or(StageError::NothingToCondense)?;
        let sensors = sensors(case, asked);
        let ring = stage.boundary.ring();
        let bodies = PlaceBodies {
            housing: Some(&stage.housing),
            ring: ring.map(|(ring, _)| ring),
            tie: ring.map(|(_, tie)| tie),
            frame: *stage.housing.model.frame(),
        };
        let from = asked
            .from
            .iter()
            .map(|push| Place::new(bodies, &push.name, &push.spot, push.direction))
            .collect::<Result<Vec<_>, _>>()?;
        let to = sensors
            .iter()
            .map(|sensor| Place::new(bodies, &sensor.name, &sensor.spot, sensor.direction))
            .collect::<Result<Vec<_>, _>>()?;
        // static response to every force and, as the path back is the same, to a force at every sensor
        let dof = stage.housing.model.dof();
        let all: Vec<Vec<f64>> = from
            .iter()
            .chain(&to)
            .map(|at| at.on_housing(dof))
            .collect();
        let loads = DenseMatrix::from_fn(dof, all.len(), |row, column| all[column][row]);
        let stage = stage.with_loads(&loads)?;
        let (system, basis) = system(case, &stage)?;
        let order = system.order();
        let rows: Vec<Vec<f64>> = from.iter().map(|at| at.reduced(&stage.condensed)).collect();
        let seen: Vec<Vec<f64>> = to.iter().map(|at| at.reduced(&stage.condensed)).collect();
        let paths = FrfPaths {
            loads: DenseMatrix::from_fn(order, rows.len(), |row, load| rows[load][row]),
            sensors: DenseMatrix::from_fn(seen.len(), order, |sensor, row| seen[sensor][row]),
        };
        let superposition = ModalSuperposition::new(
            &system,
            &basis,
            &paths,
            basis.frequencies_hz().len(),
            &NO_MORE,
        )?;
        let resonances: Vec<Resonance> = basis
            .frequencies_hz()
            .iter()
            .enumerate()
            .filter(|(_, hz)| **hz > 0.0 && **hz <= 1.1 * band_hz[1])
            .map(|(mode, &frequency_hz)| Resonance {
                frequency_hz,
                ratio: superposition.ratio(mode).unwrap_or(0.0),
            })
            .collect();
        let grid = FrequencyGrid {
            band_hz,
            intervals: INTERVALS,
            points_a_bandwidth: 4,
            reach: 3.0,
        };
        Ok(Self {
            frequencies_hz: frequency_list(&grid, &resonances)?,
            names: [
                asked.from.iter().map(|push| push.name.clone()).collect(),
                sensors.iter().map(|sensor| sensor.name.clone()).collect(),
            ],
            places: [from, to],
            stage: Some(stage),
            system,
            basis,
            paths,
            band_hz,
        })
    }

    fn transfer_paths(&self) -> Result<Vec<TransferPath>, StageError> {
        let superposition = ModalSuperposition::new(
            &self.system,
            &self.basis,
            &self.paths,
            self.basis.frequencies_hz().len(),
            &NO_MORE,
        )?;
        let [from, to] = &self.names;
        let mut paths = Vec::with_capacity(from.len() * to.len());
        for (sensor, to) in to.iter().enumerate() {
            for (load, from) in from.iter().enumerate() {
                paths.push(TransferPath {
                    from: from.clone(),
                    to: to.clone(),
                    place: (sensor, load),
                    shares: superposition.shares(
                        sensor,
                        load,
                        self.band_hz,
                        &self.frequencies_hz,
                    )?,
                });
            }
        }
        Ok(paths)
    }
}

/// The case's damping is in the system's matrix already.
const NO_MORE: ModalDamping = ModalDamping::Uniform(0.0);

/// Sensors of the paths: those named, or all.
fn sensors<'c>(case: &'c Case, asked: &case::Frf) -> Vec<&'c case::Sensor> {
    let named = |sensor: &&case::Sensor| asked.to.is_empty() || asked.to.contains(&sensor.name);
    case.sensors.iter().filter(named).collect()
}

/// The case's basis, `auto` with a target for frequencies that the target for responses needs.
fn choice(case: &Case, damping: &ModalDamping, [low, high]: [f64; 2]) -> BasisChoice {
    let asked = basis_choice(case);
    let ratio = |hz: f64| match damping {
        ModalDamping::Rayleigh { alpha, beta } => {
            let omega = TAU * hz.max(1.0);
            0.5 * (alpha / omega + beta * omega)
        }
        ModalDamping::Uniform(ratio) => *ratio,
        _ => 0.0,
    };
    // alpha / w + beta w is least inside the band or at its ends
    let steps = (0..=100).map(|step| low + (high - low) * f64::from(step) / 100.0);
    let least = steps.map(ratio).fold(f64::INFINITY, f64::min).max(UNDAMPED);
    BasisChoice {
        size: match asked.size {
            BasisSize::Auto(target) => BasisSize::Auto(FREQUENCY_SHARE * target * least),
            size => size,
        },
        band_hz: high,
        ..asked
    }
}

/// Housing and ring, with the case's damping.
fn system(case: &Case, stage: &CondensedStage) -> Result<(ReducedSystem, ModalBasis), StageError> {
    let element = &stage.condensed.superelement;
    let with_ring = |own: &DenseMatrix, ring: Option<&DenseMatrix>| {
        let mut sum = own.clone();
        if let Some(ring) = ring {
            for column in 0..ring.ncols() {
                for row in 0..ring.nrows() {
                    sum[(row, column)] += ring[(row, column)];
                }
            }
        }
        sum
    };
    let attached = stage.boundary.attached();
    let k = with_ring(&element.stiffness, attached.map(|part| part.stiffness));
    let m = with_ring(&element.mass, attached.map(|part| part.mass));
    let viscous = viscous_matrix(case, &k, &m)?;
    let mut system = ReducedSystem::new(k, m)?.with_viscous(viscous)?;
    if let Some(structural) = &element.structural {
        system = system.with_structural(structural.clone())?;
    }
    let basis = ModalBasis::new(&system)?;
    Ok((system, basis))
}

/// Responses of the full model, and why there is none.
fn compare(
    case: &Case,
    asked: &case::Frf,
    reduced: &Reduced,
    response: &FrequencyResponse,
    paths: &[TransferPath],
    watch: &impl Watch,
) -> Result<(Vec<ComparedResponse>, Option<String>), StageError> {
    let ModalDamping::Rayleigh { alpha, beta } = modal_damping(case)? else {
        let why = "modal damping has no matrix in the full model; give [damping] as ratios at two frequencies or as alpha and beta to compare";
        return Ok((Vec::new(), Some(why.to_owned())));
    };
    let chosen = match &asked.check_hz {
        Some(given) => given.clone(),
        None => checked_frequencies(response, paths, reduced.band_hz),
    };
    let Some(stage) = reduced.stage.as_ref().filter(|_| !chosen.is_empty()) else {
        return Ok((Vec::new(), Some("no frequency was asked for".to_owned())));
    };
    watch.stage("full model");
    let coupled = stage.full_matrices();
    let structural = StructuralStiffness::assemble(&stage.housing.model)?;
    let structural = structural.map(|k| coupled.motions.congruent(k.matrix()));
    let damping = HarmonicDamping {
        alpha,
        beta,
        viscous: None,
        structural: structural.as_ref(),
    };
    let free = &coupled.free_dofs;
    let problem = HarmonicProblem::restricted(&coupled.stiffness, &coupled.mass, &damping, free)?;
    let rows = |places: &[Place]| -> Vec<Vec<f64>> {
        let whole = places
            .iter()
            .map(|place| place.full(&stage.boundary, &coupled));
        whole
            .map(|row| free.iter().map(|&dof| row[dof]).collect())
            .collect()
    };
    let (from, to) = (rows(&reduced.places[0]), rows(&reduced.places[1]));
    let loads = DenseMatrix::from_fn(free.len(), from.len(), |row, load| from[load][row]);
    let loads = complex_columns(&loads);
    let own = direct_response(&reduced.system, &reduced.paths, &chosen)?;
    let mut compared = Vec::with_capacity(chosen.len());
    for (index, &hz) in chosen.iter().enumerate() {
        watch.fraction(index as f64 / chosen.len() as f64);
        let solution = problem.solve(TAU * hz, &loads)?;
        let mut at = ComparedResponse {
            frequency_hz: hz,
            reduced: Vec::with_capacity(paths.len()),
            full: Vec::with_capacity(paths.len()),
            difference: 0.0,
            residual: solution.residuals.iter().copied().fold(0.0, f64::max),
        };
        for path in paths {
            let (sensor, load) = path.place;
            let full: c64 = to[sensor]
                .iter()
                .enumerate()
                .map(|(row, &factor)| solution.displacements[(row, load)] * factor)
                .sum();
            let found = own.receptance()[index][(sensor, load)];
            at.difference = at.difference.max((found - full).norm() / full.norm());
            at.reduced.push(found);
            at.full.push(full);
        }
        compared.push(at);
    }
    Ok((compared, None))
}

/// The highest peaks of the first path's accelerance, the band's top, and places between.
fn checked_frequencies(
    response: &FrequencyResponse,
    paths: &[TransferPath],
    [low, high]: [f64; 2],
) -> Vec<f64> {
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
    chosen.sort_by(f64::total_cmp);
    chosen.dedup();
    chosen
}

fn rank(
    own: &FrequencyResponse,
    others: &[(String, FrequencyResponse)],
    paths: &[TransferPath],
    band_hz: [f64; 2],
) -> Result<Vec<RankedPath>, StageError> {
    if others.is_empty() {
        return Ok(Vec::new());
    }
    let accelerance = |response: &FrequencyResponse, place: (usize, usize)| -> Vec<f64> {
        let values = response.frequencies_hz().iter().zip(response.receptance());
        values
            .map(|(hz, receptance)| (TAU * hz).powi(2) * receptance[place].norm())
            .collect()
    };
    let all = || {
        std::iter::once(("as given", own)).chain(
            others
                .iter()
                .map(|(what, response)| (what.as_str(), response)),
        )
    };
    let mut ranking = Vec::with_capacity(paths.len());
    for (path, transfer) in paths.iter().enumerate() {
        let magnitudes: Vec<Vec<f64>> = all()
            .map(|(_, response)| accelerance(response, transfer.place))
            .collect();
        let variants: Vec<BandVariant<'_>> = all()
            .zip(&magnitudes)
            .map(|((name, response), magnitudes)| BandVariant {
                name,
                frequencies_hz: response.frequencies_hz(),
                magnitudes,
            })
            .collect();
        ranking.push(RankedPath {
            path,
            variants: rank_in_band(&variants, band_hz, 1.0)?,
        });
    }
    Ok(ranking)
}
