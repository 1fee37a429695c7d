//! What of a scene is modelled, and how it is stepped.

use crate::numerics::ode::Method;
use crate::system::{BallsInertia, ModeSelection};

/// What of a scene is modelled, and how it is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunModel {
    /// Kept modes of ring and housing.
    pub modes: ModeSelection,
    /// Whether the static flexibility of the others acts in contacts and sensors.
    pub residual: bool,
    /// Whether the balls have inertia.
    pub balls_inertia: BallsInertia,
    /// Integration method.
    pub method: Method,
    /// Largest step, or time between samples of a method that chooses its steps, s.
    pub step: f64,
}
