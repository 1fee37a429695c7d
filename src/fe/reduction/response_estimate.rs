//! How far the forced response of a condensed housing is from that of the full one, without the full solution.
//!
//! A response read at a sensor misses `z^T r`, r being what the response lacks in the interior's equations and z what a
//! unit force at the sensor does to the full model. The reduced response to that force has nothing to do with r (Galerkin),
//! so what it lacks itself counts, and the error is a product of two residuals (Becker and Rannacher, Acta Numerica 10
//! (2001) 1-102): see [`ResidualFlexibility`]. Relative to the response where it is read, it is largest beside zeros.

use super::frf::{
    FrequencyResponse, FrfError, FrfPaths, ModalBasis, ModalDamping, ModalSuperposition, ReducedSystem, direct_response,
};
use super::interior_basis::interior_inertia;
use super::parts::normalised;
use super::residual_flexibility::ResidualFlexibility;
use super::{CraigBampton, ReductionError};
use crate::numerics::linalg::{ComplexMatrix, DenseMatrix, SparseMatrix, sparse_times_dense};
use faer::c64;
use std::f64::consts::TAU;

/// Modes up to so many times the highest frequency take part with their resonance, those above as statics: what that
/// neglects of the estimate is the square of the inverse.
const RESONANT: f64 = 4.0;

/// Coupling of modes by damping that is round-off, as of Rayleigh damping. Where it is more the amplitudes come from the coupled system: parts of loss
/// factors 0.002 and 0.2 made errors 19 times as large as an estimate without coupling.
pub(crate) const UNCOUPLED: f64 = 1e-10;

/// Directions of new vectors that are dropped as dependent: squared length, relative to the longest.
const DEPENDENT: f64 = 1e-12;

/// What ratios of modes change from the reduced to the full model, over what they change to a larger one. They act on all modes up to the
/// highest, and each block of vectors shows what the one before lacks of it: 1.21 and 1.44 were measured with one block.
const FURTHER: f64 = 1.5;

/// Response beside the geometric mean of those at its two ends, below which there is no path but round-off.
const NO_PATH: f64 = 1e-10;

/// The same for all of a band: what condensing leaves of a path that symmetry closes.
const CLOSED: f64 = 1e-7;

/// Estimated errors of responses over frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseEstimate {
    /// Hz.
    pub frequencies_hz: Vec<f64>,
    /// At each frequency the largest `|H~ - H| / |H|` of the paths, H~ of the reduced model and H of the full one.
    pub relative_errors: Vec<f64>,
    /// Paths that carry nothing, [sensor x load]: the largest response at their ends, m/N; 0 for the others.
    closed: DenseMatrix,
    worst: Option<usize>,
    /// What the interior needs beyond the reduced model where it lacks most [interior x k]: inertia, and losses if
    /// there are any, of the responses to the load and to a unit force at the sensor. With its static response in the basis
    /// the error there is squared away.
    pub(crate) forces: DenseMatrix,
}

/// The damping of a case as far as the interior feels it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InteriorDamping<'a> {
    /// Imaginary part of the stiffness of the housing's lossy parts over its degrees of freedom, N/m.
    pub structural: Option<&'a SparseMatrix>,
    /// Alpha of `C = alpha M`, 1/s.
    pub mass: f64,
    /// The ratio of every mode; zero for damping that is not by modes.
    pub ratio: f64,
}

