//! Where contacts begin and end: the overlap of each ball with each race, as events for methods that end their steps there.
//!
//! First the outer race's, then the inner race's, m. The overlap with the outer race is that which the ball would have without
//! its own residual displacement: of the same sign as that with it, for a contact begins at no force. For a ball far from the
//! race it is held at the distance from which on it is far.
//!
//! Overlaps are those with the plain races: contacts that begin on waves or in damage are not among the events, and a ball that
//! passes through zero there has an event where nothing happens. Balls without inertia have none: their forces follow from
//! each other, and what begins and ends there is found with them.

use crate::numerics::lanes::LANES;
use crate::numerics::lanes::scalar_product;
use crate::system::{BallsInertia, CoupledSystem, Formulation};

impl CoupledSystem {
    /// Sets the overlaps at a state, m.
    pub(super) fn contact_events_into(&mut self, t: f64, y: &[f64], v: &[f64], events: &mut [f64]) {
        if self.setup.balls_inertia == BallsInertia::QuasiStatic {
            return;
        }
        let shaft = self.setup.cage.shaft();
        let shaft = shaft.rotation.at_from(&mut self.cursors[0], t);
        let cage = self.setup.cage.rotation.at_from(&mut self.cursors[1], t);
        self.take::<0, 0>(y, v);
        self.place_balls::<0>(&shaft, &cage);
        self.approach_outer_race::<0, 0>();
        if self.residual.is_some() {
            self.outer_forces_with_residual::<0>();
        }
        let modes = self.modes;
        let centre = match self.setup.formulation {
            Formulation::Consistent => [0.0; 2],
            Formulation::Printed => [0, 1].map(|k| scalar_product(&self.centre[k], &y[..modes])),
        };
        let relative = [0, 1].map(|k| y[modes + k] - centre[k]);
        let (outer, inner) = events.split_at_mut(self.balls.count);
        for (j, outer) in outer.iter_mut().enumerate() {
            *outer = self.outer_event(j);
        }
        for (group, inner) in self.balls.groups.iter().zip(inner.chunks_mut(LANES)) {
            let [cos, sin] = &group.direction;
            let gaps = self.inner_race.gaps([cos, sin], &group.displacement, relative);
            for (l, inner) in inner.iter_mut().enumerate() {
                *inner = gaps.penetration[l] + group.oversize[l];
            }
        }
    }

    /// Overlap of ball `j` with the outer race, without its own residual displacement, m. What the other balls do to it goes
    /// to zero where it is no longer near.
    fn outer_event(&self, j: usize) -> f64 {
        let gap = self.balls.get(j, |ball| &ball.gap);
        if gap <= -self.reach {
            return -self.reach;
        }
        let near = (2.0 * (gap + self.reach) / self.reach).min(1.0);
        gap - near * self.residual_shares(j).1
    }
}
