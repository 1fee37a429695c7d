//! Powers at one instant, where the force was evaluated last.

use super::super::coupled::CoupledSystem;
use super::super::race::{Damage, RaceEnergy, RacePlace};
use super::integral::FLOWS;
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, LANES, Lanes};
use crate::numerics::ode::Instant;
use std::f64::consts::TAU;

/// Powers and what else has to be summed up.
#[derive(Debug, Clone)]
pub(super) struct Powers {
    /// As [`FLOWS`] counts them, W; that of contact damping without what the static residual's displacements
    /// take from it.
    pub flows: [f64; FLOWS],
    /// What damping adds to the outer force of each ball, N, and the static residual's displacement of the race there, m.
    pub yielding: Vec<[f64; 2]>,
    velocities: Vec<Lanes>,
    row: Vec<Lanes>,
}

/// How everything turns, and the velocity of the shaft's centre, m/s.
#[derive(Clone, Copy)]
struct Motion {
    shaft: RotationState,
    cage: RotationState,
    centre: [f64; 2],
}

impl Powers {
    pub fn new(system: &CoupledSystem) -> Self {
        let groups = lanes::column(system.modes, 0.0);
        Self {
            flows: [0.0; FLOWS],
            yielding: vec![[0.0; 2]; system.balls.count],
            velocities: groups.clone(),
            row: groups,
        }
    }

    /// Finds them at a state at which the force was evaluated last.
    pub fn find(&mut self, system: &CoupledSystem, now: &Instant<'_>) {
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
        if group.penetration[lane] <= -system.inner.rise() {
            return;
        }
        let (n, e) = (group.inner_normal.map(|n| n[lane]), system.balls.direction_of(j));
        let turn = system.radius(j) * motion.cage.speed;
        let moving = [rate * e[0] - turn * e[1] - motion.centre[0], rate * e[1] + turn * e[0] - motion.centre[1]];
        let rates = [-(n[0] * moving[0] + n[1] * moving[1]), n[0] * moving[1] - n[1] * moving[0]];
        let on_race = group.on_inner.map(|force| force[lane]);
        let tangential = n[0] * on_race[1] - n[1] * on_race[0];
        let (damage, place) = system.inner_place(j, rates, &motion.shaft);
        let carrier = match damage {
            Damage::Flat(_) => place.spin[1],
            _ => place.turning,
        };
        self.flows[1] +=
            turn * (on_race[1] * e[0] - on_race[0] * e[1]) - tangential * group.inner_distance[lane] * carrier;
        self.flows[3] += system.inner.energy(damage, &place, rates).dissipated;
        let around = rates[1] / group.inner_distance[lane];
        self.flows[4] += system.inner.blending(damage, &place, rates, around);
    }

    fn outer(&mut self, system: &CoupledSystem, j: usize, rate: f64, motion: &Motion) {
        let (group, lane) = (&system.balls.groups[j / LANES], j % LANES);
        self.yielding[j] = [0.0; 2];
        let displaced = system.race_displacement(j);
        if group.gap[lane] - displaced <= -system.outer.rise() {
            return;
        }
        let amplitudes = &system.work.amplitudes;
        let at = system.radial.locate(&group.turn).get(lane);
        let speed = motion.cage.speed;
        system.radial.slopes_into(at, speed / TAU, &mut self.row);
        let climbed = lanes::dot(self.row.iter(), amplitudes);
        let rows = group.rows.iter().map(|rows| &rows[lane]);
        let towards = rate - climbed - lanes::dot(rows, &self.velocities);
        let mut along = system.radius(j) * speed;
        let tangential = group.outer_tangential[lane];
        let (damage, place) = system.outer_place(j, displaced, &mut self.row);
        if system.outer.is_irregular() {
            let moved = lanes::dot(self.row.iter(), &self.velocities);
            let at = system.tangential_place(j);
            system.tangential.slopes_into(at, speed / TAU, &mut self.row);
            let carried = lanes::dot(self.row.iter(), amplitudes);
            let carrier = match damage {
                Damage::Flat(_) => system.radius(j) * place.spin[1],
                _ => 0.0,
            };
            self.flows[1] += tangential * (along - carried - carrier);
            along -= carried + moved;
        }
        self.flows[1] -= group.outer_radial[lane] * climbed;
        let RaceEnergy { dissipated, damping, .. } = system.outer.energy(damage, &place, [towards, along]);
        self.flows[3] += dissipated;
        let around = along / system.radius(j);
        self.flows[4] += system.outer.blending(damage, &place, [towards, along], around);
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

    /// What ball `j` feels at the inner race, and its place there at rates towards and along the race, m/s.
    pub(super) fn inner_place(&self, j: usize, [rate, along]: [f64; 2], shaft: &RotationState) -> (Damage, RacePlace) {
        let gap = self.balls.inner_gap(j);
        let mut place =
            RacePlace { penetration: gap.penetration, rate, along, turning: shaft.speed, ..RacePlace::default() };
        if !self.inner.is_irregular() {
            return (Damage::None, place);
        }
        let (e, n) = (self.balls.direction_of(j), gap.normal);
        let [cos, sin] = self.work.shaft_direction;
        let in_the_race = [n[0] * cos + n[1] * sin, n[1] * cos - n[0] * sin];
        let turned = (e[0] * n[1] - e[1] * n[0]).atan2(e[0] * n[0] + e[1] * n[1]);
        let [spin, speed] = self.work.spin[j];
        place.angle = self.ball_angle(j) + turned - shaft.angle;
        place.spin = [spin - turned, speed];
        let flat = self.balls.flat[j].filter(|&flat| self.inner.feels(flat, spin - turned));
        let damage = match (self.inner.defect_at(in_the_race), flat) {
            (Some(defect), _) => Damage::Race(defect),
            (None, Some(flat)) => Damage::Flat(flat),
            (None, None) => Damage::None,
        };
        (damage, place)
    }

    /// What ball `j` feels at the outer race, and its place there at the rates of the last evaluation; on an irregular race
    /// `row` becomes that of the tangential displacement.
    pub(super) fn outer_place(&self, j: usize, displaced: f64, row: &mut [Lanes]) -> (Damage, RacePlace) {
        let mut place = RacePlace {
            penetration: self.balls.get(j, |ball| &ball.gap) - displaced,
            rate: self.balls.get(j, |ball| &ball.rate),
            along: self.balls.get(j, |ball| &ball.along),
            ..RacePlace::default()
        };
        if !self.outer.is_irregular() {
            return (Damage::None, place);
        }
        let at = self.tangential_place(j);
        let amplitudes = &self.work.amplitudes;
        let along = self.tangential.values_into(at, amplitudes, row.iter_mut());
        let shift = along / self.radius(j);
        let [spin, speed] = self.work.spin[j];
        place.angle = self.ball_angle(j) - shift;
        place.spin = [spin + shift, speed];
        (self.work.damage[j], place)
    }
}
