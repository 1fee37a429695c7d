//! The bearing as the coupled system takes it: geometry, contacts, motion and loads in one value.
//!
//! A force over time: straight lines between points, constant beyond them.

use crate::bearing::defect::{BallFlat, RaceDefect};
use crate::bearing::{BearingGeometry, Cage, ContactStiffness, Wave};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// Which equations of motion: they differ by the reading of the ball position.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// Ball positions from the fixed bearing centre: symmetric, keeps energy.
    #[default]
    Consistent,
    /// The source paper's equations (3)-(16), their misprints corrected: ball position from the ring's mean centre,
    /// total ring displacement in the raceway radius (rigid motion counted twice), ball inertia coupled to the mean
    /// centre's acceleration, no weight on the ring. For reproduction only.
    Printed,
}

/// How balls follow their radial motion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BallsInertia {
    /// With their mass: a coordinate each.
    #[default]
    Dynamic,
    /// Each where its contacts, its weight and the centrifugal load balance: exact in the static limit, without the
    /// vibration of a ball between its contacts, and without contact damping.
    QuasiStatic,
}

/// The rigid shaft with the inner ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaft {
    /// Mass of shaft and inner ring, kg.
    pub mass: f64,
    /// Unbalance m e, kg m.
    pub unbalance: f64,
    /// Forces on the shaft besides its weight.
    pub loads: Vec<LoadProfile>,
}

/// A ball with a flat.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatOnBall {
    /// Which ball, from 0.
    pub ball: usize,
    /// The flat.
    pub shape: BallFlat,
    /// Its angle from the ball's outward radius vector when the shaft's angle is zero, rad.
    pub angle: f64,
}

/// Everything about the bearing that the structure does not know.
#[derive(Debug, Clone)]
pub struct BearingSetup {
    /// Radii, balls, clearance.
    pub geometry: BearingGeometry,
    /// Hertz stiffness of both races.
    pub stiffness: ContactStiffness,
    /// Hunt-Crossley coefficient, s/m; 0: none.
    pub contact_damping: f64,
    /// Which equations.
    pub formulation: Formulation,
    /// How balls follow.
    pub balls_inertia: BallsInertia,
    /// Shaft angle and ball angles over time.
    pub cage: Cage,
    /// Defects of both races; none of one race overlap. Those of the inner one turn with the shaft.
    pub race_defects: Vec<RaceDefect>,
    /// Waves round the races.
    pub waves: Vec<Wave>,
    /// How much larger than nominal the radius of each ball is, m; empty: not at all.
    pub oversizes: Vec<f64>,
    /// Flats on balls, at most one a ball.
    pub flats: Vec<FlatOnBall>,
    /// The shaft and its loads.
    pub shaft: Shaft,
    /// Gravity, m/s^2.
    pub gravity: [f64; 2],
}

impl BearingSetup {
    /// Number of balls.
    pub fn balls(&self) -> usize {
        self.geometry.balls() as usize
    }

    /// Force on the shaft at `time` (s), its weight included, the rotating unbalance not, N.
    #[inline]
    pub fn shaft_load(&self, time: f64) -> [f64; 2] {
        let weight = self.gravity.map(|g| self.shaft.mass * g);
        self.shaft.loads.iter().fold(weight, |sum, load| {
            let force = load.at(time);
            [sum[0] + force[0], sum[1] + force[1]]
        })
    }

    /// How much larger than nominal the radius of a ball is, m.
    #[inline]
    pub(crate) fn oversize(&self, ball: usize) -> f64 {
        self.oversizes.get(ball).copied().unwrap_or(0.0)
    }

    /// Number of the flat on `ball`, and its angle from the ball's radius vector when the shaft has turned to `shaft_angle`,
    /// both rad: by pure rolling a ball turns [`ball_spin`](crate::bearing::kinematics::DefectOrders::ball_spin) times
    /// against the shaft in one of its turns, seen from the cage.
    pub(crate) fn spin(&self, ball: usize, shaft_angle: f64) -> Option<(usize, f64)> {
        let number = self.flats.iter().position(|flat| flat.ball == ball)?;
        let turned = self.geometry.orders().ball_spin * shaft_angle;
        Some((number, self.flats[number].angle - turned))
    }

    /// Distance from the ring's node radius out to the raceway, m; negative inside.
    pub(crate) fn raceway_arm(&self, node_radius: f64) -> f64 {
        self.geometry.outer_race_radius() - node_radius
    }
}

/// A load over time: force in the bearing's plane (N), or so many components.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoadProfile<const N: usize = 2> {
    /// Time (s) and components; times ascending.
    points: Vec<(f64, [f64; N])>,
}

impl<const N: usize> LoadProfile<N> {
    /// The same force always.
    pub(crate) fn constant(force: [f64; N]) -> Self {
        Self { points: vec![(0.0, force)] }
    }

    /// Through points (s, components); those that do not come after the one before are left out. Without points there is no force.
    pub(crate) fn through(points: &[(f64, [f64; N])]) -> Self {
        let mut points = points.to_vec();
        points.dedup_by(|next, before| next.0.partial_cmp(&before.0) != Some(Ordering::Greater));
        Self { points }
    }

    /// The first time (s) after `time` at which the slope jumps; infinity if there is none.
    pub(crate) fn next_knot(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|point| point.0 <= time);
        self.points.get(after).map_or(f64::INFINITY, |point| point.0)
    }

    /// Components at `time` (s).
    #[inline]
    pub(crate) fn at(&self, time: f64) -> [f64; N] {
        let after = self.points.partition_point(|point| point.0 <= time);
        match (after.checked_sub(1), self.points.get(after)) {
            (Some(before), Some((end, last))) => {
                let (start, first) = self.points[before];
                let share = (time - start) / (end - start);
                std::array::from_fn(|k| first[k] + share * (last[k] - first[k]))
            }
            (Some(before), None) => self.points[before].1,
            (None, Some(&(_, first))) => first,
            (None, None) => [0.0; N],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn straight_between_points_and_constant_beyond() {
        let load = LoadProfile::through(&[(1.0, [0.0, -2.0]), (3.0, [4.0, 0.0])]);
        for (time, force) in [(0.0, [0.0, -2.0]), (1.5, [1.0, -1.5]), (3.0, [4.0, 0.0]), (9.0, [4.0, 0.0])] {
            for (found, expected) in load.at(time).into_iter().zip(force) {
                assert_relative_eq!(found, expected, epsilon = 1e-15);
            }
        }
        assert_relative_eq!(LoadProfile::constant([1.0, 2.0]).at(-7.0)[1], 2.0);
        assert_relative_eq!(LoadProfile::<2>::default().at(0.0)[0], 0.0);
        for (time, knot) in [(0.0, 1.0), (1.0, 3.0), (2.9, 3.0)] {
            assert_relative_eq!(load.next_knot(time), knot);
        }
        assert!(load.next_knot(3.0).is_infinite());
    }
}
