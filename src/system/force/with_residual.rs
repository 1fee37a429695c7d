//! Outer contacts on a race that also gives way by the static residual of the modes left out.

use super::super::coupled::CoupledSystem;
use super::super::lanes::LANES;
use super::super::race::RaceForce;
use crate::bearing::RotationState;

/// Sweeps over the balls that share the residual flexibility, far more than it takes.
pub(super) const MAX_SWEEPS: usize = 40;

/// Relative change of a contact force at which the sweeps end; far below any integration error.
pub(super) const SWEEP_TOLERANCE: f64 = 1e-11;

/// Relative change of a ball's displacement over which its force is continued by its tangent; the
/// error is its square.
const SAME_PLACE: f64 = 1e-7;

impl CoupledSystem {
    /// Outer forces that deform the race through the residual flexibility `G`,
    /// `F_j = f(gap_j - sum G_jk F_k)`: Newton in a ball's own force, Gauss-Seidel over the balls.
    /// `G` is soft beside the contacts (a few percent), so each sweep gains nearly two digits; the
    /// start does not depend on the history. A force already known at nearly this displacement is
    /// continued along its tangent instead of being evaluated again.
    pub(super) fn outer_forces_with_residual(&mut self, cage: &RotationState) {
        let balls = self.balls.count;
        self.clear_outer_radial();
        if let Some(residual) = &mut self.residual {
            let (balls, reach) = (&self.balls, self.reach);
            residual.couple(|j| balls.get(j, |ball| &ball.gap) > -reach);
        }
        for j in 0..balls {
            let gap = self.balls.get(j, |ball| &ball.gap);
            let force = if self.is_near(j) {
                self.outer_force(j, gap)
            } else {
                RaceForce::default()
            };
            self.work.known[j] = (gap, force);
        }
        if self.setup.contact_damping > 0.0 {
            self.residual_rates(cage);
        }
        for _ in 0..MAX_SWEEPS {
            let (mut change, mut largest): (f64, f64) = (0.0, 0.0);
            for j in 0..balls {
                if !self.is_near(j) {
                    continue;
                }
                let (own, others) = self.residual_shares(j);
                let before = self.balls.get(j, |ball| &ball.outer_radial);
                let s = self.balls.get(j, |ball| &ball.gap) - others - own * before;
                let (at, mut force) = self.work.known[j];
                if (s - at).abs() > SAME_PLACE * s.abs() {
                    force = self.outer_force(j, s);
                    self.work.known[j] = (s, force);
                }
                let continued = force.radial + force.tangent[0] * (s - self.work.known[j].0);
                let step = (continued.max(0.0) - before) / (1.0 + own * force.tangent[0]);
                self.balls
                    .set(j, |ball| &mut ball.outer_radial, before + step);
                change = change.max(step.abs());
                largest = largest.max(force.radial);
            }
            if change <= SWEEP_TOLERANCE * largest {
                break;
            }
        }
        for j in 0..balls {
            let force = self.work.known[j].1;
            self.balls
                .set(j, |ball| &mut ball.outer_tangential, force.tangential);
            self.balls
                .set(j, |ball| &mut ball.outer_magnitude, force.magnitude);
        }
    }

    pub(super) fn clear_outer_radial(&mut self) {
        for group in &mut self.balls.groups {
            group.outer_radial = [0.0; LANES];
        }
    }

    /// Takes the residual's motion under the moving balls out of their rates: `dG/dtheta F` times the
    /// cage speed, with the forces on a race that gives way by each ball's own share alone. What
    /// changes with the forces in time, `G dF/dt`, is left out.
    fn residual_rates(&mut self, cage: &RotationState) {
        let Some(residual) = &self.residual else {
            return;
        };
        let work = &self.work;
        for j in 0..self.balls.count {
            if self.balls.get(j, |ball| &ball.gap) <= -self.reach {
                continue;
            }
            let slopes = residual.contact_slope_row(j);
            let mut moved = 0.0;
            for (k, slope) in slopes.iter().enumerate() {
                let force = &work.known[k].1;
                if force.radial > 0.0 {
                    let own = residual.contact_row(k)[k];
                    moved += slope * force.radial / (1.0 + own * force.tangent[0]);
                }
            }
            let rate = self.balls.get(j, |ball| &ball.rate) - cage.speed * moved;
            self.balls.set(j, |ball| &mut ball.rate, rate);
        }
    }

    /// Residual displacement at ball `j`: per unit of its own force, and from the others' forces.
    #[inline]
    pub(super) fn residual_shares(&self, j: usize) -> (f64, f64) {
        let Some(residual) = &self.residual else {
            return (0.0, 0.0);
        };
        let row = residual.contact_row(j);
        let forces = self.balls.all(|ball| &ball.outer_radial);
        let mut others = 0.0;
        for (k, (g, force)) in row.iter().zip(forces).enumerate() {
            if k != j {
                others += g * force;
            }
        }
        (row[j], others)
    }
}
