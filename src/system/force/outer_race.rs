//! Contacts of the balls with the outer race that the kept modes and the weight move.

use super::super::bearing_setup::{BallsInertia, Formulation};
use super::super::coupled::CoupledSystem;
use super::super::race::{Damage, RaceForce, RacePlace};
use super::super::raceway::{Place, RacewayTable};
use crate::numerics::lanes::{self, LANES, Lanes, positive};
use std::f64::consts::TAU;

impl CoupledSystem {
    /// Finds the balls that touch the outer race or may be reached by it, what they may feel there, their displacements
    /// relative to the race and the rates of these.
    #[inline(always)]
    pub(super) fn approach_outer_race<const B: usize, const M: usize>(&mut self) {
        self.find_gaps::<B, M>();
        if self.setup.contact_damping > 0.0 {
            self.rates_towards_outer_race::<B>();
        }
        if self.outer.irregular {
            self.find_damage();
            self.find_shifts();
        }
    }

    /// Finds the balls on waves or damage, and how far and how fast the race under them moves along increasing angle: with it they
    /// move along the profile.
    #[inline(always)]
    fn find_shifts(&mut self) {
        let scale = self.work.cage_speed / TAU;
        self.work.uneven.clear();
        if self.outer.is_wavy() {
            for j in 0..self.balls.count {
                if self.is_near(j) {
                    self.work.uneven.push(j);
                }
            }
        } else {
            self.work.uneven.extend_from_slice(&self.work.damaged);
        }
        for place in 0..self.work.uneven.len() {
            let j = self.work.uneven[place];
            let at = self.tangential_place(j);
            let (work, table) = (&mut self.work, &self.tangential);
            let row = &mut work.scratch_row;
            let shift = table.values_into(at, &work.amplitudes, row.iter_mut());
            let moved = lanes::dot(row.iter(), &work.velocities);
            table.slopes_into(at, scale, row);
            let carried = lanes::dot(row.iter(), &work.amplitudes);
            self.balls.set(j, |ball| &mut ball.shift, shift);
            self.balls.set(j, |ball| &mut ball.shift_rate, moved + carried);
        }
    }

    /// Displacements relative to the race, of a ball that cannot be reached by it minus infinity, and the forces that plain
    /// contact without residual and damping would give.
    #[inline(always)]
    fn find_gaps<const B: usize, const M: usize>(&mut self) {
        let limit = match self.setup.balls_inertia {
            BallsInertia::Dynamic => self.reach + self.race_bound::<M>(),
            // where they are is not known yet
            BallsInertia::QuasiStatic => f64::INFINITY,
        };
        let amplitudes = lanes::first::<M, _>(&self.work.amplitudes);
        let velocities = lanes::first::<M, _>(&self.work.velocities);
        let moving = (self.setup.contact_damping > 0.0).then_some((velocities, self.work.cage_speed / TAU));
        let (radial, stiffness) = (&self.radial, self.outer.plain.stiffness);
        for group in lanes::first_mut::<B, _>(&mut self.balls.groups) {
            let places = radial.locate(&group.turn);
            let (s, oversize) = (&group.displacement, &group.oversize);
            let s = lanes::each(|l| s[l] + oversize[l]);
            let mut gaps = Gaps { limit, radial, amplitudes, moving, rows: lanes::first_mut::<M, _>(&mut group.rows) };
            let found = [
                gaps.of::<0>(s[0], places.get(0)),
                gaps.of::<1>(s[1], places.get(1)),
                gaps.of::<2>(s[2], places.get(2)),
                gaps.of::<3>(s[3], places.get(3)),
            ];
            let gap = found.map(|[gap, _]| gap);
            group.gap = gap;
            group.race_rate = found.map(|[_, rate]| rate);
            // here, where the gaps need not be collected from memory
            group.outer_radial = lanes::each(|l| {
                let overlap = positive(gap[l]);
                stiffness * (overlap * overlap.sqrt())
            });
        }
        self.place_residual::<B>();
    }

    /// Turns the residual's displacements to the balls, and takes what the weight moves there out of their gaps.
    #[inline(always)]
    fn place_residual<const B: usize>(&mut self) {
        let Some(coupling) = &mut self.residual else {
            return;
        };
        coupling.turn_to(self.balls.groups[0].turn[0]);
        let everywhere = self.setup.balls_inertia == BallsInertia::QuasiStatic;
        let with_slopes = self.setup.contact_damping > 0.0;
        let groups = lanes::first_mut::<B, _>(&mut self.balls.groups);
        for (group, weight) in groups.iter_mut().zip(coupling.weight::<B>()) {
            let gap = &group.gap;
            group.gap = lanes::each(|l| gap[l] - weight[l]);
        }
        for (number, group) in groups.iter_mut().enumerate() {
            group.own = [0.0; LANES];
            for lane in 0..LANES {
                let ball = number * LANES + lane;
                if (group.gap[lane] > -self.reach || everywhere) && ball < self.balls.count {
                    coupling.turn_column::<B>(ball, with_slopes);
                    group.own[lane] = coupling.between(ball, ball);
                }
            }
        }
    }

    /// Whether a ball is near enough to the race to be reached by what the other balls do.
    #[inline(always)]
    pub(super) fn is_near(&self, j: usize) -> bool {
        self.balls.get(j, |ball| &ball.gap) > -self.reach || self.setup.balls_inertia == BallsInertia::QuasiStatic
    }

