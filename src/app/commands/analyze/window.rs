//! Envelope analysis of a signal in windows, and what it says of the bearing: of a run's and of a measured one.
//!
//! What of a simulated bearing a signal cannot show, and the case knows.

use super::band_search::{AskedBand, UsedBand};
use super::fault_lines::{FaultLine, fault_lines};
use crate::app::case::{Bearing, Case, Defect, DentDefect, Load, MeasuredDefect};
use crate::app::error::ComputeError;
use crate::bearing::Race;
use crate::bearing::kinematics::DefectOrders;
use crate::formats::MeasuredSignal;
use crate::numerics::Watch;
use crate::numerics::series::{PASSED, TimeSeries, TimeWindow};
use crate::report::{Curve, Thinner, quantity, significant};
use crate::signal::diagnosis::{
    Conclusion, Diagnosis, DiagnosisError, EnvelopeOrderSpectrum, Fault, FaultOrders, FaultVerdict, Kinematics,
    LevelChange, LineChange, spectrum_end_hz,
};
use crate::signal::{
    Emphasis, EnvelopeAnalysis, EnvelopePeak, EnvelopeSpectrum, NamedLine, PeakSearch, SignalError, band_limit,
    envelope_peaks, rms_up_to, squared, usual_high_pass_hz, whiten,
};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// Harmonics of each line that peaks are matched to; of a part that is named all that the verdict looks at. More of the others
/// would name peaks by chance: within 3 % of k times a line are 6 k % of the distance of two of its harmonics.
const HARMONICS: u32 = 3;

/// Highest frequency of the envelope spectrum that is looked at, in shaft orders; the third
/// harmonic of the highest fault order of usual bearings lies below.
const HIGHEST_ORDER: f64 = 25.0;

/// Points of a window's signal, and of its envelope, that are kept to be shown.
const SHOWN_POINTS: usize = 4000;

/// What is analysed of a signal.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AnalysisSettings {
    /// Band that is asked for; `None`: verdicts look at all bands.
    pub band: Option<AskedBand>,
    /// Band of the envelope that is shown where none is asked for; `None`: the signal as it is.
    pub shown_band: Option<AskedBand>,
    /// Whether the envelope spectra are those of the whitened signal's squared envelope; verdicts look at both anyway.
    pub whiten: bool,
    /// Windows, s.
    pub windows: Vec<TimeWindow>,
    /// Frequency up to which a simulated signal is accurate, Hz; `None`: a measured one.
    pub good_to_hz: Option<f64>,
    /// Parts of a simulated bearing of which a signal may not indicate a fault, whether they are sound, and why.
    pub no_signs: Vec<(Fault, bool, String)>,
}

impl AnalysisSettings {
    /// What a case asks for, of one of its bearings; `shown` is what a run showed of its damage.
    #[must_use]
    pub(crate) fn of(case: &Case, bearing: Option<&Bearing>, shown: DamageShown) -> Self {
        Self {
            band: AskedBand::of(case),
            shown_band: None,
            whiten: case.analysis.whiten,
            windows: case.analysis.envelope.clone(),
            good_to_hz: good_to_hz(case),
            no_signs: no_signs(case, bearing, shown),
        }
    }

    /// Judges a window (s) of a signal by its envelopes within `within_hz`, and by what is known of the bearing beside.
    ///
    /// # Errors
    /// As [`Diagnosis::of`].
    pub(crate) fn judge(
        &self,
        signal: &TimeSeries,
        within_hz: Option<[f64; 2]>,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64,
        orders: &FaultOrders,
    ) -> Result<Diagnosis, DiagnosisError> {
        let mut diagnosis = Diagnosis::of(signal, within_hz, window, turns, orders)?;
        self.no_signs.iter().for_each(|(fault, _, reason)| diagnosis.doubt(*fault, reason));
        Ok(diagnosis)
    }

    /// Whether a case says that the part is sound.
    pub(crate) fn is_sound(&self, part: Fault) -> bool {
        self.no_signs.iter().any(|(fault, sound, _)| *fault == part && *sound)
    }
}

