//! The two-noded curved beam: shear-flexible, free of locking; three degrees of freedom a node in its
//! plane ([`CurvedBeam`]) and three out of it ([`OutOfPlaneArc`]), which do not mix.
//!
//! Polar components on an arc of radius R, angle phi counter-clockwise from the element's middle:
//! u tangential (counter-clockwise), w radial (outward), theta the section's rotation
//! (counter-clockwise). Strains (primes: d/dphi)
//!
//! ```text
//! eps = (u' + w) / R      gamma = (w' - u) / R + theta      kappa = theta' / R
//! ```
//!
//! A material point at radius r of a section moves by `w` radially and `u + (r - R) theta`
//! tangentially. The degrees of freedom are ordered (u, w, theta) at the first node, then at the
//! second, the first node being the one at the smaller angle.
//!
//! In space the polar frame is `(e_r, e_t, e_z)`, right-handed: e_r outwards, e_t counter-clockwise,
//! e_z out of the plane towards who sees the angles count counter-clockwise. u, w and theta are then
//! the components of displacement along e_t and e_r and of rotation about e_z.

pub mod closed_form;
mod force_method;
mod in_plane;
mod out_of_plane;
mod raveendranath;

pub use in_plane::{CurvedBeam, RingInterpolation};
pub use out_of_plane::OutOfPlaneArc;

#[cfg(test)]
mod tests;
