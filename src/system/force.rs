//! The hot loop: all that is evaluated in every step. No allocation, O(balls x modes).

use super::bearing_setup::Formulation;
use super::coupled::CoupledSystem;
use super::outer::OuterForce;
use crate::bearing::ShaftMotion;
use crate::dynamics::{Divergence, LinearCoordinate, SecondOrderSystem};

/// Sweeps over the balls that share the residual flexibility; three are typical, each gains two
/// digits.
const MAX_SWEEPS: usize = 40;

/// Relative change of a contact force at which the sweeps end.
const SWEEP_TOLERANCE: f64 = 1e-13;

impl SecondOrderSystem for CoupledSystem {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        let shaft = self.setup.speed.motion_from(&mut self.cursor, t);
        let cage = self.setup.cage.motion(shaft);
        self.place_balls(&cage);
        self.gaps(y);
        if self.setup.contact_damping > 0.0 {
            self.rates(&cage, y, v);
        }
        match self.residual {
            Some(_) => self.outer_forces_with_residual(y),
            None => self.outer_forces(y),
        }
        self.structure_force(g);
        self.shaft_and_ball_force(&shaft, &cage, y, v, g);
    }

    fn check(&self, y: &[f64], v: &[f64]) -> Result<(), Divergence> {
        if !y.iter().chain(v).all(|value| value.is_finite()) {
            return Err(Divergence::NotFinite);
        }
        // beyond half a ball radius neither Hertz theory nor the geometry holds
        let limit = 0.5 * self.setup.geometry.ball_radius();
        let positions = &y[self.modes..];
        let name = |place: usize| match place {
            0 => "shaft displacement x".to_owned(),
            1 => "shaft displacement y".to_owned(),
            ball => format!("radial displacement of ball {}", ball - 1),
        };
        match positions.iter().position(|value| value.abs() > limit) {
            Some(place) => Err(Divergence::OutOfRange {
                what: name(place),
                value: positions[place],
                limit,
                unit: "m",
            }),
            None => Ok(()),
        }
    }
}

impl CoupledSystem {
    /// Ball angles, directions and mode rows at a cage angle.
    fn place_balls(&mut self, cage: &ShaftMotion) {
        let modes = self.modes;
        for (j, row) in self.work.rows.chunks_exact_mut(modes.max(1)).enumerate() {
            let angle = self.setup.cage.ball_angle(cage.angle, j as u32);
            let (sin, cos) = angle.sin_cos();
            self.work.angle[j] = angle;
            self.work.direction[j] = [cos, sin];
            self.radial.values_into(angle, row);
        }
        if let Some(residual) = &mut self.residual {
            residual.turn_to(self.work.angle[0]);
        }
    }

    /// Ball displacements relative to the race as the kept modes and the weight move it.
    fn gaps(&mut self, y: &[f64]) {
        let (q, s) = (&y[..self.modes], &y[self.modes + 2..]);
        for (j, row) in self.work.rows.chunks_exact(self.modes.max(1)).enumerate() {
            let weight = self.residual.as_ref().map_or(0.0, |r| r.weight(j));
            self.work.gap[j] = s[j] - dot(row, q) - weight;
        }
    }

    /// Ball velocities relative to the race, for balls that touch or may touch.
    fn rates(&mut self, cage: &ShaftMotion, y: &[f64], v: &[f64]) {
        let (modes, touching) = (self.modes, self.inner.touching_radius);
        let (s, s_rate) = (&y[modes + 2..], &v[modes + 2..]);
        for (j, row) in self.work.rows.chunks_exact(modes.max(1)).enumerate() {
            self.work.rate[j] = if self.work.gap[j] > 0.0 {
                let along = (touching + s[j]) * cage.speed;
                [s_rate[j] - dot(row, &v[..modes]), along]
            } else {
                [0.0, 0.0]
            };
        }
    }

    /// Tangential displacement of the race under ball `j` and the row it came from.
    fn tangential_shift(&mut self, j: usize, y: &[f64]) -> f64 {
        let row = &mut self.work.tangential_row;
        self.tangential.values_into(self.work.angle[j], row);
        dot(row, &y[..self.modes])
    }

    /// Angle at which the displaced race sees ball `j`.
    fn angle_on_race(&mut self, j: usize, y: &[f64]) -> f64 {
        let angle = self.work.angle[j];
        if self.outer.dent_at(angle).is_none() {
            return angle;
        }
        let shift = self.tangential_shift(j, y);
        angle - shift / (self.inner.touching_radius + y[self.modes + 2 + j])
    }

    fn outer_forces(&mut self, y: &[f64]) {
        for j in 0..self.work.gap.len() {
            let angle = self.angle_on_race(j, y);
            let force = self.outer.force(angle, self.work.gap[j], self.work.rate[j]);
            self.keep_outer(j, &force);
        }
    }

    /// Outer forces that deform the race through the residual flexibility: Gauss-Seidel over the
    /// balls, Newton within a ball. The residual is stiff against the contacts, so it converges
    /// fast; the start does not depend on the history.
    fn outer_forces_with_residual(&mut self, y: &[f64]) {
        let balls = self.work.gap.len();
        self.work.outer_radial.fill(0.0);
        for sweep in 0..MAX_SWEEPS {
            let mut change: f64 = 0.0;
            let mut largest: f64 = 0.0;
            for j in 0..balls {
                let (own, others) = self.residual_shares(j);
                let gap = self.work.gap[j] - others;
                // a ball that stays off the race needs no more
                let dented = self.outer.dent_at(self.work.angle[j]).is_some();
                if gap <= 0.0 && !dented {
                    change = change.max(self.work.outer_radial[j].abs());
                    self.keep_outer(j, &OuterForce::default());
                    continue;
                }
                let angle = self.angle_on_race(j, y);
                let force = self.solve_ball(angle, gap, self.work.rate[j], own);
                change = change.max((force.radial - self.work.outer_radial[j]).abs());
                largest = largest.max(force.radial.abs());
                self.keep_outer(j, &force);
            }
            if change <= SWEEP_TOLERANCE * largest || (sweep == 0 && largest == 0.0) {
                break;
            }
        }
    }

