//! Explicit Runge-Kutta of order 8 with a step of its own: the reference that others are measured by.
//!
//! The pair of order 8(5,3) of Dormand and Prince in the form of Hairer, Norsett and Wanner (Solving Ordinary Differential
//! Equations I, 2nd ed., II.5, II.6, II.10) on the state (y, v): twelve evaluations a step, three more for a step with
//! samples inside, one for each sample. Every mode is resolved or damps the step: explicit, stable up to about
//! `h = 6 / omega_max`.
//!
//! The force of a contact grows with the power 3/2 of the overlap. A step across its beginning has no order 8, and the error
//! estimate, made for smooth forces, does not know. With events steps end there; what is left is the same power at a step's
//! end, where its part is smaller.

mod control;
mod crossings;
mod stages;
mod tableau;

use super::{Divergence, Exchange, SecondOrderSystem, SnapshotError, Statistics, Stepper};
use control::{Scale, after_failure, after_success};
use crossings::{Crossings, Dense, Trial, resolution};
use stages::{LAST, Span, Stages};

/// Steps by tolerance.
#[derive(Debug)]
pub(super) struct Dop853 {
    tolerance: f64,
    with_events: bool,
    stages: Stages,
    dense: Dense,
    scale: Scale,
    /// Error of the last step, which controls the next one.
    error_before: f64,
    crossings: Option<Crossings>,
    /// The last step.
    span: Span,
    /// Length of the next one if nothing cuts it, s; none before the start.
    next: Option<f64>,
    /// Where the force jumps next, s.
    change: f64,
    steps: u64,
    rejected: u64,
    samples: u64,
}

impl Dop853 {
    /// From the instant `t` (s); `tolerance` is relative, above 0 and below 1.
    pub(super) fn new(system: &impl SecondOrderSystem, t: f64, tolerance: f64, events: bool) -> Self {
        let linear = system.linear();
        let stages = Stages::new(linear);
        Self {
            tolerance,
            with_events: events,
            dense: Dense::new(stages.length()),
            scale: Scale::new(linear, stages.length()),
            stages,
            error_before: 1e-4,
            crossings: None,
            span: Span::new(t, t, f64::INFINITY),
            next: None,
            change: f64::INFINITY,
            steps: 0,
            rejected: 0,
            samples: 0,
        }
    }

    fn begin<S: SecondOrderSystem>(&mut self, system: &mut S, t1: f64, [y, v, g]: [&[f64]; 3]) {
        let t = self.span.to;
        self.stages.begin(y, v, g);
        self.scale.see(self.stages.states()[1], 0.0);
        if self.with_events {
            self.crossings = Crossings::new(system, self.tolerance, t, [y, v]);
        }
        let slope = self.stages.slope(LAST);
        let step = self.scale.first_step(system.linear(), slope, 1e-3 * (t1 - t));
        self.next = Some(step);
    }

    /// Takes one step.
    fn advance<S: SecondOrderSystem>(&mut self, system: &mut S, next: f64) -> Result<(), Divergence> {
        let from = self.span.to;
        self.stages.turn_over();
        if from >= self.change {
            self.stages.restart(system, from);
        }
        self.change = system.next_change(from);
        if let Some(crossings) = &mut self.crossings {
            crossings.turn_over();
        }
        let (mut next, mut failed, mut event) = (next, false, None);
        loop {
            let to = event.unwrap_or_else(|| end_of_step(from, next, self.change));
            let (span, cut) = (Span::new(from, to, self.change), to - from < next);
            self.dense.clear();
            self.stages.attempt(system, &span);
            let error = self.scale.error(&self.stages, span.length()) / self.tolerance;
            if error > 1.0 {
                next = span.length() * after_failure(error);
                if next <= resolution(from, next) {
                    return Err(if error.is_finite() {
                        Divergence::NoStep { step: next }
                    } else {
                        Divergence::NotFinite
                    });
                }
                (failed, event) = (true, None);
                self.rejected += 1;
                if let Some(crossings) = &mut self.crossings {
                    crossings.forget();
                }
                continue;
            }
            self.stages.close(system, &span);
            if let Some(crossings) = &mut self.crossings {
                let (stages, dense) = (&mut self.stages, &mut self.dense);
                event = crossings.look(&mut Trial { system: &mut *system, stages, dense, span: &span });
                if event.is_some() {
                    self.rejected += 1;
                    continue;
                }
            }
            let allowed = span.length() * after_success(&mut self.error_before, error, failed);
            self.next = Some(if cut { allowed.max(next) } else { allowed });
            self.scale.see(self.stages.states()[1], span.length());
            self.span = span;
            self.steps += 1;
            return Ok(());
        }
    }
}

/// End of a step of at most `h` s; the last two before a change are of the same length.
fn end_of_step(from: f64, h: f64, change: f64) -> f64 {
    let left = change - from;
    if h >= left {
        change
    } else if 2.0 * h > left {
        from + 0.5 * left
    } else {
        from + h
    }
}

impl<S: SecondOrderSystem> Stepper<S> for Dop853 {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) -> Result<(), Divergence> {
        if self.next.is_none() {
            self.begin(system, t1, [y, v, g]);
        }
        while let Some(next) = self.next
            && self.span.to < t1
        {
            self.advance(system, next)?;
        }
        let place = self.span.place(t1);
        let [at_y, at_v] =
            if place < 1.0 { self.dense.at(system, &mut self.stages, &self.span, place) } else { self.stages.end() };
        y.copy_from_slice(at_y);
        v.copy_from_slice(at_v);
        system.force_into(t1, y, v, g);
        self.samples += 1;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        Statistics {
            steps: self.steps,
            rejected: self.rejected,
            evaluations: self.stages.evaluations + self.samples + 1,
            events: self.crossings.as_ref().map_or(0, |crossings| crossings.count),
            ..Statistics::default()
        }
    }

    fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        for count in [&mut self.steps, &mut self.rejected, &mut self.samples] {
            words.count(count)?;
        }
        words.option(&mut self.next)?;
        words.number(&mut self.change)?;
        self.span.exchange(words)?;
        self.stages.exchange(words)?;
        self.dense.exchange(words)?;
        self.scale.exchange(words)?;
        words.number(&mut self.error_before)?;
        let mut watches = self.crossings.is_some();
        words.flag(&mut watches)?;
        if watches {
            self.crossings.get_or_insert_with(|| Crossings::blank(self.tolerance)).exchange(words)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
