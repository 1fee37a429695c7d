//! The force on modes, shaft and balls at a state.
//!
//! The spring that a ball meets between its contacts.

use super::placing::CentreMotion;
use crate::bearing::RotationState;
use crate::numerics::lanes;
use crate::numerics::lanes::{LANES, Lanes, fused, together};
use crate::numerics::ode::{Divergence, LinearCoordinate, SecondOrderSystem, Tangent, all_finite};
use crate::system::{BallsInertia, CoupledSystem, Formulation};
use multiversion::multiversion;

impl SecondOrderSystem for CoupledSystem {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        evaluate(self, t, y, v, g);
    }

    fn tangent_into(&mut self, t: f64, y: &[f64], v: &[f64], tangent: &mut Tangent) {
        let mut g = std::mem::take(&mut self.work.force);
        g.resize(y.len(), 0.0);
        self.force_and_tangent_into(t, y, v, &mut g, tangent);
        self.work.force = g;
    }

    fn force_and_tangent_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64], tangent: &mut Tangent) {
        evaluate(self, t, y, v, g);
        self.add_tangent(t, [y, v, g], tangent);
    }

    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        find_own_springs(self, springs, sizes);
    }

    fn next_change(&self, t: f64) -> f64 {
        let loads = self.setup.shaft.loads.iter();
        let knots = loads.map(|load| load.next_knot(t));
        knots.fold(self.setup.cage.rotation.next_knot(t), f64::min)
    }

    fn events(&self) -> usize {
        match self.setup.balls_inertia {
            BallsInertia::Dynamic => 2 * self.balls.count,
            BallsInertia::QuasiStatic => 0,
        }
    }

    fn events_into(&mut self, t: f64, y: &[f64], v: &[f64], events: &mut [f64]) {
        self.contact_events_into(t, y, v, events);
    }

    fn check(&self, y: &[f64], v: &[f64]) -> Result<(), Divergence> {
        if !(all_finite(y) && all_finite(v)) {
            return Err(Divergence::NotFinite);
        }
        // beyond half a ball radius neither Hertz theory nor the geometry holds
        let limit = 0.5 * self.setup.geometry.ball_radius();
        let positions = &y[self.modes..];
        let beyond = |value: &f64| value.abs() > limit;
        // all at once, as in nearly every call none is
        if !positions.iter().fold(false, |any, value| any | beyond(value)) {
            return Ok(());
        }
        let Some(place) = positions.iter().position(beyond) else {
            return Ok(());
        };
        let what = match place {
            0 => "shaft displacement x".to_owned(),
            1 => "shaft displacement y".to_owned(),
            ball => format!("radial displacement of ball {}", ball - 1),
        };
        Err(Divergence::OutOfRange { what, value: positions[place], limit, unit: "m" })
    }
}

/// [`SecondOrderSystem::force_into`] with the vector registers that the machine has; products are fused where it is written and nowhere
/// else, so that neither their width nor the machine changes a result.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
fn evaluate(system: &mut CoupledSystem, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
    // five to twelve balls and up to twelve modes without loops over their groups
    match (system.balls.groups.len(), system.work.amplitudes.len()) {
        (2, 1) => evaluate_sized::<2, 1>(system, t, y, v, g),
        (2, 2) => evaluate_sized::<2, 2>(system, t, y, v, g),
        (2, 3) => evaluate_sized::<2, 3>(system, t, y, v, g),
        (3, 2) => evaluate_sized::<3, 2>(system, t, y, v, g),
        (3, 3) => evaluate_sized::<3, 3>(system, t, y, v, g),
        _ => evaluate_sized::<0, 0>(system, t, y, v, g),
    }
}

