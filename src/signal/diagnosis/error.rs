//! What a diagnosis cannot work with.

use thiserror::Error;

use crate::numerics::Brief;
use crate::numerics::series::SeriesError;
use crate::signal::SignalError;

/// Why there is no diagnosis of a window.
#[derive(Debug, Error)]
pub enum DiagnosisError {
    /// A spectrum that cannot be formed.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A window outside the signal.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// A band, an order or a shaft that there is no diagnosis for.
    #[error("{0}")]
    Refused(String),
    /// A sensor that is dead, or not connected.
    #[error(
        "from {} s to {} s: expected a signal that changes, found a constant: check sensor and channel",
        Brief(*.from_s), Brief(*.to_s)
    )]
    Constant {
        /// Start of the window, s.
        from_s: f64,
        /// End of the window, s.
        to_s: f64,
    },
    /// A signal of tones alone, computed or recorded with too few digits: its rounding makes lines of its own.
    #[error(
        "expected noise beside the tones, to judge lines against, found a floor of {} (RMS) where the values have steps of {}: record with a higher gain or more digits; a signal that was computed, repeated or resampled to a higher rate lacks it: give the original record, or add noise",
        Brief::rounded(*noise, 2), Brief::rounded(*step, 2)
    )]
    NoNoise {
        /// Root mean square of white noise with the floor's density, in the signal's unit.
        noise: f64,
        /// Step of the values, in the signal's unit.
        step: f64,
    },
    /// A piece of a signal that is repeated: what it holds comes at a fixed rate.
    #[error(
        "expected a record, found one whose values repeat exactly every {} s: whatever it holds then strikes at that rate; give the original record",
        Brief(*.period_s)
    )]
    Repeated {
        /// After what time all values come again, s.
        period_s: f64,
    },
}
