//! Balls between the grooves of a bearing: what they meet at either race, and what that does to modes, inner ring and themselves.
//!
//! ```text
//! outer   d = (u_r - W, u_z - V)                      W, V: displacement of the groove's centre by the structure
//! inner   p = R^T (b - c),  d = (|p_xy| - rho_i, p_z - z_0)
//! ```

use super::balls::{BallGroup, BearingBalls};
use super::damage::Touch;
use super::force::InnerRing;
use super::groove_lanes::Felt;
use super::system::Work;
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, LANES, Lanes, each, positive, total};
use crate::system::raceway::{Place, RacewayTable, reduced_turn};
use crate::system::turning::directions;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Sums over a bearing's balls: force on the inner ring along x, y, z, and moment about its centre.
type OnRing = [f64; 6];

impl BearingBalls {
    /// Takes the balls' coordinates and velocities, and places the balls.
    #[inline(always)]
    pub(super) fn take(&mut self, y: &[f64], v: &[f64], angle: f64, cage_speed: f64) {
        self.cage_speed = cage_speed;
        self.turn = reduced_turn(angle);
        let (turn, count) = (self.turn, self.count);
        let [[cos, sin], _] = directions([turn, 0.0]);
        let both = |values: &[f64], group: usize| {
            let start = group * LANES;
            let end = (start + LANES).min(count);
            [lanes::from(&values[start..end]), lanes::from(&values[count + start..count + end])]
        };
        for (number, group) in self.groups.iter_mut().enumerate() {
            group.place = both(y, number);
            group.rate = both(v, number);
            let [c, s] = &group.spacing;
            group.direction = [each(|l| cos * c[l] - sin * s[l]), each(|l| sin * c[l] + cos * s[l])];
            let place = each(|l| turn + group.spacing_turns[l]);
            group.turn = each(|l| if place[l] < 1.0 { place[l] } else { place[l] - 1.0 });
        }
    }

    /// Contacts with the outer race, which the kept modes move.
    #[inline(always)]
    pub(super) fn meet_outer(&mut self, work: &mut Work, damped: bool) {
        let Self { groups, rows, outer, count, cage_speed, .. } = self;
        for (number, group) in groups.iter_mut().enumerate() {
            let places = [rows[0].locate(&group.turn), rows[1].locate(&group.turn)];
            let balls = LANES.min(*count - number * LANES);
            for (component, table) in rows.iter().enumerate() {
                for lane in 0..balls {
                    let own = group.rows[component].iter_mut().map(|rows| &mut rows[lane]);
                    group.moved[component][lane] =
                        table.values_into(places[component].get(lane), &work.amplitudes, own);
                }
            }
            let (place, moved) = (&group.place, &group.moved);
            let d = [each(|l| place[0][l] - moved[0][l]), each(|l| place[1][l] - moved[1][l])];
            group.outer = outer.felt([&d[0], &d[1]], &group.oversize);
            group.loads[1] = group.outer.load;
            group.on_outer = group.outer.gradient;
            if damped {
                let mut race = [[0.0; LANES]; 2];
                let scale = *cage_speed / TAU;
                for (component, (table, race)) in rows.iter().zip(&mut race).enumerate() {
                    for (lane, race) in race.iter_mut().enumerate().take(balls) {
                        let at = places[component].get(lane);
                        *race = velocity(table, at, scale, work, lane, &group.rows[component]);
                    }
                }
                let normal = group.outer.normal;
                group.approach[1] = each(|l| {
                    normal[0][l] * (group.rate[0][l] - race[0][l]) + normal[1][l] * (group.rate[1][l] - race[1][l])
                });
                let (felt, approach) = (&group.outer, &group.approach[1]);
                let damping = damped_part(felt.load, approach, outer.damping);
                group.loads[1] = each(|l| felt.load[l] + damping[l]);
                group.on_outer = along_normal(felt, &damping);
            }
        }
        if self.damage[1].is_some() {
            self.meet_outer_defects(work);
        }
        // friction of the gyroscopic moment, (n_z, -n_r) on the ball
        let factor = self.gyroscopic * self.cage_speed * self.cage_speed * self.friction[1];
        if factor != 0.0 {
            for group in &mut self.groups {
                let normal = group.outer.normal;
                let friction = each(|l| if group.outer.penetration[l] > 0.0 { factor * normal[1][l] } else { 0.0 });
                group.on_outer[0] = each(|l| group.on_outer[0][l] - friction[l] * normal[1][l]);
                group.on_outer[1] = each(|l| group.on_outer[1][l] + friction[l] * normal[0][l]);
            }
        }
    }

