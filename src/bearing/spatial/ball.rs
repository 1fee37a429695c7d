//! One ball between the grooves: forces in its plane, and the place where it is in equilibrium.
//!
//! ```text
//! ω_c = ω (1 − γ' cos α_i) / (1 + cos(α_i − α_o))      tan β = sin α_o / (cos α_o + γ')      γ' = D / d_m
//! F_c = m ω_c² ρ                                       M_g = J ω_R ω_c sin β = (m D d_m / 10) ω_c² sin α_o
//! ```
//!
//! Speeds are those of outer race control: the ball rolls at both contacts and does not spin at the outer one (T. A. Harris, *Rolling
//! Bearing Analysis*, 4th edition, (8.53) to (8.63); J = m D² / 10). The gyroscopic moment is carried by friction: λ_o M_g / D at
//! the outer contact and λ_i M_g / D at the inner one, in the plane, across the contacts.
//!
//! Sign: with the inner ring turning, the ball spins about an axis that points outwards and towards −z for α > 0. The rate of its angular
//! momentum, ω_c × J ω_R, needs a friction that pushes the ball towards −z at the outer contact and towards +z at the inner one. In Harris's
//! formulas the same sign comes from ω_R, which is negative for a turning inner ring (8.57).

use super::contact::{GrooveContact, GrooveState};
use super::groove::Grooves;
use super::ring::BallPlane;
use crate::bearing::error::BearingError;
use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Newton steps before the search for a ball's place gives up; 4 to 8 are typical.
const MAX_ITERATIONS: usize = 80;

/// Halvings of a step: 2^-40 of a groove's radius is below round-off.
const HALVINGS: usize = 40;

/// Force out of balance that counts as none, relative to the forces on the ball.
const FORCE_TOLERANCE: f64 = 1e-13;

/// The same where steps no longer halve it: the accuracy of the Hertz constants is ten times less.
const SETTLED: f64 = 1e-11;

/// Passes that set a ball between its races: every one is a hundred times as accurate as the one before. Where a ball is about to touch,
/// fewer would set it against one race alone, out of balance.
const PLACINGS: usize = 12;

/// How soon the contact angle that a ball's speeds belong to turns to that of the outer race where the inner contact is lost: by its gap
/// times this, against the groove's seat. Any value keeps the speeds continuous.
const LOST: f64 = 4.0;

/// How the friction that carries a ball's gyroscopic moment is shared between the races.
///
/// It is the rule of Jones (1959) and Harris (9.14): the pitch angle of the ball is that of outer race control either way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RaceControl {
    /// All of it at the outer race: λ_o = 2, λ_i = 0.
    #[default]
    Outer,
    /// Half of it at each race: λ_o = λ_i = 1.
    Shared,
}

impl RaceControl {
    /// λ_i and λ_o.
    pub(crate) fn shares(self) -> [f64; 2] {
        match self {
            Self::Outer => [0.0, 2.0],
            Self::Shared => [1.0, 1.0],
        }
    }
}

/// What acts on every ball of a bearing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BallLaw {
    pub grooves: Grooves,
    pub inner: GrooveContact,
    pub outer: GrooveContact,
    /// m, kg.
    pub mass: f64,
    /// D, m.
    pub diameter: f64,
    /// d_m, m.
    pub pitch_diameter: f64,
    pub race_control: RaceControl,
}

/// Speeds of a ball, rad/s, with the derivatives of ω_c by the contact angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallSpeeds {
    /// Orbital speed ω_c.
    pub orbit: f64,
    /// By α_i and α_o.
    orbit_by: [f64; 2],
    /// Speed about the ball's own axis against the cage, ω_R.
    pub spin: f64,
    /// Pitch angle β, rad.
    pub pitch: f64,
}

