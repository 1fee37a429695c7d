//! A system on its way through a schedule, one interval at a time.

use super::steppers::stepper;
use super::{
    BlowUp, Divergence, Exchange, Instant, Method, Observer, Schedule, SecondOrderSystem, Snapshot, SnapshotError,
    SnapshotReader, State, Statistics, StepLimit, Stepper, TransientError,
};

/// Steps between two looks at whether the state still means something, besides those at the ends of intervals: a blow-up by a
/// step that is too long is then seen fewer than so many steps after its first value out of range. By instructions a look takes
/// 11 % of the cheapest step (7 modes, no residual), so that looking takes below 2 % of a run.
const STEPS_UNCHECKED: u64 = 6;

/// Good states that are kept of the last looks: in a single one the ball that vibrates may be just off its races.
const KEPT: usize = 4;

/// Every so many looks one is kept for longer: the last ones before a blow-up may be far from where it began.
const APART: u64 = 64;

/// Whether to go on after an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stepping {
    /// Go on.
    Continue,
    /// Stop here; the state is that of this instant.
    Stop,
}

/// Integrates `system` from `state`, which is left at the end or at the last good instant.
///
/// `observer` sees every sample, `schedule.steps_per_interval` an interval: the steps of a method that has none of its own.
/// `after_interval(done, total)` is called between intervals and may stop the run.
///
/// # Errors
/// [`TransientError::Unstable`] and [`TransientError::Schedule`] before the first step, [`TransientError::BlewUp`] with the last
/// good state and the records of the steps before it left in place.
pub fn integrate<S: SecondOrderSystem>(
    system: &mut S,
    method: Method,
    schedule: &Schedule,
    state: &mut State,
    observer: &mut impl Observer<S>,
    mut after_interval: impl FnMut(u64, u64) -> Stepping,
) -> Result<Statistics, TransientError> {
    let mut integration = Integration::begin(system, method, *schedule, state.clone(), observer)?;
    let mut ended = Ok(());
    while ended.is_ok() && !integration.is_complete() {
        ended = integration.advance(system, observer);
        if ended.is_ok() && after_interval(integration.intervals, schedule.intervals) == Stepping::Stop {
            break;
        }
    }
    state.clone_from(&integration.state);
    ended.map(|()| integration.statistics())
}

/// An integration under way: the method with what it remembers, the state, and what of the schedule is done.
pub struct Integration<S> {
    method: Method,
    schedule: Schedule,
    stepper: Box<dyn Stepper<S>>,
    /// Where it is, after a blow-up the last good state.
    pub(crate) state: State,
    force: Vec<f64>,
    /// The last ones that were looked at and meant something; `newest` is the place of the last.
    good: [State; KEPT],
    newest: usize,
    /// From longer ago: the start, and two that are [`APART`], the older one first.
    earlier: [State; 3],
    looks: u64,
    start: f64,
    /// Intervals done.
    pub(crate) intervals: u64,
    samples: u64,
}

impl<S: SecondOrderSystem> Integration<S> {
    /// Ready to go from a state, which `observer` sees as the first sample.
    ///
    /// # Errors
    /// [`TransientError::Unstable`] and [`TransientError::Schedule`].
    pub(crate) fn begin(
        system: &mut S,
        method: Method,
        schedule: Schedule,
        state: State,
        observer: &mut impl Observer<S>,
    ) -> Result<Self, TransientError> {
        let stepper = stepper(system, method, &schedule, state.t)?;
        let mut force = vec![0.0; state.y.len()];
        system.force_into(state.t, &state.y, &state.v, &mut force);
        observe(system, observer, 0, &state);
        Ok(Self::at(state, force, method, schedule, stepper))
    }

    /// Goes on where an integration of the same system, method and schedule was when it wrote this, to the last bit as if
    /// it had never stopped.
    ///
    /// # Errors
    /// [`TransientError::Unstable`], [`TransientError::Schedule`], and [`TransientError::Snapshot`] for a snapshot of
    /// something else.
    pub(crate) fn resume(
        system: &S,
        method: Method,
        schedule: Schedule,
        snapshot: &mut SnapshotReader,
    ) -> Result<Self, TransientError> {
        let blank = vec![0.0; system.linear().len()];
        let state = State { t: 0.0, y: blank.clone(), v: blank.clone() };
        let stepper = stepper(system, method, &schedule, 0.0)?;
        let mut resumed = Self::at(state, blank, method, schedule, stepper);
        resumed.exchange(&mut Exchange::Read(snapshot))?;
        resumed.good.fill(resumed.state.clone());
        resumed.earlier.fill(resumed.state.clone());
        Ok(resumed)
    }

