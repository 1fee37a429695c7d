//! Supernodal factorisation `A = L L^T` or `A = L B L^T` in single or double precision, by faer.
//!
//! A matrix is scaled to a unit diagonal first: single precision then loses what is small beside its own row, not beside
//! the stiffest part of the model.
//!
//! A factorisation runs on one thread: faer's own threads make it slower (1.1 s instead of 0.6 s on two cores for a solid of
//! 60 000 degrees of freedom).

use super::substitution::{Pivoting, Precision, Triangles, substitute};
use super::{LinalgError, Symbolic, SymmetricMatrix};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::prelude::*;
use faer::sparse::linalg::cholesky::supernodal::{
    SupernodalLltRef, factorize_supernodal_numeric_intranode_lblt as lblt,
    factorize_supernodal_numeric_intranode_lblt_scratch as lblt_scratch, factorize_supernodal_numeric_llt as llt,
    factorize_supernodal_numeric_llt_scratch as llt_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{MatMut, Par};
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
    /// Entries of L, and those of B on its diagonal.
    pub values: Vec<T>,
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
    pub(super) fn new(
        symbolic: &Symbolic,
        a: &SymmetricMatrix,
        kind: Kind,
        memory: Vec<T>,
    ) -> Result<Self, LinalgError> {
        let order = a.order();
        let failed = |reason| LinalgError::Factorisation { order, reason };
        let scale: Vec<f64> = a
            .stored_diagonal()
            .into_iter()
            .map(|entry| if entry == 0.0 { 1.0 } else { entry.abs().sqrt().recip() })
            .collect();
        let scaled: Vec<T> = (0..order)
            .flat_map(|column| {
                let scale = &scale;
                a.column(column).map(move |(row, value)| T::rounded(scale[row] * value * scale[column]))
            })
            .collect();
        let pattern = SymbolicSparseColMatRef::new_checked(order, order, &a.offsets, None, &a.rows);
        let lower = SparseColMatRef::new(pattern, &scaled);
        let mut values = memory;
        values.truncate(symbolic.len_val());
        values.try_reserve_exact(symbolic.len_val() - values.len()).map_err(|_| failed("out of memory"))?;
        values.resize(symbolic.len_val(), T::rounded(0.0));
        let scratch = match kind {
            Kind::Definite => llt_scratch::<u32, T>(symbolic, Par::Seq, Default::default()),
            Kind::Indefinite => lblt_scratch::<u32, T>(symbolic, Par::Seq, Default::default()),
        };
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| failed("out of memory"))?;
        let stack = MemStack::new(&mut buffer);
        let pivots = match kind {
            Kind::Definite => {
                let refused =
                    |LltError::NonPositivePivot { index: pivot }| LinalgError::NotPositiveDefinite { order, pivot };
                llt(&mut values, lower, Default::default(), symbolic, Par::Seq, stack, Default::default())
                    .map_err(refused)?;
                None
            }
            Kind::Indefinite => {
                let (mut below, mut old, mut new) = (vec![T::rounded(0.0); order], vec![0; order], vec![0; order]);
                lblt(&mut values, &mut below, &mut old, &mut new, lower, symbolic, Par::Seq, stack, Default::default());
                Some(Pivots { below_diagonal: below, old, new })
            }
        };
        Ok(Self { values, scale, pivots })
    }

    /// The same with every entry rounded to another precision.
    pub(super) fn rounded<S: Precision>(&self) -> NumericFactor<S> {
        let round = |values: &[T]| values.iter().map(|&v| S::rounded(v.exact())).collect();
        NumericFactor {
            values: round(&self.values),
            scale: self.scale.clone(),
            pivots: self.pivots.as_ref().map(|pivots| Pivots {
                below_diagonal: round(&pivots.below_diagonal),
                old: pivots.old.clone(),
                new: pivots.new.clone(),
            }),
        }
    }

    /// `A^-1 B` in place for `B` [n x k]. Threads share the columns.
    pub(super) fn solve(&self, symbolic: &Symbolic, b: MatMut<'_, f64>) {
        let width = b.ncols().div_ceil(rayon::current_num_threads()).max(1);
        b.par_col_chunks_mut(width).for_each(|columns| self.solve_columns(symbolic, columns));
    }

    /// Where a row of the factor is in the matrix.
    fn place(&self, row: usize) -> usize {
        match &self.pivots {
            None => row,
            Some(pivots) => pivots.old[row] as usize,
        }
    }

    fn solve_columns(&self, symbolic: &Symbolic, b: MatMut<'_, f64>) {
        // more lanes than columns are wasted, fewer load every entry more often
        match b.ncols() {
            ..=4 => self.solve_blocks::<4>(symbolic, b),
            9.. if T::REGISTER == 8 => self.solve_blocks::<16>(symbolic, b),
            _ => self.solve_blocks::<8>(symbolic, b),
        }
    }

    /// The same in blocks of `L` columns, which are filled up with zeros.
    fn solve_blocks<const L: usize>(&self, symbolic: &Symbolic, mut b: MatMut<'_, f64>) {
        let order = self.scale.len();
        let mut x = vec![[T::default(); L]; order * b.ncols().div_ceil(L)];
        for (block, x) in x.chunks_exact_mut(order).enumerate() {
            let width = L.min(b.ncols() - L * block);
            let columns = b.rb().subcols(L * block, width);
            for (row, lanes) in x.iter_mut().enumerate() {
                let place = self.place(row);
                let entries = columns.row(place).iter();
                for (lane, entry) in lanes.iter_mut().zip(entries) {
                    *lane = T::rounded(self.scale[place] * entry);
                }
            }
        }
        let pivoting =
            self.pivots.as_ref().map(|pivots| Pivoting { below_diagonal: &pivots.below_diagonal, places: &pivots.new });
        let triangles = Triangles { supernodes: symbolic, values: &self.values, pivoting };
        substitute(&triangles, &mut x);
        for (block, x) in x.chunks_exact(order).enumerate() {
            let width = L.min(b.ncols() - L * block);
            let mut columns = b.rb_mut().subcols_mut(L * block, width);
            for (row, lanes) in x.iter().enumerate() {
                let place = self.place(row);
                let entries = columns.rb_mut().row_mut(place).iter_mut();
                for (lane, entry) in lanes.iter().zip(entries) {
                    *entry = self.scale[place] * lane.exact();
                }
            }
        }
    }

    /// Number of negative eigenvalues of the factorised matrix (Sylvester's law of inertia).
    pub(super) fn negative(&self, symbolic: &Symbolic) -> usize {
        let Some(pivots) = &self.pivots else {
            return 0;
        };
        let factor = SupernodalLltRef::new(symbolic, &self.values);
        let mut negative = 0;
        for index in 0..symbolic.n_supernodes() {
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
                    negative += if determinant < 0.0 { 1 } else { 2 * usize::from(diagonal < 0.0) };
                    column += 2;
                }
            }
        }
        negative
    }
}
