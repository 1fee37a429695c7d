//! What is between the ends of a step: order 7 from three more stages.

use super::stages::{LAST, Span, Stages};
use super::tableau::DENSE;
use crate::numerics::ode::{Exchange, SecondOrderSystem, SnapshotError};

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
