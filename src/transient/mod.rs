//! Time integration of a second-order system with a diagonal linear part. Knows nothing of
//! bearings.
//!
//! - [`Method::Exponential`]: the linear part is stepped exactly, the force is held over the step;
//!   second order, keeps every equilibrium, no linear stability limit.
//! - [`Method::NewmarkExplicit`]: central differences with the damping at the new velocity, the
//!   source paper's method; stable below `h = 2 / omega_max`.

mod driver;
mod error;
mod exponential;
mod newmark;
mod propagator;
mod splitting;

pub use driver::{Method, Schedule, Statistics, Stepping, integrate};
pub use error::TransientError;

#[cfg(test)]
mod tests;
