//! What a step of a method makes of small motions, by the method itself.
//!
//! A step on a linear system is a matrix A, the amplification matrix, on position, velocity and what the method remembers. The
//! largest of `A^n x` goes as `rho^n` with the spectral radius rho of A, and a method is stable where `rho <= 1` (Hughes, The
//! Finite Element Method, 2000, section 9.1.2; of multistep methods Hairer, Norsett, Wanner, Solving ODEs I, 2nd ed., III.3). Here
//! `rho` is taken from n steps of the method itself on the [`Linearised`] system, from a start that holds all its motions: no
//! formula of a method is needed, and damping, modes and what a method remembers count as they do in a run.
//!
//! A system's small motions about a state: its linear part, and the force by its tangent there.
//!
//! ```text
//! y_i'' + damping_i y_i' + squared_frequency_i y_i = sum_k left_ki (position_k . y + velocity_k . y')
//! ```
//!
//! A method steps this as it steps the system itself, so that what it does to small motions needs no formula of its own.

use super::adams::Adams;
use super::steppers::stepper;
use super::system::dot;
use super::{Method, Schedule, SecondOrderSystem, TransientError};
use crate::numerics::ode::{LinearCoordinate, State, Tangent};
use std::ops::Range;

/// Growth a step, `ln rho`, above which a method is unstable: a motion then becomes e times as large in 2000 steps. What beats
/// without growing was found below half of it over a thousand steps.
pub const UNSTABLE: f64 = 5e-4;

/// Steps from which the growth is taken.
pub(super) const STEPS: u32 = 1000;

/// Size at which a motion has grown beyond doubt, in units of the start's.
const BEYOND_DOUBT: f64 = 1e30;

/// Parts into which the steps are cut: growth must go on over the last two.
const PARTS: usize = 4;

/// The golden section, whose multiples fill 0 to 1 evenly.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// How the largest small motion grows.
#[derive(Debug, Clone, PartialEq)]
pub struct Growth {
    /// `ln rho` of a step; zero or less where all motions shrink. Infinite where the method refuses the step.
    pub per_step: f64,
    /// Velocities in the end: those of what grows. None where the method refuses the step.
    pub motion: Vec<f64>,
}

impl Growth {
    /// Whether it is more than [`UNSTABLE`].
    #[must_use]
    pub(crate) fn is_unstable(&self) -> bool {
        self.per_step > UNSTABLE
    }
}

/// How the largest small motion of `system` grows in a step of length `h` (s), from so many `steps`; `fastest` (1/s) is the
/// order of its fastest motion. `ExponentialAdams` with a tolerance takes steps of that length too: what is small is below it.
#[must_use]
pub(crate) fn growth(system: &mut Linearised, method: Method, h: f64, fastest: f64, steps: u32) -> Growth {
    let infinite = Growth { per_step: f64::INFINITY, motion: Vec::new() };
    take(system, method, h, fastest, steps).unwrap_or(infinite)
}

fn take(system: &mut Linearised, method: Method, h: f64, fastest: f64, steps: u32) -> Result<Growth, TransientError> {
    let schedule = Schedule { interval: h, steps_per_interval: 1, intervals: u64::from(steps) };
    let mut stepper = match method {
        Method::ExponentialAdams { tolerance: Some(_) } => Box::new(Adams::new(&*system, h, Some(f64::INFINITY))),
        _ => stepper(&*system, method, &schedule, 0.0)?,
    };
    let dof = system.linear().len();
    let [mut y, mut v] = start(dof, fastest);
    let (mut g, mut before) = (vec![0.0; dof], v.clone());
    system.force_into(0.0, &y, &v, &mut g);
    let first = size(&v);
    // the largest size in each of equal parts of the run, of a sample at least
    let (mut largest, samples) = ([0.0; PARTS], steps.max(PARTS as u32));
    for step in 0..steps {
        before.copy_from_slice(&v);
        let went = stepper.step(system, f64::from(step + 1) * h, &mut y, &mut v, &mut g);
        let now = size(&v);
        if went.is_err() || now.is_nan() || now > BEYOND_DOUBT * first {
            return Ok(Growth { per_step: BEYOND_DOUBT.ln() / f64::from(step + 1), motion: before });
        }
        let part = (u64::from(step) * PARTS as u64 / u64::from(samples)) as usize;
        let part = &mut largest[part.min(PARTS - 1)];
        *part = f64::max(*part, now);
    }
    // the lesser of the last two parts' growths, so that a beat or a steady drift counts little
    let [.., before, last, end] = largest;
    let logarithm = f64::ln(end / last).min(f64::ln(last / before));
    Ok(Growth { per_step: logarithm / (f64::from(samples) / PARTS as f64), motion: v })
}

