//! Fill-reducing order of a symmetric matrix: nested dissection on the graph of its nodes, then a postorder of the
//! elimination tree.
//!
//! The unknowns of a mesh node have the same neighbours: consecutive columns with equal patterns are one node of the
//! graph, which is nine times smaller than the matrix's own in space. A postorder changes no fill and puts columns
//! that share a supernode beside each other; without it a factorisation finds supernodes of half the width.

use super::metis::{Graph, nested_dissection};
use super::{DenseMatrix, LinalgError, SparseMatrix};
use rayon::prelude::*;

/// Where the entries of a symmetric matrix are that has both triangles stored, in compressed columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pattern<'a> {
    /// Where each column begins in `rows`, one more than columns.
    pub offsets: &'a [usize],
    /// Rows, those of each column ascending.
    pub rows: &'a [usize],
}

impl<'a> Pattern<'a> {
    pub(crate) fn of(a: &'a SparseMatrix) -> Self {
        Self { offsets: a.indptr().into_raw_storage(), rows: a.indices() }
    }

    fn order(&self) -> usize {
        self.offsets.len() - 1
    }

    fn column(&self, index: usize) -> &'a [usize] {
        &self.rows[self.offsets[index]..self.offsets[index + 1]]
    }
}

/// An order of the unknowns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ordering {
    /// `old[new]`: which unknown comes at this place.
    pub(super) old: Vec<u32>,
    /// `new[old]`: at which place an unknown comes; [`ABSENT`] for one that is left out.
    pub(super) new: Vec<u32>,
    /// The unknowns that are ordered, ascending.
    kept: Vec<u32>,
}

/// Place of an unknown that is left out.
pub(super) const ABSENT: u32 = u32::MAX;

const NONE: usize = usize::MAX;

impl Ordering {
    /// The unknowns in this order.
    #[cfg(test)]
    pub(super) fn as_given(order: &[usize]) -> Self {
        let old: Vec<u32> = order.iter().map(|&unknown| unknown as u32).collect();
        let mut new = vec![ABSENT; old.len()];
        old.iter().zip(0..).for_each(|(&unknown, place)| new[unknown as usize] = place);
        Self { kept: (0..old.len() as u32).collect(), old, new }
    }

    /// Order of a symmetric matrix [n x n], both triangles stored.
    ///
    /// # Errors
    /// As [`Ordering::of_part`].
    pub(super) fn of(a: &SparseMatrix) -> Result<Self, LinalgError> {
        let all: Vec<usize> = (0..a.rows()).collect();
        Self::of_part(Pattern::of(a), &all)
    }

    /// Order of the rows and columns `kept` (ascending) of a stiffness K, none of which has neither stiffness nor mass.
    ///
    /// # Errors
    /// [`LinalgError::Refused`] for an empty row of K and M; as [`Ordering::of_part`].
    pub(super) fn of_problem(k: &SparseMatrix, m: &SparseMatrix, kept: &[usize]) -> Result<Self, LinalgError> {
        Self::of_part(Pattern::of(k), kept)?.of_determined(k, m)
    }

    /// This order, if each of its unknowns has stiffness or mass.
    ///
    /// # Errors
    /// [`LinalgError::Refused`] for an empty row of K and M.
    pub(super) fn of_determined(self, k: &SparseMatrix, m: &SparseMatrix) -> Result<Self, LinalgError> {
        // of semidefinite matrices a row is empty if its diagonal is
        let empty = |a: &SparseMatrix, row| a.get(row, row).is_none_or(|value| *value == 0.0);
        let undetermined = |&&row: &&u32| empty(k, row as usize) && empty(m, row as usize);
        match self.kept.par_iter().find_first(undetermined) {
            Some(row) => Err(LinalgError::Refused(format!(
                "row {row} of stiffness and mass is empty: this degree of freedom is held by nothing and carries nothing, so that its motion is not determined; leave it out or hold it"
            ))),
            None => Ok(self),
        }
    }

    /// Order of the rows and columns `kept` (ascending) of a symmetric matrix.
    ///
    /// # Errors
    /// [`LinalgError::Factorisation`] for a matrix with more than 2^31 entries or when METIS gives up.
    pub(crate) fn of_part(a: Pattern<'_>, kept: &[usize]) -> Result<Self, LinalgError> {
        let runs = Runs::of(a, kept);
        let graph = runs.graph(a)?;
        let failed = LinalgError::Factorisation { order: a.order(), reason: "METIS found no order" };
        Ok(runs.arranged(a.order(), &graph, &nested_dissection(&graph).ok_or(failed)?))
    }

    /// Order of the rows and columns `kept` (ascending) of a symmetric matrix as they come in this order of more of them: what
    /// they fill is among what all would.
    ///
    /// # Errors
    /// [`LinalgError::Factorisation`] for a matrix with more than 2^31 entries.
    pub(crate) fn restricted(&self, a: Pattern<'_>, kept: &[usize]) -> Result<Self, LinalgError> {
        let runs = Runs::of(a, kept);
        let graph = runs.graph(a)?;
        let mut in_order: Vec<usize> = (0..graph.weights.len()).collect();
        in_order.sort_by_key(|&run| self.new[runs.members(run)[0]]);
        Ok(runs.arranged(a.order(), &graph, &in_order))
    }

    /// Place of one of the unknowns that are ordered, in their own order.
    pub(super) fn place(&self, kept: usize) -> usize {
        self.new[self.kept[kept] as usize] as usize
    }

