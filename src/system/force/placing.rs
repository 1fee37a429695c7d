//! Where the balls are, and what they may feel there.

use super::super::coupled::CoupledSystem;
use super::super::race::Damage;
use super::super::raceway::reduced_turn;
use super::super::turning::directions;
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, Lanes};

impl CoupledSystem {
    /// Directions of the shaft and of all balls, and the balls' places: one sine and cosine, the others by rotation through
    /// the fixed spacing.
    #[inline(always)]
    pub(super) fn place_balls<const B: usize>(
        &mut self,
        shaft: &RotationState,
        cage: &RotationState,
    ) {
        self.work.cage_angle = cage.angle;
        let turn = reduced_turn(self.setup.cage.ball_angle(cage.angle, 0));
        let [[cos, sin], shaft] = directions([turn, reduced_turn(shaft.angle)]);
        self.work.shaft_direction = shaft;
        for group in lanes::first_mut::<B, _>(&mut self.balls.groups) {
            let [c, s] = &group.spacing;
            group.direction = [
                lanes::each(|l| cos * c[l] - sin * s[l]),
                lanes::each(|l| sin * c[l] + cos * s[l]),
            ];
            let place = lanes::each(|l| turn + group.spacing_turns[l]);
            group.turn = lanes::each(|l| {
                if place[l] < 1.0 {
                    place[l]
                } else {
                    place[l] - 1.0
                }
            });
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

    /// Turns the balls' flats to where they are.
    #[inline(always)]
    pub(super) fn turn_flats(&mut self, shaft: &RotationState, cage: &RotationState) {
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
}
