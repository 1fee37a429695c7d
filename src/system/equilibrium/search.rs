//! Newton's method on a potential of contacts: down to a minimum, or to the next point without slope.

use crate::system::{Pressed, SystemError};
use nalgebra::{DMatrix, DVector, Dyn, SymmetricEigen};

type Eigen = SymmetricEigen<f64, Dyn>;

/// Newton steps before it gives up; 15 to 40 are typical, each costs microseconds. Forty balls in ten micrometres of play took 530.
const MAX_ITERATIONS: usize = 2000;

/// Longest step of any coordinate, m: a fifth of a usual clearance; it decides to which of several equilibria a search leads.
const LONGEST_STEP: f64 = 0.5e-6;

/// Steps after which it may go farther, in directions that contacts hold and in the others, m: a soft ring gives way by much more
/// than a clearance.
const PATIENCE: usize = 60;
const FAR: [f64; 2] = [1e-4, 5e-6];

/// Force out of balance that counts as none, relative to the load on the shaft.
const FORCE_TOLERANCE: f64 = 1e-11;

/// Round-off of a contact's overlap, relative to the radius at which the ball stands; what it does to the forces counts as none
/// where steps no longer help.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// Curvature below which a direction counts as held by nothing, N/m: that of a ball between the races. The softest contact, of
/// a ball under 1e-6 N, has 1e5 N/m.
pub(in crate::system) const HELD: f64 = 0.1;

/// Halvings of a step: 2^-30 of the longest one is below round-off of a displacement.
const HALVINGS: usize = 30;

/// One evaluation of a potential.
pub(in crate::system) struct Evaluation<C> {
    /// Force out of balance on each coordinate, N.
    pub gradient: DVector<f64>,
    /// N/m.
    pub hessian: DMatrix<f64>,
    /// What the contacts carry.
    pub contacts: C,
}

/// A potential over lengths that contacts hold.
pub(in crate::system) trait Potential {
    /// What the contacts carry.
    type Contacts;

    /// Slope and curvature at `z`.
    fn evaluate(&mut self, z: &DVector<f64>) -> Evaluation<Self::Contacts>;

    /// Force that others are measured by, N.
    fn force_scale(&self) -> f64;

    /// Radius at which the balls stand, m.
    fn touching_radius(&self) -> f64;

    /// What the load would do to the ball that gives way most.
    fn pressed(&self) -> Pressed;
}

/// Where a search ended.
pub(in crate::system) struct Found<C> {
    /// Shaft relative to the centre that its position is measured from, then the balls' displacements, m.
    pub z: DVector<f64>,
    pub evaluation: Evaluation<C>,
    pub iterations: usize,
    /// Smallest curvature of the potential among directions that a contact holds, N/m.
    pub least_curvature: f64,
    /// Directions in which the potential falls.
    pub directions_down: usize,
}

/// Newton's method on any of them.
pub(in crate::system) trait Search: Potential {
    /// Walks downhill from `z` to a minimum, where nothing is out of balance but a direction curves downwards, along it; or, not
    /// downhill, to the next point without slope, a saddle as well as a minimum.
    ///
    /// # Errors
    /// [`SystemError::NoEquilibrium`].
    fn search(&mut self, mut z: DVector<f64>, downhill: bool) -> Result<Found<Self::Contacts>, SystemError> {
        let mut evaluation = self.evaluate(&z);
        let (mut iterations, mut before) = (0, f64::INFINITY);
        loop {
            let eigen = evaluation.hessian.clone().symmetric_eigen();
            let (softest, _) = eigen.eigenvalues.argmin();
            let saddle = downhill && eigen.eigenvalues[softest] < self.falling();
            let balanced = self.balanced(&evaluation, before);
            before = evaluation.gradient.amax();
            if balanced && !saddle {
                let curvatures = || eigen.eigenvalues.iter().copied();
                let held = curvatures().filter(|value| value.abs() > HELD);
                return Ok(Found {
                    least_curvature: held.fold(f64::INFINITY, f64::min),
                    directions_down: curvatures().filter(|&value| value < self.falling()).count(),
                    z,
                    evaluation,
                    iterations,
                });
            }
            if iterations == MAX_ITERATIONS || !before.is_finite() {
                return Err(SystemError::NoEquilibrium { iterations, residual_n: before, pressed: self.pressed() });
            }
            evaluation = if downhill {
                let most = if iterations < PATIENCE { [LONGEST_STEP; 2] } else { FAR };
                let step = match balanced {
                    true => eigen.eigenvectors.column(softest) * LONGEST_STEP,
                    false => newton(&eigen, &evaluation.gradient, most, |curvature| curvature.abs().max(HELD)),
                };
                self.walk(&mut z, step, &evaluation)
            } else {
                let used = |curvature: f64| curvature.abs().max(HELD).copysign(curvature);
                let step = newton(&eigen, &evaluation.gradient, [LONGEST_STEP; 2], used);
                self.settle(&mut z, step, evaluation)
            };
            iterations += 1;
        }
    }

