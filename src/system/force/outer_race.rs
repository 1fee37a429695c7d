//! Contacts of the balls with the outer race that the kept modes and the weight move.

use super::super::bearing_setup::BallsInertia;
use super::super::coupled::{CoupledSystem, Work};
use super::super::lanes::{self, positive};
use super::super::race::{Damage, RaceForce, RacePlace};
use crate::bearing::RotationState;

impl CoupledSystem {
    /// Finds the balls that touch the outer race or may be reached by it, what they may feel there, their displacements
    /// relative to the race and the rates of these.
    #[inline(always)]
    pub(super) fn approach_outer_race(&mut self, shaft: &RotationState, cage: &RotationState) {
        self.find_gaps();
        if self.setup.contact_damping > 0.0 {
            self.rates_towards_outer_race(cage);
        }
        if self.outer.is_irregular() || self.inner.is_irregular() {
            self.turn_flats(shaft, cage);
        }
        if self.outer.is_irregular() {
            self.find_damage();
        }
    }

    /// Displacements relative to the race; of a ball that cannot be reached by it, minus infinity.
    #[inline(always)]
    fn find_gaps(&mut self) {
        let limit = match self.setup.balls_inertia {
            BallsInertia::Dynamic => self.reach + self.race_bound(),
            // where they are is not known yet
            BallsInertia::QuasiStatic => f64::INFINITY,
        };
        let (count, groups) = (self.balls.count, self.radial.groups());
        let Work {
            amplitudes,
            displacement,
            turn,
            rows,
            gap,
            ..
        } = &mut self.work;
        let displacement = displacement.as_flattened()[..count].iter();
        let balls = displacement.zip(&self.balls.oversize).enumerate();
        let gaps = gap.as_flattened_mut().iter_mut();
        let places = turn.as_flattened().iter().zip(gaps);
        let rows = rows.chunks_exact_mut(groups);
        for (((j, (s, oversize)), (&turn, gap)), row) in balls.zip(places).zip(rows) {
            let s = s + oversize;
            // what is not a number goes on and shows itself
            if s <= -limit {
                *gap = f64::NEG_INFINITY;
                continue;
            }
            *gap = s - self.radial.values_into(turn, amplitudes, row);
            if let Some(residual) = &mut self.residual {
                residual.place(j, turn);
                *gap -= residual.weight(j);
            }
        }
    }

    /// What the balls that are near may feel.
    fn find_damage(&mut self) {
        for j in 0..self.balls.count {
            self.work.damage[j] = if self.is_near(j) {
                self.damage_at_the_outer_race(j)
            } else {
                Damage::None
            };
        }
    }

    /// Whether a ball is near enough to the race to be reached by what the other balls do.
    #[inline(always)]
    pub(super) fn is_near(&self, j: usize) -> bool {
        self.work.gap.as_flattened()[j] > -self.reach
            || self.setup.balls_inertia == BallsInertia::QuasiStatic
    }

    /// How far the kept modes and the weight can have moved the race anywhere, m.
    #[inline(always)]
    fn race_bound(&self) -> f64 {
        let mut sum = self.balls.weight_bound;
        for (bound, amplitude) in self.balls.mode_bounds.iter().zip(&self.work.amplitudes) {
            sum += lanes::total(&lanes::each(|l| bound[l] * amplitude[l].abs()));
        }
        sum
    }

    /// Velocities of the near balls relative to the race: the race's radial velocity under a ball is `d/dt w(theta(t), t)`,
    /// with the part that comes from the ball moving along the deformed race. The static residual's part is added where it
    /// is known.
    #[inline(always)]
    fn rates_towards_outer_race(&mut self, cage: &RotationState) {
        let groups = self.radial.groups();
        for j in 0..self.balls.count {
            if !self.is_near(j) {
                self.work.rate[j] = [0.0; 2];
                continue;
            }
            let along = self.radius(j) * cage.speed;
            let work = &mut self.work;
            let slopes = &mut work.scratch_row;
            self.radial.slopes_into(work.turn.as_flattened()[j], slopes);
            let row = &work.rows[j * groups..(j + 1) * groups];
            let race = lanes::dot(row, &work.velocities)
                + cage.speed * lanes::dot(slopes, &work.amplitudes);
            work.rate[j] = [work.displacement_rate.as_flattened()[j] - race, along];
        }
    }

    /// Distance of a ball's centre from the bearing's, m.
    #[inline(always)]
    pub(super) fn radius(&self, j: usize) -> f64 {
        self.inner_race.touching_radius + self.work.displacement.as_flattened()[j]
    }

    /// Forces on a race that only the kept modes move.
    #[inline(always)]
    pub(super) fn outer_forces(&mut self) {
        let work = &mut self.work;
        let law = self.outer.plain();
        for group in 0..work.gap.len() {
            let (gap, rate) = (&work.gap[group], &work.rate);
            let mut force = lanes::each(|l| {
                let overlap = positive(gap[l]);
                law.stiffness * (overlap * overlap.sqrt())
            });
            if law.damping > 0.0 {
                let first = group * lanes::LANES;
                force = lanes::each(|l| {
                    let rate = rate.get(first + l).map_or(0.0, |rate| rate[0]);
                    force[l] * positive(1.0 + law.damping * rate)
                });
            }
            work.outer_radial[group] = force;
            work.outer_magnitude[group] = force;
        }
        if self.outer.is_irregular() {
            self.irregular_outer_forces();
        }
    }

    /// The same for balls on waves or damage.
    fn irregular_outer_forces(&mut self) {
        self.work.outer_tangential.fill(0.0);
        let wavy = self.outer.is_wavy();
        for j in 0..self.balls.count {
            if self.is_near(j) && (wavy || self.work.damage[j] != Damage::None) {
                let force = self.outer_force(j, self.work.gap.as_flattened()[j]);
                self.keep_outer(j, &force);
            }
        }
    }

    /// Outer force of ball `j` at the displacement `s` relative to the race.
    #[inline]
    pub(super) fn outer_force(&mut self, j: usize, s: f64) -> RaceForce {
        let damage = self.work.damage[j];
        if damage == Damage::None && !self.outer.is_wavy() {
            return self.outer.plain_force(s, self.work.rate[j][0]);
        }
        let (turn, radius) = (self.work.turn.as_flattened()[j], self.radius(j));
        let work = &mut self.work;
        let along = self
            .tangential
            .values_into(turn, &work.amplitudes, &mut work.scratch_row);
        let shift = along / radius;
        let [rate, along] = self.work.rate[j];
        let [spin, speed] = self.work.spin[j];
        let place = RacePlace {
            angle: self.ball_angle(j) - shift,
            penetration: s,
            rate,
            along,
            spin: [spin + shift, speed],
            turning: 0.0,
        };
        self.outer.force(damage, &place)
    }

    #[inline]
    pub(super) fn keep_outer(&mut self, j: usize, force: &RaceForce) {
        let work = &mut self.work;
        work.outer_radial.as_flattened_mut()[j] = force.radial;
        work.outer_magnitude.as_flattened_mut()[j] = force.magnitude;
        work.outer_tangential[j] = force.tangential;
    }
}
