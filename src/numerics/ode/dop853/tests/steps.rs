//! Lengths of the steps: at a jump of the force, for what stands still, and where none is short enough.

use super::super::*;
use super::{free, method};
use crate::numerics::ode::{LinearCoordinate, NoRecord, State};
use crate::numerics::ode::{Schedule, Statistics, Stepping, integrate};

/// A force that jumps from 1 to -2 at an instant, told or not.
struct Jump {
    linear: [LinearCoordinate; 1],
    told: bool,
    after: f64,
    calls: u64,
}

const JUMP: f64 = 0.7;

impl SecondOrderSystem for Jump {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, _y: &[f64], _v: &[f64], g: &mut [f64]) {
        self.calls += 1;
        g[0] = if t < JUMP { 1.0 } else { self.after };
    }

    fn next_change(&self, t: f64) -> f64 {
        if self.told && t < JUMP { JUMP } else { f64::INFINITY }
    }
}

/// Error at 2 s of a body at rest under that force, what it took, and how often it was evaluated.
fn jumped(told: bool) -> (f64, Statistics, u64) {
    let mut system = Jump { linear: free(), told, after: -2.0, calls: 0 };
    let mut state = State { t: 0.0, y: vec![0.0], v: vec![0.0] };
    let statistics = integrate(
        &mut system,
        method(1e-6),
        &Schedule::covering(2.0, 1.0, 0.1).unwrap(),
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .unwrap();
    let (after, speed) = (2.0 - JUMP, JUMP);
    let exact = 0.5 * JUMP * JUMP + speed * after - after * after;
    ((state.y[0] - exact).abs(), statistics, system.calls)
}

#[test]
fn no_step_passes_a_jump_of_the_force() {
    let (error, statistics, calls) = jumped(true);
    // powers up to 7 are exact
    assert!(error < 1e-14, "{error:e}");
    assert_eq!(statistics.rejected, 0);
    assert_eq!(statistics.evaluations, calls);
    let (untold, statistics, calls) = jumped(false);
    assert!(untold > 1e-10, "{untold:e}");
    assert!(statistics.rejected > 5);
    assert_eq!(statistics.evaluations, calls);
}

/// Springs in balance with large forces: nothing moves but by round-off.
struct Resting {
    linear: [LinearCoordinate; 3],
}

impl SecondOrderSystem for Resting {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        g[0] = 9.81 + 1e-3 * (y[2] - 1e-6 / 3.0);
        g[1] = (1e6 / 7.0 - 1e12 * y[1]) * 1e-6;
        g[2] = 1e4 * (1e-6 / 3.0 - y[2]);
    }
}

#[test]
fn what_stands_still_does_not_shorten_the_steps() {
    let coordinate = |squared_frequency: f64| LinearCoordinate { squared_frequency, damping: 0.0 };
    let mut system = Resting { linear: [coordinate(1e6), coordinate(0.0), coordinate(0.0)] };
    let mut state = State { t: 0.0, y: vec![9.81e-6, 1e-6 / 7.0, 1e-6 / 3.0], v: vec![0.0; 3] };
    let statistics = integrate(
        &mut system,
        method(1e-8),
        &Schedule::covering(1.0, 1.0, 1.0).unwrap(),
        &mut state,
        &mut NoRecord,
        |_, _| Stepping::Continue,
    )
    .unwrap();
    // 1e3 rad of the spring: at the limit of stability, about 5.3 rad a step
    assert!(statistics.steps < 220, "{statistics:?}");
    assert!(state.v.iter().all(|v| v.abs() < 1e-13), "{state:?}");
}

#[test]
fn what_no_step_is_short_enough_for_is_said() {
    let run = |system: &mut Jump, tolerance: f64| {
        let mut state = State { t: 0.0, y: vec![0.1], v: vec![0.3] };
        let schedule = Schedule::covering(2.0, 1.0, 0.1).unwrap();
        let method = method(tolerance);
        let mut record = NoRecord;
        integrate(system, method, &schedule, &mut state, &mut record, |_, _| Stepping::Continue)
            .unwrap_err()
            .to_string()
    };
    let mut system = Jump { linear: free(), told: false, after: 1e20, calls: 0 };
    assert_eq!(run(&mut system, 0.0), "tolerance must be at least 1e-14 and below 1, found 0.0");
    assert!(run(&mut system, f64::NAN).contains("found NaN"));
    assert!(run(&mut system, 1e-3).contains("no step is short enough for the tolerance"));
    system.linear[0].squared_frequency = f64::NAN;
    assert!(run(&mut system, 1e-6).contains("not a number"));
}