    /// The rows of `x` (those kept, ascending) in this order.
    pub(super) fn forward(&self, x: &DenseMatrix) -> DenseMatrix {
        let mut y = DenseMatrix::zeros(x.nrows(), x.ncols());
        y.par_col_iter_mut().zip(x.par_col_iter()).for_each(|(mut to, from)| {
            for (&unknown, &entry) in self.kept.iter().zip(from.iter()) {
                to[self.new[unknown as usize] as usize] = entry;
            }
        });
        y
    }

    /// The rows of `y`, which are in this order, as those kept, ascending.
    pub(super) fn backward(&self, y: &DenseMatrix, x: &mut DenseMatrix) {
        x.par_col_iter_mut().zip(y.par_col_iter()).for_each(|(to, from)| {
            for (&unknown, entry) in self.kept.iter().zip(to.iter_mut()) {
                *entry = from[self.new[unknown as usize] as usize];
            }
        });
    }
}

/// Runs of consecutive unknowns whose columns have the same pattern among those kept: the nodes of a mesh.
struct Runs<'k> {
    kept: &'k [usize],
    /// Where each run begins in `kept`, one more than runs.
    firsts: Vec<usize>,
}

impl<'k> Runs<'k> {
    fn of(a: Pattern<'_>, kept: &'k [usize]) -> Self {
        let mut is_kept = vec![false; a.order()];
        kept.iter().for_each(|&unknown| is_kept[unknown] = true);
        let column = |place: usize| a.column(kept[place]);
        let among = |place: usize| column(place).iter().filter(|&&row| is_kept[row]);
        let differ = |place: usize| column(place) != column(place - 1) && among(place).ne(among(place - 1));
        let begins = |&place: &usize| place == 0 || differ(place);
        let mut firsts: Vec<usize> = (0..kept.len()).filter(begins).collect();
        firsts.push(kept.len());
        Self { kept, firsts }
    }

    fn members(&self, run: usize) -> &[usize] {
        &self.kept[self.firsts[run]..self.firsts[run + 1]]
    }

    /// Their graph.
    ///
    /// # Errors
    /// [`LinalgError::Factorisation`] if it is too large for METIS's integers.
    fn graph(&self, a: Pattern<'_>) -> Result<Graph, LinalgError> {
        let failed = |_| LinalgError::Factorisation { order: a.order(), reason: "more than 2^31 entries" };
        let runs = self.firsts.len() - 1;
        let mut run_of = vec![NONE; a.order()];
        for run in 0..runs {
            for &unknown in self.members(run) {
                run_of[unknown] = run;
            }
        }
        let mut graph = Graph { starts: vec![0], neighbours: Vec::new(), weights: Vec::with_capacity(runs) };
        for run in 0..runs {
            let mut last = NONE;
            for &row in a.column(self.members(run)[0]) {
                // rows ascend, so do their runs
                let other = run_of[row];
                if other != NONE && other != last && other != run {
                    graph.neighbours.push(i32::try_from(other).map_err(failed)?);
                }
                if other != NONE {
                    last = other;
                }
            }
            graph.starts.push(i32::try_from(graph.neighbours.len()).map_err(failed)?);
            graph.weights.push(i32::try_from(self.members(run).len()).map_err(failed)?);
        }
        Ok(graph)
    }

    /// The unknowns in the order of these runs, but each subtree of the elimination behind the other; `order` is that of the matrix.
    fn arranged(&self, order: usize, graph: &Graph, dissected: &[usize]) -> Ordering {
        let mut place = vec![0; dissected.len()];
        for (new, &node) in dissected.iter().enumerate() {
            place[node] = new;
        }
        let parents = elimination_tree(graph, dissected, &place);
        let old: Vec<u32> = postorder(&parents)
            .into_iter()
            .map(|place| dissected[place])
            .flat_map(|node| self.members(node).iter().map(|&unknown| unknown as u32))
            .collect();
        let mut new = vec![ABSENT; order];
        for (place, &unknown) in old.iter().enumerate() {
            new[unknown as usize] = place as u32;
        }
        let kept = self.kept.iter().map(|&unknown| unknown as u32).collect();
        Ordering { old, new, kept }
    }
}

/// Parent of every place in the elimination tree (Liu, SIAM J. Matrix Anal. Appl. 11 (1990) 134-172, algorithm 4.2
/// with compressed paths); roots have none.
fn elimination_tree(graph: &Graph, node_at: &[usize], place_of: &[usize]) -> Vec<usize> {
    let nodes = graph.weights.len();
    let mut parents = vec![NONE; nodes];
    let mut ancestors = vec![NONE; nodes];
    for (place, &node) in node_at.iter().enumerate() {
        let (start, end) = (graph.starts[node] as usize, graph.starts[node + 1] as usize);
        for &other in &graph.neighbours[start..end] {
            let mut lower = place_of[other as usize];
            while lower < place {
                let above = ancestors[lower];
                ancestors[lower] = place;
                if above == NONE {
                    parents[lower] = place;
                    break;
                }
                lower = above;
            }
        }
    }
    parents
}

/// Places in an order in which every subtree is contiguous and precedes its root.
fn postorder(parents: &[usize]) -> Vec<usize> {
    let places = parents.len();
    let (mut first_child, mut next_sibling) = (vec![NONE; places], vec![NONE; places]);
    for place in (0..places).rev() {
        let parent = parents[place];
        if parent != NONE {
            next_sibling[place] = first_child[parent];
            first_child[parent] = place;
        }
    }
    let mut order = Vec::with_capacity(places);
    let mut path = Vec::new();
    for root in (0..places).filter(|&place| parents[place] == NONE) {
        path.push(root);
        while let Some(&place) = path.last() {
            let child = first_child[place];
            if child == NONE {
                order.push(place);
                path.pop();
            } else {
                first_child[place] = next_sibling[child];
                path.push(child);
            }
        }
    }
    order
}
