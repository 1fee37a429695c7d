//! How unique the reading of the source is that gives its three eigenfrequencies.
//!
//! [`Grid`] of everything that the source does not report -> [`Study`] of all combinations -> [`Fits`], what those have in
//! common that give all three frequencies, and [`moved_by_one_choice`], what each choice does by itself.

mod choices;
mod fits;
mod shapes;
mod study;
mod summary;

pub use choices::{
    ContactSource, Equations, FACTORS, Factor, Grid, Levels, RingBond, SpringArc, Springs,
};
pub use fits::{Fit, FitGroup, Fits, LevelCount, Moved, WITHIN, moved_by_one_choice};
pub use shapes::{ByShape, ShapeShares};
pub use study::{ReadingResult, Study};
pub use summary::{
    ChoiceSummary, DeterminedSummary, FitSummary, LevelSummary, MovedSummary, ReadingsSummary,
};
