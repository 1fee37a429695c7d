//! How well an element is shaped, good or bad.

use super::ContinuumKind;
use super::dispatch::for_kind;
use super::geometry::{Placed, extremes};
use super::table::tables;
use crate::fe::element::ElementError;

/// The Jacobian of an element, sampled at its nodes and at the points of its stiffness rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeQuality {
    /// Smallest determinant, m^2 (plane) or m^3 (solid); negative where the element is inverted.
    pub smallest_determinant: f64,
    /// Jacobian ratio: smallest determinant over largest magnitude, in [-1, 1]. 1: constant (every straight
    /// triangle and tetrahedron, every parallelogram and parallelepiped, however thin); small: strongly
    /// tapered, warped or curved; 0 or below: no valid element. An element without size has 0.
    pub scaled_jacobian: f64,
    /// Where the smallest determinant is, m.
    pub position: [f64; 3],
}

/// The quality of any element, also of one that [`stiffness_into`](super::stiffness_into) refuses.
///
/// `coords`: one (x, y, z) a node in gmsh's order, m; plane elements lie in xy and z is not read.
///
/// # Errors
/// [`ElementError::NodeCount`], [`ElementError::NotFinite`] and [`ElementError::TooLarge`] alone.
pub(crate) fn quality(kind: ContinuumKind, coords: &[[f64; 3]]) -> Result<ShapeQuality, ElementError> {
    for_kind!(kind, sample(kind, coords))
}

fn sample<const N: usize, const D: usize>(
    kind: ContinuumKind,
    coords: &[[f64; 3]],
) -> Result<ShapeQuality, ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let found = extremes::<N, D>(kind, &placed.coords, &tables(kind).stiffness);
    let largest = found.high.abs().max(found.low.abs());
    let scaled_jacobian = if largest > 0.0 { found.low / largest } else { 0.0 };
    Ok(ShapeQuality { smallest_determinant: found.low, scaled_jacobian, position: found.low_position(kind, coords) })
}
