//! The sparsity pattern of a model with two displacements a node, and how to add blocks into it.

use crate::linalg::SparseMatrix;
use crate::model::HousingModel;
use nalgebra::DMatrix;
use nalgebra_sparse::pattern::SparsityPattern;

/// Compressed columns of 2 x 2 blocks over the node graph.
pub(super) struct BlockPattern {
    /// Sorted neighbours of every node, itself included.
    neighbours: Vec<Vec<usize>>,
    /// Where the first of a node's two columns starts among the values.
    starts: Vec<usize>,
    entries: usize,
}

impl BlockPattern {
    pub fn new(model: &HousingModel) -> Self {
        // unused nodes keep their diagonal block, so that the matrix has every degree of freedom
        let mut neighbours: Vec<Vec<usize>> = (0..model.coordinates.len())
            .map(|node| vec![node])
            .collect();
        for element in &model.elements {
            for &node in &element.nodes {
                neighbours[node].extend_from_slice(&element.nodes);
            }
        }
        let mut starts = Vec::with_capacity(neighbours.len());
        let mut entries = 0;
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
            starts.push(entries);
            entries += 4 * list.len();
        }
        Self {
            neighbours,
            starts,
            entries,
        }
    }

    /// Values of a matrix without entries.
    pub fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.entries]
    }

    /// Adds an element matrix (two rows a node) over the given nodes.
    pub fn add(&self, values: &mut [f64], nodes: &[usize], local: &DMatrix<f64>) {
        for (b, &column_node) in nodes.iter().enumerate() {
            let list = &self.neighbours[column_node];
            for (a, row_node) in nodes.iter().enumerate() {
                // every pair of nodes of an element is in the graph by construction
                let Ok(place) = list.binary_search(row_node) else {
                    continue;
                };
                for j in 0..2 {
                    let column = self.starts[column_node] + 2 * j * list.len();
                    for i in 0..2 {
                        values[column + 2 * place + i] += local[(2 * a + i, 2 * b + j)];
                    }
                }
            }
        }
    }

    /// The matrix of these values.
    pub fn matrix(&self, values: Vec<f64>) -> SparseMatrix {
        let order = 2 * self.neighbours.len();
        let mut offsets = Vec::with_capacity(order + 1);
        let mut rows = Vec::with_capacity(self.entries);
        offsets.push(0);
        for list in &self.neighbours {
            for _ in 0..2 {
                rows.extend(list.iter().flat_map(|&node| [2 * node, 2 * node + 1]));
                offsets.push(rows.len());
            }
        }
        debug_assert!(
            SparsityPattern::try_from_offsets_and_indices(
                order,
                order,
                offsets.clone(),
                rows.clone()
            )
            .is_ok()
        );
        sprs::CsMat::new_csc((order, order), offsets, rows, values)
    }
}
