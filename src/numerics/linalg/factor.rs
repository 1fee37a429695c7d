//! A factor with a measure of how good it is, in single precision where that serves.

use super::dense::pseudo_random;
use super::followers::Correction;
use super::memory::SMALL;
#[cfg(feature = "mumps")]
use super::mumps;
use super::numeric::NumericFactor;
use super::{Kind, LinalgError, Plan, SymmetricMatrix};
use faer::MatMut;
use std::sync::Arc;

/// Contraction above which a factor is refused. Its inverse is then right to a tenth, and its inertia is that of the
/// matrix.
pub(super) const LARGEST_CONTRACTION: f64 = 0.1;

/// Contraction of a factor in double precision above which the matrix is so ill-conditioned (1e8) that round-off in its
/// lowest modes is felt: a shift helps.
const DULL: f64 = 1e-8;

/// Vectors with which the contraction is measured, and how often it is applied to them: the first time brings out
/// the factor's worst directions, the second measures them.
const PROBES: (usize, usize) = (2, 2);

/// The entries of a factor.
#[derive(Debug)]
pub(super) enum Numbers {
    Single(NumericFactor<f32>),
    Double(NumericFactor<f64>),
    #[cfg(feature = "mumps")]
    Mumps(Box<mumps::Numbers>),
}

impl Numbers {
    /// Factorises a matrix as planned.
    fn new(
        plan: &Plan,
        a: &SymmetricMatrix,
        kind: Kind,
        double: bool,
        memory: FactorMemory,
    ) -> Result<Self, LinalgError> {
        Ok(match plan {
            Plan::Own(symbolic) if double || symbolic.entries() <= SMALL => {
                Self::Double(NumericFactor::new(symbolic, a, kind, memory.double)?)
            }
            Plan::Own(symbolic) => Self::Single(NumericFactor::new(symbolic, a, kind, memory.single)?),
            #[cfg(feature = "mumps")]
            Plan::Mumps { way, .. } => Self::Mumps(Box::new(mumps::Numbers::new(a, kind, *way, double)?)),
        })
    }

    /// `F^-1 B` in place for `B` [n x k].
    fn solve(&self, plan: &Plan, b: MatMut<'_, f64>) {
        match (self, plan) {
            (Self::Single(numbers), Plan::Own(symbolic)) => numbers.solve(symbolic, b),
            (Self::Double(numbers), Plan::Own(symbolic)) => numbers.solve(symbolic, b),
            #[cfg(feature = "mumps")]
            (Self::Mumps(numbers), _) => numbers.solve(b),
            // numbers are those of their own plan
            #[cfg(feature = "mumps")]
            _ => {
                let mut b = b;
                b.fill(f64::NAN);
            }
        }
    }

    /// Number of negative eigenvalues of the matrix.
    fn negative(&self, plan: &Plan) -> usize {
        match (self, plan) {
            (Self::Single(numbers), Plan::Own(symbolic)) => numbers.negative(symbolic),
            (Self::Double(numbers), Plan::Own(symbolic)) => numbers.negative(symbolic),
            #[cfg(feature = "mumps")]
            (Self::Mumps(numbers), _) => numbers.negative(),
            #[cfg(feature = "mumps")]
            _ => usize::MAX,
        }
    }
}

/// Factor F of a symmetric matrix A, in an order of its own.
///
/// **Quality.** The contraction is the factor by which one step of iterative refinement, `G = I - F^-1 A`, reduces an
/// error, estimated by powers of G. It judges the inertia too: on the way from F to A, `A_t = F - t (F - A)` for t
/// from 0 to 1, a sign can change only where `A_t` is singular, that is where G has the eigenvalue 1/t >= 1. A
/// spectral radius below 1 therefore proves that F and A have equally many negative eigenvalues, whatever the
/// precision in which F was computed.
#[derive(Debug)]
pub(super) struct Factor {
    /// Where its entries are.
    pub plan: Arc<Plan>,
    numbers: Numbers,
    /// What followers add to solutions and counts.
    correction: Option<Correction>,
    /// Estimate of the spectral radius of `I - F^-1 A`.
    pub contraction: f64,
    /// Row in which round-off is felt most: the largest entry of the error that refinement reduces least.
    pub weakest: usize,
}

