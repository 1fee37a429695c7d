//! Defects, and where a ball that stays in the plane of the bearing touches them.
//!
//! | defect | what a user gives | solved once | asked in the hot loop |
//! |---|---|---|---|
//! | dent in either race | [`DentShape`] | [`Dent`] | [`Dent::contacts`] |
//! | the same in three dimensions | [`DentShape`] with a width | [`SurfaceDent`] | [`SurfaceDent::contacts`] |
//! | measured profile of either race | samples | [`MeasuredProfile`] | [`MeasuredProfile::contacts`] |
//! | flat on a ball | [`FlatShape`] | [`BallFlat`] | [`BallFlat::contacts`], race by race |
//!
//! [`RaceDefect`] is any of the first three; what follows is about sections in the plane, and `surface` is about the
//! second. A profile lies in a circle: a race or a ball. Depth is measured
//! from that circle into the material, D(s) over the arc length s from the middle of the defect:
//!
//! ```text
//! P(φ) = (R ± D(s)) e(φ)      D(s) = b sqrt(1 − (s/a)²)      floor of a dent; + on the outer race, − on the inner one
//! ```
//!
//! The vertical ends of this ellipse are rounded by rims, and so are the edges of a flat, an arc of larger radius
//! than the ball's: a rim is a convex arc that is tangent to the circle (at `±φ_c` from the middle) and to
//! the floor (at the joint). A measured profile runs into the race by itself. So every profile has a continuous
//! tangent, and forces are continuous in the ball's position:
//!
//! ```text
//!   circle     rim                floor                rim     circle
//! ─────────╮__                                     __╭─────────        other body below, material above
//!  −φ_c       ‾‾──..__                     __..──‾‾      +φ_c
//!                      ‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾
//! ```
//!
//! (drawn with the depth upside down). A contact is a local minimum of the distance from the ball's centre to
//! the profile: with a dent at most one on each rim and one on the floor, or the one on the race. A flat is
//! solved with the parts exchanged: the ball carries the profile, and the race's circle, convex or concave,
//! rolls over it (`circles`: one code for all by two signs).
//!
//! # Choices, and why
//! - A floor more tightly curved than the ball cannot be touched by it: there the distance has no
//!   minimum. Such minima fade out before the curvature reaches the ball's ([`FLOOR_FADE`]); so do
//!   minima at the inner end of a rim ([`RIM_BLEND`]). A minimum that vanished at full force would be a
//!   jump. Both places are reached only when a neighbouring contact is pressed in deeper by microns.
//! - The curvature that enters the Hertz stiffness changes smoothly from the race's to the rim's over the
//!   first [`RIM_BLEND`] of contact angle: the contact patch is longer than the rim's arc and averages it.
//!   A measured profile has continuous curvature and needs no blend.
//! - The groove radius (across the rolling direction) stays the race's, and the ball's its own: the in-plane
//!   profile.
//!
//! # Limitations
//! Contacts are Hertzian and independent of each other, although at 10 N a patch (0.055 mm on the source's race)
//! is half as long as the distance between rim and floor. A rim's arc, or an asperity of a measured profile, may
//! be shorter than the patch that Hertz theory gives on it: smooth a measurement to the patch's length. On scratches
//! of a micron a contact fades within nanometres of the ball's way, continuous and yet a jump for a time step. The
//! stiffness follows the position, so that a contact moving along the profile exchanges a little energy that no
//! potential accounts for: with k held the force is the gradient of `(2/5) k δ^{5/2}`, and what is missing is
//! `(2/5) δ^{5/2} ∇k`. The width of a defect enters in a [`SurfaceDent`] alone, and there a dent narrower than a patch is
//! felt as a weakened pair of edges.

mod circles;
mod contacts;
mod curve;
mod dent;
mod depression;
mod flat;
mod floor;
mod measured;
mod query;
mod race_defect;
mod rim;
mod samples_check;
mod spline;
mod stiffness;
mod surface;

#[cfg(test)]
mod tests;

pub(crate) use contacts::reduced;
pub use contacts::{DefectContact, DefectContacts, Feature, MOST_CONTACTS, PolarPosition, RaceProfile};
pub use dent::{CurvatureReading, DEFAULT_RIM_RADIUS, Dent, DentShape};
pub use flat::{BallFlat, FlatShape};
pub use measured::MeasuredProfile;
pub use race_defect::RaceDefect;
pub use rim::RIM_BLEND;
pub use stiffness::FLOOR_FADE;
pub use surface::SurfaceDent;
