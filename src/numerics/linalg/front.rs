//! One supernode of a factorisation: its front, a dense matrix over its columns and the rows below them.
//!
//! A front is assembled from the matrix and from what its children leave, its columns are eliminated, and what they leave of
//! the rows below is handed to the parent (Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302-325). Columns are taken in
//! panels; pivots are sought within a panel.

use super::precision::Precision;
use super::rest::{Pool, Rest};
use super::symbolic::Supernode;
use super::trapezoid::Trapezoid;
use super::{LinalgError, SymmetricMatrix};
use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::{lblt, llt};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place};
use faer::prelude::*;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;

/// Rows that are updated at once: with a panel they stay in the second cache.
const ROWS: usize = 512;

/// Products of a front above which threads share it.
const SHARED: usize = 1 << 24;

/// Which factorisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// `L L^T`; the matrix must be positive definite.
    Definite,
    /// `L B L^T` with pivots of order one and two within each panel (Bunch and Kaufman, Math. Comp. 31 (1977)
    /// 163-179).
    Indefinite,
}

/// Where a factorisation writes what it finds of some supernodes.
#[derive(Debug)]
pub(super) struct Target<'a, T> {
    /// Entries of L, and of B on its diagonal.
    pub values: &'a mut [T],
    /// Entries of B below its diagonal, one a column; empty for `L L^T`.
    pub below_diagonal: &'a mut [T],
    /// Which column of its panel a pivot was; empty for `L L^T`.
    pub old: &'a mut [u32],
}

/// Columns of a front from the diagonal down.
struct Block<'a, T> {
    first: usize,
    columns: usize,
    rows: usize,
    entries: &'a mut [T],
}

impl<'a, T: Precision> Block<'a, T> {
    /// The blocks of a trapezoid whose first column is `first` of the front.
    fn all(layout: Trapezoid, first: usize, mut entries: &'a mut [T]) -> impl Iterator<Item = Self> {
        (0..layout.blocks()).map(move |index| {
            let (begin, columns) = layout.block(index);
            let rows = layout.rows - begin;
            let (own, rest) = std::mem::take(&mut entries).split_at_mut(rows * columns);
            entries = rest;
            Self { first: first + begin, columns, rows, entries: own }
        })
    }

    /// Rows from `row` of the front on.
    fn from(&self, row: usize) -> MatRef<'_, T> {
        MatRef::from_column_major_slice(self.entries, self.rows, self.columns).split_at_row(row - self.first).1
    }

    fn all_rows(&mut self) -> MatMut<'_, T> {
        MatMut::from_column_major_slice_mut(self.entries, self.rows, self.columns)
    }
}

/// B of a panel.
#[derive(Clone, Copy)]
struct Diagonal<'a, T> {
    panel: MatRef<'a, T>,
    below: &'a [T],
}

impl<T: Precision> Diagonal<'_, T> {
    /// Calls with every pivot: its column, the entries on the diagonal, and that beside it if it is of order two.
    fn each(&self, mut handle: impl FnMut(usize, T, Option<(T, T)>)) {
        let mut column = 0;
        while column < self.below.len() {
            let (own, below) = (self.panel[(column, column)], self.below[column]);
            if below == T::default() || column + 1 == self.below.len() {
                handle(column, own, None);
                column += 1;
            } else {
                handle(column, own, Some((below, self.panel[(column + 1, column + 1)])));
                column += 2;
            }
        }
    }

    /// `X B`.
    fn times(&self, x: MatRef<'_, T>) -> faer::Mat<T> {
        let mut product = faer::Mat::<T>::zeros(x.nrows(), x.ncols());
        self.each(|column, own, pair| match pair {
            None => {
                let to = product.col_as_slice_mut(column);
                to.iter_mut().zip(x.col(column).iter()).for_each(|(to, x)| *to = *x * own);
            }
            Some((below, next)) => {
                for row in 0..x.nrows() {
                    let (a, b) = (x[(row, column)], x[(row, column + 1)]);
                    product[(row, column)] = a * own + b * below;
                    product[(row, column + 1)] = a * below + b * next;
                }
            }
        });
        product
    }

    /// `X B^-1` in place.
    fn divide(&self, mut x: MatMut<'_, T>) {
        let one = T::rounded(1.0);
        self.each(|column, own, pair| match pair {
            None => {
                let inverse = one / own;
                x.rb_mut().col_mut(column).iter_mut().for_each(|x| *x *= inverse);
            }
            Some((below, next)) => {
                // in units of the entry beside the diagonal, which is the largest
                let (upper, lower) = (own / below, next / below);
                let inverse = one / (upper * lower - one);
                for row in 0..x.nrows() {
                    let (a, b) = (x[(row, column)] / below, x[(row, column + 1)] / below);
                    x[(row, column)] = (lower * a - b) * inverse;
                    x[(row, column + 1)] = (upper * b - a) * inverse;
                }
            }
        });
    }
}

