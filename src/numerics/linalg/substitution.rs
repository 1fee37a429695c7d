//! Forward and backward substitution with a supernodal factor for blocks of right-hand sides.
//!
//! Right-hand sides stand side by side in lanes: an entry of the factor is loaded once for all of them, and what a
//! supernode needs of a row is one piece of memory. Columns of a supernode are taken a few at once and used for all blocks
//! while they are in the cache.
//!
//! What a right-hand side's solution is does not depend on the others beside it, nor on how many they are.
//!
//! A supernode whose own right-hand sides are zero is passed over on the way forward: loads on a few nodes reach those
//! nodes and the separators above them alone (Gilbert, SIAM J. Matrix Anal. Appl. 15 (1994) 62-79).
//!
//! The two precisions in which a factor is computed and kept.

use faer::sparse::linalg::cholesky::supernodal::{SupernodalLltRef, SymbolicSupernodalCholesky};
use multiversion::multiversion;
use multiversion::target::target_cfg_f;

/// Rows that are handled at once on the way forward.
const TILE: usize = 4;

/// A row of a block of `L` right-hand sides.
pub(super) type Row<T, const L: usize> = [T; L];

/// B of `L B L^T`, block-diagonal.
pub(super) struct Pivoting<'a, T> {
    /// Its entries below the diagonal; a pivot of order two has one that is not zero.
    pub below_diagonal: &'a [T],
    /// Where the rows of the matrix are among the pivots.
    pub places: &'a [u32],
}

/// A factor `L L^T` or `L B L^T`.
pub(super) struct Triangles<'a, T> {
    /// Where the entries of L are.
    pub supernodes: &'a SymbolicSupernodalCholesky<u32>,
    /// The entries of L; those of B stand on its diagonal.
    pub values: &'a [T],
    /// `None` for `L L^T`.
    pub pivoting: Option<Pivoting<'a, T>>,
}

/// `(L B L^T)^-1 X` in place for blocks of right-hand sides one after the other [blocks * n].
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
pub(super) fn substitute<T: Precision, const L: usize>(triangles: &Triangles<'_, T>, x: &mut [Row<T, L>]) {
    // without the instruction a fused product is a call of the library
    if target_cfg_f!(any(target_feature = "fma", target_feature = "neon")) {
        triangles.forward::<L, true>(x);
        triangles.backward::<L, true>(x);
    } else {
        triangles.forward::<L, false>(x);
        triangles.backward::<L, false>(x);
    }
}

/// Columns of L with one pattern: a square on the diagonal, and rows below it.
#[derive(Clone, Copy)]
struct Supernode<'a, T> {
    values: &'a [T],
    start: usize,
    columns: usize,
    below: &'a [u32],
}

impl<'a, T: Precision> Supernode<'a, T> {
    #[inline(always)]
    fn rows(&self) -> usize {
        self.columns + self.below.len()
    }

    /// `J` columns from row `from` on.
    #[inline(always)]
    fn part<const J: usize>(&self, first: usize, from: usize) -> [&'a [T]; J] {
        let rows = self.rows();
        std::array::from_fn(|j| &self.values[(first + j) * rows..][from..rows])
    }

    /// Eliminates `J` columns from the rows that follow.
    #[inline(always)]
    fn forward<const L: usize, const J: usize, const FUSED: bool>(
        &self,
        first: usize,
        unit: bool,
        work: &mut [Row<T, L>],
    ) {
        let (own, rest) = work[first..].split_at_mut(J);
        let square = self.part::<J>(first, first);
        let mut minus = [[T::default(); L]; J];
        for j in 0..J {
            if !unit {
                let inverse = T::rounded(1.0) / square[j][j];
                own[j] = own[j].map(|value| value * inverse);
            }
            minus[j] = own[j].map(T::neg);
            for i in j + 1..J {
                add::<T, L, FUSED>(&mut own[i], square[j][i], &minus[j]);
            }
        }
        let entries = self.part::<J>(first, first + J);
        let entries = entries.map(|column| &column[..rest.len()]);
        // a few rows at once: what is subtracted is loaded once for all of them
        let (tiles, last) = rest.as_chunks_mut::<TILE>();
        for (tile, rows) in tiles.iter_mut().enumerate() {
            let mut sums = *rows;
            for j in 0..J {
                for (i, sum) in sums.iter_mut().enumerate() {
                    add::<T, L, FUSED>(sum, entries[j][TILE * tile + i], &minus[j]);
                }
            }
            *rows = sums;
        }
        for (i, row) in last.iter_mut().enumerate() {
            for j in 0..J {
                add::<T, L, FUSED>(row, entries[j][TILE * tiles.len() + i], &minus[j]);
            }
        }
    }

