//! What can be wrong with an analysis of a signal.

use crate::numerics::Brief;
use crate::numerics::series::SeriesError;
use std::fmt::Display;
use thiserror::Error;

/// Why a signal cannot be filtered, transformed, searched or compared: a sentence with the values found.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct SignalError(pub(super) String);

impl From<SeriesError> for SignalError {
    fn from(error: SeriesError) -> Self {
        Self(error.to_string())
    }
}

impl SignalError {
    /// Too few samples for the edge extension of a filter, or for a spectrum.
    pub(super) fn too_short(samples: usize, needed: usize) -> Self {
        Self(format!("series has {samples} samples, the filter or transform needs at least {needed}"))
    }

    /// A cut-off (Hz) that does not lie between zero and half the sampling rate (Hz).
    pub(super) fn cut_off(cut_off_hz: f64, nyquist_hz: f64) -> Self {
        let [cut_off_hz, nyquist_hz] = [cut_off_hz, nyquist_hz].map(Brief);
        Self(format!("cut-off must lie between 0 and {nyquist_hz} Hz (half the sampling rate), found {cut_off_hz} Hz"))
    }

    /// Segments that do not fit into the series, or overlap whole.
    pub(super) fn segments(segment: usize, overlap: usize, samples: usize) -> Self {
        Self(format!(
            "segments must have 2 to {samples} samples (the series) and overlap by less, found {segment} samples and \
             {overlap} of overlap"
        ))
    }

    /// More points of a transform or a result than are offered.
    pub(super) fn too_long(points: usize, most: usize) -> Self {
        Self(format!("{points} points are needed, at most {most} are offered: take a shorter stretch"))
    }

    /// The Fourier transform refused its buffers.
    pub(super) fn transform(points: usize, source: impl Display) -> Self {
        Self(format!("Fourier transform over {points} points failed: {source}"))
    }

    /// The reference of a relative difference is zero throughout.
    pub(crate) fn zero_reference() -> Self {
        Self("relative difference needs a reference that is not zero throughout".to_owned())
    }
}
