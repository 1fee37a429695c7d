//! Multifrontal factorisation `A = L L^T` or `A = L B L^T` in single or double precision.
//!
//! A matrix is scaled to a unit diagonal first: single precision then loses what is small beside its own row, not beside
//! the stiffest part of the model.
//!
//! Threads share the elimination tree and the large fronts at its top. Every sum has the same order whatever their number.

use super::front::{Front, Kind, Target};
use super::precision::Precision;
use super::rest::{Pool, Rest};
use super::substitution::{Pivoting, Triangles, substitute};
use super::symbolic::Symbolic;
use super::tree::lock;
use super::{LinalgError, SymmetricMatrix};
use faer::MatMut;
use faer::prelude::*;
use rayon::prelude::*;
use std::sync::Mutex;

/// Rows that are turned from columns to lanes at once: they stay in the first cache.
const TILE: usize = 256;

/// Block-diagonal part of `L B L^T` off the diagonal, and the order of the pivots within the panels.
#[derive(Debug)]
struct Pivots<T> {
    below_diagonal: Vec<T>,
    /// Which column of its panel a pivot was.
    old: Vec<u32>,
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

/// What a part of the tree leaves to the part above: `None` until it is done, or where it failed.
type Slot<T> = Mutex<Option<Rest<T>>>;

impl<T: Precision> NumericFactor<T> {
    /// Factorises a matrix with the analysed pattern; `memory`, which may be empty, is used again.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] for [`Kind::Definite`], of the first such column; [`LinalgError::Factorisation`].
    pub(super) fn new(
        symbolic: &Symbolic,
        a: &SymmetricMatrix,
        kind: Kind,
        memory: Vec<T>,
    ) -> Result<Self, LinalgError> {
        let order = a.order();
        let scale: Vec<f64> = a
            .stored_diagonal()
            .into_iter()
            .map(|entry| if entry == 0.0 { 1.0 } else { entry.abs().sqrt().recip() })
            .collect();
        let mut values = memory;
        if values.len() != symbolic.entries() {
            let failed = |_| LinalgError::Factorisation { order, reason: "out of memory" };
            drop(values);
            // pages that come zeroed from the system are filled by the threads
            Vec::<T>::new().try_reserve_exact(symbolic.entries()).map_err(failed)?;
            values = vec![T::default(); symbolic.entries()];
        }
        let pivoted = if kind == Kind::Indefinite { order } else { 0 };
        let mut pivots = Pivots { below_diagonal: vec![T::default(); pivoted], old: vec![0; pivoted] };
        let elimination = Elimination {
            symbolic,
            a,
            kind,
            scale: &scale,
            pool: Pool::new(),
            maps: Mutex::new(Vec::new()),
            slots: (0..symbolic.tree.len()).map(|_| Mutex::new(None)).collect(),
            failure: Mutex::new(None),
        };
        let targets: Vec<Mutex<Target<'_, T>>> =
            elimination.targets(&mut values, &mut pivots).into_iter().map(Mutex::new).collect();
        symbolic.tree.upwards(|part| elimination.eliminate(part, &mut lock(&targets[part])));
        drop(targets);
        let failure = lock(&elimination.failure).take();
        match failure {
            Some(error) => Err(error),
            None => Ok(Self { values, pivots: (kind == Kind::Indefinite).then_some(pivots), scale }),
        }
    }

    /// The same with every entry rounded to another precision.
    pub(super) fn rounded<S: Precision>(&self) -> NumericFactor<S> {
        let round = |values: &[T]| values.par_iter().map(|&v| S::rounded(v.exact())).collect();
        NumericFactor {
            values: round(&self.values),
            scale: self.scale.clone(),
            pivots: self
                .pivots
                .as_ref()
                .map(|pivots| Pivots { below_diagonal: round(&pivots.below_diagonal), old: pivots.old.clone() }),
        }
    }

    /// `A^-1 B` in place for `B` [n x k].
    pub(super) fn solve(&self, symbolic: &Symbolic, b: MatMut<'_, f64>) {
        // more lanes than columns are wasted, fewer load every entry more often
        match b.ncols() {
            ..=4 => self.solve_blocks::<4>(symbolic, b),
            9.. if T::REGISTER == 8 => self.solve_blocks::<16>(symbolic, b),
            _ => self.solve_blocks::<8>(symbolic, b),
        }
    }

    /// The same in blocks of `L` columns, which are filled up with zeros.
    fn solve_blocks<const L: usize>(&self, symbolic: &Symbolic, b: MatMut<'_, f64>) {
        let order = self.scale.len();
        let mut x = vec![[T::default(); L]; order * b.ncols().div_ceil(L)];
        for (block, x) in x.chunks_exact_mut(order.max(1)).enumerate() {
            let columns = b.rb().subcols(L * block, L.min(b.ncols() - L * block));
            x.par_chunks_mut(TILE).zip(self.scale.par_chunks(TILE)).enumerate().for_each(|(tile, (rows, scale))| {
                for lane in 0..columns.ncols() {
                    let entries = columns.col(lane).subrows(TILE * tile, rows.len()).iter();
                    for ((row, entry), scale) in rows.iter_mut().zip(entries).zip(scale) {
                        row[lane] = T::rounded(scale * entry);
                    }
                }
            });
        }
        let pivoting =
            self.pivots.as_ref().map(|pivots| Pivoting { below_diagonal: &pivots.below_diagonal, old: &pivots.old });
        let triangles = Triangles { symbolic, values: &self.values, pivoting };
        substitute(&triangles, &mut x);
        let x = &x;
        b.par_row_chunks_mut(TILE).zip(self.scale.par_chunks(TILE)).enumerate().for_each(|(tile, (mut b, scale))| {
            for column in 0..b.ncols() {
                let rows = &x[column / L * order + TILE * tile..][..scale.len()];
                for ((row, entry), scale) in rows.iter().zip(b.rb_mut().col_mut(column).iter_mut()).zip(scale) {
                    *entry = scale * row[column % L].exact();
                }
            }
        });
    }

