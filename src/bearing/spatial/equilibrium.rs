//! Where a shaft rests: Newton's method downhill, and the other equilibria that clearance allows.
//!
//! Tilts are scaled by the pitch radius, so that all coordinates are lengths and all forces N. The search follows the slope of the
//! potential along its step, which is known from the forces alone, and works with the balls' inertia too.

use super::assembly::{BearingState, Five, FiveByFive};
use super::ring::RingDisplacement;
use super::shaft::{Balance, RigidShaft, ShaftLoad};
use crate::bearing::error::{BearingError, refused};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Newton steps before a search gives up; 10 to 40 are typical.
const MAX_ITERATIONS: usize = 600;

/// Halvings of a step.
const HALVINGS: usize = 30;

/// Longest step as a share of the distance of the groove centres: at first, which decides to which of several equilibria a search
/// leads, and after some patience.
const LONGEST_STEP: [f64; 2] = [0.01, 0.1];
const PATIENCE: usize = 60;

/// What becomes of the longest step after one that turned back, one that was halved, and one that was neither. Light contacts hold
/// a shaft within nanometres, beside which the potential falls: steps of one length jump to and fro over such a place.
const TURNED_BACK: f64 = 0.25;
const HALVED: f64 = 0.5;
const WENT_ON: f64 = 2.0;

/// Force out of balance that counts as none, relative to the largest of the load and the balls' loads.
const FORCE_TOLERANCE: f64 = 1e-11;

/// Round-off of a penetration, relative to the distance of a ball from the groove centres.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// Stiffness below which a direction counts as held by nothing, N/m; see `system::equilibrium`. Light loads hold less: it is at most
/// this share of the load over the pitch radius.
const HELD: f64 = 0.1;
const HELD_SHARE: f64 = 1e-3;

/// Distance below which two equilibria are one, as a share of the distance of the groove centres.
const SAME: f64 = 1e-6;

/// Shares of the load at which the search goes on from the last place, where it fails at once.
const LOAD_STEPS: [f64; 7] = [0.01, 0.03, 0.1, 0.25, 0.5, 0.75, 1.0];

/// Where a shaft rests.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaftEquilibrium {
    /// Displacement of the shaft's point at z = 0, and its tilt.
    pub displacement: RingDisplacement,
    /// Load that holds the prescribed displacements: N along x, y, z, N m about x, y. Zero where the shaft is free.
    pub holding_load: [f64; 5],
    /// Stiffness that a further load on the shaft meets, over x, y, z and the tilts.
    pub stiffness: [[f64; 5]; 5],
    /// Each bearing, loads about its own centre.
    pub bearings: Vec<BearingState>,
    /// Newton iterations.
    pub iterations: usize,
    /// Largest force out of balance, N; moments over the pitch radius.
    pub residual_n: f64,
    /// Smallest stiffness among the free directions that a contact holds, N/m, tilts scaled by the pitch radius.
    pub least_stiffness: Option<f64>,
    /// Free directions in which the potential falls: none in a stable equilibrium.
    pub directions_down: usize,
    /// Free directions that nothing holds.
    pub directions_loose: usize,
}

impl ShaftEquilibrium {
    /// Whether every displacement that a contact feels needs work.
    pub fn is_stable(&self) -> bool {
        self.directions_down == 0
    }
}

/// Where a search ended.
#[derive(Clone)]
struct Found {
    at: Five,
    balance: Balance,
    iterations: usize,
    curvatures: Vec<f64>,
    /// Stiffness below which a direction is loose, N/m.
    held: f64,
}

impl RigidShaft {
    /// The stable equilibrium to which the load leads from the undisplaced place.
    ///
    /// # Errors
    /// [`BearingError`]: a load or a prescribed displacement that is not finite; no equilibrium, with the force that stays out of
    /// balance; an angular contact bearing whose rings the load pushes apart.
    pub fn equilibrium(&self, load: &ShaftLoad) -> Result<ShaftEquilibrium, BearingError> {
        self.check(load)?;
        let start = self.start(Five::zeros());
        let found = match self.search(start, load, true) {
            Ok(found) => found,
            Err(failed) => self.in_load_steps(start, load).map_err(|_| failed)?,
        };
        self.result(&found)
    }