/// Memory of a factor that is no longer needed, or none. A large one that is used again saves a page fault for each
/// 4 KiB, as long as the factor's own scattering of entries.
#[derive(Debug, Default)]
pub(super) struct FactorMemory {
    single: Vec<f32>,
    double: Vec<f64>,
}

impl Factor {
    /// Factorises `a` in the precision that its size calls for, and in double precision if single does not suffice.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`], [`LinalgError::Factorisation`], or [`LinalgError::NearlySingular`] if
    /// the factor in double precision does not solve its own system either.
    pub(super) fn new(
        plan: &Arc<Plan>,
        a: &SymmetricMatrix,
        kind: Kind,
        memory: FactorMemory,
    ) -> Result<Self, LinalgError> {
        match Self::quick(plan, a, kind, memory) {
            Err(LinalgError::NearlySingular { .. } | LinalgError::NotPositiveDefinite { .. })
                if plan.entries() > SMALL =>
            {
                Self::double(plan, a, kind)
            }
            done => done,
        }
    }

    /// Factorises `a`: in single precision if it is large, in double precision if it is small.
    ///
    /// # Errors
    /// As [`Factor::new`], already if single precision does not suffice.
    pub(super) fn quick(
        plan: &Arc<Plan>,
        a: &SymmetricMatrix,
        kind: Kind,
        memory: FactorMemory,
    ) -> Result<Self, LinalgError> {
        Self::unjudged(plan, a, kind, false, memory)?.judged()
    }

    /// Factorises `a` in double precision.
    ///
    /// # Errors
    /// As [`Factor::new`].
    pub(super) fn double(plan: &Arc<Plan>, a: &SymmetricMatrix, kind: Kind) -> Result<Self, LinalgError> {
        Self::unjudged(plan, a, kind, true, FactorMemory::default())?.judged()
    }

    /// Factorises `a` in the precision that its size calls for, or in double precision, whatever the quality: for an
    /// iteration that says itself how far it came.
    ///
    /// # Errors
    /// [`LinalgError::Factorisation`], [`LinalgError::NotPositiveDefinite`].
    pub(super) fn unjudged(
        plan: &Arc<Plan>,
        a: &SymmetricMatrix,
        kind: Kind,
        double: bool,
        memory: FactorMemory,
    ) -> Result<Self, LinalgError> {
        Ok(Self::measured(plan, a, Numbers::new(plan, a, kind, double, memory)?))
    }

    /// Whether its entries are in double precision.
    pub(super) fn is_double(&self) -> bool {
        match &self.numbers {
            Numbers::Single(_) => false,
            Numbers::Double(_) => true,
            #[cfg(feature = "mumps")]
            Numbers::Mumps(numbers) => numbers.is_double(),
        }
    }

    /// This factor of `a` with its entries rounded to single precision, half as much to read for every solve; `None` if it is
    /// small, or no longer sharp.
    pub(super) fn lightened(&self, a: &SymmetricMatrix) -> Option<Self> {
        match &self.numbers {
            Numbers::Double(numbers) if self.plan.entries() > SMALL => {
                let light = Self::measured(&self.plan, a, Numbers::Single(numbers.rounded()));
                light.is_sharp().then_some(light)
            }
            _ => None,
        }
    }

    /// # Errors
    /// [`LinalgError::Library`] if a solve by a library has failed, whose solutions are then no numbers.
    pub(super) fn check(&self) -> Result<(), LinalgError> {
        match &self.numbers {
            Numbers::Single(_) | Numbers::Double(_) => Ok(()),
            #[cfg(feature = "mumps")]
            Numbers::Mumps(numbers) => numbers.check(),
        }
    }

