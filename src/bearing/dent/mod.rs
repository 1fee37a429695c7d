//! A dent in the outer race, in the plane of the bearing, and where a ball touches it.
//!
//! The race is a circle of radius R_0 about its (displaced) centre. Along the race, `s = R_0 (φ − φ_D)`,
//! the dent of length `2a` and depth `b` is pressed radially outwards from the undeformed race:
//!
//! ```text
//! P(φ) = (R_0 + D(s)) e(φ)      D(s) = b sqrt(1 − (s/a)²)                       floor
//! ```
//!
//! Its vertical ends are rounded by a rim: a convex arc of radius `r_rim` that is tangent to the race
//! (at `±φ_c` from the middle) and tangent to the floor (at the joint). The profile so made has a
//! continuous tangent, so that forces are continuous in the ball's position:
//!
//! ```text
//!   race       rim                floor                rim       race
//! ─────────╮__                                     __╭─────────        ball below, material above
//!  −φ_c       ‾‾──..__                     __..──‾‾      +φ_c
//!                      ‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾
//! ```
//!
//! (drawn with the depth upside down). [`DentShape`] is what a user gives; [`OuterDent`] is solved once
//! and answers [`OuterDent::contacts`] in the hot loop: at most one contact on each rim and one on the
//! floor, or the one on the race. A contact is a local minimum of the distance from the ball's centre to
//! the profile.
//!
//! # Choices, and why
//! - A floor more tightly curved than the ball cannot be touched by it: there the distance has no
//!   minimum. Such minima fade out before the curvature reaches the ball's ([`FLOOR_FADE`]); so do
//!   minima at the inner end of a rim ([`RIM_BLEND`]). A minimum that vanished at full force would be a
//!   jump. Both places are reached only when a neighbouring contact is pressed in deeper by microns.
//! - The curvature that enters the Hertz stiffness changes smoothly from the race's to the rim's over the
//!   first [`RIM_BLEND`] of contact angle: the contact patch is longer than the rim's arc and averages it.
//! - The groove radius (across the rolling direction) stays the race's: the in-plane profile.
//!
//! # Limitations
//! Contacts on rim and floor are Hertzian and independent of each other, although at 10 N a patch
//! (0.055 mm on the source's race) is half as long as the distance between them. A rim's arc may be shorter than the patch that Hertz theory
//! gives on it. The stiffness follows the position, so that a contact moving along the
//! profile exchanges a little energy that no potential accounts for.

mod angle;
mod contacts;
mod floor;
mod outer;
mod query;
mod rim;
mod shape;
mod stiffness;
mod vector;

pub use angle::reduced;
pub use contacts::{DentContact, DentContacts, DentFeature, MOST_CONTACTS};
pub use outer::{FLOOR_FADE, OuterDent, PolarPosition};
pub use rim::RIM_BLEND;
pub use shape::{DEFAULT_RIM_RADIUS, DentCurvature, DentError, DentShape};
