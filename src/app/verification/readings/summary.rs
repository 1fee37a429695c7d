//! What `verify.json` says of the study.

use super::{Factor, Fit, Fits, Levels, Moved, ReadingResult, ShapeShares, Study, WITHIN};
use crate::app::verification::PaperFrequencies;
use schemars::JsonSchema;
use serde::Serialize;

/// How unique the reading of the source is.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ReadingsSummary {
    /// The source's eigenfrequencies, Hz.
    pub expected_hz: PaperFrequencies,
    /// Largest relative distance from them that fits.
    pub within: f64,
    /// Number of readings with an equilibrium.
    pub count: usize,
    /// Number of readings without.
    pub without_equilibrium: usize,
    /// Readings of which a nearest mode has not the shape that the source speaks of.
    pub nearest_of_another_shape: usize,
    /// What a reading chooses, in the order of its levels.
    pub choices: Vec<ChoiceSummary>,
    /// Levels of the built-in case; `None` if the grid does not have them.
    pub known: Option<Levels>,
    /// Shapes of its nearest three modes.
    pub known_shapes: Option<[ShapeShares; 3]>,
    /// Its place among those that fit, from 1.
    pub known_place: Option<usize>,
    /// Number of readings that fit.
    pub fits_count: usize,
    /// Readings that fit, the best first.
    pub fits: Vec<FitSummary>,
    /// How often each value of each choice occurs among them.
    pub by_choice: Vec<LevelSummary>,
    /// Choices of which all that fit take the same value.
    pub determined: Vec<DeterminedSummary>,
    /// The built-in case with one choice changed at a time.
    pub one_at_a_time: Vec<MovedSummary>,
}

/// A choice and its values.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ChoiceSummary {
    /// The choice.
    pub choice: Factor,
    /// Its values in words.
    pub values: Vec<String>,
}

/// A reading that fits.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct FitSummary {
    /// Its values of each choice, indices from 0.
    pub levels: Levels,
    /// Modes nearest to the source's three, Hz.
    pub hz: [f64; 3],
    /// Relative distances from these.
    pub relative_error: [f64; 3],
    /// Whether each is the mode with the shape that the source speaks of.
    pub by_shape: [bool; 3],
}

/// How often a value occurs among the readings that fit.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LevelSummary {
    /// The choice.
    pub choice: Factor,
    /// Its value in words.
    pub value: String,
    /// Readings with it.
    pub readings: usize,
    /// Those of them that fit.
    pub fits: usize,
    /// Those that fit by mode shape too.
    pub fits_by_shape: usize,
}

/// A value that all readings that fit take.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct DeterminedSummary {
    /// The choice.
    pub choice: Factor,
    /// Its value in words.
    pub value: String,
}

/// The built-in case with one choice changed.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct MovedSummary {
    /// The choice.
    pub choice: Factor,
    /// Its value in words.
    pub value: String,
    /// The three frequencies, Hz.
    pub hz: [f64; 3],
    /// How far they moved, relatively.
    pub moved_by: [f64; 3],
    /// Whether each is the mode with the shape that the source speaks of.
    pub by_shape: [bool; 3],
}

impl Study {
    /// What `verify.json` says of it, with what fits, the built-in case and what moves it.
    #[must_use]
    pub fn summary(
        &self,
        fits: &Fits,
        base: Option<&ReadingResult>,
        moved: &[Moved],
    ) -> ReadingsSummary {
        let label = |factor, level| self.grid.label(factor, level);
        let choices = Factor::ALL.into_iter().zip(self.grid.sizes());
        let known = self.grid.known();
        ReadingsSummary {
            expected_hz: self.paper,
            within: WITHIN,
            count: self.readings.len(),
            without_equilibrium: self.without_equilibrium,
            nearest_of_another_shape: fits.misnamed,
            choices: choices
                .map(|(choice, size)| ChoiceSummary {
                    choice,
                    values: (0..size).map(|level| label(choice, level)).collect(),
                })
                .collect(),
            known,
            known_shapes: base.map(|base| base.shapes),
            known_place: known.and_then(|known| fits.rank(&known)),
            fits_count: fits.fits.len(),
            fits: fits.fits.iter().map(Fit::summary).collect(),
            by_choice: fits
                .counts
                .iter()
                .map(|count| LevelSummary {
                    choice: count.factor,
                    value: label(count.factor, count.level),
                    readings: count.readings,
                    fits: count.fits,
                    fits_by_shape: count.shaped_fits,
                })
                .collect(),
            determined: fits
                .determined
                .iter()
                .map(|&(choice, level)| DeterminedSummary {
                    choice,
                    value: label(choice, level),
                })
                .collect(),
            one_at_a_time: moved
                .iter()
                .map(|moved| MovedSummary {
                    choice: moved.factor,
                    value: label(moved.factor, moved.level),
                    hz: moved.hz,
                    moved_by: moved.by,
                    by_shape: moved.shaped,
                })
                .collect(),
        }
    }
}

impl Fit {
    fn summary(&self) -> FitSummary {
        FitSummary {
            levels: self.reading.levels,
            hz: self.reading.nearest_hz,
            relative_error: self.errors,
            by_shape: self.shaped,
        }
    }
}