/// Frequency up to which a case's recorded signals are accurate, Hz: the end of its band, or what the recording filter passes.
fn good_to_hz(case: &Case) -> Option<f64> {
    let passed = PASSED * case.transient.as_ref()?.output_hz;
    Some(case.band_hz()?[1].min(passed))
}

/// Multiples of a bearing's lines that are known for its own, and how near an order has to be, relative.
const LISTED_MULTIPLES: u32 = 6;
const SAME_ORDER: f64 = 5e-3;

/// Whether an order is a multiple of a line of one of these bearings.
fn is_line_of(bearings: &[DefectOrders], order: f64) -> bool {
    let lines = bearings.iter().flat_map(|own| [own.outer, own.inner, own.ball_defect, own.cage]);
    let mut multiples = lines.flat_map(|line| (1..=LISTED_MULTIPLES).map(move |k| f64::from(k) * line));
    multiples.any(|line| (order / line - 1.0).abs() < SAME_ORDER)
}

/// What of a signal lies in the band of its case.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct BandLevel {
    /// End of the band, Hz.
    pub to_hz: f64,
    /// Root mean square up to there, in the unit of the signal.
    pub rms: f64,
}

impl BandLevel {
    /// Of a window of a signal.
    fn of(window: &TimeSeries, to_hz: f64) -> Result<Self, SignalError> {
        Ok(Self { to_hz, rms: rms_up_to(window, to_hz)? })
    }

    /// In words, where it is another level than that of the whole signal.
    pub(crate) fn beside(self, rms: f64, unit: &str) -> Option<String> {
        let [end, level] = [quantity(self.to_hz, "Hz"), significant(self.rms, 3)];
        (self.rms < SAME_LEVEL * rms)
            .then(|| format!("{level} {unit} of it up to {end}, the end of the band; no error is estimated above"))
    }
}

/// A level in the band over that of the whole signal, above which nothing is said of it: 1 % of the power lies above.
const SAME_LEVEL: f64 = 0.995;

/// A window of the signal, analysed. JSON results hold all of it but the curves.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WindowAnalysis {
    /// Sensor or channel that it belongs to.
    pub sensor: String,
    /// The bearing that it is of, where a case has several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bearing: Option<String>,
    /// Unit of its signal.
    pub unit: String,
    /// Whether the envelope spectrum is of the whitened signal's squared envelope.
    pub whitened: bool,
    /// Start, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// Mean shaft speed in the window, Hz.
    pub speed_hz: f64,
    /// Root mean square of the signal, in its unit.
    pub rms: f64,
    /// The same of what lies in the case's band, in which the error is estimated; absent from measured signals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms_in_band: Option<BandLevel>,
    /// Largest magnitude, in its unit.
    pub peak: f64,
    /// Kurtosis (3 for a normal distribution); `None` for a constant signal.
    pub kurtosis: Option<f64>,
    /// Band that the envelope is of.
    #[serde(flatten)]
    pub band: UsedBand,
    /// The lines of every part in the envelope over the shaft's angle.
    pub fault_lines: Vec<FaultLine>,
    /// The order above which lines over Hz are smeared and not compared with peaks: the speed changes too much. `None`: none is.
    #[serde(rename = "lines_smeared_above_order")]
    pub smeared_above: Option<f64>,
    /// Strongest peaks of the envelope spectrum.
    #[serde(rename = "envelope_peaks")]
    pub peaks: Vec<EnvelopePeak>,
    /// Verdict on each part of the bearing, or why there is none.
    #[serde(rename = "verdict", serialize_with = "verdict_summary")]
    #[schemars(with = "VerdictSummary<'static>")]
    pub diagnosis: Result<Diagnosis, String>,
    /// What changed since an earlier signal; absent where none was named.
    #[serde(rename = "changes", skip_serializing_if = "Option::is_none")]
    pub change: Option<WindowChange>,
    /// Signal and envelope over time, thinned.
    #[serde(skip)]
    pub shown: [Curve; 2],
    /// Envelope spectrum.
    #[serde(skip)]
    pub spectrum: EnvelopeSpectrum,
    /// Fault lines and the shaft's, with those harmonics that the speed's change leaves sharp.
    #[serde(skip)]
    pub lines: Vec<NamedLine>,
}

