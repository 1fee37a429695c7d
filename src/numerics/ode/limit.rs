//! Largest stable step of a method at a state, searched upward by what its steps make of small motions there.
//!
//! Stability need not end at one step: where the phase `h omega` of a mode that is held exactly is near a multiple of pi, the
//! contacts can drive it (Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., XIII.1 and XIII.8). Such a
//! [`Resonance`] is told apart from the limit by what grows.

use super::amplification::STEPS;
use super::system::dot;
use super::{Growth, Linearised, Method, Resonance, SecondOrderSystem, State, StepLimit, Tangent, growth};
use crate::numerics::linalg::{DenseMatrix, general_spectrum};
use std::f64::consts::{PI, TAU};

/// Steps that are tried, in units of the fastest motion's time: the first one, the ratio of two, and the last one.
const FIRST: f64 = 0.2;
const RATIO: f64 = 1.1;
const LAST: f64 = 6.0;

/// Halvings of the logarithm between the last stable step and the first unstable one: to 4e-4 of it.
const HALVINGS: usize = 8;

/// Distance of a phase from a multiple of pi, in units of pi, within which growth in a mode is a resonance.
const NEAR: f64 = 0.25;

/// Steps of a growth reach over so many radians of the contacts' fastest motion, with this many at most.
const RADIANS: f64 = 200.0;
const MOST_STEPS: f64 = 20_000.0;

impl Resonance {
    /// The resonance that a growth of a system in steps of `h` (s) is, if it is one: what grows has most of its kinetic energy in
    /// a mode whose phase is near a multiple of pi.
    #[must_use]
    pub(crate) fn of(found: &Growth, system: &Linearised, h: f64) -> Option<Self> {
        if !found.is_unstable() {
            return None;
        }
        let energies = found.motion.iter().zip(&system.masses);
        let energies = energies.map(|(v, mass)| mass * v * v).enumerate();
        let (coordinate, _) = energies.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let omega = system.linear()[coordinate].squared_frequency.sqrt();
        let phase = h * omega / PI;
        let multiple = phase.round();
        let near = multiple >= 1.0 && (phase - multiple).abs() < NEAR;
        near.then_some(Self { mode_hz: omega / TAU, multiple: multiple as u32 })
    }
}

impl Method {
    /// The method's limit at a state of a system. None for the implicit methods, for `dop853`, whose tolerance is its limit, and
    /// where nothing grows in steps up to some periods of the fastest motion.
    ///
    /// `ExponentialAdams` with a tolerance refers that to the largest force: in longer steps than this motions that are small beside it
    /// grow until they are of the tolerance's size, and stay there.
    ///
    /// What the system leaves out of its tangent is not seen.
    pub(crate) fn step_limit<S: SecondOrderSystem>(self, system: &mut S, state: &State) -> Option<StepLimit> {
        self.limit_up_to(&mut Linearised::new(system, state), f64::INFINITY)
    }

    /// The same where it is below `longest` (s), which ends the search: of a longer one nothing is said.
    pub(crate) fn step_limit_below<S: SecondOrderSystem>(
        self,
        system: &mut S,
        state: &State,
        longest: f64,
    ) -> Option<StepLimit> {
        let limit = self.limit_up_to(&mut Linearised::new(system, state), longest);
        limit.filter(|limit| limit.step_s < longest)
    }

    /// The resonance of a step of length `h` (s) at a state, if small motions there grow by one.
    pub(crate) fn resonance<S: SecondOrderSystem>(self, system: &mut S, state: &State, h: f64) -> Option<Resonance> {
        if self.chooses_its_steps() {
            return None;
        }
        let mut linearised = Linearised::new(system, state);
        let fastest = fastest(&linearised)?;
        let found = growth(&mut linearised, self, h, fastest, STEPS);
        Resonance::of(&found, &linearised, h)
    }

    /// [`step_limit`](Self::step_limit) of a system that is linear already.
    pub(crate) fn limit_of(self, system: &mut Linearised) -> Option<StepLimit> {
        self.limit_up_to(system, f64::INFINITY)
    }

