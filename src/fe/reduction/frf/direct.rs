//! Responses by a complex factorisation at each frequency, exact for any damping.

use super::error::{check_frequencies, unbounded};
use super::{FrequencyResponse, FrfError, FrfPaths, ReducedSystem};
use crate::numerics::linalg::{ComplexMatrix, complex_columns, complex_solve};
use faer::c64;
use rayon::prelude::*;
use std::f64::consts::TAU;

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
