//! Exponential velocity Verlet: the linear part exact, the force held over the step for the
//! position and linear over it for the velocity.
//!
//! ```text
//! y1 = E_yy y0 + E_yv v0 + P g0
//! v1 = E_vy y0 + E_vv v0 + (E_yv - P/h) g0 + P/h g1,      g1 = g(t1, y1, v*)
//! ```
//!
//! v* is the velocity at the end under the held force; it enters through contact damping alone. The
//! variation-of-constants formula with this quadrature belongs to the Gautschi class (Hairer,
//! Lubich, Wanner, Geometric Numerical Integration, 2nd ed., XIII.1); holding the force keeps
//! `g = w^2 y` exactly, which impulse splitting does not. With w = 0 it is the velocity Verlet
//! method.

use super::driver::Stepper;
use super::propagator::Propagator;
use crate::dynamics::SecondOrderSystem;

/// Flow coefficients of every coordinate for one step length.
#[derive(Debug)]
pub(super) struct Exponential {
    h: f64,
    flow: Vec<Propagator>,
    predicted: Vec<f64>,
    next_force: Vec<f64>,
}

impl Exponential {
    pub fn new(system: &impl SecondOrderSystem, h: f64) -> Self {
        let flow: Vec<Propagator> = system
            .linear()
            .iter()
            .map(|&coordinate| Propagator::new(coordinate, h))
            .collect();
        let dof = flow.len();
        Self {
            h,
            flow,
            predicted: vec![0.0; dof],
            next_force: vec![0.0; dof],
        }
    }
}

impl<S: SecondOrderSystem> Stepper<S> for Exponential {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) {
        for i in 0..self.flow.len() {
            let p = &self.flow[i];
            let (y0, v0, g0) = (y[i], v[i], g[i]);
            y[i] = p.position_position * y0 + p.position_velocity * v0 + p.response * g0;
            self.predicted[i] =
                p.velocity_position * y0 + p.velocity_velocity * v0 + p.position_velocity * g0;
        }
        system.force_into(t1, y, &self.predicted, &mut self.next_force);
        let rate = 1.0 / self.h;
        for i in 0..self.flow.len() {
            v[i] = self.predicted[i]
                + self.flow[i].response * rate * (self.next_force[i] - g[i]);
            g[i] = self.next_force[i];
        }
    }
}