    fn judged(self) -> Result<Self, LinalgError> {
        self.check()?;
        match self.contraction {
            contraction if contraction <= LARGEST_CONTRACTION => Ok(self),
            contraction => Err(LinalgError::NearlySingular { order: self.plan.order(), contraction }),
        }
    }

    pub(super) fn measured(plan: &Arc<Plan>, a: &SymmetricMatrix, numbers: Numbers) -> Self {
        let mut factor =
            Self { plan: Arc::clone(plan), numbers, correction: None, contraction: f64::INFINITY, weakest: 0 };
        factor.correction = a.followers.as_ref().map(|followers| followers.correction(|b| factor.solve(b)));
        let mut error = pseudo_random(a.order(), PROBES.0, 0);
        for _ in 0..PROBES.1 {
            let before = error.norm_l2();
            let mut step = a.times(error.as_ref());
            factor.solve(step.as_mut());
            error -= &step;
            let after = error.norm_l2();
            // a factor that is no number must not pass for one without error
            factor.contraction = if before == 0.0 { 0.0 } else { after / before };
        }
        let rows = (0..a.order()).map(|row| (row, error.row(row).norm_max()));
        let weakest = rows.max_by(|a, b| a.1.total_cmp(&b.1));
        factor.weakest = weakest.map_or(0, |(row, _)| row);
        if !factor.contraction.is_finite() {
            factor.contraction = f64::INFINITY;
        }
        factor
    }

    /// Whether the matrix is well enough conditioned to iterate with.
    pub(super) fn is_sharp(&self) -> bool {
        self.contraction <= if self.is_double() { DULL } else { LARGEST_CONTRACTION }
    }

    /// The memory of its entries, for another factor.
    pub(super) fn into_memory(self) -> FactorMemory {
        match self.numbers {
            Numbers::Single(numbers) => FactorMemory { single: numbers.values, ..FactorMemory::default() },
            Numbers::Double(numbers) => FactorMemory { double: numbers.values, ..FactorMemory::default() },
            #[cfg(feature = "mumps")]
            Numbers::Mumps(_) => FactorMemory::default(),
        }
    }

    /// `F^-1 B` in place for `B` [n x k].
    pub(super) fn solve(&self, mut b: MatMut<'_, f64>) {
        self.numbers.solve(&self.plan, b.as_mut());
        if let Some(correction) = &self.correction {
            correction.apply(b);
        }
    }

    /// Number of negative eigenvalues of the matrix.
    pub(super) fn negative(&self) -> usize {
        let alone = self.numbers.negative(&self.plan);
        self.correction.as_ref().map_or(alone, |correction| correction.negative(alone))
    }
}

#[cfg(test)]
#[path = "incompressible_tests.rs"]
mod incompressible;

#[cfg(test)]
mod tests {
    use super::super::ordering::Ordering;
    use super::super::{DenseMatrix, Plan, TripletBuilder};
    use super::*;

    /// Chain of unit springs fixed at both ends, less sigma.
    fn chain(order: usize, sigma: f64) -> (Arc<Plan>, SymmetricMatrix) {
        let mut a = TripletBuilder::new(order, order);
        for row in 0..order {
            a.add(row, row, 2.0 - sigma);
            if row + 1 < order {
                a.add(row, row + 1, -1.0);
                a.add(row + 1, row, -1.0);
            }
        }
        let a = a.build();
        let ordering = Ordering::of(&a).expect("an order");
        let permuted = SymmetricMatrix::permuted(&a, &ordering);
        (Arc::new(Plan::of(&permuted).expect("analysed")), permuted)
    }

    fn value(j: usize, order: usize) -> f64 {
        2.0 - 2.0 * (j as f64 * std::f64::consts::PI / (order + 1) as f64).cos()
    }

