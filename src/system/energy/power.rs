//! Powers at one instant, where the force was evaluated last.
//!
//! Integrals of functions at equal intervals as they come: Gregory's formula.

use super::super::coupled::CoupledSystem;
use super::super::powers::{FLOWS, Powers};
use super::super::race::RaceEnergy;
use crate::bearing::RotationState;
use crate::numerics::lanes;
use crate::numerics::lanes::LANES;
use crate::numerics::ode::{Instant, Snapshot, SnapshotError, SnapshotReader};
use std::f64::consts::TAU;

/// How everything turns, and the velocity of the shaft's centre, m/s.
#[derive(Clone, Copy)]
struct Motion {
    shaft: RotationState,
    cage: RotationState,
    centre: [f64; 2],
}

impl Powers {
    /// Finds them at a state at which the force was evaluated last.
    pub(in crate::system) fn find(&mut self, system: &CoupledSystem, now: &Instant<'_>) {
        let modes = system.modes;
        lanes::set(&mut self.velocities, &now.v[..modes]);
        let motion = Motion {
            shaft: system.setup.cage.shaft().motion(now.t),
            cage: system.setup.cage.motion(now.t),
            centre: [now.v[modes], now.v[modes + 1]],
        };
        let linear = system.linear.iter().zip(now.v);
        let modal: f64 = linear.map(|(linear, v)| linear.damping * v * v).sum();
        self.flows = [system.load_power(now, &motion), 0.0, modal, 0.0, 0.0];
        for j in 0..system.balls.count {
            let rate = now.v[modes + 2 + j];
            self.carried(system, j, rate, &motion);
            self.inner(system, j, rate, &motion);
            self.outer(system, j, rate, &motion);
        }
        if let Some(coupling) = &system.residual {
            let force = |j: usize| system.balls.get(j, |ball| &ball.outer_radial);
            self.flows[1] -= motion.cage.speed * coupling.work_by_turning(force);
        }
    }

    /// Weight of a ball, and the centrifugal load, which is the cage's.
    fn carried(&mut self, system: &CoupledSystem, j: usize, rate: f64, motion: &Motion) {
        let mass = system.setup.geometry.ball_mass();
        let ([x, y], gravity) = (system.balls.direction_of(j), system.setup.gravity);
        let square = motion.cage.speed * motion.cage.speed;
        self.flows[0] += mass * (gravity[0] * x + gravity[1] * y) * rate;
        self.flows[1] += mass * system.radius(j) * square * rate;
    }

    fn inner(&mut self, system: &CoupledSystem, j: usize, rate: f64, motion: &Motion) {
        let (group, lane) = (&system.balls.groups[j / LANES], j % LANES);
        if group.inner.penetration[lane] <= -system.inner.rise {
            return;
        }
        let (gap, e) = (system.balls.inner_gap(j), system.balls.direction_of(j));
        let n = gap.normal;
        let turn = system.radius(j) * motion.cage.speed;
        let rates = system.velocity_on_inner(j, &gap, rate, motion.centre);
        let on_race = group.on_inner.map(|force| force[lane]);
        let tangential = n[0] * on_race[1] - n[1] * on_race[0];
        let (damage, place) = system.inner_place(j, &gap, rates, &motion.shaft);
        let oversize = system.balls.get(j, |ball| &ball.oversize);
        let turning = (gap.distance - oversize) * place.turning;
        let energy = system.inner.energy(damage, &place, rates[0]);
        // what the contact takes less what ball and shaft give
        self.flows[1] += turn * (on_race[1] * e[0] - on_race[0] * e[1])
            - tangential * (turning + (rates[1] - place.along))
            - energy.carried;
        self.flows[3] += energy.dissipated;
        self.flows[4] += system.inner.blending(damage, &place, rates[0]);
    }

    fn outer(&mut self, system: &CoupledSystem, j: usize, rate: f64, motion: &Motion) {
        let (group, lane) = (&system.balls.groups[j / LANES], j % LANES);
        self.yielding[j] = [0.0; 2];
        let displaced = system.race_displacement(j);
        if group.gap[lane] - displaced <= -system.outer.rise {
            return;
        }
        let amplitudes = &system.work.amplitudes;
        let at = system.radial.locate(&group.turn).get(lane);
        let speed = motion.cage.speed;
        system.radial.slopes_into(at, speed / TAU, &mut self.row);
        let climbed = lanes::dot(self.row.iter(), amplitudes);
        let rows = group.rows.iter().map(|rows| &rows[lane]);
        let towards = rate - climbed - lanes::dot(rows, &self.velocities);
        let tangential = group.outer_tangential[lane];
        let (damage, place) = system.outer_place(j, group.gap[lane] - displaced);
        if tangential != 0.0 {
            let (at, row) = (system.tangential_place(j), self.row.iter_mut());
            system.tangential.values_into(at, amplitudes, row);
            let moved = lanes::dot(self.row.iter(), &self.velocities);
            // what the contact takes less what the modes give
            self.flows[1] += tangential * (place.along + moved);
        }
        self.flows[1] -= group.outer_radial[lane] * climbed;
        let RaceEnergy { dissipated, damping, carried, .. } = system.outer.energy(damage, &place, towards);
        self.flows[1] -= carried;
        self.flows[3] += dissipated;
        self.flows[4] += system.outer.blending(damage, &place, towards);
        if let Some(coupling) = &system.residual {
            let weight = coupling.weight::<0>().as_flattened()[j];
            self.yielding[j] = [damping, displaced + weight];
        }
    }
}

