//! The hot loop: all that is evaluated in every step. No allocation, O(balls x modes).

use super::bearing_setup::Formulation;
use super::coupled::CoupledSystem;
use super::inner::InnerGap;
use super::race::{Damage, RaceForce, RacePlace};
use super::raceway::reduced_turn;
use crate::bearing::RotationState;
use crate::dynamics::{Divergence, LinearCoordinate, SecondOrderSystem};

/// Sweeps over the balls that share the residual flexibility, far more than it takes.
const MAX_SWEEPS: usize = 40;

/// Relative change of a contact force at which the sweeps end; far below any integration error.
const SWEEP_TOLERANCE: f64 = 1e-11;

/// Relative change of a ball's displacement over which its force is continued by its tangent; the
/// error is its square.
const SAME_PLACE: f64 = 1e-7;

/// A ball that is farther from the race than this (m) cannot be reached by the residual
/// displacement that other balls cause: 1e-9 m/N under less than 100 N.
pub(super) const REACH: f64 = 1e-7;

impl SecondOrderSystem for CoupledSystem {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        let shaft = self.setup.cage.shaft().motion_from(&mut self.cursors[0], t);
        let cage = self.setup.cage.motion_from(&mut self.cursors[1], t);
        self.place_balls(&shaft, &cage);
        self.gaps(y);
        if self.setup.contact_damping > 0.0 {
            self.rates(&cage, y, v);
        }
        match self.residual {
            Some(_) => self.outer_forces_with_residual(&cage, y),
            None => self.outer_forces(y),
        }
        self.structure_force(g);
        let load = self.setup.shaft_load(t);
        self.shaft_and_ball_force(load, &shaft, &cage, y, v, g);
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
    /// Ball angles, directions and mode rows at a cage angle: one sine and cosine, the others by
    /// rotation through the fixed spacing.
    fn place_balls(&mut self, shaft: &RotationState, cage: &RotationState) {
        let modes = self.modes;
        let first = self.setup.cage.ball_angle(cage.angle, 0);
        let (sin, cos) = first.sin_cos();
        for j in 0..self.work.gap.len() {
            let [c, s] = self.work.spacing[j];
            self.work.direction[j] = [cos * c - sin * s, sin * c + cos * s];
            let angle = self.setup.cage.ball_angle(cage.angle, j as u32);
            self.work.angle[j] = angle;
            self.work.turn[j] = reduced_turn(angle);
            self.work.damage[j] = self.damage_at_the_outer_race(j, shaft, cage);
            let row = &mut self.work.rows[j * modes..(j + 1) * modes];
            self.radial.values_into(self.work.turn[j], row);
            if let Some(residual) = &mut self.residual {
                residual.place(j, self.work.turn[j]);
            }
        }
    }

    /// Turns the ball's flat to where it is, and says what the ball may feel at the outer race: a defect of the race before
    /// a flat of its own.
    #[inline]
    fn damage_at_the_outer_race(
        &mut self,
        j: usize,
        shaft: &RotationState,
        cage: &RotationState,
    ) -> Damage {
        let mut damage = Damage::None;
        if let Some(flat) = self.work.flat[j]
            && let Some((_, angle)) = self.setup.spin(j, shaft.angle)
        {
            let speed = cage.speed - self.setup.geometry.orders().ball_spin * shaft.speed;
            self.work.spin[j] = [angle, speed];
            if self.outer.feels(flat, angle) {
                damage = Damage::Flat(flat);
            }
        }
        let defect = self.outer.defect_at(self.work.direction[j]);
        defect.map_or(damage, Damage::Race)
    }

    /// Whether a ball is near enough to the race to be reached by what the other balls do, given its gap.
    #[inline]
    fn is_near(&self, j: usize) -> bool {
        self.work.gap[j] > -self.reach || self.work.damage[j] != Damage::None
    }

    /// Ball displacements relative to the race as the kept modes and the weight move it.
    fn gaps(&mut self, y: &[f64]) {
        let modes = self.modes;
        for j in 0..self.work.gap.len() {
            let row = &self.work.rows[j * modes..(j + 1) * modes];
            let weight = self.residual.as_ref().map_or(0.0, |r| r.weight(j));
            self.work.gap[j] =
                y[modes + 2 + j] + self.setup.oversize(j) - dot(row, &y[..modes]) - weight;
        }
    }

