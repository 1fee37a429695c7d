//! The sparsity pattern of a model from its node graph, and how to add blocks into it.

use crate::numerics::linalg::{Pattern, SparseMatrix};
use rayon::prelude::*;
use std::ops::Range;

/// Nodes whose neighbours one thread finds in a row.
const CHUNK: usize = 4096;

/// Which nodes are coupled: for every node its sorted neighbours, itself included.
pub(super) struct NodeGraph {
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

impl NodeGraph {
    /// Couples all nodes of each group of `groups`. Nodes in no group keep themselves, so that a matrix has
    /// every degree of freedom on its diagonal.
    pub(super) fn new(nodes: usize, groups: &[&[usize]]) -> Self {
        let mut starts = vec![0_usize; nodes + 1];
        for group in groups {
            for &node in *group {
                starts[node + 1] += 1;
            }
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        // the groups that each node belongs to, one node after the other
        let mut fill = starts.clone();
        let mut belongs = vec![0_u32; starts[nodes]];
        for (number, group) in groups.iter().enumerate() {
            for &node in *group {
                belongs[fill[node]] = number as u32;
                fill[node] += 1;
            }
        }
        let lists: Vec<(Vec<u32>, Vec<u32>)> = (0..nodes.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let chunk = chunk * CHUNK..((chunk + 1) * CHUNK).min(nodes);
                let (mut lengths, mut found) = (Vec::with_capacity(chunk.len()), Vec::new());
                let mut list: Vec<u32> = Vec::new();
                for node in chunk {
                    list.clear();
                    list.push(node as u32);
                    for &group in &belongs[starts[node]..starts[node + 1]] {
                        list.extend(groups[group as usize].iter().map(|&other| other as u32));
                    }
                    list.sort_unstable();
                    list.dedup();
                    lengths.push(list.len() as u32);
                    found.extend_from_slice(&list);
                }
                (lengths, found)
            })
            .collect();
        let mut ends = Vec::with_capacity(nodes + 1);
        ends.push(0);
        let mut total = 0;
        for length in lists.iter().flat_map(|(lengths, _)| lengths) {
            total += *length as usize;
            ends.push(total);
        }
        let mut neighbours = Vec::with_capacity(total);
        lists.iter().for_each(|(_, found)| neighbours.extend_from_slice(found));
        Self { starts: ends, neighbours }
    }

    fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    fn neighbours(&self, node: usize) -> &[u32] {
        &self.neighbours[self.starts[node]..self.starts[node + 1]]
    }
}

/// How a matrix couples the displacement components of two nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coupling {
    /// Every component with every other: stiffness, and mass with incompatible modes.
    Full,
    /// Each component with itself, all alike: mass without them.
    Same,
}

impl Coupling {
    /// Entries a pair of nodes.
    fn entries(self, dimension: usize) -> usize {
        match self {
            Self::Full => dimension * dimension,
            Self::Same => dimension,
        }
    }
}

/// Where the entries of a matrix over a node graph are, in compressed columns.
pub(super) struct Columns {
    offsets: Vec<usize>,
    rows: Vec<usize>,
}

impl Columns {
    pub(super) fn new(graph: &NodeGraph, dimension: usize, coupling: Coupling) -> Self {
        let (d, entries) = (dimension, coupling.entries(dimension));
        let mut offsets = Vec::with_capacity(d * graph.nodes() + 1);
        offsets.push(0);
        for node in 0..graph.nodes() {
            let (begin, height) = (entries * graph.starts[node], entries / d * graph.neighbours(node).len());
            offsets.extend((1..=d).map(|component| begin + component * height));
        }
        let mut rows = vec![0; entries * graph.neighbours.len()];
        let mut left = rows.as_mut_slice();
        let mut pieces = Vec::with_capacity(graph.nodes().div_ceil(CHUNK));
        for first in (0..graph.nodes()).step_by(CHUNK) {
            let nodes = first..(first + CHUNK).min(graph.nodes());
            let length = entries * (graph.starts[nodes.end] - graph.starts[first]);
            pieces.push((nodes, left.split_off_mut(..length).unwrap_or_default()));
        }
        pieces.into_par_iter().for_each(|(nodes, rows)| {
            let mut to = rows.iter_mut();
            for (node, component) in nodes.flat_map(|node| (0..d).map(move |component| (node, component))) {
                let firsts = graph.neighbours(node).iter().map(|&other| d * other as usize);
                let own = match coupling {
                    Coupling::Full => 0..d,
                    Coupling::Same => component..component + 1,
                };
                let rows = firsts.flat_map(|first| own.clone().map(move |component| first + component));
                rows.zip(to.by_ref()).for_each(|(row, to)| *to = row);
            }
        });
        Self { offsets, rows }
    }