    /// What balls on defects of the outer race feel in the place of the whole one. The race moves a ball along the profile by its
    /// tangential displacement u: the azimuth on the race is that of the ball less u over the radius.
    #[inline(never)]
    fn meet_outer_defects(&mut self, work: &mut Work) {
        let Self { groups, rows, damage: [_, Some(damage)], tangential: Some(tangential), .. } = self else {
            return;
        };
        damage.met.clear();
        let (speed, count, per_radius) = (self.cage_speed, self.count, 1.0 / self.race_radius);
        for (number, group) in groups.iter_mut().enumerate() {
            let inside = damage.inside([&group.direction[0], &group.direction[1]]);
            for (lane, &inside) in inside.iter().enumerate().take(count - number * LANES) {
                // the opposite would leave out what is not a number
                if inside < 0.0 {
                    continue;
                }
                let race = [0, 1].map(|k| {
                    let at = rows[k].locate(&group.turn).get(lane);
                    velocity(&rows[k], at, speed / TAU, work, lane, &group.rows[k])
                });
                let at = tangential.locate(&group.turn).get(lane);
                tangential.slopes_into(at, speed / TAU, &mut work.scratch_row);
                let driven = speed - per_radius * lanes::dot(work.scratch_row.iter(), &work.amplitudes);
                let row = &mut work.scratch_row;
                let shift = tangential.values_into(at, &work.amplitudes, row.iter_mut());
                let moved = lanes::dot(row.iter(), &work.velocities);
                let [radial, axial] = [0, 1].map(|k| group.rate[k][lane] - race[k]);
                let place = Touch {
                    d: [0, 1].map(|k| group.place[k][lane] - group.moved[k][lane]).into(),
                    azimuth: TAU * group.turn[lane] - per_radius * shift,
                    rates: Vector3::new(radial, axial, driven - per_radius * moved),
                    driven,
                };
                if let Some(met) = damage.meet(number * LANES + lane, lane, place, &mut group.outer) {
                    let force = met.gradient();
                    (group.approach[1][lane], group.loads[1][lane]) = (met.approach, met.state.load + met.damped);
                    (group.on_outer[0][lane], group.on_outer[1][lane]) = (force.x, force.y);
                    lanes::add_scaled(&mut work.modal_force, per_radius * force.z, &work.scratch_row);
                }
            }
        }
    }

