//! Where the force is not smooth: crossings of event functions through zero, and steps that end there.
//!
//! Each event function has a side, above zero or not, which it leaves when it is beyond zero by a band: what happens within the
//! band is too small to be seen. A step at whose end a function is on its other side is taken back to where it crosses, found
//! on the dense output; the step that ends there is taken with stages of its own, within the band if the dense output was good,
//! else the search goes on from there. A function that crosses twice within a step is left to the error estimate.
//!
//! What is between the ends of a step: order 7 from three more stages.

use super::stages::{LAST, Span, Stages};
use super::tableau::DENSE;
use crate::numerics::ode::{Exchange, SecondOrderSystem, SnapshotError};

/// Half of the band about zero in units of `tolerance` times the largest value of the function so far: the force of a contact
/// there, with the power 3/2 of the overlap, is 1e-3 of the tolerance.
const BAND: f64 = 1e-2;

/// Places of a step at which a function is looked at before it is searched.
const PLACES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Evaluations of a search, more than bisection takes to the last digit of a place.
const MAX_SEARCH: usize = 80;

/// Trials for one step that ends at an event.
const MAX_RETAKEN: usize = 8;

/// Steps in succession that events cut to the resolution of time; the next one then ends where it likes.
const MAX_CROWDED: usize = 10;

/// What is left of the time that can be told from `t` (s): a few units in the last place.
pub(super) fn resolution(t: f64, step: f64) -> f64 {
    4.0 * f64::EPSILON * t.abs().max(step)
}

/// A step that was good enough, with what evaluates it between its ends.
pub(super) struct Trial<'a, S> {
    pub system: &'a mut S,
    pub stages: &'a mut Stages,
    pub dense: &'a mut Dense,
    pub span: &'a Span,
}

/// Sides of all event functions.
#[derive(Debug, Default)]
pub(super) struct Crossings {
    tolerance: f64,
    above: Vec<bool>,
    largest: Vec<f64>,
    /// At the start of the step, at its end, and in between.
    before: Vec<f64>,
    after: Vec<f64>,
    between: Vec<f64>,
    aimed: Option<usize>,
    retaken: usize,
    crowded: usize,
    /// Steps that ended at an event.
    pub count: u64,
}

impl Crossings {
    /// Of no events, to be read from a snapshot.
    pub(super) fn blank(tolerance: f64) -> Self {
        Self { tolerance, ..Self::default() }
    }

    /// Of a system with event functions; the sides are those at the start.
    pub(super) fn new<S: SecondOrderSystem>(
        system: &mut S,
        tolerance: f64,
        t: f64,
        [y, v]: [&[f64]; 2],
    ) -> Option<Self> {
        let count = system.events();
        if count == 0 {
            return None;
        }
        let mut after = vec![0.0; count];
        system.events_into(t, y, v, &mut after);
        Some(Self {
            above: after.iter().map(|&value| value > 0.0).collect(),
            largest: after.iter().map(|value| value.abs()).collect(),
            before: after.clone(),
            between: after.clone(),
            after,
            ..Self::blank(tolerance)
        })
    }