/// A verdict, or why there is none.
#[derive(Serialize, JsonSchema)]
struct VerdictSummary<'a> {
    /// In a few words.
    headline: String,
    /// What decided it, in a sentence or two.
    reason: String,
    /// What it rests on; absent where there is no verdict.
    #[serde(flatten)]
    diagnosis: Option<&'a Diagnosis>,
}

fn verdict_summary<S: Serializer>(diagnosis: &Result<Diagnosis, String>, to: S) -> Result<S::Ok, S::Error> {
    let (headline, reason) = match diagnosis {
        Ok(diagnosis) => (diagnosis.headline(), diagnosis.reason()),
        Err(reason) => ("no verdict".to_owned(), reason.clone()),
    };
    VerdictSummary { headline, reason, diagnosis: diagnosis.as_ref().ok() }.serialize(to)
}

impl WindowAnalysis {
    /// The same of a bearing with this label, which is empty for the only one. Impacts at the orders of the bearings of a machine that has
    /// several, this one's among them, or at their multiples, are theirs and not unexplained.
    pub(crate) fn of_bearing(mut self, label: &str, several: &[DefectOrders]) -> Self {
        if let Ok(diagnosis) = &mut self.diagnosis {
            diagnosis.unexplained.retain(|impacts| !is_line_of(several, impacts.order));
        }
        Self { bearing: Some(label.to_owned()).filter(|label| !label.is_empty()), ..self }
    }

    /// Sensor and bearing.
    pub(crate) fn place(&self) -> String {
        match &self.bearing {
            None => self.sensor.clone(),
            Some(label) => format!("{}, bearing {label}", self.sensor),
        }
    }

    /// Whether any part was judged.
    #[must_use]
    pub(crate) fn is_judged(&self) -> bool {
        self.diagnosis.as_ref().is_ok_and(Diagnosis::is_judged)
    }

    /// What makes its verdict doubtful, a sentence each: a speed that no line confirms, or another speed than the given one.
    #[must_use]
    pub fn doubts(&self) -> Vec<String> {
        let diagnosis = self.diagnosis.iter();
        diagnosis.flat_map(|found| [found.speed_doubt(), found.speed_change()].into_iter().flatten()).collect()
    }

    /// The parts of which this is said.
    pub(crate) fn parts(&self, conclusion: Conclusion) -> impl Iterator<Item = &FaultVerdict> {
        let verdicts = self.diagnosis.iter().flat_map(|found| &found.faults);
        verdicts.filter(move |verdict| verdict.conclusion == conclusion)
    }

    /// Without the curves, which fill the memory where windows are many.
    pub(crate) fn without_curves(mut self) -> Self {
        let spectrum = &mut self.spectrum.spectrum;
        let mut curves = vec![&mut spectrum.frequency_hz, &mut spectrum.amplitude];
        curves.extend(self.shown.iter_mut().map(|curve| &mut curve.y));
        if let Ok(diagnosis) = &mut self.diagnosis {
            curves.extend([&mut diagnosis.spectrum.order, &mut diagnosis.spectrum.amplitude]);
        }
        curves.into_iter().for_each(|values| *values = Vec::new());
        if let Some(Ok(search)) = &mut self.band.search {
            search.kurtogram.bands = Vec::new();
        }
        if let Some(change) = &mut self.change {
            change.spectra = None;
        }
        self
    }
}

