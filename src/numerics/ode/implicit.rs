//! Implicit methods of Newmark's family, solved for the acceleration at the end of the step by Newton's method.
//!
//! ```text
//! y1 = y0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1)      v1 = v0 + h ((1 - gamma) a0 + gamma a1)
//! (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) f1 + alpha_f f0      f = g - c v - w^2 y
//! ```
//!
//! - Average acceleration (Newmark 1959): `beta = 1/4`, `gamma = 1/2`, `alpha_m = alpha_f = 0`. Stable at every step on a linear
//!   system, and keeps its energy; motions with `h w` beyond 1 stay, with a wrong period.
//! - Generalized-alpha (Chung and Hulbert, J. Appl. Mech. 60 (1993) 371, equations 17, 18 and 25): of second order, and damps what
//!   the step does not resolve, by `rho_inf` a step at `h w` to infinity; 1 keeps it and 0 takes it out at once.
//!
//! The forces at both ends are weighted, not the states (Erlicher, Bonaventura and Bursi, Comput. Mech. 28 (2002) 83): the force
//! is evaluated at the samples themselves, and an equilibrium stays one.
//!
//! The iteration starts from `a1 = a0`. Its last correction is applied to the force by the tangent, at a change that no longer
//! counts ([`TOLERANCE`](super::newton::TOLERANCE)), so that the force belongs to the state without another evaluation.

use super::newton::{NewtonMatrix, Progress, Weights};
use super::{Divergence, Exchange, LinearCoordinate, SecondOrderSystem, SnapshotError, Statistics, Stepper, Tangent};

/// Parameters of a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Family {
    alpha_m: f64,
    alpha_f: f64,
    beta: f64,
    gamma: f64,
}

impl Family {
    pub(super) const AVERAGE_ACCELERATION: Self = Self { alpha_m: 0.0, alpha_f: 0.0, beta: 0.25, gamma: 0.5 };

    /// Of second order, with the least damping of low frequencies for its `spectral_radius` at high ones, 0 to 1.
    pub(super) fn generalized_alpha(spectral_radius: f64) -> Self {
        let alpha_m = (2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0);
        let alpha_f = spectral_radius / (spectral_radius + 1.0);
        let difference = 1.0 - alpha_m + alpha_f;
        Self { alpha_m, alpha_f, beta: 0.25 * difference * difference, gamma: difference - 0.5 }
    }
}

#[derive(Debug)]
pub(super) struct Implicit {
    h: f64,
    family: Family,
    weights: Weights,
    linear: Vec<LinearCoordinate>,
    matrix: NewtonMatrix,
    tangent: Tangent,
    /// At the last instant; none before the first step.
    acceleration: Option<Vec<f64>>,
    /// What the acceleration at the end does not change: of position and velocity, and `alpha_m a0 - alpha_f f0`.
    known_y: Vec<f64>,
    known_v: Vec<f64>,
    balance: Vec<f64>,
    /// Scratch: correction, and what it does to position and velocity.
    correction: Vec<f64>,
    dy: Vec<f64>,
    dv: Vec<f64>,
    statistics: Statistics,
}

impl Implicit {
    /// With equal steps of `h` (s).
    pub(super) fn new(system: &impl SecondOrderSystem, h: f64, family: Family) -> Self {
        let linear = system.linear().to_vec();
        let weights =
            Weights { force: 1.0 - family.alpha_f, position: family.beta * h * h, velocity: family.gamma * h };
        let diagonal = linear.iter().map(|coordinate| {
            let spring = weights.position * coordinate.squared_frequency;
            let damper = weights.velocity * coordinate.damping;
            (1.0 - family.alpha_m) + weights.force * (spring + damper)
        });
        let zeros = || vec![0.0; linear.len()];
        Self {
            h,
            family,
            weights,
            matrix: NewtonMatrix::new(diagonal.collect(), weights),
            tangent: Tangent::new(linear.len()),
            acceleration: None,
            known_y: zeros(),
            known_v: zeros(),
            balance: zeros(),
            correction: zeros(),
            dy: zeros(),
            dv: zeros(),
            statistics: Statistics { evaluations: 1, ..Statistics::default() },
            linear,
        }
    }

    /// Sets what is known from the start of the step, with `a` the acceleration there.
    fn begin(&mut self, y: &[f64], v: &[f64], g: &[f64], a: &[f64]) {
        let (h, family) = (self.h, self.family);
        for (i, linear) in self.linear.iter().enumerate() {
            self.known_y[i] = y[i] + h * v[i] + (0.5 - family.beta) * h * h * a[i];
            self.known_v[i] = v[i] + (1.0 - family.gamma) * h * a[i];
            self.balance[i] = family.alpha_m * a[i] - family.alpha_f * pull(linear, y[i], v[i], g[i]);
        }
    }

    /// The state that an acceleration at the end gives.
    fn place(&self, a: &[f64], y: &mut [f64], v: &mut [f64]) {
        for i in 0..a.len() {
            y[i] = self.known_y[i] + self.weights.position * a[i];
            v[i] = self.known_v[i] + self.weights.velocity * a[i];
        }
    }

    /// Sets the correction to what is out of balance; gives the Euclidean size of the forces that should balance, with
    /// those that cancel within `g`: to first order what a term's position makes of it.
    fn residual(&mut self, a: &[f64], y: &[f64], v: &[f64], g: &[f64]) -> f64 {
        self.dy.fill(0.0);
        for term in 0..self.tangent.terms {
            let pairs = self.tangent.position(term).iter().zip(y);
            let force: f64 = pairs.map(|(row, y)| (row * y).abs()).sum();
            for (sum, left) in self.dy.iter_mut().zip(self.tangent.left(term)) {
                *sum += force * left.abs();
            }
        }
        let mut square = 0.0;
        for (i, linear) in self.linear.iter().enumerate() {
            let f = pull(linear, y[i], v[i], g[i]);
            let inertia = (1.0 - self.family.alpha_m) * a[i];
            self.correction[i] = self.weights.force * f - inertia - self.balance[i];
            let spring = linear.squared_frequency * y[i];
            let size = a[i].abs() + g[i].abs() + spring.abs() + self.dy[i];
            square += size * size;
        }
        square.sqrt()
    }

