//! The reduced potential of shaft and balls: its slope and curvature at given positions.
//!
//! What an equilibrium is asked for.

use super::search::{Evaluation, Potential};
use crate::numerics::linalg::DenseMatrix;
use crate::system::race::RaceForce;
use crate::system::resting::RestingRaces;
use crate::system::{BearingSetup, Formulation, Pressed, Structure, SystemError};
use nalgebra::{DMatrix, DVector};

/// What the contacts of a bearing carry, ball by ball.
pub(super) struct PlaneContacts {
    /// Magnitudes at the inner race, N.
    pub inner: Vec<f64>,
    pub outer: Vec<RaceForce>,
}

/// A bearing in its structure, the cage at rest.
pub(super) struct Problem<'a> {
    pub setup: &'a BearingSetup,
    races: RestingRaces,
    pub condition: StaticCondition,
    pub angles: Vec<f64>,
    /// Flexibility at the contacts [2 balls x 2 balls], radial then tangential a ball, m/N.
    flexibility: DMatrix<f64>,
    /// Displacement there under the structure's weight [2 balls], m.
    weight: DVector<f64>,
    /// Displacement of the race under the balls [2 balls], the start of the next inner solution.
    race: DVector<f64>,
}

impl<'a> Problem<'a> {
    /// The problem, and the loads behind it: unit contact forces, then the weight [dof x 2 balls + 1].
    pub(super) fn new(
        structure: &Structure,
        setup: &'a BearingSetup,
        condition: StaticCondition,
    ) -> Result<(Self, DenseMatrix), SystemError> {
        let balls = setup.balls();
        let angles: Vec<f64> = (0..balls).map(|j| setup.cage.ball_angle(condition.cage_angle, j as u32)).collect();
        let rows = contact_rows(structure, setup, &angles);
        let weighted = setup.formulation == Formulation::Consistent;
        let loads =
            DenseMatrix::from_fn(structure.dof(), 2 * balls + 1, |row, column| match column.checked_sub(2 * balls) {
                None => rows[(row, column)],
                Some(_) if weighted => structure.gravity()[row],
                Some(_) => 0.0,
            });
        let responses = structure.static_response(&loads)?;
        let at_contacts = rows.transpose() * &responses;
        Ok((
            Self {
                races: RestingRaces::new(setup, condition.shaft_angle),
                setup,
                angles,
                condition,
                flexibility: DMatrix::from_fn(2 * balls, 2 * balls, |i, j| at_contacts[(i, j)]),
                weight: DVector::from_fn(2 * balls, |i, _| at_contacts[(i, 2 * balls)]),
                race: DVector::zeros(2 * balls),
            },
            loads,
        ))
    }

    /// Outer contact forces for given ball positions, and their derivatives [balls x balls] with
    /// the structure following.
    fn outer_forces(&mut self, z: &DVector<f64>) -> (Vec<RaceForce>, DMatrix<f64>) {
        let balls = self.angles.len();
        let at = |race: &DVector<f64>| -> (Vec<RaceForce>, DVector<f64>) {
            let forces: Vec<RaceForce> = (0..balls)
                .map(|j| {
                    let s = z[2 + j];
                    let shift = race[2 * j + 1] / (self.touching_radius() + s);
                    self.races.outer_force(j, self.angles[j], shift, s - race[2 * j])
                })
                .collect();
            let vector = DVector::from_fn(2 * balls, |i, _| match i % 2 {
                0 => forces[i / 2].radial,
                _ => forces[i / 2].tangential,
            });
            let error = race - &self.weight - &self.flexibility * &vector;
            (forces, error)
        };
        let mut race = self.race.clone();
        let (mut forces, mut error) = at(&race);
        let mut tangent = self.tangent(&forces);
        for _ in 0..60 {
            // 1e-20 m is below round-off of any displacement that matters here
            if error.amax() <= 1e-13 * race.amax() + 1e-20 {
                break;
            }
            let jacobian = DMatrix::identity(2 * balls, 2 * balls) + &self.flexibility * &tangent;
            let Some(mut step) = jacobian.lu().solve(&error) else {
                break;
            };
            let size = error.norm();
            // the error falls along Newton's direction; past round-off any step is as good
            loop {
                let trial = &race - &step;
                let (trial_forces, trial_error) = at(&trial);
                if trial_error.norm() < size || step.amax() < 1e-18 {
                    (race, forces, error) = (trial, trial_forces, trial_error);
                    break;
                }
                step *= 0.5;
            }
            tangent = self.tangent(&forces);
        }
        let follow = DMatrix::identity(2 * balls, 2 * balls) + &tangent * &self.flexibility;
        let stiffness = follow.lu().solve(&tangent).unwrap_or(tangent);
        self.race = race;
        let radial =
            DMatrix::from_fn(balls, balls, |i, j| 0.5 * (stiffness[(2 * i, 2 * j)] + stiffness[(2 * j, 2 * i)]));
        (forces, radial)
    }

