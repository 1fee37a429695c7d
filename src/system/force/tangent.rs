//! How the contact forces change with the state: one term for a contact along its normal and one across it.
//!
//! With w and u the race's rows under a ball (outward, along increasing angle), n and t the unit vectors from the inner race's
//! centre to the ball and across, and c the place of that centre,
//!
//! ```text
//! outer   d F = rr (ds - w dq) - rt u dq + b_rr dr' + b_rt da'                 on modes w, on the ball -1 / m_b
//!         d T = rt (ds - w dq) - tt u dq + b_rt dr' + b_tt da'                 on modes u
//!         dr' = ds' - w dq' - w' theta' dq
//!         da' = -u dq' - u' theta' dq + (theta' - turning) (ds - w dq)         `printed`: without u
//! inner   d F = rr' dr + rt' da + b_rr dr' + b_rt da'                          on the shaft n / m_s, on the ball -n.e / m_b
//!         d T = rt' dr + tt' da + b_rt dr' + b_tt da'                          on the shaft t / m_s, on the ball -t.e / m_b
//!         dr = n . (e ds - dc), da = t . (e ds - dc)
//!         dr' = n . d moving + (t . moving) da / chi, da' = t . d moving - turning dr
//! ```
//!
//! with b the derivatives by the velocities relative to what turns with the damage and, across the normal, what comes from the
//! force turning with it, `F / chi`.
//!
//! Exact on circles. Left out, so that a method that solves with it needs an iteration more where they count: the centrifugal
//! force's growth with s (1e4 1/s^2 beside 1e11 of a contact); on damage how the profile turns the normals; of the velocity along
//! it the parts by u / rho and by the radial velocity over chi; of the static residual what one ball's force moves under the
//! others; without the balls' inertia all but both contacts in series along one normal.

use super::super::race::{Damage, RaceForce};
use super::super::resting::in_the_plane;
use crate::bearing::RotationState;
use crate::numerics::lanes::{self, LANES, Lanes};
use crate::numerics::ode::{Tangent, TangentTerm};
use crate::system::{BallsInertia, CoupledSystem, Formulation};
use std::f64::consts::TAU;

/// Contact of a ball with the outer race.
struct OuterContact {
    /// On the race, with its derivatives.
    force: RaceForce,
    /// How far the race gives way to it, m/N.
    own: f64,
    /// Displacement into the race, m.
    overlap: f64,
    /// Angular speed of what carries the damage, rad/s.
    carrier: f64,
}

impl CoupledSystem {
    /// Adds the tangent at the state that was evaluated last, whose force is `g`.
    pub(super) fn add_tangent(&mut self, t: f64, [y, v, g]: [&[f64]; 3], tangent: &mut Tangent) {
        let shaft = self.setup.cage.shaft();
        let shaft = shaft.rotation.at_from(&mut self.cursors[0], t);
        if self.setup.balls_inertia == BallsInertia::QuasiStatic {
            for j in 0..self.balls.count {
                self.add_in_series(j, &shaft, tangent);
            }
            return;
        }
        let centre = self.centre_motion(y, v, g);
        let velocity = [0, 1].map(|k| v[self.modes + k] - centre.velocity[k]);
        for j in 0..self.balls.count {
            self.add_outer(j, tangent);
            self.add_inner(j, velocity, &shaft, tangent);
        }
        if self.setup.formulation == Formulation::Printed {
            self.add_frame(tangent);
        }
    }

    /// Outer contact of a ball.
    fn add_outer(&mut self, j: usize, tangent: &mut Tangent) {
        let Some(OuterContact { force, own, overlap, carrier }) = self.outer_contact(j) else {
            return;
        };
        let uneven = self.work.damage[j] != Damage::None || self.outer.is_wavy();
        let [mut rr, rt, tt] = force.tangent;
        // on a race that gives way by `own`, the rate r shrinks by 1 + own f', and the more the stiffer the contact becomes
        let [mut by_rate, mixed, across] = force.by_rate;
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
        // by which the race gives way for a motion along it
        let aside = own * rt * share;
        let across = across - aside * (2.0 * mixed - aside * force.by_rate[0]);
        let mixed = (mixed - aside * force.by_rate[0]) * share;
        let (rr, rt, tt) = (rr * share, rt * share, tt - own * rt * rt * share);
        by_rate *= share;
        let (modes, sliding) = (self.modes, self.work.cage_speed - carrier);
        if uneven {
            let mut term = tangent.add();
            let by = [[rt + across * sliding, tt], [mixed, across]];
            self.by_motion_on_outer(j, by, &mut term);
            self.find_row_across(j);
            lanes::get(&self.work.scratch_row, &mut term.left[..modes]);
            self.follow_centre(&mut term);
        }
        let mut term = tangent.add();
        let by = [[rr + mixed * sliding, rt], [by_rate, mixed]];
        self.by_motion_on_outer(j, by, &mut term);
        for i in 0..modes {
            term.left[i] = self.radial_row(j, i);
        }
        term.left[modes + 2 + j] = -self.ball_mobility;
        self.follow_centre(&mut term);
    }