/// Analyses one sensor's signal in every window. `read` gives the stretch of it that holds a window (s), with
/// so many seconds before and after as there are: at least the window's own length, that its envelope has no edges.
///
/// # Errors
/// Of `read`, and
/// [`ComputeError::Signal`] or [`ComputeError::Series`] for a window outside the signal or a filter
/// that does not fit the sampling.
pub fn analyse(
    sensor: &str,
    settings: &AnalysisSettings,
    read: impl Fn(TimeWindow, f64) -> Result<TimeSeries, ComputeError>,
    kinematics: &Kinematics,
) -> Result<Vec<WindowAnalysis>, ComputeError> {
    let windows = settings.windows.iter();
    windows
        .map(|&window| {
            let (from, to) = (window.from, window.to);
            let speed_hz = kinematics.mean_speed_hz(window);
            let orders = kinematics.orders(window)?;
            let read = |window, margin_s: f64| read(window, margin_s.max(to - from));
            let band = UsedBand::of(settings.band.or(settings.shown_band), window, read, speed_hz, &orders)?;
            let filter = EnvelopeAnalysis { high_pass_hz: band.high_pass_hz, ..EnvelopeAnalysis::default() };
            let stretch = read(window, band.margin_s())?;
            let envelope_of = |signal: &TimeSeries| match band.low_pass_hz {
                Some(up_to_hz) => filter.envelope(&band_limit(signal, up_to_hz)?),
                None => filter.envelope(signal),
            };
            let envelope = envelope_of(&stretch)?;
            let whitened = settings.whiten.then(|| {
                let white = whiten(&stretch, Emphasis::Even)?;
                squared(&envelope_of(&white)?)
            });
            let whitened = whitened.transpose()?;
            let part = stretch.window(from, to)?;
            let of_lines = whitened.as_ref().unwrap_or(&envelope);
            let spectrum = filter.window_of(of_lines, from, to)?;
            let turns = |time| kinematics.turns(time);
            let good_to_hz = settings.good_to_hz.or_else(|| spectrum_end_hz(&part));
            let within_hz = band.judged_hz(settings.band, good_to_hz);
            let diagnosis = settings.judge(&stretch, within_hz, window, turns, &orders);
            let sharp = sharp_order(kinematics.speed_spread_hz(window), to - from);
            let (lines, smeared) = lines(speed_hz, &orders, diagnosis.as_ref().ok(), sharp)?;
            let search = PeakSearch { to_hz: Some(HIGHEST_ORDER * speed_hz), ..PeakSearch::default() };
            let peaks = if speed_hz > 0.0 { envelope_peaks(&spectrum, &lines, &search) } else { Vec::new() };
            Ok(WindowAnalysis {
                sensor: sensor.to_owned(),
                bearing: None,
                unit: stretch.unit().to_owned(),
                from,
                to,
                speed_hz,
                rms: part.rms(),
                rms_in_band: settings.good_to_hz.map(|hz| BandLevel::of(&part, hz)).transpose()?,
                peak: part.peak(),
                kurtosis: part.kurtosis(),
                shown: [thinned(sensor, &part), thinned("envelope", &envelope.window(from, to)?)],
                whitened: settings.whiten,
                fault_lines: fault_lines(of_lines, window, turns, &orders, speed_hz, diagnosis.as_ref().ok()),
                band,
                spectrum,
                lines,
                smeared_above: smeared.then_some(sharp),
                peaks,
                diagnosis: diagnosis.map_err(|error| error.to_string()),
                change: None,
            })
        })
        .collect()
}

/// A curve of few points in which spikes survive.
fn thinned(name: &str, series: &TimeSeries) -> Curve {
    let mut thinner = Thinner::new(series.values().len(), SHOWN_POINTS);
    thinner.push(series.values());
    Curve::of_thinned(name, [series.start_s(), series.step_s()], thinner)
}

/// The highest order whose line over Hz a change of the speed (Hz) spreads over no more than what a window (s) separates, 1 / T.
fn sharp_order(spread_hz: f64, duration_s: f64) -> f64 {
    1.0 / (spread_hz * duration_s)
}

