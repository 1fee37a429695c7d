//! What a state stores and what flows: the energy balance of the spatial system.
//!
//! Potentials are those of modes and contacts. Cage and friction of the gyroscopic moment work as prescribed motion does: their power
//! is in `rotation`, beside that of the centrifugal load.

use super::balls::BearingBalls;
use super::force::{InnerRing, unbalance_force};
use super::pose::Pose;
use super::setup::SHAFT;
use super::system::SpatialSystem;
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, LANES, Lanes};
use crate::numerics::ode::Instant;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Powers at a state, W.
#[derive(Debug, Clone, Default)]
pub(super) struct Flow {
    /// Weight, loads and unbalance.
    pub loads: f64,
    /// Cage, centrifugal load and friction.
    pub rotation: f64,
    /// Taken by the damping of modes.
    pub modal_damping: f64,
    /// Taken by the damping of contacts.
    pub contact_damping: f64,
    /// Got by contacts as their stiffness changed along the profiles of defects.
    pub blending: f64,
}

impl SpatialSystem {
    /// Kinetic and elastic energy of a state at which the force was evaluated last, J.
    pub(super) fn energy_at(&self, &Instant { y, v, .. }: &Instant<'_>) -> f64 {
        let modes = self.modes;
        let mut doubled: f64 = (0..modes).map(|i| v[i] * v[i] + self.linear[i].squared_frequency * y[i] * y[i]).sum();
        let own = &self.setup.shaft;
        let squares = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
        doubled += own.mass * squares(&v[modes..modes + 3]);
        doubled += own.transverse_inertia * squares(&v[modes + 3..modes + SHAFT]);
        let mut energy = 0.0;
        for ((first, count), bearing) in self.ball_ranges().zip(&self.bearings) {
            doubled += squares(&v[first..first + 2 * count]) / bearing.mobility;
            energy += bearing.contact_energy();
        }
        0.5 * doubled + energy
    }

    /// Powers at a state at which the force was evaluated last; `velocities` and `row` are room for the modes.
    pub(super) fn flow(&self, now: &Instant<'_>, velocities: &mut [Lanes], row: &mut [Lanes]) -> Flow {
        let (modes, &Instant { t, y, v, .. }) = (self.modes, now);
        lanes::set(velocities, &v[..modes]);
        let linear = self.linear.iter().zip(v);
        let mut flow =
            Flow { modal_damping: linear.map(|(linear, v)| linear.damping * v * v).sum(), ..Flow::default() };
        let weight = self.gravity.as_flattened().iter().zip(&v[..modes]);
        flow.loads += weight.map(|(weight, v)| weight * v).sum::<f64>();
        let pose = Pose::new(&y[modes..]);
        let shaft = self.setup.bearings[0].cage.shaft().motion(t);
        let mut load = self.setup.shaft_load(&pose, t);
        for unbalance in &self.setup.shaft.unbalances {
            let [x, y] = unbalance_force(unbalance, self.work.shaft_direction, &shaft);
            let [p, q] = pose.on_tilts(pose.arm(unbalance.place)[0].cross(&Vector3::new(x, y, 0.0)));
            for (sum, part) in load.iter_mut().zip([x, y, 0.0, p, q]) {
                *sum += part;
            }
        }
        flow.loads += load.iter().zip(&v[modes..]).map(|(load, v)| load * v).sum::<f64>();
        for (((first, count), bearing), own) in self.ball_ranges().zip(&self.bearings).zip(&self.setup.bearings) {
            let cage = own.cage.motion(t);
            let rates = &v[first..first + 2 * count];
            bearing.add_flow(&mut flow, self.setup.gravity, &cage, rates, (&self.work.amplitudes, velocities, row));
            if bearing.friction[0] > 0.0 {
                let ring = InnerRing::new(&pose, [own.place, own.offset], &v[modes..]);
                flow.rotation += bearing.inner_friction_power(&ring, &cage, rates);
            }
        }
        flow
    }
}

impl BearingBalls {
    fn contact_energy(&self) -> f64 {
        let ball = |j: usize| {
            let (group, lane) = (&self.groups[j / LANES], j % LANES);
            self.inner.energy(&group.inner, lane) + self.outer.energy(&group.outer, lane)
        };
        let whole: f64 = (0..self.count).map(ball).sum();
        let felt = |race: usize, j: usize| {
            let group = &self.groups[j / LANES];
            if race == 0 {
                self.inner.energy(&group.inner, j % LANES)
            } else {
                self.outer.energy(&group.outer, j % LANES)
            }
        };
        let damage = self.damage.iter().enumerate();
        let beyond = damage.filter_map(|(race, damage)| Some(damage.as_ref()?.energy_beyond(|j| felt(race, j))));
        whole + beyond.sum::<f64>()
    }

