//! Forward and backward substitution with a supernodal factor for blocks of right-hand sides.
//!
//! Right-hand sides stand side by side in lanes: an entry of the factor is loaded once for all of them, and what a
//! supernode needs of a row is one piece of memory. What a supernode adds to the rows below goes to its parent, and what those
//! rows become comes back from it: threads share the tree (Liu, SIAM Rev. 34 (1992) 82-109). Columns of a supernode are taken a few at once and used for all blocks
//! while they are in the cache.
//!
//! What a right-hand side's solution is does not depend on the others beside it, nor on how many they are.
//!
//! A supernode whose own right-hand sides are zero is passed over on the way forward: loads on a few nodes reach those
//! nodes and the separators above them alone (Gilbert, SIAM J. Matrix Anal. Appl. 15 (1994) 62-79).

use super::precision::Precision;
use super::rows::{Row, TILE, add, products, subtract};
use super::symbolic::Symbolic;
use super::tree::lock;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use std::sync::Mutex;

/// B of `L B L^T`, block-diagonal.
pub(super) struct Pivoting<'a, T> {
    /// Its entries below the diagonal; a pivot of order two has one that is not zero.
    pub below_diagonal: &'a [T],
    /// Which column of its panel a pivot was.
    pub old: &'a [u32],
}

/// A factor `L L^T` or `L B L^T`.
pub(super) struct Triangles<'a, T> {
    /// Where the entries of L are.
    pub symbolic: &'a Symbolic,
    /// The entries of L; those of B stand on its diagonal.
    pub values: &'a [T],
    /// `None` for `L L^T`.
    pub pivoting: Option<Pivoting<'a, T>>,
}

/// Rows of right-hand sides on the way through the tree, for some of the blocks: those of each block one behind the other.
struct Message<T, const L: usize> {
    blocks: Vec<usize>,
    rows: Vec<Row<T, L>>,
}

/// What is on the way to the supernodes of other parts of the tree.
type Slots<T, const L: usize> = Vec<Mutex<Option<Message<T, L>>>>;

/// The rows of the supernodes of one part, of every block.
type Own<'x, T, const L: usize> = Vec<&'x mut [Row<T, L>]>;