    #[test]
    fn counts_the_eigenvalues_of_a_chain() {
        let order = 400;
        for below in [0, 1, 7, 200, 399] {
            let sigma = 0.4 * value(below, order) + 0.6 * value(below + 1, order);
            let (plan, a) = chain(order, sigma);
            let factor = Factor::new(&plan, &a, Kind::Indefinite, FactorMemory::default()).expect("regular");
            assert_eq!(factor.negative(), below);
            let single = NumericFactor::<f32>::new(plan.own(), &a, Kind::Indefinite, Vec::new()).expect("regular");
            let single = Factor::measured(&plan, &a, Numbers::Single(single));
            // single precision cannot tell eigenvalues 6e-5 apart where the largest is 4; it says so
            assert!(single.negative() == below || single.contraction > LARGEST_CONTRACTION);
        }
    }

    /// Between the two singular cases lies a factor's whole quality: refinement says which it is.
    #[test]
    fn a_shift_on_an_eigenvalue_is_noticed() {
        let order = 300;
        let on = value(17, order);
        let (plan, a) = chain(order, on);
        let result = Factor::new(&plan, &a, Kind::Indefinite, FactorMemory::default());
        assert!(matches!(result, Err(LinalgError::NearlySingular { .. })), "{result:?}");
        let (plan, a) = chain(order, on * (1.0 + 1e-6));
        let factor = Factor::new(&plan, &a, Kind::Indefinite, FactorMemory::default()).expect("regular");
        assert_eq!(factor.negative(), 17);
        assert!(factor.contraction < 1e-6, "{:e}", factor.contraction);
    }

    /// Single precision has seven digits: the contraction is about condition times 6e-8.
    #[test]
    fn contraction_grows_with_the_condition() {
        for (order, limits) in [(20, [1e-9, 1e-4]), (2000, [1e-6, f64::INFINITY])] {
            let (plan, a) = chain(order, 0.0);
            let numbers = NumericFactor::<f32>::new(plan.own(), &a, Kind::Definite, Vec::new()).expect("definite");
            let factor = Factor::measured(&plan, &a, Numbers::Single(numbers));
            let found = factor.contraction;
            assert!(found > limits[0] && found < limits[1], "{order} {found:e}");
        }
    }

    /// A factor in double precision that is rounded is as good as one computed in single precision, not better.
    #[test]
    fn a_rounded_factor_solves_to_single_precision() {
        for kind in [Kind::Definite, Kind::Indefinite] {
            let (plan, a) = chain(20, 0.0);
            let double = NumericFactor::<f64>::new(plan.own(), &a, kind, Vec::new()).expect("definite");
            let rounded = Factor::measured(&plan, &a, Numbers::Single(double.rounded()));
            let found = rounded.contraction;
            assert!(found > 1e-9 && found < 1e-4, "{found:e}");
        }
    }

    #[test]
    fn both_kinds_and_precisions_solve() {
        let (plan, a) = chain(90, 0.0);
        let x = pseudo_random(90, 3, 5);
        let b = a.times(x.as_ref());
        let error = |mut y: DenseMatrix, solve: &dyn Fn(&mut DenseMatrix)| {
            solve(&mut y);
            (y - &x).norm_max()
        };
        for kind in [Kind::Definite, Kind::Indefinite] {
            let double = NumericFactor::<f64>::new(plan.own(), &a, kind, Vec::new()).expect("definite");
            // condition 3300 times the unit round-off, and a factor of ten
            assert!(error(b.clone(), &|y| double.solve(plan.own(), y.as_mut())) < 1e-11);
            let single = NumericFactor::<f32>::new(plan.own(), &a, kind, Vec::new()).expect("definite");
            let lost = error(b.clone(), &|y| single.solve(plan.own(), y.as_mut()));
            assert!(lost < 3e-3 && lost > 1e-9, "{lost:e}");
        }
    }
}
