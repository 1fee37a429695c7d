//! The reduced model on the paths of a case, with as many residual vectors as its responses need.

use super::housing::{FrfHousing, Spot, places};
use super::path::{CarriedPart, TransferPath};
use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::app::scene::CondensedHousing;
use crate::app::scene::condensed::basis_choice;
use crate::app::scene::damping::{mass_damping, modal_damping, viscous_matrix};
use crate::app::scene::places::{Named, Place};
use crate::fe::reduction::frf::{
    FrequencyGrid, FrequencyResponse, FrfPaths, ModalBasis, ModalDamping, ModalSuperposition, ReducedSystem, Resonance,
    direct_response, frequency_list,
};
use crate::fe::reduction::{BasisChoice, BasisSize, InteriorDamping, ResponseEstimate, UNCOUPLED};
use crate::numerics::Watch;
use crate::numerics::linalg::DenseMatrix;

/// Equal intervals of the band in which the response is computed, beside its resonances.
const INTERVALS: usize = 400;

/// Part of the target that the estimated error may use: an estimate of first order may be a few per cent too small.
const MARGIN: f64 = 0.8;

/// How often residual vectors are added.
const ENLARGEMENTS: usize = 60;

/// Modes of which the contribution is kept over frequency.
const CARRIED: usize = 4;

/// The case's damping is in the system's matrices already.
const NO_MORE: ModalDamping = ModalDamping::Uniform(0.0);

/// A condensed housing, with its ring, on the paths of a case.
pub(crate) struct ReducedPaths<'c> {
    asked: Asked<'c>,
    pub housing: FrfHousing,
    pub band_hz: [f64; 2],
    pub frequencies_hz: Vec<f64>,
    /// None of a housing of which no mesh is known.
    pub estimate: Option<ResponseEstimate>,
    system: ReducedSystem,
    paths: FrfPaths,
    superposition: ModalSuperposition,
}

/// What a case asks for.
#[derive(Clone, Copy)]
struct Asked<'c> {
    case: &'c Case,
    frf: &'c case::Frf,
}

impl<'c> Asked<'c> {
    /// The forces, then the sensors: those named, or all.
    fn ends(self) -> [Vec<Spot<'c>>; 2] {
        let Self { case, frf } = self;
        let named = |sensor: &&case::Sensor| frf.to.is_empty() || frf.to.contains(&sensor.name);
        let sensors = case.sensors.iter().filter(named);
        let from = frf.from.iter();
        [
            from.map(|push| (Named::Force(&push.name), &push.spot, push.direction)).collect(),
            sensors.map(|sensor| (Named::Sensor(&sensor.name), &sensor.spot, sensor.direction)).collect(),
        ]
    }
}

impl<'c> ReducedPaths<'c> {
    /// Condenses the housing of a case for its paths, or reads it.
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub(crate) fn build(case: &'c Case, frf: &'c case::Frf, watch: &impl Watch) -> Result<Self, ComputeError> {
        let asked = Asked { case, frf };
        let choice = basis_choice(case);
        let band_hz = frf.band_hz.or(case.band_hz()).unwrap_or([0.0, choice.band_hz]);
        if let Some(path) = case.superelement() {
            watch.stage("read");
            return Self::of(asked, FrfHousing::read(case, path)?, band_hz);
        }
        let stage = CondensedHousing::with_basis(case, first_choice(choice, band_hz[1]), watch)?
            .ok_or(ComputeError::NothingToCondense)?;
        // static response to every force and, as the path back is the same, to a force at every sensor
        let ends = places(&stage, asked.ends().into_iter().flatten())?;
        let dof = stage.housing.model.dof();
        let all: Vec<Vec<f64>> = ends.iter().map(|at| at.on_housing(dof)).collect();
        let loads = DenseMatrix::from_fn(dof, all.len(), |row, column| all[column][row]);
        let meshed = |stage| FrfHousing::Mesh(Box::new(stage));
        let mut reduced = Self::of(asked, meshed(stage.with_loads(&loads)?), band_hz)?;
        if let BasisSize::Auto(target) = choice.size {
            watch.stage("basis for the responses");
            for _ in 0..ENLARGEMENTS {
                match (reduced.housing, &reduced.estimate) {
                    (FrfHousing::Mesh(stage), Some(estimate)) if estimate.lacking() > MARGIN * target => {
                        let stage = stage.with_forces(estimate.forces().clone())?;
                        reduced = Self::of(asked, meshed(stage), band_hz)?;
                    }
                    (housing, _) => {
                        reduced.housing = housing;
                        break;
                    }
                }
            }
        }
        Ok(reduced)
    }

