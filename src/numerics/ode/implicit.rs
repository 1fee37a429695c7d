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
//! counts ([`TOLERANCE`](TOLERANCE)), so that the force belongs to the state without another evaluation.
//!
//! Newton's method for the accelerations at the end of a step: the equations of a correction, and when to stop.
//!
//! With `dy = a_y da` and `dv = a_v da` the matrix is diagonal but for the tangent of `g`,
//!
//! ```text
//! J = D - weight sum_k left_k (a_y position_k + a_v velocity_k)^T = D - L R^T      [n x n], L and R [n x r]
//! ```
//!
//! so that by the identity of Woodbury (Golub and Van Loan, Matrix Computations, 4th ed., section 2.1.4) a correction costs a
//! system of order r, the number of terms: `J^-1 b = z + D^-1 L (1 - R^T D^-1 L)^-1 R^T z`, `z = D^-1 b`.

use super::system::dot;
use super::{Divergence, Exchange, LinearCoordinate, SecondOrderSystem, SnapshotError, Statistics, Stepper, Tangent};
use crate::numerics::linalg::SmallLu;

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

/// Change of the force at which the iteration ends, in units of its size. One step of 0.1 rad errs by 1e-4 of the force, one of
/// 1e-2 rad by 1e-7.
pub(super) const TOLERANCE: f64 = 1e-10;

/// Corrections in a step, far more than it takes: two or three, some more where contact begins or ends in it.
pub(super) const MAX_ITERATIONS: u32 = 30;

/// What one correction costs a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// Equations for the r terms: r^2 n + r^3 / 3 products.
    Terms,
    /// For the n coordinates: r n^2 + n^3 / 3 products.
    Coordinates,
}

/// How position, velocity and force change with the unknown acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weights {
    /// Of the force at the end in the equations.
    pub force: f64,
    /// dy / da, s^2.
    pub position: f64,
    /// dv / da, s.
    pub velocity: f64,
}

/// The matrix of a correction, factorised; its memory stays.
#[derive(Debug, Clone)]
pub(super) struct NewtonMatrix {
    weights: Weights,
    /// D.
    diagonal: Vec<f64>,
    /// R [terms x dof].
    rows: Vec<f64>,
    lu: SmallLu,
    way: Way,
    /// One number a term.
    small: Vec<f64>,
}

impl NewtonMatrix {
    pub(super) fn new(diagonal: Vec<f64>, weights: Weights) -> Self {
        Self { weights, diagonal, rows: Vec::new(), lu: SmallLu::default(), way: Way::Terms, small: Vec::new() }
    }

    /// Takes a tangent in, the cheaper way. Gives whether the matrix is regular.
    #[must_use]
    pub(super) fn factorise(&mut self, tangent: &Tangent) -> bool {
        let way = if tangent.terms <= tangent.dof { Way::Terms } else { Way::Coordinates };
        self.factorise_by(way, tangent)
    }

    fn factorise_by(&mut self, way: Way, tangent: &Tangent) -> bool {
        self.way = way;
        self.set_rows(tangent);
        let (n, terms) = (tangent.dof, tangent.terms);
        let rows = || self.rows.chunks_exact(n.max(1));
        match way {
            Way::Terms => {
                let matrix = self.lu.fill(terms);
                for (k, row) in rows().enumerate() {
                    for l in 0..terms {
                        matrix[k * terms + l] = -dot(row, tangent.left(l));
                    }
                    matrix[k * terms + k] += 1.0;
                }
            }
            Way::Coordinates => {
                let matrix = self.lu.fill(n);
                for (k, row) in rows().enumerate() {
                    for (matrix, left) in matrix.chunks_exact_mut(n).zip(tangent.left(k)) {
                        if *left != 0.0 {
                            add_scaled(matrix, -left, row);
                        }
                    }
                }
                for (i, diagonal) in self.diagonal.iter().enumerate() {
                    matrix[i * n + i] += diagonal;
                }
            }
        }
        self.lu.factorise()
    }

    /// R, with `D^-1` in it for the way by terms.
    fn set_rows(&mut self, tangent: &Tangent) {
        let Weights { force, position, velocity } = self.weights;
        self.rows.clear();
        for term in 0..tangent.terms {
            let parts = tangent.position(term).iter().zip(tangent.velocity(term));
            let row = parts.map(|(y, v)| force * (position * y + velocity * v));
            match self.way {
                Way::Terms => self.rows.extend(row.zip(&self.diagonal).map(|(row, diagonal)| row / diagonal)),
                Way::Coordinates => self.rows.extend(row),
            }
        }
    }

    /// Overwrites `b` \[dof\] by `J^-1 b`; the tangent is that of the last factorisation.
    pub(super) fn solve_in_place(&mut self, tangent: &Tangent, b: &mut [f64]) {
        match self.way {
            Way::Coordinates => self.lu.solve_in_place(b),
            Way::Terms => {
                self.small.clear();
                let rows = self.rows.chunks_exact(b.len().max(1));
                self.small.extend(rows.map(|row| dot(row, b)));
                self.lu.solve_in_place(&mut self.small);
                for (term, factor) in self.small.iter().enumerate() {
                    add_scaled(b, *factor, tangent.left(term));
                }
                for (b, diagonal) in b.iter_mut().zip(&self.diagonal) {
                    *b /= diagonal;
                }
            }
        }
    }
}