    /// The equilibrium to which the load leads from a displacement nearby, so that it stays on one branch where there are several.
    ///
    /// # Errors
    /// As [`Self::equilibrium`].
    pub(crate) fn equilibrium_near(
        &self,
        load: &ShaftLoad,
        near: &RingDisplacement,
    ) -> Result<ShaftEquilibrium, BearingError> {
        self.check(load)?;
        let start = self.start(near.vector().component_div(&self.units()));
        self.search(start, load, true).and_then(|found| self.result(&found)).or_else(|_| self.equilibrium(load))
    }

    /// The equilibrium of [`Self::equilibrium`] first, then the other stable ones that are found from starts to several sides, then
    /// the saddles between neighbours. Of a load that leads to a saddle or nowhere, a stable one comes first. Places along a direction
    /// that nothing holds count as one.
    ///
    /// # Errors
    /// As [`Self::equilibrium`], where no start leads to an equilibrium.
    pub fn find_all(&self, load: &ShaftLoad) -> Result<Vec<ShaftEquilibrium>, BearingError> {
        self.check(load)?;
        let first = self.equilibrium(load);
        let mut all: Vec<ShaftEquilibrium> = first.iter().cloned().collect();
        let distance = self.centre_distance();
        let along = load.force[1].atan2(load.force[0]);
        for step in 0..12 {
            let (sin, cos) = (along + TAU * f64::from(step) / 12.0).sin_cos();
            for axial in [-0.5, 0.0, 0.5] {
                let aside = Five::from([0.05 * cos, 0.05 * sin, axial, 0.0, 0.0]) * distance;
                self.keep(&mut all, self.search(self.start(aside), load, true));
            }
        }
        if all.is_empty() {
            return first.map(|only| vec![only]);
        }
        all.sort_by_key(|rest| !rest.is_stable());
        let (sin, cos) = along.sin_cos();
        let across =
            |rest: &ShaftEquilibrium| rest.displacement.translation[1] * cos - rest.displacement.translation[0] * sin;
        let mut stable: Vec<&ShaftEquilibrium> = all.iter().collect();
        stable.sort_by(|a, b| across(a).total_cmp(&across(b)));
        let places = stable.iter().map(|rest| rest.displacement.vector().component_div(&self.units()));
        let places: Vec<Five> = places.collect();
        for pair in places.windows(2) {
            let between = 0.5 * (pair[0] + pair[1]);
            self.keep(&mut all, self.search(self.start(between), load, false));
        }
        Ok(all)
    }

    /// Adds an equilibrium that is not known.
    fn keep(&self, all: &mut Vec<ShaftEquilibrium>, found: Result<Found, BearingError>) {
        let Ok(other) = found.and_then(|found| self.result(&found)) else { return };
        let apart = |known: &ShaftEquilibrium| self.apart(known, &other) > SAME * self.centre_distance();
        if other.directions_loose == 0 && all.iter().all(apart) {
            all.push(other);
        }
    }

    fn check(&self, load: &ShaftLoad) -> Result<(), BearingError> {
        for value in load.force.iter().chain(&load.moment).chain([&load.place]) {
            if !value.is_finite() {
                return refused("load", *value, "must be finite");
            }
        }
        for value in self.held.iter().flatten() {
            if !value.is_finite() {
                return refused("prescribed displacement", *value, "must be finite");
            }
        }
        Ok(())
    }

    /// Length that tilts are scaled by, m.
    fn arm(&self) -> f64 {
        self.bearings[0].bearing.geometry().pitch_radius()
    }

    fn centre_distance(&self) -> f64 {
        self.bearings[0].bearing.law.grooves.centre_distance
    }

    fn units(&self) -> Five {
        let arm = self.arm().recip();
        Five::from([1.0, 1.0, 1.0, arm, arm])
    }

    /// A start in scaled coordinates, the prescribed ones as they are to be.
    fn start(&self, aside: Five) -> Five {
        let units = self.units();
        Five::from_fn(|row, _| self.held[row].map_or(aside[row], |value| value / units[row]))
    }

    fn apart(&self, a: &ShaftEquilibrium, b: &ShaftEquilibrium) -> f64 {
        (a.displacement.vector() - b.displacement.vector()).component_div(&self.units()).amax()
    }

