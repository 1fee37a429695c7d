//! The searches for a shaft's equilibrium: downhill within a trusted radius, or to the next place in balance.
//!
//! A contact's force grows with the power 3/2 of its penetration: where a ball just touches, the third derivative of the potential has
//! no bound, and the radius within which a quadratic model holds may be nanometres. What a step gains is the work of the forces along
//! it, by the trapezoidal rule with its correction from the stiffness at both ends: it needs no potential, and so allows for inertia.

use super::assembly::Five;
use super::shaft::{Balance, RigidShaft, ShaftLoad};
use crate::bearing::error::BearingError;
use nalgebra::{DMatrix, DVector, Dyn, SymmetricEigen};

/// Steps before a search gives up, rejected ones included; 20 to 100 are typical.
const MAX_ITERATIONS: usize = 600;

/// Longest step as a share of the distance of the groove centres: at first, which decides to which of several equilibria a search
/// leads, and after some patience.
const LONGEST_STEP: [f64; 2] = [0.01, 0.1];
const PATIENCE: usize = 60;

/// Shortest radius, as a share of the distance of the groove centres.
const SHORTEST_STEP: f64 = 1e-15;

/// First radius of a search from a place nearby, as a share of the longest step.
const NEARBY: f64 = 0.1;

/// A step that gains less than the first share of what its model says is rejected; the radius shrinks below the second and grows
/// above the third.
const SHARES: [f64; 3] = [0.1, 0.25, 0.75];
const SHRINK: f64 = 0.25;
const GROW: f64 = 2.0;

/// Steps in a row to places where a ball finds none, before a search gives up: each takes long.
const FAILURES: usize = 8;

/// Halvings of a step to the next place in balance.
const HALVINGS: usize = 30;

/// Force out of balance that counts as none, relative to the largest of the load and the balls' loads.
const FORCE_TOLERANCE: f64 = 1e-11;

/// What counts as none, as a multiple of that, where no step goes further down: a ball's own place is known less well than the shaft's
/// where it is about to touch.
const ROUGH: f64 = 1e5;

/// Round-off of a penetration, relative to the distance of a ball from the groove centres.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// Stiffness below which a direction counts as held by nothing, N/m; see `system::equilibrium`. Light loads hold less: it is at most
/// this share of the load over the pitch radius.
const HELD: f64 = 0.1;
const HELD_SHARE: f64 = 1e-3;

/// Bisections of the shift that fits a step to the radius.
const BISECTIONS: usize = 80;

/// Where a search ended.
pub(super) struct Found {
    pub at: Five,
    pub balance: Balance,
    pub iterations: usize,
    pub curvatures: Vec<f64>,
    /// Stiffness below which a direction is loose, N/m.
    pub held: f64,
}

/// The quadratic model of the potential over the free coordinates.
struct Model {
    gradient: DVector<f64>,
    stiffness: DMatrix<f64>,
    eigen: SymmetricEigen<f64, Dyn>,
    held: f64,
    /// Largest force out of balance, what of it is round-off, and what counts as little, N.
    error: f64,
    round_off: f64,
    little: f64,
}

impl Model {
    fn new(shaft: &RigidShaft, free: &[usize], balance: &Balance, load: &ShaftLoad) -> Self {
        let gradient = DVector::from_fn(free.len(), |row, _| balance.gradient[free[row]]);
        let stiffness = DMatrix::from_fn(free.len(), free.len(), |a, b| balance.stiffness[(free[a], free[b])]);
        let symmetric = (&stiffness + stiffness.transpose()) * 0.5;
        // none of a shaft that is held in all directions
        let eigen = match free.len() {
            0 => SymmetricEigen { eigenvectors: symmetric, eigenvalues: DVector::zeros(0) },
            _ => symmetric.symmetric_eigen(),
        };
        let arm = shaft.arm();
        let [fx, fy, fz] = load.force;
        let [mx, my] = load.moment;
        let applied = [fx, fy, fz, mx / arm, my / arm].into_iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        let carried = applied.max(balance.carried);
        // what a bearing without any load is measured by
        let ball_weight = 9.81 * shaft.bearings[0].bearing.geometry().ball_mass();
        let largest = stiffness.iter().fold(0.0_f64, |most, k| most.max(k.abs()));
        Self {
            error: gradient.amax(),
            round_off: ROUND_OFF * shaft.centre_distance() * largest,
            little: FORCE_TOLERANCE * carried.max(ball_weight),
            held: HELD.min(HELD_SHARE * carried / arm),
            gradient,
            stiffness,
            eigen,
        }
    }

