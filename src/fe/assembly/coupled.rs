//! A housing, a ring, or the housing with the ring in its bore in one system of sparse matrices, nothing condensed.

use super::SystemMatrices;
use crate::fe::model::{HousingModel, Ring, RingTie};
use crate::numerics::linalg::{
    DenseMatrix, SparseMatrix, TripletBuilder, congruence, placed, sparse_times_dense, transpose_times_dense,
};

/// Stiffness and mass over the housing's degrees of freedom, then the ring's; one of the two may be missing. Rows and
/// columns of what the tie drives are empty: their share is with the ring.
#[derive(Debug, Clone)]
pub struct CoupledMatrices {
    /// Stiffness [n x n], N/m.
    pub stiffness: SparseMatrix,
    /// Mass [n x n], kg.
    pub mass: SparseMatrix,
    /// Free degrees of freedom, ascending: the housing's interior and the ring.
    pub free_dofs: Vec<usize>,
    /// What the coordinates mean.
    pub motions: CoupledMotions,
}

/// Displacements of housing and ring from the coordinates of both, and back.
#[derive(Debug, Clone)]
pub struct CoupledMotions {
    /// Housing displacements in the mesh's axes from all coordinates [housing dof x n].
    recovery: SparseMatrix,
    housing_dof: usize,
    ring_dof: usize,
}

impl CoupledMatrices {
    /// Couples a housing to a ring.
    pub fn new(matrices: &SystemMatrices, tie: &RingTie, ring: &Ring) -> Self {
        let partition = tie.partition();
        let housing_dof = matrices.stiffness.rows();
        let order = housing_dof + ring.dof();
        let mut driven = vec![false; housing_dof];
        let mut expand = TripletBuilder::new(housing_dof, order);
        for &dof in &partition.driven {
            driven[dof] = true;
        }
        for (column, entries) in partition.tie.outer_iterator().enumerate() {
            for (row, &value) in entries.iter() {
                expand.add(partition.driven[row], housing_dof + column, value);
            }
        }
        for dof in (0..housing_dof).filter(|&dof| !driven[dof]) {
            expand.add(dof, dof, 1.0);
        }
        let mut recovery = expand.build();
        if let Some(rotation) = tie.rotation() {
            recovery = (rotation * &recovery).to_csc();
        }
        let with_ring = |housing: &SparseMatrix, ring: &DenseMatrix| {
            &congruence(housing, &recovery) + &placed(ring, housing_dof, order)
        };
        let ring_dofs = housing_dof..order;
        Self {
            stiffness: with_ring(&matrices.stiffness, ring.stiffness()),
            mass: with_ring(&matrices.mass, ring.mass()),
            free_dofs: partition.interior.iter().copied().chain(ring_dofs).collect(),
            motions: CoupledMotions { recovery, housing_dof, ring_dof: ring.dof() },
        }
    }

    /// A housing alone; its matrices are used up.
    pub(crate) fn of_housing(matrices: SystemMatrices, model: &HousingModel) -> Self {
        Self {
            stiffness: matrices.stiffness,
            mass: matrices.mass,
            free_dofs: model.free_dofs(),
            motions: CoupledMotions {
                recovery: SparseMatrix::eye_csc(model.dof()),
                housing_dof: model.dof(),
                ring_dof: 0,
            },
        }
    }

    /// A ring alone.
    pub(crate) fn of_ring(ring: &Ring) -> Self {
        Self::of_condensed(ring.stiffness(), ring.mass(), ring.dof())
    }

    /// A ring in a housing that is condensed already: stiffness and mass [n x n] over the ring's displacements, then
    /// over amplitudes of the housing's modes. Nothing of the housing can be recovered.
    pub(crate) fn of_condensed(stiffness: &DenseMatrix, mass: &DenseMatrix, ring_dof: usize) -> Self {
        let order = stiffness.nrows();
        Self {
            stiffness: placed(stiffness, 0, order),
            mass: placed(mass, 0, order),
            free_dofs: (0..order).collect(),
            motions: CoupledMotions { recovery: TripletBuilder::new(0, order).build(), housing_dof: 0, ring_dof },
        }
    }
}

impl CoupledMotions {
    /// Displacements of the housing in the mesh's axes [housing dof x k] for coordinates x [n x k], tied nodes filled
    /// in.
    pub(crate) fn housing(&self, model: &HousingModel, x: &DenseMatrix) -> DenseMatrix {
        let moved = sparse_times_dense(&self.recovery, x);
        match model.tie_matrix() {
            Some(tie) => sparse_times_dense(&tie, &moved),
            None => moved,
        }
    }

    /// A matrix of the housing in the mesh's axes [housing dof x housing dof], such as its structural damping, over the
    /// coordinates of housing and ring [n x n]; the ring adds nothing.
    pub fn congruent(&self, housing: &SparseMatrix) -> SparseMatrix {
        congruence(housing, &self.recovery)
    }

    /// Displacements of the ring [ring dof x k] for coordinates x [n x k].
    pub(crate) fn ring(&self, x: &DenseMatrix) -> DenseMatrix {
        x.submatrix(self.housing_dof, 0, self.ring_dof, x.ncols()).to_owned()
    }

    /// Coordinates [n x k] of motions given for the housing in the mesh's axes [housing dof x k] and for the ring
    /// [ring dof x k]. What the tie drives follows the ring.
    pub(crate) fn coordinates(&self, housing: &DenseMatrix, ring: &DenseMatrix) -> DenseMatrix {
        // the recovery's columns of the housing are orthonormal or empty
        let mut x = transpose_times_dense(&self.recovery, housing);
        for column in 0..x.ncols() {
            for row in 0..ring.nrows() {
                x[(self.housing_dof + row, column)] = ring[(row, column)];
            }
        }
        x
    }
}
