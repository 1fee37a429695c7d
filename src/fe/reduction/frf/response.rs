//! Responses over frequency, as displacement, velocity or acceleration.
//!
//! Responses by a complex factorisation at each frequency, exact for any damping.

use super::error::{check_frequencies, unbounded};
use super::system::same;
use super::{FrfError, FrfPaths, ReducedSystem};
use crate::numerics::linalg::{ComplexMatrix, DenseMatrix, complex_columns, complex_solve};
use faer::c64;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// What a response is of: motion over force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrfQuantity {
    /// Displacement over force, m/N.
    Receptance,
    /// Velocity over force, `i w` times the receptance, m/(N s).
    Mobility,
    /// Acceleration over force, `-w^2` times the receptance, 1/kg.
    Accelerance,
}

impl FrfQuantity {
    /// Factor on the receptance at a frequency, 1, 1/s or 1/s^2.
    pub fn factor(self, frequency_hz: f64) -> c64 {
        let omega = TAU * frequency_hz;
        match self {
            Self::Receptance => c64::new(1.0, 0.0),
            Self::Mobility => c64::new(0.0, omega),
            Self::Accelerance => c64::new(-omega * omega, 0.0),
        }
    }
}

/// Receptances of all paths over frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyResponse {
    pub(super) frequencies_hz: Vec<f64>,
    pub(super) receptance: Vec<ComplexMatrix>,
    pub(super) uncertainty: Vec<f64>,
}

impl FrequencyResponse {
    /// A response from receptances [s x p] at each frequency, for data that come from elsewhere.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn new(frequencies_hz: Vec<f64>, receptance: Vec<ComplexMatrix>) -> Result<Self, FrfError> {
        super::error::check_frequencies(&frequencies_hz)?;
        same("number of receptances", frequencies_hz.len(), receptance.len())?;
        if let Some(first) = receptance.first() {
            for other in &receptance {
                same("sensors", first.nrows(), other.nrows())?;
                same("loads", first.ncols(), other.ncols())?;
            }
        }
        Ok(Self { uncertainty: vec![0.0; frequencies_hz.len()], frequencies_hz, receptance })
    }

    /// Frequencies, ascending, Hz.
    pub fn frequencies_hz(&self) -> &[f64] {
        &self.frequencies_hz
    }

    /// Receptances [s x p] at each frequency, m/N.
    pub fn receptance(&self) -> &[ComplexMatrix] {
        &self.receptance
    }

    /// Share of each frequency's response that round-off may have changed; 0 where it was not measured.
    pub fn uncertainty(&self) -> &[f64] {
        &self.uncertainty
    }

    /// One path over frequency.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn path(&self, sensor: usize, load: usize, quantity: FrfQuantity) -> Result<Vec<c64>, FrfError> {
        let (sensors, loads) = self.receptance.first().map_or((0, 0), |first| (first.nrows(), first.ncols()));
        check_path("sensor", sensor, sensors)?;
        check_path("load", load, loads)?;
        let values = self.frequencies_hz.iter().zip(&self.receptance);
        Ok(values.map(|(&hz, receptance)| quantity.factor(hz) * receptance[(sensor, load)]).collect())
    }

    /// Largest difference of each path to the same path in `other`, relative to the largest receptance of that path in
    /// `other` [s x p]; both over the same frequencies.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn largest_difference(&self, other: &Self) -> Result<DenseMatrix, FrfError> {
        same("number of frequencies", other.receptance.len(), self.receptance.len())?;
        let (sensors, loads) = other.receptance.first().map_or((0, 0), |first| (first.nrows(), first.ncols()));
        let mut differences = DenseMatrix::zeros(sensors, loads);
        for sensor in 0..sensors {
            for load in 0..loads {
                let own = self.path(sensor, load, FrfQuantity::Receptance)?;
                let reference = other.path(sensor, load, FrfQuantity::Receptance)?;
                let difference = own.iter().zip(&reference).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
                let largest = reference.iter().map(|b| b.norm()).fold(0.0, f64::max);
                differences[(sensor, load)] = if difference == 0.0 { 0.0 } else { difference / largest };
            }
        }
        Ok(differences)
    }
}

pub(super) fn check_path(what: &'static str, index: usize, count: usize) -> Result<(), FrfError> {
    if index < count { Ok(()) } else { Err(FrfError(format!("{what} {index} asked for, there are {count}"))) }
}

/// Share of a response that round-off may change before it is refused: four digits must be certain.
const LARGEST_UNCERTAINTY: f64 = 1e-4;

/// Receptances `sensors Z(w)^-1 loads` at ascending frequencies (Hz, >= 0). The frequencies are shared among threads;
/// what is computed for one does not depend on their number.
///
/// # Errors
/// [`FrfError`] at the lowest frequency at
/// which the system is singular.
pub fn direct_response(
    system: &ReducedSystem,
    paths: &FrfPaths,
    frequencies_hz: &[f64],
) -> Result<FrequencyResponse, FrfError> {
    system.check(paths)?;
    check_frequencies(frequencies_hz)?;
    let loads = complex_columns(&paths.loads);
    let sensors = complex_columns(&paths.sensors);
    let solved: Vec<Result<(ComplexMatrix, f64), FrfError>> = frequencies_hz
        .par_iter()
        .map(|&hz| {
            let found = complex_solve(&dynamic_stiffness(system, TAU * hz), &loads)?;
            if found.uncertainty > LARGEST_UNCERTAINTY {
                return Err(unbounded(hz));
            }
            Ok((&sensors * &found.x, found.uncertainty))
        })
        .collect();
    let solved: Vec<(ComplexMatrix, f64)> = solved.into_iter().collect::<Result<_, _>>()?;
    let (receptance, uncertainty) = solved.into_iter().unzip();
    Ok(FrequencyResponse { frequencies_hz: frequencies_hz.to_vec(), receptance, uncertainty })
}

/// `Z(w)` at w in rad/s.
fn dynamic_stiffness(system: &ReducedSystem, omega: f64) -> ComplexMatrix {
    let (k, m) = (system.stiffness(), system.mass());
    let (c, s) = (system.viscous(), system.structural());
    ComplexMatrix::from_fn(system.order(), system.order(), |row, column| {
        let entry = (row, column);
        let viscous = c.map_or(0.0, |c| omega * c[entry]);
        let structural = s.map_or(0.0, |s| s[entry]);
        c64::new(k[entry] - omega * omega * m[entry], viscous + structural)
    })
}