    /// Number of negative eigenvalues of the factorised matrix (Sylvester's law of inertia).
    pub(super) fn negative(&self, symbolic: &Symbolic) -> usize {
        let Some(pivots) = &self.pivots else {
            return 0;
        };
        let mut negative = 0;
        for index in 0..symbolic.supernodes() {
            let supernode = symbolic.supernode(index);
            let values = &self.values[symbolic.values(&(index..index + 1))];
            let layout = supernode.layout();
            for block in 0..layout.blocks() {
                let (first, columns) = layout.block(block);
                let (rows, entries) = (layout.rows - first, &values[layout.begin(block)..]);
                let below = &pivots.below_diagonal[supernode.start + first..][..columns];
                negative += negative_pivots(|column| entries[column * rows + column].exact(), below);
            }
        }
        negative
    }
}

/// Negative eigenvalues of one panel's B.
fn negative_pivots<T: Precision>(diagonal: impl Fn(usize) -> f64, below: &[T]) -> usize {
    let (mut negative, mut column) = (0, 0);
    while column < below.len() {
        let (own, beside) = (diagonal(column), below[column].exact());
        if beside == 0.0 || column + 1 == below.len() {
            negative += usize::from(own < 0.0);
            column += 1;
        } else {
            let determinant = own * diagonal(column + 1) - beside * beside;
            negative += if determinant < 0.0 { 1 } else { 2 * usize::from(own < 0.0) };
            column += 2;
        }
    }
    negative
}

/// A factorisation under way.
struct Elimination<'a, T> {
    symbolic: &'a Symbolic,
    a: &'a SymmetricMatrix,
    kind: Kind,
    scale: &'a [f64],
    pool: Pool<T>,
    /// Where rows of the matrix are in a front: memory of the threads.
    maps: Mutex<Vec<Vec<u32>>>,
    slots: Vec<Slot<T>>,
    failure: Mutex<Option<LinalgError>>,
}

impl<'a, T: Precision> Elimination<'a, T> {
    /// What each part of the tree writes.
    fn targets<'v>(&self, values: &'v mut [T], pivots: &'v mut Pivots<T>) -> Vec<Target<'v, T>> {
        let (mut values, mut below, mut old) = (values, &mut pivots.below_diagonal[..], &mut pivots.old[..]);
        let of_part = |part: usize| {
            let supernodes = self.symbolic.tree.supernodes(part);
            let columns = if old.is_empty() { 0 } else { self.symbolic.columns(&supernodes).len() };
            Target {
                values: values.split_off_mut(..self.symbolic.values(&supernodes).len()).unwrap_or_default(),
                below_diagonal: below.split_off_mut(..columns).unwrap_or_default(),
                old: old.split_off_mut(..columns).unwrap_or_default(),
            }
        };
        (0..self.symbolic.tree.len()).map(of_part).collect()
    }

    /// Eliminates the supernodes of one part of the tree.
    fn eliminate(&self, part: usize, target: &mut Target<'_, T>) {
        let supernodes = self.symbolic.tree.supernodes(part);
        let mut map = lock(&self.maps).pop().unwrap_or_else(|| vec![0; self.symbolic.order()]);
        let mut rests: Vec<Option<Rest<T>>> = supernodes.clone().map(|_| None).collect();
        let (mut values, mut below, mut old) = (&mut *target.values, &mut *target.below_diagonal, &mut *target.old);
        for index in supernodes.clone() {
            let supernode = self.symbolic.supernode(index);
            let columns = if self.kind == Kind::Indefinite { supernode.columns } else { 0 };
            let own = Target {
                values: values.split_off_mut(..supernode.layout().len()).unwrap_or_default(),
                below_diagonal: below.split_off_mut(..columns).unwrap_or_default(),
                old: old.split_off_mut(..columns).unwrap_or_default(),
            };
            let left_by = |child: usize| {
                let relative = self.symbolic.supernode(child).relative;
                let rest = match child.checked_sub(supernodes.start) {
                    Some(place) => rests[place].take(),
                    None => lock(&self.slots[self.symbolic.tree.part_of(child)]).take(),
                };
                rest.map(|rest| (relative, rest))
            };
            // without what a failed child would have left there is nothing to do
            let Some(children) = self.symbolic.children(index).map(left_by).collect() else { continue };
            let front = Front { supernode, matrix: self.a, scale: self.scale, kind: self.kind, children };
            match front.eliminate(own, &self.pool, &mut map) {
                Ok(rest) => rests[index - supernodes.start] = Some(rest),
                Err(error) => self.failed(error),
            }
            front.children.into_iter().for_each(|(_, rest)| self.pool.give_back(rest));
        }
        *lock(&self.slots[part]) = rests.pop().flatten();
        lock(&self.maps).push(map);
    }

    /// Keeps the error of the lowest column, whichever came first.
    fn failed(&self, error: LinalgError) {
        let column = |error: &LinalgError| match error {
            LinalgError::NotPositiveDefinite { pivot, .. } => *pivot,
            _ => 0,
        };
        let mut failure = lock(&self.failure);
        if failure.as_ref().is_none_or(|known| column(&error) < column(known)) {
            *failure = Some(error);
        }
    }
}

#[cfg(test)]
#[path = "numeric_tests.rs"]
mod tests;
