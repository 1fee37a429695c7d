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

use super::tangent::{Tangent, dot};
use crate::numerics::linalg::SmallLu;
use crate::numerics::ode::Divergence;

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