impl ResponseEstimate {
    /// Estimates the errors on `paths` of a condensed housing in a system, whose coordinates begin with those of the
    /// superelement, at ascending frequencies. What mass damping takes of the interior adds to inertia, `(w^2 - i w alpha) M x`.
    /// Damping in proportion to stiffness leaves nothing in the interior that statics lack.
    ///
    /// # Errors
    /// What [`ModalSuperposition`] refuses.
    pub fn new(
        condensed: &CraigBampton,
        damping: InteriorDamping<'_>,
        system: &ReducedSystem,
        modes: &ModalBasis,
        paths: &FrfPaths,
        frequencies_hz: &[f64],
    ) -> Result<Self, ReductionError> {
        let ends = Ends::new(system, modes, paths, frequencies_hz)?;
        let inertia = interior_inertia(&condensed.substructure, &condensed.basis, &ends.motions);
        let loss = |matrix: &SparseMatrix| {
            condensed.interior_of(&sparse_times_dense(matrix, &condensed.field(&ends.motions, matrix.rows())))
        };
        let losses = damping.structural.map(loss);
        let forces = beside(&inertia, losses.as_ref());
        let (substructure, basis) = (&condensed.substructure, &condensed.basis);
        let flexibility = ResidualFlexibility::new(substructure, basis, forces.clone())?;
        let inertial = |hz: f64| c64::new((TAU * hz).powi(2), -TAU * hz * damping.mass);
        let residual = |place: usize, end: usize| -> Vec<c64> {
            let squared = inertial(frequencies_hz[place]);
            let amplitudes = ends.amplitudes(place, end);
            let lossy = losses.iter().flat_map(|_| &amplitudes);
            let lossy = lossy.map(|amplitude| -c64::i() * amplitude);
            let moving = amplitudes.iter().map(|amplitude| amplitude * squared);
            moving.chain(lossy).collect()
        };
        let loads = paths.loads.ncols();
        let closed = DenseMatrix::from_fn(paths.sensors.nrows(), loads, |sensor, load| {
            ends.closed(load, loads + sensor).unwrap_or(0.0)
        });
        let larger = if damping.ratio > 0.0 {
            Some(ends.larger(condensed, damping, system, &flexibility, frequencies_hz)?)
        } else {
            None
        };
        let mut worst = (0.0, None);
        let mut relative_errors = Vec::with_capacity(frequencies_hz.len());
        for (place, &hz) in frequencies_hz.iter().enumerate() {
            let mut largest = 0.0;
            for load in 0..loads {
                let pushed = residual(place, load);
                for sensor in loads..ends.count() {
                    if closed[(sensor - loads, load)] > 0.0 {
                        continue;
                    }
                    let pulled = residual(place, sensor);
                    let lacks = flexibility.missing(inertial(hz).norm(), &pushed, &pulled);
                    let by_ratio = larger.as_ref().map_or(c64::new(0.0, 0.0), |larger| {
                        larger[place][(sensor, load)] - ends.receptance[place][(sensor, load)] - lacks
                    });
                    let ratios = FURTHER * by_ratio.norm();
                    let relative = (lacks.norm() + ratios) / ends.level(place, load, sensor);
                    largest = f64::max(largest, relative);
                    if relative > worst.0 {
                        worst = (relative, Some((place, [load, sensor], ratios > lacks.norm())));
                    }
                }
            }
            relative_errors.push(largest);
        }
        let forces = match worst.1 {
            Some((place, path, by_ratio)) => {
                let mut amplitudes = ends.in_phase(place, path);
                if by_ratio {
                    // modes far above the band, which their statics alone know
                    let statics = path.map(|end| ends.modes + end);
                    let statics = DenseMatrix::from_fn(amplitudes.nrows(), 2, |row, column| {
                        f64::from(u8::from(row == statics[column]))
                    });
                    amplitudes = faer::concat![[amplitudes, statics]];
                }
                let losses = losses.map(|losses| losses * &amplitudes);
                beside(&(inertia * &amplitudes), losses.as_ref())
            }
            None => DenseMatrix::zeros(forces.nrows(), 0),
        };
        Ok(Self {
            frequencies_hz: frequencies_hz.to_vec(),
            relative_errors,
            closed,
            worst: worst.1.map(|(place, ..)| place),
            forces,
        })
    }

    /// The largest of all, and where; none without a response.
    pub(crate) fn largest(&self) -> Option<(f64, f64)> {
        let worst = self.worst?;
        Some((self.frequencies_hz[worst], self.relative_errors[worst]))
    }

