//! Static equilibrium of ring, housing, shaft and balls at one cage angle, by Newton's method on
//! the reduced potential.
//!
//! For given positions of shaft and balls the structure's response is found first (its static
//! flexibility at the contacts, a small monotone problem). What remains is a potential of 2 + balls
//! unknowns whose gradient is the force out of balance and whose Hessian includes the geometric
//! term of the contacts. Directions of negative curvature are walked downhill, so that the end is a
//! minimum: a ball straight under the load is a saddle, and the shaft leans on a neighbour.
//!
//! **Rules.** Of two mirror-image equilibria the one reached from a start displaced by a hundredth
//! of a micrometre counter-clockwise of the load is taken. A ball that nothing pushes stays where
//! it touches the undeformed outer race.

use super::bearing_setup::{BearingSetup, Formulation};
use super::error::SystemError;
use super::inner::InnerRace;
use super::outer::{OuterForce, OuterRace};
use super::structure::Structure;
use crate::linalg::DenseMatrix;
use nalgebra::{DMatrix, DVector};

/// Newton steps before it gives up; 15 to 40 are typical, each costs microseconds.
const MAX_ITERATIONS: usize = 400;

/// Longest step of any coordinate, m: a fifth of a usual clearance.
const LONGEST_STEP: f64 = 0.5e-6;

/// Force out of balance that counts as none, relative to the load on the shaft.
const FORCE_TOLERANCE: f64 = 1e-11;

/// Least curvature in a step, N/m: a ball between the races has none, and its weight of 1e-4 N
/// shall not throw it farther than the longest step.
const LEAST_CURVATURE: f64 = 100.0;

/// Forces on one ball at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallLoad {
    /// Angle of the ball, rad.
    pub angle: f64,
    /// Outward displacement from touching the undeformed outer race, m.
    pub displacement: f64,
    /// Contact force at the inner race, N.
    pub inner: f64,
    /// Contact force at the outer race, sum of magnitudes, N.
    pub outer: f64,
}

/// Where everything rests.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// Shaft displacement x, y, m.
    pub shaft: [f64; 2],
    /// Balls, in order.
    pub balls: Vec<BallLoad>,
    /// Contact forces and weight on the structure's coordinates \[dof\].
    pub structure_load: Vec<f64>,
    /// Newton iterations.
    pub iterations: usize,
    /// Largest force out of balance, N.
    pub residual_n: f64,
    /// Smallest curvature of the potential among directions that a contact holds, N/m; positive:
    /// stable.
    pub least_curvature: f64,
    /// Displacement of the structure relative to the fixed centre that the inner race's position is
    /// measured from, m: the ring's mean in `printed`, zero otherwise.
    pub centre: [f64; 2],
    /// Cage speed that the centrifugal load belongs to, rad/s.
    pub cage_speed: f64,
}

/// One evaluation of the reduced potential.
struct Evaluation {
    gradient: DVector<f64>,
    hessian: DMatrix<f64>,
    inner: Vec<f64>,
    outer: Vec<OuterForce>,
}

struct Problem<'a> {
    setup: &'a BearingSetup,
    inner: InnerRace,
    outer: OuterRace,
    angles: Vec<f64>,
    /// Cage speed, rad/s.
    speed: f64,
    /// Flexibility at the contacts [2 balls x 2 balls], radial then tangential a ball, m/N.
    flexibility: DMatrix<f64>,
    /// Displacement there under the structure's weight [2 balls], m.
    weight: DVector<f64>,
    /// Displacement of the race under the balls [2 balls], the start of the next inner solution.
    race: DVector<f64>,
}

impl Equilibrium {
    /// Finds the equilibrium with the cage and the shaft as they are at time `t` (s); the
    /// centrifugal load of the balls at that speed is included, the rotating unbalance is not.
    ///
    /// # Errors
    /// [`SystemError::NotSupported`], [`SystemError::NoEquilibrium`],
    /// [`SystemError::NothingHoldsTheShaft`].
    pub fn find(structure: &Structure, setup: &BearingSetup, t: f64) -> Result<Self, SystemError> {
        let (mut problem, loads) = Problem::new(structure, setup, t)?;
        let balls = setup.balls();
        let load = setup.shaft_load();
        let load_size = load[0].hypot(load[1]);
        let play = setup.geometry.radial_play();
        if load_size <= f64::MIN_POSITIVE && play >= 0.0 {
            return Err(SystemError::NothingHoldsTheShaft);
        }
        let mut z = start(load, load_size, play, balls);
        // weight of a ball as a floor, for a shaft without load in a preloaded bearing
        let smallest = setup.geometry.ball_mass() * 9.81;
        let tolerance = FORCE_TOLERANCE * load_size.max(smallest);
        let mut evaluation = problem.evaluate(&z)?;
        let mut iterations = 0;
        loop {
            let residual_n = evaluation.gradient.amax();
            let eigen = evaluation.hessian.clone().symmetric_eigen();
            let (softest, _) = eigen.eigenvalues.argmin();
            let saddle = eigen.eigenvalues[softest] < -LEAST_CURVATURE;
            if residual_n <= tolerance && !saddle {
                let held = eigen.eigenvalues.iter().copied();
                let held = held.filter(|value| value.abs() > 1e-3 * LEAST_CURVATURE);
                let least_curvature = held.fold(f64::INFINITY, f64::min);
                return Ok(problem.result(
                    &z,
                    &evaluation,
                    &loads,
                    structure,
                    iterations,
                    least_curvature,
                ));
            }
            if iterations == MAX_ITERATIONS || !residual_n.is_finite() {
                return Err(SystemError::NoEquilibrium {
                    iterations,
                    residual_n,
                });
            }
            let mut step = DVector::zeros(z.len());
            for (value, vector) in eigen
                .eigenvalues
                .iter()
                .zip(eigen.eigenvectors.column_iter())
            {
                let slope = vector.dot(&evaluation.gradient);
                step -= vector * (slope / value.abs().max(LEAST_CURVATURE));
            }
            if saddle && residual_n <= tolerance {
                step = eigen.eigenvectors.column(softest) * LONGEST_STEP;
            }
            let longest = step.amax();
            if longest > LONGEST_STEP {
                step *= LONGEST_STEP / longest;
            }
            evaluation = problem.walk(&mut z, step, &evaluation)?;
            iterations += 1;
        }
    }
}