    fn tangent(&self, forces: &[RaceForce]) -> DMatrix<f64> {
        let mut tangent = DMatrix::zeros(2 * forces.len(), 2 * forces.len());
        for (j, force) in forces.iter().enumerate() {
            let [rr, rt, tt] = force.tangent;
            tangent.view_mut((2 * j, 2 * j), (2, 2)).copy_from_slice(&[rr, rt, rt, tt]);
        }
        tangent
    }
}

impl Potential for Problem<'_> {
    type Contacts = PlaneContacts;

    fn evaluate(&mut self, z: &DVector<f64>) -> Evaluation<PlaneContacts> {
        let balls = self.angles.len();
        let (outer, stiffness) = self.outer_forces(z);
        let mut gradient = DVector::zeros(2 + balls);
        let mut hessian = DMatrix::zeros(2 + balls, 2 + balls);
        gradient[0] = -self.condition.load[0];
        gradient[1] = -self.condition.load[1];
        let mass = self.setup.geometry.ball_mass();
        let mut inner = vec![0.0; balls];
        for j in 0..balls {
            let (sin, cos) = self.angles[j].sin_cos();
            let s = z[2 + j];
            let rho = self.races.inner_race.touching_radius + s;
            let weight = mass * (self.setup.gravity[0] * cos + self.setup.gravity[1] * sin);
            let spin = self.condition.cage_speed.powi(2);
            gradient[2 + j] = outer[j].radial - weight - mass * spin * rho;
            hessian[(2 + j, 2 + j)] -= mass * spin;
            for k in 0..balls {
                hessian[(2 + j, 2 + k)] += stiffness[(j, k)];
            }
            let contact = self.races.inner_contact(j, self.angles[j], s, [z[0], z[1]]);
            inner[j] = contact.magnitude;
            if contact.magnitude > 0.0 {
                let place = [0, 1, 2 + j];
                for a in 0..3 {
                    gradient[place[a]] += contact.slope[a];
                    for b in 0..3 {
                        hessian[(place[a], place[b])] += contact.curvature[a][b];
                    }
                }
            }
        }
        Evaluation { gradient, hessian, contacts: PlaneContacts { inner, outer } }
    }

    /// Distance of a ball that touches the outer race from the bearing's centre, m.
    fn touching_radius(&self) -> f64 {
        self.races.inner_race.touching_radius
    }

    /// Force that others are measured by, N: the load, at least a ball's weight, for a shaft without load in a preloaded
    /// bearing.
    fn force_scale(&self) -> f64 {
        let [x, y] = self.condition.load;
        x.hypot(y).max(self.setup.geometry.ball_mass() * 9.81)
    }

    fn pressed(&self) -> Pressed {
        Pressed {
            load_n: self.force_scale(),
            stiffness: self.setup.stiffness.series(),
            limit_m: 0.5 * self.setup.geometry.ball_radius(),
        }
    }
}

/// Rows of the race's displacement at the balls, as columns [dof x 2 balls]: radial, then
/// tangential at the raceway, for each ball.
pub(in crate::system) fn contact_rows(structure: &Structure, setup: &BearingSetup, angles: &[f64]) -> DenseMatrix {
    let ring = structure.ring();
    let arm = setup.raceway_arm(ring.section().radius);
    let mut columns = DenseMatrix::zeros(structure.dof(), 2 * angles.len());
    for (j, &angle) in angles.iter().enumerate() {
        let rows = ring.rows_at(angle);
        let tangential = rows.tangential_at(arm);
        for k in 0..6 {
            columns[(rows.dofs[k], 2 * j)] += rows.radial[k];
            columns[(rows.dofs[k], 2 * j + 1)] += tangential[k];
        }
    }
    columns
}

/// Cage and loads as they stand still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticCondition {
    /// Angle of ball 0, rad.
    pub cage_angle: f64,
    /// Cage speed that the centrifugal load of the balls belongs to, rad/s.
    pub cage_speed: f64,
    /// Angle of the shaft, which the defects of the inner race and the balls' flats turn with, rad.
    pub shaft_angle: f64,
    /// Force on the shaft, its weight included, N.
    pub load: [f64; 2],
}

impl StaticCondition {
    /// As they are at `time` (s); the rotating unbalance is not included.
    pub fn at(setup: &BearingSetup, time: f64) -> Self {
        let cage = setup.cage.motion(time);
        Self {
            cage_angle: cage.angle,
            cage_speed: cage.speed,
            shaft_angle: setup.cage.shaft().angle(time),
            load: setup.shaft_load(time),
        }
    }

    /// The same with the cage turned on by `angle` (rad), and the shaft as pure rolling has it.
    #[must_use]
    pub(crate) fn turned_by(self, setup: &BearingSetup, angle: f64) -> Self {
        Self {
            cage_angle: self.cage_angle + angle,
            shaft_angle: self.shaft_angle + angle / setup.geometry.orders().cage,
            ..self
        }
    }

    /// The same with `factor` times the force on the shaft.
    #[must_use]
    pub fn loaded(self, factor: f64) -> Self {
        Self { load: self.load.map(|force| factor * force), ..self }
    }
}
