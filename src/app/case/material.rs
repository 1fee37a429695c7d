//! Materials by name.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::schema::one_of;
use super::union::{OneOrThree, mismatch, read_as};

/// An elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Material {
    /// The same in every direction.
    Isotropic(IsotropicMaterial),
    /// With three planes of symmetry; for parts of a housing only.
    Orthotropic(OrthotropicMaterial),
}

/// An isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IsotropicMaterial {
    /// Young's modulus E in Pa, > 0.
    pub young: f64,
    /// Poisson's ratio, > -1 and < 0.5.
    pub poisson: f64,
    /// Density in kg/m^3, > 0.
    pub density: f64,
    /// Structural loss factor, >= 0 and < 2 (0 unless given): stress leads strain by it, `sigma = E (1 + i eta) eps`. For
    /// frequency responses; undamped modes do not depend on it.
    #[serde(skip_serializing_if = "is_zero")]
    pub loss_factor: f64,
}

/// An orthotropic elastic material: printed, rolled, laminated, wooden.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OrthotropicMaterial {
    /// Young's moduli along the material's x, y, z in Pa, each > 0.
    pub young: [f64; 3],
    /// Poisson's ratios xy, yz, xz: `nu_ij` is the contraction along j under a pull along i.
    pub poisson: [f64; 3],
    /// Shear moduli xy, yz, xz in Pa, each > 0.
    pub shear: [f64; 3],
    /// Density in kg/m^3, > 0.
    pub density: f64,
    /// Structural loss factor of all its stiffness, >= 0 and < 2 (0 unless given), as of an isotropic material.
    #[serde(skip_serializing_if = "is_zero")]
    pub loss_factor: f64,
    /// The material's x in the mesh's axes.
    pub x_axis: [f64; 3],
    /// A direction in the material's x-y plane, in the mesh's axes.
    pub y_axis: [f64; 3],
}

fn is_zero(loss_factor: &f64) -> bool {
    *loss_factor == 0.0
}

impl Material {
    /// Structural loss factor, >= 0 and < 2.
    #[must_use]
    pub(crate) fn loss_factor(&self) -> f64 {
        match self {
            Self::Isotropic(material) => material.loss_factor,
            Self::Orthotropic(material) => material.loss_factor,
        }
    }

    /// Density in kg/m^3.
    #[must_use]
    pub(crate) fn density(&self) -> f64 {
        match self {
            Self::Isotropic(material) => material.density,
            Self::Orthotropic(material) => material.density,
        }
    }
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = either()))]
/// An elastic material: isotropic with one number each for `young` and `poisson`, orthotropic with three each and `shear`.
struct MaterialForm {
    /// Young's modulus in Pa, > 0; or along the material's x, y, z.
    young: OneOrThree,
    /// Poisson's ratio, > -1 and < 0.5; or xy, yz, xz: `nu_ij` is the contraction along j under a pull along i.
    poisson: OneOrThree,
    /// Density in kg/m^3, > 0.
    density: f64,
    /// Structural loss factor, >= 0 and < 2; 0 unless given. For frequency responses.
    loss_factor: Option<f64>,
    /// Shear moduli xy, yz, xz in Pa, each > 0; orthotropic materials only.
    shear: Option<[f64; 3]>,
    /// The material's x in the mesh's axes; orthotropic materials only.
    x_axis: Option<[f64; 3]>,
    /// A direction in the material's x-y plane, in the mesh's axes; orthotropic materials only.
    y_axis: Option<[f64; 3]>,
}

/// Isotropic or orthotropic, never half of each.
fn either() -> Value {
    json!([
        {
            "properties": { "young": { "type": "number" }, "poisson": { "type": "number" } },
            "not": { "anyOf": one_of(&["shear", "x_axis", "y_axis"]) },
        },
        {
            "properties": { "young": { "type": "array" }, "poisson": { "type": "array" } },
            "required": ["shear"],
        },
    ])
}

read_as!(Material, MaterialForm, |form| {
    const FORMS: &str = "one number each for `young` and `poisson` (isotropic), or three each and `shear` \
        (orthotropic: young = [x, y, z], poisson and shear = [xy, yz, xz])";
    let loss_factor = form.loss_factor.unwrap_or(0.0);
    match (form.young, form.poisson, form.shear) {
        (OneOrThree::One(young), OneOrThree::One(poisson), None) => {
            if form.x_axis.is_some() || form.y_axis.is_some() {
                return Err(mismatch("axes of an isotropic material", FORMS));
            }
            Ok(Self::Isotropic(IsotropicMaterial { young, poisson, density: form.density, loss_factor }))
        }
        (OneOrThree::Three(young), OneOrThree::Three(poisson), Some(shear)) => {
            Ok(Self::Orthotropic(OrthotropicMaterial {
                young,
                poisson,
                shear,
                density: form.density,
                loss_factor,
                x_axis: form.x_axis.unwrap_or([1.0, 0.0, 0.0]),
                y_axis: form.y_axis.unwrap_or([0.0, 1.0, 0.0]),
            }))
        }
        (OneOrThree::One(_), OneOrThree::One(_), Some(_)) => Err(mismatch("`shear` of an isotropic material", FORMS)),
        (OneOrThree::Three(_), OneOrThree::Three(_), None) => Err(mismatch("no `shear`", FORMS)),
        _ => Err(mismatch("one number and three", FORMS)),
    }
});