/// Forces on a ball in its plane: u by the place against the outer groove, y by that which the inner ring sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlaneForces {
    pub inner: GrooveState,
    pub outer: GrooveState,
    /// Force along u, then along y, N.
    pub force: Vector4<f64>,
    /// Its derivatives by u, then by y, N/m.
    pub tangent: Matrix4<f64>,
    /// Moment of the inner friction on the inner ring about the ball's centre, N m, around; and its derivatives by u and y, N.
    pub couple: f64,
    pub couple_by: Vector4<f64>,
    pub speeds: BallSpeeds,
    /// Centrifugal force, N, and gyroscopic moment, N m.
    pub centrifugal: f64,
    pub gyroscopic: f64,
}

impl BallLaw {
    /// Speeds at contact angles with these `[cos, sin]`, for an inner ring that turns at `speed`.
    #[inline]
    pub(crate) fn speeds(&self, inner: Vector2<f64>, outer: Vector2<f64>, speed: f64) -> BallSpeeds {
        let ratio = self.diameter / self.pitch_diameter;
        let (rolling, both) = (1.0 - ratio * inner.x, 1.0 + inner.dot(&outer));
        // sine of α_i − α_o
        let apart = inner.y * outer.x - inner.x * outer.y;
        let orbit = speed * rolling / both;
        let by_distance = orbit * apart / both;
        let axis = Vector2::new(outer.x + ratio, outer.y);
        BallSpeeds {
            orbit,
            orbit_by: [speed * ratio * inner.y / both + by_distance, -by_distance],
            spin: orbit * axis.norm() / ratio,
            pitch: axis.y.atan2(axis.x),
        }
    }

    /// Forces at a place `u` (radial from ρ_o, axial) that the inner ring sees at `y`.
    #[inline]
    pub(crate) fn forces(&self, u: Vector2<f64>, y: Vector2<f64>, speed: f64) -> PlaneForces {
        let outer = self.outer.at(u);
        let inner = self.inner.at(y - Vector2::new(self.grooves.radial_gap, self.grooves.axial_gap));
        let mut forces = PlaneForces {
            inner,
            outer,
            force: Vector4::new(-outer.gradient.x, -outer.gradient.y, -inner.gradient.x, -inner.gradient.y),
            tangent: Matrix4::zeros(),
            couple: 0.0,
            couple_by: Vector4::zeros(),
            speeds: BallSpeeds { orbit: 0.0, orbit_by: [0.0; 2], spin: 0.0, pitch: 0.0 },
            centrifugal: 0.0,
            gyroscopic: 0.0,
        };
        forces.tangent.fixed_view_mut::<2, 2>(0, 0).copy_from(&-outer.hessian);
        forces.tangent.fixed_view_mut::<2, 2>(2, 2).copy_from(&-inner.hessian);
        if speed.abs() > 0.0 {
            self.add_inertia(&mut forces, u, speed);
        }
        forces
    }