/// A supernode whose children are known.
pub(super) struct Front<'a, T> {
    pub supernode: Supernode<'a>,
    pub matrix: &'a SymmetricMatrix,
    /// Factors of rows and columns.
    pub scale: &'a [f64],
    pub kind: Kind,
    /// What the children leave, and where their rows are in this front.
    pub children: Vec<(&'a [u32], Rest<T>)>,
}

/// Rows of a child that are one behind the other in the parent's front.
struct Run {
    from: usize,
    to: usize,
    rows: usize,
}

/// Runs of at least so many rows on average are added as pieces of memory.
const LONG: usize = 6;

/// The runs of a child; none if they are short.
fn runs(relative: &[u32]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (from, &to) in relative.iter().enumerate() {
        match runs.last_mut() {
            Some(run) if run.to + run.rows == to as usize => run.rows += 1,
            _ => runs.push(Run { from, to: to as usize, rows: 1 }),
        }
    }
    if LONG * runs.len() > relative.len() {
        runs.clear();
    }
    runs
}

/// What a child leaves, from one of its columns on.
struct Arrival<'a, T> {
    relative: &'a [u32],
    rest: &'a Rest<T>,
    /// The runs that do not end before that column; none if they are short.
    runs: &'a [Run],
    index: usize,
}

impl<T: Precision> Arrival<'_, T> {
    /// Adds the column to that of the front, whose rows begin with `first`.
    fn add(&mut self, to: &mut [T], first: usize) {
        let (index, column) = (self.index, self.rest.column(self.index));
        if self.runs.is_empty() {
            for (value, &place) in column.iter().zip(&self.relative[index..]) {
                to[place as usize - first] += *value;
            }
            return;
        }
        let ended = self.runs.iter().take_while(|run| run.from + run.rows <= index).count();
        self.runs = &self.runs[ended..];
        for Run { from, to: place, rows } in self.runs {
            // the first run begins above the diagonal
            let cut = index.saturating_sub(*from);
            let values = &column[from + cut - index..from + rows - index];
            let to = &mut to[place + cut - first..][..values.len()];
            to.iter_mut().zip(values).for_each(|(to, value)| *to += *value);
        }
    }
}

impl<T: Precision> Front<'_, T> {
    /// Eliminates the columns; `map`, as long as the matrix's order, is overwritten.
    ///
    /// # Errors
    /// The column whose pivot is not positive, for [`Kind::Definite`].
    pub(super) fn eliminate(
        &self,
        target: Target<'_, T>,
        pool: &Pool<T>,
        map: &mut [u32],
    ) -> Result<Rest<T>, LinalgError> {
        let (columns, rows) = (self.supernode.columns, self.supernode.rows());
        for (&row, place) in self.supernode.below.iter().zip(columns as u32..) {
            map[row as usize] = place;
        }
        let map: &[u32] = map;
        let shared = columns * rows * rows > SHARED && rayon::current_num_threads() > 1;
        let mut rest = pool.take(rows - columns);
        let layout = rest.layout();
        let panels = Block::all(self.supernode.layout(), 0, target.values);
        let mut blocks: Vec<_> = panels.chain(Block::all(layout, columns, rest.entries())).collect();
        let runs: Vec<Vec<Run>> = self.children.iter().map(|(relative, _)| runs(relative)).collect();
        each(shared, &mut blocks, |block| self.assemble(block, map, &runs));
        let (panels, others) = blocks.split_at_mut(self.supernode.layout().blocks());
        let mut diagonals = target.below_diagonal;
        let mut old = target.old;
        let mut below: Vec<&[T]> = Vec::with_capacity(panels.len());
        for index in 0..panels.len() {
            let (done, now) = panels.split_at_mut(index);
            let panel = &mut now[0];
            self.update(panel, done, &below, shared);
            match self.kind {
                Kind::Definite => {
                    self.factorise_definite(panel, shared)?;
                    below.push(&[]);
                }
                Kind::Indefinite => {
                    let (own, left) = diagonals.split_at_mut(panel.columns);
                    let (places, others) = old.split_at_mut(panel.columns);
                    (diagonals, old) = (left, others);
                    factorise_indefinite(panel, own, places, shared);
                    below.push(own);
                }
            }
        }
        each(shared, others, |block| self.update(block, panels, &below, false));
        Ok(rest)
    }

    /// Fills a block from the matrix and the children, column by column: what is added to is in the first cache.
    fn assemble(&self, block: &mut Block<'_, T>, map: &[u32], runs: &[Vec<Run>]) {
        let (first, rows) = (block.first, block.rows);
        let Supernode { start, columns, .. } = self.supernode;
        let arrivals = self.children.iter().zip(runs).map(|((relative, rest), runs)| {
            let index = relative.partition_point(|&place| (place as usize) < first);
            Arrival { relative, rest, runs, index }
        });
        let mut arrivals: Vec<Arrival<'_, T>> = arrivals.collect();
        for (column, to) in (first..).zip(block.entries.chunks_exact_mut(rows)) {
            to.fill(T::default());
            if column < columns {
                let scale = self.scale[start + column];
                for (row, value) in self.matrix.column(start + column) {
                    let place = if row < start + columns { row - start } else { map[row] as usize };
                    to[place - first] += T::rounded(self.scale[row] * value * scale);
                }
            }
            for arrival in &mut arrivals {
                if arrival.relative.get(arrival.index) == Some(&(column as u32)) {
                    arrival.add(to, first);
                    arrival.index += 1;
                }
            }
        }
    }

    /// Subtracts what eliminated panels contribute to a block.
    fn update(&self, block: &mut Block<'_, T>, panels: &[Block<'_, T>], below: &[&[T]], shared: bool) {
        if panels.is_empty() {
            return;
        }
        let (first, columns) = (block.first, block.columns);
        let own = |panel: &Block<'_, T>| panel.from(first).split_at_row(columns).0.to_owned();
        let factors: Vec<faer::Mat<T>> = match self.kind {
            Kind::Definite => panels.iter().map(own).collect(),
            Kind::Indefinite => {
                let diagonals =
                    panels.iter().zip(below).map(|(panel, below)| Diagonal { panel: panel.from(panel.first), below });
                panels
                    .iter()
                    .zip(diagonals)
                    .map(|(panel, b)| b.times(panel.from(first).split_at_row(columns).0))
                    .collect()
            }
        };
        let subtract = |(index, mut rows): (usize, MatMut<'_, T>)| {
            let from = first + index * ROWS;
            for (panel, factor) in panels.iter().zip(&factors) {
                let (left, _) = panel.from(from).split_at_row(rows.nrows());
                matmul(rows.rb_mut(), Accum::Add, left, factor.transpose(), T::rounded(-1.0), Par::Seq);
            }
        };
        by_rows(shared, block.all_rows(), subtract);
    }

    fn factorise_definite(&self, panel: &mut Block<'_, T>, shared: bool) -> Result<(), LinalgError> {
        let (columns, column) = (panel.columns, self.supernode.start + panel.first);
        let (mut square, below) = panel.all_rows().split_at_row_mut(columns);
        let scratch = llt::factor::cholesky_in_place_scratch::<T>(columns, Par::Seq, Default::default());
        let mut buffer = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut buffer);
        llt::factor::cholesky_in_place(square.rb_mut(), Default::default(), Par::Seq, stack, Default::default())
            .map_err(|llt::factor::LltError::NonPositivePivot { index }| LinalgError::NotPositiveDefinite {
                order: self.matrix.order(),
                pivot: column + index,
            })?;
        let square = square.rb();
        by_rows(shared, below, |(_, rows)| solve_lower_triangular_in_place(square, rows.transpose_mut(), Par::Seq));
        Ok(())
    }
}