    /// Balance in scaled coordinates.
    fn scaled(&self, at: &Five, load: &ShaftLoad) -> Result<Balance, BearingError> {
        let units = self.units();
        let Balance { gradient, stiffness, carried } =
            self.balance(&RingDisplacement::of(at.component_mul(&units)), load)?;
        let scale = FiveByFive::from_diagonal(&units);
        Ok(Balance { gradient: gradient.component_mul(&units), stiffness: scale * stiffness * scale, carried })
    }

    fn in_load_steps(&self, start: Five, load: &ShaftLoad) -> Result<Found, BearingError> {
        let mut at = start;
        let mut found = None;
        for share in LOAD_STEPS {
            let part = ShaftLoad {
                force: load.force.map(|force| share * force),
                moment: load.moment.map(|moment| share * moment),
                place: load.place,
            };
            let next = self.search(at, &part, true)?;
            at = next.at;
            found = Some(next);
        }
        found.ok_or_else(|| BearingError("no share of the load was tried".to_owned()))
    }

    /// Walks downhill from a start to a minimum; or, not downhill, to the next place in balance, a saddle as well.
    fn search(&self, start: Five, load: &ShaftLoad, downhill: bool) -> Result<Found, BearingError> {
        let free: Vec<usize> = (0..5).filter(|&row| self.held[row].is_none()).collect();
        let reach = self.centre_distance();
        let arm = self.arm();
        let mut at = start;
        let mut balance = self.scaled(&at, load)?;
        if free.is_empty() {
            return Ok(Found { at, balance, iterations: 0, curvatures: Vec::new(), held: HELD });
        }
        let [fx, fy, fz] = load.force;
        let [mx, my] = load.moment;
        let applied = [fx, fy, fz, mx / arm, my / arm].into_iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        // what a bearing without any load is measured by
        let ball_weight = 9.81 * self.bearings[0].bearing.geometry().ball_mass();
        let (mut iterations, mut before, mut trust) = (0, f64::INFINITY, 1.0_f64);
        let mut last: Option<DVector<f64>> = None;
        // step off a saddle: to the other side and shorter each time that the search comes back
        let mut escape = 1.0_f64;
        // a place in balance that could not be left downhill
        let mut saddle_found = None;
        loop {
            let gradient = DVector::from_fn(free.len(), |row, _| balance.gradient[free[row]]);
            let stiffness = DMatrix::from_fn(free.len(), free.len(), |a, b| balance.stiffness[(free[a], free[b])]);
            let eigen = ((&stiffness + stiffness.transpose()) * 0.5).symmetric_eigen();
            let scale = applied.max(balance.carried).max(ball_weight);
            let held = HELD.min(HELD_SHARE * applied.max(balance.carried) / arm);
            let softest = (0..free.len()).min_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
            let saddle = softest.filter(|&index| downhill && eigen.eigenvalues[index] < -held);
            let error = gradient.amax();
            let round_off = ROUND_OFF * reach * stiffness.iter().fold(0.0_f64, |most, k| most.max(k.abs()));
            let balanced =
                error <= FORCE_TOLERANCE * scale || (error <= round_off && error > 0.5 * before) || error <= 0.0;
            if balanced {
                let curvatures = eigen.eigenvalues.iter().copied().collect();
                let found = Found { at, balance: balance.clone(), iterations, curvatures, held };
                if saddle.is_none() {
                    return Ok(found);
                }
                saddle_found = Some(found);
            }
            if iterations == MAX_ITERATIONS || !error.is_finite() {
                if let Some(found) = saddle_found {
                    return Ok(found);
                }
                return Err(BearingError(format!(
                    "the shaft finds no equilibrium: {error:.3e} N stay out of balance after {iterations} steps; \
                     check that the bearings can carry the load in every direction"
                )));
            }
            before = error;
            let longest = LONGEST_STEP[usize::from(iterations >= PATIENCE)] * reach;
            let leave = escape * LONGEST_STEP[0] * reach;
            let within = |most: f64| match (balanced, saddle) {
                (true, Some(index)) => eigen.eigenvectors.column(index) * leave,
                _ => {
                    let mut step = DVector::zeros(free.len());
                    for (&curvature, direction) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
                        let size = curvature.abs().max(held);
                        let along = direction.dot(&gradient) / if downhill { size } else { size.copysign(curvature) };
                        step -= direction * along.clamp(-most, most);
                    }
                    // with inertia the stiffness is not symmetric: Newton's own step is the better one near the end
                    let newton = stiffness.clone().lu().solve(&gradient).map(|newton| -newton);
                    newton.filter(|newton| newton.amax() < 1e-3 * longest && saddle.is_none()).unwrap_or(step)
                }
            };
            let mut step = within(trust * longest);
            if balanced {
                (last, trust) = (None, escape.abs());
                escape *= -TURNED_BACK;
            }
            let turned_back = |step: &DVector<f64>| last.as_ref().is_some_and(|last| last.dot(step) < 0.0);
            if downhill && turned_back(&step) {
                trust *= TURNED_BACK;
                step = within(trust * longest);
            }
            let slope = gradient.dot(&step).abs();
            let mut tried = None;
            for halving in 0..=HALVINGS {
                let mut trial = at;
                for (row, &place) in free.iter().enumerate() {
                    trial[place] += step[row];
                }
                match self.scaled(&trial, load) {
                    Ok(next) => {
                        let overrun: f64 = free.iter().zip(step.iter()).map(|(&row, s)| next.gradient[row] * s).sum();
                        let small = error <= round_off.max(1e3 * FORCE_TOLERANCE * scale);
                        let closer = match downhill {
                            true => overrun <= 0.5 * slope,
                            false => {
                                free.iter().map(|&row| next.gradient[row].powi(2)).sum::<f64>().sqrt() < gradient.norm()
                            }
                        };
                        let done = closer || small || halving == HALVINGS;
                        tried = Some((trial, next));
                        if done {
                            trust = (trust * if halving > 0 { HALVED } else { WENT_ON }).min(1.0);
                            break;
                        }
                    }
                    Err(failed) if halving == HALVINGS && tried.is_none() => return Err(failed),
                    Err(_) => {}
                }
                step *= 0.5;
            }
            if let Some((next, next_balance)) = tried {
                (at, balance) = (next, next_balance);
            }
            last = Some(step);
            iterations += 1;
        }
    }

    fn result(&self, found: &Found) -> Result<ShaftEquilibrium, BearingError> {
        let units = self.units();
        let displacement = RingDisplacement::of(found.at.component_mul(&units));
        let scale = FiveByFive::from_diagonal(&units.map(f64::recip));
        let stiffness = scale * found.balance.stiffness * scale;
        let gradient = found.balance.gradient.component_div(&units);
        let mut bearings = Vec::with_capacity(self.bearings.len());
        for (index, mounted) in self.bearings.iter().enumerate() {
            let own = self.at_bearing(index, &displacement);
            let state = mounted.bearing.state(&own, self.condition(index))?;
            for ball in &state.balls {
                if let Some(angle) = ball.contact_angle.into_iter().flatten().find(|angle| angle.cos() <= 0.0) {
                    return Err(BearingError(format!(
                        "a ball at {:.1} degrees touches a race at a contact angle of {:.1} degrees, expected less than 90: \
                         no groove reaches so far; reduce load, tilt or play",
                        ball.azimuth.to_degrees(),
                        angle.to_degrees()
                    )));
                }
            }
            let carried = state.balls.iter().any(|ball| ball.load[0] > 0.0);
            if carried && mounted.bearing.engagement(own.translation[2]) <= 0.0 {
                return Err(BearingError(format!(
                    "the load pushes the rings of an angular contact bearing apart: it holds thrust along {} only; \
                     turn the thrust round, add axial load or preload",
                    if mounted.bearing.thrust().sign() > 0.0 { "+z" } else { "-z" }
                )));
            }
            bearings.push(state);
        }
        let free = |row: usize| self.held[row].is_none();
        let residual = (0..5).filter(|&row| free(row)).map(|row| found.balance.gradient[row].abs());
        let held = found.curvatures.iter().copied().filter(|curvature| curvature.abs() > found.held);
        Ok(ShaftEquilibrium {
            displacement,
            holding_load: std::array::from_fn(|row| if free(row) { 0.0 } else { gradient[row] }),
            stiffness: std::array::from_fn(|row| std::array::from_fn(|column| stiffness[(row, column)])),
            bearings,
            iterations: found.iterations,
            residual_n: residual.fold(0.0, f64::max),
            least_stiffness: held.reduce(f64::min),
            directions_down: found.curvatures.iter().filter(|&&curvature| curvature < -found.held).count(),
            directions_loose: found.curvatures.iter().filter(|curvature| curvature.abs() <= found.held).count(),
        })
    }
}
