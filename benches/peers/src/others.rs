//! Integrators of other Rust packages.

use crate::Run;
use crate::equations::Equations;
use diffsol::{NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason};
use ode_solvers::{Dop853, Dopri5, OutputType, SVector, System};
use std::cell::RefCell;
use std::error::Error;
use std::time::Instant;

/// Coordinates and velocities that `ode_solvers` is compiled for: vectors without allocation.
const SIZE: usize = 32;

type M = NalgebraMat<f64>;
type LS = NalgebraLU<f64>;

/// First step (s), where a package takes one instead of finding it.
const FIRST_STEP: f64 = 1e-8;

/// Runs a method of `diffsol`; with `interval` (s) samples by its interpolation are kept.
pub fn diffsol(
    equations: &mut Equations,
    method: &str,
    tolerance: f64,
    seconds: f64,
    interval: Option<f64>,
) -> Result<Run, Box<dyn Error>> {
    let (start, size) = (equations.start(), equations.size());
    equations.take_evaluations();
    let equations = RefCell::new(equations);
    let problem = OdeBuilder::<M>::new()
        .t0(0.0)
        .h0(FIRST_STEP)
        .rtol(tolerance)
        .atol([tolerance])
        .rhs_implicit(
            |x, _p, t, dx| equations.borrow_mut().rhs_into(t, x, dx),
            |x, _p, t, w, out| equations.borrow_mut().jacobian_times(t, x, w, out),
        )
        .init(|_p, _t, x| x.copy_from_slice(&start), size)
        .build()?;
    let clock = Instant::now();
    let states = match method {
        "bdf" => go(problem.bdf::<LS>()?, seconds, interval),
        "tr_bdf2" => go(problem.tr_bdf2::<LS>()?, seconds, interval),
        "esdirk34" => go(problem.esdirk34::<LS>()?, seconds, interval),
        "tsit45" => go(problem.tsit45()?, seconds, interval),
        _ => Err(format!("no method `{method}`").into()),
    }?;
    let seconds = clock.elapsed().as_secs_f64();
    let evaluations = equations.borrow_mut().take_evaluations();
    Ok(Run { seconds, evaluations, interval: interval.unwrap_or(0.0), states })
}

/// Steps to the end, with the states every `interval` seconds.
fn go<'a, E>(
    mut solver: impl OdeSolverMethod<'a, E>,
    seconds: f64,
    interval: Option<f64>,
) -> Result<Vec<f64>, Box<dyn Error>>
where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
{
    solver.set_stop_time(seconds)?;
    let mut states = Vec::new();
    let mut sample = 0;
    if interval.is_some() {
        states.extend_from_slice(solver.state().y.batch_as_slice(0));
        sample = 1;
    }
    loop {
        let reason = solver.step()?;
        if let Some(interval) = interval {
            // round-off must not take the last sample
            while sample as f64 * interval <= solver.state().t + 1e-9 * interval {
                let t = (sample as f64 * interval).min(solver.state().t);
                states.extend_from_slice(solver.interpolate(t)?.batch_as_slice(0));
                sample += 1;
            }
        }
        if matches!(reason, OdeSolverStopReason::TstopReached) {
            return Ok(states);
        }
    }
}

/// A right-hand side behind a shared reference, as `ode_solvers` wants it.
struct Shared<'a>(&'a RefCell<&'a mut Equations>);

impl System<f64, SVector<f64, SIZE>> for Shared<'_> {
    fn system(&self, t: f64, x: &SVector<f64, SIZE>, dx: &mut SVector<f64, SIZE>) {
        let mut equations = self.0.borrow_mut();
        equations.rhs_into(t, x.as_slice(), dx.as_mut_slice());
    }
}

/// More steps than any run takes.
const MOST_STEPS: u32 = 10_000_000;

/// Runs a method of `ode_solvers`; with `interval` (s) samples by its dense output are kept.
pub fn ode_solvers(
    equations: &mut Equations,
    method: &str,
    tolerance: f64,
    seconds: f64,
    interval: Option<f64>,
) -> Result<Run, Box<dyn Error>> {
    let start = equations.start();
    if start.len() != SIZE {
        let found = start.len();
        return Err(format!("{SIZE} coordinates and velocities are compiled in, found {found}").into());
    }
    equations.take_evaluations();
    let start = SVector::from_row_slice(&start);
    let equations = RefCell::new(equations);
    let output = match interval {
        Some(_) => OutputType::Dense,
        None => OutputType::Sparse,
    };
    let dx = interval.unwrap_or(seconds);
    let clock = Instant::now();
    let (elapsed, states) = match method {
        "dop853" => {
            let f = Shared(&equations);
            // as Dop853::new, without its test for stiffness
            let mut solver = Dop853::from_param(
                f, 0.0, seconds, dx, start, tolerance, tolerance, 0.9, 0.0, 0.333, 6.0, seconds, 0.0, MOST_STEPS,
                MOST_STEPS, output,
            );
            solver.integrate()?;
            (clock.elapsed(), solver.y_out().clone())
        }
        "dopri5" => {
            let f = Shared(&equations);
            // as Dopri5::new, without its test for stiffness
            let mut solver = Dopri5::from_param(
                f, 0.0, seconds, dx, start, tolerance, tolerance, 0.9, 0.04, 0.2, 10.0, seconds, 0.0, MOST_STEPS,
                MOST_STEPS, output,
            );
            solver.integrate()?;
            (clock.elapsed(), solver.y_out().clone())
        }
        _ => return Err(format!("no method `{method}`").into()),
    };
    let kept = if interval.is_some() { states.as_slice() } else { &[] };
    let evaluations = equations.borrow_mut().take_evaluations();
    Ok(Run {
        seconds: elapsed.as_secs_f64(),
        evaluations,
        interval: dx,
        states: kept.iter().flat_map(|x| x.iter().copied()).collect(),
    })
}
