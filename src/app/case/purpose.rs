//! What a command needs of a case, and a case that has what a simulation needs.

use super::error::CaseError;
use super::{Bearing, Case, Interface, Linearise, Ring, Shaft, Speed, Transient};

/// What a case is to be used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Eigenfrequencies.
    Modes,
    /// A condensed housing.
    Condense,
    /// Transfer paths.
    Frf,
    /// The simulation in time.
    Run,
    /// Speed against accuracy of the simulation.
    Chart,
}

/// A case with every part that a simulation in time needs; see [`Case::for_run`].
#[derive(Debug, Clone, Copy)]
pub struct RunCase<'c> {
    /// The whole case: what has a default or may be absent, such as damping and analysis, is taken from it.
    pub case: &'c Case,
    /// The ring.
    pub ring: &'c Ring,
    /// Balls, races and contacts.
    pub bearing: &'c Bearing,
    /// The shaft with the inner ring.
    pub shaft: &'c Shaft,
    /// Shaft speed over time.
    pub speed: &'c Speed,
    /// The simulation in time; that of the case, or another in its place.
    pub transient: &'c Transient,
}

/// Why a table is needed: the case, and the computation or key that needs it.
#[derive(Clone, Copy)]
struct Need<'c> {
    case: &'c Case,
    by: &'static str,
}

impl Need<'_> {
    /// The part of this name, if it is there.
    fn of<T>(self, table: &'static str, part: Option<T>) -> Result<T, CaseError> {
        part.ok_or_else(|| {
            let what = format!("{} needs {table}, which the case file lacks", self.by);
            let help = format!("add {table} to the case file");
            CaseError::at(self.case.source.path.display(), what).with_help(Some(help))
        })
    }

    /// Something that is there or not.
    fn that(self, table: &'static str, present: bool) -> Result<(), CaseError> {
        self.of(table, present.then_some(()))
    }
}

impl Case {
    /// Checks that the case has the tables that a purpose needs.
    ///
    /// # Errors
    /// [`CaseError`] with the first table that it lacks.
    pub fn ready_for(&self, purpose: Purpose) -> Result<(), CaseError> {
        let need = |by| Need { case: self, by };
        let interface = self.ring.as_ref().is_some_and(|ring| ring.tie.is_some())
            || self.superelement().is_some()
            || self.condense.interface != Interface::Ring;
        match purpose {
            Purpose::Run => self.for_run().map(|_| ()),
            Purpose::Chart => self.for_chart().map(|_| ()),
            Purpose::Modes => match self.modes.linearise {
                Linearise::None => Ok(()),
                Linearise::Static => self.at_rest(need("`modes.linearise = \"static\"`")).map(|_| ()),
            },
            Purpose::Condense => {
                let need = need("`condense`");
                need.that("[housing]", self.housing.is_some())?;
                let table = "ring.tie, or condense.interface = { group = \"NAME\" }";
                need.that(table, interface)
            }
            Purpose::Frf => {
                let need = need("`frf`");
                need.that("[housing]", self.housing.is_some())?;
                need.that("[frf]", self.frf.is_some())?;
                need.that("[[sensors]]", !self.sensors.is_empty())?;
                let damped = self.damping.is_some() || self.has_loss_factor();
                need.that("[damping], or loss_factor of a material", damped)?;
                let table = "ring.tie, or condense.interface = { nodes = [TAGS] }";
                need.that(table, interface)
            }
        }
    }

    /// Returns the parts that `run` needs.
    ///
    /// # Errors
    /// [`CaseError`] with the first table that the case lacks.
    pub fn for_run(&self) -> Result<RunCase<'_>, CaseError> {
        self.simulated("`run`")
    }

    /// Returns the parts that `chart` needs: those of a run.
    ///
    /// # Errors
    /// As [`Case::for_run`].
    pub(crate) fn for_chart(&self) -> Result<RunCase<'_>, CaseError> {
        self.simulated("`chart`")
    }

    fn simulated(&self, by: &'static str) -> Result<RunCase<'_>, CaseError> {
        let need = Need { case: self, by };
        let (ring, bearing, shaft) = self.at_rest(need)?;
        let speed = need.of("[speed]", self.speed.as_ref())?;
        let transient = need.of("[transient]", self.transient.as_ref())?;
        need.that("[[sensors]]", !self.sensors.is_empty())?;
        Ok(RunCase { case: self, ring, bearing, shaft, speed, transient })
    }

    /// What an equilibrium under the load needs.
    fn at_rest(&self, need: Need<'_>) -> Result<(&Ring, &Bearing, &Shaft), CaseError> {
        let ring = need.of("[ring]", self.ring.as_ref())?;
        let bearing = need.of("[bearing]", self.bearing.as_ref())?;
        let shaft = need.of("[shaft]", self.shaft.as_ref())?;
        let held = !ring.supports.is_empty()
            || (self.meshed_housing()).is_some_and(|housing| !housing.supports.is_empty())
            // what holds it is in its stiffness
            || self.superelement().is_some();
        need.that("a support in [housing] or [ring]", held)?;
        Ok((ring, bearing, shaft))
    }

    /// Whether a part of the housing is of a material with a loss factor.
    fn has_loss_factor(&self) -> bool {
        let mut parts = self.meshed_housing().into_iter().flat_map(|housing| &housing.parts);
        parts.any(|part| {
            let material = self.material(&part.material);
            material.is_some_and(|material| material.loss_factor() > 0.0)
        })
    }
}