    /// Ball velocities relative to the race, for balls that touch or may touch: the race's radial
    /// velocity under a ball is `d/dt w(theta(t), t)`, with the part that comes from the ball moving
    /// along the deformed race. The static residual's part is added where it is known.
    fn rates(&mut self, cage: &RotationState, y: &[f64], v: &[f64]) {
        let modes = self.modes;
        for j in 0..self.work.gap.len() {
            self.work.rate[j] = if self.is_near(j) {
                let row = &self.work.rows[j * modes..(j + 1) * modes];
                let slopes = &mut self.work.scratch_row;
                self.radial.slopes_into(self.work.turn[j], slopes);
                let race = dot(row, &v[..modes]) + cage.speed * dot(slopes, &y[..modes]);
                let along = (self.inner_race.touching_radius + y[modes + 2 + j]) * cage.speed;
                [v[modes + 2 + j] - race, along]
            } else {
                [0.0, 0.0]
            };
        }
    }

    /// Outer force of ball `j` at the displacement `s` relative to the race.
    #[inline]
    fn outer_force(&mut self, j: usize, s: f64, y: &[f64]) -> RaceForce {
        let [rate, along] = self.work.rate[j];
        let damage = self.work.damage[j];
        if damage == Damage::None && !self.outer.is_wavy() {
            return self.outer.plain_force(s, rate);
        }
        let row = &mut self.work.scratch_row;
        self.tangential.values_into(self.work.turn[j], row);
        let radius = self.inner_race.touching_radius + y[self.modes + 2 + j];
        let shift = dot(row, &y[..self.modes]) / radius;
        let [spin, speed] = self.work.spin[j];
        let place = RacePlace {
            angle: self.work.angle[j] - shift,
            penetration: s,
            rate,
            along,
            spin: [spin + shift, speed],
            turning: 0.0,
        };
        self.outer.force(damage, &place)
    }

    fn outer_forces(&mut self, y: &[f64]) {
        for j in 0..self.work.gap.len() {
            let force = self.outer_force(j, self.work.gap[j], y);
            self.keep_outer(j, &force);
        }
    }