    /// Contacts with the inner race: what they do to the ring.
    #[inline(always)]
    pub(super) fn meet_inner(&mut self, ring: &InnerRing, shaft: &RotationState, [c, s]: [f64; 2]) -> OnRing {
        let r = &ring.rotation;
        let [cx, cy, cz] = [ring.centre.x, ring.centre.y, ring.centre.z];
        let [base, gap, damping, speed] = [self.base, self.gap[0], self.inner.damping, self.cage_speed];
        let friction = self.gyroscopic * speed * speed * self.friction[0];
        let mut sums = [[0.0; LANES]; 6];
        let damage = &mut self.damage[0];
        if let Some(damage) = damage {
            damage.met.clear();
        }
        for (number, group) in self.groups.iter_mut().enumerate() {
            let ([cos, sin], [radial, axial]) = (&group.direction, &group.place);
            let rho = each(|l| base + radial[l]);
            let b = [each(|l| rho[l] * cos[l] - cx), each(|l| rho[l] * sin[l] - cy), each(|l| axial[l] - cz)];
            // p = R^T b
            let p = turned_back(r, &b);
            let across = each(|l| (p[0][l] * p[0][l] + p[1][l] * p[1][l]).sqrt());
            let inverse = each(|l| 1.0 / across[l]);
            // |p| - rho without the difference of large numbers: |p|^2 - base^2 over their sum would gain nothing beside sqrt
            let d = [each(|l| (across[l] - base) - gap), each(|l| p[2][l] - self.gap[1])];
            group.inner = self.inner.felt([&d[0], &d[1]], &group.oversize);
            let felt = group.inner;
            group.loads[0] = felt.load;
            let mut gradient = felt.gradient;
            let out = [each(|l| p[0][l] * inverse[l]), each(|l| p[1][l] * inverse[l])];
            // force around the ring's axis, N
            let mut around = [0.0; LANES];
            if damping > 0.0 || damage.is_some() {
                let moved = turned_back(r, &inner_rates(group, ring, speed, &rho, &b));
                group.approach[0] = each(|l| {
                    felt.normal[0][l] * (out[0][l] * moved[0][l] + out[1][l] * moved[1][l])
                        + felt.normal[1][l] * moved[2][l]
                });
                let part = damped_part(felt.load, &group.approach[0], damping);
                group.loads[0] = each(|l| felt.load[l] + part[l]);
                gradient = along_normal(&felt, &part);
                if let Some(damage) = damage {
                    // directions in the frame that turns with the shaft
                    let seen = [each(|l| out[0][l] * c + out[1][l] * s), each(|l| out[1][l] * c - out[0][l] * s)];
                    let inside = damage.inside([&seen[0], &seen[1]]);
                    for (lane, &inside) in inside.iter().enumerate().take(self.count - number * LANES) {
                        // the opposite would leave out what is not a number
                        if inside < 0.0 {
                            continue;
                        }
                        let [x, y, z] = [0, 1, 2].map(|k| moved[k][lane]);
                        let [e_x, e_y] = [0, 1].map(|k| out[k][lane]);
                        let turn = (e_x * y - e_y * x) * inverse[lane] - shaft.speed;
                        let place = Touch {
                            d: [d[0][lane], d[1][lane]].into(),
                            azimuth: seen[1][lane].atan2(seen[0][lane]),
                            rates: Vector3::new(e_x * x + e_y * y, z, turn),
                            driven: -shaft.speed,
                        };
                        if let Some(met) = damage.meet(number * LANES + lane, lane, place, &mut group.inner) {
                            let force = met.gradient();
                            (group.approach[0][lane], group.loads[0][lane]) =
                                (met.approach, met.state.load + met.damped);
                            (gradient[0][lane], gradient[1][lane]) = (force.x, force.y);
                            around[lane] = force.z * inverse[lane];
                        }
                    }
                }
            }
            if friction != 0.0 {
                // as at the outer race, with the sine of the outer angle: (-sin, cos) of the inner contact on the ball
                let sine = group.outer.normal[1];
                let own = each(|l| if felt.penetration[l] > 0.0 { friction * sine[l] } else { 0.0 });
                gradient[0] = each(|l| gradient[0][l] - own[l] * felt.normal[1][l]);
                gradient[1] = each(|l| gradient[1][l] + own[l] * felt.normal[0][l]);
            }
            let in_ring = [
                each(|l| around[l] * out[1][l] - gradient[0][l] * out[0][l]),
                each(|l| -around[l] * out[0][l] - gradient[0][l] * out[1][l]),
                each(|l| -gradient[1][l]),
            ];
            let force = turned(r, &in_ring);
            let [x, y, z] = &force;
            let [b_x, b_y, b_z] = &b;
            let moment = [
                each(|l| b_y[l] * z[l] - b_z[l] * y[l]),
                each(|l| b_z[l] * x[l] - b_x[l] * z[l]),
                each(|l| b_x[l] * y[l] - b_y[l] * x[l]),
            ];
            for (sum, part) in sums.iter_mut().zip([x, y, z, &moment[0], &moment[1], &moment[2]]) {
                *sum = each(|l| sum[l] - part[l]);
            }
            group.from_inner = force;
        }
        let [a, b, c, d, e, f] = &sums;
        [total(a), total(b), total(c), total(d), total(e), total(f)]
    }

    /// What the outer contacts do to the kept modes.
    #[inline(always)]
    pub(super) fn add_to_modes(&self, work: &mut Work) {
        for group in &self.groups {
            for (forces, rows) in group.on_outer.iter().zip(&group.rows) {
                if forces.iter().all(|&force| force == 0.0) {
                    continue;
                }
                for (force, [a, b, c, d]) in work.modal_force.iter_mut().zip(rows) {
                    *force = each(|l| {
                        (force[l] + (forces[0] * a[l] + forces[1] * b[l])) + (forces[2] * c[l] + forces[3] * d[l])
                    });
                }
            }
        }
    }