    /// Residual displacement at ball `j`: per unit of its own force, and from the others' forces.
    fn residual_shares(&self, j: usize) -> (f64, f64) {
        let Some(residual) = &self.residual else {
            return (0.0, 0.0);
        };
        let row = residual.contact_row(j);
        let forces = &self.work.outer_radial;
        (row[j], dot(row, forces) - row[j] * forces[j])
    }

    /// Force of one ball on a race that gives way by `softness` (m/N): `F = f(gap - softness F)`.
    fn solve_ball(&self, angle: f64, gap: f64, rate: [f64; 2], softness: f64) -> OuterForce {
        let mut s = gap;
        let mut force = self.outer.force(angle, s, rate);
        for _ in 0..MAX_SWEEPS {
            let error = s + softness * force.radial - gap;
            if error.abs() <= SWEEP_TOLERANCE * gap.abs() {
                break;
            }
            s -= error / (1.0 + softness * force.tangent[0]);
            force = self.outer.force(angle, s, rate);
        }
        force
    }

    fn keep_outer(&mut self, j: usize, force: &OuterForce) {
        self.work.outer_radial[j] = force.radial;
        self.work.outer_tangential[j] = force.tangential;
        self.work.outer_magnitude[j] = force.magnitude;
    }

    /// Weight and contact forces on the kept modes.
    fn structure_force(&mut self, g: &mut [f64]) {
        let modes = self.modes;
        g[..modes].copy_from_slice(&self.gravity);
        for j in 0..self.work.gap.len() {
            let (radial, tangential) = (self.work.outer_radial[j], self.work.outer_tangential[j]);
            if radial != 0.0 {
                let row = &self.work.rows[j * modes..(j + 1) * modes];
                add_scaled(&mut g[..modes], radial, row);
            }
            if tangential != 0.0 {
                let row = &mut self.work.tangential_row;
                self.tangential.values_into(self.work.angle[j], row);
                add_scaled(&mut g[..modes], tangential, row);
            }
        }
    }

    /// Inner contacts, weight, unbalance and centrifugal load on shaft and balls.
    fn shaft_and_ball_force(
        &mut self,
        shaft: &ShaftMotion,
        cage: &ShaftMotion,
        y: &[f64],
        v: &[f64],
        g: &mut [f64],
    ) {
        let modes = self.modes;
        let printed = self.setup.formulation == Formulation::Printed;
        let (mut centre, mut centre_rate, mut centre_acceleration) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        if printed {
            for k in 0..2 {
                let row = &self.centre[k];
                centre[k] = dot(row, &y[..modes]);
                centre_rate[k] = dot(row, &v[..modes]);
                centre_acceleration[k] = (0..modes)
                    .map(|i| {
                        let linear = self.linear[i];
                        let pull = linear.damping * v[i] + linear.squared_frequency * y[i];
                        row[i] * (g[i] - pull)
                    })
                    .sum();
            }
        }
        let relative = [y[modes] - centre[0], y[modes + 1] - centre[1]];
        let velocity = [v[modes] - centre_rate[0], v[modes + 1] - centre_rate[1]];
        let mut total = self.setup.shaft_load();
        let mass = self.setup.geometry.ball_mass();
        for j in 0..self.work.gap.len() {
            let e = self.work.direction[j];
            let (s, s_rate) = (y[modes + 2 + j], v[modes + 2 + j]);
            let gap = self.inner.gap(e, s, relative);
            let rho = self.inner.touching_radius + s;
            let mut force = 0.0;
            let mut along = 0.0;
            if gap.penetration > 0.0 {
                let n = gap.normal;
                let turn = rho * cage.speed;
                let approach = n[0] * (s_rate * e[0] - turn * e[1] - velocity[0])
                    + n[1] * (s_rate * e[1] + turn * e[0] - velocity[1]);
                force = self.inner.law.force(gap.penetration, -approach);
                along = force * (n[0] * e[0] + n[1] * e[1]);
                total[0] -= force * n[0];
                total[1] -= force * n[1];
            }
            self.work.inner_force[j] = force;
            let gravity = self.setup.gravity;
            let frame = e[0] * (gravity[0] - centre_acceleration[0])
                + e[1] * (gravity[1] - centre_acceleration[1]);
            g[modes + 2 + j] = rho * cage.speed * cage.speed
                + (along - self.work.outer_radial[j]) / mass
                + frame;
        }
        let unbalance = self.setup.shaft.unbalance;
        if unbalance != 0.0 {
            let (sin, cos) = shaft.angle.sin_cos();
            let (centrifugal, tangential) = (
                unbalance * shaft.speed * shaft.speed,
                unbalance * shaft.acceleration,
            );
            total[0] += centrifugal * cos + tangential * sin;
            total[1] += centrifugal * sin - tangential * cos;
        }
        g[modes] = total[0] / self.setup.shaft.mass;
        g[modes + 1] = total[1] / self.setup.shaft.mass;
    }
}

#[inline]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    // four sums side by side: the order is fixed, and the compiler can use vector registers
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4
        .remainder()
        .iter()
        .zip(b4.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[inline]
fn add_scaled(sum: &mut [f64], factor: f64, row: &[f64]) {
    for (total, value) in sum.iter_mut().zip(row) {
        *total += factor * value;
    }
}
