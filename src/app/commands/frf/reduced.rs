//! The reduced model on the paths of a case, with as many residual vectors as its responses need.

use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::app::scene::condensed::basis_choice;
use crate::app::scene::damping::{damping, mass_damping, viscous_matrix};
use crate::app::scene::places::{Place, Spot};
use crate::app::scene::{CondensedHousing, ImportedHousing};
use crate::fe::model::Rings;
use crate::fe::reduction::frf::{
    FrequencyGrid, FrequencyResponse, FrfPaths, ModalBasis, ModalDamping, ModalSuperposition, PathShares,
    ReducedSystem, Resonance, direct_response, frequency_list,
};
use crate::fe::reduction::{
    Attached, BasisChoice, BasisSize, InteriorDamping, ResponseEstimate, Superelement, UNCOUPLED,
};
use crate::numerics::Watch;
use crate::numerics::linalg::DenseMatrix;
use faer::c64;

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

/// A housing and the ring in it.
#[derive(Debug, Clone)]
pub enum FrfHousing {
    /// Condensed from a mesh.
    Mesh(Box<CondensedHousing>),
    /// From a file, with the rings that fit it. What it lacks is not known.
    File(Box<(ImportedHousing, Rings)>),
}

impl FrfHousing {
    /// Its matrices.
    pub(crate) fn element(&self) -> &Superelement {
        match self {
            Self::Mesh(stage) => &stage.condensed.superelement,
            Self::File(imported) => &imported.0.element,
        }
    }

    /// What sits on its interface.
    fn attached(&self) -> Option<Attached<'_>> {
        match self {
            Self::Mesh(stage) => stage.boundary.attached(),
            Self::File(imported) => Some(Attached { stiffness: imported.1.stiffness(), mass: imported.1.mass() }),
        }
    }

    /// Rows of some places over its coordinates, one \[order\] for each.
    ///
    /// # Errors
    /// [`ComputeError`] for a place that is not there.
    fn rows(&self, spots: &[Spot<'_>]) -> Result<Vec<Vec<f64>>, ComputeError> {
        match self {
            Self::Mesh(stage) => Ok(places(stage, spots)?.iter().map(|at| at.reduced(&stage.condensed)).collect()),
            Self::File(imported) => spots.iter().map(|&spot| imported.0.row(spot, &imported.1)).collect(),
        }
    }
}

/// Places on housing and ring.
///
/// # Errors
/// [`ComputeError`] for a place that is not there.
pub(crate) fn places(stage: &CondensedHousing, spots: &[Spot<'_>]) -> Result<Vec<Place>, ComputeError> {
    spots.iter().map(|&spot| Place::new(stage.bodies(), spot)).collect()
}

/// The forces of a case, then its sensors: those named, or all.
fn ends<'c>(case: &'c Case, frf: &'c case::Frf) -> [Vec<Spot<'c>>; 2] {
    let named = |sensor: &&case::Sensor| frf.to.is_empty() || frf.to.contains(&sensor.name);
    [frf.from.iter().map(Spot::from).collect(), case.sensors.iter().filter(named).map(Spot::from).collect()]
}

/// A condensed housing, with its ring, on the paths of a case.
pub(crate) struct ReducedPaths<'c> {
    /// The forces, then the sensors.
    pub ends: [Vec<Spot<'c>>; 2],
    pub housing: FrfHousing,
    pub band_hz: [f64; 2],
    pub frequencies_hz: Vec<f64>,
    /// None of a housing of which no mesh is known.
    pub estimate: Option<ResponseEstimate>,
    system: ReducedSystem,
    paths: FrfPaths,
    superposition: ModalSuperposition,
}

/// What one mode carries of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct CarriedPart {
    /// Its natural frequency, Hz.
    pub frequency_hz: f64,
    /// Its part of the receptance over the frequencies of the response, m/N.
    pub receptance: Vec<c64>,
}

/// A path from a force to a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct TransferPath {
    /// Name of the force.
    pub from: String,
    /// Name of the sensor.
    pub to: String,
    /// Which sensor and which load of the response.
    pub place: (usize, usize),
    /// What carries it in the band.
    pub shares: PathShares,
    /// The few modes with the largest shares, over frequency.
    pub carried: Vec<CarriedPart>,
}

impl TransferPath {
    /// What is said of a path that carries next to nothing.
    pub const CLOSED: &str = "carries less than 1e-7 of the responses at its ends, by symmetry or between bodies that hardly touch; no error is estimated there";

    /// Whether its responses are so small beside those at its ends that no mode is said to carry it.
    pub(crate) fn is_closed(&self) -> bool {
        self.shares.modes.is_empty()
    }
}

