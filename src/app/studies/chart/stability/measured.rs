//! What short runs do: two that begin a little apart, side by side, against finer ones from the same starts.

use super::super::starts::perturb;
use super::condition::Variant;
use crate::numerics::ode::{Integration, Method, Schedule, TransientError};
use crate::numerics::ode::{NoRecord, State};

/// Relative distance of the two starts: far above rounding, far below what changes contacts.
const APART: f64 = 1e-7;

/// Steps between two looks.
const STRIDE: u32 = 5;

/// A run may be so many times as fast as the finer one has been, and its distance from its neighbour so many times that of these:
/// balls that strike part nearby runs too, by other factors in other steps.
const FASTER: f64 = 10.0;
const FARTHER: f64 = 100.0;

/// Part of the finer runs' time whose largest values count from the beginning on: in the first moments all is at rest.
const BEGINNING: f64 = 0.1;

/// Where nothing moves, a velocity is told from none beside this part of the state's size at the fastest frequency: what a method moves
/// that does not keep the equilibrium is no growth.
const MOVING: f64 = 1e-2;

/// Largest velocity and distance so far of finer runs, over time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reference {
    every_s: f64,
    values: Vec<[f64; 2]>,
    /// Velocity that is none.
    still: f64,
}

/// Runs of a variant.
pub(super) struct Measurement<'a> {
    pub(super) variant: &'a Variant,
    /// Steps of a run.
    pub(super) steps: u32,
    /// What the finer runs do.
    pub(super) reference: &'a Reference,
}

impl Reference {
    /// Of so many steps of `h` (s) by `method`; `fastest` (1/s) is the order of the fastest motion. Runs that fail tell of their time
    /// until then.
    pub(super) fn of(variant: &Variant, method: Method, h: f64, steps: u32, fastest: f64) -> Self {
        let mut values = Vec::with_capacity((steps / STRIDE) as usize);
        let mut most = [0.0_f64; 2];
        let _ = observe(variant, method, h, steps, |_, now| {
            most = [0, 1].map(|k| most[k].max(now[k]));
            values.push(most);
            true
        });
        let size = variant.state.y.iter().map(|y| y * y).sum::<f64>().sqrt();
        Self { every_s: h * f64::from(STRIDE), values, still: MOVING * size * fastest }
    }

    /// Largest velocity and distance until a time after the start, s.
    fn until(&self, time: f64) -> [f64; 2] {
        let last = self.values.len().saturating_sub(1);
        let place = (time / self.every_s).max(BEGINNING * last as f64);
        let [speed, apart] = self.values.get((place as usize).min(last)).copied().unwrap_or([0.0; 2]);
        [speed.max(self.still), apart.max(APART * self.still)]
    }
}

impl Measurement<'_> {
    /// Whether runs with steps of `h` (s) do what fine ones do not; with the failure if there is one.
    pub(super) fn unstable(&self, method: Method, h: f64) -> (bool, Option<TransientError>) {
        let mut grown = false;
        let failure = observe(self.variant, method, h, self.steps, |time, [speed, apart]| {
            let [fast, far] = self.reference.until(time);
            grown = speed > FASTER * fast || apart > FARTHER * far;
            !grown
        })
        .err();
        (grown || failure.is_some(), failure)
    }
}

/// Runs of so many steps of `h` (s) from rest and from beside it; `see` is told the time since the start (s), the root of the sum
/// of the squared velocities and that of their difference, and says whether to go on. Gives the mean length of a step, s.
///
/// # Errors
/// Why they ended early.
pub(super) fn observe(
    variant: &Variant,
    method: Method,
    h: f64,
    steps: u32,
    mut see: impl FnMut(f64, [f64; 2]) -> bool,
) -> Result<f64, TransientError> {
    let intervals = (steps / STRIDE).max(1);
    let schedule =
        Schedule { interval: h * f64::from(STRIDE), steps_per_interval: STRIDE, intervals: u64::from(intervals) };
    let mut beside = variant.state.clone();
    perturb(&mut beside, APART, 1, 0);
    let mut systems = [variant.system.clone(), variant.system.clone()];
    let begin = |system: &mut _, state: State| Integration::begin(system, method, schedule, state, &mut NoRecord);
    let mut runs = [begin(&mut systems[0], variant.state.clone())?, begin(&mut systems[1], beside)?];
    for interval in 1..=intervals {
        for (run, system) in runs.iter_mut().zip(&mut systems) {
            run.advance(system, &mut NoRecord)?;
        }
        let [own, other] = [&runs[0], &runs[1]].map(|run| &run.state.v);
        let speed = own.iter().map(|v| v * v).sum::<f64>().sqrt();
        let pairs = own.iter().zip(other);
        let apart = pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        if !see(f64::from(interval) * schedule.interval, [speed, apart]) {
            break;
        }
    }
    let taken = runs[0].statistics().steps.max(1) as f64;
    Ok(runs[0].intervals as f64 * schedule.interval / taken)
}
