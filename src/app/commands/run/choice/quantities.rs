//! Quantities of a scene that several estimates use: forces to prepare for, the equilibrium under the heaviest load, the fastest change of
//! the loads, a ball's vibration, participations of modes.

use super::pilot::Asked;
use crate::app::case;
use crate::app::error::ComputeError;
use crate::app::scene::Scene;
use crate::system::{Equilibrium, Sensor, StaticCondition, StructureModes};
use std::f64::consts::TAU;
use std::iter::successors;

/// Largest ball force to prepare for, in units of the largest static one: impacts in a dent of the source's size reach five to
/// ten times.
pub(crate) const IMPACT: f64 = 10.0;

/// Band without `[accuracy]`, Hz.
pub(crate) const USUAL_BAND: f64 = 40e3;

/// Sensors at most that the estimates of modes look at: each costs some milliseconds.
pub(crate) const JUDGED_SENSORS: usize = 64;

/// A run that a model is chosen for: the scene, and what is asked of it.
#[derive(Clone, Copy)]
pub(crate) struct RunTask<'a> {
    pub scene: &'a Scene,
    pub asked: &'a case::Transient,
    /// Top of the band, Hz.
    pub band_hz: f64,
    /// `accuracy.target`.
    pub target: f64,
    /// The instant (s) of the heaviest load and the equilibrium under it; `None` where nothing is heavier than at the start.
    pub heaviest: Option<&'a (f64, Equilibrium)>,
}

impl<'a> RunTask<'a> {
    /// What a stretch of it is asked for.
    pub(crate) fn stretch(self, strikes: bool) -> Asked<'a> {
        Asked { transient: self.asked, band_hz: self.band_hz, strikes }
    }
}

/// The sensors that the estimates of modes look at: all, or every so many of them.
pub(crate) fn judged(scene: &Scene) -> impl Iterator<Item = &Sensor> {
    let sensors = scene.stage.structure.sensors();
    let apart = sensors.len().div_ceil(JUDGED_SENSORS).max(1);
    sensors.iter().step_by(apart)
}

/// Stiffness `k' = 3/2 k^(2/3) F^(1/3)` of a contact `F = k x^(3/2)` under a force (N), N/m.
pub(crate) fn tangent(stiffness: f64, force: f64) -> f64 {
    1.5 * stiffness.cbrt().powi(2) * force.cbrt()
}

/// Frequency of a ball with these forces between its contacts, Hz.
pub(crate) fn ball_hz(scene: &Scene, inner: f64, outer: f64) -> f64 {
    let stiffness = &scene.setup.stiffness;
    let sum = tangent(stiffness.inner(), inner) + tangent(stiffness.outer(), outer);
    (sum / scene.setup.geometry.ball_mass()).sqrt() / TAU
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

/// Instants at which the speed is looked at; loads are looked at wherever one changes its slope.
const SPEED_INSTANTS: u32 = 64;

/// How much heavier than at the start a load has to be to be looked at.
const HEAVIER: f64 = 1.05;

/// That instant and equilibrium; the unbalance acts along the load there. `None` where nothing is heavier than at the start.
///
/// # Errors
/// [`ComputeError::System`] where the shaft finds no equilibrium under that load.
pub(crate) fn heaviest(asked: &case::Transient, scene: &Scene) -> Result<Option<(f64, Equilibrium)>, ComputeError> {
    let setup = &scene.setup;
    let duration = asked.end - asked.start;
    let evenly = (1..=SPEED_INSTANTS).map(|i| asked.start + duration * f64::from(i) / f64::from(SPEED_INSTANTS));
    let knots = knots(asked, scene);
    let at_rest = |t: f64| {
        let [x, y] = setup.shaft_load(t);
        x.hypot(y)
    };
    let force = |t: f64| {
        let speed = setup.cage.shaft().motion(t).speed;
        at_rest(t) + setup.shaft.unbalance.abs() * speed * speed
    };
    let most = evenly.chain(knots).fold(asked.start, |most, t| if force(t) > force(most) { t } else { most });
    if at_rest(most) <= 0.0 || force(most) <= HEAVIER * at_rest(asked.start) {
        return Ok(None);
    }
    let condition = StaticCondition::at(setup, most).loaded(force(most) / at_rest(most));
    let rest = Equilibrium::find(&scene.stage.structure, setup, condition)?;
    Ok(Some((most, rest)))
}

/// Where a load begins to change its slope between start and end, s.
fn knots(asked: &case::Transient, scene: &Scene) -> Vec<f64> {
    let of_load = scene.setup.shaft.loads.iter().flat_map(|load| {
        let all = successors(Some(load.next_knot(asked.start)), |t| Some(load.next_knot(*t)));
        all.take_while(|t| *t <= asked.end)
    });
    let mut knots: Vec<f64> = of_load.collect();
    knots.sort_by(f64::total_cmp);
    knots
}

/// Between which instants the loads change fastest; `None` where they do not change.
pub(crate) fn fastest_change(asked: &case::Transient, scene: &Scene) -> Option<[f64; 2]> {
    let mut instants = vec![asked.start];
    instants.extend(knots(asked, scene));
    instants.push(asked.end);
    let rates = instants.windows(2).filter(|ends| ends[1] > ends[0]);
    let rates = rates.map(|ends| {
        let [a, b] = [ends[0], ends[1]].map(|t| scene.setup.shaft_load(t));
        let change = (b[0] - a[0]).hypot(b[1] - a[1]);
        ([ends[0], ends[1]], change / (ends[1] - ends[0]))
    });
    let fastest = rates.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    (fastest.1 > 0.0).then_some(fastest.0)
}
