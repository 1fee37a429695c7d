//! Integration rules on the natural elements.

mod line;
mod rule;
mod simplex;
#[cfg(test)]
mod tests;

pub use line::QuadraturePoint;
pub use rule::QuadratureRule;
#[cfg(test)]
pub(super) use rule::{cube, product, square};
#[cfg(test)]
pub(super) use simplex::{conical_tetrahedron, conical_triangle};
