//! How the contact forces change with the state: one term for a contact along its normal and one across it.
//!
//! With w and u the race's rows under a ball (outward, along increasing angle), n and t the unit vectors from the inner race's
//! centre to the ball and across, and c the place of that centre,
//!
//! ```text
//! outer   d F = rr (ds - w dq) - rt u dq + b (ds' - w dq' - w' theta' dq)      on modes w, on the ball -1 / m_b
//!         d T = rt (ds - w dq) - tt u dq                                       on modes u
//! inner   d F = rr' dr + rt' da + b (n . d moving + (t . moving) da / chi)     on the shaft n / m_s, on the ball -n.e / m_b
//!         d T = rt' dr + tt' da                                                on the shaft t / m_s, on the ball -t.e / m_b
//!         dr = n . (e ds - dc), da = t . (e ds - dc)
//! ```
//!
//! with b the derivative by the rate and, across the normal, what comes from the force turning with it, `F / chi`.
//!
//! Exact on circles. Left out, so that a method that solves with it needs an iteration more where they count: the centrifugal
//! force's growth with s (1e4 1/s^2 beside 1e11 of a contact); on damage the profile's turning of the normals and the rate's
//! part across them; of the static residual what one ball's force moves under
//! the others; without the balls' inertia all but
//! both contacts in series along one normal.

use super::super::bearing_setup::{BallsInertia, Formulation};
use super::super::coupled::CoupledSystem;
use super::super::race::{Damage, RaceForce};
use super::super::resting::in_the_plane;
use crate::bearing::RotationState;
use crate::numerics::lanes::LANES;
use crate::numerics::ode::{Tangent, TangentTerm};
use std::f64::consts::TAU;

impl CoupledSystem {
    /// Adds the tangent at the state that was evaluated last, whose force is `g`.
    pub(super) fn add_tangent(&mut self, t: f64, [y, v, g]: [&[f64]; 3], tangent: &mut Tangent) {
        let shaft = self.setup.cage.shaft();
        let shaft = shaft.motion_from(&mut self.cursors[0], t);
        let cage = self.setup.cage.motion_from(&mut self.cursors[1], t);
        if self.setup.balls_inertia == BallsInertia::QuasiStatic {
            for j in 0..self.balls.count {
                self.add_in_series(j, &shaft, tangent);
            }
            return;
        }
        let centre = self.centre_motion(y, v, g);
        let velocity = [0, 1].map(|k| v[self.modes + k] - centre.velocity[k]);
        for j in 0..self.balls.count {
            self.add_outer(j, cage.speed, tangent);
            self.add_inner(j, velocity, [&shaft, &cage], tangent);
        }
        if self.setup.formulation == Formulation::Printed {
            self.add_frame(tangent);
        }
    }

    /// Outer contact of a ball.
    fn add_outer(&mut self, j: usize, speed: f64, tangent: &mut Tangent) {
        let Some((force, own, overlap)) = self.outer_contact(j) else {
            return;
        };
        let uneven = self.work.damage[j] != Damage::None || self.outer.is_wavy();
        let [mut rr, rt, tt] = force.tangent;
        // on a race that gives way by `own`, the rate r shrinks by 1 + own f', and the more the stiffer the contact becomes
        let mut by_rate = force.by_rate;
        if own > 0.0 && by_rate > 0.0 {
            let rate = match uneven {
                true => 0.0,
                false => own * self.balls.get(j, |ball| &ball.rate) / overlap,
            };
            let shrinks = 1.0 + own * rr + 1.5 * rate * by_rate;
            by_rate /= shrinks;
            rr -= 0.5 * by_rate * rate * rr;
        }
        let share = 1.0 / (1.0 + own * rr);
        let (rr, rt, tt) = (rr * share, rt * share, tt - own * rt * rt * share);
        by_rate *= share;
        let (modes, ball) = (self.modes, self.modes + 2 + j);
        if uneven {
            // the row across is still there from the force
            let mut term = tangent.add();
            for i in 0..modes {
                let (w, u) = (self.radial_row(j, i), self.scratch(i));
                term.left[i] = u;
                term.position[i] = -(rt * w + tt * u);
            }
            term.position[ball] = rt;
            self.follow_centre(&mut term);
        }
        let mut term = tangent.add();
        for i in 0..modes {
            let w = self.radial_row(j, i);
            term.left[i] = w;
            term.position[i] = -rr * w;
            term.velocity[i] = -by_rate * w;
            if uneven {
                term.position[i] -= rt * self.scratch(i);
            }
        }
        term.left[ball] = -self.ball_mobility;
        term.position[ball] = rr;
        term.velocity[ball] = by_rate;
        if by_rate > 0.0 {
            let at = self.radial.locate(&self.balls.groups[j / LANES].turn);
            let (place, scale) = (at.get(j % LANES), speed / TAU);
            self.radial.slopes_into(place, scale, &mut self.work.scratch_row);
            for i in 0..modes {
                term.position[i] -= by_rate * self.scratch(i);
            }
        }
        self.follow_centre(&mut term);
    }

