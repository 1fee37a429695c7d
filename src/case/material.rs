//! Materials by name.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// An isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E in Pa, > 0.
    pub young: f64,
    /// Poisson's ratio, > -1 and < 0.5.
    pub poisson: f64,
    /// Density in kg/m^3, > 0.
    pub density: f64,
}

impl Material {
    const fn new(young: f64, poisson: f64, density: f64) -> Self {
        Self {
            young,
            poisson,
            density,
        }
    }
}

/// The materials that a case may name without giving them: common values for a low-alloy steel, a through-hardened
/// bearing steel (both with the modulus at which the source paper's contact stiffness is computed) and a wrought
/// aluminium alloy. A table of the same name in the case file takes their place.
pub const BUILT_IN_MATERIALS: [(&str, Material); 3] = [
    ("steel", Material::new(206e9, 0.3, 7850.0)),
    ("bearing steel", Material::new(206e9, 0.3, 7850.0)),
    ("aluminium", Material::new(70e9, 0.33, 2700.0)),
];

/// Adds the built-in materials that the case file does not give itself.
pub(super) fn add_built_in(materials: &mut BTreeMap<String, Material>) {
    for (name, material) in BUILT_IN_MATERIALS {
        materials.entry(name.to_owned()).or_insert(material);
    }
}