    /// Contacts, weight and centrifugal load on the balls.
    #[inline(always)]
    pub(super) fn ball_forces(&self, [gx, gy, gz]: [f64; 3], cage: &RotationState, g: &mut [f64]) {
        let (mobility, square) = (self.mobility, cage.speed * cage.speed);
        let (radial, axial) = g.split_at_mut(self.count);
        let out = radial.chunks_mut(LANES).zip(axial.chunks_mut(LANES));
        for (group, (radial, axial)) in self.groups.iter().zip(out) {
            let [cos, sin] = &group.direction;
            let ([x, y, z], [outer_r, outer_z]) = (&group.from_inner, &group.on_outer);
            let force = each(|l| {
                let contacts = (x[l] * cos[l] + y[l] * sin[l]) - outer_r[l];
                (self.base + group.place[0][l]) * square + contacts * mobility + (gx * cos[l] + gy * sin[l])
            });
            lanes::put(&force, radial);
            lanes::put(&each(|l| (z[l] - outer_z[l]) * mobility + gz), axial);
        }
    }
}

// Closures over the components of vectors are written out in what follows: `map` of an array is a call that vector registers do not
// survive.

/// R^T x.
#[inline(always)]
fn turned_back(r: &Matrix3<f64>, x: &[Lanes; 3]) -> [Lanes; 3] {
    [
        each(|l| r[(0, 0)] * x[0][l] + r[(1, 0)] * x[1][l] + r[(2, 0)] * x[2][l]),
        each(|l| r[(0, 1)] * x[0][l] + r[(1, 1)] * x[1][l] + r[(2, 1)] * x[2][l]),
        each(|l| r[(0, 2)] * x[0][l] + r[(1, 2)] * x[1][l] + r[(2, 2)] * x[2][l]),
    ]
}

/// R x.
#[inline(always)]
fn turned(r: &Matrix3<f64>, x: &[Lanes; 3]) -> [Lanes; 3] {
    [
        each(|l| r[(0, 0)] * x[0][l] + r[(0, 1)] * x[1][l] + r[(0, 2)] * x[2][l]),
        each(|l| r[(1, 0)] * x[0][l] + r[(1, 1)] * x[1][l] + r[(1, 2)] * x[2][l]),
        each(|l| r[(2, 0)] * x[0][l] + r[(2, 1)] * x[1][l] + r[(2, 2)] * x[2][l]),
    ]
}

/// The elastic contact with a part that acts along its normal, N.
#[inline(always)]
fn along_normal(felt: &Felt, part: &Lanes) -> [Lanes; 2] {
    let (gradient, normal) = (&felt.gradient, &felt.normal);
    [each(|l| gradient[0][l] + part[l] * normal[0][l]), each(|l| gradient[1][l] + part[l] * normal[1][l])]
}

/// Velocity of a component under the ball in a lane, which moves along at so many turns a second, m/s.
#[inline(always)]
fn velocity(table: &RacewayTable, at: Place, speed: f64, work: &mut Work, lane: usize, rows: &[[Lanes; LANES]]) -> f64 {
    let Work { amplitudes, velocities, scratch_row, .. } = work;
    table.slopes_into(at, speed, scratch_row);
    lanes::dot(rows.iter().map(|rows| &rows[lane]), velocities) + lanes::dot(scratch_row.iter(), amplitudes)
}

/// Hunt-Crossley's part of a contact force, never so large that it pulls, N.
#[inline(always)]
fn damped_part(load: Lanes, approach: &Lanes, damping: f64) -> Lanes {
    each(|l| load[l] * (positive(1.0 + damping * approach[l]) - 1.0))
}

/// Velocity of the balls against the inner ring's material points there, its spin left out, m/s.
#[inline(always)]
fn inner_rates(group: &BallGroup, ring: &InnerRing, speed: f64, rho: &Lanes, b: &[Lanes; 3]) -> [Lanes; 3] {
    let ([cos, sin], [radial, axial]) = (&group.direction, &group.rate);
    let (v, w) = (&ring.velocity, &ring.turning);
    [
        each(|l| radial[l] * cos[l] - rho[l] * speed * sin[l] - v.x - (w.y * b[2][l] - w.z * b[1][l])),
        each(|l| radial[l] * sin[l] + rho[l] * speed * cos[l] - v.y - (w.z * b[0][l] - w.x * b[2][l])),
        each(|l| axial[l] - v.z - (w.x * b[1][l] - w.y * b[0][l])),
    ]
}
