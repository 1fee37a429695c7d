//! Mass, centroid and moments of inertia of a model, from its mass matrix.
//!
//! How much of the mass each mode sets in motion when the ground moves.

use super::error::{ModalError, check_count};
use super::rigid_motions;
use crate::fe::assembly::SystemMatrices;
use crate::fe::model::HousingModel;
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, sparse_times_dense};
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::Serialize;

/// What a model weighs and how that is spread, in the axes of its coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct MassProperties {
    /// Mass with point masses, kg, > 0.
    pub mass: f64,
    /// Where it is.
    pub distribution: MassDistribution,
}

/// Centroid and inertia, as far as the model knows them: a plane one knows neither its place along z nor its moments
/// about x and y.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MassDistribution {
    /// Of a plane model.
    Plane {
        /// x and y, m.
        centroid: [f64; 2],
        /// Moment of inertia about the axis along z through the centroid, kg m^2.
        polar: f64,
    },
    /// Of a model in space.
    Space {
        /// x, y, z, m.
        centroid: [f64; 3],
        /// Inertia `int rho (|r|^2 1 - r r^T) dV` about the centroid [3 x 3], kg m^2: products of inertia
        /// with a minus sign.
        inertia: [[f64; 3]; 3],
    },
}

/// Principal moments of inertia about the centroid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PrincipalInertia {
    /// Moments, kg m^2, ascending.
    pub moments: [f64; 3],
    /// Unit vectors of their axes, one a row, right-handed. Of equal moments any axes in their plane.
    pub axes: [[f64; 3]; 3],
}

impl MassProperties {
    /// From the rigid-body inertia `R^T M R` [3 x 3 or 6 x 6] of the motions about the point `about` (m), in the
    /// order of `rigid_motions`.
    ///
    /// With s from `about` to the centroid: `m` on the diagonal, `m e_k x s` beside it, and
    /// `I_c = I_about - m (|s|^2 1 - s s^T)`. Take `about` near the centroid: the difference loses digits
    /// otherwise. Source: Craig and Kurdila (2006).
    ///
    /// # Errors
    /// [`ModalError::Shape`] for another order, [`ModalError::NoMass`].
    pub fn from_rigid_inertia(rigid: &DenseMatrix, about: [f64; 3]) -> Result<Self, ModalError> {
        let plane = rigid.nrows() == 3;
        let order = if plane { 3 } else { 6 };
        check_count("rows of the rigid-body inertia", order, rigid.nrows())?;
        check_count("columns of the rigid-body inertia", order, rigid.ncols())?;
        let d = if plane { 2 } else { 3 };
        let mass = (0..d).map(|i| rigid[(i, i)]).sum::<f64>() / d as f64;
        if mass.is_nan() || mass <= 0.0 || mass.is_infinite() {
            return Err(ModalError::NoMass { mass });
        }
        let distribution = if plane {
            let s = [rigid[(1, 2)] / mass, -rigid[(0, 2)] / mass];
            MassDistribution::Plane {
                centroid: [about[0] + s[0], about[1] + s[1]],
                polar: rigid[(2, 2)] - mass * (s[0] * s[0] + s[1] * s[1]),
            }
        } else {
            let couples = |i: usize, axis: usize| rigid[(i, 3 + axis)] / mass;
            let s = Vector3::new(
                0.5 * (couples(1, 2) - couples(2, 1)),
                0.5 * (couples(2, 0) - couples(0, 2)),
                0.5 * (couples(0, 1) - couples(1, 0)),
            );
            let about_point = Matrix3::from_fn(|i, j| 0.5 * (rigid[(3 + i, 3 + j)] + rigid[(3 + j, 3 + i)]));
            let shift = (Matrix3::identity() * s.norm_squared() - s * s.transpose()) * mass;
            MassDistribution::Space {
                centroid: (Vector3::from(about) + s).into(),
                inertia: (about_point - shift).transpose().into(),
            }
        };
        Ok(Self { mass, distribution })
    }

    /// Of a housing with its point masses, fixed nodes included, in the mesh's axes.
    ///
    /// # Errors
    /// As [`Self::from_rigid_inertia`].
    pub fn of_housing(matrices: &SystemMatrices, model: &HousingModel) -> Result<Self, ModalError> {
        Self::about_centroid(&matrices.mass, middle(model), |about| {
            rigid_motions(&model.coordinates, model.dimension, about)
        })
    }

    /// By the mass matrix and its rigid motions about a point: about `start` (m), and a second time about the centroid itself, where
    /// nothing is left to subtract.
    ///
    /// # Errors
    /// As [`Self::from_rigid_inertia`].
    pub(super) fn about_centroid(
        mass: &SparseMatrix,
        start: [f64; 3],
        rigid: impl Fn([f64; 3]) -> DenseMatrix,
    ) -> Result<Self, ModalError> {
        let of = |about: [f64; 3]| {
            let r = rigid(about);
            Self::from_rigid_inertia(&(r.transpose() * sparse_times_dense(mass, &r)), about)
        };
        let first = of(start)?.centroid();
        of([0, 1, 2].map(|axis| first[axis].unwrap_or(start[axis])))
    }

    /// Coordinates of the centroid, m; z is `None` for a plane model.
    pub fn centroid(&self) -> [Option<f64>; 3] {
        match self.distribution {
            MassDistribution::Plane { centroid, .. } => [Some(centroid[0]), Some(centroid[1]), None],
            MassDistribution::Space { centroid, .. } => centroid.map(Some),
        }
    }

    /// Principal moments and axes; `None` for a plane model and for values that are not finite.
    pub fn principal(&self) -> Option<PrincipalInertia> {
        let MassDistribution::Space { inertia, .. } = self.distribution else {
            return None;
        };
        let inertia = Matrix3::from(inertia).transpose();
        if inertia.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let eigen = inertia.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let axis = |k: usize| -> Vector3<f64> {
            let axis = eigen.eigenvectors.column(order[k]).into_owned();
            // the largest component positive, so that a run repeats and reads well
            axis * axis[axis.iamax()].signum()
        };
        let (first, second) = (axis(0), axis(1));
        Some(PrincipalInertia {
            moments: order.map(|k| eigen.eigenvalues[k]),
            axes: [first, second, first.cross(&second)].map(Into::into),
        })
    }
}

/// Mean of the coordinates of the nodes that an element uses, m.
fn middle(model: &HousingModel) -> [f64; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0);
    for (point, _) in model.coordinates.iter().zip(&model.used).filter(|node| *node.1) {
        count += 1;
        for (sum, x) in sum.iter_mut().zip(point) {
            *sum += x;
        }
    }
    sum.map(|sum| sum / f64::from(count.max(1)))
}

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
#[path = "mass_properties_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "participation_tests.rs"]
mod participation_tests;
