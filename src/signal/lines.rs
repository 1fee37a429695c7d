//! Peaks of an envelope spectrum and the lines they belong to: shaft, races, balls and their harmonics.

use crate::numerics::Brief;
use schemars::JsonSchema;
use serde::Serialize;

use super::SignalError;
use super::envelope::EnvelopeSpectrum;
use super::fourier::WindowFunction;
use super::spectrum::{Peak, local_maxima};

/// A peak that a stronger one's leakage could make, with this margin, is not listed: leakages of several lines add
/// up with signs, and the bound 1 / (pi d T) is an envelope.
const LEAKAGE_MARGIN: f64 = 1.2;

/// Peaks below this part of the strongest are not listed: nobody diagnoses from them, and near half the sampling rate
/// the periodic images of strong lines make some.
const FLOOR: f64 = 0.01;

/// How far a peak may be from a line that it is said to be, relative to the line's frequency: slip and a contact angle that is not
/// known move the line of a fault by 1 to 2 % (Randall & Antoni,
/// Mechanical Systems and Signal Processing 25, 2011, 485-520).
pub const LINE_TOLERANCE: f64 = 0.03;
/// Resolutions 1 / T to each side of a peak whose median is its floor.
const FLOOR_BINS: f64 = 5.0;

/// A line that a spectrum may show at k f, k = 1 ..= harmonics.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedLine {
    name: String,
    frequency_hz: f64,
    /// Where a signal shows it, Hz.
    found_hz: f64,
    harmonics: u32,
}

impl NamedLine {
    /// Line `name` with its fundamental at `frequency_hz` > 0 and `harmonics` >= 1 multiples, the fundamental counted.
    ///
    /// # Errors
    /// [`SignalError`] unless frequency and harmonics are positive.
    pub fn new(name: impl Into<String>, frequency_hz: f64, harmonics: u32) -> Result<Self, SignalError> {
        let name = name.into();
        if !(frequency_hz.is_finite() && frequency_hz > 0.0 && harmonics > 0) {
            return Err(SignalError(format!(
                "line \"{name}\" must have a positive frequency and at least one harmonic, found {} Hz and {harmonics}",
                Brief(frequency_hz)
            )));
        }
        Ok(Self { name, frequency_hz, found_hz: frequency_hz, harmonics })
    }

    /// The same where a signal shows its fundamental, Hz, > 0: peaks are told apart by that, and deviate from what was expected.
    #[must_use]
    pub(crate) fn found_at(self, found_hz: f64) -> Self {
        Self { found_hz, ..self }
    }

    /// Name ("shaft", "outer").
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Fundamental, Hz.
    pub fn frequency_hz(&self) -> f64 {
        self.frequency_hz
    }

    /// Number of multiples, the fundamental counted.
    pub fn harmonics(&self) -> u32 {
        self.harmonics
    }

    /// A harmonic of it against a frequency found, Hz.
    fn at(&self, harmonic: u32, found_hz: f64) -> LineMatch {
        let expected_hz = f64::from(harmonic) * self.frequency_hz;
        LineMatch {
            nearest: self.name.clone(),
            harmonic,
            expected_hz,
            deviation: (found_hz - expected_hz) / expected_hz,
        }
    }
}

/// The line nearest to a peak.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LineMatch {
    /// Name of the line.
    pub nearest: String,
    /// Which multiple of its fundamental, from 1.
    pub harmonic: u32,
    /// Expected frequency, harmonic times fundamental, Hz.
    pub expected_hz: f64,
    /// Relative deviation, (found - expected) / expected.
    pub deviation: f64,
}

impl LineMatch {
    /// Harmonic and name ("2 x outer race").
    pub fn label(&self) -> String {
        format!("{} x {}", self.harmonic, self.nearest)
    }
}

