//! Several bearings that carry axial load and tilt, on one rigid shaft, in a structure with a ring each.
//!
//! [`SpatialSetup`] and a [`Structure`](super::Structure) make a [`SpatialSystem`], which a time integrator steps. The ball bearing
//! in its plane has a system of its own, [`CoupledSystem`](super::CoupledSystem), to the same equations without the axial
//! coordinates. Read `force.rs` first.

mod ball_forces;
mod balls;
mod branches;
mod damage;
mod energy;
mod equilibrium;
mod force;
mod groove_lanes;
mod loaded;
mod pose;
mod second_order;
mod setup;
mod springs;
mod static_vectors;
mod system;
#[cfg(test)]
mod tests;

pub use equilibrium::{SpatialBallLoad, SpatialCondition, SpatialEquilibrium};
pub use setup::{BearingInPlace, SpatialLoad, SpatialSetup, SpatialShaft, Unbalance};
pub(crate) use static_vectors::with_static_vectors;
pub use system::SpatialSystem;
