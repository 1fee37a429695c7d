//! Where the runs of an ensemble begin: instants over one ball pass, each at rest in its own equilibrium.

use super::{ChartError, Settings};
use crate::app::scene::Scene;
use crate::numerics::ode::State;
use crate::system::{CoupledSystem, Equilibrium, StaticCondition};
use rayon::prelude::*;

/// Halvings that find the end of a ball pass.
const HALVINGS: usize = 60;

/// A start of a run.
#[derive(Debug, Clone)]
pub struct Start {
    /// Number in the ensemble, from 0.
    pub number: usize,
    /// When, s.
    pub time_s: f64,
    /// At rest in this.
    pub equilibrium: Equilibrium,
}

/// The starts of a scene's ensemble.
#[derive(Debug, Clone)]
pub struct Starts {
    /// Those with an equilibrium, in order of time.
    pub starts: Vec<Start>,
    /// Time over which they are spread, s: a ball pass, or less if the simulated time ends before.
    pub spread_s: f64,
    /// Starts that have no equilibrium, and why.
    pub left_out: Vec<String>,
}

impl Starts {
    /// As many as the ensemble has runs, evenly over the time in which the cage turns by a ball's distance, at most `length`
    /// (s), each from the equilibrium with cage and loads held as they are then.
    ///
    /// # Errors
    /// [`ChartError::NoStarts`] if fewer than two have an equilibrium.
    pub(crate) fn over_ball_pass(scene: &Scene, settings: &Settings, length: f64) -> Result<Self, ChartError> {
        let wanted = settings.ensemble.runs;
        let spread_s = ball_pass(scene, length);
        let found: Vec<_> = (0..wanted)
            .into_par_iter()
            .map(|number| {
                let time_s = scene.start + spread_s * number as f64 / wanted as f64;
                let condition = StaticCondition::at(&scene.setup, time_s);
                let found = Equilibrium::find(&scene.stage.structure, &scene.setup, condition);
                (time_s, number, found)
            })
            .collect();
        let mut starts = Vec::with_capacity(wanted);
        let mut left_out = Vec::new();
        let mut first = None;
        for (time_s, number, found) in found {
            match found {
                Ok(equilibrium) => starts.push(Start { number, time_s, equilibrium }),
                Err(error) => {
                    left_out.push(format!("start at {time_s} s: {error}"));
                    first.get_or_insert(error);
                }
            }
        }
        match first {
            Some(source) if starts.len() < 2 => Err(ChartError::NoStarts { found: starts.len(), wanted, source }),
            _ => Ok(Self { starts, spread_s, left_out }),
        }
    }
}

impl Start {
    /// At rest there, in a system's coordinates.
    pub(crate) fn state(&self, scene: &Scene, system: &CoupledSystem) -> State {
        system.state_at(self.time_s, &self.equilibrium, &scene.stage.modes)
    }
}

/// Time from the start in which the cage turns by the distance of two balls, s, at most `length`.
fn ball_pass(scene: &Scene, length: f64) -> f64 {
    let cage = &scene.setup.cage;
    let from = cage.motion(scene.start).angle;
    let turned = |time: f64| (cage.motion(scene.start + time).angle - from).abs();
    if turned(length) <= cage.spacing() {
        return length;
    }
    let (mut low, mut high) = (0.0, length);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if turned(middle) < cage.spacing() {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
