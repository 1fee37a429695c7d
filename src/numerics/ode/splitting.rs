//! Impulse splitting: half a kick by the force, the exact flow of the linear part, half a kick.
//!
//! ```text
//! v0' = v0 + h/2 g(t0, y0, v0)      (y1, v1') = exp(h L) (y0, v0')      v1 = v1' + h/2 g(t1, y1, v1')
//! ```
//!
//! Second order, symmetric without damping, and the method that fails here (Verlet-I, r-RESPA: Hairer, Lubich, Wanner,
//! Geometric Numerical Integration, 2nd ed., XIII.1.3): between the kicks a coordinate with `g = w^2 y` moves, so that its
//! equilibrium is not kept. What it keeps is `g = (2 w / h) tan(h w / 2) y`: between a large contact force and a large spring
//! force the place of balance is wrong by `(h w)^2 / 12`, and at `h w = pi` no force moves it.

use super::propagator::Propagator;
use super::stepper::OneEvaluation;
use crate::numerics::ode::SecondOrderSystem;

#[derive(Debug)]
pub(super) struct Splitting {
    half: f64,
    flow: Vec<Propagator>,
}

impl Splitting {
    pub(super) fn new(system: &impl SecondOrderSystem, h: f64) -> Self {
        let coordinates = system.linear().iter();
        Self { half: 0.5 * h, flow: coordinates.map(|&coordinate| Propagator::new(coordinate, h)).collect() }
    }
}

impl<S: SecondOrderSystem> OneEvaluation<S> for Splitting {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) {
        for (i, p) in self.flow.iter().enumerate() {
            let (y0, v0) = (y[i], v[i] + self.half * g[i]);
            y[i] = p.position_position * y0 + p.position_velocity * v0;
            v[i] = p.velocity_position * y0 + p.velocity_velocity * v0;
        }
        system.force_into(t1, y, v, g);
        for (v, g) in v.iter_mut().zip(g.iter()) {
            *v += self.half * g;
        }
    }
}
