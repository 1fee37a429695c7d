//! What the solid and plane elements ask of a material: its density and its 6 x 6 stiffness.

use super::{Material, OrthotropicMaterial};

/// A linear elastic material, isotropic or orthotropic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ElasticMaterial {
    /// The same in every direction.
    Isotropic(Material),
    /// Three planes of symmetry; carries its own axes.
    Orthotropic(OrthotropicMaterial),
}

impl From<Material> for ElasticMaterial {
    fn from(material: Material) -> Self {
        Self::Isotropic(material)
    }
}

impl From<OrthotropicMaterial> for ElasticMaterial {
    fn from(material: OrthotropicMaterial) -> Self {
        Self::Orthotropic(material)
    }
}

impl ElasticMaterial {
    /// Density rho, kg/m^3.
    pub(crate) fn density(&self) -> f64 {
        match self {
            Self::Isotropic(material) => material.density,
            Self::Orthotropic(material) => material.density,
        }
    }

    /// Structural loss factor eta, in [0, 2).
    pub(crate) fn loss_factor(&self) -> f64 {
        match self {
            Self::Isotropic(material) => material.loss_factor,
            Self::Orthotropic(material) => material.loss_factor,
        }
    }

    /// Stiffness C (6 x 6, Pa) in mesh axes: `sigma = C eps` with both in the order xx, yy, zz, xy, yz,
    /// xz and engineering shear strains (`gamma_xy = du_x/dy + du_y/dx`). Symmetric and positive definite.
    ///
    /// Isotropic: `lambda + 2 mu` on the first three diagonal entries, `lambda` beside them, `mu` on the
    /// last three, with `lambda = E nu / ((1 + nu)(1 - 2 nu))`, `mu = E / (2 (1 + nu))` (Bathe, Finite
    /// Element Procedures (1996), table 4.3). Orthotropic: the inverse of the compliance, turned into
    /// mesh axes.
    pub(crate) fn stiffness_matrix(&self) -> [[f64; 6]; 6] {
        match self {
            Self::Isotropic(material) => {
                let (lambda, mu) = (material.lame_lambda(), material.shear_modulus());
                let mut c = [[0.0; 6]; 6];
                for i in 0..3 {
                    c[i][..3].fill(lambda);
                    c[i][i] += 2.0 * mu;
                    c[i + 3][i + 3] = mu;
                }
                c
            }
            Self::Orthotropic(material) => material.stiffness_matrix(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fe::material::MaterialError;

    /// Reference: uniaxial stress, `eps_x = sigma / E`, `eps_y = eps_z = -nu sigma / E`, and `tau = G gamma`.
    #[test]
    fn isotropic_stiffness_gives_uniaxial_stress_and_shear() -> Result<(), MaterialError> {
        let steel = ElasticMaterial::from(Material::new(208e9, 0.3, 7800.0)?);
        assert!((steel.density() - 7800.0).abs() < 1e-12);
        let c = steel.stiffness_matrix();
        let strain = [1.0 / 208e9, -0.3 / 208e9, -0.3 / 208e9, 0.0, 1.0 / 80e9, 0.0];
        for (i, expected) in [1.0, 0.0, 0.0, 0.0, 1.0, 0.0].into_iter().enumerate() {
            let stress: f64 = (0..6).map(|j| c[i][j] * strain[j]).sum();
            assert!((stress - expected).abs() < 1e-15, "{i}: {stress}");
        }
        Ok(())
    }
}
