//! Time integration of a second-order system with a diagonal linear part. Knows nothing of
//! bearings.
//!
//! - [`Method::Exponential`]: the linear part is stepped exactly, the force is held over the step;
//!   second order, keeps every equilibrium, no linear stability limit.
//! - [`Method::ExponentialAdams`]: the same with the force a polynomial through what is known of it; third order for the same
//!   one evaluation a step, stable below `h = ` [`ADAMS_STABILITY_LIMIT`] ` / omega` of what the force holds.
//! - [`Method::NewmarkExplicit`]: central differences with the damping at the new velocity, the
//!   source paper's method; stable below `h = 2 / omega_max`.
//! - [`Method::Splitting`]: kicks by the force between exact flows; moves every equilibrium between a force and a spring. To see
//!   it fail.
//! - [`Method::Newmark`] and [`Method::GeneralizedAlpha`]: implicit, solved with the tangent that the system gives; second
//!   order, keep every equilibrium, no linear stability limit.
//! - [`Method::Dop853`]: explicit Runge-Kutta of order 8 by a tolerance, interpolated at the samples; its steps may end where
//!   contacts begin and end.
//!
//! How long a step may be is asked of the methods themselves: `growth` steps a [`Linearised`] system, and
//! `Method::step_limit` searches the step at which a small motion begins to grow.
//!
//! [`integrate`] goes through a [`Schedule`]; an [`Integration`] does so interval by interval. A state that means nothing any
//! more is noticed within a few steps ([`BlowUp`]), with the method's limit there ([`StepLimit`]).

mod adams;
mod amplification;
mod dop853;
mod error;
mod implicit;
mod integration;
mod limit;
mod method;
mod propagator;
mod schedule;
mod snapshot;
mod stepper;
mod steppers;
mod system;

pub use adams::STABILITY_LIMIT as ADAMS_STABILITY_LIMIT;
pub(crate) use amplification::growth;
pub use amplification::{Growth, Linearised, UNSTABLE};
pub use error::{BlowUp, TransientError};
pub use integration::{Integration, Stepping, integrate};
pub(crate) use limit::fastest;
pub use method::{LEAST_TOLERANCE, Method, Resonance, StepLimit};
pub use schedule::{MOST_STEPS_PER_INTERVAL, Schedule};
pub(crate) use snapshot::Exchange;
pub use snapshot::{Snapshot, SnapshotError, SnapshotReader};
pub use stepper::Statistics;
pub(in crate::numerics::ode) use stepper::Stepper;
pub(crate) use system::all_finite;
pub use system::{
    Divergence, Instant, LinearCoordinate, NoRecord, Observer, SecondOrderSystem, State, Tangent, TangentTerm,
};

#[cfg(test)]
mod implicit_tests;
#[cfg(test)]
mod tests;
