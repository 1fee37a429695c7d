//! Outer contacts on a race that also gives way by the static residual of the modes left out.

use super::super::coupled::CoupledSystem;
use super::super::race::SAME_TOUCH;
use crate::numerics::lanes::{LANES, Lanes, each, first_mut, fused, positive};

/// Sweeps over all balls at once: three to five where the residual is a few percent of the contacts' own flexibility.
const SWEEPS: usize = 12;

/// Those of them that find the rates: what one leaves is some percent of what it found.
const RATE_SWEEPS: usize = 2;

/// Sweeps over the balls in turns, far more than it takes.
pub(super) const MAX_SWEEPS: usize = 1000;

/// Relative change of a contact force at which the sweeps end: the forces are then right to about a percent of it, 1e-8, far
/// below any integration error.
pub(super) const SWEEP_TOLERANCE: f64 = 1e-6;

impl CoupledSystem {
    /// Outer forces that deform the race through the residual flexibility `G`, `F_j = f(gap_j - sum G_jk F_k)`: all balls at
    /// once, Newton's method in each one's own force.
    ///
    /// `G` is soft beside the contacts (a few percent, and less from ball to ball), so each sweep gains nearly two digits; the
    /// start does not depend on the history.
    ///
    /// Contact damping sees the rates on the moving race, `r = v - dG/dt F - G dF/dt` with `dF_j/dt = f'(gap) r_j` and, on waves
    /// and damage, what changes as the ball moves along: they are found in the first of the same sweeps.
    #[inline(always)]
    pub(super) fn outer_forces_with_residual<const B: usize>(&mut self) {
        let damped = self.setup.contact_damping > 0.0;
        self.start_sweeps::<B>();
        let mut done = false;
        for sweep in 0..SWEEPS {
            if damped && sweep < RATE_SWEEPS {
                self.displace_moving_race::<B>();
                self.damping_factors::<B>();
            } else {
                self.displace_race::<B>();
            }
            self.laws::<B>();
            for place in 0..self.work.uneven.len() {
                self.uneven_law(self.work.uneven[place]);
            }
            let (mut change, mut largest) = ([0.0; LANES], [0.0; LANES]);
            for group in first_mut::<B, _>(&mut self.balls.groups) {
                let (own, [law, tangent]) = (&group.own, &group.law);
                let before = group.outer_radial;
                let yields = each(|l| 1.0 / fused(own[l], tangent[l], 1.0));
                let after = each(|l| positive(fused(law[l] - before[l], yields[l], before[l])));
                group.yields = yields;
                change = each(|l| f64::max(change[l], (after[l] - before[l]).abs()));
                largest = each(|l| f64::max(largest[l], after[l]));
                group.outer_radial = after;
            }
            if most(&change) <= SWEEP_TOLERANCE * most(&largest) {
                done = true;
                break;
            }
        }
        if !done {
            self.outer_forces_in_turns::<B>(damped);
        }
        for group in first_mut::<B, _>(&mut self.balls.groups) {
            group.outer_magnitude = group.outer_radial;
            group.outer_tangential = [0.0; LANES];
        }
        for place in 0..self.work.uneven.len() {
            let j = self.work.uneven[place];
            let (group, lane) = (&mut self.balls.groups[j / LANES], j % LANES);
            let s = group.gap[lane] - group.displaced[lane];
            let force = self.outer.force_by(&self.work.touch[j], s, group.rate[lane]);
            group.outer_magnitude[lane] = force.magnitude;
            group.outer_tangential[lane] = force.tangential;
        }
    }

    /// The same ball by ball, each with the newest forces and rates of the others, which converges however soft the residual is
    /// (`1 / f' + G` is positive definite); not a number where it does not.
    #[inline(never)]
    fn outer_forces_in_turns<const B: usize>(&mut self, damped: bool) {
        let near = (0..self.balls.count).filter(|&j| self.is_near(j));
        let near: Vec<usize> = near.collect();
        for &j in &near {
            self.balls.set(j, |ball| &mut ball.outer_radial, 0.0);
            self.balls.set(j, |ball| &mut ball.law[1], 0.0);
            self.balls.set(j, |ball| &mut ball.growth, 0.0);
            self.work.touch[j].penetration = f64::NAN;
        }
        for _ in 0..MAX_SWEEPS {
            let (mut change, mut largest) = (0.0_f64, 0.0_f64);
            for &j in &near {
                let [before, after] = self.next_force(j, &near, damped);
                change = change.max((after - before).abs());
                largest = largest.max(after);
            }
            if change <= SWEEP_TOLERANCE * largest {
                self.displace_race::<B>();
                return;
            }
        }
        for &j in &near {
            self.balls.set(j, |ball| &mut ball.outer_radial, f64::NAN);
        }
    }

