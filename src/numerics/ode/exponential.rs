//! Exponential velocity Verlet: the linear part exact, the force held over the step.
//!
//! ```text
//! y1 = E_yy y0 + E_yv v0 + P g0
//! v1 = E_vy y0 + E_vv v0 + a g0 + b g1,      g1 = g(t1, y1, v*)
//! ```
//!
//! The weights a and b make the positions follow Gautschi's two-step recursion, which without
//! damping is `y2 - 2 cos(h w) y1 + y0 = (2 sin(h w / 2) / w)^2 g1`: symmetric in time, so that no
//! energy creeps in or out through modes that the step does not resolve (Hairer, Lubich, Wanner,
//! Geometric Numerical Integration, 2nd ed., XIII.1.2). Interpolating the force linearly for the
//! velocity instead lags behind in such modes and drove the shaft: 31 % wrong after 10 ms of the
//! smooth scene at h = 2.5e-8 s in all modes. Holding the force keeps `g = w^2 y` exactly, which
//! impulse splitting does not. v* is the velocity under the held force; it enters through contact
//! damping alone. With w = 0 this is the velocity Verlet method.

use super::propagator::Propagator;
use super::stepper::OneEvaluation;
use crate::numerics::ode::SecondOrderSystem;

/// Flow coefficients of every coordinate for one step length.
#[derive(Debug)]
pub(super) struct Exponential {
    flow: Vec<Propagator>,
    predicted: Vec<f64>,
    next_force: Vec<f64>,
}

impl Exponential {
    pub(super) fn new(system: &impl SecondOrderSystem, h: f64) -> Self {
        let flow: Vec<Propagator> = system.linear().iter().map(|&coordinate| Propagator::new(coordinate, h)).collect();
        let dof = flow.len();
        Self { flow, predicted: vec![0.0; dof], next_force: vec![0.0; dof] }
    }
}

impl<S: SecondOrderSystem> OneEvaluation<S> for Exponential {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) {
        for i in 0..self.flow.len() {
            let p = &self.flow[i];
            let (y0, v0, g0) = (y[i], v[i], g[i]);
            y[i] = p.position_position * y0 + p.position_velocity * v0 + p.response * g0;
            self.predicted[i] = p.velocity_position * y0 + p.velocity_velocity * v0 + p.position_velocity * g0;
        }
        system.force_into(t1, y, &self.predicted, &mut self.next_force);
        for i in 0..self.flow.len() {
            let p = &self.flow[i];
            // the prediction holds g0 over the whole step with the weight a + b
            v[i] = self.predicted[i] + p.kick_after * (self.next_force[i] - g[i]);
            g[i] = self.next_force[i];
        }
    }
}
