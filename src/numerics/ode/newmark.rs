//! Explicit Newmark (beta = 0, gamma = 1/2): central differences, the source paper's method.
//!
//! ```text
//! y1 = y0 + h v0 + h^2/2 a0
//! (1 + h/2 c) v1 = v0 + h/2 a0 + h/2 (g1 - w^2 y1)
//! ```
//!
//! The damping acts on the new velocity (`M + h/2 C` factored once, here diagonal), so the limit
//! is `h < 2 / w` whatever the damping; with lagged damping stiffness-proportional damping would
//! lower it. In modal coordinates the method is the same as in nodal ones, step by step: it
//! commutes with a change of basis.

use super::stepper::OneEvaluation;
use crate::numerics::ode::{LinearCoordinate, SecondOrderSystem};

#[derive(Debug)]
pub(super) struct NewmarkExplicit {
    h: f64,
    linear: Vec<LinearCoordinate>,
    /// 1 / (1 + h c / 2) for every coordinate.
    implicit_damping: Vec<f64>,
    predicted: Vec<f64>,
    half_velocity: Vec<f64>,
}

impl NewmarkExplicit {
    pub(super) fn new(system: &impl SecondOrderSystem, h: f64) -> Self {
        let linear = system.linear().to_vec();
        let implicit_damping = linear.iter().map(|coordinate| 1.0 / (1.0 + 0.5 * h * coordinate.damping)).collect();
        let dof = linear.len();
        Self { h, linear, implicit_damping, predicted: vec![0.0; dof], half_velocity: vec![0.0; dof] }
    }
}

impl<S: SecondOrderSystem> OneEvaluation<S> for NewmarkExplicit {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) {
        let h = self.h;
        for i in 0..self.linear.len() {
            let LinearCoordinate { squared_frequency, damping } = self.linear[i];
            let a = g[i] - damping * v[i] - squared_frequency * y[i];
            self.half_velocity[i] = v[i] + 0.5 * h * a;
            self.predicted[i] = v[i] + h * a;
            y[i] += h * self.half_velocity[i];
        }
        system.force_into(t1, y, &self.predicted, g);
        for i in 0..self.linear.len() {
            let pull = g[i] - self.linear[i].squared_frequency * y[i];
            v[i] = self.implicit_damping[i] * (self.half_velocity[i] + 0.5 * h * pull);
        }
    }
}
