//! Every method as a [`Stepper`], made for a system and its steps.

use super::adams::Adams;
use super::dop853::Dop853;
use super::error::require;
use super::implicit::{Family, Implicit};
use super::propagator::OneEvaluation;
use super::{LEAST_TOLERANCE, Method, Schedule, SecondOrderSystem, Stepper, TransientError};
use std::f64::consts::TAU;

/// The method ready to go from `start` (s) with the schedule's steps.
pub(super) fn stepper<S: SecondOrderSystem>(
    system: &S,
    method: Method,
    schedule: &Schedule,
    start: f64,
) -> Result<Box<dyn Stepper<S>>, TransientError> {
    let h = schedule.step();
    Ok(match method {
        Method::ExponentialAdams { tolerance } => {
            tolerance.map_or(Ok(()), check_tolerance)?;
            Box::new(Adams::new(system, h, tolerance))
        }
        Method::Exponential | Method::Splitting => Box::new(OneEvaluation::new(system, method, h)),
        Method::Newmark => Box::new(Implicit::new(system, h, Family::AVERAGE_ACCELERATION)),
        Method::GeneralizedAlpha { spectral_radius } => {
            require((0.0..=1.0).contains(&spectral_radius), "spectral radius", spectral_radius, "from 0 to 1")?;
            Box::new(Implicit::new(system, h, Family::generalized_alpha(spectral_radius)))
        }
        Method::Dop853 { tolerance, events } => {
            check_tolerance(tolerance)?;
            Box::new(Dop853::new(system, start, tolerance, events))
        }
        Method::NewmarkExplicit => {
            check_stability(system, h)?;
            Box::new(OneEvaluation::new(system, method, h))
        }
    })
}

fn check_tolerance(tolerance: f64) -> Result<(), TransientError> {
    require((LEAST_TOLERANCE..1.0).contains(&tolerance), "tolerance", tolerance, "at least 1e-14 and below 1")
}

fn check_stability(system: &impl SecondOrderSystem, h: f64) -> Result<(), TransientError> {
    let highest = system.linear().iter().map(|coordinate| coordinate.squared_frequency).fold(0.0, f64::max).sqrt();
    if h * highest < 2.0 {
        return Ok(());
    }
    Err(TransientError::Unstable { step_s: h, limit_s: 2.0 / highest, highest_hz: highest / TAU })
}