    /// Outer forces that deform the race through the residual flexibility `G`,
    /// `F_j = f(gap_j - sum G_jk F_k)`: Newton in a ball's own force, Gauss-Seidel over the balls.
    /// `G` is soft beside the contacts (a few percent), so each sweep gains nearly two digits; the
    /// start does not depend on the history. A force already known at nearly this displacement is
    /// continued along its tangent instead of being evaluated again.
    fn outer_forces_with_residual(&mut self, cage: &RotationState, y: &[f64]) {
        let balls = self.work.gap.len();
        self.work.outer_radial.fill(0.0);
        if let Some(residual) = &mut self.residual {
            let (work, reach) = (&self.work, self.reach);
            residual.couple(|j| work.gap[j] > -reach || work.damage[j] != Damage::None);
        }
        for j in 0..balls {
            let force = if self.is_near(j) {
                self.outer_force(j, self.work.gap[j], y)
            } else {
                RaceForce::default()
            };
            self.work.known[j] = (self.work.gap[j], force);
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
                let before = self.work.outer_radial[j];
                let s = self.work.gap[j] - others - own * before;
                let (at, mut force) = self.work.known[j];
                if (s - at).abs() > SAME_PLACE * s.abs() {
                    force = self.outer_force(j, s, y);
                    self.work.known[j] = (s, force);
                }
                let continued = force.radial + force.tangent[0] * (s - self.work.known[j].0);
                let step = (continued.max(0.0) - before) / (1.0 + own * force.tangent[0]);
                self.work.outer_radial[j] = before + step;
                change = change.max(step.abs());
                largest = largest.max(force.radial);
            }
            if change <= SWEEP_TOLERANCE * largest {
                break;
            }
        }
        for j in 0..balls {
            let force = self.work.known[j].1;
            self.work.outer_tangential[j] = force.tangential;
            self.work.outer_magnitude[j] = force.magnitude;
        }
    }

    /// Takes the residual's motion under the moving balls out of their rates: `dG/dtheta F` times the
    /// cage speed, with the forces on a race that gives way by each ball's own share alone. What
    /// changes with the forces in time, `G dF/dt`, is left out.
    fn residual_rates(&mut self, cage: &RotationState) {
        let Some(residual) = &self.residual else {
            return;
        };
        let work = &mut self.work;
        for j in 0..work.gap.len() {
            if work.gap[j] <= -self.reach && work.damage[j] == Damage::None {
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
            work.rate[j][0] -= cage.speed * moved;
        }
    }

    /// Residual displacement at ball `j`: per unit of its own force, and from the others' forces.
    #[inline]
    fn residual_shares(&self, j: usize) -> (f64, f64) {
        let Some(residual) = &self.residual else {
            return (0.0, 0.0);
        };
        let row = residual.contact_row(j);
        let forces = &self.work.outer_radial;
        let mut others = 0.0;
        for (k, (g, force)) in row.iter().zip(forces).enumerate() {
            if k != j {
                others += g * force;
            }
        }
        (row[j], others)
    }

    fn keep_outer(&mut self, j: usize, force: &RaceForce) {
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
                let row = &mut self.work.scratch_row;
                self.tangential.values_into(self.work.turn[j], row);
                add_scaled(&mut g[..modes], tangential, row);
            }
        }
    }

    /// Inner contacts, weight, unbalance and centrifugal load on shaft and balls.
    fn shaft_and_ball_force(
        &mut self,
        load: [f64; 2],
        shaft: &RotationState,
        cage: &RotationState,
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
        let mut total = load;
        let irregular = self.inner.is_irregular();
        let mass = self.setup.geometry.ball_mass();
        for j in 0..self.work.gap.len() {
            let e = self.work.direction[j];
            let (s, s_rate) = (y[modes + 2 + j], v[modes + 2 + j]);
            let mut gap = self.inner_race.gap(e, s, relative);
            gap.penetration += self.setup.oversize(j);
            let rho = self.inner_race.touching_radius + s;
            let mut along = 0.0;
            self.work.inner_force[j] = 0.0;
            if gap.penetration > 0.0 || irregular {
                let n = gap.normal;
                let turn = rho * cage.speed;
                let moving = [
                    s_rate * e[0] - turn * e[1] - velocity[0],
                    s_rate * e[1] + turn * e[0] - velocity[1],
                ];
                let approach = -(n[0] * moving[0] + n[1] * moving[1]);
                let force = if irregular {
                    let across = n[0] * moving[1] - n[1] * moving[0];
                    self.irregular_inner_force(j, &gap, [approach, across], shaft)
                } else {
                    self.inner.plain_force(gap.penetration, approach)
                };
                let on_race = [
                    force.radial * n[0] - force.tangential * n[1],
                    force.radial * n[1] + force.tangential * n[0],
                ];
                along = -(on_race[0] * e[0] + on_race[1] * e[1]);
                total[0] += on_race[0];
                total[1] += on_race[1];
                self.work.inner_force[j] = force.magnitude;
            }
            let gravity = self.setup.gravity;
            let frame = e[0] * (gravity[0] - centre_acceleration[0])
                + e[1] * (gravity[1] - centre_acceleration[1]);
            g[modes + 2 + j] =
                rho * cage.speed * cage.speed + (along - self.work.outer_radial[j]) / mass + frame;
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

impl CoupledSystem {
    /// Force of ball `j` on an inner race that carries waves or defects, or that may meet the ball's flat, for rates of the ball
    /// towards the race and along it, m/s.
    fn irregular_inner_force(
        &self,
        j: usize,
        gap: &InnerGap,
        [rate, along]: [f64; 2],
        shaft: &RotationState,
    ) -> RaceForce {
        let (e, n) = (self.work.direction[j], gap.normal);
        // from the radius vector about the bearing's centre to that about the shaft's
        let turned = (e[0] * n[1] - e[1] * n[0]).atan2(e[0] * n[0] + e[1] * n[1]);
        let (sin, cos) = shaft.angle.sin_cos();
        let in_the_race = [n[0] * cos + n[1] * sin, n[1] * cos - n[0] * sin];
        let [spin, speed] = self.work.spin[j];
        let flat = self.work.flat[j].filter(|&flat| self.inner.feels(flat, spin - turned));
        let damage = match (self.inner.defect_at(in_the_race), flat) {
            (Some(defect), _) => Damage::Race(defect),
            (None, Some(flat)) => Damage::Flat(flat),
            (None, None) => Damage::None,
        };
        let place = RacePlace {
            angle: self.work.angle[j] + turned - shaft.angle,
            penetration: gap.penetration,
            rate,
            along,
            spin: [spin - turned, speed],
            turning: shaft.speed,
        };
        self.inner.force(damage, &place)
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
