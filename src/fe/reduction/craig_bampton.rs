//! Craig-Bampton condensation: constraint modes and a basis of the interior become a superelement.
//!
//! ```text
//! k = [[k_bb, 0], [0, diag(values)]]      m = [[m_bb, A^T Q], [Q^T A, 1]]
//! ```
//!
//! (Craig and Bampton, AIAA Journal 6 (1968) 1313-1319.) Static interface response is exact; frequencies converge from
//! above.
//!
//! A condensed housing as others use it: small matrices on its interface and on modal amplitudes.

use super::interior_basis::{BasisChoice, reduced_matrices};
use super::parts::rows_of;
use super::selection::choose_basis;
use super::{Attached, InteriorBasis, ReductionError, Substructure};
use crate::fe::assembly::SystemMatrices;
use crate::fe::model::HousingPartition;
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, sparse_times_dense, times, transpose_times_dense};
use crate::numerics::{Unwatched, Watch};

/// Columns that are condensed at once.
const BLOCK: usize = 64;

/// A condensed housing with the way back to its nodes.
#[derive(Debug, Clone)]
pub struct CraigBampton {
    /// The housing's split, its factor and its constraint modes.
    pub substructure: Substructure,
    /// What the interior may do beside following the interface.
    pub basis: InteriorBasis,
    /// The reduced matrices.
    pub superelement: Superelement,
}

/// Condenses a housing on the interface of `partition` with a basis as `choice` asks for; `attached` is what it will
/// be attached to, which decides which of its motions matter.
///
/// # Errors
/// [`ReductionError`] of the split, of the eigenvalue iteration, and of a basis that does not become good enough.
pub fn craig_bampton(
    matrices: &SystemMatrices,
    partition: &HousingPartition,
    choice: BasisChoice,
    attached: Option<Attached<'_>>,
) -> Result<CraigBampton, ReductionError> {
    craig_bampton_watched(matrices, partition, choice, attached, &Unwatched)
}

/// The same; `watch` is told of its stages.
///
/// # Errors
/// As [`craig_bampton`].
pub(crate) fn craig_bampton_watched(
    matrices: &SystemMatrices,
    partition: &HousingPartition,
    choice: BasisChoice,
    attached: Option<Attached<'_>>,
    watch: &dyn Watch,
) -> Result<CraigBampton, ReductionError> {
    let substructure = Substructure::watched(matrices, partition, watch)?;
    let basis = choose_basis(&substructure, choice, attached, watch)?;
    Ok(CraigBampton::new(substructure, basis, &matrices.weight))
}

impl CraigBampton {
    /// The superelement of a basis; `weight` is that of the housing along the bearing's x and y [dof x 2], kg.
    pub fn new(substructure: Substructure, basis: InteriorBasis, weight: &DenseMatrix) -> Self {
        let [stiffness, mass] = reduced_matrices(&substructure, &basis, None);
        let superelement = Superelement {
            stiffness,
            mass,
            weight: DenseMatrix::zeros(0, 0),
            structural: None,
            interface_dof: substructure.interface_dof(),
        };
        let mut condensed = Self { substructure, basis, superelement };
        condensed.superelement.weight = condensed.project(weight);
        condensed
    }

    /// The same with the imaginary part of the stiffness of lossy parts [dof x dof], N/m.
    pub(crate) fn with_structural(mut self, matrix: &SparseMatrix) -> Self {
        self.superelement.structural = Some(self.condensed(matrix));
        self
    }

    /// Loads on the coordinates [order x k] of loads on the degrees of freedom of the housing [dof x k]. The weight of
    /// the mesh stays the weight of the mesh, whatever the basis keeps.
    pub(crate) fn project(&self, load: &DenseMatrix) -> DenseMatrix {
        let partition = &self.substructure.partition;
        let (interior, driven) = (self.interior_of(load), rows_of(load, &partition.driven));
        let follow = times(self.substructure.constraint_modes.transpose(), interior.as_ref());
        let interface = transpose_times_dense(&partition.tie, &driven) + follow;
        faer::concat![[interface], [times(self.basis.vectors.transpose(), interior.as_ref())]]
    }

    /// `V^T A V` [order x order] of a matrix over the housing's degrees of freedom, V the columns of [`field`](Self::field).
    pub(crate) fn condensed(&self, matrix: &SparseMatrix) -> DenseMatrix {
        let order = self.superelement.order();
        let mut condensed = DenseMatrix::zeros(order, order);
        for first in (0..order).step_by(BLOCK) {
            let width = BLOCK.min(order - first);
            let unit = DenseMatrix::from_fn(order, width, |row, column| f64::from(u8::from(row == first + column)));
            let moved = sparse_times_dense(matrix, &self.field(&unit, matrix.rows()));
            condensed.subcols_mut(first, width).copy_from(&self.project(&moved));
        }
        condensed
    }

