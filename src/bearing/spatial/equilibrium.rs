//! Where a shaft rests: a search downhill, and the other equilibria that clearance allows.
//!
//! Tilts are scaled by the pitch radius, so that all coordinates are lengths and all forces N; see `search.rs`.

use super::assembly::{BearingState, Five, FiveByFive};
use super::ring::RingDisplacement;
use super::search::Found;
use super::shaft::{Balance, RigidShaft, ShaftLoad};
use crate::bearing::error::{BearingError, refused};
use std::f64::consts::TAU;

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

impl RigidShaft {
    /// The stable equilibrium to which the load leads from the undisplaced place.
    ///
    /// # Errors
    /// [`BearingError`]: a load or a prescribed displacement that is not finite; no equilibrium, with the force that stays out of
    /// balance; an angular contact bearing whose rings the load pushes apart.
    pub fn equilibrium(&self, load: &ShaftLoad) -> Result<ShaftEquilibrium, BearingError> {
        self.check(load)?;
        let start = self.start(Five::zeros());
        let found = match self.descend(start, load, false) {
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
        self.descend(start, load, true).and_then(|found| self.result(&found)).or_else(|_| self.equilibrium(load))
    }

    /// The equilibrium of [`Self::equilibrium`] first, then the other stable ones that are found from starts to several sides, then
    /// the saddles between neighbours. Places along a direction
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
                self.keep(&mut all, self.descend(self.start(aside), load, false));
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
            self.keep(&mut all, self.next_in_balance(self.start(between), load));
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
    pub(super) fn arm(&self) -> f64 {
        self.bearings[0].bearing.geometry().pitch_radius()
    }

    pub(super) fn centre_distance(&self) -> f64 {
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
    pub(super) fn scaled(&self, at: &Five, load: &ShaftLoad) -> Result<Balance, BearingError> {
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
            let next = self.descend(at, &part, false)?;
            at = next.at;
            found = Some(next);
        }
        found.ok_or_else(|| BearingError("no share of the load was tried".to_owned()))
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
