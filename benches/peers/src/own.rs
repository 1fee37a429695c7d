//! plummer's own methods.

use crate::Run;
use crate::equations::Equations;
use plummer::numerics::ode::{Instant, NoRecord, Observer};
use plummer::numerics::ode::{Method, Schedule, Stepping, integrate};
use std::error::Error;

/// Coordinates and velocities of every sample.
struct States(Vec<f64>);

impl<S> Observer<S> for States {
    fn observe(&mut self, _system: &S, now: Instant<'_>) {
        self.0.extend_from_slice(now.y);
        self.0.extend_from_slice(now.v);
    }
}

/// A method by its name in case files; without a tolerance equal steps.
pub fn method(name: &str, tolerance: Option<f64>) -> Result<Method, Box<dyn Error>> {
    Ok(match (name, tolerance) {
        ("exponential-adams", tolerance) => Method::ExponentialAdams { tolerance },
        ("exponential", None) => Method::Exponential,
        ("newmark", None) => Method::Newmark,
        ("dop853", Some(tolerance)) => Method::Dop853 { tolerance, events: true },
        _ => return Err(format!("no method `{name}` with tolerance {tolerance:?}").into()),
    })
}

/// Runs from rest with samples at most `step` (s) apart, which divide `interval`.
pub fn run(
    equations: &mut Equations,
    method: Method,
    seconds: f64,
    interval: f64,
    step: f64,
    keep: bool,
) -> Result<Run, Box<dyn Error>> {
    let schedule = Schedule::covering(seconds, interval, step)?;
    let mut state = equations.rest().clone();
    let go_on = |_, _| Stepping::Continue;
    let system = equations.system_mut();
    let mut states = States(Vec::new());
    let clock = std::time::Instant::now();
    let statistics = if keep {
        integrate(system, method, &schedule, &mut state, &mut states, go_on)
    } else {
        integrate(system, method, &schedule, &mut state, &mut NoRecord, go_on)
    }?;
    let seconds = clock.elapsed().as_secs_f64();
    let mut states = states.0;
    let size = equations.size();
    for x in states.chunks_exact_mut(size) {
        let (y, v) = x.split_at(size / 2);
        let (y, v) = (y.to_vec(), v.to_vec());
        equations.measure(&y, &v, x);
    }
    Ok(Run { seconds, evaluations: statistics.evaluations, interval: schedule.step(), states })
}