/// A peak of an envelope spectrum with the line nearest to it, and the lines that it may be.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct EnvelopePeak {
    /// Frequency found, Hz.
    pub frequency_hz: f64,
    /// Amplitude found, in the spectrum's unit.
    pub amplitude: f64,
    /// Amplitude over the median of the amplitudes within five resolutions 1 / T to each side, dB.
    pub above_median_db: f64,
    /// Nearest line; `None` only if no lines were given.
    #[serde(flatten)]
    pub line: Option<LineMatch>,
    /// Labels of the lines that it may be, see [`lines_at`]: nearest first, empty for a peak that is none of them.
    pub labels: Vec<String>,
}

/// Which peaks are looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeakSearch {
    /// How many, the strongest first.
    pub count: usize,
    /// Lowest frequency, Hz; `None`: the resolution, below which the spectrum holds the window itself.
    pub from_hz: Option<f64>,
    /// Highest frequency, Hz; `None`: the end of the spectrum.
    pub to_hz: Option<f64>,
}

impl Default for PeakSearch {
    /// The six strongest peaks of the whole spectrum.
    fn default() -> Self {
        Self { count: 6, from_hz: None, to_hz: None }
    }
}

/// The strongest peaks of an envelope spectrum, strongest first, each with the nearest of `lines`.
///
/// A peak that could be leakage alone is left out: one not higher than 1.2 sum_i A_i l(d_i T) over the stronger
/// peaks i at distance d_i Hz and their images at -f_i (T the window's length, s, l the bound of the window function's
/// side lobes, [`WindowFunction::leakage`], 1 / (pi d T) for a boxcar); or closer than the resolution to a stronger peak;
/// or below 1 % of the strongest. So a weak line close beside a
/// strong one is not listed either: the window cannot tell them apart; look with `EnvelopeSpectrum::peak_near` and
/// take a longer window.
pub fn envelope_peaks(spectrum: &EnvelopeSpectrum, lines: &[NamedLine], search: &PeakSearch) -> Vec<EnvelopePeak> {
    let duration_s = spectrum.window.to - spectrum.window.from;
    let from_hz = search.from_hz.unwrap_or(spectrum.resolution_hz);
    let mut candidates = local_maxima(&spectrum.frequency_hz, &spectrum.amplitude);
    candidates.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let mut peaks: Vec<Peak> = Vec::new();
    for candidate in candidates {
        let in_band = candidate.frequency_hz >= from_hz && search.to_hz.is_none_or(|to| candidate.frequency_hz <= to);
        if peaks.len() == search.count {
            break;
        }
        if in_band && stands_out(&candidate, &peaks, spectrum.window_function, duration_s) {
            peaks.push(candidate);
        }
    }
    peaks
        .into_iter()
        .map(|peak| EnvelopePeak {
            frequency_hz: peak.frequency_hz,
            amplitude: peak.amplitude,
            above_median_db: above_median_db(spectrum, &peak, FLOOR_BINS / duration_s),
            line: match_line(peak.frequency_hz, lines),
            labels: lines_at(peak.frequency_hz, lines, spectrum.resolution_hz).iter().map(LineMatch::label).collect(),
        })
        .collect()
}

/// A peak's amplitude over the median of those within `reach_hz`, dB.
fn above_median_db(spectrum: &EnvelopeSpectrum, peak: &Peak, reach_hz: f64) -> f64 {
    let near = spectrum.frequency_hz.iter().zip(&spectrum.amplitude);
    let near = near.filter(|(hz, _)| (**hz - peak.frequency_hz).abs() <= reach_hz);
    let mut near: Vec<f64> = near.map(|(_, amplitude)| *amplitude).collect();
    let middle = near.len() / 2;
    let median = *near.select_nth_unstable_by(middle, f64::total_cmp).1;
    20.0 * (peak.amplitude / median).log10()
}

