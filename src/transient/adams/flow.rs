//! One step of the exponential Adams method, coordinates side by side.

use super::super::propagator::Propagator;
use crate::dynamics::{LinearCoordinate, SecondOrderSystem};
use multiversion::multiversion;

/// The exact flow of all coordinates over a step, one column a coefficient of [`Propagator`].
#[derive(Debug)]
pub struct Flow {
    /// s.
    pub step: f64,
    /// position_position, position_velocity, velocity_position, velocity_velocity, response, ramp, and the last two over the
    /// step.
    columns: [Vec<f64>; 8],
}

/// The step that is being tried, and what the last one left.
#[derive(Debug)]
pub struct Track {
    /// Force a step before; the line through it and the present force is that of the prediction.
    before: Vec<f64>,
    /// Length of that step, s; none before the first.
    last: Option<f64>,
    /// Step under way over the last one.
    ratio: f64,
    position: Vec<f64>,
    velocity: Vec<f64>,
    force: Vec<f64>,
    /// The quadratic part of the force over the step.
    bends: Vec<f64>,
    /// Largest force of each coordinate so far.
    largest: Vec<f64>,
}

impl Flow {
    pub fn new(coordinates: &[LinearCoordinate], step: f64) -> Self {
        let flow: Vec<_> = coordinates
            .iter()
            .map(|&coordinate| Propagator::new(coordinate, step))
            .collect();
        let column = |of: fn(&Propagator) -> f64| flow.iter().map(of).collect::<Vec<_>>();
        let over_step = |column: Vec<f64>| column.iter().map(|value| value / step).collect();
        Self {
            step,
            columns: [
                column(|p| p.position_position),
                column(|p| p.position_velocity),
                column(|p| p.velocity_position),
                column(|p| p.velocity_velocity),
                column(|p| p.response),
                column(|p| p.ramp),
                over_step(column(|p| p.response)),
                over_step(column(|p| p.ramp)),
            ],
        }
    }
}

impl Track {
    pub fn new(coordinates: usize) -> Self {
        let blank = vec![0.0; coordinates];
        Self {
            before: blank.clone(),
            last: None,
            ratio: 0.0,
            position: blank.clone(),
            velocity: blank.clone(),
            force: blank.clone(),
            bends: blank.clone(),
            largest: blank,
        }
    }

    /// Goes over a step from a state under the line of the force.
    pub fn predict(&mut self, flow: &Flow, y: &[f64], v: &[f64], g: &[f64]) {
        // no slope is known before the first step: it is of the second order
        self.ratio = self.last.map_or(0.0, |last| flow.step / last);
        let state = [y, v, g, self.before.as_slice()];
        predict(
            &flow.columns,
            self.ratio,
            state,
            &mut self.position,
            &mut self.velocity,
        );
    }

    /// Evaluates the force at its end, and how far it leaves the line.
    pub fn evaluate(&mut self, system: &mut impl SecondOrderSystem, t: f64, g: &[f64]) {
        system.force_into(t, &self.position, &self.velocity, &mut self.force);
        let forces = [self.force.as_slice(), g, &self.before];
        bends_into(self.ratio, forces, &mut self.bends);
    }

    /// Largest bend in units of the largest force of its coordinate so far.
    pub fn bend(&self) -> f64 {
        most(&self.bends, &self.force, &self.largest)
    }

    /// Takes the step: the velocity under the parabola of the force.
    pub fn accept(&mut self, flow: &Flow, y: &mut [f64], v: &mut [f64], g: &mut [f64]) {
        y.copy_from_slice(&self.position);
        if self.last.is_some() {
            correct(&flow.columns, self.ratio, &self.velocity, &self.bends, v);
        } else {
            let [.., response, _] = &flow.columns;
            for (i, response) in response.iter().enumerate() {
                v[i] = self.velocity[i] + response * (self.force[i] - g[i]);
            }
        }
        for (largest, force) in self.largest.iter_mut().zip(&self.force) {
            let force = force.abs();
            *largest = if *largest > force { *largest } else { force };
        }
        self.before.copy_from_slice(g);
        g.copy_from_slice(&self.force);
        self.last = Some(flow.step);
    }
}

#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn predict(
    columns: &[Vec<f64>; 8],
    ratio: f64,
    [y, v, g, before]: [&[f64]; 4],
    position: &mut [f64],
    velocity: &mut [f64],
) {
    let n = position.len();
    let [pp, pv, vp, vv, response, ramp, response_over, _] = columns;
    let (pp, pv, vp, vv) = (&pp[..n], &pv[..n], &vp[..n], &vv[..n]);
    let (response, ramp, response_over) = (&response[..n], &ramp[..n], &response_over[..n]);
    let (y, v, g, before) = (&y[..n], &v[..n], &g[..n], &before[..n]);
    let velocity = &mut velocity[..n];
    for i in 0..n {
        let rise = ratio * (g[i] - before[i]);
        position[i] = pp[i] * y[i] + pv[i] * v[i] + (response[i] * g[i] + ramp[i] * rise);
        velocity[i] = vp[i] * y[i] + vv[i] * v[i] + (pv[i] * g[i] + response_over[i] * rise);
    }
}

#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn correct(
    columns: &[Vec<f64>; 8],
    ratio: f64,
    predicted: &[f64],
    bends: &[f64],
    velocity: &mut [f64],
) {
    let n = velocity.len();
    let [.., response, ramp] = columns;
    let (response, ramp) = (&response[..n], &ramp[..n]);
    let (predicted, bends) = (&predicted[..n], &bends[..n]);
    let share = 1.0 / ratio;
    for i in 0..n {
        velocity[i] = predicted[i] + (share * response[i] + 2.0 * ramp[i]) * bends[i];
    }
}

#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn bends_into(ratio: f64, [next, now, before]: [&[f64]; 3], bends: &mut [f64]) {
    let n = bends.len();
    let (next, now, before) = (&next[..n], &now[..n], &before[..n]);
    let share = ratio / (1.0 + ratio);
    for i in 0..n {
        bends[i] = share * ((next[i] - now[i]) - ratio * (now[i] - before[i]));
    }
}

/// Largest |bend| over the larger of |force| and `largest`; what is not a number does not count.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn most(bends: &[f64], forces: &[f64], largest: &[f64]) -> f64 {
    let n = bends.len();
    let (forces, largest) = (&forces[..n], &largest[..n]);
    let mut sums = [0.0; 4];
    for i in 0..n {
        let force = forces[i].abs();
        let unit = if largest[i] > force {
            largest[i]
        } else {
            force
        };
        let share = bends[i].abs() / (unit + f64::MIN_POSITIVE);
        sums[i % 4] = if share > sums[i % 4] {
            share
        } else {
            sums[i % 4]
        };
    }
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    larger(larger(sums[0], sums[1]), larger(sums[2], sums[3]))
}
