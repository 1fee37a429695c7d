//! A housing, rings, or the housing with rings in its bores in one system of sparse matrices, nothing condensed.

use super::SystemMatrices;
use crate::fe::model::{HousingModel, HousingPartition, RingTie, Rings};
use crate::numerics::linalg::{
    DenseMatrix, Ordering, SparseMatrix, TripletBuilder, congruence, placed, sparse_times_dense, transpose_times_dense,
};

/// Stiffness and mass over the housing's degrees of freedom, then the rings'; one of the two may be missing. Rows and
/// columns of what the tie drives are empty: their share is with the rings.
#[derive(Debug, Clone)]
pub struct CoupledMatrices {
    /// Stiffness [n x n], N/m.
    pub stiffness: SparseMatrix,
    /// Mass [n x n], kg.
    pub mass: SparseMatrix,
    /// Free degrees of freedom, ascending: the housing's interior and the rings.
    pub free_dofs: Vec<usize>,
    /// What the coordinates mean.
    pub motions: CoupledMotions,
    /// Order in which the free degrees of freedom are factorised, if it is known.
    pub(crate) ordering: Option<Ordering>,
}

/// Displacements of housing and rings from the coordinates of both, and back.
#[derive(Debug, Clone)]
pub struct CoupledMotions {
    /// Housing displacements in the mesh's axes from all coordinates [housing dof x n].
    recovery: SparseMatrix,
    housing_dof: usize,
    ring_dof: usize,
}

impl CoupledMatrices {
    /// Couples a housing to the rings in its bores.
    pub fn new(matrices: &SystemMatrices, tie: &RingTie, rings: &Rings) -> Self {
        Self::with_centres(matrices, tie, rings, tie.partition())
    }

    /// The same where the partition has coordinates of centre nodes after those of the rings.
    pub(crate) fn with_centres(
        matrices: &SystemMatrices,
        tie: &RingTie,
        rings: &Rings,
        partition: &HousingPartition,
    ) -> Self {
        let housing_dof = matrices.stiffness.rows();
        let order = housing_dof + partition.tie.cols();
        let mut recovery = recovery(housing_dof, partition);
        if let Some(rotation) = tie.rotation() {
            recovery = (rotation * &recovery).to_csc();
        }
        let with_rings = |housing: &SparseMatrix, rings: &DenseMatrix| {
            &congruence(housing, &recovery) + &placed(rings, housing_dof, order)
        };
        Self {
            stiffness: with_rings(&matrices.stiffness, rings.stiffness()),
            mass: with_rings(&matrices.mass, rings.mass()),
            free_dofs: free_dofs(housing_dof, partition),
            motions: CoupledMotions { recovery, housing_dof, ring_dof: rings.dof() },
            ordering: None,
        }
    }

    /// A housing whose partition drives some of its displacements, as a rigid centre node does. Coordinates that only follow, those of
    /// nodes in the mean, have empty rows and are not free.
    pub(crate) fn of_partition(matrices: &SystemMatrices, partition: &HousingPartition) -> Self {
        let housing_dof = matrices.stiffness.rows();
        let recovery = recovery(housing_dof, partition);
        Self {
            stiffness: congruence(&matrices.stiffness, &recovery),
            mass: congruence(&matrices.mass, &recovery),
            free_dofs: free_dofs(housing_dof, partition),
            motions: CoupledMotions { recovery, housing_dof, ring_dof: 0 },
            ordering: None,
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
            ordering: matrices.ordering,
        }
    }

    /// Rings alone.
    pub(crate) fn of_rings(rings: &Rings) -> Self {
        Self::of_condensed(rings.stiffness(), rings.mass(), rings.dof())
    }

    /// Rings in a housing that is condensed already: stiffness and mass [n x n] over the rings' displacements, then
    /// over amplitudes of the housing's modes. Nothing of the housing can be recovered.
    pub(crate) fn of_condensed(stiffness: &DenseMatrix, mass: &DenseMatrix, ring_dof: usize) -> Self {
        let order = stiffness.nrows();
        Self {
            stiffness: placed(stiffness, 0, order),
            mass: placed(mass, 0, order),
            free_dofs: (0..order).collect(),
            motions: CoupledMotions { recovery: TripletBuilder::new(0, order).build(), housing_dof: 0, ring_dof },
            ordering: None,
        }
    }
}

/// The interior, and the coordinates of the interface that do not only follow.
fn free_dofs(housing_dof: usize, partition: &HousingPartition) -> Vec<usize> {
    let driving = |coordinate: &usize| !partition.mean.coordinates.contains(coordinate);
    let driving = (0..partition.tie.cols()).filter(driving).map(|coordinate| housing_dof + coordinate);
    partition.interior.iter().copied().chain(driving).collect()
}

/// Housing displacements in the partition's axes from all coordinates, those of the interface last [housing dof x n].
fn recovery(housing_dof: usize, partition: &HousingPartition) -> SparseMatrix {
    let mut driven = vec![false; housing_dof];
    let mut expand = TripletBuilder::new(housing_dof, housing_dof + partition.tie.cols());
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
    expand.build()
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
    /// coordinates of housing and rings [n x n]; the rings add nothing.
    pub fn congruent(&self, housing: &SparseMatrix) -> SparseMatrix {
        congruence(housing, &self.recovery)
    }

    /// Displacements of the rings [ring dof x k] for coordinates x [n x k].
    pub(crate) fn rings(&self, x: &DenseMatrix) -> DenseMatrix {
        x.submatrix(self.housing_dof, 0, self.ring_dof, x.ncols()).to_owned()
    }

    /// Coordinates [n x k] of motions given for the housing in the mesh's axes [housing dof x k] and for the rings
    /// [ring dof x k]. What the tie drives follows the rings.
    pub(crate) fn coordinates(&self, housing: &DenseMatrix, rings: &DenseMatrix) -> DenseMatrix {
        // the recovery's columns of the housing are orthonormal or empty
        let mut x = transpose_times_dense(&self.recovery, housing);
        for column in 0..x.ncols() {
            for row in 0..rings.nrows() {
                x[(self.housing_dof + row, column)] = rings[(row, column)];
            }
        }
        x
    }
}
