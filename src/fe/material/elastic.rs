//! What the solid and plane elements are made of.

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
}