/// The same for so many groups of balls and of modes, for any number where that is zero.
#[inline(always)]
fn evaluate_sized<const B: usize, const M: usize>(
    system: &mut CoupledSystem,
    t: f64,
    y: &[f64],
    v: &[f64],
    g: &mut [f64],
) {
    let shaft = system.setup.cage.shaft();
    let shaft = shaft.rotation.at_from(&mut system.cursors[0], t);
    let cage = system.setup.cage.rotation.at_from(&mut system.cursors[1], t);
    system.take::<B, M>(y, v);
    system.place_balls::<B>(&shaft, &cage);
    system.approach_outer_race::<B, M>();
    let inertia = system.setup.balls_inertia;
    match (inertia, &system.residual) {
        (BallsInertia::QuasiStatic, _) => {
            let centre = [y[system.modes], y[system.modes + 1]];
            system.settle_balls(centre, &shaft, &cage);
        }
        (BallsInertia::Dynamic, Some(_)) => system.outer_forces_with_residual::<B>(),
        (BallsInertia::Dynamic, None) => system.outer_forces::<B>(),
    }
    system.structure_force::<B, M>(g);
    let centre = system.centre_motion(y, v, g);
    system.inner_forces::<B>(&centre, &shaft, y, v);
    system.shaft_force(t, &shaft, g);
    if inertia == BallsInertia::Dynamic {
        system.ball_forces::<B>(&centre, &cage, g);
    }
}

impl CoupledSystem {
    /// Weight and contact forces on the kept modes.
    #[inline(always)]
    fn structure_force<const B: usize, const M: usize>(&mut self, g: &mut [f64]) {
        let forces = lanes::first_mut::<M, _>(&mut self.work.modal_force);
        for (force, gravity) in forces.iter_mut().zip(lanes::first::<M, _>(&self.gravity)) {
            *force = *gravity;
        }
        for group in lanes::first::<B, _>(&self.balls.groups) {
            let radial = &group.outer_radial;
            if radial.iter().all(|&radial| radial == 0.0) {
                continue;
            }
            let rows = lanes::first::<M, _>(&group.rows);
            for (force, [a, b, c, d]) in forces.iter_mut().zip(rows) {
                *force = lanes::each(|l| {
                    fused(radial[1], b[l], fused(radial[0], a[l], force[l])) + fused(radial[3], d[l], radial[2] * c[l])
                });
            }
        }
        if self.outer.irregular {
            self.tangential_structure_force();
        }
        let forces = lanes::first::<M, _>(&self.work.modal_force);
        lanes::get(forces, &mut g[..self.modes]);
    }

    #[inline(always)]
    fn tangential_structure_force(&mut self) {
        for number in 0..self.balls.groups.len() {
            let forces = self.balls.groups[number].outer_tangential;
            if forces.iter().all(|&force| force == 0.0) {
                continue;
            }
            for (lane, force) in forces.into_iter().enumerate() {
                if force != 0.0 {
                    let at = self.tangential_place(number * LANES + lane);
                    let (work, row) = (&mut self.work.modal_force, &mut self.work.scratch_row);
                    self.tangential.values_into(at, &self.work.amplitudes, row.iter_mut());
                    lanes::add_scaled(work, force, row);
                }
            }
        }
    }

    /// Loads, unbalance and inner contacts on the shaft.
    #[inline(always)]
    fn shaft_force(&mut self, t: f64, shaft: &RotationState, g: &mut [f64]) {
        let mut total = self.setup.shaft_load(t);
        let contacts = &self.work.on_shaft;
        for (total, contact) in total.iter_mut().zip(contacts) {
            *total += contact;
        }
        let unbalance = self.setup.shaft.unbalance;
        if unbalance != 0.0 {
            let [cos, sin] = self.work.shaft_direction;
            let (centrifugal, tangential) = (unbalance * shaft.speed * shaft.speed, unbalance * shaft.acceleration);
            total[0] += centrifugal * cos + tangential * sin;
            total[1] += centrifugal * sin - tangential * cos;
        }
        if let [x, y, ..] = &mut g[self.modes..] {
            *x = total[0] * self.shaft_mobility;
            *y = total[1] * self.shaft_mobility;
        }
    }

