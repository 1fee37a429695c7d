//! What a second-order system shows to a time integrator, and what a record taker shows to both.
//!
//! All coordinates are scaled to unit mass. The linear part is diagonal and constant,
//!
//! ```text
//! y_i'' + damping_i y_i' + squared_frequency_i y_i = g_i(t, y, y')
//! ```
//!
//! and `g` (contact, gravity, unbalance) is what has to be evaluated step by step.
//!
//! How the force changes with the state: a sum of few products, one a contact and direction, instead of a full matrix.
//!
//! ```text
//! d g = sum_k left_k (position_k . d y + velocity_k . d v)
//! ```

use crate::numerics::Brief;
use thiserror::Error;

/// Linear part of one coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearCoordinate {
    /// omega^2, 1/s^2, >= 0; zero for a coordinate that only `g` holds.
    pub squared_frequency: f64,
    /// 2 zeta omega, 1/s, >= 0.
    pub damping: f64,
}

/// A system of second order with a diagonal linear part and everything else in `g`.
pub trait SecondOrderSystem {
    /// The linear part, one entry a coordinate.
    fn linear(&self) -> &[LinearCoordinate];

    /// Sets `g = g(t, y, v)`; all slices have one entry a coordinate, `t` in s.
    ///
    /// Called once or a few times a step: no allocation. A function of these alone, to the last bit: what an evaluation
    /// leaves in `self` may make the next one faster and nothing else, for a run that goes on from a checkpoint has none of it.
    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]);

    /// Adds how `g` changes with `y` and `v` at a state to an empty `tangent`, for methods that solve for the force.
    ///
    /// What is left out costs such a method iterations, not accuracy; by default all is.
    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], _tangent: &mut Tangent) {}

    /// Sets what each coordinate meets of the force as a spring of its own, `-dg_i/dy_i` >= 0 (1/s^2), and the size of what its
    /// force is the sum of (m/s^2), both where the force was evaluated last, for methods that step such springs exactly; zero
    /// where they are not known.
    ///
    /// Any values leave such a method right: how near the springs are decides how long its steps can be, and what is large
    /// beside the force says that most of it cancels, so that a tolerance has something to refer to.
    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        springs.fill(0.0);
        sizes.fill(0.0);
    }

    /// [`Self::force_into`] and [`Self::tangent_into`] at once, for a system that need not evaluate twice.
    fn force_and_tangent_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64], tangent: &mut Tangent) {
        self.tangent_into(t, y, v, tangent);
        self.force_into(t, y, v, g);
    }

    /// The first instant after `t` (s) at which `g` or a derivative of it by time may jump whatever the state: where a
    /// prescribed motion or load changes its law. Infinity if there is none.
    fn next_change(&self, _t: f64) -> f64 {
        f64::INFINITY
    }

    /// Number of event functions: how many [`events_into`](Self::events_into) sets.
    fn events(&self) -> usize {
        0
    }

    /// Sets the event functions, in any unit: continuous along a motion, and of one sign on each side of where `g` or a
    /// derivative of it is not continuous. For contacts they are the overlaps.
    ///
    /// What is left out costs a method of high order accuracy there, no more. May be called between any two calls of
    /// [`force_into`](Self::force_into).
    fn events_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], _events: &mut [f64]) {}

    /// Whether the state is still one that the model can mean. Called every few steps.
    ///
    /// # Errors
    /// [`Divergence`], which ends the run.
    fn check(&self, y: &[f64], v: &[f64]) -> Result<(), Divergence> {
        if all_finite(y) && all_finite(v) { Ok(()) } else { Err(Divergence::NotFinite) }
    }
}

/// Whether all values are numbers. All are looked at, which several at a time makes faster than to stop at the first.
pub(crate) fn all_finite(values: &[f64]) -> bool {
    values.iter().fold(true, |finite, value| finite & value.is_finite())
}

/// Why a state means nothing any more.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Divergence {
    /// A value is infinite or not a number.
    #[error("a value is infinite or not a number")]
    NotFinite,
    /// The equations of a step were not solved.
    #[error(
        "the equations of a step were not solved in {iterations} iterations: the last changed the force by {change:.1e} of its size"
    )]
    NotSolved {
        /// Iterations of Newton's method.
        iterations: u32,
        /// Last change of the force, relative.
        change: f64,
    },
    /// No step is short enough for the tolerance.
    #[error("no step is short enough for the tolerance: tried down to {step:.1e} s")]
    NoStep {
        /// The last one tried, s.
        step: f64,
    },
    /// A coordinate left the range that the model holds for.
    #[error("{what} is {} {unit}, beyond {} {unit}", Brief::rounded(*value, 4), Brief::rounded(*limit, 4))]
    OutOfRange {
        /// Which quantity.
        what: String,
        /// Its value.
        value: f64,
        /// The largest magnitude that the model can mean.
        limit: f64,
        /// Unit of both.
        unit: &'static str,
    },
}

