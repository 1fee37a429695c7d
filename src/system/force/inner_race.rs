//! Contacts of the balls with the inner race.

use super::super::coupled::CoupledSystem;
use super::super::inner::InnerGap;
use super::super::race::{Damage, RacePlace};
use super::placing::CentreMotion;
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, LANES, Lanes, positive};

impl CoupledSystem {
    /// Inner forces: what they do to the shaft, and along the radius vectors to the balls.
    #[inline(always)]
    pub(super) fn inner_forces<const B: usize>(
        &mut self,
        centre: &CentreMotion,
        shaft: &RotationState,
        y: &[f64],
        v: &[f64],
    ) {
        let modes = self.modes;
        let relative = [0, 1].map(|k| y[modes + k] - centre.position[k]);
        let velocity = [0, 1].map(|k| v[modes + k] - centre.velocity[k]);
        let (law, rise, speed) = (self.inner.plain, self.inner.rise, self.work.cage_speed);
        for group in lanes::first_mut::<B, _>(&mut self.balls.groups) {
            let (s, [cos, sin]) = (&group.displacement, &group.direction);
            let oversize = &group.oversize;
            let bounds = self.inner_race.penetration_bounds([cos, sin], s, relative);
            let bounds = lanes::each(|l| bounds[l] + oversize[l]);
            if bounds.iter().all(|&bound| bound <= -rise) {
                group.inner.penetration = bounds;
                group.inner_force = [0.0; LANES];
                group.on_inner = [[0.0; LANES]; 2];
                continue;
            }
            let gap = self.inner_race.gaps([cos, sin], s, relative);
            let penetration = lanes::each(|l| gap.penetration[l] + oversize[l]);
            let mut force: Lanes = lanes::each(|l| {
                let overlap = positive(penetration[l]);
                law.stiffness * (overlap * overlap.sqrt())
            });
            let [n_x, n_y] = &gap.normal;
            if law.damping > 0.0 {
                let rate = &group.displacement_rate;
                force = lanes::each(|l| {
                    let turn = (self.inner_race.touching_radius + s[l]) * speed;
                    let moving = [
                        rate[l] * cos[l] - turn * sin[l] - velocity[0],
                        rate[l] * sin[l] + turn * cos[l] - velocity[1],
                    ];
                    let approach = -(n_x[l] * moving[0] + n_y[l] * moving[1]);
                    force[l] * positive(1.0 + law.damping * approach)
                });
            }
            group.on_inner = [lanes::each(|l| -force[l] * n_x[l]), lanes::each(|l| -force[l] * n_y[l])];
            group.inner = InnerGap { penetration, ..gap };
            group.inner_force = force;
        }
        if self.inner.irregular {
            self.irregular_inner_forces(velocity, shaft);
        }
        let mut sums = [[0.0; LANES]; 2];
        for group in lanes::first::<B, _>(&self.balls.groups) {
            let [x, y] = &group.on_inner;
            sums = [lanes::each(|l| sums[0][l] + x[l]), lanes::each(|l| sums[1][l] + y[l])];
        }
        self.work.on_shaft = [lanes::total(&sums[0]), lanes::total(&sums[1])];
    }

    /// The same for balls near a race that carries waves or defects, or that may meet a ball's flat.
    fn irregular_inner_forces(&mut self, velocity: [f64; 2], shaft: &RotationState) {
        let rise = self.inner.rise;
        for j in 0..self.balls.count {
            let gap = self.balls.inner_gap(j);
            if gap.penetration <= -rise {
                continue;
            }
            let rate = self.balls.get(j, |ball| &ball.displacement_rate);
            let moving = self.velocity_on_inner(j, &gap, rate, velocity);
            let (damage, place) = self.inner_place(j, &gap, moving, shaft);
            let force = self.inner.force(damage, &place);
            let n = gap.normal;
            let (group, lane) = (&mut self.balls.groups[j / LANES], j % LANES);
            group.inner_force[lane] = force.magnitude;
            group.on_inner[0][lane] = force.radial * n[0] - force.tangential * n[1];
            group.on_inner[1][lane] = force.radial * n[1] + force.tangential * n[0];
        }
    }

    /// Velocities of the centre of ball `j` towards the inner race's centre and across, m/s; of the ball along its radius vector
    /// `rate`, of the race `velocity`.
    pub(in super::super) fn velocity_on_inner(
        &self,
        j: usize,
        gap: &InnerGap,
        rate: f64,
        velocity: [f64; 2],
    ) -> [f64; 2] {
        let (n, e) = (gap.normal, self.balls.direction_of(j));
        let turn = self.radius(j) * self.work.cage_speed;
        let moving = [rate * e[0] - turn * e[1] - velocity[0], rate * e[1] + turn * e[0] - velocity[1]];
        [-(n[0] * moving[0] + n[1] * moving[1]), n[0] * moving[1] - n[1] * moving[0]]
    }

    /// What ball `j` feels at the inner race, and its place there, for velocities of the ball's centre towards the race's and
    /// across, m/s.
    pub(in super::super) fn inner_place(
        &self,
        j: usize,
        gap: &InnerGap,
        [rate, across]: [f64; 2],
        shaft: &RotationState,
    ) -> (Damage, RacePlace) {
        // a larger ball's centre is farther away than its penetration says
        let oversize = self.balls.get(j, |ball| &ball.oversize);
        let mut place = RacePlace {
            penetration: gap.penetration,
            rate,
            along: across * (1.0 - oversize / gap.distance),
            turning: shaft.speed,
            ..RacePlace::default()
        };
        let (e, n) = (self.balls.direction_of(j), gap.normal);
        let [cos, sin] = self.work.shaft_direction;
        let in_the_race = [n[0] * cos + n[1] * sin, n[1] * cos - n[0] * sin];
        let defect = self.inner.defect_at(in_the_race);
        let flat = self.balls.flat[j];
        if defect.is_none() && flat.is_none() && !self.inner.is_wavy() {
            return (Damage::None, place);
        }
        // from the radius vector about the bearing's centre to that about the shaft's
        let turned = (e[0] * n[1] - e[1] * n[0]).atan2(e[0] * n[0] + e[1] * n[1]);
        let [spin, speed] = self.work.spin[j];
        let flat = flat.filter(|&flat| self.inner.feels(flat, spin - turned));
        let damage = Damage::of(defect, flat);
        place.angle = self.ball_angle(j) + turned - shaft.angle;
        place.spin = [spin - turned, speed];
        (damage, place)
    }
}