fn factorise_indefinite<T: Precision>(panel: &mut Block<'_, T>, below: &mut [T], old: &mut [u32], shared: bool) {
    let columns = panel.columns;
    let (mut square, rest) = panel.all_rows().split_at_row_mut(columns);
    let scratch = lblt::factor::cholesky_in_place_scratch::<u32, T>(columns, Par::Seq, Default::default());
    let mut buffer = MemBuffer::new(scratch);
    let mut new = vec![0_u32; columns];
    lblt::factor::cholesky_in_place(
        square.rb_mut(),
        DiagMut::from_slice_mut(below),
        old,
        &mut new,
        Par::Seq,
        MemStack::new(&mut buffer),
        Default::default(),
    );
    let square = square.rb();
    let moved = old.iter().zip(0..).any(|(&old, new)| old != new);
    let diagonal = Diagonal { panel: square, below };
    by_rows(shared, rest, |(_, mut rows)| {
        if moved {
            let before = rows.to_owned();
            for (column, &old) in old.iter().enumerate() {
                rows.rb_mut().col_mut(column).copy_from(before.col(old as usize));
            }
        }
        solve_unit_lower_triangular_in_place(square, rows.rb_mut().transpose_mut(), Par::Seq);
        diagonal.divide(rows);
    });
}

/// Calls with every item, shared among threads or not.
fn each<I: Send>(shared: bool, items: &mut [I], handle: impl Fn(&mut I) + Sync + Send) {
    if shared { items.par_iter_mut().for_each(handle) } else { items.iter_mut().for_each(handle) }
}

/// Calls with pieces of [`ROWS`] rows, the same whether threads share them or not.
fn by_rows<T: Precision>(shared: bool, a: MatMut<'_, T>, handle: impl Fn((usize, MatMut<'_, T>)) + Sync + Send) {
    let mut pieces = Vec::with_capacity(a.nrows().div_ceil(ROWS));
    let mut left = a;
    while left.nrows() > ROWS {
        let (piece, others) = left.split_at_row_mut(ROWS);
        pieces.push(piece);
        left = others;
    }
    pieces.push(left);
    if shared {
        pieces.into_par_iter().enumerate().for_each(handle);
    } else {
        pieces.into_iter().enumerate().for_each(handle);
    }
}
