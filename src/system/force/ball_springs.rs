//! The spring that a ball meets between its contacts.

use crate::numerics::lanes::{self, LANES, together};
use crate::system::{BallsInertia, CoupledSystem, Formulation};
use multiversion::multiversion;

/// What [`own_springs_into`] says. Of a ball: the stiffness of both contacts over its mass, `3/2 F / delta` of each, the outer one
/// in series with what the race gives way to the ball alone; and the sum of both forces over its mass. Of the shaft: no spring,
/// for it weighs far more, and the sum of the balls' forces on it over its mass. Of modes: no spring, what holds them is no part of
/// their force, and the sum of what weight and balls do to them.
///
/// [`own_springs_into`]: crate::numerics::ode::SecondOrderSystem::own_springs_into
#[multiversion(targets("x86_64+avx2", "aarch64+neon"), dispatcher = "direct")]
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
                    (sum[l] + (radial[0] * a[l]).abs() + (radial[1] * b[l]).abs())
                        + ((radial[2] * c[l]).abs() + (radial[3] * d[l]).abs())
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
