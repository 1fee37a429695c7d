//! `plummer inspect`: its example, and a density.

use super::number::number;

pub(super) const INSPECT_EXAMPLE: &str = "\
Example: a solid housing drawn in millimetres
  plummer inspect meshes/pedestal.msh --length-unit mm --density 2700

The command writes inspect.json only where --out names a folder.";

/// A density: positive and finite.
pub(super) fn density(text: &str) -> Result<f64, String> {
    number(text, |density| density > 0.0 && density.is_finite(), "a number of kg/m^3 above 0")
}
