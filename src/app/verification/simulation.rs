//! Stepping through time: an impact in closed form, the balance of energy, the order of a dent's impacts.

use std::f64::consts::PI;

use super::section::{Check, IMPACT, Kind, SMOOTH, SectionResult, VerificationError, built_in};
use crate::app::commands::run::compute_run;
use crate::bearing::HertzContact;
use crate::bearing::hertz::{effective_modulus, sphere_on_flat};
use crate::bearing::impact::impact;
use crate::numerics::Unwatched;
use crate::numerics::ode::{
    Instant, LinearCoordinate, Method, Observer, Schedule, SecondOrderSystem, State, Stepping, integrate,
};

/// Title of the section.
const TITLE: &str = "Simulation";

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a simulation cannot be carried out.
pub(super) fn simulation() -> Result<SectionResult, VerificationError> {
    Ok(SectionResult::of_checks(TITLE, [sphere()?, energy()?].concat()))
}

/// A sphere over a flat.
struct Sphere {
    linear: [LinearCoordinate; 1],
    law: HertzContact,
    mass: f64,
}

impl SecondOrderSystem for Sphere {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        g[0] = -self.law.force(y[0], v[0]) / self.mass;
    }
}

/// Largest force, and the time at which the sphere leaves.
#[derive(Default)]
struct Peak {
    force: f64,
    left: Option<f64>,
    last: Option<(f64, f64)>,
}

impl Observer<Sphere> for Peak {
    fn observe(&mut self, system: &Sphere, now: Instant<'_>) {
        self.force = self.force.max(system.law.force(now.y[0], now.v[0]));
        if let Some((time, depth)) = self.last
            && depth > 0.0
            && now.y[0] <= 0.0
        {
            // straight between two steps: the force is zero there
            self.left = Some(time + (now.t - time) * depth / (depth - now.y[0]));
        }
        self.last = Some((now.t, now.y[0]));
    }
}

fn sphere() -> Result<Vec<Check>, VerificationError> {
    let radius = 5e-3;
    let modulus = effective_modulus([2.1e11; 2], [0.3; 2])?;
    let stiffness = sphere_on_flat(radius, modulus)?.stiffness;
    let mass = 7800.0 * 4.0 / 3.0 * PI * radius * radius * radius;
    let expected = impact(stiffness, mass, 1.0)?;
    let kind = |unit| Kind {
        unit,
        source: "closed form: Johnson, Contact Mechanics, (11.22) to (11.24)",
        assumptions: "Steel sphere, diameter 10 mm, at 1 m/s against a steel flat, F = k delta^(3/2); 1000 steps in the time of contact.",
        reason: "Second order, (w h)^2 / 24 with w h about pi / 1000, and the largest of steps for the largest value.",
    };
    let mut checks = Vec::new();
    let spectral_radius = 0.8;
    for method in
        [Method::Exponential, Method::NewmarkExplicit, Method::Newmark, Method::GeneralizedAlpha { spectral_radius }]
    {
        let mut sphere = Sphere {
            linear: [LinearCoordinate { squared_frequency: 0.0, damping: 0.0 }],
            law: HertzContact { stiffness, damping: 0.0 },
            mass,
        };
        let mut state = State { t: 0.0, y: vec![0.0], v: vec![1.0] };
        let schedule = Schedule { interval: 1.1 * expected.contact_time, steps_per_interval: 1100, intervals: 1 };
        let mut peak = Peak::default();
        let go_on = |_, _| Stepping::Continue;
        integrate(&mut sphere, method, &schedule, &mut state, &mut peak, go_on)?;
        let name = |what: &str| format!("Impact by {}: {what}", method.name());
        let left = peak.left.unwrap_or(f64::NAN);
        checks.push(kind("N").check(&name("force"), peak.force, expected.force, 1e-4));
        checks.push(kind("s").check(&name("time of contact"), left, expected.contact_time, 1e-4));
    }
    Ok(checks)
}

/// What was put in, less what damping took, is what is stored.
fn energy() -> Result<Vec<Check>, VerificationError> {
    let precise = [
        "transient.modes=7",
        "transient.method=dop853",
        "transient.tolerance=1e-10",
        "transient.step=1e-7",
        "transient.end=5e-4",
        "analysis.energy=true",
        "analysis.envelope=[]",
    ];
    let mut checks = Vec::new();
    for (name, text, limit, reason) in [
        (
            "smooth",
            SMOOTH,
            5e-5,
            "Under preload the contacts store 500 times what is exchanged; tables of shapes and residual are good to 1e-8.",
        ),
        (
            "impact",
            IMPACT,
            2e-4,
            "A force on damage of the outer race is taken at a displacement that may be wrong by 1e-5 of itself.",
        ),
    ] {
        let run = compute_run(&built_in(&format!("{name}.toml"), text, &precise)?, &Unwatched)?;
        let kind = Kind {
            unit: "of all that flowed",
            source: "first law: loads and prescribed rotation, less damping, is what is stored",
            assumptions: "examples/scenes, 0.5 ms from rest by dop853, seven modes and the residual; 1 is a balance that closes.",
            reason,
        };
        let error = run.simulation.energy.map_or(f64::NAN, |energy| energy.error());
        let name = format!("Balance of energy, scene {name}");
        checks.push(kind.check(&name, 1.0 + error, 1.0, limit));
    }
    Ok(checks)
}