/// The corrections of one step so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Progress {
    iterations: u32,
    last: Option<f64>,
}

impl Progress {
    /// Judges a correction of size `change` in units of the force: whether what it leaves is below [`TOLERANCE`]. With `rate` the ratio to the last change, what is left
    /// after this one is `change rate / (1 - rate)` at most (Hairer and Wanner, Solving Ordinary Differential Equations II,
    /// 2nd ed., section IV.8), less where the rate falls from one to the next as it does here.
    ///
    /// # Errors
    /// [`Divergence::NotFinite`], [`Divergence::NotSolved`].
    pub(super) fn judge(&mut self, change: f64) -> Result<bool, Divergence> {
        self.iterations += 1;
        if !change.is_finite() {
            return Err(Divergence::NotFinite);
        }
        let left = match self.last.replace(change) {
            Some(last) if change < last => change * change / (last - change),
            _ => change,
        };
        let is_solved = left.min(change) <= TOLERANCE;
        if !is_solved && self.iterations >= MAX_ITERATIONS {
            return Err(Divergence::NotSolved { iterations: self.iterations, change });
        }
        Ok(is_solved)
    }

    /// What to say when a correction has no solution.
    pub(super) fn failed(&self) -> Divergence {
        Divergence::NotSolved { iterations: self.iterations, change: self.last.unwrap_or(1.0) }
    }
}

fn add_scaled(sum: &mut [f64], factor: f64, row: &[f64]) {
    for (sum, row) in sum.iter_mut().zip(row) {
        *sum += factor * row;
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

#[cfg(test)]
mod newton_tests {
    use super::*;

    /// Terms of all sizes without pattern.
    fn some_tangent(dof: usize, terms: usize) -> Tangent {
        let mut tangent = Tangent::new(dof);
        let mut place = 0.0;
        let mut next = || {
            place += 1.0;
            f64::sin(place * place)
        };
        for _ in 0..terms {
            let term = tangent.add();
            for i in 0..dof {
                term.left[i] = next();
                term.position[i] = 1e4 * next();
                term.velocity[i] = 10.0 * next();
            }
        }
        tangent
    }

    #[test]
    fn both_ways_give_one_answer_that_solves_the_equations() {
        let weights = Weights { force: 0.6, position: 2.5e-5, velocity: 5e-3 };
        for (dof, terms) in [(9, 0), (9, 3), (5, 5), (4, 7), (1, 2)] {
            let tangent = some_tangent(dof, terms);
            let diagonal: Vec<f64> = (0..dof).map(|i| 1.0 + (i * i) as f64).collect();
            let b: Vec<f64> = (0..dof).map(|i| 2.0 - i as f64).collect();
            let mut matrix = NewtonMatrix::new(diagonal.clone(), weights);
            let solutions = [Way::Terms, Way::Coordinates].map(|way| {
                assert!(matrix.factorise_by(way, &tangent));
                let mut x = b.clone();
                matrix.solve_in_place(&tangent, &mut x);
                x
            });
            for x in &solutions {
                // J x by the tangent itself
                let scaled = |factor: f64| x.iter().map(|x| factor * x).collect::<Vec<f64>>();
                let mut change = vec![0.0; dof];
                let (dy, dv) = (scaled(weights.position), scaled(weights.velocity));
                tangent.apply(&dy, &dv, &mut change);
                for i in 0..dof {
                    let left = diagonal[i] * x[i] - weights.force * change[i] - b[i];
                    // round-off of numbers up to 100 in a matrix of condition 100
                    assert!(left.abs() < 1e-12, "{dof} {terms}: {left:e}");
                }
            }
            for (a, b) in solutions[0].iter().zip(&solutions[1]) {
                assert!((a - b).abs() < 1e-12, "{dof} {terms}: {a} {b}");
            }
        }
    }

    #[test]
    fn few_terms_are_solved_by_terms_and_many_by_coordinates() {
        let weights = Weights { force: 1.0, position: 1e-6, velocity: 1e-3 };
        let mut matrix = NewtonMatrix::new(vec![1.0; 4], weights);
        for (terms, way) in [(4, Way::Terms), (5, Way::Coordinates), (0, Way::Terms)] {
            assert!(matrix.factorise(&some_tangent(4, terms)));
            assert_eq!(matrix.way, way);
        }
    }

    #[test]
    fn the_iteration_ends_by_what_a_correction_leaves() {
        // quadratic: after 1e-2, 1e-4 and 1e-8 nothing is left that counts; by the second, 1e-6 may be
        let mut progress = Progress::default();
        assert_eq!(progress.judge(1e-2), Ok(false));
        assert_eq!(progress.judge(1e-4), Ok(false));
        assert_eq!(progress.judge(1e-8), Ok(true));
        // growing changes end with an error, and so does what is not a number
        let mut progress = Progress::default();
        for _ in 1..MAX_ITERATIONS {
            assert_eq!(progress.judge(1.0), Ok(false));
        }
        let failed = Divergence::NotSolved { iterations: MAX_ITERATIONS, change: 1.0 };
        assert_eq!(progress.judge(1.0), Err(failed));
        assert_eq!(Progress::default().judge(f64::NAN), Err(Divergence::NotFinite));
    }
}