    /// Writes sides and values at the end of the last step, or reads them; what concerns a step under way is none of it.
    ///
    /// # Errors
    /// [`SnapshotError`] for those of another system.
    pub(super) fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        words.count(&mut self.count)?;
        let mut crowded = self.crowded as u64;
        words.count(&mut crowded)?;
        self.crowded = crowded.try_into().unwrap_or(usize::MAX);
        words.list(&mut self.largest)?;
        let events = self.largest.len();
        for values in [&mut self.before, &mut self.after, &mut self.between] {
            values.resize(events, 0.0);
        }
        words.numbers("events", &mut self.after)?;
        self.above.resize(events, false);
        self.above.iter_mut().try_for_each(|above| words.flag(above))
    }

    /// Goes on from the end of the last step.
    pub(super) fn turn_over(&mut self) {
        std::mem::swap(&mut self.before, &mut self.after);
        self.forget();
    }

    /// A trial was not good enough: none of its events is sought any more.
    pub(super) fn forget(&mut self) {
        (self.aimed, self.retaken) = (None, 0);
    }

    /// Looks at a good step: the instant (s) to which it must be taken back, or none, and then the sides are those at its end.
    pub(super) fn look<S: SecondOrderSystem>(&mut self, trial: &mut Trial<'_, S>) -> Option<f64> {
        let span = trial.span;
        let [y, v] = trial.stages.end();
        trial.system.events_into(span.to, y, v, &mut self.after);
        let least = resolution(span.to, span.length());
        if self.retaken < MAX_RETAKEN && self.crowded < MAX_CROWDED {
            let mut first: Option<(usize, f64)> = None;
            for event in 0..self.above.len() {
                if self.has_left(event, self.after[event]) {
                    let limit = first.map_or(1.0, |(_, place)| place);
                    let found = self.place(trial, event, limit);
                    first = found.map(|place| (event, place)).or(first);
                }
            }
            if let Some((event, place)) = first {
                let t = (span.from + place * span.length()).max(span.from + 2.0 * least);
                if t < span.to - least {
                    (self.aimed, self.retaken) = (Some(event), self.retaken + 1);
                    return Some(t);
                }
                // it cannot be told from the end
                self.aimed = Some(event);
            }
        }
        self.stand(span, least);
        None
    }

    /// Takes the step as it is.
    fn stand(&mut self, span: &Span, least: f64) {
        let aimed = self.aimed;
        for event in 0..self.above.len() {
            let value = self.after[event];
            self.largest[event] = self.largest[event].max(value.abs());
            let reached = aimed == Some(event) && value.abs() <= self.band(event);
            if reached || self.has_left(event, value) {
                self.above[event] = !self.above[event];
                self.count += u64::from(aimed == Some(event));
            }
        }
        self.crowded = match aimed {
            Some(_) if span.length() < 1e3 * least => self.crowded + 1,
            _ => 0,
        };
    }

    fn band(&self, event: usize) -> f64 {
        BAND * self.tolerance * self.largest[event].max(self.after[event].abs())
    }

    /// Whether a value is beyond the band on the side that the event is not on.
    fn has_left(&self, event: usize, value: f64) -> bool {
        self.toward(event, value) < -self.band(event)
    }

    /// A value, positive on the side that the event is on.
    fn toward(&self, event: usize, value: f64) -> f64 {
        if self.above[event] { value } else { -value }
    }

    /// Where an event that has changed its side by the end of a step first leaves it, up to a place; none if it was never
    /// beyond the band on it, and has only touched zero.
    fn place<S: SecondOrderSystem>(&mut self, trial: &mut Trial<'_, S>, event: usize, limit: f64) -> Option<f64> {
        let band = self.band(event);
        let start = self.toward(event, self.before[event]);
        let mut armed = (start > band).then_some((0.0, start));
        for share in PLACES {
            let place = share * limit;
            let value =
                if place < 1.0 { self.value(trial, event, place) } else { self.toward(event, self.after[event]) };
            match armed {
                Some(before) if value <= 0.0 => {
                    let bracket = [before, (place, value)];
                    return Some(self.search(trial, event, bracket));
                }
                Some(_) => armed = Some((place, value)),
                None if value > band => armed = Some((place, value)),
                None => {}
            }
        }
        None
    }

    /// The place of zero in a bracket, by the Illinois form of false position, with a bisection where that gains too little:
    /// to half the band, or to what can be told apart.
    fn search<S: SecondOrderSystem>(
        &mut self,
        trial: &mut Trial<'_, S>,
        event: usize,
        [(mut a, mut f_a), (mut b, mut f_b)]: [(f64, f64); 2],
    ) -> f64 {
        let enough = 0.5 * self.band(event);
        let span = trial.span;
        let least = (resolution(span.to, span.length()) / span.length()).max(f64::EPSILON);
        for looked in 0..MAX_SEARCH {
            if b - a <= least {
                break;
            }
            let secant = a + (b - a) * f_a / (f_a - f_b);
            let bisect = looked % 4 == 3 || !(a < secant && secant < b);
            let x = if bisect { 0.5 * (a + b) } else { secant };
            let f_x = self.value(trial, event, x);
            if f_x.abs() <= enough {
                return x;
            }
            if f_x > 0.0 {
                (a, f_a) = (x, f_x);
                f_b *= 0.5;
            } else {
                (b, f_b) = (x, f_x);
                f_a *= 0.5;
            }
        }
        b
    }

    /// An event function at a place of the step, positive on its side.
    fn value<S: SecondOrderSystem>(&mut self, trial: &mut Trial<'_, S>, event: usize, place: f64) -> f64 {
        let Trial { system, stages, dense, span } = trial;
        let [y, v] = dense.at(*system, stages, span, place);
        system.events_into(span.at(place), y, v, &mut self.between);
        self.toward(event, self.between[event])
    }
}