    fn add_inertia(&self, forces: &mut PlaneForces, u: Vector2<f64>, speed: f64) {
        let (n_i, n_o) = (forces.inner.direction, forces.outer.direction);
        // contact angles by u and y
        let mut a_i = Vector4::new(0.0, 0.0, n_i.y, -n_i.x) / forces.inner.distance;
        let a_o = Vector4::new(-n_o.y, n_o.x, 0.0, 0.0) / forces.outer.distance;
        let mut rolling = n_i;
        let gap = -LOST * forces.inner.penetration;
        if gap > 0.0 {
            // a ball without inner contact follows the outer race the more the farther it is from the inner one
            let towards = forces.inner.distance * n_i + gap * n_o;
            let length = towards.norm().max(f64::MIN_POSITIVE);
            rolling = towards / length;
            let across = Vector2::new(-rolling.y, rolling.x) / length;
            let by_y = LOST * across.dot(&n_o) * n_i - across;
            a_i = gap * across.dot(&Vector2::new(-n_o.y, n_o.x)) * a_o + Vector4::new(0.0, 0.0, by_y.x, by_y.y);
        }
        let speeds = self.speeds(rolling, n_o, speed);
        forces.speeds = speeds;
        let square = speeds.orbit * speeds.orbit;
        let square_by = 2.0 * speeds.orbit * (speeds.orbit_by[0] * a_i + speeds.orbit_by[1] * a_o);

        let radius = self.grooves.outer_centres + u.x;
        forces.centrifugal = self.mass * square * radius;
        forces.force.x += forces.centrifugal;
        let by = self.mass * (radius * square_by + square * Vector4::x());
        add_row(&mut forces.tangent, 0, by);

        let inertia = 0.1 * self.mass * self.diameter * self.pitch_diameter;
        let moment = inertia * square * n_o.y;
        let moment_by = inertia * (n_o.y * square_by + square * n_o.x * a_o);
        forces.gyroscopic = moment;
        let [l_i, l_o] = self.race_control.shares().map(|share| share / self.diameter);
        // friction across the contacts: (sin α_o, −cos α_o) at the outer one, (−sin α_i, cos α_i) at the inner one
        for (row, arm, friction, friction_by, angle) in [
            (0, l_o, Vector2::new(n_o.y, -n_o.x), n_o, a_o),
            (2, l_i, Vector2::new(-rolling.y, rolling.x), -rolling, a_i),
        ] {
            for axis in 0..2 {
                forces.force[row + axis] += arm * moment * friction[axis];
                let by = arm * (friction[axis] * moment_by + moment * friction_by[axis] * angle);
                add_row(&mut forces.tangent, row + axis, by);
            }
        }
        let share = -0.5 * self.race_control.shares()[0];
        forces.couple = share * moment;
        forces.couple_by = share * moment_by;
    }

    /// The place (radial from ρ_o, axial) at which the ball is in equilibrium.
    ///
    /// Without speed, a ball that does not touch both races is set between them.
    ///
    /// # Errors
    /// [`BearingError`] where the search does not end, with the force out of balance.
    pub(crate) fn place(&self, plane: &BallPlane, speed: f64) -> Result<Vector2<f64>, BearingError> {
        let start = match self.start(plane, speed) {
            Start::Free(place) => return Ok(place),
            Start::At(place) => place,
        };
        let failed = match self.newton(plane, start, speed) {
            Ok(place) => return Ok(place),
            Err(failed) => failed,
        };
        // the contact angles part with the speed: from rest to it in steps
        let mut place = match self.start(plane, 0.0) {
            Start::Free(place) | Start::At(place) => place,
        };
        for step in 1..=20 {
            place = self.newton(plane, place, speed * f64::from(step) / 20.0).map_err(|_| failed.clone())?;
        }
        Ok(place)
    }

    /// Where the search for the place begins.
    fn start(&self, plane: &BallPlane, speed: f64) -> Start {
        let [inner_seat, outer_seat] = self.grooves.seats;
        let gap = Vector2::new(self.grooves.radial_gap, self.grooves.axial_gap);
        let no_angle = Vector2::new(1.0, 0.0);
        let orbit = self.speeds(no_angle, no_angle, speed).orbit;
        let pressed = self.mass * orbit * orbit * (self.grooves.outer_centres + outer_seat);
        let depth = (pressed / self.outer.stiffness.at(1.0)[0]).powf(2.0 / 3.0);
        let alone = Vector2::new(outer_seat + depth, 0.0);
        if speed.abs() > 0.0 && self.inner.at(plane.seen(alone).place - gap).penetration <= 0.0 {
            return Start::At(alone);
        }
        // the inner groove's centre as the ball's plane has it; a tilt makes it depend on the place by some per cent
        let (mut place, mut free) = (alone, false);
        for _ in 0..PLACINGS {
            let before = place;
            let line = gap - (plane.seen(place).place - place);
            let distance = line.norm().max(f64::MIN_POSITIVE);
            let direction = line / distance;
            let approach = distance - self.grooves.centre_distance;
            let [k_i, k_o] = [&self.inner, &self.outer].map(|contact| contact.stiffness.at(direction.x)[0]);
            let share = 1.0 / (1.0 + (k_o / k_i).powf(2.0 / 3.0));
            if speed.abs() > 0.0 {
                // the outer one of two places at which the ball is pressed into both races, by the rings and by its inertia
                let both = approach.max(0.0);
                let [inner, outer] = [inner_seat + depth + (1.0 - share) * both, outer_seat + depth + share * both];
                let along = (distance * distance + outer * outer - inner * inner) / (2.0 * distance);
                let across = (outer * outer - along * along).max(0.0).sqrt();
                let side = Vector2::new(direction.y, -direction.x);
                place = along * direction + if side.x < 0.0 { -across } else { across } * side;
            } else if approach > 0.0 {
                place = (outer_seat + share * approach) * direction;
            } else {
                place = (outer_seat + 0.5 * approach) * direction;
            }
            free = speed.abs() <= 0.0 && approach <= 0.0;
            if (place - before).norm() <= f64::EPSILON * outer_seat {
                break;
            }
        }
        if free { Start::Free(place) } else { Start::At(place) }
    }

