//! What can be wrong with an analysis of a signal.

use thiserror::Error;

use crate::numerics::series::SeriesError;

/// Why a signal cannot be filtered, transformed, searched or compared.
#[derive(Debug, Error)]
pub enum SignalError {
    /// The series or a window of it is not valid.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// A cut-off that does not lie between zero and half the sampling rate.
    #[error("cut-off must lie between 0 and {nyquist_hz} Hz (half the sampling rate), found {cut_off_hz} Hz")]
    CutOff {
        /// Cut-off as given, Hz.
        cut_off_hz: f64,
        /// Half the sampling rate, Hz.
        nyquist_hz: f64,
    },
    /// A filter order that is not offered.
    #[error("filter order must be 1 to {largest}, found {order}")]
    Order {
        /// Order as given.
        order: usize,
        /// Largest order offered.
        largest: usize,
    },
    /// A band whose edges are not 0 < from < to < half the sampling rate.
    #[error(
        "band must satisfy 0 < from < to < {nyquist_hz} Hz (half the sampling rate), found {from_hz} Hz to {to_hz} Hz"
    )]
    Band {
        /// Lower edge as given, Hz.
        from_hz: f64,
        /// Upper edge as given, Hz.
        to_hz: f64,
        /// Half the sampling rate, Hz.
        nyquist_hz: f64,
    },
    /// A filter so low or so narrow for the sampling rate that rounding would decide its shape.
    #[error(
        "filter edges from {lowest_hz} Hz, {width_hz} Hz wide, leave no digits at this sampling rate: lowest edge {least_hz} Hz, \
         narrowest band {narrowest_hz} Hz; decimate first"
    )]
    FilterDigits {
        /// Lowest edge as given, Hz.
        lowest_hz: f64,
        /// Width of the band as given, Hz.
        width_hz: f64,
        /// Lowest edge offered, Hz.
        least_hz: f64,
        /// Narrowest band offered, Hz.
        narrowest_hz: f64,
    },
    /// The filter library did not give second-order sections.
    #[error("Butterworth design of order {order} did not give second-order sections")]
    Design {
        /// Order of the filter.
        order: usize,
    },
    /// Too few samples for the edge extension of the filter, or for a spectrum.
    #[error("series has {samples} samples, the filter or transform needs at least {needed}")]
    TooShort {
        /// Samples found.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// A bin width that is not positive, or needs more than 2^28 points.
    #[error("bin width must be positive and at least {finest_hz} Hz for this sampling rate, found {bin_hz} Hz")]
    BinWidth {
        /// Bin width as given, Hz.
        bin_hz: f64,
        /// Finest bin width offered, Hz.
        finest_hz: f64,
    },
    /// Segments that do not fit into the series, or overlap whole.
    #[error(
        "segments must have 2 to {samples} samples (the series) and overlap by less, found {segment} samples and {overlap} of overlap"
    )]
    Segments {
        /// Samples of a segment as given.
        segment: usize,
        /// Overlap as given, samples.
        overlap: usize,
        /// Samples of the series.
        samples: usize,
    },
    /// Frequencies of a transform that are out of order or outside what the series has.
    #[error(
        "frequencies must satisfy {lowest_hz} Hz <= from < to < {highest_hz} Hz and be 2 to {most}, found {count} from {from_hz} Hz to {to_hz} Hz"
    )]
    Frequencies {
        /// Lowest frequency as given, Hz.
        from_hz: f64,
        /// Highest frequency as given, Hz.
        to_hz: f64,
        /// Number of frequencies as given.
        count: usize,
        /// Lowest frequency offered, Hz.
        lowest_hz: f64,
        /// What the highest frequency must lie below, Hz.
        highest_hz: f64,
        /// Most frequencies offered.
        most: usize,
    },
    /// A number of cycles of a wavelet that is not offered.
    #[error("a wavelet must have {fewest} to {most} cycles, found {cycles}")]
    Cycles {
        /// Cycles as given.
        cycles: f64,
        /// Fewest cycles offered.
        fewest: f64,
        /// Most cycles offered.
        most: f64,
    },
    /// A decimation by zero, or one that leaves fewer than two instants.
    #[error("decimation of {samples} samples must be by 1 to half as many, found {ratio}")]
    Decimation {
        /// Ratio as given.
        ratio: usize,
        /// Samples of the series.
        samples: usize,
    },
    /// A confidence that is no probability.
    #[error("confidence must lie between 0 and 1, found {confidence}")]
    Confidence {
        /// Confidence as given.
        confidence: f64,
    },
    /// Levels of a kurtogram that are not offered.
    #[error("levels must be 1 to {most}, found {levels}")]
    Levels {
        /// Levels as given.
        levels: usize,
        /// Most levels offered.
        most: usize,
    },
    /// Instants of a speed that are too few or out of order.
    #[error("speed must be known at two instants at least, finite and in order of time, found {points} instants")]
    SpeedPoints {
        /// Instants given.
        points: usize,
    },
    /// A speed that is not positive.
    #[error(
        "shaft speed must be positive throughout, found {speed_hz} Hz at {time_s} s: take a stretch in which the shaft turns one way"
    )]
    Speed {
        /// Instant, s.
        time_s: f64,
        /// Speed there, Hz.
        speed_hz: f64,
    },
    /// Samples per turn that are not offered.
    #[error("samples per turn must be 2 to {most}, found {samples_per_turn}")]
    SamplesPerTurn {
        /// Samples per turn as given.
        samples_per_turn: usize,
        /// Most samples per turn offered.
        most: usize,
    },
    /// Too few turns of the shaft.
    #[error("{turns} turns are known, at least {needed} needed")]
    FewTurns {
        /// Turns found.
        turns: f64,
        /// Turns needed.
        needed: usize,
    },
    /// An order of a line that is not positive.
    #[error("order of a line must be positive, found {order}")]
    OrderOfLine {
        /// Order as given.
        order: f64,
    },
    /// Too few readings of a speed to know their scatter.
    #[error("{readings} readings of the speed, at least {needed} needed: take a longer stretch")]
    FewReadings {
        /// Readings found.
        readings: usize,
        /// Readings needed.
        needed: usize,
    },
    /// Windows that do not move.
    #[error("windows must move by at least one sample, found 0")]
    Hop,
    /// More than 2^28 points of a transform or a result.
    #[error("{points} points are needed, at most {most} are offered: take a shorter stretch")]
    TooLong {
        /// Points needed.
        points: usize,
        /// Most points offered.
        most: usize,
    },
    /// The Fourier transform refused its buffers.
    #[error("Fourier transform over {points} points failed: {source}")]
    Transform {
        /// Length of the transform.
        points: usize,
        /// What the library found.
        source: realfft::FftError,
    },
    /// A named line without a positive frequency or without harmonics.
    #[error(
        "line \"{name}\" must have a positive frequency and at least one harmonic, found {frequency_hz} Hz and {harmonics}"
    )]
    Line {
        /// Name of the line.
        name: String,
        /// Its fundamental, Hz.
        frequency_hz: f64,
        /// Its number of harmonics.
        harmonics: u32,
    },
    /// Two series that are compared differ in their instants.
    #[error(
        "series are not sampled at the same instants: {first_samples} samples from {first_start_s} s every {first_step_s} s against \
         {second_samples} from {second_start_s} s every {second_step_s} s"
    )]
    Instants {
        /// Samples of the first series.
        first_samples: usize,
        /// Start of the first series, s.
        first_start_s: f64,
        /// Step of the first series, s.
        first_step_s: f64,
        /// Samples of the second series.
        second_samples: usize,
        /// Start of the second series, s.
        second_start_s: f64,
        /// Step of the second series, s.
        second_step_s: f64,
    },
    /// Two series that are compared differ in their unit.
    #[error("series have different units: \"{first}\" against \"{second}\"")]
    Units {
        /// Unit of the first series.
        first: String,
        /// Unit of the second series.
        second: String,
    },
    /// The reference of a relative difference is zero throughout.
    #[error("relative difference needs a reference that is not zero throughout")]
    ZeroReference,
}
