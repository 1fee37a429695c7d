//! A condensed housing: its matrices, and the way back to its nodes.

use crate::linalg::{DenseMatrix, transpose_times_dense};
use crate::model::HousingPartition;

/// A housing condensed on its interface. Coordinates: the interface first, then the amplitudes of
/// the fixed-interface modes.
#[derive(Debug, Clone)]
pub struct Superelement {
    partition: HousingPartition,
    stiffness: DenseMatrix,
    mass: DenseMatrix,
    constraint_modes: DenseMatrix,
    fixed_modes: DenseMatrix,
    /// Mass times unit accelerations in x and in y, on the coordinates [order x 2], kg.
    weight: DenseMatrix,
}

impl Superelement {
    pub(super) fn new(
        partition: HousingPartition,
        stiffness: DenseMatrix,
        mass: DenseMatrix,
        constraint_modes: DenseMatrix,
        fixed_modes: DenseMatrix,
        nodal_weight: &DenseMatrix,
    ) -> Self {
        let mut element = Self {
            partition,
            stiffness,
            mass,
            constraint_modes,
            fixed_modes,
            weight: DenseMatrix::zeros(0, 2),
        };
        element.weight = element.reduced_weight(nodal_weight);
        element
    }

    /// Number of interface coordinates.
    pub fn interface_dof(&self) -> usize {
        self.partition.tie.cols()
    }

    /// Number of fixed-interface modes.
    pub fn fixed_interface_modes(&self) -> usize {
        self.fixed_modes.ncols()
    }

    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// k [order x order].
    pub fn stiffness(&self) -> &DenseMatrix {
        &self.stiffness
    }

    /// m [order x order].
    pub fn mass(&self) -> &DenseMatrix {
        &self.mass
    }

    /// How the housing's degrees of freedom were split.
    pub fn partition(&self) -> &HousingPartition {
        &self.partition
    }

    /// Data recovery: the row that gives a degree of freedom of the housing from the coordinates
    /// \[order\]; `None` for one that is fixed.
    pub fn recovery_row(&self, dof: usize) -> Option<Vec<f64>> {
        let interface = self.interface_dof();
        if let Some(place) = self.partition.interior.iter().position(|&i| i == dof) {
            let constraint = (0..interface).map(|column| self.constraint_modes[(place, column)]);
            let modal = (0..self.fixed_modes.ncols()).map(|mode| self.fixed_modes[(place, mode)]);
            return Some(constraint.chain(modal).collect());
        }
        let place = self.partition.driven.iter().position(|&b| b == dof)?;
        let mut row = vec![0.0; self.order()];
        for (column, entries) in self.partition.tie.outer_iterator().enumerate() {
            row[column] = entries.get(place).copied().unwrap_or(0.0);
        }
        Some(row)
    }

    /// Weight on the coordinates for a gravity vector in m/s^2 \[order\].
    pub fn gravity_load(&self, gravity: [f64; 2]) -> Vec<f64> {
        (0..self.order())
            .map(|row| self.weight[(row, 0)] * gravity[0] + self.weight[(row, 1)] * gravity[1])
            .collect()
    }

    /// Projects the mesh's own inertia load [dof x 2], so that the weight is that of the mesh
    /// whatever the reduction keeps.
    fn reduced_weight(&self, nodal: &DenseMatrix) -> DenseMatrix {
        let pick = |dofs: &[usize]| {
            DenseMatrix::from_fn(dofs.len(), 2, |row, column| nodal[(dofs[row], column)])
        };
        let interior = pick(&self.partition.interior);
        let driven = pick(&self.partition.driven);
        let tied = transpose_times_dense(&self.partition.tie, &driven);
        let interface = tied + self.constraint_modes.transpose() * &interior;
        let modal = self.fixed_modes.transpose() * &interior;
        DenseMatrix::from_fn(self.order(), 2, |row, column| {
            match row.checked_sub(self.interface_dof()) {
                None => interface[(row, column)],
                Some(mode) => modal[(mode, column)],
            }
        })
    }
}
