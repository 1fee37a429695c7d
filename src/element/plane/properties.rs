//! Material, thickness and plane assumption of a plane part.

use crate::element::ElementError;
use crate::material::Material;

/// What the plane model assumes across its thickness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneAssumption {
    /// No stress through the thickness: thin parts, free faces.
    Stress,
    /// No strain through the thickness: long parts, or a slice held between its neighbours.
    Strain,
}

/// What a plane element needs beside its coordinates; built by [`PlaneProperties::new`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PlaneProperties {
    /// What it is made of.
    pub material: Material,
    /// Plane stress or plane strain.
    pub assumption: PlaneAssumption,
    /// Thickness t, m, > 0.
    pub thickness: f64,
}

/// The three constants of `D` for an isotropic material, Pa:
/// `D = [[direct, cross, 0], [cross, direct, 0], [0, 0, shear]]` on (eps_x, eps_y, gamma_xy).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Elasticity {
    pub(super) direct: f64,
    pub(super) cross: f64,
    pub(super) shear: f64,
}

impl PlaneProperties {
    /// Properties with a thickness in metres, > 0.
    ///
    /// # Errors
    /// [`ElementError::Thickness`] if it is not positive and finite.
    pub fn new(
        material: Material,
        assumption: PlaneAssumption,
        thickness: f64,
    ) -> Result<Self, ElementError> {
        if thickness > 0.0 && thickness.is_finite() {
            Ok(Self {
                material,
                assumption,
                thickness,
            })
        } else {
            Err(ElementError::Thickness { value: thickness })
        }
    }

    /// Elasticity constants. Stress: `E / (1 - nu^2)` times (1, nu); strain:
    /// `E / ((1 + nu)(1 - 2 nu))` times (1 - nu, nu). Source: Bathe, table 4.3.
    pub(super) fn elasticity(&self) -> Elasticity {
        let (young, nu) = (self.material.young, self.material.poisson);
        let (direct, cross) = match self.assumption {
            PlaneAssumption::Stress => {
                let factor = young / (1.0 - nu * nu);
                (factor, factor * nu)
            }
            PlaneAssumption::Strain => {
                let factor = young / ((1.0 + nu) * (1.0 - 2.0 * nu));
                (factor * (1.0 - nu), factor * nu)
            }
        };
        Elasticity {
            direct,
            cross,
            shear: self.material.shear_modulus(),
        }
    }
}
