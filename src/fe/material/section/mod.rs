//! The section of a ring: one or more rings fitted into each other, reduced to one curved beam.

mod beam;

pub use beam::{BeamSection, Bond, OutOfPlaneSection, RadiusRule, RingLayer};

#[cfg(test)]
mod tests;
