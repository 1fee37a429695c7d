//! Supernodal factorisation `A = L L^T` or `A = L B L^T` in single or double precision, by faer.
//!
//! A matrix is scaled to a unit diagonal first: single precision then loses what is small beside its own row, not beside
//! the stiffest part of the model.
//!
//! A factorisation runs on one thread: faer's own threads make it slower (1.1 s instead of 0.6 s on two cores for a solid of
//! 60 000 degrees of freedom).

use super::LinalgError;
use super::symbolic::Symbolic;
use super::symmetric::SymmetricMatrix;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::perm::PermRef;
use faer::prelude::*;
use faer::sparse::linalg::cholesky::supernodal::{
    SupernodalIntranodeLbltRef, SupernodalLltRef, factorize_supernodal_numeric_intranode_lblt,
    factorize_supernodal_numeric_intranode_lblt_scratch, factorize_supernodal_numeric_llt,
    factorize_supernodal_numeric_llt_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Mat, MatMut, Par};
use rayon::prelude::*;

/// Which factorisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// `L L^T`; the matrix must be positive definite.
    Definite,
    /// `L B L^T` with pivots of order one and two within each supernode (Bunch and Kaufman, Math. Comp. 31 (1977)
    /// 163-179).
    Indefinite,
}

/// A precision in which a factor is computed and kept.
pub(super) trait Precision: faer::traits::RealField + Copy {
    /// The nearest value.
    fn rounded(value: f64) -> Self;
    /// The value in double precision.
    fn exact(self) -> f64;
}

impl Precision for f32 {
    fn rounded(value: f64) -> Self {
        value as f32
    }
    fn exact(self) -> f64 {
        f64::from(self)
    }
}

impl Precision for f64 {
    fn rounded(value: f64) -> Self {
        value
    }
    fn exact(self) -> f64 {
        self
    }
}

/// Block-diagonal part of `L B L^T` off the diagonal, and the order of the pivots within the supernodes.
#[derive(Debug)]
struct Pivots<T> {
    below_diagonal: Vec<T>,
    old: Vec<u32>,
    new: Vec<u32>,
}

/// A numerical factor.
#[derive(Debug)]
pub(super) struct NumericFactor<T> {
    values: Vec<T>,
    /// `1 / sqrt |a_ii|`.
    scale: Vec<f64>,
    /// `None` for `L L^T`.
    pivots: Option<Pivots<T>>,
}

