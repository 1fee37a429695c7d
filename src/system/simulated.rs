//! What the record and the energy balance of a run ask of a system.

use super::powers::Powers;
use super::record::{RecordLayout, RunRecord};
use crate::numerics::ode::{Instant, SecondOrderSystem};

/// A system that a run records.
pub trait Simulated: SecondOrderSystem {
    /// What its record has.
    fn layout(&self) -> RecordLayout;

    /// Number of kept modes.
    fn kept_modes(&self) -> usize;

    /// Whether the static residual of the modes left out is in use.
    fn uses_residual(&self) -> bool;

    /// Displacement of a sensor at a state at which the force was evaluated last, m.
    fn sensor_displacement(&self, sensor: usize, y: &[f64]) -> f64;

    /// Appends positions and forces at such a state to a record of its layout; the sensors have a way of their own.
    fn record_into(&self, now: &Instant<'_>, record: &mut RunRecord);

    /// Whether forces have potentials and all coordinates inertia: what an energy balance needs.
    fn has_energy(&self) -> bool;

    /// Kinetic and elastic energy of such a state, J.
    fn stored_energy(&self, now: &Instant<'_>) -> f64;

    /// Powers at such a state.
    fn find_powers(&self, now: &Instant<'_>, powers: &mut Powers);
}
