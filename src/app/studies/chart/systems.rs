//! Coupled systems that are built once: tables over the raceway take longer than many a short run.

use super::Start;
use super::trace::Failure;
use crate::app::scene::{RunModel, Scene};
use crate::numerics::ode::State;
use crate::system::CoupledSystem;

/// A system, ready to begin anywhere.
pub(super) struct Ready<'a> {
    scene: &'a Scene,
    system: CoupledSystem,
}

/// The systems of a scene's models, each built when it is first asked for.
pub(super) struct Systems<'a> {
    scene: &'a Scene,
    /// A model and its system; models that differ by method or step alone share one.
    built: Vec<(RunModel, Ready<'a>)>,
}

impl<'a> Ready<'a> {
    /// A system that is at hand.
    pub(super) fn new(scene: &'a Scene, system: CoupledSystem) -> Self {
        Self { scene, system }
    }

    /// The system, and its state at rest at a start.
    pub(super) fn at(&self, start: &Start) -> (CoupledSystem, State) {
        let state = start.state(self.scene, &self.system);
        (self.system.clone(), state)
    }
}

impl<'a> Systems<'a> {
    /// None built yet.
    pub(super) fn new(scene: &'a Scene) -> Self {
        Self { scene, built: Vec::new() }
    }

    /// The system of a model.
    ///
    /// # Errors
    /// [`Failure`] for a model that does not fit the scene.
    pub(super) fn of(&mut self, model: &RunModel) -> Result<&Ready<'a>, Failure> {
        let same = |other: &RunModel| {
            let method = (model.method, model.step);
            RunModel { method: method.0, step: method.1, ..*other } == *model
        };
        let known = self.built.iter().position(|(other, _)| same(other));
        let place = match known {
            Some(place) => place,
            None => {
                let system = self.scene.system(model)?;
                self.built.push((*model, Ready::new(self.scene, system)));
                self.built.len() - 1
            }
        };
        Ok(&self.built[place].1)
    }
}