    /// About to take its first step from a state and the force there.
    fn at(state: State, force: Vec<f64>, method: Method, schedule: Schedule, stepper: Box<dyn Stepper<S>>) -> Self {
        Self {
            method,
            schedule,
            stepper,
            good: std::array::from_fn(|_| state.clone()),
            newest: 0,
            earlier: std::array::from_fn(|_| state.clone()),
            looks: 0,
            start: state.t,
            state,
            force,
            intervals: 0,
            samples: 0,
        }
    }

    /// Writes all that the rest depends on, between two intervals.
    ///
    /// # Errors
    /// None, for nothing is read.
    pub(crate) fn remember(&mut self, snapshot: &mut Snapshot) -> Result<(), SnapshotError> {
        self.exchange(&mut Exchange::Write(snapshot))
    }

    fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        words.number(&mut self.state.t)?;
        for numbers in [&mut self.state.y, &mut self.state.v, &mut self.force] {
            words.numbers("coordinates", numbers)?;
        }
        words.number(&mut self.start)?;
        words.count(&mut self.intervals)?;
        words.count(&mut self.samples)?;
        self.stepper.exchange(words)
    }

    /// Whether all intervals are done.
    pub(crate) fn is_complete(&self) -> bool {
        self.intervals >= self.schedule.intervals
    }

    /// What it took so far.
    pub(crate) fn statistics(&self) -> Statistics {
        self.stepper.statistics()
    }

    /// Goes through the next interval; `observer` sees every sample.
    ///
    /// # Errors
    /// [`TransientError::BlewUp`]; the state is then the last good one, which lies in this interval or at its start.
    pub(crate) fn advance(&mut self, system: &mut S, observer: &mut impl Observer<S>) -> Result<(), TransientError> {
        for place in 1..=self.schedule.steps_per_interval {
            let t = self.schedule.instant(self.start, self.intervals, place);
            if let Err(cause) = self.step(system, t, place) {
                return Err(self.blown_up(system, cause));
            }
            self.samples += 1;
            observe(system, observer, self.samples, &self.state);
        }
        self.intervals += 1;
        Ok(())
    }

    /// Goes to the next sample.
    fn step(&mut self, system: &mut S, t: f64, place: u32) -> Result<(), Divergence> {
        let State { t: now, y, v } = &mut self.state;
        *now = t;
        self.stepper.step(system, t, y, v, &mut self.force)?;
        let due = (self.samples + 1).is_multiple_of(STEPS_UNCHECKED);
        if due || place == self.schedule.steps_per_interval {
            system.check(y, v)?;
            self.newest = (self.newest + 1) % KEPT;
            let good = &mut self.good[self.newest];
            good.t = t;
            good.y.copy_from_slice(y);
            good.v.copy_from_slice(v);
            self.looks += 1;
            if self.looks.is_multiple_of(APART) {
                self.earlier.swap(1, 2);
                self.earlier[2].clone_from(good);
            }
        }
        Ok(())
    }

    /// Goes back to the last good state and tells what happened.
    fn blown_up(&mut self, system: &mut S, cause: Divergence) -> TransientError {
        let time = self.state.t;
        self.state.clone_from(&self.good[self.newest]);
        let step_s = self.schedule.step();
        let limit = self.limit(system, step_s);
        let below = limit.is_none_or(|limit| step_s <= limit.step_s);
        let resonance = below.then(|| self.method.resonance(system, &self.earlier[2], step_s)).flatten();
        TransientError::BlewUp(Box::new(BlowUp {
            method: self.method,
            time,
            good_until: self.state.t,
            good_intervals: self.intervals,
            step_s,
            statistics: self.stepper.statistics(),
            limit,
            resonance,
            cause,
        }))
    }

    /// The limit that the step was beyond first, or the least one.
    fn limit(&self, system: &mut S, step_s: f64) -> Option<StepLimit> {
        if self.method.chooses_its_steps() {
            return None;
        }
        let (older, newer) = self.good.split_at(self.newest + 1);
        let kept = self.earlier.iter().chain(newer).chain(older);
        let mut least: Option<StepLimit> = None;
        let mut last: Option<&State> = None;
        for state in kept {
            // nothing was kept in its place yet
            if last.is_some_and(|last| last == state) {
                continue;
            }
            last = Some(state);
            let Some(limit) = self.method.step_limit(system, state) else {
                continue;
            };
            if step_s > limit.step_s {
                return Some(limit);
            }
            if least.is_none_or(|least| limit.step_s < least.step_s) {
                least = Some(limit);
            }
        }
        least
    }
}

fn observe<S>(system: &S, observer: &mut impl Observer<S>, step: u64, state: &State) {
    observer.observe(system, Instant { step, t: state.t, y: &state.y, v: &state.v });
}
