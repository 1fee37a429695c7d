//! Integration rules on the natural elements.

mod rule;
#[cfg(test)]
mod tests;

pub use rule::{QuadraturePoint, QuadratureRule};
#[cfg(test)]
pub(super) use rule::{conical_tetrahedron, conical_triangle, cube, product, square};
