//! The ball bearing by itself: geometry, contact, kinematics and defects. Knows nothing of finite elements.
//!
//! [`BearingGeometry`] -> [`ContactStiffness`] (Hertz, or given) -> force law [`contact`];
//! [`SpeedProfile`] and [`SlipProfile`] -> [`Cage`] -> ball angles; [`defect::RaceDefect`] takes the
//! place of a race where a ball meets a dent or a measured profile, [`defect::BallFlat`] that of both
//! races where a ball has a flat.
//!
//! Frames: x right, y up, angles counter-clockwise from x, radians. A penetration δ is positive
//! when ball and race overlap. SI throughout.
//!
//! # Limitations
//! Radial bearing in its own plane (contact angle zero), in which balls stay on defects too; no lubricant
//! film. Balls of different size have the contact stiffness and mass of the nominal one.

pub mod cage;
pub mod catalogue;
pub mod contact;
pub mod defect;
mod error;
pub mod geometry;
pub mod hertz;
pub mod impact;
pub mod kinematics;
pub mod life;
pub mod materials;
pub mod spatial;
pub mod speed;
pub mod waviness;

#[cfg(test)]
#[path = "samples_tests.rs"]
pub(crate) mod samples;

pub use cage::{Cage, SlipProfile};
pub use contact::{ContactForce, HertzContact};
pub use error::BearingError;
pub use geometry::{BearingDimensions, BearingGeometry};
pub use life::RatingLife;
pub use materials::{ContactMaterial, ContactStiffness, Race, RaceContacts};
pub use speed::{RotationCursor, RotationState, SpeedKnot, SpeedProfile};
pub use waviness::{Wave, Waviness};
