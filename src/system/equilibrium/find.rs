//! Where everything rests: the equilibrium that the load leads to, and the others.

use super::StaticCondition;
use super::problem::{PlaneContacts, Problem};
use super::search::{Found, HELD, Search};
use crate::numerics::linalg::DenseMatrix;
use crate::system::{BearingSetup, Formulation, Structure, SystemError};
use nalgebra::{DMatrix, DVector};

/// Displacement of the start to one side of the load, m: it decides between mirror images.
const ASIDE: f64 = 1e-8;

/// Starts to either side of the load when other equilibria are looked for, and the angle between them, rad.
const STARTS: (i32, f64) = (6, 0.2);

/// Distance of two shaft positions, or balls, below which two equilibria are one, m.
const SAME: f64 = 1e-10;

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
    /// Directions in which the potential falls: none in a stable equilibrium, one in a saddle.
    pub directions_down: usize,
    /// Stiffness that a further force on the shaft meets, N/m: `dF_i / dx_j`, balls, ring and housing following. In
    /// `printed` relative to the ring's mean.
    pub shaft_stiffness: [[f64; 2]; 2],
    /// Displacement of the structure relative to the fixed centre that the inner race's position is
    /// measured from, m: the ring's mean in `printed`, zero otherwise.
    pub centre: [f64; 2],
    /// Cage speed that the centrifugal load belongs to, rad/s.
    pub cage_speed: f64,
    /// Angle of the shaft, rad.
    pub shaft_angle: f64,
}

impl Equilibrium {
    /// Finds the stable equilibrium at which the shaft arrives when the load pushes it into the clearance.
    ///
    /// # Errors
    /// [`SystemError::NoEquilibrium`]; [`SystemError::Refused`] for a structure or a shaft that nothing holds.
    pub fn find(structure: &Structure, setup: &BearingSetup, condition: StaticCondition) -> Result<Self, SystemError> {
        let (mut problem, loads) = Problem::new(structure, setup, condition)?;
        let start = start(setup, condition, 0.0)?;
        let found = problem.search(start, true)?;
        Ok(problem.result(&found, &loads, structure))
    }

    /// The equilibrium of [`Equilibrium::find`] first, then the other stable ones that are found from starts to both sides of
    /// the load, then the saddles between neighbours.
    ///
    /// # Errors
    /// As [`Equilibrium::find`]; a start that leads nowhere is no error.
    pub fn find_all(
        structure: &Structure,
        setup: &BearingSetup,
        condition: StaticCondition,
    ) -> Result<Vec<Self>, SystemError> {
        let (mut problem, loads) = Problem::new(structure, setup, condition)?;
        let mut found = vec![problem.search(start(setup, condition, 0.0)?, true)?];
        for step in (1..=STARTS.0).flat_map(|step| [step, -step]) {
            let aside = start(setup, condition, f64::from(step) * STARTS.1)?;
            if let Ok(other) = problem.search(aside, true) {
                keep(&mut found, other);
            }
        }
        let stable = found.len();
        let mut order: Vec<usize> = (0..stable).collect();
        let across = |place: &usize| {
            let z = &found[*place].z;
            z[1] * condition.load[0] - z[0] * condition.load[1]
        };
        order.sort_by(|a, b| across(a).total_cmp(&across(b)));
        for pair in order.windows(2) {
            let between = (&found[pair[0]].z + &found[pair[1]].z) * 0.5;
            if let Ok(saddle) = problem.search(between, false) {
                keep(&mut found, saddle);
            }
        }
        let results = found.iter();
        Ok(results.map(|found| problem.result(found, &loads, structure)).collect())
    }

    /// Whether every displacement from it that a contact or the structure feels needs work.
    pub fn is_stable(&self) -> bool {
        self.directions_down == 0
    }
}

