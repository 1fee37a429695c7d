//! What is simulated: structure and bearing of a case, at rest where they start.

use super::bearing::{bearing_setup, race_contacts};
use super::contact_limits::accept_contacts;
use super::damping::{damping, refuse_structural_damping};
use super::doubts;
use super::run_model::RunModel;
use super::structure::CoupledStructure;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::bearing::{Race, RaceContacts};
use crate::numerics::Watch;
use crate::numerics::ode::State;
use crate::system::{
    BearingSetup, CoupledSystem, Equilibrium, ModeDamping, StaticCondition, SystemError,
};

/// Structure and bearing of a case and the equilibrium that a simulation starts from.
#[derive(Debug)]
pub struct Scene {
    /// The linear model with all its modes.
    pub stage: CoupledStructure,
    /// The bearing.
    pub setup: BearingSetup,
    /// Its contacts by Hertz from geometry and materials, whichever stiffness is in use.
    pub contacts: RaceContacts,
    /// Damping of the structure's modes.
    pub damping: ModeDamping,
    /// When it starts, s.
    pub start: f64,
    /// Equilibrium with cage and loads as they are then.
    pub equilibrium: Equilibrium,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

impl Scene {
    /// Builds the scene of a case.
    ///
    /// # Errors
    /// [`ComputeError`] of the stages that it goes through.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
        refuse_structural_damping(case)?;
        Self::built(CoupledStructure::build(case, watch)?, case, watch)
    }

    /// The scene of a case with all modes of its structure, however many.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn with_all_modes(case: &Case, watch: &impl Watch) -> Result<Self, ComputeError> {
        refuse_structural_damping(case)?;
        let stage = CoupledStructure::with_modes(case, usize::MAX, watch)?;
        Self::built(stage, case, watch)
    }

    fn built(
        stage: Option<CoupledStructure>,
        case: &Case,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        // a run without ring, bearing, shaft or transient was refused with the case
        let stage = stage.ok_or(SystemError::NotSupported)?;
        watch.stage("equilibrium");
        Self::around(stage, case)
    }

    /// The scene of a case around ring and housing that are built already, of a case that has the same: for several runs of one
    /// structure.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn around(stage: CoupledStructure, case: &Case) -> Result<Self, ComputeError> {
        let bearing = (bearing_setup(case)?, race_contacts(case)?);
        let ((Some(setup), Some(contacts)), Some(asked)) = (bearing, case.transient.as_ref())
        else {
            return Err(SystemError::NotSupported.into());
        };
        if let Some(imported) = &stage.imported {
            imported.refuse_structural_damping()?;
        }
        let condition = StaticCondition::at(&setup, asked.start);
        let equilibrium = Equilibrium::find(&stage.structure, &setup, condition)?;
        accept_contacts(&setup, &contacts, &equilibrium)?;
        let housing = stage.housing.as_ref();
        let housing = housing.map(|housing| (&housing.mesh, &housing.model));
        Ok(Self {
            doubts: doubts(case, housing, Some((&setup, &equilibrium)))?,
            stage,
            setup,
            contacts,
            damping: damping(case)?,
            start: asked.start,
            equilibrium,
        })
    }

    /// The scene in a model's coordinates.
    ///
    /// # Errors
    /// [`ComputeError::System`] for a model that does not fit it.
    pub fn system(&self, model: &RunModel) -> Result<CoupledSystem, ComputeError> {
        let setup = BearingSetup {
            balls_inertia: model.balls_inertia,
            ..self.setup.clone()
        };
        Ok(CoupledSystem::new(
            &self.stage.structure,
            &self.stage.modes,
            setup,
            model.modes,
            self.damping,
            model.residual,
        )?)
    }

    /// At rest in the equilibrium.
    pub fn at_rest(&self, system: &CoupledSystem) -> State {
        system.state_at(self.start, &self.equilibrium, &self.stage.modes)
    }

    /// Whether the outer race has no defect.
    pub fn outer_race_is_sound(&self) -> bool {
        let mut defects = self.setup.race_defects.iter();
        !defects.any(|defect| defect.race() == Race::Outer)
    }
}