    /// Sets by which motion a force changes that changes by the displacement of ball `j` and its rate, each towards the outer race
    /// and along it.
    fn by_motion_on_outer(
        &mut self,
        j: usize,
        [[towards, along], [rate, rate_along]]: [[f64; 2]; 2],
        term: &mut TangentTerm<'_>,
    ) {
        let (modes, ball) = (self.modes, self.modes + 2 + j);
        for i in 0..modes {
            let w = self.radial_row(j, i);
            term.position[i] = -towards * w;
            term.velocity[i] = -rate * w;
        }
        term.position[ball] = towards;
        term.velocity[ball] = rate;
        let scale = self.work.cage_speed / TAU;
        if rate != 0.0 {
            let place = self.radial.locate(&self.balls.groups[j / LANES].turn).get(j % LANES);
            self.radial.slopes_into(place, scale, &mut self.work.scratch_row);
            take(&mut term.position[..modes], rate, &self.work.scratch_row);
        }
        if along != 0.0 {
            self.find_row_across(j);
            take(&mut term.position[..modes], along, &self.work.scratch_row);
        }
        if rate_along != 0.0 && self.setup.formulation == Formulation::Consistent {
            self.find_row_across(j);
            take(&mut term.velocity[..modes], rate_along, &self.work.scratch_row);
            let place = self.tangential_place(j);
            self.tangential.slopes_into(place, scale, &mut self.work.scratch_row);
            take(&mut term.position[..modes], rate_along, &self.work.scratch_row);
        }
    }

    /// Sets the scratch row to the race's displacement along increasing angle under ball `j`.
    fn find_row_across(&mut self, j: usize) {
        let at = self.tangential_place(j);
        let (work, table) = (&mut self.work, &self.tangential);
        table.values_into(at, &work.amplitudes, work.scratch_row.iter_mut());
    }

    /// Inner contact of a ball, for a `velocity` of the race's centre.
    fn add_inner(&self, j: usize, velocity: [f64; 2], shaft: &RotationState, tangent: &mut Tangent) {
        if self.balls.get(j, |ball| &ball.inner_force) <= 0.0 {
            return;
        }
        let (gap, e) = (self.balls.inner_gap(j), self.balls.direction_of(j));
        let (n, t) = (gap.normal, [-gap.normal[1], gap.normal[0]]);
        let rate = self.balls.get(j, |ball| &ball.displacement_rate);
        let moving = self.velocity_on_inner(j, &gap, rate, velocity);
        let (damage, place) = self.inner_place(j, &gap, moving, shaft);
        let force = self.inner.force(damage, &place);
        let [rr, rt, tt] = in_the_plane(&force, gap.distance);
        let ([by_rate, mixed, by_across], turning) = (force.by_rate, moving[1] / gap.distance);
        let (along, aside) = (product(n, e), product(t, e));
        let (speed, carrier) = (self.work.cage_speed, place.carrier(damage));
        let (first, ball) = (self.modes, self.modes + 2 + j);
        // along the normal and across it
        let terms = [(n, along, [rr, rt], [by_rate, mixed]), (t, aside, [rt, tt], [mixed, by_across])];
        for (direction, share, [by_along, by_aside], [rate_along, rate_aside]) in terms {
            let mut term = tangent.add();
            for k in 0..2 {
                term.left[first + k] = self.shaft_mobility * direction[k];
                term.position[first + k] =
                    -((by_along - rate_aside * carrier) * n[k] + (by_aside + rate_along * turning) * t[k]);
                term.velocity[first + k] = -(rate_along * n[k] + rate_aside * t[k]);
            }
            term.left[ball] = -self.ball_mobility * share;
            // a ball farther out goes round faster: cage speed times e turned by a right angle
            term.position[ball] = by_along * along
                + by_aside * aside
                + rate_along * (turning * aside - speed * aside)
                + rate_aside * (speed - carrier) * along;
            term.velocity[ball] = rate_along * along + rate_aside * aside;
            self.follow_centre(&mut term);
        }
    }

    /// Both contacts of a ball without inertia.
    fn add_in_series(&mut self, j: usize, shaft: &RotationState, tangent: &mut Tangent) {
        if self.balls.get(j, |ball| &ball.inner_force) <= 0.0 {
            return;
        }
        let Some(OuterContact { force, own, .. }) = self.outer_contact(j) else {
            return;
        };
        let gap = self.balls.inner_gap(j);
        let inner = self.inner_force_at(j, &gap, shaft).tangent[0];
        let outer = force.tangent[0] / (1.0 + own * force.tangent[0]);
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

    /// None without contact.
    fn outer_contact(&self, j: usize) -> Option<OuterContact> {
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
        let overlap = gap - given;
        let (damage, place) = self.outer_place(j, overlap);
        let force = self.outer.force(damage, &place);
        (force.magnitude > 0.0).then_some(OuterContact { force, own, overlap, carrier: place.carrier(damage) })
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
}

/// Takes `factor` times a row from as many entries as there are.
fn take(from: &mut [f64], factor: f64, row: &[Lanes]) {
    for (entry, value) in from.iter_mut().zip(row.as_flattened()) {
        *entry -= factor * value;
    }
}

fn product(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
