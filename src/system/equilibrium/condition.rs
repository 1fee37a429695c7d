//! What an equilibrium is asked for.

use crate::system::BearingSetup;

/// Cage and loads as they stand still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticCondition {
    /// Angle of ball 0, rad.
    pub cage_angle: f64,
    /// Cage speed that the centrifugal load of the balls belongs to, rad/s.
    pub cage_speed: f64,
    /// Angle of the shaft, which the defects of the inner race and the balls' flats turn with, rad.
    pub shaft_angle: f64,
    /// Force on the shaft, its weight included, N.
    pub load: [f64; 2],
}

impl StaticCondition {
    /// As they are at `time` (s); the rotating unbalance is not included.
    pub fn at(setup: &BearingSetup, time: f64) -> Self {
        let cage = setup.cage.motion(time);
        Self {
            cage_angle: cage.angle,
            cage_speed: cage.speed,
            shaft_angle: setup.cage.shaft().angle(time),
            load: setup.shaft_load(time),
        }
    }

    /// The same with the cage turned on by `angle` (rad), and the shaft as pure rolling has it.
    #[must_use]
    pub(crate) fn turned_by(self, setup: &BearingSetup, angle: f64) -> Self {
        Self {
            cage_angle: self.cage_angle + angle,
            shaft_angle: self.shaft_angle + angle / setup.geometry.orders().cage,
            ..self
        }
    }

    /// The same with `factor` times the force on the shaft.
    #[must_use]
    pub fn loaded(self, factor: f64) -> Self {
        Self { load: self.load.map(|force| factor * force), ..self }
    }
}