/// All coordinates in motion, without pattern: velocities of the order 1, positions of the order `1 / fastest` (1/s).
fn start(dof: usize, fastest: f64) -> [Vec<f64>; 2] {
    // none is near zero
    let number = |k: usize| {
        let even = 2.0 * ((k + 1) as f64 * GOLDEN).fract() - 1.0;
        even + 0.2_f64.copysign(even)
    };
    [(0..dof).map(|i| number(2 * i + 1) / fastest).collect(), (0..dof).map(|i| number(2 * i)).collect()]
}

fn size(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// A system linearised at a state; its coordinates are the distances from there.
#[derive(Debug, Clone)]
pub struct Linearised {
    linear: Vec<LinearCoordinate>,
    /// What the force is by the tangent.
    pub(super) tangent: Tangent,
    /// Where the rows of each term are not zero: left, position, velocity.
    filled: Vec<[Range<usize>; 3]>,
    /// What each coordinate weighs beside a mode of unit mass, as far as the terms tell: a force that acts on both along what it
    /// depends on has `position_i / left_i` in proportion to the masses. 1 where none does.
    pub(super) masses: Vec<f64>,
    /// What each coordinate meets of the force as a spring of its own.
    springs: Vec<f64>,
}

impl Linearised {
    /// The small motions of `system` about `state`; of what its tangent leaves out nothing is known.
    pub fn new<S: SecondOrderSystem>(system: &mut S, state: &State) -> Self {
        let mut tangent = Tangent::new(state.y.len());
        system.tangent_into(state.t, &state.y, &state.v, &mut tangent);
        let filled = (0..tangent.terms).map(|term| {
            let rows = [tangent.left(term), tangent.position(term), tangent.velocity(term)];
            rows.map(filled)
        });
        let linear = system.linear().to_vec();
        let [mut springs, mut sizes] = [0, 1].map(|_| vec![0.0; linear.len()]);
        system.own_springs_into(&mut springs, &mut sizes);
        Self { springs, filled: filled.collect(), masses: masses(&linear, &tangent), linear, tangent }
    }
}

impl SecondOrderSystem for Linearised {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        g.fill(0.0);
        for (term, [left, position, velocity]) in self.filled.iter().enumerate() {
            let at =
                |row: &[f64], values: &[f64], filled: &Range<usize>| dot(&row[filled.clone()], &values[filled.clone()]);
            let factor = at(self.tangent.position(term), y, position) + at(self.tangent.velocity(term), v, velocity);
            let pairs = g[left.clone()].iter_mut();
            for (g, left) in pairs.zip(&self.tangent.left(term)[left.clone()]) {
                *g += factor * left;
            }
        }
    }

    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        tangent.clone_from(&self.tangent);
    }

    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        springs.copy_from_slice(&self.springs);
        sizes.fill(0.0);
    }
}

