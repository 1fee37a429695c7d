//! The reduced model on the paths of a case, with as many residual vectors as its responses need.

use super::{CarriedPart, TransferPath};
use crate::case::{self, Case};
use crate::linalg::DenseMatrix;
use crate::reduction::frf::{
    FrequencyGrid, FrequencyResponse, FrfPaths, ModalBasis, ModalDamping, ModalSuperposition,
    ReducedSystem, Resonance, direct_response, frequency_list,
};
use crate::reduction::{BasisChoice, BasisSize, ResponseEstimate};
use crate::stages::condensed::{CondensedStage, basis_choice};
use crate::stages::damping::viscous_matrix;
use crate::stages::places::{Place, PlaceBodies};
use crate::stages::{StageError, Watch};

/// Equal intervals of the band in which the response is computed, beside its resonances.
const INTERVALS: usize = 400;

/// Part of the target that the estimated error may use: an estimate of first order may be a few per cent too small.
const MARGIN: f64 = 0.8;

/// How often residual vectors are added.
const ENLARGEMENTS: usize = 60;

/// Modes of which the contribution is kept over frequency.
const CARRIED: usize = 4;

/// Coupling of modes by damping that is round-off: Rayleigh damping of a ring of beams leaves 1e-13.
const UNCOUPLED: f64 = 1e-10;

/// The case's damping is in the system's matrices already.
const NO_MORE: ModalDamping = ModalDamping::Uniform(0.0);

/// A condensed housing, with its ring, on the paths of a case.
pub(super) struct ReducedPaths {
    pub stage: CondensedStage,
    /// Where forces act, where motions are read.
    pub places: [Vec<Place>; 2],
    system: ReducedSystem,
    paths: FrfPaths,
    pub band_hz: [f64; 2],
    pub frequencies_hz: Vec<f64>,
    pub estimate: ResponseEstimate,
    names: [Vec<String>; 2],
    superposition: ModalSuperposition,
}

impl ReducedPaths {
    /// Condenses the housing of a case for its paths.
    ///
    /// # Errors
    /// [`StageError`] of the stages that it goes through.
    pub fn build(case: &Case, asked: &case::Frf, watch: &impl Watch) -> Result<Self, StageError> {
        let choice = basis_choice(case);
        let band_hz = asked
            .band_hz
            .or(case.band_hz())
            .unwrap_or([0.0, choice.band_hz]);
        let stage = CondensedStage::with_basis(case, first_choice(choice, band_hz[1]), watch)?
            .ok_or(StageError::NothingToCondense)?;
        let sensors = sensors(case, asked);
        let pushes = asked.from.iter();
        let pushes = pushes.map(|push| (&*push.name, &push.spot, push.direction));
        let seen = sensors.iter();
        let seen = seen.map(|sensor| (&*sensor.name, &sensor.spot, sensor.direction));
        let names = [
            pushes.clone().map(|(name, ..)| name.to_owned()).collect(),
            seen.clone().map(|(name, ..)| name.to_owned()).collect(),
        ];
        let places = [placed(&stage, pushes)?, placed(&stage, seen)?];
        // static response to every force and, as the path back is the same, to a force at every sensor
        let dof = stage.housing.model.dof();
        let all: Vec<Vec<f64>> = places
            .iter()
            .flatten()
            .map(|at| at.on_housing(dof))
            .collect();
        let loads = DenseMatrix::from_fn(dof, all.len(), |row, column| all[column][row]);
        let mut reduced = Self::of(
            case,
            asked,
            stage.with_loads(&loads)?,
            places,
            names,
            band_hz,
        )?;
        if let BasisSize::Auto(target) = choice.size {
            watch.stage("basis for the responses");
            for _ in 0..ENLARGEMENTS {
                if reduced.largest_error() <= MARGIN * target {
                    break;
                }
                let stage = reduced
                    .stage
                    .with_forces(reduced.estimate.forces().clone())?;
                let Self { places, names, .. } = reduced;
                reduced = Self::of(case, asked, stage, places, names, band_hz)?;
            }
        }
        Ok(reduced)
    }