    /// Solves for the first `J` rows of a group when those that follow are known. Sums run over the rows below the group
    /// first and those in it then, so that they do not depend on `J`.
    #[inline(always)]
    fn backward<const L: usize, const J: usize, const FUSED: bool>(
        &self,
        first: usize,
        group: usize,
        unit: bool,
        work: &mut [Row<T, L>],
    ) {
        let (own, below) = work[first..].split_at_mut(J);
        let (near, rest) = below.split_at(group - J);
        let entries = self.part::<J>(first, first + group);
        let entries = entries.map(|column| &column[..rest.len()]);
        let mut sums = [[T::default(); L]; J];
        for (i, row) in rest.iter().enumerate() {
            for j in 0..J {
                add::<T, L, FUSED>(&mut sums[j], entries[j][i], row);
            }
        }
        let square = self.part::<J>(first, first);
        for j in (0..J).rev() {
            for i in j + 1..J {
                add::<T, L, FUSED>(&mut sums[j], square[j][i], &own[i]);
            }
            for (i, row) in near.iter().enumerate() {
                add::<T, L, FUSED>(&mut sums[j], square[j][J + i], row);
            }
            own[j] = std::array::from_fn(|lane| own[j][lane] - sums[j][lane]);
            if !unit {
                let inverse = T::rounded(1.0) / square[j][j];
                own[j] = own[j].map(|value| value * inverse);
            }
        }
    }

    /// `B^-1 X` in place for the pivots of this supernode.
    #[inline(always)]
    fn divide<const L: usize>(&self, below_diagonal: &[T], x: &mut [Row<T, L>]) {
        let diagonal = |column: usize| self.values[column * self.rows() + column];
        let one = T::rounded(1.0);
        let mut column = 0;
        while column < self.columns {
            let below = below_diagonal[column];
            if below == T::default() || column + 1 == self.columns {
                let inverse = one / diagonal(column);
                x[column] = x[column].map(|value| value * inverse);
                column += 1;
                continue;
            }
            // in units of the entry beside the diagonal, which is the largest
            let (upper, lower) = (diagonal(column) / below, diagonal(column + 1) / below);
            let inverse = one / (upper * lower - one);
            let (before, after) = x.split_at_mut(column + 1);
            for (first, second) in before[column].iter_mut().zip(&mut after[0]) {
                let (a, b) = (*first / below, *second / below);
                *first = (lower * a - b) * inverse;
                *second = (upper * b - a) * inverse;
            }
            column += 2;
        }
    }
}

