//! The section of a ring: one or more rings fitted into each other, reduced to one curved beam.

mod beam;
mod layer;

pub use beam::{BeamSection, Bond, OutOfPlaneSection, RadiusRule};
pub use layer::RingLayer;

#[cfg(test)]
mod tests;
