//! Dense matrices of a system, and where forces act and motions are read.

use super::FrfError;
use crate::numerics::linalg::DenseMatrix;
use faer::Scale;

/// `Z(w) = k - w^2 m + i (w c + k_s)` in dense real symmetric matrices.
#[derive(Debug, Clone)]
pub struct ReducedSystem {
    stiffness: DenseMatrix,
    mass: DenseMatrix,
    viscous: Option<DenseMatrix>,
    structural: Option<DenseMatrix>,
}

/// Where forces act and motions are read.
#[derive(Debug, Clone)]
pub struct FrfPaths {
    /// Load vectors in columns [n x p]: the coordinates' forces for a unit of each load.
    pub loads: DenseMatrix,
    /// Sensor rows [s x n]: displacement read for a unit of each coordinate.
    pub sensors: DenseMatrix,
}

impl ReducedSystem {
    /// A system without damping from stiffness and mass [n x n].
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn new(stiffness: DenseMatrix, mass: DenseMatrix) -> Result<Self, FrfError> {
        let order = stiffness.nrows();
        square("stiffness", &stiffness, order)?;
        square("mass", &mass, order)?;
        Ok(Self { stiffness, mass, viscous: None, structural: None })
    }

    /// Adds viscous damping c [n x n], N s/m, to what there is.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn with_viscous(mut self, viscous: DenseMatrix) -> Result<Self, FrfError> {
        square("viscous damping", &viscous, self.order())?;
        self.viscous = sum(self.viscous, viscous);
        Ok(self)
    }

    /// Adds structural damping k_s [n x n], N/m (sum of loss factor times stiffness), to what there is.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn with_structural(mut self, structural: DenseMatrix) -> Result<Self, FrfError> {
        square("structural damping", &structural, self.order())?;
        self.structural = sum(self.structural, structural);
        Ok(self)
    }

    /// Adds `alpha m + beta k` to the viscous damping; alpha in 1/s, beta in s, both >= 0.
    ///
    /// # Errors
    /// [`FrfError`].
    pub fn with_rayleigh(self, alpha: f64, beta: f64) -> Result<Self, FrfError> {
        super::error::check_coefficients(&[("alpha", alpha), ("beta", beta)])?;
        let damping = &self.mass * Scale(alpha) + &self.stiffness * Scale(beta);
        self.with_viscous(damping)
    }

    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// k [n x n].
    pub fn stiffness(&self) -> &DenseMatrix {
        &self.stiffness
    }

    /// m [n x n].
    pub fn mass(&self) -> &DenseMatrix {
        &self.mass
    }

    /// c [n x n], if there is any.
    pub fn viscous(&self) -> Option<&DenseMatrix> {
        self.viscous.as_ref()
    }

    /// k_s [n x n], if there is any.
    pub fn structural(&self) -> Option<&DenseMatrix> {
        self.structural.as_ref()
    }

    /// Whether the paths are over this system's coordinates.
    pub(super) fn check(&self, paths: &FrfPaths) -> Result<(), FrfError> {
        same("rows of the loads", self.order(), paths.loads.nrows())?;
        same("columns of the sensors", self.order(), paths.sensors.ncols())
    }
}

fn sum(before: Option<DenseMatrix>, more: DenseMatrix) -> Option<DenseMatrix> {
    match before {
        Some(before) => Some(before + more),
        None => Some(more),
    }
}

fn square(what: &'static str, matrix: &DenseMatrix, order: usize) -> Result<(), FrfError> {
    same(what, order, matrix.nrows())?;
    same(what, order, matrix.ncols())
}

pub(super) fn same(what: &'static str, expected: usize, found: usize) -> Result<(), FrfError> {
    if found == expected { Ok(()) } else { Err(FrfError(format!("{what}: expected {expected}, found {found}"))) }
}