    fn of(
        case: &Case,
        asked: &case::Frf,
        stage: CondensedStage,
        places: [Vec<Place>; 2],
        names: [Vec<String>; 2],
        band_hz: [f64; 2],
    ) -> Result<Self, StageError> {
        let system = system(case, &stage)?;
        let basis = ModalBasis::new(&system)?;
        let order = system.order();
        let [from, to] = places.each_ref().map(|places| {
            places
                .iter()
                .map(|at| at.reduced(&stage.condensed))
                .collect::<Vec<_>>()
        });
        let paths = FrfPaths {
            loads: DenseMatrix::from_fn(order, from.len(), |row, load| from[load][row]),
            sensors: DenseMatrix::from_fn(to.len(), order, |sensor, row| to[sensor][row]),
        };
        let kept = basis.frequencies_hz().len();
        let superposition = ModalSuperposition::new(&system, &basis, &paths, kept, &NO_MORE)?;
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
        let mut frequencies_hz = frequency_list(&grid, &resonances)?;
        let [low, high] = band_hz;
        let checked = asked.check_hz.iter().flatten().copied();
        frequencies_hz.extend(checked.filter(|hz| (low..=high).contains(hz)));
        frequencies_hz.sort_by(f64::total_cmp);
        frequencies_hz.dedup();
        let estimate = ResponseEstimate::new(
            &stage.condensed,
            stage.structural.as_ref(),
            &system,
            &basis,
            &paths,
            &frequencies_hz,
        )?;
        Ok(Self {
            stage,
            places,
            system,
            paths,
            band_hz,
            frequencies_hz,
            estimate,
            names,
            superposition,
        })
    }

    fn largest_error(&self) -> f64 {
        self.estimate.largest().map_or(0.0, |(_, error)| error)
    }

    /// Responses at ascending frequencies, Hz: sums of modes where damping does not couple them, which is exact and quick.
    ///
    /// # Errors
    /// [`StageError::Frf`].
    pub fn response(&self, frequencies_hz: &[f64]) -> Result<FrequencyResponse, StageError> {
        Ok(if self.superposition.coupling() <= UNCOUPLED {
            self.superposition.response(frequencies_hz)?
        } else {
            direct_response(&self.system, &self.paths, frequencies_hz)?
        })
    }

    /// The paths, sensor by sensor, with what carries them.
    ///
    /// # Errors
    /// [`StageError::Frf`].
    pub fn transfer_paths(&self) -> Result<Vec<TransferPath>, StageError> {
        let [from, to] = &self.names;
        let mut paths = Vec::with_capacity(from.len() * to.len());
        for (sensor, to) in to.iter().enumerate() {
            for (load, from) in from.iter().enumerate() {
                let (band_hz, hz) = (self.band_hz, &self.frequencies_hz);
                let shares = self.superposition.shares(sensor, load, band_hz, hz)?;
                let parts = self.superposition.contributions(sensor, load, hz)?;
                let carried = shares.modes.iter().take(CARRIED).map(|share| CarriedPart {
                    frequency_hz: share.frequency_hz,
                    receptance: (0..hz.len())
                        .map(|place| parts[(share.mode, place)])
                        .collect(),
                });
                paths.push(TransferPath {
                    from: from.clone(),
                    to: to.clone(),
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
        BasisSize::Auto(_) => BasisChoice {
            size: BasisSize::UpTo(band_hz),
            enhanced: false,
            band_hz,
        },
        _ => BasisChoice { band_hz, ..choice },
    }
}

/// Sensors of the paths: those named, or all.
fn sensors<'c>(case: &'c Case, asked: &case::Frf) -> Vec<&'c case::Sensor> {
    let named = |sensor: &&case::Sensor| asked.to.is_empty() || asked.to.contains(&sensor.name);
    case.sensors.iter().filter(named).collect()
}

fn placed<'c>(
    stage: &CondensedStage,
    spots: impl Iterator<Item = (&'c str, &'c case::SensorSpot, [f64; 3])>,
) -> Result<Vec<Place>, StageError> {
    let ring = stage.boundary.ring();
    let bodies = PlaceBodies {
        housing: Some(&stage.housing),
        ring: ring.map(|(ring, _)| ring),
        tie: ring.map(|(_, tie)| tie),
        frame: *stage.housing.model.frame(),
    };
    spots
        .map(|(name, spot, direction)| Place::new(bodies, name, spot, direction))
        .collect()
}

/// Housing and ring, with the case's damping.
fn system(case: &Case, stage: &CondensedStage) -> Result<ReducedSystem, StageError> {
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
    let system = ReducedSystem::new(k, m)?.with_viscous(viscous)?;
    Ok(match &element.structural {
        Some(structural) => system.with_structural(structural.clone())?,
        None => system,
    })
}
