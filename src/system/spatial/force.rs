//! The force on modes, shaft and balls at a state: all that is evaluated in every step. No allocation.
//!
//! ```text
//! outer   d = (u_r - W, u_z - V)                      W, V: displacement of the groove's centre by the structure
//! inner   p = R^T (b - c),  d = (|p_xy| - rho_i, p_z - z_0)
//! shaft   Id a'' = M_a - Ip Omega b',  Id b'' = M_b + Ip Omega a'
//! ```
//!
//! The shaft's driving torque follows its axis, so that a change of speed tilts nothing.

use super::balls::{BallGroup, BearingBalls};
use super::damage::Touch;
use super::groove_lanes::Felt;
use super::pose::Pose;
use super::setup::SHAFT;
use super::springs::find_own_springs;
use super::system::{SpatialSystem, Work};
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, LANES, Lanes, each, positive, total};
use crate::numerics::ode::{Divergence, LinearCoordinate, SecondOrderSystem, Tangent, all_finite};
use crate::system::raceway::{Place, RacewayTable, reduced_turn};
use crate::system::turning::directions;
use multiversion::multiversion;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Sums over a bearing's balls: force on the inner ring along x, y, z, and moment about its centre.
type OnRing = [f64; 6];

/// Where a bearing's inner ring is and how it moves.
pub(super) struct InnerRing {
    /// m
    pub centre: Vector3<f64>,
    pub rotation: Matrix3<f64>,
    /// m/s
    pub velocity: Vector3<f64>,
    /// Of the tilt, rad/s.
    pub turning: Vector3<f64>,
    /// From the shaft's centre of mass, m.
    pub arm: Vector3<f64>,
}

impl InnerRing {
    /// At a place with an offset of the outer ring (m), for velocities of the shaft.
    #[inline(always)]
    pub(crate) fn new(pose: &Pose, [place, offset]: [f64; 2], v: &[f64]) -> Self {
        let [arm, moved] = pose.arm(place);
        let turning = pose.angular_velocity([v[3], v[4]]);
        let velocity = Vector3::new(v[0], v[1], v[2]) + turning.cross(&arm);
        let centre = pose.centre + moved - Vector3::new(0.0, 0.0, offset);
        Self { centre, rotation: pose.rotation, velocity, turning, arm }
    }
}

impl SecondOrderSystem for SpatialSystem {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        evaluate(self, t, y, v, g);
    }

    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        find_own_springs(self, springs, sizes);
    }

    fn events(&self) -> usize {
        2 * self.setup.balls()
    }

    /// The overlap of each ball with the outer and the inner race, m, bearing by bearing.
    fn events_into(&mut self, t: f64, y: &[f64], v: &[f64], events: &mut [f64]) {
        let mut force = std::mem::take(&mut self.work.force);
        force.resize(y.len(), 0.0);
        evaluate(self, t, y, v, &mut force);
        self.work.force = force;
        let overlaps = self.bearings.iter().flat_map(|bearing| {
            let outer = bearing.all(|ball| &ball.outer.penetration);
            outer.chain(bearing.all(|ball| &ball.inner.penetration))
        });
        for (event, overlap) in events.iter_mut().zip(overlaps) {
            *event = overlap;
        }
    }

    /// By differences, with four evaluations a coordinate: enough for limits of steps, slow for implicit methods.
    fn tangent_into(&mut self, t: f64, y: &[f64], v: &[f64], tangent: &mut Tangent) {
        let [by_place, by_speed] = self.derivatives(t, y, v);
        for (columns, of_speed) in [(by_place, false), (by_speed, true)] {
            for column in 0..y.len() {
                let term = tangent.add();
                term.left.copy_from_slice(columns.col_as_slice(column));
                let row = if of_speed { term.velocity } else { term.position };
                row[column] = 1.0;
            }
        }
        evaluate(self, t, y, v, &mut vec![0.0; y.len()]);
    }

    fn next_change(&self, t: f64) -> f64 {
        let loads = self.setup.shaft.loads.iter().map(|load| load.profile.next_knot(t));
        let cages = self.setup.bearings.iter().map(|bearing| bearing.cage.rotation.next_knot(t));
        loads.chain(cages).fold(f64::INFINITY, f64::min)
    }

    fn check(&self, y: &[f64], v: &[f64]) -> Result<(), Divergence> {
        if !(all_finite(y) && all_finite(v)) {
            return Err(Divergence::NotFinite);
        }
        // beyond half a ball's radius neither Hertz theory nor the geometry holds
        let balls = self.setup.bearings.iter().map(|own| 0.5 * own.bearing.geometry().ball_radius());
        let limit = balls.fold(f64::INFINITY, f64::min);
        let tilt = 0.1;
        for (place, (what, limit, unit)) in [
            ("shaft displacement x", limit, "m"),
            ("shaft displacement y", limit, "m"),
            ("shaft displacement z", limit, "m"),
            ("tilt of the shaft about x", tilt, "rad"),
            ("tilt of the shaft about y", tilt, "rad"),
        ]
        .into_iter()
        .enumerate()
        {
            let value = y[self.modes + place];
            if value.abs() > limit {
                return Err(Divergence::OutOfRange { what: what.to_owned(), value, limit, unit });
            }
        }
        for ((first, count), own) in self.ball_ranges().zip(&self.setup.bearings) {
            let places = y[first..first + 2 * count].iter();
            if let Some((place, &value)) = places.enumerate().find(|(_, value)| value.abs() > limit) {
                let way = if place < count { "radial" } else { "axial" };
                let what = format!("{way} place of ball {} of bearing {}", place % count + 1, own.label);
                return Err(Divergence::OutOfRange { what, value, limit, unit: "m" });
            }
        }
        Ok(())
    }
}