/// Interpolation over the last step, made when it is asked for.
#[derive(Debug)]
pub(super) struct Dense {
    ready: bool,
    /// \[7 x states\].
    terms: [Vec<f64>; 7],
    /// Position and velocity that were asked for last.
    state: Vec<f64>,
}

impl Dense {
    pub(super) fn new(length: usize) -> Self {
        Self { ready: false, terms: std::array::from_fn(|_| vec![0.0; length]), state: vec![0.0; length] }
    }

    /// Forgets the step.
    pub(super) fn clear(&mut self) {
        self.ready = false;
    }

    /// Writes the interpolation, or reads it.
    ///
    /// # Errors
    /// [`SnapshotError`] for that of another system.
    pub(super) fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        words.flag(&mut self.ready)?;
        self.terms.iter_mut().try_for_each(|terms| words.numbers("terms of an interpolation", terms))
    }

    /// Position and velocity at a place (0 to 1) of the step that `stages` hold.
    pub(super) fn at<S: SecondOrderSystem>(
        &mut self,
        system: &mut S,
        stages: &mut Stages,
        span: &Span,
        place: f64,
    ) -> [&[f64]; 2] {
        if !self.ready {
            self.prepare(system, stages, span);
        }
        let ([start, _], dof) = (stages.states(), stages.dof());
        for (i, state) in self.state.iter_mut().enumerate() {
            let terms = std::array::from_fn(|term| self.terms[term][i]);
            *state = start[i] + polynomial(terms, place);
        }
        [&self.state[..dof], &self.state[dof..2 * dof]]
    }

    fn prepare<S: SecondOrderSystem>(&mut self, system: &mut S, stages: &mut Stages, span: &Span) {
        stages.extend(system, span);
        let (h, [start, end]) = (span.length(), stages.states());
        let (first, last) = (stages.slope(0), stages.slope(LAST));
        for i in 0..start.len() {
            let gained = end[i] - start[i];
            self.terms[0][i] = gained;
            self.terms[1][i] = h * first[i] - gained;
            self.terms[2][i] = 2.0 * gained - h * (first[i] + last[i]);
        }
        for (row, terms) in DENSE.into_iter().zip(&mut self.terms[3..]) {
            stages.combine_into(row, h, terms);
        }
        self.ready = true;
    }
}

/// `x (f0 + (1 - x) (f1 + x (f2 + (1 - x) (f3 + x (f4 + (1 - x) (f5 + x f6))))))`.
#[inline]
pub(super) fn polynomial(f: [f64; 7], x: f64) -> f64 {
    let rest = 1.0 - x;
    x * (f[0] + rest * (f[1] + x * (f[2] + rest * (f[3] + x * (f[4] + rest * (f[5] + x * f[6]))))))
}