/// The shaft's line and those of the faults whose order is known, with their harmonics up to the order `sharp`; and whether there
/// are others.
fn lines(
    speed_hz: f64,
    orders: &FaultOrders,
    diagnosis: Option<&Diagnosis>,
    sharp: f64,
) -> Result<(Vec<NamedLine>, bool), ComputeError> {
    if speed_hz <= 0.0 {
        return Ok((Vec::new(), false));
    }
    let shaft_hz = diagnosis.map_or(speed_hz, |found| found.speed_hz);
    // a part whose lines stand out has more harmonics, and its own order
    let stands_out =
        |verdict: &&FaultVerdict| verdict.conclusion != Conclusion::NotSeen && verdict.false_alarm.is_some();
    let known = [Fault::OuterRace, Fault::InnerRace, Fault::Ball].into_iter().filter_map(|fault| {
        let order = orders.order(fault)?;
        let verdicts = diagnosis.into_iter().flat_map(|found| &found.faults);
        let seen = verdicts.filter(stands_out).find(|verdict| verdict.fault == fault);
        let last = seen.and_then(|verdict| verdict.harmonics.last());
        let harmonics = last.map_or(HARMONICS, |last| last.harmonic.max(HARMONICS));
        let own = seen.filter(|verdict| verdict.cage_lines.is_none()).and_then(|verdict| verdict.order);
        Some((fault.name(), order, own.unwrap_or(order), harmonics))
    });
    let mut lines = Vec::new();
    let mut smeared = false;
    for (name, order, found, harmonics) in std::iter::once(("shaft", 1.0, 1.0, HARMONICS)).chain(known) {
        let kept = (1..=harmonics).take_while(|&k| f64::from(k) * order <= sharp);
        let kept = kept.last().unwrap_or(0);
        smeared |= kept < harmonics;
        if kept > 0 {
            lines.push(NamedLine::new(name, order * speed_hz, kept)?.found_at(found * shaft_hz));
        }
    }
    Ok((lines, smeared))
}

/// A window beside an earlier signal.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct WindowChange {
    /// File or folder of the earlier signal.
    pub baseline: String,
    /// Its channel.
    pub channel: String,
    /// Start of its window, s.
    pub from: f64,
    /// End of its window, s.
    pub to: f64,
    /// Mean shaft speed in it, Hz.
    pub speed_hz: f64,
    /// Root mean square in it, in the signal's unit.
    pub rms: f64,
    /// Largest magnitude in it, in the signal's unit.
    pub peak: f64,
    /// Kurtosis in it; `None` for a constant signal.
    pub kurtosis: Option<f64>,
    /// The impacts of each part, and of those that belong to none.
    pub lines: Vec<LineChange>,
    /// RMS of all of the signal (first), and of each octave.
    pub levels: Vec<LevelChange>,
    /// Order spectra of the envelope of one band (Hz) in this signal and in the earlier one.
    #[serde(skip)]
    pub spectra: Option<([f64; 2], [EnvelopeOrderSpectrum; 2])>,
    /// What makes the comparison doubtful, in words.
    pub warnings: Vec<String>,
}

/// Analyses every signal in every window; without windows each as a whole. Without a band in `settings`: the high-pass of
/// `usual_high_pass_hz`.
///
/// # Errors
/// [`ComputeError`]: a window outside a signal, a filter beyond half the sampling rate, a shaft that turns more than once in two samples.
pub fn compute_analysis(
    signals: &[MeasuredSignal],
    settings: &AnalysisSettings,
    kinematics: &Kinematics,
    watch: &impl Watch,
) -> Result<Vec<WindowAnalysis>, ComputeError> {
    watch.stage("analyse");
    let mut windows = Vec::new();
    for signal in signals {
        check_speed(signal, kinematics)?;
        let series = &signal.series;
        let mut own = settings.clone();
        if own.windows.is_empty() {
            own.windows.push(series.span());
        }
        let usual = AskedBand::HighPass(usual_high_pass_hz(series.rate_hz()));
        own.shown_band.get_or_insert(usual);
        let read = |window: TimeWindow, margin_s: f64| stretch(series, window, margin_s);
        windows.extend(analyse(&signal.name, &own, read, kinematics)?);
    }
    Ok(windows)
}

