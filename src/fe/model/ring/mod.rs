//! The ring: curved beams on equally spaced nodes, with springs to the ground, in a plane or in space.

mod beams;
mod energy;
mod rows;
mod space;
mod support;

use beams::NODE_DOF;
pub(crate) use beams::RingSpring;
pub use beams::{Ring, RingError};
pub use energy::RingStrain;
pub use rows::RingRows;
pub use space::RingSpaceRows;
pub use support::{RadialSupport, RingSupport, SpringShare};

#[cfg(test)]
mod space_tests;
#[cfg(test)]
mod tests;