#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
pub(super) fn evaluate(system: &mut SpatialSystem, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
    let modes = system.modes;
    let shaft = system.setup.bearings[0].cage.shaft();
    let shaft = shaft.rotation.at_from(&mut system.shaft_cursor, t);
    let SpatialSystem { work, bearings, setup, gravity, .. } = system;
    let damaged = bearings.iter().any(|bearing| bearing.damage.iter().any(Option::is_some));
    let damped = damaged || setup.bearings.iter().any(|own| own.contact_damping > 0.0);
    work.shaft_direction = directions([reduced_turn(shaft.angle), 0.0])[0];
    lanes::set(&mut work.amplitudes, &y[..modes]);
    if damped {
        lanes::set(&mut work.velocities, &v[..modes]);
    }
    work.modal_force.copy_from_slice(gravity);
    let pose = Pose::new(&y[modes..]);
    let mut load = setup.shaft_load(&pose, t);
    let mut moment = Vector3::zeros();
    let mut first = modes + SHAFT;
    for (bearing, own) in bearings.iter_mut().zip(&setup.bearings) {
        let cage = own.cage.rotation.at_from(&mut bearing.cursor, t);
        let ring = InnerRing::new(&pose, [own.place, own.offset], &v[modes..]);
        let last = first + 2 * bearing.count;
        bearing.take(&y[first..last], &v[first..last], own.cage.ball_angle(cage.angle, 0), cage.speed);
        bearing.meet_outer(work, damped);
        let on_ring = bearing.meet_inner(&ring, &shaft, work.shaft_direction);
        bearing.add_to_modes(work);
        bearing.ball_forces(setup.gravity, &cage, &mut g[first..last]);
        let force = Vector3::new(on_ring[0], on_ring[1], on_ring[2]);
        moment += Vector3::new(on_ring[3], on_ring[4], on_ring[5]) + ring.arm.cross(&force);
        load[0] += force.x;
        load[1] += force.y;
        load[2] += force.z;
        first = last;
    }
    lanes::get(&work.modal_force, &mut g[..modes]);
    moment += system.add_unbalance(&shaft, &pose, &mut load);
    let of_contacts = pose.on_tilts(moment);
    let own = &system.setup.shaft;
    let (mass, transverse, spin) = (own.mass, own.transverse_inertia, own.polar_inertia * shaft.speed);
    let [a, b] = [v[modes + 3], v[modes + 4]];
    if let [x, y, z, p, q, ..] = &mut g[modes..] {
        *x = load[0] / mass;
        *y = load[1] / mass;
        *z = load[2] / mass;
        *p = (load[3] + of_contacts[0] - spin * b) / transverse;
        *q = (load[4] + of_contacts[1] + spin * a) / transverse;
    }
}

impl SpatialSystem {
    /// Rotating unbalances, centrifugal and by the shaft's angular acceleration; gives their moment, N m.
    #[inline(always)]
    fn add_unbalance(&self, shaft: &RotationState, pose: &Pose, load: &mut [f64; 5]) -> Vector3<f64> {
        let mut moment = Vector3::zeros();
        for unbalance in &self.setup.shaft.unbalances {
            let [x, y] = unbalance_force(unbalance, self.work.shaft_direction, shaft);
            load[0] += x;
            load[1] += y;
            moment += pose.arm(unbalance.place)[0].cross(&Vector3::new(x, y, 0.0));
        }
        moment
    }
}

/// Force of an unbalance along x and y when the shaft's angle has these cosine and sine, N.
#[inline(always)]
pub(super) fn unbalance_force(
    unbalance: &super::setup::Unbalance,
    [cos, sin]: [f64; 2],
    shaft: &RotationState,
) -> [f64; 2] {
    let (own_sin, own_cos) = unbalance.angle.sin_cos();
    let (c, s) = (cos * own_cos - sin * own_sin, sin * own_cos + cos * own_sin);
    let centrifugal = unbalance.moment * shaft.speed * shaft.speed;
    let tangential = unbalance.moment * shaft.acceleration;
    [centrifugal * c + tangential * s, centrifugal * s - tangential * c]
}

impl BearingBalls {
    /// Takes the balls' coordinates and velocities, and places the balls.
    #[inline(always)]
    fn take(&mut self, y: &[f64], v: &[f64], angle: f64, cage_speed: f64) {
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
    fn meet_outer(&mut self, work: &mut Work, damped: bool) {
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
    fn meet_inner(&mut self, ring: &InnerRing, shaft: &RotationState, [c, s]: [f64; 2]) -> OnRing {
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
    fn add_to_modes(&self, work: &mut Work) {
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
    fn ball_forces(&self, [gx, gy, gz]: [f64; 3], cage: &RotationState, g: &mut [f64]) {
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
