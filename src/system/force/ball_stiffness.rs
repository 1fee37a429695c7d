//! The spring that a ball meets between its contacts.

use super::super::bearing_setup::{BallsInertia, Formulation};
use super::super::coupled::CoupledSystem;
use super::super::lanes::{self, LANES};

impl CoupledSystem {
    /// Stiffness of both contacts over a ball's mass, 1/s^2, as [`own_stiffness_into`] says: `3/2 F / delta` of each, the outer
    /// one in series with what the race gives way to the ball alone. Zero of all else: modes and shaft weigh far more.
    ///
    /// [`own_stiffness_into`]: crate::dynamics::SecondOrderSystem::own_stiffness_into
    #[inline(always)]
    pub(super) fn ball_stiffness_into(&self, stiffness: &mut [f64]) {
        let (others, balls) = stiffness.split_at_mut((self.modes + 2).min(stiffness.len()));
        others.fill(0.0);
        if self.setup.balls_inertia == BallsInertia::QuasiStatic
            || self.setup.formulation == Formulation::Printed
        {
            balls.fill(0.0);
            return;
        }
        for (group, out) in self.balls.groups.iter().zip(balls.chunks_mut(LANES)) {
            let (gap, displaced, own) = (&group.gap, &group.displaced, &group.own);
            let (outer, inner) = (&group.outer_magnitude, &group.inner_force);
            let values = lanes::each(|l| {
                let outer = tangent(outer[l], gap[l] - displaced[l]);
                let outer = outer / (1.0 + own[l] * outer);
                self.ball_mobility * (outer + tangent(inner[l], group.penetration[l]))
            });
            lanes::put(&values, out);
        }
    }
}

/// Derivative of a Hertzian force (N) by the overlap (m), N/m; zero where there is no overlap with the plain race.
#[inline(always)]
fn tangent(force: f64, overlap: f64) -> f64 {
    if overlap > 0.0 {
        1.5 * force / overlap
    } else {
        0.0
    }
}
