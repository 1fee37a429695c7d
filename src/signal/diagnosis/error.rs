//! What a diagnosis cannot work with.

use thiserror::Error;

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
    /// Nothing to judge.
    #[error("expected an envelope at least, found none")]
    NoEnvelope,
    /// A band at the end of what the signal has: nothing is left of it to judge.
    #[error(
        "expected a band that begins below {most_hz} Hz, nine tenths of what the signal is good for, found one from {from_hz} Hz on"
    )]
    NarrowBand {
        /// Where the band begins, Hz.
        from_hz: f64,
        /// Where it may begin at most, Hz.
        most_hz: f64,
    },
    /// A sensor that is dead, or not connected.
    #[error("from {from_s} s to {to_s} s: expected a signal that changes, found a constant: check sensor and channel")]
    Constant {
        /// Start of the window, s.
        from_s: f64,
        /// End of the window, s.
        to_s: f64,
    },
    /// A signal of tones alone, computed or recorded with too few digits: its rounding makes lines of its own.
    #[error(
        "expected noise beside the tones, to judge lines against, found a floor of {noise:.1e} (RMS) where the values have steps of {step:.1e}: record with a higher gain or more digits; a signal that was computed, repeated or resampled to a higher rate lacks it: give the original record, or add noise"
    )]
    NoNoise {
        /// Root mean square of white noise with the floor's density, in the signal's unit.
        noise: f64,
        /// Step of the values, in the signal's unit.
        step: f64,
    },
    /// A piece of a signal that is repeated: what it holds comes at a fixed rate.
    #[error(
        "expected a record, found one whose values repeat exactly every {period_s} s: whatever it holds then strikes at that rate; give the original record"
    )]
    Repeated {
        /// After what time all values come again, s.
        period_s: f64,
    },
    /// A shaft that rests or turns back: angle is no measure of progress then.
    #[error(
        "from {from_s} s to {to_s} s: expected a shaft that turns one way all the time, found one that rests or turns back at {at_s} s"
    )]
    Turning {
        /// Start of the window, s.
        from_s: f64,
        /// End of the window, s.
        to_s: f64,
        /// Where it does not turn on, s.
        at_s: f64,
    },
    /// Fewer samples than a spectrum over the angle needs.
    #[error(
        "from {from_s} s to {to_s} s: expected at least {needed} samples at equal angles, found {found}: a longer window, or a higher sampling rate"
    )]
    TooFew {
        /// Start of the window, s.
        from_s: f64,
        /// End of the window, s.
        to_s: f64,
        /// Samples at equal angles.
        found: usize,
        /// How many are needed.
        needed: usize,
    },
    /// An order that is none.
    #[error("order of the {fault}: expected a number above 0 and at most {most}, found {found}")]
    Order {
        /// Which fault.
        fault: &'static str,
        /// What was given.
        found: f64,
        /// Largest order that is believed.
        most: f64,
    },
    /// A tolerance that is none.
    #[error("relative error of the orders: expected 0 to {most}, found {found}")]
    Tolerance {
        /// What was given.
        found: f64,
        /// Largest that makes sense.
        most: f64,
    },
}