    /// Adds the powers of the balls and of the contacts.
    fn add_flow(
        &self,
        flow: &mut Flow,
        [gx, gy, gz]: [f64; 3],
        cage: &RotationState,
        rates: &[f64],
        (amplitudes, velocities, slopes): (&[Lanes], &[Lanes], &mut [Lanes]),
    ) {
        for damage in self.damage.iter().flatten() {
            let [driven, blending] = damage.powers();
            flow.rotation += driven;
            flow.blending += blending;
        }
        let mass = 1.0 / self.mobility;
        for j in 0..self.count {
            let (group, lane) = (&self.groups[j / LANES], j % LANES);
            let (radial, axial) = (rates[j], rates[self.count + j]);
            let [cos, sin] = group.direction.map(|component| component[lane]);
            let rho = self.base + group.place[0][lane];
            flow.loads += mass * ((gx * cos + gy * sin) * radial + gz * axial);
            flow.rotation += mass * rho * cage.speed * cage.speed * radial;
            // the orbit moves the ball along the inner race
            let [x, y, _] = group.from_inner.map(|component| component[lane]);
            flow.rotation -= (y * cos - x * sin) * rho * cage.speed;
            // and along the deformed outer one
            let on_outer = group.on_outer.map(|component| component[lane]);
            let mut race = [0.0; 2];
            for (component, table) in self.rows.iter().enumerate() {
                let at = table.locate(&group.turn).get(lane);
                table.slopes_into(at, cage.speed / TAU, slopes);
                let climbed = lanes::dot(slopes.iter(), amplitudes);
                flow.rotation -= on_outer[component] * climbed;
                let own = group.rows[component].iter().map(|rows| &rows[lane]);
                race[component] = climbed + lanes::dot(own, velocities);
            }
            let friction = self.outer_friction(j);
            flow.rotation += friction[0] * (radial - race[0]) + friction[1] * (axial - race[1]);
            let [inner, outer] = group.approach.map(|approach| approach[lane]);
            flow.contact_damping += (group.loads[1][lane] - group.outer.load[lane]) * outer
                + (group.loads[0][lane] - group.inner.load[lane]) * inner;
        }
    }

    /// Friction on ball `j` at the outer race, radial and axial, N.
    fn outer_friction(&self, j: usize) -> [f64; 2] {
        let (group, lane) = (&self.groups[j / LANES], j % LANES);
        if group.outer.penetration[lane] <= 0.0 {
            return [0.0; 2];
        }
        let [r, z] = group.outer.normal.map(|component| component[lane]);
        let size = self.gyroscopic * self.cage_speed * self.cage_speed * self.friction[1] * z;
        [size * z, -size * r]
    }

    /// Power of the friction at the inner race by the velocities of balls against the ring there, W.
    fn inner_friction_power(&self, ring: &InnerRing, cage: &RotationState, rates: &[f64]) -> f64 {
        let ball = |j: usize| {
            let (group, lane) = (&self.groups[j / LANES], j % LANES);
            if group.inner.penetration[lane] <= 0.0 {
                return 0.0;
            }
            let [cos, sin] = group.direction.map(|component| component[lane]);
            let [radial, axial] = group.place.map(|component| component[lane]);
            let rho = self.base + radial;
            let arm = Vector3::new(rho * cos, rho * sin, axial) - ring.centre;
            let orbit = rho * cage.speed;
            let own = Vector3::new(rates[j] * cos - orbit * sin, rates[j] * sin + orbit * cos, rates[self.count + j]);
            let slip = ring.rotation.transpose() * (own - ring.velocity - ring.turning.cross(&arm));
            let seen = ring.rotation.transpose() * arm;
            let outwards = (seen.x * slip.x + seen.y * slip.y) / seen.x.hypot(seen.y);
            let [r, z] = group.inner.normal.map(|component| component[lane]);
            let sine = group.outer.normal[1][lane];
            let size = self.gyroscopic * self.cage_speed * self.cage_speed * self.friction[0] * sine;
            size * (z * outwards - r * slip.z)
        };
        (0..self.count).map(ball).sum()
    }
}