    /// Newton's step in the force of ball `j` with those of the others, and its rate: the force before and after.
    fn next_force(&mut self, j: usize, near: &[usize], damped: bool) -> [f64; 2] {
        let (mut displaced, mut yielding) = (0.0, 0.0);
        let Some(coupling) = &self.residual else {
            return [0.0; 2];
        };
        let own = coupling.between(j, j);
        for &k in near.iter().filter(|&&k| k != j) {
            let (other, lane) = (&self.balls.groups[k / LANES], k % LANES);
            let flexibility = coupling.between(j, k);
            displaced += flexibility * other.outer_radial[lane];
            yielding += flexibility * (other.law[1][lane] * other.rate[lane] + other.growth[lane]);
        }
        let plain = self.outer.plain;
        let (group, lane) = (&mut self.balls.groups[j / LANES], j % LANES);
        let before = group.outer_radial[lane];
        group.displaced[lane] = displaced + own * before;
        if damped {
            let yielding = yielding + own * group.growth[lane];
            let rate = (group.approach[lane] - yielding) / (1.0 + own * group.law[1][lane]);
            group.rate[lane] = rate;
            group.damping[lane] = f64::max(1.0 + plain.damping * rate, 0.0);
        }
        if self.work.uneven.contains(&j) {
            self.uneven_law(j);
        } else {
            let overlap = f64::max(group.gap[lane] - group.displaced[lane], 0.0);
            let root = plain.stiffness * group.damping[lane] * overlap.sqrt();
            (group.law[0][lane], group.law[1][lane]) = (root * overlap, 1.5 * root);
        }
        let group = &mut self.balls.groups[j / LANES];
        let [law, tangent] = group.law.map(|law| law[lane]);
        let after = before + (law - before) / (1.0 + own * tangent);
        // what is not a number stays
        let after = if after < 0.0 { 0.0 } else { after };
        group.outer_radial[lane] = after;
        [before, after]
    }

    /// Forces on a race that gives way by each ball's own share alone, and the rates.
    #[inline(always)]
    fn start_sweeps<const B: usize>(&mut self) {
        for group in first_mut::<B, _>(&mut self.balls.groups) {
            group.displaced = [0.0; LANES];
            group.growth = [0.0; LANES];
        }
        self.damping_factors::<B>();
        self.laws::<B>();
        for place in 0..self.work.uneven.len() {
            let j = self.work.uneven[place];
            self.work.touch[j].penetration = f64::NAN;
            self.uneven_law(j);
        }
        for group in first_mut::<B, _>(&mut self.balls.groups) {
            let (own, [law, tangent]) = (&group.own, &group.law);
            group.yields = each(|l| 1.0 / fused(own[l], tangent[l], 1.0));
            group.outer_radial = each(|l| law[l] * group.yields[l]);
        }
        if self.setup.contact_damping > 0.0 {
            self.rates_by_turning::<B>();
        }
    }

    /// What contact damping multiplies the forces with at the balls' rates.
    #[inline(always)]
    fn damping_factors<const B: usize>(&mut self) {
        let damping = self.outer.plain.damping;
        for group in first_mut::<B, _>(&mut self.balls.groups) {
            let rate = &group.rate;
            group.damping = each(|l| positive(1.0 + damping * rate[l]));
        }
    }

    /// Displacement of the race under the balls by their forces.
    #[inline(always)]
    fn displace_race<const B: usize>(&mut self) {
        let Some(coupling) = &self.residual else {
            return;
        };
        let groups = first_mut::<B, _>(&mut self.balls.groups);
        for group in &mut *groups {
            group.displaced = [0.0; LANES];
        }
        for number in 0..groups.len() {
            let force = groups[number].outer_radial;
            if is_zero(&force) {
                continue;
            }
            let columns = coupling.columns::<B>(number);
            for (place, group) in groups.iter_mut().enumerate() {
                group.displaced = with_columns(&group.displaced, columns.map(|column| &column[place]), &force);
            }
        }
    }

    /// The same, and a Jacobi sweep of the rates `r_i = v_i - sum G_ij (f'_j r_j + g_j)` with the laws of the last sweep, g what grows
    /// along waves or damage.
    #[inline(always)]
    fn displace_moving_race<const B: usize>(&mut self) {
        let Some(coupling) = &self.residual else {
            return;
        };
        let groups = first_mut::<B, _>(&mut self.balls.groups);
        for group in &mut *groups {
            group.displaced = [0.0; LANES];
            group.yielding = [0.0; LANES];
        }
        for number in 0..groups.len() {
            let group = &groups[number];
            let force = group.outer_radial;
            let (rate, tangent, growth) = (&group.rate, &group.law[1], &group.growth);
            let growing = each(|l| fused(tangent[l], rate[l], growth[l]));
            // not one without the other: a force may have gone in this sweep
            if is_zero(&force) && is_zero(&growing) {
                continue;
            }
            let columns = coupling.columns::<B>(number);
            for (place, group) in groups.iter_mut().enumerate() {
                let columns = columns.map(|column| &column[place]);
                group.displaced = with_columns(&group.displaced, columns, &force);
                group.yielding = with_columns(&group.yielding, columns, &growing);
            }
        }
        for group in groups {
            let (before, own, tangent) = (&group.rate, &group.own, &group.law[1]);
            let (approach, yielding, yields) = (&group.approach, &group.yielding, &group.yields);
            group.rate = each(|l| {
                let share = own[l] * tangent[l];
                fused(share, before[l], approach[l] - yielding[l]) * yields[l]
            });
        }
    }