fn masses(linear: &[LinearCoordinate], tangent: &Tangent) -> Vec<f64> {
    let mut masses = vec![1.0; linear.len()];
    for term in 0..tangent.terms {
        let (left, position) = (tangent.left(term), tangent.position(term));
        let modes = (0..linear.len()).filter(|&i| linear[i].squared_frequency > 0.0);
        // the mode that the force moves most
        let most = modes.max_by(|&a, &b| left[a].abs().total_cmp(&left[b].abs()));
        let Some(stiffness) = most.map(|mode| position[mode] / left[mode]) else {
            continue;
        };
        for (i, mass) in masses.iter_mut().enumerate() {
            let found = position[i] / left[i] / stiffness;
            if linear[i].squared_frequency <= 0.0 && found > 0.0 && found.is_finite() {
                *mass = found;
            }
        }
    }
    masses
}

/// From the first value that is not zero to the last.
fn filled(row: &[f64]) -> Range<usize> {
    let is_filled = |value: &f64| *value != 0.0;
    let first = row.iter().position(is_filled).unwrap_or(0);
    let end = row.iter().rposition(is_filled).map_or(0, |last| last + 1);
    first..end
}

#[cfg(test)]
mod tests {
    use super::super::tests::Oscillator;
    use super::*;
    use crate::numerics::ode::State;

    const ADAMS: Method = Method::ExponentialAdams { tolerance: None };

    /// Growth a step of `y'' + (w^2 + k) y = 0` with k in the force, `k = stiffness w^2`, at a phase `h w`.
    fn of_oscillator(method: Method, stiffness: f64, phase: f64) -> Growth {
        let w = 3.0;
        let mut oscillator = Oscillator::new(0.0);
        oscillator.linear[0].damping = 0.0;
        oscillator.outside = stiffness * w * w;
        let rest = State { t: 0.0, y: vec![0.0], v: vec![0.0] };
        let mut linearised = Linearised::new(&mut oscillator, &rest);
        growth(&mut linearised, method, phase / w, w, 4 * STEPS)
    }

    /// Spectral radius of a two-step recursion `y2 - 2 a y1 + y0 = 0`.
    fn of_recursion(a: f64) -> f64 {
        if a.abs() <= 1.0 { 0.0 } else { (a.abs() + (a * a - 1.0).sqrt()).ln() }
    }

    /// Gautschi's recursion `y2 - 2 cos y1 + y0 = -4 sin^2(phase / 2) s y1`, and that of the kicks
    /// `y2 - 2 cos y1 + y0 = -s phase sin(phase) y1`: at a phase near pi both grow, with a contact a twentieth as stiff as the mode.
    #[test]
    fn growth_at_a_resonance_is_the_recursions() {
        let s = 0.05;
        for phase in [0.5, 2.0, 2.6, 2.9, 3.0, 3.1, 3.2, 3.4, 6.2, 6.5] {
            let (cos, sin) = (f64::cos(phase), f64::sin(phase));
            let half = f64::sin(0.5 * phase);
            for (method, a) in
                [(Method::Exponential, cos - 2.0 * s * half * half), (Method::Splitting, cos - 0.5 * s * phase * sin)]
            {
                let (found, expected) = (of_oscillator(method, s, phase), of_recursion(a));
                // what beats is below UNSTABLE; a fast growth is taken from some 150 steps, of which the start takes a few
                assert!(
                    (found.per_step.max(0.0) - expected).abs() < 0.5 * UNSTABLE + 0.05 * expected,
                    "{method:?} {phase}: {found:?}, {expected}"
                );
            }
        }
    }

    #[test]
    fn implicit_methods_never_grow_and_adams_does_not_hold_what_it_does_not_resolve() {
        for phase in [0.1, 1.0, 3.0, 30.0] {
            for method in [Method::Newmark, Method::GeneralizedAlpha { spectral_radius: 0.8 }] {
                assert!(!of_oscillator(method, 0.5, phase).is_unstable());
            }
        }
        assert!(!of_oscillator(ADAMS, 0.05, 0.3).is_unstable());
        assert!(of_oscillator(ADAMS, 0.05, 2.5).is_unstable());
    }

    #[test]
    fn a_step_that_is_refused_grows_without_bound() {
        let grown = of_oscillator(Method::NewmarkExplicit, 0.1, 2.1);
        assert!(grown.per_step.is_infinite() && grown.is_unstable());
    }
}
