//! One step of the exponential Adams method, coordinates side by side.

use super::super::propagator::Propagator;
use crate::dynamics::{
    LinearCoordinate, SecondOrderSystem, Snapshot, SnapshotError, SnapshotReader,
};
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
    /// From here on coordinates have neither spring nor damper but what the force is to them.
    free: usize,
    /// Force and position a step before; the line through them and the present ones is that of the prediction.
    before: Vec<f64>,
    place_before: Vec<f64>,
    /// Length of that step, s; none before the first.
    last: Option<f64>,
    /// Step under way over the last one.
    ratio: f64,
    /// What the force is to the free coordinates at the start of the step: springs that are stepped exactly, 1/s^2.
    springs: Vec<f64>,
    /// Of the free coordinates: position from rest under a unit force, and under one that grows to it, over the step's square.
    responses: Vec<f64>,
    ramps: Vec<f64>,
    position: Vec<f64>,
    velocity: Vec<f64>,
    force: Vec<f64>,
    /// The quadratic part over the step of what is no spring in the force.
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
    pub fn new(coordinates: &[LinearCoordinate]) -> Self {
        let held = |coordinate: &LinearCoordinate| {
            coordinate.squared_frequency != 0.0 || coordinate.damping != 0.0
        };
        let blank = vec![0.0; coordinates.len()];
        Self {
            free: coordinates
                .iter()
                .rposition(held)
                .map_or(0, |last| last + 1),
            before: blank.clone(),
            place_before: blank.clone(),
            last: None,
            ratio: 0.0,
            springs: blank.clone(),
            responses: blank.clone(),
            ramps: blank.clone(),
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
        let (held, free) = (..self.free, self.free..);
        predict(
            &flow.columns,
            self.ratio,
            [&y[held], &v[held], &g[held], &self.before[held]],
            &mut self.position[held],
            &mut self.velocity[held],
        );
        let most = LARGEST_PHASE / (flow.step * flow.step);
        for spring in &mut self.springs[free.clone()] {
            *spring = if *spring < most { *spring } else { most };
        }
        let of_springs = [&mut self.responses, &mut self.ramps];
        responses(
            flow.step,
            &self.springs[free.clone()],
            of_springs.map(|x| &mut x[free.clone()]),
        );
        let springs = [&self.springs, &self.responses, &self.ramps].map(|x| &x[free.clone()]);
        let now = [y, v, g].map(|x| &x[free.clone()]);
        let before = [&self.before, &self.place_before].map(|x| &x[free.clone()]);
        predict_free(
            [flow.step, self.ratio],
            springs,
            now,
            before,
            &mut self.position[free.clone()],
            &mut self.velocity[free],
        );
    }

    /// Evaluates the force at its end, and how far it leaves the line.
    pub fn evaluate(&mut self, system: &mut impl SecondOrderSystem, t: f64, y: &[f64], g: &[f64]) {
        system.force_into(t, &self.position, &self.velocity, &mut self.force);
        bends_into(
            self.ratio,
            &self.springs,
            [&self.force, g, &self.before],
            [&self.position, y, &self.place_before],
            &mut self.bends,
        );
    }

    /// Largest bend in units of the largest force of its coordinate so far.
    pub fn bend(&self) -> f64 {
        most(&self.bends, &self.force, &self.largest)
    }

    /// Takes the step: the velocity under the parabola of the force.
    pub fn accept(&mut self, flow: &Flow, [y, v, g]: [&mut [f64]; 3]) {
        let [.., response, ramp] = &flow.columns;
        let (held, free) = (..self.free, self.free..);
        // before the first step there is no parabola: the velocity under the line through its ends
        let shares = match self.last {
            Some(_) => [1.0 / self.ratio, 2.0],
            None => {
                for (i, bend) in self.bends.iter_mut().enumerate() {
                    let spring = self.springs[i] * (self.position[i] - y[i]);
                    *bend = self.force[i] - g[i] + spring;
                }
                [1.0, 0.0]
            }
        };
        let held_parts = [&response[held], &ramp[held]];
        correct(
            shares,
            held_parts,
            &self.velocity[held],
            &self.bends[held],
            &mut v[held],
        );
        let over_step = shares.map(|share| flow.step * share);
        let free_parts = [&self.responses, &self.ramps].map(|x| &x[free.clone()]);
        let (predicted, bends) = (&self.velocity[free.clone()], &self.bends[free.clone()]);
        correct(over_step, free_parts, predicted, bends, &mut v[free]);
        for (largest, force) in self.largest.iter_mut().zip(&self.force) {
            let force = force.abs();
            *largest = if *largest > force { *largest } else { force };
        }
        self.place_before.copy_from_slice(y);
        y.copy_from_slice(&self.position);
        self.before.copy_from_slice(g);
        g.copy_from_slice(&self.force);
        self.last = Some(flow.step);
    }

    /// Writes what the next step depends on.
    pub fn remember(&self, snapshot: &mut Snapshot) {
        snapshot.option(self.last);
        for values in [
            &self.before,
            &self.place_before,
            &self.springs,
            &self.largest,
        ] {
            snapshot.numbers(values);
        }
    }

    /// Reads what [`remember`](Self::remember) wrote.
    ///
    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    pub fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError> {
        self.last = snapshot.option()?;
        snapshot.numbers_into("forces a step before", &mut self.before)?;
        snapshot.numbers_into("positions a step before", &mut self.place_before)?;
        snapshot.numbers_into("springs", &mut self.springs)?;
        snapshot.numbers_into("largest forces", &mut self.largest)
    }

    /// Takes the springs of the free coordinates where the force was evaluated last.
    pub fn find_springs(&mut self, system: &impl SecondOrderSystem) {
        system.own_stiffness_into(&mut self.springs);
        self.springs[..self.free].fill(0.0);
    }
}