    /// Rows of the interior [interior x k] of loads or motions over the housing's degrees of freedom [dof x k].
    pub(crate) fn interior_of(&self, all: &DenseMatrix) -> DenseMatrix {
        rows_of(all, &self.substructure.partition.interior)
    }

    /// The same housing with further vectors in its basis: the static response to forces on the interior [interior x k], so that it
    /// is exact for them too. Structural damping is to be added again.
    ///
    /// # Errors
    /// As [`InteriorBasis::extended`].
    pub(crate) fn with_forces(self, forces: DenseMatrix, weight: &DenseMatrix) -> Result<Self, ReductionError> {
        let static_response = self.substructure.solve_interior(forces)?;
        let basis = self.basis.extended(&self.substructure, static_response)?;
        Ok(Self::new(self.substructure, basis, weight))
    }

    /// Data recovery: the row that gives a degree of freedom of the housing from the coordinates
    /// \[order\]; `None` for one that is fixed.
    pub(crate) fn recovery_row(&self, dof: usize) -> Option<Vec<f64>> {
        let partition = &self.substructure.partition;
        if let Ok(place) = partition.interior.binary_search(&dof) {
            let (psi, q) = (self.substructure.constraint_modes.row(place), self.basis.vectors.row(place));
            return Some(psi.iter().chain(q.iter()).copied().collect());
        }
        let place = partition.driven.iter().position(|&b| b == dof)?;
        let mut row = vec![0.0; self.superelement.order()];
        for (column, entries) in partition.tie.outer_iterator().enumerate() {
            row[column] = entries.get(place).copied().unwrap_or(0.0);
        }
        Some(row)
    }

    /// Whole-field recovery: displacements over all degrees of freedom of the housing [dof x k] for coordinates
    /// [order x k]; fixed ones are zero.
    pub(crate) fn field(&self, coordinates: &DenseMatrix, dof: usize) -> DenseMatrix {
        let partition = &self.substructure.partition;
        let interface = self.superelement.interface_dof;
        let boundary = coordinates.subrows(0, interface);
        let amplitudes = coordinates.subrows(interface, self.basis.count());
        let following = times(self.substructure.constraint_modes.as_ref(), boundary);
        let interior = following + times(self.basis.vectors.as_ref(), amplitudes);
        let driven = sparse_times_dense(&partition.tie, &boundary.to_owned());
        let mut all = self.interior_field(&interior, dof);
        for column in 0..coordinates.ncols() {
            let to = all.col_as_slice_mut(column);
            for (&dof, &value) in partition.driven.iter().zip(driven.col_as_slice(column)) {
                to[dof] = value;
            }
        }
        all
    }

    /// Displacements over all degrees of freedom of the housing [dof x k] of motions of the interior alone [interior x k].
    pub(super) fn interior_field(&self, interior: &DenseMatrix, dof: usize) -> DenseMatrix {
        let mut all = DenseMatrix::zeros(dof, interior.ncols());
        for column in 0..interior.ncols() {
            let to = all.col_as_slice_mut(column);
            let inside = &self.substructure.partition.interior;
            for (&dof, &value) in inside.iter().zip(interior.col_as_slice(column)) {
                to[dof] = value;
            }
        }
        all
    }
}

/// A housing condensed on its interface. Coordinates: the interface first, then the amplitudes of the interior's
/// vectors.
#[derive(Debug, Clone, PartialEq)]
pub struct Superelement {
    /// k [order x order], N/m.
    pub stiffness: DenseMatrix,
    /// m [order x order], kg.
    pub mass: DenseMatrix,
    /// Mass times unit accelerations along the bearing's x and y, on the coordinates [order x 2], kg.
    pub weight: DenseMatrix,
    /// Imaginary part of the stiffness by the parts' loss factors [order x order], N/m; `None` without any.
    pub structural: Option<DenseMatrix>,
    /// Number of interface coordinates, <= order.
    pub interface_dof: usize,
}

impl Superelement {
    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Number of modal amplitudes.
    pub fn modal_dof(&self) -> usize {
        self.order() - self.interface_dof
    }

    /// Weight on the coordinates for a gravity vector in m/s^2 \[order\].
    pub fn gravity_load(&self, gravity: [f64; 2]) -> Vec<f64> {
        (0..self.order()).map(|row| self.weight[(row, 0)] * gravity[0] + self.weight[(row, 1)] * gravity[1]).collect()
    }
}

#[cfg(test)]
#[path = "craig_bampton_tests.rs"]
mod tests;
