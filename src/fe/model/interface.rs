//! Nodes of the mesh as the interface of a condensed housing.

use super::{HousingModel, HousingPartition};
use crate::numerics::linalg::TripletBuilder;
use std::collections::BTreeSet;

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
    pub fn holders(&self, model: &HousingModel) -> String {
        let support = |&(node, component): &(usize, usize)| model.fixed[node][component];
        let supports: BTreeSet<usize> = self.held.iter().filter_map(support).collect();
        let groups = supports.iter().map(|&place| &model.supports[place].group);
        let mut words: Vec<String> = groups
            .map(|group| format!("the support \"{group}\""))
            .collect();
        if self
            .held
            .iter()
            .any(|held| model.tied.contains_key(&held.0))
        {
            words.push("a link".to_owned());
        }
        words.join(" and ")
    }

    /// Makes `nodes` (indices, each once) the interface of a housing.
    pub fn new(model: &HousingModel, nodes: &[usize]) -> Self {
        let d = model.dimension();
        let free = model.free_dofs();
        let wanted = nodes
            .iter()
            .flat_map(|&node| (0..d).map(move |component| (node, component)));
        let (coordinates, held): (Vec<_>, Vec<_>) = wanted
            .partition(|&(node, component)| free.binary_search(&(d * node + component)).is_ok());
        let driven: Vec<usize> = coordinates
            .iter()
            .map(|&(node, component)| d * node + component)
            .collect();
        let mut on_interface = vec![false; model.dof()];
        let mut identity = TripletBuilder::new(driven.len(), driven.len());
        for (row, &dof) in driven.iter().enumerate() {
            on_interface[dof] = true;
            identity.add(row, row, 1.0);
        }
        Self {
            partition: HousingPartition {
                interior: free.into_iter().filter(|&dof| !on_interface[dof]).collect(),
                driven,
                tie: identity.build(),
            },
            coordinates,
            held,
        }
    }
}
