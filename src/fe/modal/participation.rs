//! How much of the mass each mode sets in motion when the ground moves.

use super::error::{ModalError, check_count};
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, sparse_times_dense};

/// Participation factors and effective masses of modes.
///
/// Columns are rigid motions: x, y, rotation about z; or x, y, z and rotations about x, y, z
/// (`rigid_motions`). A ground that moves along one of them loads mode k by
/// `Gamma_k`; the forces on the ground in that mode are those of the effective mass on a spring. Source: Craig
/// and Kurdila (2006).
#[derive(Debug, Clone, PartialEq)]
pub struct Participation {
    /// `Gamma = Phi^T M R` [count x 3 or 6], kg^1/2 (rotations kg^1/2 m) for mass-normalised modes.
    pub factors: DenseMatrix,
    /// `Gamma_kj^2 / (phi_k^T M phi_k)` [count x 3 or 6], kg (rotations kg m^2).
    pub effective: DenseMatrix,
    /// Effective mass of all modes given, by direction, kg or kg m^2.
    pub sums: Vec<f64>,
    /// `(R^T M R)_jj`: mass and, with R about the centroid, moments of inertia, kg or kg m^2. What fixed nodes
    /// carry is in it and in no mode.
    pub totals: Vec<f64>,
}

impl Participation {
    /// From the mass M [dof x dof] over all degrees of freedom, fixed ones included; modes Phi [dof x count] with
    /// zeros where the model is fixed; rigid motions R [dof x 3 or 6].
    ///
    /// # Errors
    /// [`ModalError::Shape`] if the numbers of rows differ, [`ModalError::NoMass`] for a mode that moves no mass.
    pub fn new(mass: &SparseMatrix, shapes: &DenseMatrix, rigid: &DenseMatrix) -> Result<Self, ModalError> {
        check_count("columns of the mass matrix", mass.rows(), mass.cols())?;
        check_count("rows of the modes", mass.rows(), shapes.nrows())?;
        check_count("rows of the rigid motions", mass.rows(), rigid.nrows())?;
        let mass_times_shapes = sparse_times_dense(mass, shapes);
        let mut generalised = Vec::with_capacity(shapes.ncols());
        for mode in 0..shapes.ncols() {
            let own: f64 = shapes.col(mode).transpose() * mass_times_shapes.col(mode);
            if own.is_nan() || own <= 0.0 {
                return Err(ModalError::NoMass { mass: own });
            }
            generalised.push(own);
        }
        let moved = sparse_times_dense(mass, rigid);
        Ok(Self::with_masses(&moved, shapes, rigid, &generalised))
    }

    /// The same for mass-normalised modes, `Phi^T M Phi = 1`, as an eigensolver returns them, from `moved = M R`: the
    /// mass itself is not needed any more.
    ///
    /// # Errors
    /// [`ModalError::Shape`] if the numbers of rows differ.
    pub(crate) fn of_normalised(
        moved: &DenseMatrix,
        shapes: &DenseMatrix,
        rigid: &DenseMatrix,
    ) -> Result<Self, ModalError> {
        check_count("rows of the modes", moved.nrows(), shapes.nrows())?;
        check_count("rows of the rigid motions", moved.nrows(), rigid.nrows())?;
        let ones = vec![1.0; shapes.ncols()];
        Ok(Self::with_masses(moved, shapes, rigid, &ones))
    }

    fn with_masses(moved: &DenseMatrix, shapes: &DenseMatrix, rigid: &DenseMatrix, generalised: &[f64]) -> Self {
        let factors = shapes.transpose() * moved;
        let effective = DenseMatrix::from_fn(factors.nrows(), factors.ncols(), |mode, j| {
            factors[(mode, j)].powi(2) / generalised[mode]
        });
        let sum = |j: usize| effective.col(j).iter().sum();
        let total = |j: usize| rigid.col(j).transpose() * moved.col(j);
        Self {
            sums: (0..rigid.ncols()).map(sum).collect(),
            totals: (0..rigid.ncols()).map(total).collect(),
            factors,
            effective,
        }
    }

    /// Share of the total that one mode moves, 0 to 1; `None` if there is no such mode or direction, or nothing
    /// to move in it.
    pub fn fraction(&self, mode: usize, direction: usize) -> Option<f64> {
        let total = self.totals.get(direction).filter(|total| **total > 0.0)?;
        (mode < self.effective.nrows()).then(|| self.effective[(mode, direction)] / total)
    }
}

#[cfg(test)]
#[path = "participation_tests.rs"]
mod tests;
