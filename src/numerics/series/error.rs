//! What can be wrong with a sampled signal or a decimator.

use thiserror::Error;

/// Why a series, a window of it or a decimator cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SeriesError {
    /// The sampling step is not a positive finite number of seconds.
    #[error("sampling step must be positive and finite, found {step_s} s")]
    Step {
        /// Step as given, s.
        step_s: f64,
    },
    /// The start instant is not finite.
    #[error("start of the series must be finite, found {start_s} s")]
    Start {
        /// Start as given, s.
        start_s: f64,
    },
    /// A series without samples.
    #[error("series has no samples")]
    Empty,
    /// A sample is NaN or infinite.
    #[error("sample {index} (t = {time_s} s) is {value}, not a finite number")]
    NotFinite {
        /// Position of the first such sample, counted from 0.
        index: usize,
        /// Its instant, s.
        time_s: f64,
        /// Its value.
        value: f64,
    },
    /// A window's end does not lie after its start, or a bound is not finite.
    #[error("window must end after it starts, found {from_s} s to {to_s} s")]
    WindowOrder {
        /// Start of the window, s.
        from_s: f64,
        /// End of the window, s.
        to_s: f64,
    },
    /// A window reaches beyond the series.
    #[error("window {from_s} s to {to_s} s is not inside the series, which covers {start_s} s to {end_s} s")]
    WindowOutside {
        /// Start of the window, s.
        from_s: f64,
        /// End of the window, s.
        to_s: f64,
        /// First instant of the series, s.
        start_s: f64,
        /// One step after the last sample of the series, s.
        end_s: f64,
    },
    /// A window falls between two samples.
    #[error("window {from_s} s to {to_s} s holds no sample: the sampling step is {step_s} s")]
    WindowEmpty {
        /// Start of the window, s.
        from_s: f64,
        /// End of the window, s.
        to_s: f64,
        /// Sampling step, s.
        step_s: f64,
    },
    /// A decimation ratio of zero.
    #[error("decimation ratio must be at least 1, found {ratio}")]
    Ratio {
        /// Ratio as given.
        ratio: usize,
    },
    /// A low-pass design whose edges are not 0 < pass < stop <= half the sampling rate.
    #[error(
        "low-pass edges must satisfy 0 < pass < stop <= {nyquist_hz} Hz (half the sampling rate), \
         found pass {pass_hz} Hz, stop {stop_hz} Hz"
    )]
    LowPassEdges {
        /// End of the pass band, Hz.
        pass_hz: f64,
        /// Begin of the stop band, Hz.
        stop_hz: f64,
        /// Half the sampling rate, Hz.
        nyquist_hz: f64,
    },
    /// A saved decimator state that does not belong to this decimator.
    #[error(
        "saved decimator state does not fit: {accumulators} accumulators in the state, {expected} in the decimator"
    )]
    State {
        /// Accumulators found in the state.
        accumulators: usize,
        /// Accumulators of the decimator.
        expected: usize,
    },
    /// A saved decimator state from a decimator of another ratio.
    #[error("saved decimator state does not fit: phase {phase} in the state, ratio {ratio} in the decimator")]
    StatePhase {
        /// Phase found in the state.
        phase: usize,
        /// Ratio of the decimator.
        ratio: usize,
    },
}
