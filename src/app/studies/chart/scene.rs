//! What a chart simulates: one bearing in its plane, or a shaft in bearings in space; and systems of its models.

use super::budget::Deadline;
use crate::app::case::{AskedRun, Case, RunCase, Transient};
use crate::app::commands::parts;
use crate::app::commands::run::choice::ModelChoice;
use crate::app::commands::run::choice::pilot::{next_on, next_strike};
use crate::app::commands::run::{Simulation, Span};
use crate::app::error::ComputeError;
use crate::app::scene::{CoupledStructure, MachineScene, RunModel, Scene};
use crate::bearing::Cage;
use crate::numerics::Watch;
use crate::numerics::ode::State;
use crate::report::Table;
use crate::system::{
    CoupledSystem, Equilibrium, Simulated, SpatialCondition, SpatialEquilibrium, SpatialSystem, StaticCondition,
    StructureModes, SystemError,
};

/// What a chart simulates.
#[derive(Debug)]
pub enum ChartScene {
    /// One bearing in its plane.
    InPlane(Box<Scene>),
    /// A shaft in bearings that carry axial load and tilt.
    InSpace(Box<MachineScene>),
}

/// A model's system, ready to begin anywhere. It is built once: tables over the raceway take longer than many a short run.
pub(super) enum Ready<'a> {
    InPlane(&'a Scene, Box<CoupledSystem>),
    /// With the basis of its structure.
    InSpace(&'a MachineScene, Box<SpatialSystem>, StructureModes),
}

impl ChartScene {
    /// The scene of a case with all modes of its structure.
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub(super) fn build(run: &AskedRun<'_>, watch: &impl Watch) -> Result<Self, ComputeError> {
        Ok(match run {
            AskedRun::InPlane(run) => Self::InPlane(Box::new(Scene::with_all_modes(*run, watch)?)),
            AskedRun::InSpace(run, asked) => {
                Self::InSpace(Box::new(MachineScene::with_all_modes(run, [asked.start, asked.end], watch)?))
            }
        })
    }

    /// Housing, rings and their modes.
    pub(crate) fn stage(&self) -> &CoupledStructure {
        match self {
            Self::InPlane(scene) => &scene.stage,
            Self::InSpace(scene) => &scene.stage,
        }
    }

    /// When it starts, s.
    pub(super) fn start(&self) -> f64 {
        match self {
            Self::InPlane(scene) => scene.start,
            Self::InSpace(scene) => scene.start,
        }
    }

    /// The cage of the first bearing.
    pub(super) fn cage(&self) -> &Cage {
        match self {
            Self::InPlane(scene) => &scene.setup.cage,
            Self::InSpace(scene) => &scene.setup.bearings[0].cage,
        }
    }

    /// What of the model may be meant otherwise, a sentence each.
    pub(crate) fn doubts(&self) -> &[String] {
        match self {
            Self::InPlane(scene) => &scene.doubts,
            Self::InSpace(scene) => &scene.doubts,
        }
    }

    /// Adds a sentence to them.
    pub(super) fn doubt(&mut self, text: String) {
        match self {
            Self::InPlane(scene) => scene.doubts.push(text),
            Self::InSpace(scene) => scene.doubts.push(text),
        }
    }

    /// The model that the program chooses for `asked` in the place of the case's own.
    ///
    /// # Errors
    /// [`ComputeError`] for a model that does not fit the scene.
    pub(super) fn choice(&self, case: &Case, asked: &Transient) -> Result<RunModel, ComputeError> {
        let choice = match self {
            Self::InPlane(scene) => ModelChoice::of_case(RunCase { transient: asked, ..case.for_run()? }, scene)?,
            Self::InSpace(scene) => ModelChoice::in_space(case, asked, scene)?,
        };
        Ok(choice.model)
    }

    /// The system of a model.
    ///
    /// # Errors
    /// [`ComputeError`] for a model that does not fit the scene.
    pub(super) fn ready(&self, model: &RunModel) -> Result<Ready<'_>, ComputeError> {
        Ok(match self {
            Self::InPlane(scene) => Ready::InPlane(scene, Box::new(scene.system(model)?)),
            Self::InSpace(scene) => {
                let (system, basis) = scene.system(model)?;
                Ready::InSpace(scene, Box::new(system), basis)
            }
        })
    }

    /// The equilibrium with cages and loads as they are at an instant (s): of a bearing in its plane, whatever the model; in space there is
    /// one, and each model rests beside it.
    ///
    /// # Errors
    /// [`SystemError`] where nothing rests.
    pub(super) fn rest(&self, time: f64) -> Result<Option<Equilibrium>, SystemError> {
        match self {
            Self::InPlane(scene) => {
                let condition = StaticCondition::at(&scene.setup, time);
                Equilibrium::find(&scene.stage.structure, &scene.setup, condition).map(Some)
            }
            Self::InSpace(scene) => {
                let condition = SpatialCondition::at(&scene.setup, time);
                SpatialEquilibrium::find(&scene.stage.structure, &scene.setup, &condition).map(|_| None)
            }
        }
    }

    /// In how many seconds from an instant (s) on a ball comes to the edge of the first defect of a race, or leaves the one that it is in;
    /// `None` without such a defect, or where balls do not pass it.
    pub(super) fn next_strike(&self, at: f64) -> Option<f64> {
        let nearer = |(until, left): (f64, Option<f64>)| left.unwrap_or(until).min(until);
        match self {
            Self::InPlane(scene) => next_strike(scene, at).map(nearer),
            Self::InSpace(scene) => {
                let bearings = scene.setup.bearings.iter().zip(&scene.orders);
                let strikes = bearings.filter_map(|(own, orders)| {
                    next_on(own.bearing.defects().first()?.profile(), &own.cage, orders.cage, at)
                });
                strikes.map(nearer).reduce(f64::min)
            }
        }
    }

    /// Whether a race has a defect.
    pub(super) fn is_damaged(&self) -> bool {
        match self {
            Self::InPlane(scene) => !scene.setup.race_defects.is_empty(),
            Self::InSpace(scene) => scene.setup.has_defects(),
        }
    }

    /// Its bearings in a table.
    pub(super) fn bearing_table(&self) -> Table {
        match self {
            Self::InPlane(scene) => parts::bearing_table(&scene.setup, &scene.contacts, Some(&scene.equilibrium)),
            Self::InSpace(scene) => parts::bearings_table(scene),
        }
    }

    /// What is assumed, a sentence each.
    pub(super) fn assumptions(&self, case: &Case) -> Vec<String> {
        match self {
            Self::InPlane(scene) => parts::assumptions(case, Some(&scene.setup)),
            Self::InSpace(scene) => {
                [parts::assumptions(case, None), parts::assumptions_in_space(&scene.setup)].concat()
            }
        }
    }
}