    /// Goes along `step`, shortened until the force out of balance falls, as it does at first along Newton's direction.
    fn settle(
        &mut self,
        z: &mut DVector<f64>,
        mut step: DVector<f64>,
        mut evaluation: Evaluation<Self::Contacts>,
    ) -> Evaluation<Self::Contacts> {
        let size = evaluation.gradient.norm();
        for _ in 0..HALVINGS {
            evaluation = self.evaluate(&(&*z + &step));
            if evaluation.gradient.norm() < size {
                break;
            }
            step *= 0.5;
        }
        *z += &step;
        evaluation
    }

    /// Curvature below which the potential falls, N/m: a hundredth of what a force on the shaft has without a contact, -F / chi.
    fn falling(&self) -> f64 {
        -0.01 * self.force_scale() / self.touching_radius()
    }

    /// Whether no force is out of balance, or no more than round-off that the last step did not halve from `before` (N).
    fn balanced(&self, evaluation: &Evaluation<Self::Contacts>, before: f64) -> bool {
        let most = evaluation.gradient.amax();
        let round_off = ROUND_OFF * self.touching_radius() * evaluation.hessian.amax();
        most <= FORCE_TOLERANCE * self.force_scale() || (most <= round_off && most > 0.5 * before)
    }

    /// Goes along `step`, shortened until the potential's slope along it says that the minimum was
    /// not overrun by more than half.
    fn walk(
        &mut self,
        z: &mut DVector<f64>,
        mut step: DVector<f64>,
        before: &Evaluation<Self::Contacts>,
    ) -> Evaluation<Self::Contacts> {
        let slope = before.gradient.dot(&step).abs();
        for _ in 0..HALVINGS {
            let trial = &*z + &step;
            let evaluation = self.evaluate(&trial);
            let overrun = evaluation.gradient.dot(&step);
            // a slope lost in round-off cannot judge: Newton's step is then as good as any
            if overrun <= 0.5 * slope || step.amax() < 1e-16 {
                *z = trial;
                return evaluation;
            }
            step *= 0.5;
        }
        *z += &step;
        self.evaluate(z)
    }
}

impl<P: Potential> Search for P {}

/// Newton's step with the curvatures as `used` makes them, at most so far (m) along directions that contacts hold, which is the
/// limit of any coordinate too, and along the others: a ball that nothing holds crosses the clearance in such steps, however little
/// it weighs.
fn newton(eigen: &Eigen, gradient: &DVector<f64>, [held, free]: [f64; 2], used: impl Fn(f64) -> f64) -> DVector<f64> {
    let mut step = DVector::zeros(gradient.len());
    let pairs = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
    for (&curvature, direction) in pairs {
        let along = direction.dot(gradient) / used(curvature);
        let most = if curvature > HELD { held } else { free };
        step -= direction * along.clamp(-most, most);
    }
    let longest = step.amax();
    if longest > held {
        step *= held / longest;
    }
    step
}
