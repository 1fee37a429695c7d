//! The force on modes, shaft and balls at a state: all that is evaluated in every step. No allocation.
//!
//! ```text
//! shaft   Id a'' = M_a - Ip Omega b',  Id b'' = M_b + Ip Omega a'
//! ```
//!
//! The shaft's driving torque follows its axis, so that a change of speed tilts nothing.

use super::pose::Pose;
use super::setup::SHAFT;
use super::system::SpatialSystem;
use crate::bearing::RotationState;
use crate::numerics::lanes;
use crate::system::raceway::reduced_turn;
use crate::system::turning::directions;
use multiversion::multiversion;
use nalgebra::{Matrix3, Vector3};

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

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
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