/// Largest phase squared by which a spring turns in a step; what is beyond stays in the force.
const LARGEST_PHASE: f64 = 4.0;

/// Terms of the series in the phase squared x: the first one left out is below 1e-13 at the largest.
const TERMS: usize = 10;

/// `(-1)^k / (2 k + 2)!` and `(-1)^k / (2 k + 3)!`, highest k first.
const SERIES: [[f64; 2]; TERMS] = series();

const fn series() -> [[f64; 2]; TERMS] {
    let mut out = [[0.0; 2]; TERMS];
    let (mut factorial, mut sign, mut k) = (1.0, 1.0, 0);
    while k < TERMS {
        factorial *= if k == 0 { 2.0 } else { (2 * k + 2) as f64 };
        let even = sign / factorial;
        factorial *= (2 * k + 3) as f64;
        out[TERMS - 1 - k] = [even, sign / factorial];
        sign = -sign;
        k += 1;
    }
    out
}

/// With x the square of a spring's phase over the step: `(1 - cos) / x` and `(1 - sin / phase) / x`.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn responses(step: f64, springs: &[f64], [responses, ramps]: [&mut [f64]; 2]) {
    let n = springs.len();
    let (responses, ramps) = (&mut responses[..n], &mut ramps[..n]);
    for i in 0..n {
        let x = springs[i] * step * step;
        let [mut response, mut ramp] = SERIES[0];
        for [even, odd] in &SERIES[1..] {
            response = response * x + even;
            ramp = ramp * x + odd;
        }
        responses[i] = response;
        ramps[i] = ramp;
    }
}

/// The same as [`predict`] for springs k that are in the force: cosine and sine are `1 - x r` and `1 - x p`, and what the spring
/// does where the step begins is in the force already.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn predict_free(
    [step, ratio]: [f64; 2],
    [springs, responses, ramps]: [&[f64]; 3],
    [y, v, g]: [&[f64]; 3],
    [before, place_before]: [&[f64]; 2],
    position: &mut [f64],
    velocity: &mut [f64],
) {
    let n = position.len();
    let (springs, responses, ramps) = (&springs[..n], &responses[..n], &ramps[..n]);
    let (y, v, g) = (&y[..n], &v[..n], &g[..n]);
    let (before, place_before) = (&before[..n], &place_before[..n]);
    let velocity = &mut velocity[..n];
    for i in 0..n {
        let (r, p) = (responses[i], ramps[i]);
        let x = springs[i] * step * step;
        let sine = 1.0 - x * p;
        let rise = ratio * ((g[i] - before[i]) + springs[i] * (y[i] - place_before[i]));
        position[i] = y[i] + step * (sine * v[i] + step * (r * g[i] + p * rise));
        velocity[i] = (1.0 - x * r) * v[i] + step * (sine * g[i] + r * rise);
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

/// `predicted + (shares . parts) bend`.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn correct(
    [first, second]: [f64; 2],
    [response, ramp]: [&[f64]; 2],
    predicted: &[f64],
    bends: &[f64],
    velocity: &mut [f64],
) {
    let n = velocity.len();
    let (response, ramp) = (&response[..n], &ramp[..n]);
    let (predicted, bends) = (&predicted[..n], &bends[..n]);
    for i in 0..n {
        velocity[i] = predicted[i] + (first * response[i] + second * ramp[i]) * bends[i];
    }
}

#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
fn bends_into(
    ratio: f64,
    springs: &[f64],
    [next, now, before]: [&[f64]; 3],
    [place_next, place, place_before]: [&[f64]; 3],
    bends: &mut [f64],
) {
    let n = bends.len();
    let (next, now, before) = (&next[..n], &now[..n], &before[..n]);
    let (place_next, place, place_before) = (&place_next[..n], &place[..n], &place_before[..n]);
    let (springs, share) = (&springs[..n], ratio / (1.0 + ratio));
    for i in 0..n {
        let rise = (next[i] - now[i]) + springs[i] * (place_next[i] - place[i]);
        let line = (now[i] - before[i]) + springs[i] * (place[i] - place_before[i]);
        bends[i] = share * (rise - ratio * line);
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
