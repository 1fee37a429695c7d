//! Model to matrices: sparse stiffness and consistent mass of a housing, its weight, its mass.
//!
//! The pattern comes from the node graph once; element matrices are added into it in element order,
//! so that the sums do not depend on anything but the model.

mod pattern;

use crate::element::plane::{mass_into, stiffness_into};
use crate::linalg::{DenseMatrix, SparseMatrix, congruence};
use crate::model::{HousingModel, ModelError, RingTie};
use nalgebra::DMatrix;
use pattern::BlockPattern;

/// Matrices of a housing over all its degrees of freedom.
#[derive(Debug, Clone)]
pub struct SystemMatrices {
    /// Stiffness with springs [dof x dof], N/m.
    pub stiffness: SparseMatrix,
    /// Consistent mass with point masses [dof x dof], kg.
    pub mass: SparseMatrix,
    /// Mass times unit accelerations in x and in y [dof x 2], kg.
    pub weight: DenseMatrix,
}

impl SystemMatrices {
    /// Assembles a housing.
    ///
    /// # Errors
    /// [`ModelError::Element`] with the tag of an element that is inverted or degenerate.
    pub fn assemble(model: &HousingModel) -> Result<Self, ModelError> {
        let pattern = BlockPattern::new(model);
        let (mut k, mut m) = (pattern.zeros(), pattern.zeros());
        for element in &model.elements {
            let coordinates: Vec<[f64; 2]> = element
                .nodes
                .iter()
                .map(|&node| model.coordinates[node])
                .collect();
            let properties = &model.parts[element.part].properties;
            let dof = element.kind.dof();
            let mut local = DMatrix::zeros(dof, dof);
            let with_tag = |source| ModelError::Element {
                path: model.path.clone(),
                tag: element.tag,
                source,
            };
            stiffness_into(element.kind, &coordinates, properties, &mut local).map_err(with_tag)?;
            pattern.add(&mut k, &element.nodes, &local);
            mass_into(element.kind, &coordinates, properties, &mut local).map_err(with_tag)?;
            pattern.add(&mut m, &element.nodes, &local);
        }
        for spring in &model.springs {
            let local = DMatrix::from_fn(2, 2, |i, j| spring.matrix[i][j]);
            pattern.add(&mut k, &[spring.node], &local);
        }
        for &(node, mass) in &model.masses {
            pattern.add(&mut m, &[node], &DMatrix::from_diagonal_element(2, 2, mass));
        }
        let mass = pattern.matrix(m);
        Ok(Self {
            stiffness: pattern.matrix(k),
            weight: weight(&mass),
            mass,
        })
    }

    /// Mass of the housing, kg.
    pub fn total_mass(&self) -> f64 {
        (0..self.weight.nrows())
            .step_by(2)
            .map(|row| self.weight[(row, 0)])
            .sum()
    }

    /// The same matrices in the displacements that a tie's partition uses.
    pub fn for_tie(self, tie: &RingTie) -> Self {
        match tie.rotation() {
            None => self,
            Some(rotation) => Self {
                stiffness: congruence(&self.stiffness, rotation),
                mass: congruence(&self.mass, rotation),
                weight: crate::linalg::transpose_times_dense(rotation, &self.weight),
            },
        }
    }
}

fn weight(mass: &SparseMatrix) -> DenseMatrix {
    let mut weight = DenseMatrix::zeros(mass.rows(), 2);
    for (column, entries) in mass.outer_iterator().enumerate() {
        for (row, &value) in entries.iter() {
            weight[(row, column % 2)] += value;
        }
    }
    weight
}