    /// Corrects the acceleration and gives the Euclidean size of the change of the force in the equations.
    fn correct(&mut self, a: &mut [f64]) -> f64 {
        self.matrix.solve_in_place(&self.tangent, &mut self.correction);
        let mut square = 0.0;
        for (i, change) in self.correction.iter().enumerate() {
            a[i] += change;
            self.dy[i] = self.weights.position * change;
            self.dv[i] = self.weights.velocity * change;
            // D da: with what the springs do
            let force = change.abs() + self.linear[i].squared_frequency * self.dy[i].abs();
            square += force * force;
        }
        square.sqrt()
    }

    fn solve<S: SecondOrderSystem>(
        &mut self,
        system: &mut S,
        t1: f64,
        a: &mut [f64],
        [y, v, g]: [&mut [f64]; 3],
    ) -> Result<(), Divergence> {
        let mut progress = Progress::default();
        loop {
            self.place(a, y, v);
            let Some(change) = self.iterate(system, t1, a, [y, v], g) else {
                return Err(progress.failed());
            };
            if progress.judge(change)? {
                self.place(a, y, v);
                self.tangent.apply(&self.dy, &self.dv, g);
                return Ok(());
            }
        }
    }

    /// One correction of the acceleration from the state that belongs to it, whose force is left in `g`. Gives the change of
    /// the force in units of its size, none if the equations are singular.
    fn iterate<S: SecondOrderSystem>(
        &mut self,
        system: &mut S,
        t1: f64,
        a: &mut [f64],
        [y, v]: [&[f64]; 2],
        g: &mut [f64],
    ) -> Option<f64> {
        self.tangent.clear();
        system.force_and_tangent_into(t1, y, v, g, &mut self.tangent);
        self.statistics.evaluations += 1;
        let size = self.residual(a, y, v, g);
        if !size.is_finite() {
            return Some(size);
        }
        if !self.matrix.factorise(&self.tangent) {
            return None;
        }
        self.statistics.solves += 1;
        let change = self.correct(a);
        // where there is no force at all, nothing changes
        Some(if change > 0.0 { change / size } else { 0.0 })
    }
}

/// The acceleration that all forces on a coordinate give it.
fn pull(linear: &LinearCoordinate, y: f64, v: f64, g: f64) -> f64 {
    g - linear.damping * v - linear.squared_frequency * y
}

impl<S: SecondOrderSystem> Stepper<S> for Implicit {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) -> Result<(), Divergence> {
        let mut a = self.acceleration.take().unwrap_or_else(|| {
            let coordinates = self.linear.iter().enumerate();
            coordinates.map(|(i, linear)| pull(linear, y[i], v[i], g[i])).collect()
        });
        self.begin(y, v, g, &a);
        self.solve(system, t1, &mut a, [y, v, g])?;
        self.acceleration = Some(a);
        self.statistics.steps += 1;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        self.statistics
    }

    fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        self.statistics.exchange(words)?;
        let mut known = self.acceleration.is_some();
        words.flag(&mut known)?;
        let zeros = || vec![0.0; if known { self.linear.len() } else { 0 }];
        let mut acceleration = self.acceleration.take().unwrap_or_else(zeros);
        words.numbers("accelerations", &mut acceleration)?;
        self.acceleration = known.then_some(acceleration);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::ode::implicit_tests::Impact;

    /// Changes of the iterations in one step from a state in contact.
    fn changes(system: &mut Impact, mut stepper: Implicit, [y, v]: [f64; 2]) -> Vec<f64> {
        let (mut g, mut a) = ([0.0], [0.0]);
        system.force_into(0.0, &[y], &[v], &mut g);
        a[0] = g[0];
        stepper.begin(&[y], &[v], &g, &a);
        let iterate = |_| {
            let (mut y, mut v) = ([0.0], [0.0]);
            stepper.place(&a, &mut y, &mut v);
            stepper.iterate(system, 0.0, &mut a, [&y, &v], &mut g)
        };
        (0..6).filter_map(iterate).collect()
    }

    #[test]
    fn newton_converges_quadratically_on_a_smooth_contact() {
        // far within a contact, steps of about 1 rad
        for damping in [0.0, 0.2] {
            let mut system = Impact::new(damping);
            for radius in [None, Some(0.8), Some(0.0)] {
                let stepper = match radius {
                    None => Implicit::new(&system, 1.0, Family::AVERAGE_ACCELERATION),
                    Some(radius) => Implicit::new(&system, 1.0, Family::generalized_alpha(radius)),
                };
                let changes = changes(&mut system, stepper, [0.5, 0.7]);
                println!("damping {damping}, {radius:?}: {changes:?}");
                // a change is the square of the one before times some curvature of the force: found 0.05 to 0.87
                for pair in changes.windows(2).filter(|pair| pair[0] < 0.3) {
                    let bound = (pair[0] * pair[0]).max(4.0 * f64::EPSILON);
                    assert!(pair[1] <= bound, "{damping} {radius:?}: {changes:?}");
                }
                // all digits after four
                assert!(changes[0] > 1e-2 && changes[4] < 1e-14, "{changes:?}");
            }
        }
    }
}
