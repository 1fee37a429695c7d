//! Where everything is that a force depends on: coordinates side by side, the ring's centre, the balls and what they may feel.

use super::super::race::Damage;
use super::super::raceway::reduced_turn;
use super::super::turning::directions;
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, LANES, Lanes, scalar_product};
use crate::system::{BallsInertia, CoupledSystem, Formulation};

/// Motion of the ring's mean centre, from which `printed` measures; at rest in `consistent`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CentreMotion {
    pub position: [f64; 2],
    pub velocity: [f64; 2],
    pub acceleration: [f64; 2],
}

impl CoupledSystem {
    /// Copies coordinates and velocities to where they stand side by side.
    #[inline(always)]
    pub(super) fn take<const B: usize, const M: usize>(&mut self, y: &[f64], v: &[f64]) {
        let (modes, work) = (self.modes, &mut self.work);
        lanes::set(lanes::first_mut::<M, _>(&mut work.amplitudes), &y[..modes]);
        let moving = self.setup.contact_damping > 0.0 || self.outer.irregular;
        if moving {
            lanes::set(lanes::first_mut::<M, _>(&mut work.velocities), &v[..modes]);
        }
        let groups = lanes::first_mut::<B, _>(&mut self.balls.groups);
        if self.setup.balls_inertia == BallsInertia::QuasiStatic {
            for group in groups {
                group.displacement = [0.0; LANES];
            }
            return;
        }
        let displacements = y[modes + 2..].chunks(LANES);
        for (group, displacements) in groups.iter_mut().zip(displacements) {
            group.displacement = lanes::from(displacements);
        }
        if moving {
            for (group, rates) in groups.iter_mut().zip(v[modes + 2..].chunks(LANES)) {
                group.displacement_rate = lanes::from(rates);
            }
        }
    }

    #[inline(always)]
    pub(super) fn centre_motion(&self, y: &[f64], v: &[f64], g: &[f64]) -> CentreMotion {
        match self.setup.formulation {
            Formulation::Consistent => CentreMotion::default(),
            Formulation::Printed => self.printed_centre(y, v, g),
        }
    }

    fn printed_centre(&self, y: &[f64], v: &[f64], g: &[f64]) -> CentreMotion {
        let modes = self.modes;
        let mut motion = CentreMotion::default();
        for k in 0..2 {
            let row = &self.centre[k];
            motion.position[k] = scalar_product(row, &y[..modes]);
            motion.velocity[k] = scalar_product(row, &v[..modes]);
            motion.acceleration[k] = (0..modes)
                .map(|i| {
                    let linear = self.linear[i];
                    let pull = linear.damping * v[i] + linear.squared_frequency * y[i];
                    row[i] * (g[i] - pull)
                })
                .sum();
        }
        motion
    }

    /// Directions of the shaft and of all balls, and the balls' places: one sine and cosine, the others by rotation through
    /// the fixed spacing.
    #[inline(always)]
    pub(super) fn place_balls<const B: usize>(&mut self, shaft: &RotationState, cage: &RotationState) {
        self.work.cage_angle = cage.angle;
        self.work.cage_speed = cage.speed;
        let turn = reduced_turn(self.setup.cage.ball_angle(cage.angle, 0));
        let [[cos, sin], direction] = directions([turn, reduced_turn(shaft.angle)]);
        self.work.shaft_direction = direction;
        for group in lanes::first_mut::<B, _>(&mut self.balls.groups) {
            let [c, s] = &group.spacing;
            group.direction = [lanes::each(|l| cos * c[l] - sin * s[l]), lanes::each(|l| sin * c[l] + cos * s[l])];
            let place = lanes::each(|l| turn + group.spacing_turns[l]);
            group.turn = lanes::each(|l| if place[l] < 1.0 { place[l] } else { place[l] - 1.0 });
        }
        // and the balls' flats
        if self.setup.flats.is_empty() {
            return;
        }
        for j in 0..self.balls.count {
            if let Some((_, angle)) = self.setup.spin(j, shaft.angle) {
                let speed = cage.speed - self.setup.geometry.orders().ball_spin * shaft.speed;
                self.work.spin[j] = [angle, speed];
            }
        }
    }

    /// Angle of a ball, rad, not reduced.
    #[inline]
    pub(in super::super) fn ball_angle(&self, j: usize) -> f64 {
        self.setup.cage.ball_angle(self.work.cage_angle, j as u32)
    }

    /// What the balls that are near may feel at the outer race: a defect of the race before a flat of their own.
    #[inline(always)]
    pub(super) fn find_damage(&mut self) {
        while let Some(ball) = self.work.damaged.pop() {
            self.work.damage[ball] = Damage::None;
        }
        for number in 0..self.balls.groups.len() {
            for defect in 0..self.outer.defects() {
                let [cos, sin] = &self.balls.groups[number].direction;
                let inside = self.outer.inside(defect, [cos, sin]);
                if inside.iter().any(|&inside| inside >= 0.0) {
                    self.damage_in_group(number, &inside, defect);
                }
            }
        }
        for number in 0..self.setup.flats.len() {
            let ball = self.setup.flats[number].ball;
            if self.outer.feels(number, self.work.spin[ball][0]) {
                self.damage_near(ball, Damage::Flat(number));
            }
        }
    }

    #[inline(never)]
    fn damage_in_group(&mut self, number: usize, inside: &Lanes, defect: usize) {
        for (lane, &inside) in inside.iter().enumerate() {
            let ball = number * lanes::LANES + lane;
            if inside >= 0.0 && ball < self.balls.count {
                self.damage_near(ball, Damage::Race(defect));
            }
        }
    }

    /// Lets a ball feel this if it is near and feels nothing else.
    fn damage_near(&mut self, ball: usize, damage: Damage) {
        if self.is_near(ball) && self.work.damage[ball] == Damage::None {
            self.work.damage[ball] = damage;
            self.work.damaged.push(ball);
        }
    }
}
