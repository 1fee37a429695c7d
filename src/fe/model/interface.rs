//! How the degrees of freedom of a housing split at its interface, and nodes of the mesh as one.

use super::HousingModel;
use crate::numerics::linalg::SparseMatrix;
use std::collections::BTreeSet;

/// Degrees of freedom of a housing seen from its interface.
#[derive(Debug, Clone)]
pub struct HousingPartition {
    /// Degrees of freedom that the tie drives.
    pub driven: Vec<usize>,
    /// Degrees of freedom that stay free, neither driven nor fixed, ascending.
    pub interior: Vec<usize>,
    /// T: displacements of `driven` from the interface coordinates [driven x interface].
    pub tie: SparseMatrix,
}

impl HousingPartition {
    /// The partition of a housing by the degrees of freedom that a tie drives.
    pub(super) fn new(model: &HousingModel, driven: Vec<usize>, tie: SparseMatrix) -> Self {
        let mut is_driven = vec![false; model.dof()];
        driven.iter().for_each(|&dof| is_driven[dof] = true);
        let free = model.free_dofs().into_iter();
        Self { interior: free.filter(|&dof| !is_driven[dof]).collect(), driven, tie }
    }
}

/// Nodes as an interface, and what could not be part of it.
#[derive(Debug, Clone)]
pub struct NodeInterface {
    /// The split: every free displacement of the nodes is a coordinate, node by node in the order given.
    pub partition: HousingPartition,
    /// Node (index) and component of every coordinate \[interface\].
    pub coordinates: Vec<(usize, usize)>,
    /// Displacements of the nodes (index, component) that a support holds or a link ties: they are no coordinates.
    pub held: Vec<(usize, usize)>,
}

impl NodeInterface {
    /// What holds or ties the displacements that are left out, in words.
    pub(crate) fn holders(&self, model: &HousingModel) -> String {
        let support = |&(node, component): &(usize, usize)| model.fixed[node][component];
        let supports: BTreeSet<usize> = self.held.iter().filter_map(support).collect();
        let groups = supports.iter().map(|&place| &model.description.supports[place].group);
        let mut words: Vec<String> = groups.map(|group| format!("the support \"{group}\"")).collect();
        if self.held.iter().any(|held| model.tied.contains_key(&held.0)) {
            words.push("a link".to_owned());
        }
        words.join(" and ")
    }

    /// Makes `nodes` (indices, each once) the interface of a housing.
    pub fn new(model: &HousingModel, nodes: &[usize]) -> Self {
        let d = model.dimension();
        let free = model.free_dofs();
        let wanted = nodes.iter().flat_map(|&node| (0..d).map(move |component| (node, component)));
        let (coordinates, held): (Vec<_>, Vec<_>) =
            wanted.partition(|&(node, component)| free.binary_search(&(d * node + component)).is_ok());
        let driven: Vec<usize> = coordinates.iter().map(|&(node, component)| d * node + component).collect();
        let identity = SparseMatrix::eye_csc(driven.len());
        Self { partition: HousingPartition::new(model, driven, identity), coordinates, held }
    }
}
