//! Material, thickness and plane assumption of a part, reduced to what an element integrates with.

use crate::fe::element::ElementError;
use crate::fe::material::ElasticMaterial;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::array::from_fn;

/// Poisson's ratio of steel.
const STEEL_POISSON: f64 = 0.3;

/// What vanishes across a plane model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PlaneAssumption {
    /// Stress across the plane is zero: thin parts, free faces.
    Stress,
    /// Strain across the plane is zero: long parts, or a slice held between its neighbours.
    Strain,
}

/// What a continuum element needs beside its coordinates; built by [`ContinuumProperties::solid`] or
/// `ContinuumProperties::plane`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContinuumProperties {
    /// 2 for a plane part, 3 for a solid one.
    pub(super) dimension: usize,
    /// Density rho, kg/m^3.
    pub(crate) density: f64,
    /// Thickness t of a plane part, m; 1 (no unit) for a solid one, so that `t` may stand before any integral.
    pub(crate) thickness: f64,
    pub(super) elasticity: Elasticity,
}

/// The elasticity as the stiffness loop wants it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "one a part, read by every element: a box would only add a jump")]
pub(super) enum Elasticity {
    /// `sigma_ij = lambda eps_kk delta_ij + 2 mu eps_ij`, Pa; in plane stress with the lambda of plane stress.
    Isotropic { lambda: f64, mu: f64 },
    /// `C_ijkl` as `[i][j][k][l]`, Pa; of a plane element the first two indices each.
    General(Tensor),
}

/// `C_ijkl`, Pa.
pub(super) type Tensor = [[[[f64; 3]; 3]; 3]; 3];

/// The Voigt index of the component (i, j), in the order xx, yy, zz, xy, yz, xz.
const VOIGT: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// How far the material's z may lean from the normal of the plane: the rounding of its orthonormalisation, and
/// directions typed with nine digits.
const LEAN: f64 = 1e-9;

impl ContinuumProperties {
    /// Properties of a solid part.
    pub fn solid(material: &ElasticMaterial) -> Self {
        let elasticity = match material {
            ElasticMaterial::Isotropic(material) => {
                Elasticity::Isotropic { lambda: material.lame_lambda(), mu: material.shear_modulus() }
            }
            ElasticMaterial::Orthotropic(material) => general(&material.stiffness_matrix()),
        };
        Self { dimension: 3, density: material.density(), thickness: 1.0, elasticity }
    }

    /// Properties of a plane part in the xy plane with a thickness in metres, > 0.
    ///
    /// Plane strain takes the rows xx, yy, xy of the material's 6 x 6 stiffness C; plane stress condenses the
    /// strain zz from them: `C_pq - C_pz C_zq / C_zz`. For an isotropic material that is lambda itself, and
    /// `lambda' = E nu / (1 - nu^2)`; mu is the same. Source: Bathe, table 4.3.
    ///
    /// # Errors
    /// [`ElementError`] if it is not positive and finite, or if the z axis of an orthotropic material is not the normal of
    /// the plane.
    pub(crate) fn plane(
        material: &ElasticMaterial,
        assumption: PlaneAssumption,
        thickness: f64,
    ) -> Result<Self, ElementError> {
        if !(thickness > 0.0 && thickness.is_finite()) {
            return Err(ElementError(format!("thickness must be positive and finite, found {thickness} m")));
        }
        let elasticity = match material {
            ElasticMaterial::Isotropic(material) => {
                let nu = material.poisson;
                let lambda = match assumption {
                    PlaneAssumption::Stress => material.young * nu / (1.0 - nu * nu),
                    PlaneAssumption::Strain => material.lame_lambda(),
                };
                Elasticity::Isotropic { lambda, mu: material.shear_modulus() }
            }
            ElasticMaterial::Orthotropic(orthotropic) => {
                let [x, y, z] = orthotropic.axes[2];
                if x.abs() > LEAN || y.abs() > LEAN {
                    return Err(ElementError(format!(
                        "the material axis z must be normal to the plane of the mesh, (0, 0, 1) or (0, 0, -1), found ({x:.6}, {y:.6}, {z:.6})"
                    )));
                }
                general(&in_the_plane(orthotropic.stiffness_matrix(), assumption))
            }
        };
        Ok(Self { dimension: 2, density: material.density(), thickness, elasticity })
    }

    /// Shear modulus, Pa: of an orthotropic material the mean of its planes (plane parts have one).
    pub(crate) fn shear_modulus(&self) -> f64 {
        match &self.elasticity {
            Elasticity::Isotropic { mu, .. } => *mu,
            Elasticity::General(c) if self.dimension == 2 => c[0][1][0][1],
            Elasticity::General(c) => (c[0][1][0][1] + c[1][2][1][2] + c[0][2][0][2]) / 3.0,
        }
    }