impl Problem<'_> {
    /// The equilibrium that a search found; `loads` as [`Problem::new`] gives them.
    fn result(&self, found: &Found<PlaneContacts>, loads: &DenseMatrix, structure: &Structure) -> Equilibrium {
        let Found { z, evaluation, .. } = found;
        let balls = self.angles.len();
        let structure_load: Vec<f64> = (0..structure.dof())
            .map(|row| {
                let contacts: f64 = (0..balls)
                    .map(|j| {
                        let force = &evaluation.contacts.outer[j];
                        loads[(row, 2 * j)] * force.radial + loads[(row, 2 * j + 1)] * force.tangential
                    })
                    .sum();
                contacts + loads[(row, 2 * balls)]
            })
            .collect();
        let centre = match self.setup.formulation {
            Formulation::Consistent => [0.0; 2],
            Formulation::Printed => {
                let column = DenseMatrix::from_fn(structure.dof(), 1, |row, _| structure_load[row]);
                structure.static_response(&column).map_or([0.0; 2], |response| structure.ring_mean(&response, 0))
            }
        };
        Equilibrium {
            shaft: [z[0] + centre[0], z[1] + centre[1]],
            balls: (0..balls)
                .map(|j| BallLoad {
                    angle: self.angles[j],
                    displacement: z[2 + j],
                    inner: evaluation.contacts.inner[j],
                    outer: evaluation.contacts.outer[j].magnitude,
                })
                .collect(),
            structure_load,
            iterations: found.iterations,
            residual_n: evaluation.gradient.amax(),
            least_curvature: found.least_curvature,
            directions_down: found.directions_down,
            shaft_stiffness: shaft_stiffness(&evaluation.hessian),
            centre,
            cage_speed: self.condition.cage_speed,
            shaft_angle: self.condition.shaft_angle,
        }
    }
}

/// Stiffness that a force on the shaft meets while the balls find their own balance, N/m:
/// `H_ss - H_sb H_bb^-1 H_bs`; balls that nothing holds do not take part.
fn shaft_stiffness(hessian: &DMatrix<f64>) -> [[f64; 2]; 2] {
    let balls = hessian.nrows() - 2;
    let of_balls = hessian.view((2, 2), (balls, balls)).symmetric_eigen();
    let coupling = of_balls.eigenvectors.transpose() * hessian.view((2, 0), (balls, 2));
    let mut stiffness = [0, 1].map(|i| [0, 1].map(|j| hessian[(i, j)]));
    for (mode, &curvature) in of_balls.eigenvalues.iter().enumerate() {
        if curvature.abs() > HELD {
            for (i, row) in stiffness.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry -= coupling[(mode, i)] * coupling[(mode, j)] / curvature;
                }
            }
        }
    }
    stiffness
}

/// Adds what is not there yet.
fn keep(all: &mut Vec<Found<PlaneContacts>>, new: Found<PlaneContacts>) {
    let apart = |old: &Found<PlaneContacts>| (&old.z - &new.z).amax() > SAME;
    if all.iter().all(apart) {
        all.push(new);
    }
}

/// Shaft displaced into the clearance at an angle (rad) from the load, balls touching the outer race.
fn start(setup: &BearingSetup, condition: StaticCondition, angle: f64) -> Result<DVector<f64>, SystemError> {
    let [x, y] = condition.load;
    let size = x.hypot(y);
    let play = setup.geometry.radial_play();
    let mut z = DVector::zeros(2 + setup.balls());
    if size > f64::MIN_POSITIVE {
        let (sin, cos) = angle.sin_cos();
        let along = [(x * cos - y * sin) / size, (x * sin + y * cos) / size];
        let depth = play.max(0.0);
        z[0] = along[0] * depth - along[1] * ASIDE;
        z[1] = along[1] * depth + along[0] * ASIDE;
    } else if play >= 0.0 {
        return Err(SystemError::Refused(
            "the shaft is not held in the loaded direction: without load on it, it can move in the clearance",
        ));
    }
    Ok(z)
}