/// The lines that a peak at `frequency_hz` may be, nearest first: of the harmonics that are no farther than the larger of
/// [`LINE_TOLERANCE`] of their frequency and half of `resolution_hz` (what the window separates, whatever the padding) the
/// nearest, and those nearer to it than `resolution_hz`, which nothing tells from it. Empty if the peak is none of `lines`.
pub fn lines_at(frequency_hz: f64, lines: &[NamedLine], resolution_hz: f64) -> Vec<LineMatch> {
    let harmonics = lines.iter().flat_map(|line| {
        let place = |harmonic: u32| f64::from(harmonic) * line.found_hz;
        (1..=line.harmonics).map(move |harmonic| (place(harmonic), line.at(harmonic, frequency_hz)))
    });
    let distance = |place: f64| (frequency_hz - place).abs();
    let mut near: Vec<(f64, LineMatch)> =
        harmonics.filter(|(hz, _)| distance(*hz) <= (LINE_TOLERANCE * hz).max(0.5 * resolution_hz)).collect();
    near.sort_by(|a, b| distance(a.0).total_cmp(&distance(b.0)));
    if let Some(nearest) = near.first().map(|line| line.0) {
        near.retain(|line| (line.0 - nearest).abs() < resolution_hz.max(f64::MIN_POSITIVE));
    }
    near.into_iter().map(|(_, line)| line).collect()
}

/// The line and harmonic nearest to `frequency_hz` (in Hz; the first given wins a tie), `None` without lines.
pub fn match_line(frequency_hz: f64, lines: &[NamedLine]) -> Option<LineMatch> {
    lines
        .iter()
        .map(|line| {
            let multiple = (frequency_hz / line.found_hz).round().clamp(1.0, f64::from(line.harmonics));
            ((frequency_hz - multiple * line.found_hz).abs(), line.at(multiple as u32, frequency_hz))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, line)| line)
}

