//! The problem `K x = lambda M x`, ordered and analysed, and what a solution of it must satisfy.

use super::super::bound::ROUNDING;
use super::super::{
    CountCheck, DenseMatrix, EigenPairs, EigenTimes, Factor, FactorChoice, Followers, LinalgError, Ordering, Plan,
    SparseCholesky, SparseMatrix, SymmetricMatrix, gigabytes, memory,
};
use std::sync::Arc;
use std::time::Instant;

/// Blocks [n x count] that are held at the same time, about.
const COPIES: u64 = 6;

/// Largest relative residual of a mode. That of a rigid mode is a ratio of round-off to the shift's term; a
/// frequency's relative error is below the square of it.
const LARGEST_RESIDUAL: f64 = 1e-5;

/// Stiffness K and mass M in the order in which they are factorised.
#[derive(Debug, Clone)]
pub struct EigenProblem {
    pub(super) ordering: Arc<Ordering>,
    pub(super) stiffness: SymmetricMatrix,
    pub(super) mass: SymmetricMatrix,
    pub(super) plan: Arc<Plan>,
    /// Factor of K, if somebody has it.
    pub(super) factor: Option<Arc<Factor>>,
    pub(super) order_s: f64,
}

impl EigenProblem {
    /// Orders and analyses `K x = lambda M x`; both matrices [n x n] symmetric, both triangles stored. Nothing of them
    /// is kept: the caller may drop them.
    ///
    /// # Errors
    /// [`LinalgError::Refused`] for a row without stiffness and mass, [`LinalgError::Factorisation`] of order and
    /// analysis.
    pub fn new(k: &SparseMatrix, m: &SparseMatrix) -> Result<Self, LinalgError> {
        let all: Vec<usize> = (0..k.rows()).collect();
        Self::restricted(k, m, &all)
    }

    /// The same over the rows and columns `kept` alone, ascending.
    ///
    /// # Errors
    /// As [`EigenProblem::new`].
    pub fn restricted(k: &SparseMatrix, m: &SparseMatrix, kept: &[usize]) -> Result<Self, LinalgError> {
        let started = Instant::now();
        let ordering = Ordering::of_problem(k, m, kept)?;
        Self::ordered([k, m], ordering, started)
    }

    /// The same over the rows and columns of an order.
    ///
    /// # Errors
    /// As [`EigenProblem::new`].
    pub(crate) fn in_order(matrices: [&SparseMatrix; 2], ordering: Ordering) -> Result<Self, LinalgError> {
        let started = Instant::now();
        let [k, m] = matrices;
        Self::ordered(matrices, ordering.of_determined(k, m)?, started)
    }

    fn ordered([k, m]: [&SparseMatrix; 2], ordering: Ordering, started: Instant) -> Result<Self, LinalgError> {
        let stiffness = SymmetricMatrix::permuted(k, &ordering);
        let mass = SymmetricMatrix::permuted(m, &ordering);
        let plan = Arc::new(if stiffness.covers(&mass) {
            Plan::of(&stiffness)?
        } else {
            Plan::of(&stiffness.shifted(1.0, &mass))?
        });
        Ok(Self {
            ordering: Arc::new(ordering),
            stiffness,
            mass,
            plan,
            factor: None,
            order_s: started.elapsed().as_secs_f64(),
        })
    }

    /// The problem over the rows and columns of an order, and the factor of K, which the problem shares. `followers` are what unknowns
    /// that follow those of K and M add to each.
    ///
    /// # Errors
    /// As [`EigenProblem::new`] and [`SparseCholesky::new`].
    pub(crate) fn factorised(
        [k, m]: [&SparseMatrix; 2],
        ordering: Ordering,
        followers: Option<[&Followers; 2]>,
    ) -> Result<(Self, SparseCholesky), LinalgError> {
        let started = Instant::now();
        let ordering = Arc::new(ordering);
        let permuted = |which: usize, a: &SparseMatrix| {
            let followers = followers.map(|both| both[which].permuted(&ordering));
            SymmetricMatrix { followers, ..SymmetricMatrix::permuted(a, &ordering) }
        };
        let (stiffness, mass) = rayon::join(|| permuted(0, k), || permuted(1, m));
        let order_s = started.elapsed().as_secs_f64();
        let cholesky = SparseCholesky::of_permuted(&stiffness, Arc::clone(&ordering))?;
        let factor = cholesky.factor();
        let plan = if stiffness.covers(&mass) {
            Arc::clone(&factor.plan)
        } else {
            Arc::new(Plan::of(&stiffness.shifted(1.0, &mass))?)
        };
        Ok((Self { ordering, stiffness, mass, plan, factor: Some(factor), order_s }, cholesky))
    }

    /// Who factorises, if not our own factor.
    pub(crate) fn factor_choice(&self) -> Option<FactorChoice> {
        self.plan.choice()
    }

    /// Number of degrees of freedom.
    pub fn order(&self) -> usize {
        self.stiffness.order()
    }

    /// Round-off of `x^T K x` where zero should be, 1/s^2: that of the motion in which all unknowns are equal, of unit mass, as far as there
    /// is mass. Motions of a rigid body have as much to an order of magnitude.
    pub(crate) fn rounding_of_zero(&self) -> f64 {
        let n = self.order();
        let ones = DenseMatrix::from_fn(n, 1, |_, _| 1.0);
        let mass: f64 = self.mass.times(ones.as_ref()).col_as_slice(0).iter().sum();
        let scatter: f64 = self.stiffness.energy_scatters(ones.as_ref()).iter().sum();
        let rounding = ROUNDING * f64::EPSILON * scatter / mass;
        if rounding.is_finite() { rounding } else { 0.0 }
    }

    /// `K X` for `X` [n x k].
    pub(crate) fn stiffness_times(&self, x: &DenseMatrix) -> DenseMatrix {
        self.stiffness.times_kept(&self.ordering, x)
    }

    /// `M X` for `X` [n x k].
    pub(crate) fn mass_times(&self, x: &DenseMatrix) -> DenseMatrix {
        self.mass.times_kept(&self.ordering, x)
    }

    /// An error if there is no memory for so many pairs.
    pub(super) fn find_room(&self, count: usize) -> Result<(), LinalgError> {
        let order = self.order();
        let bytes = 8 * COPIES * order as u64 * count as u64;
        match memory::available() {
            Some(free) if bytes > free.bytes => Err(LinalgError::Refused(format!(
                "{count} modes of {order} degrees of freedom take at least {}, {free}; ask for fewer modes",
                gigabytes(bytes)
            ))),
            _ => Ok(()),
        }
    }

    /// The pairs of the problem as it was given; `judged` are in the order of the factor.
    ///
    /// # Errors
    /// [`LinalgError::Iteration`] for a pair that does not satisfy its equation.
    pub(super) fn finished(
        &self,
        judged: EigenPairs,
        count_check: CountCheck,
        times: EigenTimes,
    ) -> Result<EigenPairs, LinalgError> {
        let too_large = |residual: &f64| residual.is_nan() || *residual > LARGEST_RESIDUAL;
        if let Some(mode) = judged.residuals.iter().position(too_large) {
            let residual = judged.residuals[mode];
            return Err(LinalgError::Iteration(format!(
                "mode {mode} leaves a relative residual of {residual:.3e} in its eigenvalue equation, more than \
                 {LARGEST_RESIDUAL:.0e}: the matrices are too ill-conditioned"
            )));
        }
        let mut vectors = DenseMatrix::zeros(self.order(), judged.values.len());
        self.ordering.backward(&judged.vectors, &mut vectors);
        Ok(EigenPairs { vectors, count_check, times, ..judged })
    }
}
