//! The ball bearing in space, at rest: the inner ring moves along three axes and tilts about two, both rings rigid.
//!
//! [`SpatialBearing`] takes a geometry, two effective moduli, a [`Thrust`] and a [`RaceControl`]. A [`RingDisplacement`] goes in; a
//! [`BearingState`] comes out: five loads, their 5 x 5 stiffness, and load, angles and speeds of every ball. [`RigidShaft`] puts one or
//! several such bearings on one shaft and finds where it rests. Read `ball.rs` first.
//!
//! Everything derives from the contact energy of `contact.rs` over the exact geometry of `ring.rs`. Without speed the forces are
//! its gradient and the stiffness is symmetric. Inertia of the balls (A. B. Jones 1960; Harris & Kotzalas, *Advanced Concepts of Bearing
//! Technology*, chapters 2 and 3) adds forces that have no potential.
//!
//! Frame: x right, y up, z towards the reader, angles counter-clockwise from x.
//!
//! # Limitations
//! Rigid rings; no weight of the balls, no defects at rest, no waviness, no lubricant film, no cage forces; complete grooves without
//! shoulders, so that no ball runs over an edge.

mod assembly;
mod ball;
mod contact;
mod defect;
mod equilibrium;
mod groove;
mod ring;
mod search;
mod shaft;
#[cfg(test)]
mod tests;

pub use assembly::{BallState, BearingCondition, BearingState, SpatialBearing};
pub use ball::RaceControl;
#[cfg(test)]
pub(crate) use contact::AngleStiffness;
pub(crate) use contact::GrooveContact;
pub use defect::{AcrossGroove, GrooveDefect};
pub(crate) use defect::{DamagedGroove, DefectState, blending_on, felt_on};
pub use equilibrium::ShaftEquilibrium;
pub use groove::Thrust;
pub(crate) use ring::InnerFrame;
pub use ring::RingDisplacement;
pub(crate) use shaft::Axis;
pub use shaft::{MountedBearing, RigidShaft, ShaftLoad};
