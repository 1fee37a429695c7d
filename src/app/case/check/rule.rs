//! What a value can break, with the values that break it.

use thiserror::Error;

use super::super::nearest::Choices;

/// A rule that values of the right kind can still break. Display says what was found and what was expected.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Rule {
    /// A number outside its range.
    #[error("found {}, expected {expected}", short(*found))]
    Range {
        /// The number, in the key's unit.
        found: f64,
        /// The range in words.
        expected: &'static str,
    },
    /// A count outside its range.
    #[error("found {found}, expected {expected}")]
    Count {
        /// The count.
        found: usize,
        /// The range in words.
        expected: &'static str,
    },
    /// An empty list or text where something is needed.
    #[error("found nothing, expected {expected}")]
    Empty {
        /// What is needed.
        expected: &'static str,
    },
    /// A name that no material has.
    #[error("no material is called \"{found}\"")]
    UnknownMaterial {
        /// The name as written.
        found: String,
        /// The materials' names.
        names: Box<Choices>,
    },
    /// A name that no sensor has.
    #[error("no sensor is called \"{found}\"")]
    UnknownSensor {
        /// The name as written.
        found: String,
        /// The sensors' names.
        names: Box<Choices>,
    },
    /// A material with directions where none can be followed.
    #[error("\"{found}\" is orthotropic, expected an isotropic material: rings and contacts have no other")]
    NotIsotropic {
        /// The name as written.
        found: String,
    },
    /// A material with structural damping where none is modelled.
    #[error(
        "\"{found}\" has a loss factor, expected a material without: structural damping is for parts of the housing"
    )]
    LossFactor {
        /// The name as written.
        found: String,
    },
    /// Constants for which a deformation would have no positive energy.
    #[error("{0}")]
    UnstableMaterial(crate::fe::material::MaterialError),
    /// A name that was used before in the same list.
    #[error("\"{name}\" stands here a second time, expected each once")]
    Repeated {
        /// The name.
        name: String,
    },
    /// A sensor's name that a signal of the program's own carries.
    #[error("\"{name}\" is the name of another signal")]
    ReservedName {
        /// The name.
        name: String,
    },
    /// A sensor's name that no array can carry.
    #[error(
        "found \"{}\", expected letters, digits, `_`, `-`, `.` and spaces: the signal is saved under this name",
        name.escape_debug()
    )]
    SignalName {
        /// The name.
        name: String,
    },
    /// A component across a plane model.
    #[error("found a component z, expected x and y only in a plane model")]
    NoZ,
    /// A vector of length zero where a direction is needed.
    #[error("found a vector of length zero, expected a direction")]
    NoDirection,
    /// Two directions along one line.
    #[error("found the direction of `ring.tie.axis`, expected one across it")]
    AlongAxis,
    /// A key that makes sense only with another.
    #[error("needs {other}, which the case lacks")]
    Needs {
        /// The table or key that is needed.
        other: &'static str,
    },
    /// A key that excludes another.
    #[error("found beside `{other}`, expected one of the two")]
    Beside {
        /// The other key.
        other: &'static str,
    },
    /// Two values in the wrong order, or equal.
    #[error("found {}, expected more than {what} ({})", short(*found), short(*other))]
    NotAbove {
        /// The value, in the key's unit.
        found: f64,
        /// What it must exceed.
        what: &'static str,
        /// The value that it must exceed, in the same unit.
        other: f64,
    },
    /// A value beyond what another allows.
    #[error("found {}, expected {how} {what} ({})", short(*found), short(*other))]
    Beyond {
        /// The value, in the key's unit.
        found: f64,
        /// "below", "at most" or "at least".
        how: &'static str,
        /// What limits it.
        what: &'static str,
        /// The limit, in the same unit.
        other: f64,
    },
    /// A window that is not within the simulation.
    #[error(
        "found {} to {} s, expected a window within the simulation ({} to {} s)",
        short(*from), short(*to), short(*start), short(*end)
    )]
    OutsideRun {
        /// Start of the window in s.
        from: f64,
        /// End of the window in s.
        to: f64,
        /// Start of the simulation in s.
        start: f64,
        /// End of the simulation in s.
        end: f64,
    },
    /// Radii that leave no room, or far too much, for the balls.
    #[error(
        "the radii leave a radial play of {} m, expected at most a tenth of the ball's radius ({} m) either way",
        short(*play), short(*limit)
    )]
    BallsDoNotFit {
        /// Outer race radius less inner race radius less ball diameter, in m.
        play: f64,
        /// A tenth of the ball's radius in m.
        limit: f64,
    },
    /// More balls than fit side by side.
    #[error("found {found}, expected at most {most}: balls of this radius would overlap")]
    BallsOverlap {
        /// Number of balls.
        found: usize,
        /// How many fit.
        most: usize,
    },
    /// A ring that nothing keeps from turning.
    #[error("found \"sliding\" and no springs in `ring.supports`, which leaves the ring free to turn")]
    FreeToTurn,
    /// A ring beside a housing, not connected to it.
    #[error("found a housing and no `ring.tie`, which leaves the ring unconnected")]
    Unconnected,
    /// Neither housing nor ring.
    #[error("found neither [housing] nor [ring], expected at least one")]
    NothingToModel,
}

impl Rule {
    /// Returns what to do about it, where the message does not say it all.
    pub(in super::super) fn help(&self) -> Option<String> {
        match self {
            Self::UnknownMaterial { names, .. } => Some(names.help("materials")),
            Self::UnknownSensor { names, .. } => Some(names.help("sensors")),
            Self::Beyond { how: "at least", .. } => {
                Some("raise the sampling rate or narrow `accuracy.band_hz`".to_owned())
            }
            Self::LossFactor { .. } => {
                Some("give this part a material of its own name, without `loss_factor`".to_owned())
            }
            Self::BallsDoNotFit { .. } => Some(
                "check that all radii are in m and none is a diameter; `bearing.radial_play` overrides the play"
                    .to_owned(),
            ),
            Self::FreeToTurn => Some(
                "use fit = \"bonded\", or add springs in x and y (in a solid housing in z too) to `ring.supports`"
                    .to_owned(),
            ),
            Self::Unconnected => Some("add tie = { group = \"NAME OF THE BORE\" } to [ring]".to_owned()),
            _ => None,
        }
    }
}

/// Writes a number briefly: twelve digits at most, plain where that is short, else with an exponent.
fn short(number: f64) -> String {
    // The text of a number always reads back.
    let number: f64 = format!("{number:.11e}").parse().unwrap_or(number);
    let size = number.abs();
    if size > 0.0 && !(1e-3..1e6).contains(&size) { format!("{number:e}") } else { number.to_string() }
}

/// A broken rule and the key that breaks it.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("`{key}`: {rule}")]
pub struct BrokenRule {
    /// Full path of the key, e.g. `bearing.defects[0].depth`; the table where a whole table breaks it.
    pub key: String,
    /// The rule.
    pub rule: Rule,
}

impl Rule {
    /// Names the key that breaks it.
    pub(crate) fn at(self, key: impl Into<String>) -> BrokenRule {
        BrokenRule { key: key.into(), rule: self }
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_written_briefly() {
        for (number, text) in [
            (0.0, "0"),
            (7.5, "7.5"),
            (100_000.0, "100000"),
            (206e9, "2.06e11"),
            (-2.5e-6, "-2.5e-6"),
            (0.1 + 0.2, "0.3"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(short(number), text);
        }
    }
}