    /// How far the kept modes and the weight can have moved the race anywhere, m.
    #[inline(always)]
    fn race_bound<const M: usize>(&self) -> f64 {
        let mut sums = [0.0; LANES];
        let amplitudes = lanes::first::<M, _>(&self.work.amplitudes);
        let bounds = lanes::first::<M, _>(&self.balls.mode_bounds);
        for (bound, amplitude) in bounds.iter().zip(amplitudes) {
            sums = lanes::each(|l| sums[l] + bound[l] * amplitude[l].abs());
        }
        self.balls.weight_bound + lanes::total(&sums)
    }

    /// Velocities of the near balls relative to the race: the race's radial velocity under a ball is `d/dt w(theta(t), t)`,
    /// with the part that comes from the ball moving along the deformed race. The static residual's part is added where it
    /// is known.
    #[inline(always)]
    fn rates_towards_outer_race<const B: usize>(&mut self) {
        for group in lanes::first_mut::<B, _>(&mut self.balls.groups) {
            let (gap, ball, race) = (&group.gap, &group.displacement_rate, &group.race_rate);
            // the opposite would leave out what is not a number
            group.rate = lanes::each(|l| if gap[l] <= -self.reach { 0.0 } else { ball[l] - race[l] });
        }
    }

    /// Distance of a ball's centre from the bearing's, m.
    #[inline(always)]
    pub(in super::super) fn radius(&self, j: usize) -> f64 {
        self.inner_race.touching_radius + self.balls.get(j, |ball| &ball.displacement)
    }

    /// Forces on a race that only the kept modes move, from those of plain contact without damping.
    #[inline(always)]
    pub(super) fn outer_forces<const B: usize>(&mut self) {
        let damping = self.outer.plain.damping;
        for group in lanes::first_mut::<B, _>(&mut self.balls.groups) {
            if damping > 0.0 {
                let (force, rate) = (&group.outer_radial, &group.rate);
                group.outer_radial = lanes::each(|l| force[l] * positive(1.0 + damping * rate[l]));
            }
            group.outer_magnitude = group.outer_radial;
            group.outer_tangential = [0.0; LANES];
        }
        for place in 0..self.work.uneven.len() {
            let j = self.work.uneven[place];
            let force = self.outer_force(j, self.balls.get(j, |ball| &ball.gap));
            self.keep_outer(j, &force);
        }
    }

    /// Outer force of ball `j` at the displacement `s` relative to the race.
    #[inline]
    pub(super) fn outer_force(&self, j: usize, s: f64) -> RaceForce {
        let (damage, place) = self.outer_place(j, s);
        self.outer.force(damage, &place)
    }

    /// What ball `j` feels at the outer race at the displacement `s` (m) relative to it, and its place there.
    ///
    /// With the race's displacement u along increasing angle the ball at θ is at `θ - u / ρ` on the race, and moves along it
    /// at `(R + s) d/dt (θ - u / ρ)`, R the distance at which it touches. `printed` leaves u out of that.
    #[inline]
    pub(in super::super) fn outer_place(&self, j: usize, s: f64) -> (Damage, RacePlace) {
        let damage = self.work.damage[j];
        let mut place =
            RacePlace { penetration: s, rate: self.balls.get(j, |ball| &ball.rate), ..RacePlace::default() };
        if damage == Damage::None && !self.outer.is_wavy() {
            return (damage, place);
        }
        let radius = self.radius(j);
        let shift = self.balls.get(j, |ball| &ball.shift) / radius;
        let [spin, spin_speed] = self.work.spin[j];
        place.angle = self.ball_angle(j) - shift;
        place.spin = [spin + shift, spin_speed];
        let speed = self.work.cage_speed;
        place.along = match self.setup.formulation {
            Formulation::Consistent => {
                let [shift_rate, rate] =
                    [self.balls.get(j, |ball| &ball.shift_rate), self.balls.get(j, |ball| &ball.displacement_rate)];
                self.outer.radius(s) * (speed - (shift_rate - shift * rate) / radius)
            }
            Formulation::Printed => radius * speed,
        };
        (damage, place)
    }

    /// Where ball `j` is in the table of tangential displacements.
    #[inline]
    pub(in super::super) fn tangential_place(&self, j: usize) -> Place {
        let turns = &self.balls.groups[j / LANES].turn;
        self.tangential.locate(turns).get(j % LANES)
    }

    #[inline]
    pub(super) fn keep_outer(&mut self, j: usize, force: &RaceForce) {
        let (group, lane) = (&mut self.balls.groups[j / LANES], j % LANES);
        group.outer_radial[lane] = force.radial;
        group.outer_magnitude[lane] = force.magnitude;
        group.outer_tangential[lane] = force.tangential;
    }
}

/// What the gaps of a group of balls are found with.
struct Gaps<'a> {
    limit: f64,
    radial: &'a RacewayTable,
    amplitudes: &'a [Lanes],
    /// The modes' velocities and the speed of the balls, turns a second, where the race's rates are asked for.
    moving: Option<(&'a [Lanes], f64)>,
    rows: &'a mut [[Lanes; LANES]],
}

impl Gaps<'_> {
    /// Displacement of the ball in lane `L` relative to the race, at `s` (m) from its undeformed place, minus infinity if it
    /// cannot be reached, and the race's rate there or zero; keeps the race's row there.
    #[inline(always)]
    fn of<const L: usize>(&mut self, s: f64, at: Place) -> [f64; 2] {
        // what is not a number goes on and shows itself
        if s <= -self.limit {
            return [f64::NEG_INFINITY, 0.0];
        }
        let rows = self.rows.iter_mut().map(|rows| &mut rows[L]);
        let Some((velocities, speed)) = self.moving else {
            return [s - self.radial.values_into(at, self.amplitudes, rows), 0.0];
        };
        let [race, rate] = self.radial.motion_into(at, [self.amplitudes, velocities], speed, rows);
        [s - race, rate]
    }
}
