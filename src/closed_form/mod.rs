//! Analytical answers: what a calculation is compared with, and what the bearing model is built on.
//!
//! - [`elliptic`]: complete elliptic integrals;
//! - [`hertz`]: stiffness of an elliptical point contact; [`impact`]: a sphere striking a flat;
//! - [`ring`]: frequencies of a free ring in its plane and out of it, deflections of a pinched one;
//! - [`race`]: cage, ball-pass and ball-spin orders of a rolling bearing.
//!
//! # Limitations
//! Hertz: smooth, elastic, frictionless, patches small against the radii. Rings: circular, uniform;
//! deflections in their own plane. Race kinematics: pure rolling, outer race at rest.

pub mod elliptic;
pub mod hertz;
pub mod impact;
pub mod race;
pub mod ring;
