//! The bearing as the coupled system takes it: geometry, contacts, motion and loads in one value.

use super::load::LoadProfile;
use crate::bearing::defect::{BallFlat, RaceDefect};
use crate::bearing::{BearingGeometry, Cage, ContactStiffness, Wave};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