    /// Contacts, weight and centrifugal load on the balls.
    #[inline(always)]
    fn ball_forces<const B: usize>(&mut self, centre: &CentreMotion, cage: &RotationState, g: &mut [f64]) {
        let gravity = self.setup.gravity;
        let frame = [0, 1].map(|k| gravity[k] - centre.acceleration[k]);
        let softness = self.ball_mobility;
        let (touching, square) = (self.inner_race.touching_radius, cage.speed * cage.speed);
        let forces = g[self.modes + 2..].chunks_mut(LANES);
        let groups = lanes::first::<B, _>(&self.balls.groups);
        for (group, out) in groups.iter().zip(forces) {
            let [cos, sin] = &group.direction;
            let ([x, y], s) = (&group.on_inner, &group.displacement);
            let outer = &group.outer_radial;
            let force = lanes::each(|l| {
                let inner = -(x[l] * cos[l] + y[l] * sin[l]);
                (touching + s[l]) * square + (inner - outer[l]) * softness + (cos[l] * frame[0] + sin[l] * frame[1])
            });
            lanes::put(&force, out);
        }
    }
}

/// What [`own_springs_into`] says. Of a ball: the stiffness of both contacts over its mass, `3/2 F / delta` of each, the outer one
/// in series with what the race gives way to the ball alone; and the sum of both forces over its mass. Of the shaft: no spring,
/// for it weighs far more, and the sum of the balls' forces on it over its mass. Of modes: no spring, what holds them is no part of
/// their force, and the sum of what weight and balls do to them.
///
/// [`own_springs_into`]: crate::numerics::ode::SecondOrderSystem::own_springs_into
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
pub(super) fn find_own_springs(system: &CoupledSystem, springs: &mut [f64], sizes: &mut [f64]) {
    let balls = (system.modes + 2).min(springs.len());
    springs[..balls].fill(0.0);
    mode_sizes(system, &mut sizes[..system.modes]);
    sizes[system.modes..balls].fill(0.0);
    if system.setup.balls_inertia == BallsInertia::QuasiStatic || system.setup.formulation == Formulation::Printed {
        springs[balls..].fill(0.0);
        sizes[balls..].fill(0.0);
        return;
    }
    let mut on_shaft = [0.0; LANES];
    let out = springs[balls..].chunks_mut(LANES);
    let out = out.zip(sizes[balls..].chunks_mut(LANES));
    for (group, (springs, sizes)) in system.balls.groups.iter().zip(out) {
        let (gap, displaced, own) = (&group.gap, &group.displaced, &group.own);
        let (outer, inner) = (&group.outer_magnitude, &group.inner_force);
        let stiffness = lanes::each(|l| {
            let outer = tangent(outer[l], gap[l] - displaced[l]);
            let outer = outer / (1.0 + own[l] * outer);
            system.ball_mobility * (outer + tangent(inner[l], group.inner.penetration[l]))
        });
        lanes::put(&together(stiffness), springs);
        let both = lanes::each(|l| system.ball_mobility * (outer[l] + inner[l]));
        lanes::put(&together(both), sizes);
        on_shaft = lanes::each(|l| on_shaft[l] + inner[l]);
    }
    let on_shaft = system.shaft_mobility * lanes::total(&on_shaft);
    sizes[system.modes..balls].fill(on_shaft);
}

/// Sums of the magnitudes of which the modal forces are the sum.
#[inline(always)]
fn mode_sizes(system: &CoupledSystem, sizes: &mut [f64]) {
    let of_weight = &system.gravity;
    for (number, (out, weight)) in sizes.chunks_mut(LANES).zip(of_weight).enumerate() {
        let mut sum = lanes::each(|l| weight[l].abs());
        for group in &system.balls.groups {
            let radial = &group.outer_radial;
            if radial.iter().any(|&radial| radial != 0.0) {
                let [a, b, c, d] = &group.rows[number];
                sum = lanes::each(|l| {
                    let part = |k: usize, row: &Lanes, more: f64| fused(radial[k].abs(), row[l].abs(), more);
                    part(1, b, part(0, a, sum[l])) + part(3, d, part(2, c, 0.0))
                });
            }
        }
        lanes::put(&together(sum), out);
    }
}

/// Derivative of a Hertzian force (N) by the overlap (m), N/m; zero where there is no overlap with the plain race.
#[inline(always)]
fn tangent(force: f64, overlap: f64) -> f64 {
    // no branch, so that the lanes stay together
    let overlap = if overlap > 0.0 { overlap } else { f64::INFINITY };
    1.5 * force / overlap
}