impl Ready<'_> {
    /// The state at rest at an instant (s); in its plane in an equilibrium that is known, or in that of the scene's start.
    ///
    /// # Errors
    /// [`ComputeError::System`] where the model does not rest.
    pub(super) fn at_rest(&self, time: f64, known: Option<&Equilibrium>) -> Result<State, ComputeError> {
        match self {
            Self::InPlane(scene, system) => {
                Ok(system.state_at(time, known.unwrap_or(&scene.equilibrium), &scene.stage.modes))
            }
            Self::InSpace(scene, system, basis) => scene.rest_in(system, basis, time),
        }
    }

    /// A simulation of a model from a state on.
    ///
    /// # Errors
    /// [`ComputeError`], also where it is not done at `until`.
    pub(super) fn from(
        &self,
        state: State,
        model: &RunModel,
        span: Span,
        until: Deadline,
    ) -> Result<Simulation, ComputeError> {
        match self {
            Self::InPlane(_, system) => kept((**system).clone(), state, model, span, until),
            Self::InSpace(_, system, _) => kept((**system).clone(), state, model, span, until),
        }
    }
}

fn kept(
    system: impl Simulated,
    state: State,
    model: &RunModel,
    span: Span,
    mut until: Deadline,
) -> Result<Simulation, ComputeError> {
    Simulation::kept(system, state, model, span, false, &mut until, |_| ())
}
