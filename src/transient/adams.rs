//! Exponential Adams method of third order: the linear part exact, the force a polynomial through what is known of it, one
//! evaluation a step.
//!
//! ```text
//! y1 = flow(y0, v0) under g0 + x (g0 - g_)                                  x = (t - t0) / h, g_ the force a step before
//! v1 = flow(y0, v0) under g0 + x (g1 - g_) / 2 + x^2 (g1 - 2 g0 + g_) / 2,  g1 = g(t1, y1, v*)
//! ```
//!
//! v* is the velocity under the line of the first row; it enters through contact damping alone. Without spring and damper
//! this is `y1 = y0 + h v0 + h^2 (4 g0 - g_) / 6`, `v1 = v0 + h (5 g1 + 8 g0 - g_) / 12`: Beeman's positions with the velocities
//! of the Adams-Moulton method (Hairer, Norsett, Wanner, Solving ODEs I, 2nd ed., III.1 and III.10). For a force `-k y` it is stable up to
//! `h sqrt(k)` = [`STABILITY_LIMIT`], with a phase error of `(h^2 k)^2 / 43` in a relative one, a four-hundredth of velocity
//! Verlet's at `h sqrt(k) = 0.07`, and it damps what it does not resolve: 1 % a step at 0.7.
//!
//! The polynomials are not symmetric in time, so energy creeps through modes whose `h w` is large: such modes are left out.

use super::driver::{Statistics, Stepper};
use super::propagator::Propagator;
use crate::dynamics::{Divergence, SecondOrderSystem};

/// Largest `h sqrt(k)` at which no solution under a force `-k y` grows: where the characteristic polynomial of the two
/// recursions has the root -1.
pub const STABILITY_LIMIT: f64 = 1.732_050_807_568_877_2;

#[derive(Debug)]
pub(super) struct Adams {
    flow: Vec<Propagator>,
    per_step: f64,
    predicted: Vec<f64>,
    before: Vec<f64>,
    next: Vec<f64>,
    steps: u64,
}

impl Adams {
    pub fn new(system: &impl SecondOrderSystem, h: f64) -> Self {
        let coordinates = system.linear().iter();
        let flow: Vec<_> = coordinates
            .map(|&coordinate| Propagator::new(coordinate, h))
            .collect();
        let blank = vec![0.0; flow.len()];
        Self {
            per_step: 1.0 / h,
            predicted: blank.clone(),
            before: blank.clone(),
            next: blank,
            steps: 0,
            flow,
        }
    }
}

impl<S: SecondOrderSystem> Stepper<S> for Adams {
    fn step(
        &mut self,
        system: &mut S,
        t1: f64,
        y: &mut [f64],
        v: &mut [f64],
        g: &mut [f64],
    ) -> Result<(), Divergence> {
        let first = self.steps == 0;
        if first {
            // no slope is known yet: the first step is of the second order
            self.before.copy_from_slice(g);
        }
        for (i, p) in self.flow.iter().enumerate() {
            let (y0, v0, g0) = (y[i], v[i], g[i]);
            let rise = g0 - self.before[i];
            y[i] = p.position_position * y0
                + p.position_velocity * v0
                + (p.response * g0 + p.ramp * rise);
            self.predicted[i] = p.velocity_position * y0
                + p.velocity_velocity * v0
                + (p.position_velocity * g0 + p.response * self.per_step * rise);
        }
        system.force_into(t1, y, &self.predicted, &mut self.next);
        for (i, p) in self.flow.iter().enumerate() {
            let (g0, g1) = (g[i], self.next[i]);
            if first {
                self.before[i] = 2.0 * g0 - g1;
                v[i] = self.predicted[i] + p.response * self.per_step * (g1 - g0);
            } else {
                // from the line to the parabola
                let bend = 0.5 * (g1 - 2.0 * g0 + self.before[i]);
                v[i] = self.predicted[i] + self.per_step * (p.response + 2.0 * p.ramp) * bend;
            }
            self.before[i] = g0;
            g[i] = g1;
        }
        self.steps += 1;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        Statistics::of_single_evaluations(self.steps)
    }
}