    /// Whether the forces are in balance, `before` the error of the step before.
    fn is_balanced(&self, before: f64) -> bool {
        self.error <= self.little || (self.error <= self.round_off && self.error > 0.5 * before) || self.error <= 0.0
    }

    /// Whether steps are too short for their gain to be told from round-off.
    fn is_close(&self) -> bool {
        self.error <= self.round_off.max(1e3 * self.little)
    }

    /// Whether the potential falls in some direction.
    fn falls(&self) -> bool {
        self.eigen.eigenvalues.iter().any(|&curvature| curvature < -self.held)
    }

    fn found(&self, at: Five, balance: Balance, iterations: usize) -> Found {
        Found { at, balance, iterations, curvatures: self.eigen.eigenvalues.iter().copied().collect(), held: self.held }
    }

    /// Newton's own step: with inertia the stiffness is not symmetric, and it is the better one near the end.
    fn newton(&self) -> Option<DVector<f64>> {
        self.stiffness.clone().lu().solve(&self.gradient).map(|step| -step)
    }

    /// Newton's step with every direction on its own and no longer than `most`.
    fn clamped(&self, most: f64) -> DVector<f64> {
        let mut step = DVector::zeros(self.gradient.len());
        for (&curvature, direction) in self.eigen.eigenvalues.iter().zip(self.eigen.eigenvectors.column_iter()) {
            let along = direction.dot(&self.gradient) / curvature.abs().max(self.held).copysign(curvature);
            step -= direction * along.clamp(-most, most);
        }
        step
    }

    /// The lowest place of the model within a radius: (K + μ) s = −g, with μ that no direction falls and s fits. Loose directions
    /// count as just held.
    fn lowest_within(&self, radius: f64) -> DVector<f64> {
        let curvature = |index: usize| {
            let own = self.eigen.eigenvalues[index];
            if own.abs() < self.held { self.held } else { own }
        };
        let count = self.gradient.len();
        let slopes = self.eigen.eigenvectors.tr_mul(&self.gradient);
        let shifted = |shift: f64| {
            DVector::from_fn(count, |index, _| -slopes[index] / (curvature(index) + shift).max(f64::MIN_POSITIVE))
        };
        let softest = (0..count).min_by(|&a, &b| curvature(a).total_cmp(&curvature(b))).unwrap_or(0);
        let lowest = curvature(softest);
        // just above what makes the softest direction stiff
        let mut low = if lowest > 0.0 { 0.0 } else { -lowest * (1.0 + 1e-10) };
        let mut along = shifted(low);
        if along.norm() > radius {
            let mut high = low + slopes.norm() / radius;
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                if shifted(middle).norm() > radius { low = middle } else { high = middle }
            }
            along = shifted(high);
        } else if lowest <= 0.0 {
            // at a saddle the slope says nothing of the direction that falls
            along[softest] = 0.0;
            let rest = (radius * radius - along.norm_squared()).max(0.0).sqrt();
            along[softest] = rest.copysign(-slopes[softest]);
        }
        &self.eigen.eigenvectors * along
    }

    /// What the model says that a step gains, J.
    fn gain(&self, step: &DVector<f64>) -> f64 {
        -self.gradient.dot(step) - 0.5 * step.dot(&(&self.stiffness * step))
    }

    /// What a step to another place gains by the forces there, J.
    fn gained(&self, step: &DVector<f64>, there: &Self) -> f64 {
        let change = step.dot(&(&self.stiffness * step)) - step.dot(&(&there.stiffness * step));
        -0.5 * (self.gradient.dot(step) + there.gradient.dot(step)) - change / 12.0
    }
}

impl RigidShaft {
    fn free(&self) -> Vec<usize> {
        (0..5).filter(|&row| self.held[row].is_none()).collect()
    }

