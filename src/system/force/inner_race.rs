//! Contacts of the balls with the inner race.

use super::super::coupled::CoupledSystem;
use super::super::inner::InnerGap;
use super::super::lanes::{self, Lanes, positive};
use super::super::race::{Damage, RaceForce, RacePlace};
use super::CentreMotion;
use crate::bearing::RotationState;

impl CoupledSystem {
    /// Inner forces: what they do to the shaft, and along the radius vectors to the balls.
    #[inline(always)]
    pub(super) fn inner_forces(
        &mut self,
        centre: &CentreMotion,
        shaft: &RotationState,
        cage: &RotationState,
        y: &[f64],
        v: &[f64],
    ) {
        let modes = self.modes;
        let relative = [0, 1].map(|k| y[modes + k] - centre.position[k]);
        let velocity = [0, 1].map(|k| v[modes + k] - centre.velocity[k]);
        let (law, work) = (self.inner.plain(), &mut self.work);
        let rise = self.inner.rise();
        for group in 0..work.displacement.len() {
            let (s, [cos, sin]) = (&work.displacement[group], &work.direction[group]);
            let oversize = &self.balls.oversize_lanes[group];
            let bounds = self.inner_race.penetration_bounds([cos, sin], s, relative);
            let bounds = lanes::each(|l| bounds[l] + oversize[l]);
            if bounds.iter().all(|&bound| bound <= -rise) {
                work.penetration[group] = bounds;
                work.inner_force[group] = [0.0; lanes::LANES];
                work.on_inner[group] = [[0.0; lanes::LANES]; 2];
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
                let rate = &work.displacement_rate[group];
                force = lanes::each(|l| {
                    let turn = (self.inner_race.touching_radius + s[l]) * cage.speed;
                    let moving = [
                        rate[l] * cos[l] - turn * sin[l] - velocity[0],
                        rate[l] * sin[l] + turn * cos[l] - velocity[1],
                    ];
                    let approach = -(n_x[l] * moving[0] + n_y[l] * moving[1]);
                    force[l] * positive(1.0 + law.damping * approach)
                });
            }
            let present = &self.balls.present[group];
            force = lanes::each(|l| present[l] * force[l]);
            work.penetration[group] = penetration;
            work.inner_distance[group] = gap.distance;
            work.inner_normal[group] = gap.normal;
            work.inner_force[group] = force;
            work.on_inner[group] = [
                lanes::each(|l| -force[l] * n_x[l]),
                lanes::each(|l| -force[l] * n_y[l]),
            ];
        }
        if self.inner.is_irregular() {
            self.irregular_inner_forces(velocity, shaft, cage);
        }
        self.sum_inner_forces();
    }

    /// Force on the shaft, and each ball's along its radius vector.
    #[inline(always)]
    fn sum_inner_forces(&mut self) {
        let work = &mut self.work;
        let mut sums = [[0.0; lanes::LANES]; 2];
        for group in 0..work.on_inner.len() {
            let ([x, y], [cos, sin]) = (&work.on_inner[group], &work.direction[group]);
            work.inner_along[group] = lanes::each(|l| -(x[l] * cos[l] + y[l] * sin[l]));
            sums = [
                lanes::each(|l| sums[0][l] + x[l]),
                lanes::each(|l| sums[1][l] + y[l]),
            ];
        }
        work.on_shaft = [lanes::total(&sums[0]), lanes::total(&sums[1])];
    }

    /// The same for balls near a race that carries waves or defects, or that may meet a ball's flat.
    fn irregular_inner_forces(
        &mut self,
        velocity: [f64; 2],
        shaft: &RotationState,
        cage: &RotationState,
    ) {
        let rise = self.inner.rise();
        for j in 0..self.balls.count {
            let gap = self.work.inner_gap(j);
            if gap.penetration <= -rise {
                continue;
            }
            let (n, e) = (gap.normal, self.work.direction_of(j));
            let rate = self.work.displacement_rate.as_flattened()[j];
            let turn = self.radius(j) * cage.speed;
            let moving = [
                rate * e[0] - turn * e[1] - velocity[0],
                rate * e[1] + turn * e[0] - velocity[1],
            ];
            let approach = -(n[0] * moving[0] + n[1] * moving[1]);
            let across = n[0] * moving[1] - n[1] * moving[0];
            let force = self.irregular_inner_force(j, &gap, [approach, across], shaft);
            let work = &mut self.work;
            let (group, lane) = (j / lanes::LANES, j % lanes::LANES);
            work.inner_force[group][lane] = force.magnitude;
            work.on_inner[group][0][lane] = force.radial * n[0] - force.tangential * n[1];
            work.on_inner[group][1][lane] = force.radial * n[1] + force.tangential * n[0];
        }
    }

    /// Force of ball `j` on such a race, for rates of the ball towards the race and along it, m/s.
    pub(super) fn irregular_inner_force(
        &self,
        j: usize,
        gap: &InnerGap,
        [rate, along]: [f64; 2],
        shaft: &RotationState,
    ) -> RaceForce {
        let (e, n) = (self.work.direction_of(j), gap.normal);
        let [cos, sin] = self.work.shaft_direction;
        let in_the_race = [n[0] * cos + n[1] * sin, n[1] * cos - n[0] * sin];
        let defect = self.inner.defect_at(in_the_race);
        let flat = self.balls.flat[j];
        if defect.is_none() && flat.is_none() && !self.inner.is_wavy() {
            return self.inner.plain_force(gap.penetration, rate);
        }
        // from the radius vector about the bearing's centre to that about the shaft's
        let turned = (e[0] * n[1] - e[1] * n[0]).atan2(e[0] * n[0] + e[1] * n[1]);
        let [spin, speed] = self.work.spin[j];
        let flat = flat.filter(|&flat| self.inner.feels(flat, spin - turned));
        let damage = match (defect, flat) {
            (Some(defect), _) => Damage::Race(defect),
            (None, Some(flat)) => Damage::Flat(flat),
            (None, None) => Damage::None,
        };
        let place = RacePlace {
            angle: self.ball_angle(j) + turned - shaft.angle,
            penetration: gap.penetration,
            rate,
            along,
            spin: [spin - turned, speed],
            turning: shaft.speed,
        };
        self.inner.force(damage, &place)
    }
}
