//! Diagnosis of a vibration signal: high-pass, envelope, spectrum, peaks and the defect lines they lie on.
//!
//! The way of a signal: a [`Butterworth`] high-pass takes the low-frequency vibration off, [`envelope`] follows the amplitude of
//! what is left, [`envelope_spectrum`] shows how often that amplitude comes back, and [`envelope_peaks`] names the
//! lines. [`EnvelopeAnalysis`] does all of it over one window. [`band_limit`] and [`relative_difference`] compare the
//! signals of two methods in the band that matters.
//!
//! Beside it: power spectra ([`Welch`]), amplitude over time and frequency ([`WaveletTransform`]), orders of a shaft
//! ([`ShaftAngle`], [`AngleSeries`], [`SpeedSearch`]), and what is impulsive, when and in which band ([`moving_figures`],
//! [`spectral_kurtosis()`], [`kurtogram()`]). [`whiten`] makes weak bands count as much as resonances.
//!
//! Nothing here knows of simulations: a measured signal goes the same way.

mod angle_series;
mod band_limit;
mod butterworth;
mod compare;
pub mod diagnosis;
mod envelope;
mod envelope_analysis;
mod error;
mod fourier;
mod frequency_axis;
mod kurtogram;
mod kurtosis_limit;
mod lines;
mod morlet;
mod moving;
mod peaks;
mod raw_spectrum;
mod ridge;
#[cfg(test)]
pub(crate) mod samples;
mod scalogram;
mod shaft_angle;
mod spectral_kurtosis;
mod spectrum;
mod speed_estimate;
mod third_octave;
mod welch;
mod white_spectrum;
mod whitening;
mod window_function;

pub use angle_series::{AngleSeries, OrderSpectrum, SynchronousAverage};
pub use band_limit::{band_limit, band_limit_edge_s, band_limit_from_rest};
pub use butterworth::{Butterworth, DEFAULT_ORDER, FilterBand};
pub use compare::relative_difference;
pub use envelope::{envelope, squared};
pub(crate) use envelope_analysis::usual_high_pass_hz;
pub use envelope_analysis::{EnvelopeAnalysis, EnvelopeSpectrum, envelope_spectrum};
pub use error::SignalError;
pub(crate) use fourier::{Forward, fast_length};
pub use frequency_axis::FrequencyAxis;
pub use kurtogram::{Kurtogram, KurtogramBand, kurtogram};
pub use lines::{EnvelopePeak, LINE_TOLERANCE, LineMatch, NamedLine, PeakSearch, envelope_peaks, lines_at, match_line};
pub use moving::{MovingFigures, moving_figures};
pub use peaks::{Peak, local_maxima, peak_near};
pub(crate) use raw_spectrum::{BandEnvelope, RawSpectrum};
pub use scalogram::{Scalogram, WaveletTransform};
pub use shaft_angle::{ShaftAngle, SpeedPoint};
pub use spectral_kurtosis::{SpectralKurtosis, spectral_kurtosis};
pub use spectrum::{AmplitudeSpectrum, DEFAULT_BIN_HZ, amplitude_spectrum};
pub use speed_estimate::{SpeedReading, SpeedSearch, angle_from_readings};
pub use third_octave::{BandLevel, third_octaves};
pub use welch::{PowerScaling, PowerSpectrum, Welch};
pub(crate) use white_spectrum::{WhiteSpectrum, running_median};
pub use whitening::{Emphasis, whiten};
pub use window_function::WindowFunction;
