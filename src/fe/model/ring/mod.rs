//! The ring: curved beams on equally spaced nodes, with springs to the ground, in a plane or in space.

mod beams;
mod support;

use beams::NODE_DOF;
pub(crate) use beams::RingSpring;
pub use beams::{Ring, RingError, RingRows, RingSpaceRows, RingStrain};
pub use support::{RadialSupport, RingSupport, SpringShare};

#[cfg(test)]
mod space_tests;
#[cfg(test)]
mod tests;