/// Whether a peak is more than the leakage of the stronger ones.
fn stands_out(candidate: &Peak, stronger: &[Peak], window_function: WindowFunction, duration_s: f64) -> bool {
    let widths = |peak: &Peak| (candidate.frequency_hz - peak.frequency_hz).abs() * duration_s;
    let leakage: f64 = stronger
        .iter()
        .map(|peak| {
            let image = (candidate.frequency_hz + peak.frequency_hz) * duration_s;
            peak.amplitude * (window_function.leakage(widths(peak)) + window_function.leakage(image))
        })
        .sum();
    let floor = stronger.first().map_or(0.0, |peak| FLOOR * peak.amplitude);
    // within the main lobe the leakage is the whole line
    candidate.amplitude >= floor && candidate.amplitude > LEAKAGE_MARGIN * leakage
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::series::{TimeSeries, TimeWindow};
    use crate::signal::envelope_spectrum;
    use std::f64::consts::PI;

    /// "Envelope" with lines at 21 Hz (2), 55 Hz (5) and 110.5 Hz (3) over 0.5 s at 10 kHz.
    fn spectrum(window_function: WindowFunction) -> EnvelopeSpectrum {
        let values = (0..5000).map(|k| {
            let t = f64::from(k) * 1e-4;
            [(21.0, 2.0), (55.0, 5.0), (110.5, 3.0)].iter().map(|(f, a)| a * (2.0 * PI * f * t).cos()).sum::<f64>()
        });
        let series = TimeSeries::new(0.0, 1e-4, "m/s^2", values.collect()).expect("a valid series");
        envelope_spectrum(&series, None, window_function, 0.25).expect("spectrum")
    }

    fn lines() -> Vec<NamedLine> {
        [("shaft", 21.3, 3), ("outer", 54.7, 4), ("inner", 94.4, 4)]
            .map(|(name, f, harmonics)| NamedLine::new(name, f, harmonics).expect("a valid line"))
            .to_vec()
    }

    #[test]
    fn three_lines_give_three_peaks_with_their_names() {
        let peaks = envelope_peaks(&spectrum(WindowFunction::Boxcar), &lines(), &PeakSearch::default());
        // Side lobes of the 55 Hz line are a fifth of it, as high as half the 21 Hz line; none is listed.
        assert_eq!(peaks.len(), 3, "{peaks:?}");
        let expected = [(55.0, 5.0, "outer", 1, 54.7), (110.5, 3.0, "outer", 2, 109.4), (21.0, 2.0, "shaft", 1, 21.3)];
        for (peak, (f, a, name, harmonic, line_hz)) in peaks.iter().zip(expected) {
            assert!((peak.frequency_hz - f).abs() < 0.2, "{peak:?}");
            assert!((peak.amplitude / a - 1.0).abs() < 0.05, "{peak:?}");
            let line = peak.line.as_ref().expect("lines were given");
            assert_eq!((line.nearest.as_str(), line.harmonic), (name, harmonic));
            assert_eq!(peak.labels, [line.label()]);
            let deviation = peak.frequency_hz / line_hz - 1.0;
            assert!((line.deviation - deviation).abs() < 1e-12);
        }
    }

    #[test]
    fn every_window_function_lists_the_three_lines_alone() {
        for window_function in
            [WindowFunction::Hann, WindowFunction::Hamming, WindowFunction::Blackman, WindowFunction::FlatTop]
        {
            let found = envelope_peaks(&spectrum(window_function), &[], &PeakSearch::default());
            let mut found: Vec<f64> = found.iter().map(|p| p.frequency_hz.round()).collect();
            found.sort_by(f64::total_cmp);
            // 110.5 Hz may round either way
            assert_eq!(found.len(), 3, "{window_function:?}: {found:?}");
            assert_eq!(&found[..2], [21.0, 55.0]);
        }
    }

    #[test]
    fn search_obeys_count_and_band() {
        let search = |search| envelope_peaks(&spectrum(WindowFunction::Boxcar), &[], &search);
        let one = search(PeakSearch { count: 1, ..Default::default() });
        assert_eq!(one.len(), 1);
        assert_eq!(one[0].line, None);
        let band = search(PeakSearch { count: 9, from_hz: Some(80.0), to_hz: Some(120.0) });
        assert!((band[0].frequency_hz - 110.5).abs() < 0.2);
        assert!(search(PeakSearch { count: 0, ..Default::default() }).is_empty());
    }

    #[test]
    fn a_peak_is_so_far_above_the_median_about_it() {
        // a second of noise, resolved to 2 Hz: its floor reaches 5 Hz to each side
        let frequency_hz: Vec<f64> = (0..400).map(|k| 0.25 * f64::from(k)).collect();
        let floor = |hz: &f64| match (hz - 50.0).abs() {
            away if away < 0.1 => 20.0,
            away if away <= 5.0 => 2.0,
            _ => 1.0,
        };
        let mut spectrum = spectrum(WindowFunction::Boxcar);
        spectrum.spectrum.amplitude = frequency_hz.iter().map(floor).collect();
        spectrum.spectrum.frequency_hz = frequency_hz;
        spectrum.spectrum.window = TimeWindow { from: 2.0, to: 3.0 };
        let peaks = envelope_peaks(&spectrum, &[], &PeakSearch::default());
        assert!((peaks[0].frequency_hz - 50.0).abs() < 1e-9, "{peaks:?}");
        assert!((peaks[0].above_median_db - 20.0).abs() < 1e-9, "{peaks:?}");
    }

    #[test]
    fn match_stops_at_the_last_harmonic() {
        let found = match_line(400.0, &lines()).expect("lines were given");
        assert_eq!((found.nearest.as_str(), found.harmonic), ("inner", 4));
        let low = match_line(3.0, &lines()).expect("lines were given");
        assert_eq!((low.nearest.as_str(), low.harmonic), ("shaft", 1));
    }

    /// Lines at 21.3, 54.7 and 94.4 Hz, judged with lines 0.5, 4 and 14 Hz apart.
    #[test]
    fn a_peak_is_a_line_within_three_percent_or_half_the_resolution() {
        let labels = |hz: f64, resolution_hz: f64| -> Vec<String> {
            let found = lines_at(hz, &lines(), resolution_hz);
            found.iter().map(LineMatch::label).collect()
        };
        // 3 % of 54.7 Hz is 1.64 Hz
        assert_eq!(labels(56.3, 0.5), ["1 x outer"]);
        assert_eq!(labels(56.4, 0.5), [""; 0]);
        assert_eq!(labels(1.7, 0.5), [""; 0], "92 % below the shaft");
        // half of 4 Hz is more
        assert_eq!(labels(56.6, 4.0), ["1 x outer"]);
        assert_eq!(labels(56.8, 4.0), [""; 0]);
        // 63.9 (shaft) and 54.7 Hz (outer) are 9.2 Hz apart: a window that separates 14 Hz does not tell them apart
        assert_eq!(labels(59.2, 8.0), [""; 0]);
        assert_eq!(labels(59.2, 14.0), ["1 x outer", "3 x shaft"]);
        assert_eq!(labels(59.4, 14.0), ["3 x shaft", "1 x outer"]);
        assert_eq!(lines_at(54.7, &[], 1.0), []);
    }

    /// Of two lines within three percent the nearest, if the window separates them, and both otherwise.
    #[test]
    fn lines_that_the_window_separates_are_not_both_named() {
        let lines = [("inner", 100.0), ("ball", 103.0)];
        let lines = lines.map(|(name, f)| NamedLine::new(name, f, 1).expect("a valid line"));
        let count = |resolution_hz| lines_at(101.4, &lines, resolution_hz).len();
        assert_eq!((count(2.9), count(3.1)), (1, 2));
    }

    /// The outer race slips by 1.5 %: its line is nearer to another's than to where it is expected.
    #[test]
    fn a_line_is_matched_where_the_signal_shows_it() {
        let named = |name, f| NamedLine::new(name, f, 1).expect("a valid line");
        let matched = |outer: NamedLine| {
            let lines = [outer, named("ball", 102.5)];
            let nearest = match_line(101.6, &lines).expect("lines were given");
            (lines_at(101.6, &lines, 0.5).iter().map(LineMatch::label).collect::<Vec<_>>(), nearest)
        };
        assert_eq!(matched(named("outer", 100.0)).0, ["1 x ball"]);
        let (labels, nearest) = matched(named("outer", 100.0).found_at(101.5));
        assert_eq!((labels, nearest.nearest.as_str()), (vec!["1 x outer".to_owned()], "outer"));
        assert!((nearest.expected_hz - 100.0).abs() < 1e-12 && (nearest.deviation - 0.016).abs() < 1e-12);
    }

    /// Two names for one frequency are both said, however fine the resolution.
    #[test]
    fn lines_that_coincide_are_all_named() {
        let lines = [("shaft", 20.0), ("outer", 60.0)];
        let lines = lines.map(|(name, f)| NamedLine::new(name, f, 3).expect("a valid line"));
        let found = lines_at(60.01, &lines, 1e-3);
        let labels: Vec<String> = found.iter().map(LineMatch::label).collect();
        assert_eq!(labels, ["3 x shaft", "1 x outer"]);
    }

    #[test]
    fn json_is_flat() {
        let peak = EnvelopePeak {
            frequency_hz: 55.0,
            amplitude: 5.0,
            above_median_db: 12.0,
            line: match_line(55.0, &lines()),
            labels: Vec::new(),
        };
        let json = serde_json::to_value(&peak).expect("serialises");
        assert_eq!(json["nearest"], "outer");
        assert_eq!(json["harmonic"], 1);
        assert!(json["deviation"].is_f64());
    }

    #[test]
    fn lines_without_frequency_or_harmonics_are_refused() {
        let message = |f, harmonics| NamedLine::new("outer", f, harmonics).expect_err("must fail").to_string();
        assert_eq!(
            message(0.0, 2),
            "line \"outer\" must have a positive frequency and at least one harmonic, found 0 Hz and 2"
        );
        assert!(message(10.0, 0).ends_with("found 10 Hz and 0"));
        assert!(message(f64::INFINITY, 1).ends_with("found inf Hz and 1"));
    }
}
