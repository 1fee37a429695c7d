//! The bearing as the coupled system takes it: geometry, contacts, motion and loads in one value.

use crate::bearing::defect::Dent;
use crate::bearing::{BearingGeometry, Cage, ContactStiffness, SpeedProfile};

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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaft {
    /// Mass of shaft and inner ring, kg.
    pub mass: f64,
    /// Unbalance m e, kg m.
    pub unbalance: f64,
    /// Constant force on the shaft besides its weight, N.
    pub force: [f64; 2],
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
    /// Ball angles from the shaft angle.
    pub cage: Cage,
    /// Shaft speed over time.
    pub speed: SpeedProfile,
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

    /// Constant force on the shaft, its weight included, N.
    pub fn shaft_load(&self) -> [f64; 2] {
        let Shaft { mass, force, .. } = self.shaft;
        [
            force[0] + mass * self.gravity[0],
            force[1] + mass * self.gravity[1],
        ]
    }

    /// Distance from the ring's node radius out to the raceway, m; negative inside.
    pub fn raceway_arm(&self, node_radius: f64) -> f64 {
        self.geometry.outer_race_radius() - node_radius
    }
}