    /// How it resists a layer that it holds, as the shear modulus of an isotropic material, Pa: by shear or by being stretched.
    pub(crate) fn holding_modulus(&self) -> f64 {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let stretched = (0..self.dimension).map(|i| self.layer_moduli(axes[(i + 1) % self.dimension], axes[i])[1]);
        stretched.fold(self.shear_modulus(), f64::max)
    }

    /// Moduli, Pa, of a layer across a unit normal, along a unit vector in it: against shear across the layer, and the shear modulus
    /// of the isotropic steel that gives the same resistance to stretching in the layer, `G 2 / (1 - nu)`.
    pub(crate) fn layer_moduli(&self, normal: Vector3<f64>, along: Vector3<f64>) -> [f64; 2] {
        let Elasticity::General(c) = &self.elasticity else { return [self.shear_modulus(); 2] };
        let d = self.dimension;
        let component = |[p, q, r, s]: [Vector3<f64>; 4]| {
            let indices = (0..d.pow(4)).map(|at| [at / (d * d * d), at / (d * d) % d, at / d % d, at % d]);
            indices.map(|[i, j, k, l]| c[i][j][k][l] * p[i] * q[j] * r[k] * s[l]).sum::<f64>()
        };
        let coupling = component([normal, normal, along, along]);
        let stretch = component([along; 4]) - coupling * coupling / component([normal; 4]);
        [component([normal, along, normal, along]), stretch * (1.0 - STEEL_POISSON) / 2.0]
    }

    /// Lame's first constant over the shear modulus, of an orthotropic material that of an isotropic one whose normal stiffnesses are
    /// coupled as much.
    pub(crate) fn lame_over_shear(&self) -> f64 {
        let c = match &self.elasticity {
            Elasticity::Isotropic { lambda, mu } => return lambda / mu,
            Elasticity::General(c) => c,
        };
        let pairs: &[[usize; 2]] = if self.dimension == 2 { &[[0, 1]] } else { &[[0, 1], [1, 2], [0, 2]] };
        let coupled = |[i, j]: &[usize; 2]| c[*i][*i][*j][*j] / (c[*i][*i][*i][*i] * c[*j][*j][*j][*j]).sqrt();
        let mean = pairs.iter().map(coupled).sum::<f64>() / pairs.len() as f64;
        2.0 * mean / (1.0 - mean)
    }

    /// Strains of stresses (Pa), both symmetric; of a plane part those in its plane. `None` of a singular elasticity.
    pub(crate) fn strain(&self, stress: &Matrix3<f64>) -> Option<Matrix3<f64>> {
        let d = self.dimension;
        match &self.elasticity {
            Elasticity::Isotropic { lambda, mu } => {
                let mean = lambda / (d as f64 * lambda + 2.0 * mu) * stress.trace();
                let identity = Matrix3::from_fn(|i, j| f64::from(u8::from(i == j && i < d)));
                Some((stress - identity * mean) / (2.0 * mu))
            }
            Elasticity::General(c) => {
                let pairs: Vec<[usize; 2]> = (0..d).flat_map(|i| (i..d).map(move |j| [i, j])).collect();
                let stiffness = DMatrix::from_fn(pairs.len(), pairs.len(), |row, column| {
                    let ([i, j], [k, l]) = (pairs[row], pairs[column]);
                    if k == l { c[i][j][k][l] } else { c[i][j][k][l] + c[i][j][l][k] }
                });
                let stresses = DVector::from_iterator(pairs.len(), pairs.iter().map(|&[i, j]| stress[(i, j)]));
                let strains = stiffness.lu().solve(&stresses)?;
                let mut found = Matrix3::zeros();
                for (&[i, j], strain) in pairs.iter().zip(strains.iter()) {
                    (found[(i, j)], found[(j, i)]) = (*strain, *strain);
                }
                Some(found)
            }
        }
    }
}

/// The 6 x 6 stiffness with the strain zz condensed (stress) or as it is (strain); only the rows xx, yy, xy
/// count.
fn in_the_plane(c: [[f64; 6]; 6], assumption: PlaneAssumption) -> [[f64; 6]; 6] {
    match assumption {
        PlaneAssumption::Strain => c,
        PlaneAssumption::Stress => from_fn(|p| from_fn(|q| c[p][q] - c[p][2] * c[2][q] / c[2][2])),
    }
}

fn general(c: &[[f64; 6]; 6]) -> Elasticity {
    Elasticity::General(VOIGT.map(|row| row.map(|ij| VOIGT.map(|row| row.map(|kl| c[ij][kl])))))
}