    fn limit_up_to(self, system: &mut Linearised, longest: f64) -> Option<StepLimit> {
        if self.is_implicit() || matches!(self, Self::Dop853 { .. }) {
            return None;
        }
        let contacts = fastest(system)?;
        let mut fastest = contacts;
        if self == Self::NewmarkExplicit {
            let squares = system.linear().iter().map(|held| held.squared_frequency);
            fastest = squares.fold(fastest, |most, square| most.max(square.sqrt()));
        }
        let unstable = |system: &mut Linearised, h: f64| {
            let steps = (RADIANS / (contacts * h)).clamp(f64::from(STEPS), MOST_STEPS);
            let found = growth(system, self, h, fastest, steps as u32);
            found.is_unstable() && Resonance::of(&found, system, h).is_none()
        };
        let first = match self {
            // a mode has a limit that is known, and contacts shorten it little
            Self::NewmarkExplicit if fastest > contacts => 4.0 * FIRST,
            _ => FIRST,
        };
        let mut stable = first / fastest;
        while unstable(system, stable) {
            stable /= 2.0;
            if stable * fastest < 1e-3 {
                return None;
            }
        }
        let mut grows = stable * RATIO;
        while !unstable(system, grows) {
            stable = grows;
            grows *= RATIO;
            if grows * fastest > LAST || stable >= longest {
                return None;
            }
        }
        for _ in 0..HALVINGS {
            let middle = (stable * grows).sqrt();
            if unstable(system, middle) {
                grows = middle;
            } else {
                stable = middle;
            }
        }
        let explicit = match self {
            Self::NewmarkExplicit => of_coordinates(system),
            _ => of_terms(&system.tangent, Tangent::position),
        };
        Some(StepLimit { step_s: stable, highest_hz: largest_real_part(&explicit)?.sqrt() / TAU })
    }
}

/// The order of the fastest motion that the force alone makes, 1/s: its frequency, or the rate of its damping where that is
/// larger. None where it makes none.
#[must_use]
pub(crate) fn fastest(system: &Linearised) -> Option<f64> {
    let tangent = &system.tangent;
    let frequency = largest_real_part(&of_terms(tangent, Tangent::position))?.sqrt();
    let rate = largest_real_part(&of_terms(tangent, Tangent::velocity))?;
    let fastest = frequency.max(rate);
    (fastest > 0.0).then_some(fastest)
}

/// `-row_k . left_l`, \[terms x terms\]: its eigenvalues that are not zero are those of the sum of the terms.
fn of_terms(tangent: &Tangent, row: impl Fn(&Tangent, usize) -> &[f64]) -> DenseMatrix {
    let terms = tangent.terms;
    DenseMatrix::from_fn(terms, terms, |k, l| -dot(row(tangent, k), tangent.left(l)))
}

/// Linear part and tangent, \[dof x dof\].
fn of_coordinates(system: &Linearised) -> DenseMatrix {
    let tangent = &system.tangent;
    let dof = tangent.dof;
    let mut matrix = DenseMatrix::zeros(dof, dof);
    for (i, linear) in system.linear().iter().enumerate() {
        matrix[(i, i)] = linear.squared_frequency;
    }
    for term in 0..tangent.terms {
        for (j, position) in tangent.position(term).iter().enumerate() {
            for (i, left) in tangent.left(term).iter().enumerate() {
                matrix[(i, j)] -= left * position;
            }
        }
    }
    matrix
}

/// At least zero; none of a matrix with a value that is not finite.
fn largest_real_part(matrix: &DenseMatrix) -> Option<f64> {
    if matrix.nrows() == 0 {
        return Some(0.0);
    }
    let spectrum = general_spectrum(matrix).ok()?;
    let parts = spectrum.values.iter().map(|value| value.re);
    Some(parts.fold(0.0, f64::max))
}

#[cfg(test)]
#[path = "limit_tests.rs"]
mod tests;