/// `(L B L^T)^-1 X` in place for blocks of right-hand sides one after the other [blocks * n].
pub(super) fn substitute<T: Precision, const L: usize>(triangles: &Triangles<'_, T>, x: &mut [Row<T, L>]) {
    let tree = &triangles.symbolic.tree;
    let mut own: Vec<Own<'_, T, L>> = (0..tree.len()).map(|_| Vec::new()).collect();
    for mut block in x.chunks_exact_mut(triangles.symbolic.order().max(1)) {
        for (part, own) in own.iter_mut().enumerate() {
            let columns = triangles.symbolic.columns(&tree.supernodes(part)).len();
            own.push(block.split_off_mut(..columns).unwrap_or_default());
        }
    }
    let own: Vec<Mutex<Own<'_, T, L>>> = own.into_iter().map(Mutex::new).collect();
    let slots = || -> Slots<T, L> { (0..tree.len()).map(|_| Mutex::new(None)).collect() };
    let above = slots();
    tree.upwards(|part| forward(triangles, part, &mut lock(&own[part]), &above));
    let below: Slots<T, L> = (0..triangles.symbolic.supernodes()).map(|_| Mutex::new(None)).collect();
    tree.downwards(|part| backward(triangles, part, &mut lock(&own[part]), &below));
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx2+fma", "x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn forward<T: Precision, const L: usize>(
    triangles: &Triangles<'_, T>,
    part: usize,
    own: &mut Own<'_, T, L>,
    slots: &Slots<T, L>,
) {
    // without the instruction a fused product is a call of the library
    if target_cfg_f!(any(target_feature = "fma", target_feature = "neon")) {
        triangles.forward::<L, true>(part, own, slots);
    } else {
        triangles.forward::<L, false>(part, own, slots);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx2+fma", "x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn backward<T: Precision, const L: usize>(
    triangles: &Triangles<'_, T>,
    part: usize,
    own: &mut Own<'_, T, L>,
    slots: &Slots<T, L>,
) {
    if target_cfg_f!(any(target_feature = "fma", target_feature = "neon")) {
        triangles.backward::<L, true>(part, own, slots);
    } else {
        triangles.backward::<L, false>(part, own, slots);
    }
}

/// Columns of L that were factorised at once: a square on the diagonal, and rows below it.
#[derive(Clone, Copy)]
struct Panel<'a, T> {
    values: &'a [T],
    rows: usize,
    columns: usize,
    /// B below its diagonal, and which column a pivot was; `None` for `L L^T`.
    pivots: Option<(&'a [T], &'a [u32])>,
}

impl<'a, T: Precision> Panel<'a, T> {
    /// `J` columns from row `from` on.
    #[inline(always)]
    fn part<const J: usize>(&self, first: usize, from: usize) -> [&'a [T]; J] {
        let rows = self.rows;
        std::array::from_fn(|j| &self.values[(first + j) * rows..][from..rows])
    }

    /// Eliminates `J` columns from the rows that follow.
    #[inline(always)]
    fn forward<const L: usize, const J: usize, const FUSED: bool>(&self, first: usize, work: &mut [Row<T, L>]) {
        let unit = self.pivots.is_some();
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
        subtract::<T, L, J>(&self.part(first, first + J), &minus, rest);
    }

    /// Solves for `J` rows when those that follow are known; `R` of these are taken at once.
    #[inline(always)]
    fn backward<const L: usize, const J: usize, const R: usize, const FUSED: bool>(
        &self,
        first: usize,
        work: &mut [Row<T, L>],
    ) {
        let unit = self.pivots.is_some();
        let (own, rest) = work[first..].split_at_mut(J);
        let mut sums = products::<T, L, J, R>(&self.part(first, first + J), rest);
        let square = self.part::<J>(first, first);
        for j in (0..J).rev() {
            for i in j + 1..J {
                add::<T, L, FUSED>(&mut sums[j], square[j][i], &own[i]);
            }
            own[j] = std::array::from_fn(|lane| own[j][lane] - sums[j][lane]);
            if !unit {
                let inverse = T::rounded(1.0) / square[j][j];
                own[j] = own[j].map(|value| value * inverse);
            }
        }
    }

    /// Puts the panel's rows into the order of the pivots.
    #[inline(always)]
    fn in_order_of_pivots<const L: usize>(&self, work: &mut [Row<T, L>], spare: &mut Vec<Row<T, L>>) {
        if let Some((_, old)) = self.pivots {
            spare.clear();
            spare.extend_from_slice(&work[..self.columns]);
            work.iter_mut().zip(old).for_each(|(row, &old)| *row = spare[old as usize]);
        }
    }

    /// Puts the panel's rows back into the order of the matrix.
    #[inline(always)]
    fn in_order_of_rows<const L: usize>(&self, work: &mut [Row<T, L>], spare: &mut Vec<Row<T, L>>) {
        if let Some((_, old)) = self.pivots {
            spare.clear();
            spare.extend_from_slice(&work[..self.columns]);
            spare.iter().zip(old).for_each(|(row, &old)| work[old as usize] = *row);
        }
    }

    /// `B^-1 X` in place for the pivots of this panel.
    #[inline(always)]
    fn divide<const L: usize>(&self, below_diagonal: &[T], x: &mut [Row<T, L>]) {
        let diagonal = |column: usize| self.values[column * self.rows + column];
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
    /// The panels of a supernode, and their first columns.
    #[inline(always)]
    fn panels(&self, index: usize) -> impl DoubleEndedIterator<Item = (usize, Panel<'a, T>)> {
        let (supernode, range) = (self.symbolic.supernode(index), self.symbolic.values(&(index..index + 1)));
        let (layout, start, values) = (supernode.layout(), supernode.start, &self.values[range]);
        let (below, old) =
            self.pivoting.as_ref().map_or((&[][..], &[][..]), |pivoting| (pivoting.below_diagonal, pivoting.old));
        let pivoted = self.pivoting.is_some();
        (0..layout.blocks()).map(move |block| {
            let (first, columns) = layout.block(block);
            let (rows, begin) = (layout.rows - first, layout.begin(block));
            let own = start + first..start + first + columns;
            let pivots = pivoted.then(|| (&below[own.clone()], &old[own]));
            (first, Panel { values: &values[begin..begin + rows * columns], rows, columns, pivots })
        })
    }

    /// Eliminates the supernodes of a part from the right-hand sides.
    #[inline(always)]
    fn forward<const L: usize, const FUSED: bool>(&self, part: usize, own: &mut Own<'_, T, L>, slots: &Slots<T, L>) {
        let nothing = [T::default(); L];
        let supernodes = self.symbolic.tree.supernodes(part);
        let start = self.symbolic.columns(&supernodes).start;
        let mut messages: Vec<Option<Message<T, L>>> = supernodes.clone().map(|_| None).collect();
        let mut spare: Vec<Vec<Row<T, L>>> = Vec::new();
        let mut work: Vec<Row<T, L>> = Vec::new();
        let mut pivoted = Vec::new();
        for index in supernodes.clone() {
            let supernode = self.symbolic.supernode(index);
            let (rows, columns) = (supernode.rows(), supernode.columns);
            let place = supernode.start - start..supernode.start - start + columns;
            let children = self.symbolic.children(index);
            let children = children.filter_map(|child| {
                let message = match child.checked_sub(supernodes.start) {
                    Some(place) => messages[place].take(),
                    None => lock(&slots[self.symbolic.tree.part_of(child)]).take(),
                };
                Some((self.symbolic.supernode(child).relative, message?))
            });
            let children: Vec<(&[u32], Message<T, L>)> = children.collect();
            let reaches = |block: &usize| {
                let sent = children.iter().any(|(_, message)| message.blocks.contains(block));
                sent || own[*block][place.clone()].iter().any(|row| *row != nothing)
            };
            let blocks: Vec<usize> = (0..own.len()).filter(reaches).collect();
            work.clear();
            for &block in &blocks {
                let from = work.len();
                work.extend_from_slice(&own[block][place.clone()]);
                work.resize(from + rows, nothing);
                for (relative, message) in &children {
                    let Some(sent) = message.blocks.iter().position(|&other| other == block) else { continue };
                    let sent = message.rows[sent * relative.len()..].iter();
                    for (row, &place) in sent.zip(*relative) {
                        let to = &mut work[from + place as usize];
                        *to = std::array::from_fn(|lane| to[lane] + row[lane]);
                    }
                }
            }
            spare.extend(children.into_iter().map(|(_, message)| message.rows));
            if blocks.is_empty() {
                continue;
            }
            for (from, panel) in self.panels(index) {
                for work in work.chunks_exact_mut(rows) {
                    panel.in_order_of_pivots(&mut work[from..], &mut pivoted);
                }
                let mut first = 0;
                while first < panel.columns {
                    let taken = step(panel.columns - first);
                    for work in work.chunks_exact_mut(rows) {
                        let work = &mut work[from..];
                        match taken {
                            8 => panel.forward::<L, 8, FUSED>(first, work),
                            4 => panel.forward::<L, 4, FUSED>(first, work),
                            2 => panel.forward::<L, 2, FUSED>(first, work),
                            _ => panel.forward::<L, 1, FUSED>(first, work),
                        }
                    }
                    first += taken;
                }
            }
            let mut sent = spare.pop().unwrap_or_default();
            sent.clear();
            for (work, &block) in work.chunks_exact(rows).zip(&blocks) {
                own[block][place.clone()].copy_from_slice(&work[..columns]);
                sent.extend_from_slice(&work[columns..]);
            }
            if rows > columns {
                messages[index - supernodes.start] = Some(Message { blocks, rows: sent });
            }
        }
        *lock(&slots[part]) = messages.pop().flatten();
    }

    /// Solves for the rows of a part, from what those above have told.
    #[inline(always)]
    fn backward<const L: usize, const FUSED: bool>(&self, part: usize, own: &mut Own<'_, T, L>, slots: &Slots<T, L>) {
        let supernodes = self.symbolic.tree.supernodes(part);
        let start = self.symbolic.columns(&supernodes).start;
        let blocks = own.len();
        let mut messages: Vec<Option<Vec<Row<T, L>>>> = supernodes.clone().map(|_| None).collect();
        let mut spare: Vec<Vec<Row<T, L>>> = Vec::new();
        let mut work: Vec<Row<T, L>> = Vec::new();
        let mut pivoted = Vec::new();
        for index in supernodes.clone().rev() {
            let supernode = self.symbolic.supernode(index);
            let (rows, columns) = (supernode.rows(), supernode.columns);
            let place = supernode.start - start..supernode.start - start + columns;
            let message = messages[index - supernodes.start].take();
            let message =
                message.or_else(|| lock(&slots[index]).take().map(|message| message.rows)).unwrap_or_default();
            work.clear();
            for block in 0..blocks {
                work.extend_from_slice(&own[block][place.clone()]);
                work.extend_from_slice(&message[block * (rows - columns)..][..rows - columns]);
            }
            spare.push(message);
            for (from, panel) in self.panels(index).rev() {
                if let Some((below, _)) = panel.pivots {
                    work.chunks_exact_mut(rows).for_each(|work| panel.divide(below, &mut work[from..]));
                }
                let mut left = panel.columns;
                while left > 0 {
                    let taken = step(left);
                    left -= taken;
                    for work in work.chunks_exact_mut(rows) {
                        let work = &mut work[from..];
                        match taken {
                            8 if L <= 8 => panel.backward::<L, 8, TILE, FUSED>(left, work),
                            // a loop twice as long would not be unrolled, and its sums not stay in registers
                            8 => panel.backward::<L, 8, 4, FUSED>(left, work),
                            4 => panel.backward::<L, 4, TILE, FUSED>(left, work),
                            2 => panel.backward::<L, 2, TILE, FUSED>(left, work),
                            _ => panel.backward::<L, 1, TILE, FUSED>(left, work),
                        }
                    }
                }
                for work in work.chunks_exact_mut(rows) {
                    panel.in_order_of_rows(&mut work[from..], &mut pivoted);
                }
            }
            for (work, own) in work.chunks_exact(rows).zip(own.iter_mut()) {
                own[place.clone()].copy_from_slice(&work[..columns]);
            }
            for child in self.symbolic.children(index) {
                let relative = self.symbolic.supernode(child).relative;
                let mut told = spare.pop().unwrap_or_default();
                told.clear();
                for work in work.chunks_exact(rows) {
                    told.extend(relative.iter().map(|&place| work[place as usize]));
                }
                match child.checked_sub(supernodes.start) {
                    Some(place) => messages[place] = Some(told),
                    None => *lock(&slots[child]) = Some(Message { blocks: Vec::new(), rows: told }),
                }
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

#[cfg(test)]
#[path = "substitution_tests.rs"]
mod tests;