/// Shaft displaced into the clearance along the load, balls touching the outer race.
fn start(load: [f64; 2], load_size: f64, play: f64, balls: usize) -> DVector<f64> {
    let mut z = DVector::zeros(2 + balls);
    if load_size > 0.0 {
        let along = [load[0] / load_size, load[1] / load_size];
        let (depth, aside) = (play.max(0.0), 1e-8);
        z[0] = along[0] * depth - along[1] * aside;
        z[1] = along[1] * depth + along[0] * aside;
    }
    z
}

impl<'a> Problem<'a> {
    /// The problem, and the loads behind it: unit contact forces, then the weight [dof x 2 balls + 1].
    fn new(
        structure: &Structure,
        setup: &'a BearingSetup,
        t: f64,
    ) -> Result<(Self, DenseMatrix), SystemError> {
        let balls = setup.balls();
        let cage = setup.cage.motion(setup.speed.motion(t));
        let angles: Vec<f64> = (0..balls)
            .map(|j| setup.cage.ball_angle(cage.angle, j as u32))
            .collect();
        let rows = contact_rows(structure, setup, &angles);
        let weighted = setup.formulation == Formulation::Consistent;
        let loads =
            DenseMatrix::from_fn(structure.dof(), 2 * balls + 1, |row, column| {
                match column.checked_sub(2 * balls) {
                    None => rows[(row, column)],
                    Some(_) if weighted => structure.gravity()[row],
                    Some(_) => 0.0,
                }
            });
        let responses = structure.static_response(&loads)?;
        let at_contacts = rows.transpose() * &responses;
        Ok((
            Self {
                inner: InnerRace::new(&setup.geometry, setup.stiffness.inner(), 0.0),
                outer: OuterRace::new(setup),
                setup,
                angles,
                speed: cage.speed,
                flexibility: DMatrix::from_fn(2 * balls, 2 * balls, |i, j| at_contacts[(i, j)]),
                weight: DVector::from_fn(2 * balls, |i, _| at_contacts[(i, 2 * balls)]),
                race: DVector::zeros(2 * balls),
            },
            loads,
        ))
    }

    /// Goes along `step`, shortened until the potential's slope along it says that the minimum was
    /// not overrun by more than half.
    fn walk(
        &mut self,
        z: &mut DVector<f64>,
        mut step: DVector<f64>,
        before: &Evaluation,
    ) -> Result<Evaluation, SystemError> {
        let slope = before.gradient.dot(&step).abs();
        for _ in 0..30 {
            let trial = &*z + &step;
            let evaluation = self.evaluate(&trial)?;
            let overrun = evaluation.gradient.dot(&step);
            // a slope lost in round-off cannot judge: Newton's step is then as good as any
            if overrun <= 0.5 * slope || step.amax() < 1e-16 {
                *z = trial;
                return Ok(evaluation);
            }
            step *= 0.5;
        }
        *z += &step;
        self.evaluate(z)
    }