    /// Inner contact of a ball, for a `velocity` of the race's centre.
    fn add_inner(&self, j: usize, velocity: [f64; 2], [shaft, cage]: [&RotationState; 2], tangent: &mut Tangent) {
        if self.balls.get(j, |ball| &ball.inner_force) <= 0.0 {
            return;
        }
        let (gap, e) = (self.balls.inner_gap(j), self.balls.direction_of(j));
        let (n, t) = (gap.normal, [-gap.normal[1], gap.normal[0]]);
        let rate = self.balls.get(j, |ball| &ball.displacement_rate);
        let turn = self.radius(j) * cage.speed;
        let moving = [rate * e[0] - turn * e[1] - velocity[0], rate * e[1] + turn * e[0] - velocity[1]];
        let (apart, across) = (product(n, moving), product(t, moving));
        let force = if self.inner.is_irregular() {
            self.irregular_inner_force(j, &gap, [-apart, across], shaft)
        } else {
            self.inner.plain_force(gap.penetration, -apart)
        };
        let [rr, rt, tt] = in_the_plane(&force, gap.distance);
        let (by_rate, turning) = (force.by_rate, across / gap.distance);
        let (along, aside) = (product(n, e), product(t, e));
        let (first, ball) = (self.modes, self.modes + 2 + j);
        let mut term = tangent.add();
        for k in 0..2 {
            term.left[first + k] = self.shaft_mobility * n[k];
            term.position[first + k] = -(rr * n[k] + (rt + by_rate * turning) * t[k]);
            term.velocity[first + k] = -by_rate * n[k];
        }
        term.left[ball] = -self.ball_mobility * along;
        // a ball farther out goes round faster: cage speed times e turned by a right angle
        term.position[ball] = rr * along + rt * aside + by_rate * (turning * aside - cage.speed * aside);
        term.velocity[ball] = by_rate * along;
        self.follow_centre(&mut term);
        let mut term = tangent.add();
        for k in 0..2 {
            term.left[first + k] = self.shaft_mobility * t[k];
            term.position[first + k] = -(rt * n[k] + tt * t[k]);
        }
        term.left[ball] = -self.ball_mobility * aside;
        term.position[ball] = rt * along + tt * aside;
        self.follow_centre(&mut term);
    }

    /// Both contacts of a ball without inertia.
    fn add_in_series(&mut self, j: usize, shaft: &RotationState, tangent: &mut Tangent) {
        if self.balls.get(j, |ball| &ball.inner_force) <= 0.0 {
            return;
        }
        let Some((outer, own, _)) = self.outer_contact(j) else {
            return;
        };
        let gap = self.balls.inner_gap(j);
        let inner = self.inner_force_at(j, &gap, shaft).tangent[0];
        let outer = outer.tangent[0] / (1.0 + own * outer.tangent[0]);
        let both = inner + outer;
        if inner <= 0.0 || outer <= 0.0 {
            return;
        }
        let stiffness = inner * outer / both;
        let term = tangent.add();
        for i in 0..self.modes {
            let w = self.radial_row(j, i);
            term.left[i] = w;
            term.position[i] = -stiffness * w;
        }
        for k in 0..2 {
            term.left[self.modes + k] = -self.shaft_mobility * gap.normal[k];
            term.position[self.modes + k] = stiffness * gap.normal[k];
        }
    }

    /// Force on the outer race with its derivatives, how far the race gives way to it (m/N), and the displacement into the race (m);
    /// none without contact.
    fn outer_contact(&mut self, j: usize) -> Option<(RaceForce, f64, f64)> {
        if self.balls.get(j, |ball| &ball.outer_magnitude) <= 0.0 {
            return None;
        }
        let gap = self.balls.get(j, |ball| &ball.gap);
        let (own, others) = self.residual_shares(j);
        let given = match self.setup.balls_inertia {
            BallsInertia::Dynamic => others + own * self.balls.get(j, |ball| &ball.outer_radial),
            // what is kept there is the overlap
            BallsInertia::QuasiStatic => 0.0,
        };
        let force = self.outer_force(j, gap - given);
        (force.magnitude > 0.0).then_some((force, own, gap - given))
    }

    /// In `printed` the inner race is where the shaft is less the ring's mean, and the balls' frame accelerates with it.
    fn follow_centre(&self, term: &mut TangentTerm<'_>) {
        if self.setup.formulation == Formulation::Consistent {
            return;
        }
        let modes = self.modes;
        for k in 0..2 {
            let (position, velocity) = (term.position[modes + k], term.velocity[modes + k]);
            let mut acceleration = 0.0;
            for (i, row) in self.centre[k].iter().enumerate() {
                term.position[i] -= position * row;
                term.velocity[i] -= velocity * row;
                acceleration += term.left[i] * row;
            }
            for (j, left) in term.left[modes + 2..].iter_mut().enumerate() {
                *left -= self.balls.direction_of(j)[k] * acceleration;
            }
        }
    }

    /// What springs and dampers of the modes do to that frame.
    fn add_frame(&self, tangent: &mut Tangent) {
        for k in 0..2 {
            let term = tangent.add();
            for (j, left) in term.left[self.modes + 2..].iter_mut().enumerate() {
                *left = self.balls.direction_of(j)[k];
            }
            for (i, row) in self.centre[k].iter().enumerate() {
                term.position[i] = row * self.linear[i].squared_frequency;
                term.velocity[i] = row * self.linear[i].damping;
            }
        }
    }

    /// Outward displacement of the race under ball `j` by mode `i`.
    fn radial_row(&self, j: usize, i: usize) -> f64 {
        self.balls.groups[j / LANES].rows[i / LANES][j % LANES][i % LANES]
    }

    fn scratch(&self, i: usize) -> f64 {
        self.work.scratch_row[i / LANES][i % LANES]
    }
}

fn product(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