impl<'c> ReducedPaths<'c> {
    /// Condenses the housing of a case for its paths, or reads it.
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub(crate) fn build(case: &'c Case, frf: &'c case::Frf, watch: &impl Watch) -> Result<Self, ComputeError> {
        let choice = basis_choice(case);
        let band_hz = frf.band_hz.unwrap_or(case.band_or_default());
        if let Some(path) = case.superelement() {
            watch.stage("read");
            let file = ImportedHousing::read(case, path)?;
            file.0.accept()?;
            return Self::of(case, frf, FrfHousing::File(Box::new(file)), band_hz);
        }
        let first = match choice.size {
            // the fixed-interface modes of the band, which resonate whatever is attached: the estimated error says what else is needed
            BasisSize::Auto(_) => {
                BasisChoice { size: BasisSize::UpTo(band_hz[1]), enhanced: false, band_hz: band_hz[1] }
            }
            _ => BasisChoice { band_hz: band_hz[1], ..choice },
        };
        let stage = CondensedHousing::with_basis(case, first, watch)?.ok_or(ComputeError::NothingToCondense)?;
        // static response to every force and, as the path back is the same, to a force at every sensor
        let places = places(&stage, &ends(case, frf).concat())?;
        let dof = stage.housing.model.dof();
        let all: Vec<Vec<f64>> = places.iter().map(|at| at.on_housing(dof)).collect();
        let loads = DenseMatrix::from_fn(dof, all.len(), |row, column| all[column][row]);
        let meshed = |stage| FrfHousing::Mesh(Box::new(stage));
        let mut reduced = Self::of(case, frf, meshed(stage.with_loads(&loads)?), band_hz)?;
        if let BasisSize::Auto(target) = choice.size {
            watch.stage("basis for the responses");
            let mut order = 0;
            for _ in 0..ENLARGEMENTS {
                let grown = std::mem::replace(&mut order, reduced.system.order()) < order;
                let error = reduced.estimate.as_ref().and_then(ResponseEstimate::largest);
                let too_large = error.is_some_and(|(_, error)| error > MARGIN * target);
                match (reduced.housing, &reduced.estimate) {
                    (FrfHousing::Mesh(stage), Some(estimate)) if grown && too_large => {
                        let stage = stage.with_forces(estimate.forces.clone())?;
                        reduced = Self::of(case, frf, meshed(stage), band_hz)?;
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

    fn of(case: &'c Case, frf: &'c case::Frf, housing: FrfHousing, band_hz: [f64; 2]) -> Result<Self, ComputeError> {
        let system = system(case, &housing)?;
        let basis = ModalBasis::new(&system)?;
        let order = system.order();
        let ends = ends(case, frf);
        let (from, to) = (housing.rows(&ends[0])?, housing.rows(&ends[1])?);
        let paths = FrfPaths {
            loads: DenseMatrix::from_fn(order, from.len(), |row, load| from[load][row]),
            sensors: DenseMatrix::from_fn(to.len(), order, |sensor, row| to[sensor][row]),
        };
        let kept = basis.frequencies_hz().len();
        let superposition = ModalSuperposition::new(&system, &basis, &paths, kept, &NO_MORE)?;
        let frequencies_hz = frequencies(frf, &basis, &superposition, band_hz)?;
        let estimate = match &housing {
            FrfHousing::File(_) => None,
            FrfHousing::Mesh(stage) => Some(ResponseEstimate::new(
                &stage.condensed,
                InteriorDamping {
                    structural: stage.structural.as_ref(),
                    mass: mass_damping(case)?,
                    ratio: match damping(case)? {
                        ModalDamping::Uniform(ratio) => ratio,
                        _ => 0.0,
                    },
                },
                &system,
                &basis,
                &paths,
                &frequencies_hz,
            )?),
        };
        Ok(Self { ends, housing, band_hz, frequencies_hz, estimate, system, paths, superposition })
    }

    /// Responses at ascending frequencies, Hz: sums of modes where damping does not couple them, which is exact and quick.
    ///
    /// # Errors
    /// [`ComputeError::Frf`].
    pub(crate) fn response(&self, frequencies_hz: &[f64]) -> Result<FrequencyResponse, ComputeError> {
        Ok(if self.superposition.coupling <= UNCOUPLED {
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
        let [from, to] = &self.ends;
        let mut paths = Vec::with_capacity(from.len() * to.len());
        for (sensor, to) in to.iter().enumerate() {
            for (load, from) in from.iter().enumerate() {
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
                    from: from.name.to_owned(),
                    to: to.name.to_owned(),
                    place: (sensor, load),
                    carried: carried.collect(),
                    shares,
                });
            }
        }
        Ok(paths)
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
    // the ring's coordinates come first
    let with_ring = |own: &DenseMatrix, ring: Option<&DenseMatrix>| {
        let mut sum = own.clone();
        if let Some(ring) = ring {
            let mut part = sum.submatrix_mut(0, 0, ring.nrows(), ring.ncols());
            part += ring;
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