    fn newton(&self, plane: &BallPlane, start: Vector2<f64>, speed: f64) -> Result<Vector2<f64>, BearingError> {
        let mut place = start;
        let mut at = self.balance(plane, place, speed);
        let mut before = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let error = at.force.norm();
            let round_off = 4.0 * f64::EPSILON * place.norm() * at.stiffness.norm();
            let settled = error <= round_off.max(SETTLED * at.scale) && error > 0.5 * before;
            if error <= FORCE_TOLERANCE * at.scale || settled {
                return Ok(place);
            }
            before = error;
            let Some(mut step) = self.step(&at) else { break };
            for halving in 0..=HALVINGS {
                let trial = self.balance(plane, place + step, speed);
                // Newton's direction lowers the force; in round-off any step is as good
                if trial.force.norm() < error || error <= round_off || halving == HALVINGS {
                    place += step;
                    at = trial;
                    break;
                }
                step *= 0.5;
            }
        }
        Err(BearingError(format!(
            "finds no place between the races: {:.3e} N of {:.3e} N stay out of balance; \
             lower the speed, or change load, tilt or play",
            at.force.norm(),
            at.scale
        )))
    }

    /// Newton's step, no longer than a tenth of the contact distance; along the force where the stiffness is singular.
    fn step(&self, at: &Balance) -> Option<Vector2<f64>> {
        let newton = at.stiffness.lu().solve(&at.force);
        let most = 0.1 * self.grooves.centre_distance;
        let mut step = newton.unwrap_or(most / at.force.norm() * at.force);
        let length = step.norm();
        if length > most {
            step *= most / length;
        }
        length.is_finite().then_some(step)
    }

    fn balance(&self, plane: &BallPlane, place: Vector2<f64>, speed: f64) -> Balance {
        let seen = plane.seen(place);
        let forces = self.forces(place, seen.place, speed);
        let y = forces.force.fixed_rows::<2>(2);
        let (outer, inner) = (forces.tangent.fixed_view::<2, 2>(0, 0), forces.tangent.fixed_view::<2, 2>(2, 2));
        let (by_y, by_u) = (forces.tangent.fixed_view::<2, 2>(0, 2), forces.tangent.fixed_view::<2, 2>(2, 0));
        let through = seen.slope.transpose();
        Balance {
            force: forces.force.fixed_rows::<2>(0) + through * y,
            stiffness: -(outer + by_y * seen.slope + through * (by_u + inner * seen.slope) + y[0] * seen.bend),
            scale: forces.inner.load + forces.outer.load + forces.centrifugal,
        }
    }
}

enum Start {
    /// A ball without speed that does not touch both races.
    Free(Vector2<f64>),
    At(Vector2<f64>),
}

/// Force on a ball in its plane, its stiffness, and what forces are measured by.
struct Balance {
    force: Vector2<f64>,
    stiffness: Matrix2<f64>,
    scale: f64,
}

fn add_row(tangent: &mut Matrix4<f64>, row: usize, values: Vector4<f64>) {
    for column in 0..4 {
        tangent[(row, column)] += values[column];
    }
}
