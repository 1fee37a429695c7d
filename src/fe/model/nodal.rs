//! What acts on the nodes of a housing beside its elements: matrices on some of them, and faces that others follow.

use super::surface::Foot;
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// A symmetric matrix on some nodes: springs, or the share of a point mass.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodalMatrix {
    pub nodes: Vec<usize>,
    pub matrix: DMatrix<f64>,
    /// What asked for it.
    pub source: NodalSource,
}

/// What a nodal matrix belongs to; indices into the lists of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum NodalSource {
    Support(usize),
    Link(usize),
    Mass(usize),
}

/// Tied nodes by their index.
pub(crate) type TiedNodes = BTreeMap<usize, TiedNode>;

/// A node that moves with a face: `u = sum_i follow_i u_i`.
#[derive(Debug, Clone)]
pub(crate) struct TiedNode {
    pub foot: Foot,
    /// Index of the link.
    pub link: usize,
}

/// Nodes in ascending order: the corners of a face, wherever it begins.
pub(super) fn sorted(nodes: &[usize]) -> Vec<usize> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes
}

/// Nodes in ascending order, each once.
pub(super) fn unique(nodes: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut nodes: Vec<usize> = nodes.collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