/// Refuses a shaft that turns more than once in two samples.
///
/// # Errors
/// [`ComputeError::Input`].
pub(crate) fn check_speed(signal: &MeasuredSignal, kinematics: &Kinematics) -> Result<(), ComputeError> {
    let (series, speed_hz) = (&signal.series, kinematics.mean_speed_hz(signal.series.span()));
    if speed_hz < 0.5 * series.rate_hz() {
        return Ok(());
    }
    let what = format!(
        "channel \"{}\": expected a shaft speed below half of the sampling rate, {:e} Hz, found {speed_hz:e} Hz",
        signal.name,
        series.rate_hz()
    );
    Err(ComputeError::input(what, "check speed and sampling rate, as given or as the file says"))
}

/// The stretch of a series that holds a window, with so many seconds before and after it as there are.
///
/// # Errors
/// [`ComputeError::Diagnosis`] for a window outside the series: a window that was asked for and is not there is wrong input.
pub(crate) fn stretch(series: &TimeSeries, window: TimeWindow, margin_s: f64) -> Result<TimeSeries, ComputeError> {
    let samples = series.values().len();
    window.check_inside(series.start_s(), series.step_s(), samples).map_err(DiagnosisError::from)?;
    let span = series.span();
    let from = (window.from - margin_s).max(span.from);
    let to = (window.to + margin_s).min(span.to);
    Ok(series.window(from, to)?)
}

/// Load over the weight of a ball from which balls of a healthy bearing with play strike as hard as those of a damaged one. The bearing
/// of `examples/tadina2011` does so from 12 000 on and bearing 627 from 8000; of 6205 it is seen at 970 already (`docs/diagnosis.md`).
const STRIKING_LOAD: f64 = 7500.0;
/// m/s^2
const STANDARD_GRAVITY: f64 = 9.80665;

/// What is known of the part that the damage of a simulated bearing has in the signals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum DamageShown {
    /// The bearing stays in its plane: play and load say whether its lines are a sign.
    InPlane,
    /// In space; no stretch without the damage was stepped beside one with it.
    NotCompared,
    /// In space; what the damage adds to a stretch, over the RMS without it, the largest sensor's.
    Share(f64),
}

impl DamageShown {
    /// Of a bearing in space, by its share if a stretch was compared.
    pub(crate) fn in_space(share: Option<f64>) -> Self {
        share.map_or(Self::NotCompared, Self::Share)
    }
}

/// What damage has to add to a signal to be what its lines come from, over the signal without it.
const DAMAGE_SHOWS: f64 = 1.0;

/// Why lines of a part are no sign of damage in a simulated bearing: the case has no damage there, the load is too large to tell, or a
/// stretch with and without the damage differs by too little, or was not compared.
pub(crate) fn no_signs(case: &Case, bearing: Option<&Bearing>, shown: DamageShown) -> Vec<(Fault, bool, String)> {
    let Some(bearing) = bearing else {
        return Vec::new();
    };
    let has_play = bearing.play() > 0.0 && shown == DamageShown::InPlane;
    let play = has_play.then(|| format!("the play is {} µm", significant(1e6 * bearing.play(), 2)));
    let damaged = bearing.defects.iter().map(|defect| match defect {
        Defect::Dent(DentDefect { on, .. }) | Defect::Measured(MeasuredDefect { on, .. }) => match on {
            Race::Outer => Fault::OuterRace,
            Race::Inner => Fault::InnerRace,
        },
        Defect::Flat(_) => Fault::Ball,
    });
    let damaged: Vec<Fault> = damaged.collect();
    let reasons = [Fault::OuterRace, Fault::InnerRace, Fault::Ball].into_iter().filter_map(|fault| {
        let play = play.as_ref().filter(|_| fault == Fault::OuterRace);
        let reason = match (damaged.contains(&fault), play) {
            (false, Some(play)) => format!("The case has no damage there, and {play}."),
            (false, None) => "The case has no damage there.".to_owned(),
            (true, _) if shown != DamageShown::InPlane => match shown {
                DamageShown::Share(share) if share >= DAMAGE_SHOWS => return None,
                DamageShown::Share(share) => format!(
                    "A sound bearing has such lines too: without the damage a stretch of the run differs by {} of its RMS at most.",
                    significant(share, 2)
                ),
                _ => "A sound bearing has such lines too, and no stretch of the run could be compared with one without the damage."
                    .to_owned(),
            },
            (true, play) => {
                let (play, weights) = (play?, ball_weights(case, bearing).filter(|weights| *weights >= STRIKING_LOAD)?);
                format!(
                    "Its lines cannot be told from those of play: {play}, and shaft and loads weigh up to {} times a ball. Only a comparison with a run without the damage tells (--baseline).",
                    significant(weights, 2)
                )
            }
        };
        Some((fault, !damaged.contains(&fault), reason))
    });
    reasons.collect()
}