    /// The largest response at the ends of a path, sensor and load, that carries nothing; `None` for one that does.
    pub(crate) fn closed(&self, path: (usize, usize)) -> Option<f64> {
        Some(self.closed[path]).filter(|ends| *ends > 0.0)
    }

    /// The estimate at one of its frequencies.
    pub(crate) fn at(&self, hz: f64) -> Option<f64> {
        let frequencies = self.frequencies_hz.iter();
        let place = frequencies.map(|own| own.to_bits()).position(|own| own == hz.to_bits())?;
        self.relative_errors.get(place).copied()
    }
}

/// Columns of one matrix, then those of another.
fn beside(first: &DenseMatrix, second: Option<&DenseMatrix>) -> DenseMatrix {
    second.map_or_else(|| first.clone(), |second| faer::concat![[first, second]])
}

/// Responses to forces at both ends of all paths: loads first, then sensors.
struct Ends {
    /// Modes, and the statics of the rest for each end [order x (modes + ends)].
    motions: DenseMatrix,
    modes: usize,
    /// Amplitudes of the modes [modes x ends] at each frequency.
    amplitudes: FrequencyResponse,
    /// Receptances between the ends [ends x ends] at each frequency.
    receptance: Vec<ComplexMatrix>,
    /// The unit forces [order x ends].
    forces: DenseMatrix,
}

impl Ends {
    fn new(
        system: &ReducedSystem,
        basis: &ModalBasis,
        paths: &FrfPaths,
        frequencies_hz: &[f64],
    ) -> Result<Self, FrfError> {
        let order = system.order();
        let forces = faer::concat![[paths.loads, paths.sensors.transpose()]];
        let top = frequencies_hz.last().copied().unwrap_or(0.0);
        let modes = basis.frequencies_hz().partition_point(|hz| *hz <= RESONANT * top);
        let superposition = |sensors: DenseMatrix, kept: usize| {
            let paths = FrfPaths { loads: forces.clone(), sensors };
            ModalSuperposition::new(system, basis, &paths, kept, &ModalDamping::Uniform(0.0))
        };
        let shapes = basis.shapes.subcols(0, modes);
        // Phi^T m picks the amplitudes of the modes
        let picked = (shapes.transpose() * system.mass()).to_owned();
        let amplitudes = superposition(picked.clone(), modes)?;
        let statics = superposition(DenseMatrix::identity(order, order), modes)?;
        let between = superposition(forces.transpose().to_owned(), basis.frequencies_hz().len())?;
        let response = |alone: &ModalSuperposition, sensors: DenseMatrix| {
            if between.coupling <= UNCOUPLED {
                return alone.response(frequencies_hz);
            }
            direct_response(system, &FrfPaths { loads: forces.clone(), sensors }, frequencies_hz)
        };
        let receptance = response(&between, forces.transpose().to_owned())?;
        let amplitudes = response(&amplitudes, picked)?;
        Ok(Self {
            motions: faer::concat![[shapes, statics.residual]],
            modes,
            amplitudes,
            receptance: receptance.receptance().to_vec(),
            forces,
        })
    }

