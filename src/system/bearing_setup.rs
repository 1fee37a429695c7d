//! The bearing as the coupled system takes it: geometry, contacts, motion and loads in one value.

use super::load::LoadProfile;
use crate::bearing::defect::Dent;
use crate::bearing::{BearingGeometry, Cage, ContactStiffness};

/// Which reading of the ball position the equations follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Formulation {
    /// Ball position from the fixed bearing centre: symmetric, energy-conserving.
    #[default]
    Consistent,
    /// The source's equations (3)-(16): ball position from the ring's mean centre, total ring
    /// displacement in the raceway radius (rigid motion counted twice), ball inertia coupled to the
    /// mean centre's acceleration, no weight on the ring. For reproduction only.
    Printed,
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
    /// Shaft angle and ball angles over time.
    pub cage: Cage,
    /// Dents of the outer race, none overlapping.
    pub dents: Vec<Dent>,
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
    pub fn shaft_load(&self, time: f64) -> [f64; 2] {
        let weight = self.gravity.map(|g| self.shaft.mass * g);
        self.shaft.loads.iter().fold(weight, |sum, load| {
            let force = load.at(time);
            [sum[0] + force[0], sum[1] + force[1]]
        })
    }

    /// Distance from the ring's node radius out to the raceway, m; negative inside.
    pub fn raceway_arm(&self, node_radius: f64) -> f64 {
        self.geometry.outer_race_radius() - node_radius
    }
}
