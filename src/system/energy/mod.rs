//! The energy balance of a run: what came in, what was taken out, what is stored.
//!
//! ```text
//! stored = kinetic + sum (omega q)^2 / 2 + sum (2/5) k delta^(5/2) + F . G F / 2
//! d stored / dt = loads + rotation + blending - modal damping - contact damping
//! ```
//!
//! The kinetic energy is that of kept modes, shaft, and the balls' radial motion; G is the static residual's flexibility under
//! the outer contacts' forces F. `loads` is the power of weight, loads and unbalance; `rotation` that of cage and shaft,
//! which turn as prescribed: of every contact force at the velocity at which the prescribed motion alone would move the
//! contact, and of the centrifugal load. `blending` is what contacts get that move along a defect's profile while their
//! stiffness k changes, `(2/5) delta^(5/2) dk/dt`: their force has no part for it. Powers come from the forces that the method evaluated, so that a force without the potential
//! that is counted, and an integrator that loses or makes energy, leave a gap in the balance.

mod power;
mod stored;

use super::powers::Powers;
use super::simulated::Simulated;
use crate::numerics::ode::{Instant, Observer, Snapshot, SnapshotError, SnapshotReader, State};
use power::Integral;
use schemars::JsonSchema;
use serde::Serialize;

/// The energy balance of a run, J.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct EnergyBalance {
    /// Work of weight, loads and unbalance.
    #[serde(rename = "loads")]
    pub loads_j: f64,
    /// Work of cage and shaft, which turn as prescribed.
    #[serde(rename = "rotation")]
    pub rotation_j: f64,
    /// What contacts got, or lost if negative, as their stiffness changed along the profiles of defects.
    #[serde(rename = "blending")]
    pub blending_j: f64,
    /// Taken by the damping of the kept modes.
    #[serde(rename = "modal_damping")]
    pub modal_damping_j: f64,
    /// Taken by the damping of the contacts.
    #[serde(rename = "contact_damping")]
    pub contact_damping_j: f64,
    /// What is stored at the end less what was at the start.
    #[serde(rename = "stored")]
    pub stored_j: f64,
    /// All that flowed in or out, each flow by its magnitude at every instant.
    #[serde(rename = "exchanged")]
    pub exchanged_j: f64,
}

impl EnergyBalance {
    /// Work done on the system, what contacts got by blending with it, J.
    pub(crate) fn input_j(&self) -> f64 {
        self.loads_j + self.rotation_j + self.blending_j
    }

    /// Taken out by damping, J.
    pub(crate) fn dissipated_j(&self) -> f64 {
        self.modal_damping_j + self.contact_damping_j
    }

    /// What does not add up, `input - dissipated - stored`, in units of what was exchanged; 0 if nothing was.
    pub fn error(&self) -> f64 {
        let gap = self.input_j() - self.dissipated_j() - self.stored_j;
        if self.exchanged_j > 0.0 { gap / self.exchanged_j } else { 0.0 }
    }
}

/// Sums the powers of a run up.
///
/// Powers are integrated from sample to sample by the trapezoidal rule with Gregory's corrections at both ends, of the fourth
/// order; what the static residual's displacements take from the work of contact damping by the trapezoidal rule.
#[derive(Debug)]
pub struct EnergyMeter {
    powers: Powers,
    integral: Integral,
    /// Taken from contact damping's work by displacements of the race, J.
    yielded: f64,
    yielding_before: Vec<[f64; 2]>,
    start: Option<f64>,
    /// Time between samples, s.
    step: f64,
}

impl EnergyMeter {
    /// For samples `step` (s) apart; none in the `printed` equations, which have no potential, and for balls without inertia.
    pub fn new(system: &impl Simulated, step: f64) -> Option<Self> {
        system.has_energy().then(|| Self {
            powers: Powers::new(system.kept_modes(), system.layout().balls),
            integral: Integral::default(),
            yielded: 0.0,
            yielding_before: Vec::new(),
            start: None,
            step,
        })
    }

    /// The balance of what was observed up to a state, the last that was; none before the first.
    pub(crate) fn balance(&self, system: &mut impl Simulated, end: &State) -> Option<EnergyBalance> {
        let mut force = vec![0.0; end.y.len()];
        system.force_into(end.t, &end.y, &end.v, &mut force);
        let now = Instant { step: 0, t: end.t, y: &end.y, v: &end.v };
        let integrals = self.integral.of(self.step);
        let [loads_j, rotation_j, modal_damping_j, contact, blending_j] = integrals;
        Some(EnergyBalance {
            loads_j,
            rotation_j,
            blending_j,
            modal_damping_j,
            contact_damping_j: contact - self.yielded,
            stored_j: system.stored_energy(&now) - self.start?,
            exchanged_j: self.integral.magnitude * self.step,
        })
    }

    /// Writes all that the rest of the balance depends on.
    pub(crate) fn remember(&self, snapshot: &mut Snapshot) {
        self.integral.remember(snapshot);
        snapshot.number(self.yielded);
        snapshot.numbers(self.yielding_before.as_flattened());
        snapshot.option(self.start);
    }

    /// Reads what [`remember`](Self::remember) wrote, into a meter made for the same system and step.
    ///
    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    pub(crate) fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError> {
        self.integral.recall(snapshot)?;
        self.yielded = snapshot.number()?;
        let numbers = snapshot.numbers()?;
        self.yielding_before = numbers.as_chunks().0.to_vec();
        self.start = snapshot.option()?;
        Ok(())
    }
}

impl<S: Simulated> Observer<S> for EnergyMeter {
    fn observe(&mut self, system: &S, now: Instant<'_>) {
        system.find_powers(&now, &mut self.powers);
        self.integral.add(&self.powers.flows);
        if self.start.is_none() {
            self.start = Some(system.stored_energy(&now));
        }
        let pairs = self.yielding_before.iter().zip(&self.powers.yielding);
        for ([force, place], [force_now, place_now]) in pairs {
            self.yielded += 0.5 * (force + force_now) * (place_now - place);
        }
        self.yielding_before.clone_from(&self.powers.yielding);
    }
}