    fn of(asked: Asked<'c>, housing: FrfHousing, band_hz: [f64; 2]) -> Result<Self, ComputeError> {
        let system = system(asked.case, &housing)?;
        let basis = ModalBasis::new(&system)?;
        let order = system.order();
        let [from, to] = asked.ends();
        let from = housing.rows(from.into_iter())?;
        let to = housing.rows(to.into_iter())?;
        let paths = FrfPaths {
            loads: DenseMatrix::from_fn(order, from.len(), |row, load| from[load][row]),
            sensors: DenseMatrix::from_fn(to.len(), order, |sensor, row| to[sensor][row]),
        };
        let kept = basis.frequencies_hz().len();
        let superposition = ModalSuperposition::new(&system, &basis, &paths, kept, &NO_MORE)?;
        let frequencies_hz = frequencies(asked.frf, &basis, &superposition, band_hz)?;
        let estimate = match &housing {
            FrfHousing::File(_) => None,
            FrfHousing::Mesh(stage) => Some(ResponseEstimate::new(
                &stage.condensed,
                InteriorDamping {
                    structural: stage.structural.as_ref(),
                    mass: mass_damping(asked.case)?,
                    by_mode: matches!(modal_damping(asked.case)?, ModalDamping::Uniform(ratio) if ratio > 0.0),
                },
                &system,
                &basis,
                &paths,
                &frequencies_hz,
            )?),
        };
        Ok(Self { asked, housing, band_hz, frequencies_hz, estimate, system, paths, superposition })
    }

    /// Places of forces and sensors on a condensed housing.
    ///
    /// # Errors
    /// None that [`ReducedPaths::build`] did not have.
    pub(crate) fn places(&self, stage: &CondensedHousing) -> Result<[Vec<Place>; 2], ComputeError> {
        let [from, to] = self.asked.ends();
        Ok([places(stage, from.into_iter())?, places(stage, to.into_iter())?])
    }

    /// Responses at ascending frequencies, Hz: sums of modes where damping does not couple them, which is exact and quick.
    ///
    /// # Errors
    /// [`ComputeError::Frf`].
    pub(crate) fn response(&self, frequencies_hz: &[f64]) -> Result<FrequencyResponse, ComputeError> {
        Ok(if self.superposition.coupling() <= UNCOUPLED {
            self.superposition.response(frequencies_hz)?
        } else {
            direct_response(&self.system, &self.paths, frequencies_hz)?
        })
    }

    /// The paths, sensor by sensor, with what carries them.
    ///
    /// # Errors
    /// [`ComputeError::Frf`].
    pub(crate) fn transfer_paths(&self) -> Result<Vec<TransferPath>, ComputeError> {
        let [from, to] = self.asked.ends();
        let mut paths = Vec::with_capacity(from.len() * to.len());
        for (sensor, (to, ..)) in to.iter().enumerate() {
            for (load, (from, ..)) in from.iter().enumerate() {
                let (band_hz, hz) = (self.band_hz, &self.frequencies_hz);
                let mut shares = self.superposition.shares(sensor, load, band_hz, hz)?;
                let closed = |all: &ResponseEstimate| all.closed((sensor, load)).is_some();
                if self.estimate.as_ref().is_some_and(closed) {
                    // shares of round-off
                    shares.modes.clear();
                }
                let parts = self.superposition.contributions(sensor, load, hz)?;
                let carried = shares.modes.iter().take(CARRIED).map(|share| CarriedPart {
                    frequency_hz: share.frequency_hz,
                    receptance: (0..hz.len()).map(|place| parts[(share.mode, place)]).collect(),
                });
                paths.push(TransferPath {
                    from: from.name().to_owned(),
                    to: to.name().to_owned(),
                    place: (sensor, load),
                    carried: carried.collect(),
                    shares,
                });
            }
        }
        Ok(paths)
    }
}

/// What `auto` begins with: the fixed-interface modes of the band, which resonate whatever is attached. The estimated error
/// of the responses says what else it needs.
fn first_choice(choice: BasisChoice, band_hz: f64) -> BasisChoice {
    match choice.size {
        BasisSize::Auto(_) => BasisChoice { size: BasisSize::UpTo(band_hz), enhanced: false, band_hz },
        _ => BasisChoice { band_hz, ..choice },
    }
}

/// Equal steps of the band, its resonances, and where the full model is solved.
fn frequencies(
    frf: &case::Frf,
    basis: &ModalBasis,
    superposition: &ModalSuperposition,
    band_hz: [f64; 2],
) -> Result<Vec<f64>, ComputeError> {
    let [low, high] = band_hz;
    let resonances: Vec<Resonance> = basis
        .frequencies_hz()
        .iter()
        .enumerate()
        .filter(|(_, hz)| **hz > 0.0 && **hz <= 1.1 * high)
        .map(|(mode, &frequency_hz)| Resonance { frequency_hz, ratio: superposition.ratio(mode).unwrap_or(0.0) })
        .collect();
    let grid = FrequencyGrid { band_hz, intervals: INTERVALS, points_a_bandwidth: 4, reach: 3.0 };
    let mut frequencies_hz = frequency_list(&grid, &resonances)?;
    let checked = frf.check_hz.iter().flatten().copied();
    frequencies_hz.extend(checked.filter(|hz| (low..=high).contains(hz)));
    frequencies_hz.sort_by(f64::total_cmp);
    frequencies_hz.dedup();
    Ok(frequencies_hz)
}

/// Housing and ring, with the case's damping.
fn system(case: &Case, housing: &FrfHousing) -> Result<ReducedSystem, ComputeError> {
    let element = housing.element();
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
    let attached = housing.attached();
    let k = with_ring(&element.stiffness, attached.map(|part| part.stiffness));
    let m = with_ring(&element.mass, attached.map(|part| part.mass));
    let viscous = viscous_matrix(case, &k, &m)?;
    let system = ReducedSystem::new(k, m)?.with_viscous(viscous)?;
    Ok(match &element.structural {
        Some(structural) => system.with_structural(structural.clone())?,
        None => system,
    })
}
