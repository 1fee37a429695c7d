//! Evenly sampled signals with a unit, their statistics, and the decimator that records them during a simulation.
//!
//! Everything here stands on the lowest row of the crate: the transient integrators record through it, the signal
//! analysis starts from it.

mod decimator;
mod time_series;

pub(crate) use decimator::KaiserLowPass;
pub use decimator::{Decimator, DecimatorState, HALF_LENGTH_OUTPUTS, PASSED};
pub use time_series::{SeriesError, TimeSeries, TimeWindow};
pub(crate) use time_series::{root_mean_square, tolerance_steps};