    fn evaluate(&mut self, z: &DVector<f64>) -> Result<Evaluation, SystemError> {
        let balls = self.angles.len();
        let (outer, stiffness) = self.outer_forces(z)?;
        let mut gradient = DVector::zeros(2 + balls);
        let mut hessian = DMatrix::zeros(2 + balls, 2 + balls);
        let load = self.setup.shaft_load();
        gradient[0] = -load[0];
        gradient[1] = -load[1];
        let mass = self.setup.geometry.ball_mass();
        let mut inner = vec![0.0; balls];
        for j in 0..balls {
            let (sin, cos) = self.angles[j].sin_cos();
            let e = [cos, sin];
            let s = z[2 + j];
            let rho = self.inner.touching_radius + s;
            let weight = mass * (self.setup.gravity[0] * cos + self.setup.gravity[1] * sin);
            let spin = self.speed * self.speed;
            gradient[2 + j] = outer[j].radial - weight - mass * spin * rho;
            hessian[(2 + j, 2 + j)] -= mass * spin;
            for k in 0..balls {
                hessian[(2 + j, 2 + k)] += stiffness[(j, k)];
            }
            let gap = self.inner.gap(e, s, [z[0], z[1]]);
            let force = self.inner.law.linearised(gap.penetration, 0.0);
            inner[j] = force.force;
            if force.force > 0.0 {
                // chi over (x, y, s_j): gradient a, Hessian (t t^T) / chi with t across the normal
                let n = gap.normal;
                let along = [-n[0], -n[1], n[0] * e[0] + n[1] * e[1]];
                let across = [n[1], -n[0], n[0] * e[1] - n[1] * e[0]];
                let place = [0, 1, 2 + j];
                for a in 0..3 {
                    gradient[place[a]] -= force.force * along[a];
                    for b in 0..3 {
                        hessian[(place[a], place[b])] += force.by_penetration * along[a] * along[b]
                            - force.force / gap.distance * across[a] * across[b];
                    }
                }
            }
        }
        Ok(Evaluation {
            gradient,
            hessian,
            inner,
            outer,
        })
    }

    /// Outer contact forces for given ball positions, and their derivatives [balls x balls] with
    /// the structure following.
    fn outer_forces(
        &mut self,
        z: &DVector<f64>,
    ) -> Result<(Vec<OuterForce>, DMatrix<f64>), SystemError> {
        let balls = self.angles.len();
        let at = |race: &DVector<f64>| -> (Vec<OuterForce>, DVector<f64>) {
            let forces: Vec<OuterForce> = (0..balls)
                .map(|j| {
                    let s = z[2 + j];
                    let shift = race[2 * j + 1] / (self.inner.touching_radius + s);
                    let angle = self.angles[j] - shift;
                    self.outer.force(angle, s - race[2 * j], [0.0; 2])
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
        let radial = DMatrix::from_fn(balls, balls, |i, j| {
            0.5 * (stiffness[(2 * i, 2 * j)] + stiffness[(2 * j, 2 * i)])
        });
        Ok((forces, radial))
    }

    fn tangent(&self, forces: &[OuterForce]) -> DMatrix<f64> {
        let mut tangent = DMatrix::zeros(2 * forces.len(), 2 * forces.len());
        for (j, force) in forces.iter().enumerate() {
            tangent[(2 * j, 2 * j)] = force.tangent[0];
            tangent[(2 * j, 2 * j + 1)] = force.tangent[1];
            tangent[(2 * j + 1, 2 * j)] = force.tangent[1];
            tangent[(2 * j + 1, 2 * j + 1)] = force.tangent[2];
        }
        tangent
    }

    fn result(
        &self,
        z: &DVector<f64>,
        evaluation: &Evaluation,
        loads: &DenseMatrix,
        structure: &Structure,
        iterations: usize,
        least_curvature: f64,
    ) -> Equilibrium {
        let balls = self.angles.len();
        let structure_load: Vec<f64> = (0..structure.dof())
            .map(|row| {
                let contacts: f64 = (0..balls)
                    .map(|j| {
                        let force = &evaluation.outer[j];
                        loads[(row, 2 * j)] * force.radial
                            + loads[(row, 2 * j + 1)] * force.tangential
                    })
                    .sum();
                contacts + loads[(row, 2 * balls)]
            })
            .collect();
        let centre = match self.setup.formulation {
            Formulation::Consistent => [0.0; 2],
            Formulation::Printed => self.mean_displacement(structure, &structure_load),
        };
        Equilibrium {
            shaft: [z[0] + centre[0], z[1] + centre[1]],
            balls: (0..balls)
                .map(|j| BallLoad {
                    angle: self.angles[j],
                    displacement: z[2 + j],
                    inner: evaluation.inner[j],
                    outer: evaluation.outer[j].magnitude,
                })
                .collect(),
            structure_load,
            iterations,
            residual_n: evaluation.gradient.amax(),
            least_curvature,
            centre,
            cage_speed: self.speed,
        }
    }

    fn mean_displacement(&self, structure: &Structure, load: &[f64]) -> [f64; 2] {
        let column = DenseMatrix::from_fn(load.len(), 1, |row, _| load[row]);
        let nodes = structure.ring().nodes();
        structure
            .static_response(&column)
            .map(|response| {
                [0, 1].map(|component| {
                    let sum: f64 = (0..nodes)
                        .map(|node| response[(3 * node + component, 0)])
                        .sum();
                    sum / nodes as f64
                })
            })
            .unwrap_or([0.0; 2])
    }
}

/// Rows of the race's displacement at the balls, as columns [dof x 2 balls]: radial, then
/// tangential at the raceway, for each ball.
pub(super) fn contact_rows(
    structure: &Structure,
    setup: &BearingSetup,
    angles: &[f64],
) -> DenseMatrix {
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
