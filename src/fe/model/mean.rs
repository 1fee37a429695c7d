//! Interface coordinates that follow the interior: means over free nodes.

use crate::numerics::linalg::{SparseMatrix, TripletBuilder};

/// Interface coordinates that are means over free nodes: `W u = c`. Empty without such.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanTie {
    /// Which of the interface coordinates they are.
    pub coordinates: Vec<usize>,
    /// `W^T` [housing dof x coordinates]: what a displacement adds to each; rotations in 1/m.
    pub weights: SparseMatrix,
}

impl Default for MeanTie {
    fn default() -> Self {
        Self { coordinates: Vec::new(), weights: TripletBuilder::new(0, 0).build() }
    }
}

impl MeanTie {
    /// Degrees of freedom of the housing that the means are over.
    pub(crate) fn dofs(&self) -> Vec<usize> {
        let of_column = self.weights.outer_iterator().flat_map(|column| column.indices().to_vec());
        let dofs: std::collections::BTreeSet<usize> = of_column.collect();
        dofs.into_iter().collect()
    }

    /// Whether there is no such coordinate.
    pub(crate) fn is_empty(&self) -> bool {
        self.coordinates.is_empty()
    }
}
