//! Diagnosis of a vibration signal: high-pass, envelope, spectrum, peaks and the defect lines they lie on.
//!
//! The way of a signal: a [`Butterworth`] high-pass takes the low-frequency vibration off, [`envelope`] follows the amplitude of
//! what is left, [`envelope_spectrum`] shows how often that amplitude comes back, and [`envelope_peaks`] names the
//! lines. [`EnvelopeAnalysis`] does all of it over one window. [`band_limit`] and [`relative_difference`] compare the
//! signals of two methods in the band that matters.
//!
//! Beside it: power spectra ([`Welch`]), amplitude over time and frequency ([`WaveletTransform`]), and what is impulsive in which band
//! ([`spectral_kurtosis()`], [`kurtogram()`]). [`whiten`] makes weak bands count as much as resonances.
//!
//! Nothing here knows of simulations: a measured signal goes the same way.

mod band_limit;
mod butterworth;
pub mod diagnosis;
mod envelope;
mod error;
mod fourier;
mod kurtogram;
mod lines;
#[cfg(test)]
#[path = "samples_tests.rs"]
pub(crate) mod samples;
mod scalogram;
mod spectral_kurtosis;
mod spectrum;
mod welch;
mod white_spectrum;
mod whitening;

pub use band_limit::{band_limit, band_limit_edge_s, band_limit_from_rest, relative_difference};
pub(crate) use butterworth::Streaming;
pub use butterworth::{Butterworth, DEFAULT_ORDER, FilterBand};
pub(crate) use envelope::usual_high_pass_hz;
pub use envelope::{EnvelopeAnalysis, EnvelopeSpectrum, envelope, envelope_spectrum, squared};
pub use error::SignalError;
pub use fourier::WindowFunction;
pub(crate) use fourier::{Forward, fast_length};
pub use kurtogram::{Kurtogram, KurtogramBand, kurtogram};
pub use lines::{EnvelopePeak, LINE_TOLERANCE, LineMatch, NamedLine, PeakSearch, envelope_peaks, lines_at, match_line};
pub use scalogram::{FrequencyAxis, Scalogram, WaveletTransform};
pub use spectral_kurtosis::{SpectralKurtosis, spectral_kurtosis};
pub(crate) use spectrum::rms_up_to;
pub use spectrum::{AmplitudeSpectrum, BandLevel, DEFAULT_BIN_HZ, Peak, amplitude_spectrum, peak_near, third_octaves};
pub use welch::{PowerScaling, PowerSpectrum, Welch};
pub(crate) use white_spectrum::{BandEnvelope, RawSpectrum, WhiteSpectrum, running_median};
pub use whitening::{Emphasis, whiten};