impl CoupledSystem {
    /// Power of weight, loads and unbalance on shaft and structure, W.
    fn load_power(&self, now: &Instant<'_>, motion: &Motion) -> f64 {
        let [mut x, mut y] = self.setup.shaft_load(now.t);
        let ([cos, sin], unbalance) = (self.work.shaft_direction, self.setup.shaft.unbalance);
        let (centrifugal, tangential) =
            (unbalance * motion.shaft.speed * motion.shaft.speed, unbalance * motion.shaft.acceleration);
        x += centrifugal * cos + tangential * sin;
        y += centrifugal * sin - tangential * cos;
        let weight = self.gravity.as_flattened().iter().zip(&now.v[..self.modes]);
        let weight: f64 = weight.map(|(weight, v)| weight * v).sum();
        weight + x * motion.centre[0] + y * motion.centre[1]
    }

    /// Displacement of the race under ball `j` by the static residual under the contacts' forces, m.
    pub(super) fn race_displacement(&self, j: usize) -> f64 {
        match &self.residual {
            Some(_) => self.balls.get(j, |ball| &ball.displaced),
            None => 0.0,
        }
    }
}

/// Values at either end that the corrections take.
const ENDS: usize = 4;

/// Of a value at an end and its differences inwards: what the sum of all values has too much (Hildebrand, Introduction to
/// Numerical Analysis, 2nd ed., 5.9).
const GREGORY: [f64; ENDS] = [1.0 / 2.0, -1.0 / 12.0, 1.0 / 24.0, -19.0 / 720.0];

/// Sums of [`FLOWS`] functions.
#[derive(Debug, Clone, Default)]
pub(super) struct Integral {
    sums: [f64; FLOWS],
    /// Sum of all magnitudes.
    pub magnitude: f64,
    first: Vec<[f64; FLOWS]>,
    /// Newest last.
    last: Vec<[f64; FLOWS]>,
}

impl Integral {
    /// Takes the next values.
    pub(crate) fn add(&mut self, values: &[f64; FLOWS]) {
        for (sum, value) in self.sums.iter_mut().zip(values) {
            *sum += value;
            self.magnitude += value.abs();
        }
        if self.first.len() < ENDS {
            self.first.push(*values);
        }
        if self.last.len() == ENDS {
            self.last.remove(0);
        }
        self.last.push(*values);
    }

    /// Integrals with so much between two values.
    pub(crate) fn of(&self, step: f64) -> [f64; FLOWS] {
        std::array::from_fn(|flow| {
            let first: Vec<f64> = self.first.iter().map(|values| values[flow]).collect();
            let last: Vec<f64> = self.last.iter().rev().map(|values| values[flow]).collect();
            step * (self.sums[flow] - beyond(first) - beyond(last))
        })
    }

    pub(crate) fn remember(&self, snapshot: &mut Snapshot) {
        snapshot.numbers(&self.sums);
        snapshot.number(self.magnitude);
        snapshot.numbers(self.first.as_flattened());
        snapshot.numbers(self.last.as_flattened());
    }

    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    pub(crate) fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError> {
        snapshot.numbers_into("sums of powers", &mut self.sums)?;
        self.magnitude = snapshot.number()?;
        self.first = snapshot.numbers()?.as_chunks().0.to_vec();
        self.last = snapshot.numbers()?.as_chunks().0.to_vec();
        Ok(())
    }
}

/// What a sum has too much at an end, from the values there inwards.
fn beyond(mut values: Vec<f64>) -> f64 {
    let mut sum = 0.0;
    for weight in GREGORY.into_iter().take(values.len()) {
        sum += weight * values[0];
        for place in 1..values.len() {
            values[place - 1] = values[place] - values[place - 1];
        }
        values.pop();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_integrated_exactly_however_few_values() {
        for intervals in [3_u32, 4, 9] {
            let mut integral = Integral::default();
            for place in 0..=intervals {
                let x = f64::from(place) / f64::from(intervals);
                integral.add(&[1.0, x, x * x, x * x * x, 0.0]);
            }
            let found = integral.of(1.0 / f64::from(intervals));
            for (power, found) in (1_u32..5).zip(found) {
                // round-off of ten terms
                assert!((found - 1.0 / f64::from(power)).abs() < 1e-14, "{power}");
            }
        }
    }
}
