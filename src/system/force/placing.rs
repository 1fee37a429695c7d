//! Where the balls are, and what they may feel there.

use super::super::coupled::CoupledSystem;
use super::super::lanes;
use super::super::race::Damage;
use super::super::raceway::reduced_turn;
use super::super::turning::directions;
use crate::bearing::RotationState;

impl CoupledSystem {
    /// Directions of the shaft and of all balls, and the balls' places: one sine and cosine, the others by rotation through
    /// the fixed spacing.
    #[inline(always)]
    pub(super) fn place_balls(&mut self, shaft: &RotationState, cage: &RotationState) {
        let work = &mut self.work;
        work.cage_angle = cage.angle;
        let first = self.setup.cage.ball_angle(cage.angle, 0);
        let turn = reduced_turn(first);
        let [[cos, sin], shaft] = directions([turn, reduced_turn(shaft.angle)]);
        work.shaft_direction = shaft;
        for group in 0..work.direction.len() {
            let ([c, s], turns) = (&self.balls.spacing[group], &self.balls.turns[group]);
            work.direction[group] = [
                lanes::each(|l| cos * c[l] - sin * s[l]),
                lanes::each(|l| sin * c[l] + cos * s[l]),
            ];
            work.turn[group] = lanes::each(|l| {
                let place = turn + turns[l];
                if place < 1.0 { place } else { place - 1.0 }
            });
        }
    }

    /// Angle of a ball, rad, not reduced.
    #[inline]
    pub(super) fn ball_angle(&self, j: usize) -> f64 {
        self.setup.cage.ball_angle(self.work.cage_angle, j as u32)
    }

    /// What a ball may feel at the outer race: a defect of the race before a flat of its own.
    #[inline(always)]
    pub(super) fn damage_at_the_outer_race(&self, j: usize) -> Damage {
        let defect = self.outer.defect_at(self.work.direction_of(j));
        defect.map_or_else(
            || match self.balls.flat[j] {
                Some(flat) if self.outer.feels(flat, self.work.spin[j][0]) => Damage::Flat(flat),
                _ => Damage::None,
            },
            Damage::Race,
        )
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
