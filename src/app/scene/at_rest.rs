//! What is simulated: structure and bearing of a case, at rest where they start, and what of them a run models.

use super::bearing::{contacts_of, setup_of};
use super::contact_damping::PressedBall;
use super::contacts::accept_contacts;
use super::damping::{damping, refuse_structural_damping};
use super::doubts;
use super::start::starts_in_damage;
use super::structure::{CoupledStructure, needed_modes};
use crate::app::case::RunCase;
use crate::app::error::ComputeError;
use crate::bearing::{ContactStiffness, RaceContacts};
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::Watch;
use crate::numerics::ode::{Method, State};
use crate::system::{BallsInertia, BearingSetup, CoupledSystem, Equilibrium, ModeSelection, StaticCondition};
use std::sync::Arc;

/// Structure and bearing of a case and the equilibrium that a simulation starts from.
#[derive(Debug)]
pub struct Scene {
    /// The linear model with all its modes.
    pub stage: Arc<CoupledStructure>,
    /// The bearing.
    pub setup: BearingSetup,
    /// Its contacts by Hertz from geometry and materials, whichever stiffness is in use.
    pub contacts: RaceContacts,
    /// Damping of the structure's modes.
    pub damping: ModalDamping,
    /// When it starts, s.
    pub start: f64,
    /// Equilibrium with cage and loads as they are then.
    pub equilibrium: Equilibrium,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

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

impl Scene {
    /// Builds the scene of a case.
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub fn build(run: RunCase<'_>, watch: &impl Watch) -> Result<Self, ComputeError> {
        Self::with_modes(run, needed_modes(run.case), watch)
    }

    /// The scene of a case with all modes of its structure, however many.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub(crate) fn with_all_modes(run: RunCase<'_>, watch: &impl Watch) -> Result<Self, ComputeError> {
        Self::with_modes(run, usize::MAX, watch)
    }

    fn with_modes(run: RunCase<'_>, count: usize, watch: &impl Watch) -> Result<Self, ComputeError> {
        refuse_structural_damping(run.case)?;
        let stage = CoupledStructure::around_rings(run.case, count, watch)?;
        watch.stage("equilibrium");
        Self::around(stage, run)
    }

    /// The scene of a case around ring and housing that are built already, of a case that has the same: for several runs of one
    /// structure.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn around(stage: impl Into<Arc<CoupledStructure>>, run: RunCase<'_>) -> Result<Self, ComputeError> {
        let stage = stage.into();
        let RunCase { case, bearing, .. } = run;
        let setup = setup_of(case, bearing, run.shaft)?;
        let contacts = contacts_of(case, bearing)?;
        let start = run.transient.start;
        if let Some(imported) = &stage.bodies.imported {
            imported.refuse_structural_damping()?;
        }
        let condition = StaticCondition::at(&setup, start);
        let equilibrium = Equilibrium::find(&stage.structure, &setup, condition)?;
        accept_contacts(&setup, &contacts, &equilibrium)?;
        let mut doubts = doubts(case, stage.bodies.mesh_and_model(), Some((&setup, &equilibrium)))?;
        doubts.extend(starts_in_damage(&setup, start));
        let mut scene = Self { doubts, stage, setup, contacts, damping: damping(case)?, start, equilibrium };
        scene.doubts.extend(scene.heavy_damping(run.transient.end - start));
        Ok(scene)
    }

    /// The most loaded ball at rest with these stiffnesses of the contacts; `None` where none is loaded.
    pub(crate) fn pressed_ball(&self, stiffness: &ContactStiffness) -> Option<PressedBall> {
        let loads = self.equilibrium.balls.iter().map(|ball| [ball.inner, ball.outer]);
        PressedBall::of([stiffness.inner(), stiffness.outer()], self.setup.geometry.ball_mass(), loads)
    }

    /// That contact damping makes a run of so many seconds slow.
    pub(crate) fn heavy_damping(&self, duration: f64) -> Option<String> {
        let ball = self.pressed_ball(&self.setup.stiffness)?;
        ball.doubt("bearing.contact_damping", self.setup.contact_damping, duration)
    }

    /// The scene in a model's coordinates.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a model that does not fit it.
    pub(crate) fn system(&self, model: &RunModel) -> Result<CoupledSystem, ComputeError> {
        let setup = BearingSetup { balls_inertia: model.balls_inertia, ..self.setup.clone() };
        Ok(CoupledSystem::new(
            &self.stage.structure,
            &self.stage.modes,
            setup,
            model.modes,
            &self.damping,
            model.residual,
        )?)
    }

    /// At rest in the equilibrium.
    pub(crate) fn at_rest(&self, system: &CoupledSystem) -> State {
        system.state_at(self.start, &self.equilibrium, &self.stage.modes)
    }
}