    /// Walks downhill from a start to a minimum. From a place `nearby` it begins with short steps.
    ///
    /// # Errors
    /// [`BearingError`] where the search does not end, with what it found.
    pub(super) fn descend(&self, start: Five, load: &ShaftLoad, nearby: bool) -> Result<Found, BearingError> {
        let free = self.free();
        let reach = self.centre_distance();
        let mut at = start;
        let mut balance = self.scaled(&at, load)?;
        let mut model = Model::new(self, &free, &balance, load);
        if free.is_empty() {
            return Ok(model.found(at, balance, 0));
        }
        let mut radius = if nearby { NEARBY } else { 1.0 } * LONGEST_STEP[0] * reach;
        let (mut before, mut saddle, mut failures) = (f64::INFINITY, None, 0);
        for iterations in 0..MAX_ITERATIONS {
            let falls = model.falls();
            if model.is_balanced(before) {
                if !falls {
                    return Ok(model.found(at, balance, iterations));
                }
                saddle = Some(at);
            }
            if !model.error.is_finite() {
                break;
            }
            if radius < SHORTEST_STEP * reach {
                if !falls && model.error <= ROUGH * model.little {
                    return Ok(model.found(at, balance, iterations));
                }
                break;
            }
            let longest = LONGEST_STEP[usize::from(iterations >= PATIENCE)] * reach;
            radius = radius.min(longest);
            let newton = if falls { None } else { model.newton() };
            let step = newton.filter(|step| step.norm() < radius.min(1e-3 * longest));
            let step = step.unwrap_or_else(|| model.lowest_within(radius));
            let mut trial = at;
            for (row, &place) in free.iter().enumerate() {
                trial[place] += step[row];
            }
            let next = match self.scaled(&trial, load) {
                Ok(next) => next,
                Err(error) => {
                    failures += 1;
                    if failures == FAILURES {
                        return Err(error);
                    }
                    radius = SHRINK * step.norm();
                    continue;
                }
            };
            let there = Model::new(self, &free, &next, load);
            let share = model.gained(&step, &there) / model.gain(&step).max(f64::MIN_POSITIVE);
            let close = model.is_close() && !falls && there.error <= 1e3 * model.error;
            if share > SHARES[2] || close {
                radius = radius.max(GROW * step.norm());
            } else if share.is_nan() || share < SHARES[1] {
                radius = SHRINK * step.norm();
            }
            if share > SHARES[0] || close {
                before = model.error;
                (at, balance, model, failures) = (trial, next, there, 0);
            }
        }
        let found = saddle.map_or_else(
            || "check that the bearings can carry the load in every direction".to_owned(),
            |at| {
                let [x, y, z] = [at[0], at[1], at[2]].map(|part| 1e6 * part);
                format!("all that was found is a saddle, which the shaft leaves, at ({x:.3}, {y:.3}, {z:.3}) um: change the load a little, or where the balls stand")
            },
        );
        Err(BearingError(format!(
            "the shaft finds no stable equilibrium: {:.3e} N stay out of balance; {found}",
            model.error
        )))
    }

    /// Walks from a start to the next place in balance, a saddle as well.
    ///
    /// # Errors
    /// [`BearingError`] where the search does not end.
    pub(super) fn next_in_balance(&self, start: Five, load: &ShaftLoad) -> Result<Found, BearingError> {
        let free = self.free();
        let mut at = start;
        let mut balance = self.scaled(&at, load)?;
        let mut model = Model::new(self, &free, &balance, load);
        let mut before = f64::INFINITY;
        for iterations in 0..MAX_ITERATIONS {
            if free.is_empty() || model.is_balanced(before) {
                return Ok(model.found(at, balance, iterations));
            }
            before = model.error;
            let longest = LONGEST_STEP[usize::from(iterations >= PATIENCE)] * self.centre_distance();
            let newton = model.newton().filter(|step| step.amax() < 1e-3 * longest);
            let mut step = newton.unwrap_or_else(|| model.clamped(longest));
            for halving in 0..=HALVINGS {
                let mut trial = at;
                for (row, &place) in free.iter().enumerate() {
                    trial[place] += step[row];
                }
                let next = self.scaled(&trial, load);
                if let Ok(next) = next {
                    let there = Model::new(self, &free, &next, load);
                    if there.gradient.norm() < model.gradient.norm() || model.is_close() || halving == HALVINGS {
                        (at, balance, model) = (trial, next, there);
                        break;
                    }
                }
                step *= 0.5;
            }
        }
        Err(BearingError(format!("no place in balance: {:.3e} N stay", model.error)))
    }
}