/// Position and velocity at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a> {
    /// Number of the step that ends here; 0 is the start.
    pub step: u64,
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub y: &'a [f64],
    /// Velocities.
    pub v: &'a [f64],
}

/// Sees every step of a run, the start included.
pub trait Observer<S> {
    /// Called after each step with the system as it evaluated that step's force.
    fn observe(&mut self, system: &S, now: Instant<'_>);
}

/// Takes no record.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoRecord;

impl<S> Observer<S> for NoRecord {
    fn observe(&mut self, _system: &S, _now: Instant<'_>) {}
}

/// Coordinates and velocities at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub y: Vec<f64>,
    /// Velocities.
    pub v: Vec<f64>,
}

/// A sum of products of rank one; all rows have one entry a coordinate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tangent {
    /// Number of coordinates.
    pub(crate) dof: usize,
    /// Number of terms.
    pub(crate) terms: usize,
    /// [terms x 3 x dof]: left, position, velocity.
    values: Vec<f64>,
}

/// One product `left (position . d y + velocity . d v)`, each \[dof\].
#[derive(Debug, PartialEq)]
pub struct TangentTerm<'a> {
    /// Direction in which the force changes.
    pub left: &'a mut [f64],
    /// By which displacements, 1/s^2 with `left` without unit.
    pub position: &'a mut [f64],
    /// By which velocities, 1/s.
    pub velocity: &'a mut [f64],
}

impl Tangent {
    /// No terms, for so many coordinates.
    #[must_use]
    pub fn new(dof: usize) -> Self {
        Self { dof, terms: 0, values: Vec::new() }
    }

    /// Takes all terms out; the memory stays.
    pub fn clear(&mut self) {
        self.terms = 0;
    }

    /// Adds a term of zeros, to be filled.
    pub(crate) fn add(&mut self) -> TangentTerm<'_> {
        let size = 3 * self.dof;
        let start = self.terms * size;
        self.terms += 1;
        self.values.resize(self.values.len().max(start + size), 0.0);
        let values = &mut self.values[start..start + size];
        values.fill(0.0);
        let (left, rest) = values.split_at_mut(self.dof);
        let (position, velocity) = rest.split_at_mut(self.dof);
        TangentTerm { left, position, velocity }
    }

    /// Row `left` of a term.
    #[must_use]
    pub(crate) fn left(&self, term: usize) -> &[f64] {
        self.row(3 * term)
    }

    /// Row `position` of a term.
    #[must_use]
    pub(crate) fn position(&self, term: usize) -> &[f64] {
        self.row(3 * term + 1)
    }

    /// Row `velocity` of a term.
    #[must_use]
    pub(crate) fn velocity(&self, term: usize) -> &[f64] {
        self.row(3 * term + 2)
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.dof..(row + 1) * self.dof]
    }

    /// Adds the change of force for a change of the state to `dg`, all \[dof\].
    pub fn apply(&self, dy: &[f64], dv: &[f64], dg: &mut [f64]) {
        for term in 0..self.terms {
            let factor = dot(self.position(term), dy) + dot(self.velocity(term), dv);
            for (dg, left) in dg.iter_mut().zip(self.left(term)) {
                *dg += factor * left;
            }
        }
    }
}

/// Sum of products, from the first on.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_blank_when_memory_is_used_again() {
        let mut tangent = Tangent::new(2);
        for factor in [3.0, 5.0] {
            tangent.clear();
            let term = tangent.add();
            term.left[0] = factor;
            term.position[1] = 2.0;
            let mut dg = [1.0, 1.0];
            tangent.apply(&[7.0, 0.5], &[9.0, 9.0], &mut dg);
            assert!((dg[0] - 1.0 - factor).abs() < 1e-15 && (dg[1] - 1.0).abs() < 1e-15);
            tangent.add().velocity[0] = 4.0;
            assert_eq!(tangent.terms, 2);
        }
        tangent.clear();
        tangent.add();
        assert_eq!(tangent.velocity(0), [0.0, 0.0]);
    }
}
