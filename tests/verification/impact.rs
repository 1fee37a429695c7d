//! Reference: Hertz's impact in closed form (`closed_form::impact`), a steel sphere of 10 mm striking a steel flat at 1 m/s.
//! Goal: all integrators give its largest force and its time of contact to 1e-4.
//! Sketch: one coordinate, F = k delta^1.5.
//! Conditions: no damping, no gravity; the sphere touches at time zero.
//! Parameters: E 210 GPa, nu 0.3, 7800 kg/m^3; 1000 steps in the time of contact.

use std::f64::consts::PI;

use plummer::bearing::HertzContact;
use plummer::bearing::hertz::{effective_modulus, sphere_on_flat};
use plummer::bearing::impact::impact;
use plummer::numerics::ode::{Instant, LinearCoordinate, Observer, SecondOrderSystem, State};
use plummer::numerics::ode::{Method, Schedule, Stepping, integrate};

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

#[test]
fn hertz_impact_by_all_integrators() {
    let radius = 5e-3;
    let modulus = effective_modulus([2.1e11; 2], [0.3; 2]).unwrap();
    let stiffness = sphere_on_flat(radius, modulus).unwrap().stiffness;
    let mass = 7800.0 * 4.0 / 3.0 * PI * radius * radius * radius;
    let expected = impact(stiffness, mass, 1.0).unwrap();
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
        let steps = 1100;
        let schedule = Schedule { interval: 1.1 * expected.contact_time, steps_per_interval: steps, intervals: 1 };
        let mut peak = Peak::default();
        let go_on = |_, _| Stepping::Continue;
        integrate(&mut sphere, method, &schedule, &mut state, &mut peak, go_on).unwrap();
        let force = peak.force / expected.force - 1.0;
        let time = peak.left.unwrap() / expected.contact_time - 1.0;
        // second order: (w h)^2 / 24 with w h about pi / 1000, and the largest of steps for the largest value
        assert!(force.abs() < 1e-4, "{method:?}: force {force:e}");
        assert!(time.abs() < 1e-4, "{method:?}: time {time:e}");
    }
}