    pub(super) fn pattern(&self) -> Pattern<'_> {
        Pattern { offsets: &self.offsets, rows: &self.rows }
    }
}

/// Values of a matrix over a node graph, in compressed columns, `d` degrees of freedom a node.
pub(super) struct BlockMatrix<'g> {
    graph: &'g NodeGraph,
    dimension: usize,
    coupling: Coupling,
    values: Vec<f64>,
}

/// A dense matrix on some nodes, column-major: `d` rows a node, or one where it is the same for all components. A
/// matrix whose coupling is full takes both.
#[derive(Clone, Copy)]
pub(super) struct Local<'a> {
    pub nodes: &'a [usize],
    pub matrix: &'a [f64],
}

impl<'g> BlockMatrix<'g> {
    pub(super) fn zeros(graph: &'g NodeGraph, dimension: usize, coupling: Coupling) -> Self {
        let values = vec![0.0; coupling.entries(dimension) * graph.neighbours.len()];
        Self { graph, dimension, coupling, values }
    }

    /// Adds matrices in their order. The columns are shared out among threads, every entry is summed by one of
    /// them in the order of `locals`: the result does not depend on how many there are.
    pub(super) fn add(&mut self, locals: &[Local<'_>]) {
        let Self { graph, dimension, coupling, .. } = *self;
        let per_node = coupling.entries(dimension);
        let mut rest = self.values.as_mut_slice();
        let mut shares = Vec::new();
        for columns in balanced(graph, rayon::current_num_threads()) {
            let length = per_node * (graph.starts[columns.end] - graph.starts[columns.start]);
            let (own, others) = rest.split_at_mut(length);
            shares.push((columns, own));
            rest = others;
        }
        shares.into_par_iter().for_each(|(columns, values)| {
            let origin = per_node * graph.starts[columns.start];
            for local in locals {
                for (b, &node) in local.nodes.iter().enumerate() {
                    if columns.contains(&node) {
                        let first = per_node * graph.starts[node] - origin;
                        let list = graph.neighbours(node);
                        let values = &mut values[first..first + per_node * list.len()];
                        let nodal = local.matrix.len() == local.nodes.len().pow(2);
                        match (nodal, dimension) {
                            (true, d) => add_same(list, values, *local, b, d, coupling),
                            (false, 3) => add_full::<3>(list, values, *local, b),
                            (false, _) => add_full::<2>(list, values, *local, b),
                        }
                    }
                }
            }
        });
    }

    /// The matrix in its columns.
    pub(super) fn into_matrix(self, columns: Columns) -> SparseMatrix {
        let order = self.dimension * self.graph.nodes();
        sprs::CsMat::new_csc((order, order), columns.offsets, columns.rows, self.values)
    }
}

/// Adds the columns of the local node `b`; `values` are those of its D columns.
fn add_full<const D: usize>(list: &[u32], values: &mut [f64], local: Local<'_>, b: usize) {
    let (rows, height) = (D * local.nodes.len(), D * list.len());
    for (a, &other) in local.nodes.iter().enumerate() {
        // every pair of nodes is in the graph by construction
        let Ok(place) = list.binary_search(&(other as u32)) else {
            continue;
        };
        for j in 0..D {
            let from = &local.matrix[(D * b + j) * rows + D * a..][..D];
            let to = &mut values[j * height + D * place..][..D];
            for i in 0..D {
                to[i] += from[i];
            }
        }
    }
}

fn add_same(list: &[u32], values: &mut [f64], local: Local<'_>, b: usize, dimension: usize, coupling: Coupling) {
    // places of the first component's entry and from a component's entry to the next one's
    let [first, next] = match coupling {
        Coupling::Same => [1, list.len()],
        Coupling::Full => [dimension, dimension * list.len() + 1],
    };
    for (a, &other) in local.nodes.iter().enumerate() {
        let Ok(place) = list.binary_search(&(other as u32)) else {
            continue;
        };
        let value = local.matrix[b * local.nodes.len() + a];
        for component in 0..dimension {
            values[first * place + next * component] += value;
        }
    }
}

/// Ranges of nodes with about as many neighbours each.
fn balanced(graph: &NodeGraph, count: usize) -> Vec<Range<usize>> {
    let count = count.max(1);
    let cut = |part: usize| {
        let target = part * graph.neighbours.len() / count;
        graph.starts.partition_point(|&start| start < target).min(graph.nodes())
    };
    let mut cuts: Vec<usize> = (0..count).map(cut).collect();
    cuts.push(graph.nodes());
    cuts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}
