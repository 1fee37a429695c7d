//! A run's model and why it is this one, with the warnings that follow from it.

use crate::app::scene::RunModel;
use crate::report::{Cell, Column, Table, significant};
use crate::system::ModeSelection;
use schemars::JsonSchema;
use serde::Serialize;

/// The parts that are a superelement from a file and a housing condensed for the run.
pub(crate) const SUPERELEMENT: &str = "superelement";
pub(crate) const CONDENSATION: &str = "condensation";

/// Signals below this are taken for rest, m/s^2: no accelerometer for machines resolves less.
pub(crate) const REST: f64 = 1e-3;

/// A model, and why it is this one.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelChoice {
    /// The model.
    pub model: RunModel,
    /// What was chosen or given, in the order modes, balls, method, largest step, and a superelement or a condensed housing.
    pub parts: Vec<ChosenPart>,
    /// Root of the sum of the parts' squared errors, relative, in the band; `None` if a part has no estimate.
    pub estimated_error: Option<f64>,
    /// How many times the linear estimate of modes and steps it takes, as balls strike.
    pub growth: f64,
    /// Up to which frequency the vectors of a condensed housing have to be complete for the target, Hz.
    pub(crate) complete_for_hz: f64,
    /// The stretch that showed the error of modes and steps; `None` where it was not measured.
    pub measured: Option<Measured>,
    /// The longest step in which small motions at rest do not grow, s, where the case gives a longer one.
    pub stable_s: Option<f64>,
    /// `accuracy.target`.
    pub target: f64,
}

/// One part of a model.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ChosenPart {
    /// Which part.
    pub what: &'static str,
    /// What it is.
    pub chosen: String,
    /// Why, with what was left out.
    pub why: String,
    /// Relative error in the band that it is expected to make; `None` where there is no estimate.
    pub estimated_error: Option<f64>,
}

impl ModelChoice {
    /// That the case's step is beyond the stable one, and that the model errs by more than the target, with its largest part and what helps: a sentence each.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let unstable = self.stable_s.map(|stable_s| {
            format!(
                "transient.step makes steps of {} s, longer than the {} s up to which {} keeps small motions at rest from growing: what they grow to, contacts may hold without a blow-up, and the signals cannot be trusted. Shorten it, or leave it to the program.",
                significant(self.model.step, 5),
                significant(stable_s, 5),
                self.model.method.name()
            )
        });
        unstable.into_iter().chain(self.missed()).collect()
    }

    /// Why signals by this model cannot be trusted, if they cannot: a warning has the figures.
    pub(crate) fn distrust(&self) -> Option<&'static str> {
        if self.stable_s.is_some() {
            Some("the step is longer than small motions at rest bear")
        } else if self.measured.is_some_and(|found| found.error >= 1.0 && found.rms > REST) {
            Some("on a stretch a finer run differs by as much as they are")
        } else if self.lacks_vectors() && self.measured.is_none_or(|found| found.rms > REST) {
            Some("the condensed housing has so few vectors that their estimated error is as large as they are")
        } else {
            None
        }
    }

    /// Whether a superelement or the condensed housing lacks so many vectors that its part of the error is as large as the signals.
    pub(crate) fn lacks_vectors(&self) -> bool {
        let mut parts = self.parts.iter().filter(|part| [SUPERELEMENT, CONDENSATION].contains(&part.what));
        parts.any(|part| part.estimated_error.is_some_and(|error| error >= 1.0))
    }

    /// The model's parts with reasons and estimated errors.
    pub(crate) fn table(&self) -> Table {
        let columns = ["Part", "Chosen", "Why, and what is left out", "Estimated error"].map(Column::text);
        let row = |what: &str, chosen: &str, why: &str, error: Option<f64>| {
            let error = error.map_or_else(|| "not estimated".to_owned(), |error| significant(error, 2));
            [Cell::text(what), Cell::text(chosen), Cell::text(why), Cell::text(error)]
        };
        let parts = self.parts.iter().map(|part| row(part.what, &part.chosen, &part.why, part.estimated_error));
        let together = "root of the sum of squares, relative, in the band, while nearby solutions stay together";
        let together = row("together", "", together, self.estimated_error);
        Table::new("The model, and why it is this one", columns).rows(parts).row(together)
    }

    fn missed(&self) -> Option<String> {
        let target = self.target;
        let parts = self.parts.iter();
        let parts = parts.filter_map(|part| Some((part, part.estimated_error?)));
        let largest = parts.max_by(|(_, a), (_, b)| a.total_cmp(b));
        let Some(together) = self.estimated_error else {
            let ChosenPart { what, chosen, why, .. } = self.parts.iter().find(|part| part.estimated_error.is_none())?;
            return Some(format!(
                "the error of the signals is not estimated: that of the {what} ({chosen}; {why}) is not known"
            ));
        };
        let (part, error) = largest?;
        if together <= target {
            return None;
        }
        let given = |what: &str| self.parts.iter().any(|part| part.what == what && part.why.starts_with("given"));
        // what the program chooses keeps the linear estimate below the target
        let grown = self.growth > 1.0 && together <= self.growth * target;
        let help = match part.what {
            SUPERELEMENT | CONDENSATION => &format!(
                "condense with more vectors by condense.fixed_interface_modes: this part falls about with the cube of their highest frequency; try {{ up_to_hz = {:.1e} }}",
                self.complete_for_hz
            ),
            "method" if given("largest step") => "leave transient.step to the program",
            "method" if given("method") && !self.model.method.chooses_its_steps() => {
                "leave transient.method to the program: its own method takes steps by the target"
            }
            "method" if !self.model.residual && self.model.modes != ModeSelection::All => {
                "transient.residual = true lets the modes that are left out act statically"
            }
            _ if grown && !given(part.what) => &format!(
                "impacts of the balls amplify errors up to {} times, which the choice of the model does not count; accuracy.target = {} allows for that",
                significant(self.growth, 2),
                significant(target / self.growth, 2)
            ),
            "modes" => "raise transient.modes; the error need not fall with each of them where balls strike",
            "balls" => "set bearing.balls_inertia = \"dynamic\"",
            _ => {
                "a smaller accuracy.target shortens the steps; an error near 1 says that such a motion cannot be predicted for so long"
            }
        };
        Some(format!(
            "the estimated error is {} where accuracy.target is {}, most of it of the {} ({}; {}): {help}",
            significant(together, 2),
            significant(target, 2),
            part.what,
            part.chosen,
            significant(error, 2),
        ))
    }
}

/// What a stretch showed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Relative error of steps and modes in the band, the worst sensor's.
    pub error: f64,
    /// Begin of the stretch, s.
    pub from_s: f64,
    /// Its length, s.
    pub length_s: f64,
    /// Root mean square of the loudest sensor in it, m/s^2.
    pub rms: f64,
    /// What the run's model was compared with.
    pub(crate) finer: RunModel,
}