    /// Forces at the displacements relative to the displaced race, and their derivatives by them.
    #[inline(always)]
    fn laws<const B: usize>(&mut self) {
        let stiffness = self.outer.plain.stiffness;
        for group in first_mut::<B, _>(&mut self.balls.groups) {
            let (gap, displaced, damping) = (&group.gap, &group.displaced, &group.damping);
            let overlap = each(|l| positive(gap[l] - displaced[l]));
            let root = each(|l| stiffness * damping[l] * overlap[l].sqrt());
            group.law = [each(|l| root[l] * overlap[l]), each(|l| 1.5 * root[l])];
        }
    }

    /// The same for ball `j` on waves or damage.
    #[inline(never)]
    fn uneven_law(&mut self, j: usize) {
        let (group, lane) = (j / LANES, j % LANES);
        let s = self.balls.groups[group].gap[lane] - self.balls.groups[group].displaced[lane];
        let rate = self.balls.groups[group].rate[lane];
        let same = SAME_TOUCH * self.setup.geometry.ball_radius();
        let moved = (s - self.work.touch[j].penetration).abs();
        // also where nothing was found yet
        if moved > same || moved.is_nan() {
            let (damage, place) = self.outer_place(j, s);
            self.outer.touch_into(damage, &place, &mut self.work.touch[j]);
        }
        let force = self.outer.force_by(&self.work.touch[j], s, rate);
        let group = &mut self.balls.groups[group];
        (group.law[0][lane], group.law[1][lane]) = (force.radial, force.tangent[0]);
        group.growth[lane] = force.growth;
    }

    /// Takes the residual's motion under the moving balls out of their rates: `dG/dtheta F` times the cage speed, with the
    /// forces at the start of the sweeps; and what each ball's own force moves there.
    #[inline(always)]
    fn rates_by_turning<const B: usize>(&mut self) {
        let speed = self.work.cage_speed;
        let Some(coupling) = &self.residual else {
            return;
        };
        let groups = first_mut::<B, _>(&mut self.balls.groups);
        for group in &mut *groups {
            group.approach = group.rate;
        }
        for number in 0..groups.len() {
            let force = &groups[number].outer_radial;
            let turning = each(|l| -(speed * force[l]));
            if is_zero(&turning) {
                continue;
            }
            let columns = coupling.slope_columns::<B>(number);
            for (place, group) in groups.iter_mut().enumerate() {
                group.approach = with_columns(&group.approach, columns.map(|column| &column[place]), &turning);
            }
        }
        for group in groups {
            let (approach, own, growth, yields) = (&group.approach, &group.own, &group.growth, &group.yields);
            group.rate = each(|l| fused(-own[l], growth[l], approach[l]) * yields[l]);
        }
    }

    /// Residual displacement at ball `j`: per unit of its own force, and from the others' forces.
    #[inline]
    pub(super) fn residual_shares(&self, j: usize) -> (f64, f64) {
        let Some(coupling) = &self.residual else {
            return (0.0, 0.0);
        };
        let forces = self.balls.all(|ball| &ball.outer_radial).enumerate();
        let others = forces.filter(|&(k, _)| k != j);
        (coupling.between(j, j), others.map(|(k, force)| coupling.between(j, k) * force).sum())
    }
}

/// A sum and the columns of four balls at the same place, each times a factor of its ball; none of the products waits for all others.
#[inline(always)]
fn with_columns(sum: &Lanes, [a, b, c, d]: [&Lanes; LANES], factors: &Lanes) -> Lanes {
    let [p, q, r, s] = *factors;
    each(|l| sum[l] + (fused(b[l], q, a[l] * p) + fused(d[l], s, c[l] * r)))
}

/// Whether none of them counts; what is not a number does.
#[inline(always)]
fn is_zero(factors: &Lanes) -> bool {
    factors.iter().all(|&factor| factor == 0.0)
}

#[inline(always)]
fn most(x: &Lanes) -> f64 {
    f64::max(f64::max(x[0], x[1]), f64::max(x[2], x[3]))
}

#[cfg(test)]
#[path = "with_residual_tests.rs"]
mod tests;
