//! Quantities of a scene that several estimates use: forces to prepare for, a ball's vibration, participations of modes.

use crate::app::scene::{RunModel, Scene};
use crate::system::{BallsInertia, Sensor, StructureModes};
use std::f64::consts::TAU;

/// Largest ball force to prepare for, in units of the largest static one: impacts in a dent of the source's size reach five to
/// ten times.
pub(crate) const IMPACT: f64 = 10.0;

/// Band without `[accuracy]`, Hz.
pub(crate) const USUAL_BAND: f64 = 40e3;

/// Sensors at most that the estimates of modes look at: each costs some milliseconds.
pub(crate) const JUDGED_SENSORS: usize = 64;

/// The sensors that the estimates of modes look at: all, or every so many of them.
pub(crate) fn judged(scene: &Scene) -> impl Iterator<Item = &Sensor> {
    let sensors = scene.stage.structure.sensors();
    let apart = sensors.len().div_ceil(JUDGED_SENSORS).max(1);
    sensors.iter().step_by(apart)
}

/// Angular frequency of a ball with these forces between its contacts, rad/s.
pub(crate) fn ball_frequency(scene: &Scene, inner: f64, outer: f64) -> f64 {
    let stiffness = &scene.setup.stiffness;
    let tangent = |stiffness: f64, force: f64| 1.5 * stiffness.cbrt().powi(2) * force.cbrt();
    let sum = tangent(stiffness.inner(), inner) + tangent(stiffness.outer(), outer);
    (sum / scene.setup.geometry.ball_mass()).sqrt()
}

/// Hz.
pub(crate) fn hertz(angular: f64) -> f64 {
    angular / TAU
}

/// Whether a bearing's balls are stepped with their mass.
pub(crate) fn dynamic(model: &RunModel) -> bool {
    model.balls_inertia == BallsInertia::Dynamic
}

pub(crate) fn participations(modes: &StructureModes, row: &[f64]) -> Vec<f64> {
    (0..modes.count()).map(|mode| modes.participation(mode, row)).collect()
}

/// Participations of radial forces at angles (rad) of the raceway.
pub(crate) fn radial_forces(scene: &Scene, angles: impl Iterator<Item = f64>) -> Vec<Vec<f64>> {
    let structure = &scene.stage.structure;
    let mut row = vec![0.0; structure.dof()];
    angles
        .map(|angle| {
            let rows = structure.ring().rows_at(angle);
            row.fill(0.0);
            for (dof, value) in rows.dofs.into_iter().zip(rows.radial) {
                row[dof] += value;
            }
            participations(&scene.stage.modes, &row)
        })
        .collect()
}
