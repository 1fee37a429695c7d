//! Envelope analysis of a run's signal in the windows that the case names.

use super::StageError;
use crate::case::Case;
use crate::closed_form::race::DefectOrders;
use crate::series::{TimeSeries, TimeWindow};
use crate::signal::{
    EnvelopeAnalysis, EnvelopePeak, EnvelopeSpectrum, NamedLine, PeakSearch, envelope_peaks,
};
use crate::system::BearingSetup;
use std::f64::consts::TAU;

/// Harmonics of each fault line that peaks are matched to.
const HARMONICS: u32 = 3;

/// Highest frequency of the envelope spectrum that is looked at, in shaft orders; the third
/// harmonic of the highest fault order of usual bearings lies below.
const HIGHEST_ORDER: f64 = 25.0;

/// How far a peak may be from the line that it is said to belong to.
const LINE_TOLERANCE: f64 = 0.03;

/// A window of the signal, analysed.
#[derive(Debug, Clone)]
pub struct WindowAnalysis {
    /// Sensor that it belongs to.
    pub sensor: String,
    /// Start, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// Mean shaft speed in the window, Hz.
    pub speed_hz: f64,
    /// Root mean square of the signal, m/s^2.
    pub rms: f64,
    /// Largest magnitude, m/s^2.
    pub peak: f64,
    /// Kurtosis (3 for a normal distribution); `None` for a constant signal.
    pub kurtosis: Option<f64>,
    /// Envelope spectrum.
    pub spectrum: EnvelopeSpectrum,
    /// Fault lines and the shaft's.
    pub lines: Vec<NamedLine>,
    /// Strongest peaks.
    pub peaks: Vec<EnvelopePeak>,
    /// For the outer race's line and its second harmonic: expected frequency, peak found within
    /// three percent (Hz, amplitude).
    pub outer: [(f64, Option<(f64, f64)>); 2],
}

/// What is read of a signal before and after a window, in periods of the high-pass's cut-off: filter and envelope err there, by
/// the ends of what is read, by 1 / (pi 2 pi n) of the signal n periods from an end.
const MARGIN_PERIODS: f64 = 200.0;

/// Analyses one sensor's acceleration in every window of the case. `read` gives the stretch of it that holds a window (s), with
/// so many seconds before and after as there are: at least the window's own length, that its envelope has no edges.
///
/// # Errors
/// Of `read`, and
/// [`StageError::Signal`] or [`StageError::Series`] for a window outside the signal or a filter
/// that does not fit the sampling.
pub fn analyse(
    case: &Case,
    sensor: &str,
    read: impl Fn(TimeWindow, f64) -> Result<TimeSeries, StageError>,
    setup: &BearingSetup,
) -> Result<Vec<WindowAnalysis>, StageError> {
    let settings = EnvelopeAnalysis {
        high_pass_hz: case.analysis.high_pass_hz,
        ..EnvelopeAnalysis::default()
    };
    let filtered_s = settings.high_pass_hz.map_or(0.0, |hz| MARGIN_PERIODS / hz);
    case.analysis
        .envelope
        .iter()
        .map(|window| {
            let (from, to) = (window.from, window.to);
            let stretch = read(TimeWindow { from, to }, filtered_s.max(to - from))?;
            let envelope = settings.envelope(&stretch)?;
            let part = stretch.window(from, to)?;
            let turned = setup.cage.shaft().angle(to) - setup.cage.shaft().angle(from);
            let speed_hz = (turned / (to - from) / TAU).abs();
            let spectrum = settings.window_of(&envelope, from, to)?;
            let orders = slipping_orders(setup, from, to);
            let lines = lines(speed_hz, &orders)?;
            let search = PeakSearch {
                to_hz: Some(HIGHEST_ORDER * speed_hz),
                ..PeakSearch::default()
            };
            let peaks = if speed_hz > 0.0 {
                envelope_peaks(&spectrum, &lines, &search)
            } else {
                Vec::new()
            };
            let near = |expected: f64| {
                let found = spectrum.peak_near(expected, LINE_TOLERANCE);
                (
                    expected,
                    found.map(|peak| (peak.frequency_hz, peak.amplitude)),
                )
            };
            Ok(WindowAnalysis {
                sensor: sensor.to_owned(),
                from,
                to,
                speed_hz,
                rms: part.rms(),
                peak: part.peak(),
                kurtosis: part.kurtosis(),
                outer: [1.0, 2.0].map(|harmonic| near(harmonic * orders.outer * speed_hz)),
                spectrum,
                lines,
                peaks,
            })
        })
        .collect()
}

/// Defect orders between two times with the cage's slip: outer `N r`, inner `N (1 - r)` for a cage order r. The
/// ball's own spin is not prescribed; its order stays that of pure rolling.
fn slipping_orders(setup: &BearingSetup, from: f64, to: f64) -> DefectOrders {
    let balls = f64::from(setup.geometry.balls());
    let cage = setup.cage.ratio_between(from, to);
    DefectOrders {
        cage,
        outer: balls * cage,
        inner: balls * (1.0 - cage),
        ..setup.geometry.orders()
    }
}

fn lines(speed_hz: f64, orders: &DefectOrders) -> Result<Vec<NamedLine>, StageError> {
    if speed_hz <= 0.0 {
        return Ok(Vec::new());
    }
    let named = [
        ("shaft", 1.0, HARMONICS),
        ("outer race", orders.outer, HARMONICS),
        ("inner race", orders.inner, HARMONICS),
        ("ball", orders.ball_defect, HARMONICS),
    ];
    named
        .into_iter()
        .map(|(name, order, harmonics)| Ok(NamedLine::new(name, order * speed_hz, harmonics)?))
        .collect()
}