impl<T: Precision> NumericFactor<T> {
    /// Factorises a matrix with the analysed pattern; `memory`, which may be empty, is used again.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] for [`Kind::Definite`], [`LinalgError::Factorisation`].
    pub fn new(
        symbolic: &Symbolic,
        a: &SymmetricMatrix,
        kind: Kind,
        memory: Vec<T>,
    ) -> Result<Self, LinalgError> {
        let order = a.order();
        let failed = |reason| LinalgError::Factorisation { order, reason };
        let scale: Vec<f64> = a
            .diagonal()
            .into_iter()
            .map(|entry| {
                if entry == 0.0 {
                    1.0
                } else {
                    entry.abs().sqrt().recip()
                }
            })
            .collect();
        let scaled: Vec<T> = (0..order)
            .flat_map(|column| {
                let scale = &scale;
                a.column(column)
                    .map(move |(row, value)| T::rounded(scale[row] * value * scale[column]))
            })
            .collect();
        let pattern = SymbolicSparseColMatRef::new_checked(order, order, &a.offsets, None, &a.rows);
        let lower = SparseColMatRef::new(pattern, &scaled);
        let (supernodes, parallelism) = (&symbolic.supernodes, Par::Seq);
        let mut values = memory;
        values.truncate(supernodes.len_val());
        values
            .try_reserve_exact(supernodes.len_val() - values.len())
            .map_err(|_| failed("out of memory"))?;
        values.resize(supernodes.len_val(), T::rounded(0.0));
        let scratch = match kind {
            Kind::Definite => factorize_supernodal_numeric_llt_scratch::<u32, T>(
                supernodes,
                parallelism,
                Default::default(),
            ),
            Kind::Indefinite => factorize_supernodal_numeric_intranode_lblt_scratch::<u32, T>(
                supernodes,
                parallelism,
                Default::default(),
            ),
        };
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| failed("out of memory"))?;
        let stack = MemStack::new(&mut buffer);
        let pivots = match kind {
            Kind::Definite => {
                factorize_supernodal_numeric_llt(
                    &mut values,
                    lower,
                    Default::default(),
                    supernodes,
                    parallelism,
                    stack,
                    Default::default(),
                )
                .map_err(|LltError::NonPositivePivot { index }| {
                    LinalgError::NotPositiveDefinite {
                        order,
                        pivot: index,
                    }
                })?;
                None
            }
            Kind::Indefinite => {
                let mut pivots = Pivots {
                    below_diagonal: vec![T::rounded(0.0); order],
                    old: vec![0; order],
                    new: vec![0; order],
                };
                factorize_supernodal_numeric_intranode_lblt(
                    &mut values,
                    &mut pivots.below_diagonal,
                    &mut pivots.old,
                    &mut pivots.new,
                    lower,
                    supernodes,
                    parallelism,
                    stack,
                    Default::default(),
                );
                Some(pivots)
            }
        };
        Ok(Self {
            values,
            scale,
            pivots,
        })
    }

    /// The memory of its entries, for another factor.
    pub fn into_memory(self) -> Vec<T> {
        self.values
    }

    /// `A^-1 B` in place for `B` [n x k]. Threads share the columns.
    pub fn solve(&self, symbolic: &Symbolic, b: MatMut<'_, f64>) {
        let width = b.ncols().div_ceil(rayon::current_num_threads()).max(1);
        b.par_col_chunks_mut(width)
            .for_each(|columns| self.solve_columns(symbolic, columns));
    }

    /// Where a row of the factor is in the matrix.
    fn place(&self, row: usize) -> usize {
        match &self.pivots {
            None => row,
            Some(pivots) => pivots.old[row] as usize,
        }
    }

    fn solve_columns(&self, symbolic: &Symbolic, mut b: MatMut<'_, f64>) {
        let mut x = Mat::<T>::zeros(self.scale.len(), b.ncols());
        for column in 0..b.ncols() {
            let from = b.rb().col(column);
            for (row, entry) in x.col_as_slice_mut(column).iter_mut().enumerate() {
                let place = self.place(row);
                *entry = T::rounded(self.scale[place] * from[place]);
            }
        }
        self.solve_scaled(symbolic, x.as_mut());
        for column in 0..b.ncols() {
            let mut to = b.rb_mut().col_mut(column);
            for (row, entry) in x.col_as_slice(column).iter().enumerate() {
                let place = self.place(row);
                to[place] = self.scale[place] * entry.exact();
            }
        }
    }

    fn solve_scaled(&self, symbolic: &Symbolic, x: MatMut<'_, T>) {
        let (supernodes, parallelism) = (&symbolic.supernodes, Par::Seq);
        let scratch = supernodes.solve_in_place_scratch::<T>(x.ncols(), parallelism);
        let mut buffer = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut buffer);
        match &self.pivots {
            None => SupernodalLltRef::new(supernodes, &self.values).solve_in_place_with_conj(
                Conj::No,
                x,
                parallelism,
                stack,
            ),
            Some(pivots) => SupernodalIntranodeLbltRef::new(
                supernodes,
                &self.values,
                &pivots.below_diagonal,
                PermRef::new_checked(&pivots.old, &pivots.new, self.scale.len()),
            )
            .solve_in_place_no_numeric_permute_with_conj(
                Conj::No,
                x,
                parallelism,
                stack,
            ),
        }
    }

    /// Number of negative eigenvalues of the factorised matrix (Sylvester's law of inertia).
    pub fn negative(&self, symbolic: &Symbolic) -> usize {
        let Some(pivots) = &self.pivots else {
            return 0;
        };
        let supernodes = &symbolic.supernodes;
        let factor = SupernodalLltRef::new(supernodes, &self.values);
        let mut negative = 0;
        for index in 0..supernodes.n_supernodes() {
            let supernode = factor.supernode(index);
            let (block, start) = (supernode.val(), supernode.start());
            let mut column = 0;
            while column < block.ncols() {
                let diagonal = block[(column, column)].exact();
                let below = pivots.below_diagonal[start + column].exact();
                if below == 0.0 || column + 1 == block.ncols() {
                    negative += usize::from(diagonal < 0.0);
                    column += 1;
                } else {
                    let next = block[(column + 1, column + 1)].exact();
                    let determinant = diagonal * next - below * below;
                    negative += if determinant < 0.0 {
                        1
                    } else {
                        2 * usize::from(diagonal < 0.0)
                    };
                    column += 2;
                }
            }
        }
        negative
    }
}