    /// Receptances [ends x ends] at each frequency of a larger model with its own ratio for every mode. It has W of the
    /// residual flexibility beside the basis, to which W is orthogonal in stiffness; statics of the forces are in the basis, so
    /// that they do no work on W.
    fn larger(
        &self,
        condensed: &CraigBampton,
        damping: InteriorDamping<'_>,
        system: &ReducedSystem,
        further: &ResidualFlexibility,
        frequencies_hz: &[f64],
    ) -> Result<Vec<ComplexMatrix>, ReductionError> {
        let turned = normalised(&further.inertia, DEPENDENT)?;
        let moved = &further.moved * &turned;
        let (order, more) = (system.order(), moved.ncols());
        let with = |own: &DenseMatrix, beside: DenseMatrix, corner: DenseMatrix| {
            faer::concat![[own, beside], [beside.transpose(), corner]]
        };
        let inertia = condensed.substructure.interior.mass_times(&moved);
        let coupling = faer::concat![
            [condensed.substructure.follow_transposed(&moved)],
            [condensed.basis.vectors.transpose() * &inertia]
        ];
        let stiffness = with(
            system.stiffness(),
            DenseMatrix::zeros(order, more),
            turned.transpose() * &further.flexibility * &turned,
        );
        let mass = with(system.mass(), coupling, moved.transpose() * &inertia);
        let mut larger = ReducedSystem::new(stiffness, mass)?;
        if let (Some(matrix), Some(own)) = (damping.structural, system.structural()) {
            let forces = sparse_times_dense(matrix, &condensed.interior_field(&moved, matrix.rows()));
            let corner = moved.transpose() * condensed.interior_of(&forces);
            larger = larger.with_structural(with(own, condensed.project(&forces), corner))?;
        }
        let modes = ModalBasis::new(&larger)?;
        let viscous = modes.viscous_matrix(&larger, &ModalDamping::Uniform(damping.ratio))?;
        let larger = larger.with_viscous(viscous)?;
        let forces = faer::concat![[self.forces], [DenseMatrix::zeros(more, self.forces.ncols())]];
        let paths = FrfPaths { sensors: forces.transpose().to_owned(), loads: forces };
        let count = modes.frequencies_hz().len();
        let between = ModalSuperposition::new(&larger, &modes, &paths, count, &ModalDamping::Uniform(0.0))?;
        let response = if between.coupling <= UNCOUPLED {
            between.response(frequencies_hz)?
        } else {
            direct_response(&larger, &paths, frequencies_hz)?
        };
        Ok(response.receptance().to_vec())
    }

    fn count(&self) -> usize {
        self.motions.ncols() - self.modes
    }

    /// Amplitudes of the motions under a unit force at an end.
    fn amplitudes(&self, place: usize, end: usize) -> Vec<c64> {
        let of_modes = self.amplitudes.receptance()[place].col(end);
        let statics = (0..self.count()).map(|other| c64::new(f64::from(u8::from(other == end)), 0.0));
        of_modes.iter().copied().chain(statics).collect()
    }

    /// What an error is relative to; infinite where there is no path.
    fn level(&self, place: usize, load: usize, sensor: usize) -> f64 {
        let between = &self.receptance[place];
        let level = between[(sensor, load)].norm();
        let ends = between[(load, load)].norm() * between[(sensor, sensor)].norm();
        if level > NO_PATH * ends.sqrt() { level } else { f64::INFINITY }
    }

    /// The largest response at both ends of a path that carries nothing; `None` for one that does.
    fn closed(&self, load: usize, sensor: usize) -> Option<f64> {
        let (mut level, mut ends) = (0.0_f64, 0.0_f64);
        for between in &self.receptance {
            let both = between[(load, load)].norm() * between[(sensor, sensor)].norm();
            level = level.max(between[(sensor, load)].norm());
            ends = ends.max(both.sqrt());
        }
        (level <= CLOSED * ends).then_some(ends)
    }

    /// Amplitudes of the motions under forces at some ends, each turned to the phase in which most of it moves
    /// [motions x ends].
    fn in_phase(&self, place: usize, ends: [usize; 2]) -> DenseMatrix {
        let turned = ends.map(|end| {
            let amplitudes = self.amplitudes(place, end);
            let modes = &amplitudes[..self.modes];
            let squares: c64 = modes.iter().map(|amplitude| amplitude * amplitude).sum();
            let turn = c64::from_polar(1.0, -0.5 * squares.arg());
            amplitudes.iter().map(|amplitude| (amplitude * turn).re).collect::<Vec<f64>>()
        });
        DenseMatrix::from_fn(self.motions.ncols(), ends.len(), |row, end| turned[end][row])
    }
}

#[cfg(test)]
#[path = "response_estimate_tests.rs"]
mod tests;