/// The largest load of the bearing over the weight of a ball.
fn ball_weights(case: &Case, bearing: &Bearing) -> Option<f64> {
    let shaft = case.shaft.as_ref()?;
    let size = |[x, y]: [f64; 2]| x.hypot(y);
    let largest = |load: &Load| {
        let points = load.in_space().1;
        points.iter().fold(0.0, |most, (_, [x, y, ..])| size([*x, *y]).max(most))
    };
    let load = shaft.mass * size(shaft.gravity) + shaft.loads.iter().map(largest).sum::<f64>();
    Some(load / (case.mass_of_ball(bearing).ok()? * STANDARD_GRAVITY))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::kinematics::BallRow;

    #[test]
    fn multiples_of_a_bearings_lines_are_its_own() {
        let bearings =
            [(9, 0.0), (7, 0.3)].map(|(balls, angle)| BallRow::new(balls, 4e-3, 19.5e-3, angle).unwrap().orders());
        let [one, other] = bearings;
        for line in [one.outer, one.inner, other.ball_defect, other.cage] {
            assert!(is_line_of(&bearings, 2.0013 * line) && is_line_of(&bearings, 6.0 * line), "{line}");
        }
        assert!(!is_line_of(&bearings, 2.02 * one.outer));
        // of a machine with one bearing nothing is known for its own here
        assert!(!is_line_of(&[], one.outer));
    }

    /// Tones at 9.9 and 10.1 kHz, whole periods of each: half of the power lies in the band.
    #[test]
    fn the_level_in_the_band_ends_at_its_end() {
        let tone = |hz: f64, k: i32| (std::f64::consts::TAU * hz * f64::from(k) / 51_200.0).sin();
        let values = (0..5120).map(|k| 3.0 + tone(9900.0, k) + tone(10_100.0, k));
        let window = TimeSeries::new(0.3, 1.0 / 51_200.0, "m/s^2", values.collect()).unwrap();
        let level = BandLevel::of(&window, 10e3).unwrap();
        assert!((level.rms.powi(2) - 9.5).abs() < 1e-9, "{level:?}");
        let whole = BandLevel::of(&window, 25.6e3).unwrap();
        assert!((whole.rms / window.rms() - 1.0).abs() < 1e-12, "{whole:?}");
    }

    #[test]
    fn lines_that_the_speed_smears_are_left_out() {
        let orders = FaultOrders::new([Some(3.5), Some(5.5), None, None], 0.01).unwrap();
        let kept = |spread_hz: f64| {
            let sharp = sharp_order(spread_hz, 2.0);
            let (lines, smeared) = lines(25.0, &orders, None, sharp).unwrap();
            let kept = lines.iter().map(|line| (line.name().to_owned(), line.harmonics()));
            (kept.collect::<Vec<_>>(), smeared)
        };
        let line = |name: &str, harmonics| (name.to_owned(), harmonics);
        let all = vec![line("shaft", 3), line("outer race", 3), line("inner race", 3)];
        assert_eq!(kept(0.0), (all, false));
        // 0.5 Hz is what 2 s separate: sharp up to the order 0.5 / 0.1
        let some = vec![line("shaft", 3), line("outer race", 1)];
        assert_eq!(kept(0.1), (some, true));
        assert_eq!(kept(0.6), (Vec::new(), true));
    }
}