impl<'a, T: Precision> Triangles<'a, T> {
    #[inline(always)]
    fn supernode(&self, index: usize) -> Supernode<'a, T> {
        let supernode = SupernodalLltRef::new(self.supernodes, self.values).supernode(index);
        let begins = self.supernodes.col_ptr_for_val();
        Supernode {
            values: &self.values[begins[index] as usize..begins[index + 1] as usize],
            start: supernode.start(),
            columns: supernode.val().ncols(),
            below: supernode.pattern(),
        }
    }

    #[inline(always)]
    fn place(&self, row: u32) -> usize {
        match &self.pivoting {
            None => row as usize,
            Some(pivoting) => pivoting.places[row as usize] as usize,
        }
    }

    /// Copies the rows that a supernode touches.
    #[inline(always)]
    fn gather<const L: usize>(&self, supernode: &Supernode<'_, T>, x: &[Row<T, L>], work: &mut [Row<T, L>]) {
        let (top, below) = work.split_at_mut(supernode.columns);
        top.copy_from_slice(&x[supernode.start..supernode.start + supernode.columns]);
        for (to, &row) in below.iter_mut().zip(supernode.below) {
            *to = x[self.place(row)];
        }
    }

    /// Memory for the rows that any supernode touches in so many blocks.
    fn workspace<const L: usize>(&self, blocks: usize) -> Vec<Row<T, L>> {
        let rows = |index| self.supernode(index).rows();
        let most = (0..self.supernodes.n_supernodes()).map(rows).max();
        vec![[T::default(); L]; blocks * most.unwrap_or(0)]
    }

    #[inline(always)]
    fn forward<const L: usize, const FUSED: bool>(&self, x: &mut [Row<T, L>]) {
        let (order, unit) = (self.supernodes.nrows(), self.pivoting.is_some());
        let blocks = x.len() / order;
        let mut workspace = self.workspace(blocks);
        let mut reached = Vec::with_capacity(blocks);
        for index in 0..self.supernodes.n_supernodes() {
            let supernode = self.supernode(index);
            let own = supernode.start..supernode.start + supernode.columns;
            let rows = supernode.rows();
            reached.clear();
            for (block, x) in x.chunks_exact(order).enumerate() {
                if x[own.clone()].iter().any(|row| *row != [T::default(); L]) {
                    self.gather(&supernode, x, &mut workspace[reached.len() * rows..][..rows]);
                    reached.push(block);
                }
            }
            let work = &mut workspace[..reached.len() * rows];
            let mut first = 0;
            while first < supernode.columns {
                let taken = step(supernode.columns - first);
                for work in work.chunks_exact_mut(rows) {
                    match taken {
                        8 => supernode.forward::<L, 8, FUSED>(first, unit, work),
                        4 => supernode.forward::<L, 4, FUSED>(first, unit, work),
                        2 => supernode.forward::<L, 2, FUSED>(first, unit, work),
                        _ => supernode.forward::<L, 1, FUSED>(first, unit, work),
                    }
                }
                first += taken;
            }
            for (work, &block) in work.chunks_exact(rows).zip(&reached) {
                let x = &mut x[block * order..(block + 1) * order];
                let (top, below) = work.split_at(supernode.columns);
                x[own.clone()].copy_from_slice(top);
                for (&row, value) in supernode.below.iter().zip(below) {
                    x[self.place(row)] = *value;
                }
            }
        }
    }

    #[inline(always)]
    fn backward<const L: usize, const FUSED: bool>(&self, x: &mut [Row<T, L>]) {
        let (order, unit) = (self.supernodes.nrows(), self.pivoting.is_some());
        let blocks = x.len() / order;
        let mut workspace = self.workspace(blocks);
        for index in (0..self.supernodes.n_supernodes()).rev() {
            let supernode = self.supernode(index);
            let own = supernode.start..supernode.start + supernode.columns;
            let rows = supernode.rows();
            let work = &mut workspace[..blocks * rows];
            for (x, work) in x.chunks_exact_mut(order).zip(work.chunks_exact_mut(rows)) {
                if let Some(pivoting) = &self.pivoting {
                    let below = &pivoting.below_diagonal[own.clone()];
                    supernode.divide(below, &mut x[own.clone()]);
                }
                self.gather(&supernode, x, work);
            }
            let mut left = supernode.columns;
            while left > 0 {
                let taken = step(left);
                left -= taken;
                for work in work.chunks_exact_mut(rows) {
                    match taken {
                        8 if L <= T::REGISTER => {
                            supernode.backward::<L, 8, FUSED>(left, 8, unit, work);
                        }
                        // half of them have their sums in registers
                        8 => {
                            supernode.backward::<L, 4, FUSED>(left + 4, 4, unit, work);
                            supernode.backward::<L, 4, FUSED>(left, 8, unit, work);
                        }
                        4 => supernode.backward::<L, 4, FUSED>(left, 4, unit, work),
                        2 => supernode.backward::<L, 2, FUSED>(left, 2, unit, work),
                        _ => supernode.backward::<L, 1, FUSED>(left, 1, unit, work),
                    }
                }
            }
            for (x, work) in x.chunks_exact_mut(order).zip(work.chunks_exact(rows)) {
                x[own.clone()].copy_from_slice(&work[..supernode.columns]);
            }
        }
    }
}

/// How many of the columns left are taken at once: a power of two.
fn step(left: usize) -> usize {
    match left {
        8.. => 8,
        4.. => 4,
        2.. => 2,
        _ => 1,
    }
}

/// `to + factor row` in place.
#[inline(always)]
fn add<T: Precision, const L: usize, const FUSED: bool>(to: &mut Row<T, L>, factor: T, row: &Row<T, L>) {
    for lane in 0..L {
        to[lane] = if FUSED { factor.fused(row[lane], to[lane]) } else { factor * row[lane] + to[lane] };
    }
}

/// A precision.
pub(super) trait Precision: faer::traits::RealField + Copy + Default {
    /// Values in a register of 32 bytes.
    const REGISTER: usize;
    /// The nearest value.
    fn rounded(value: f64) -> Self;
    /// The value in double precision.
    fn exact(self) -> f64;
    /// `self factor + term`, rounded once.
    fn fused(self, factor: Self, term: Self) -> Self;
}

impl Precision for f32 {
    const REGISTER: usize = 8;
    #[inline(always)]
    fn rounded(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn exact(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }
}

impl Precision for f64 {
    const REGISTER: usize = 4;
    #[inline(always)]
    fn rounded(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn exact(self) -> f64 {
        self
    }
    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }
}

#[cfg(test)]
#[path = "substitution_tests.rs"]
mod tests;
