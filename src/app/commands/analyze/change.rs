//! A window of a signal beside an earlier signal of the same machine: what grew.

use super::window::{AnalysisSettings, WindowAnalysis, WindowChange, check_speed, stretch};
use crate::app::error::ComputeError;
use crate::formats::MeasuredSignal;
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::report::shaft_speed;
use crate::signal::diagnosis::{
    ChangeConclusion, ComparedSignal, Conclusion, Diagnosis, DiagnosisError, Fault, Kinematics, LineChange,
    NAMED_BELOW, STRONG_CHANGE_DB, level_changes, line_changes, spectrum_end_hz,
};

/// Speeds that differ by more than this part excite resonances differently.
const SAME_SPEED: f64 = 0.05;
/// RMS that changed by more, a factor of a hundred, is in other units.
const ANOTHER_SCALE_DB: f64 = 40.0;
/// Highest order of the spectra that are shown.
const SHOWN_ORDER: f64 = 40.0;

/// An earlier signal, and how its machine moved.
#[derive(Debug)]
pub struct EarlierSignal<'a> {
    /// File or folder, as it was named.
    pub name: &'a str,
    /// The signal.
    pub signal: &'a MeasuredSignal,
    /// The window of it that counts, s; `None`: that of the signal where windows are asked for and it holds them, else all of it.
    pub window: Option<TimeWindow>,
    /// Speed and orders.
    pub kinematics: &'a Kinematics<'a>,
    /// How it is judged by itself.
    pub settings: &'a AnalysisSettings,
}

impl EarlierSignal<'_> {
    /// The window (s) that one of the signal is compared with.
    fn window_for(&self, settings: &AnalysisSettings, window: &WindowAnalysis) -> TimeWindow {
        let series = &self.signal.series;
        let same = TimeWindow { from: window.from, to: window.to };
        let inside = same.check_inside(series.start_s(), series.step_s(), series.values().len()).is_ok();
        let same = Some(same).filter(|_| inside && !settings.windows.is_empty());
        self.window.or(same).unwrap_or_else(|| series.span())
    }
}

impl WindowChange {
    /// Parts, and impacts of no part, of which this is said.
    pub(crate) fn with(&self, conclusion: ChangeConclusion) -> impl Iterator<Item = &LineChange> {
        let lines = self.lines.iter();
        lines.filter(move |line| line.conclusion == conclusion)
    }

    /// Compares what strikes in two judged signals.
    fn compare_impacts(&mut self, now: &ComparedSignal<'_>, then: &ComparedSignal<'_>) -> Result<(), ComputeError> {
        self.speed_hz = then.diagnosis.speed_hz;
        self.lines = line_changes(now, then)?;
        if let Some(band_hz) = shown_band(now.diagnosis, &self.lines) {
            let [now, then] = [now, then].map(|one| one.order_spectrum(band_hz, SHOWN_ORDER));
            self.spectra = Some((band_hz, [now?, then?]));
        }
        let compared = |line: &LineChange| line.conclusion != ChangeConclusion::NotCompared;
        if !self.lines.iter().any(compared)
            && let Some(doubt) = then.diagnosis.speed_doubt()
        {
            self.warnings.push(format!("In the earlier signal {doubt}."));
        }
        let named: Vec<&str> = then.diagnosis.named().map(|verdict| verdict.fault.name()).collect();
        if !named.is_empty() {
            self.warnings.push(format!(
                "The earlier signal indicates a fault by itself: {}. It is no record of a sound bearing.",
                named.join(", ")
            ));
        }
        Ok(())
    }
}

/// Compares the analysed windows of a signal with an earlier signal, and says in the evidence of each verdict what came of it.
///
/// # Errors
/// [`ComputeError::Diagnosis`]: a window outside the earlier signal, a shaft that rests in it. [`ComputeError::Input`]: another unit, a
/// shaft that turns more than once in two samples.
pub fn compare_windows(
    windows: &mut [WindowAnalysis],
    settings: &AnalysisSettings,
    signal: &MeasuredSignal,
    kinematics: &Kinematics<'_>,
    earlier: &EarlierSignal<'_>,
) -> Result<(), ComputeError> {
    let [expected, found] = [signal, earlier.signal].map(|signal| signal.series.unit());
    if !expected.is_empty() && !found.is_empty() && expected != found {
        let what = format!("found {found}, expected {expected} as in the signal that it is compared with");
        return Err(ComputeError::input(what, "scale one of the two signals to the unit of the other"));
    }
    check_speed(earlier.signal, earlier.kinematics)?;
    for window in windows {
        let compared = earlier.window_for(settings, window);
        let mut change = compare_window(window, settings, signal, kinematics, (earlier, compared))?;
        if expected != found {
            let (of, unit) = match found.is_empty() {
                true => (format!("The earlier signal, {},", earlier.name), expected),
                false => ("The signal".to_owned(), found),
            };
            change.warnings.push(format!(
                "{of} states no unit and is compared as if it were in {unit}: in g or m/s^2, levels would be 19.8 dB apart."
            ));
        }
        let apart = compared.to <= window.from || window.to <= compared.from;
        if !apart && signal.series.values() == earlier.signal.series.values() {
            change.warnings.push(format!(
                "The baseline is the input itself or a copy of it, {}, and the windows overlap: nothing can have grown since.",
                earlier.name
            ));
        }
        window.change = Some(change);
    }
    Ok(())
}

fn compare_window(
    window: &mut WindowAnalysis,
    settings: &AnalysisSettings,
    signal: &MeasuredSignal,
    kinematics: &Kinematics<'_>,
    (earlier, compared): (&EarlierSignal<'_>, TimeWindow),
) -> Result<WindowChange, ComputeError> {
    let span = TimeWindow { from: window.from, to: window.to };
    let now = with_margins(&signal.series, span)?;
    let before = with_margins(&earlier.signal.series, compared)?;
    let part = before.window(compared.from, compared.to)?;
    let levels = level_changes((&now, span), (&before, compared))?;
    let mut change = WindowChange {
        baseline: earlier.name.to_owned(),
        channel: earlier.signal.name.clone(),
        from: compared.from,
        to: compared.to,
        speed_hz: earlier.kinematics.mean_speed_hz(compared),
        rms: part.rms(),
        peak: part.peak(),
        kurtosis: part.kurtosis(),
        lines: Vec::new(),
        levels,
        spectra: None,
        warnings: Vec::new(),
    };
    if let Ok(diagnosis) = &window.diagnosis {
        let orders = earlier.kinematics.orders(compared)?;
        let turns = |time| earlier.kinematics.turns(time);
        let good_to_hz = earlier.settings.good_to_hz.or_else(|| spectrum_end_hz(&part));
        let within_hz = window.band.judged_hz(settings.band, good_to_hz);
        match earlier.settings.judge(&before, within_hz, compared, turns, &orders) {
            Ok(found) => {
                let turns_now = |time| kinematics.turns(time);
                let orders_now = kinematics.orders(span)?;
                let now = ComparedSignal::new(&now, span, turns_now, orders_now, diagnosis);
                let then = ComparedSignal::new(&before, compared, turns, orders, &found);
                change.compare_impacts(&now, &then)?;
            }
            // said below
            Err(DiagnosisError::Constant { .. }) => {}
            Err(error @ (DiagnosisError::NoNoise { .. } | DiagnosisError::Repeated { .. })) => change
                .warnings
                .push(format!("No impacts can be compared with the earlier signal, {}: {error}.", change.channel)),
            Err(error) => return Err(error.into()),
        }
    }
    if change.kurtosis.is_none() {
        let channel = &change.channel;
        change.warnings.push(format!("The earlier signal, {channel}, is constant: nothing can be compared with it."));
    }
    let whole_db = change.levels.first().and_then(|level| level.change_db);
    if let Some(db) = whole_db.filter(|db| db.abs() > ANOTHER_SCALE_DB) {
        change.warnings.push(format!(
            "The RMS changed by {db:+.0} dB, which no machine does that still runs: check the units and the gain of both signals."
        ));
    }
    let ratio = change.speed_hz / window.speed_hz;
    let alike = (ratio - 1.0).abs() <= SAME_SPEED && whole_db.is_none_or(|db| db.abs() <= ANOTHER_SCALE_DB);
    if (ratio - 1.0).abs() > SAME_SPEED {
        change.warnings.push(format!(
            "The shaft turned at {} in the earlier signal and turns at {} in this one: resonances are excited differently, and levels change with that.",
            shaft_speed(change.speed_hz, 4),
            shaft_speed(window.speed_hz, 4)
        ));
    }
    if let Ok(diagnosis) = &mut window.diagnosis {
        explain(diagnosis, &change.lines);
        if alike {
            diagnosis.grew = strong_growth(diagnosis, &change.lines, settings);
        }
    }
    Ok(change)
}

/// A window of a series with as much before and after it as it is long, so that its envelope has no edges.
fn with_margins(series: &TimeSeries, window: TimeWindow) -> Result<TimeSeries, ComputeError> {
    stretch(series, window, window.to - window.from)
}

/// Band that is shown: of a part that is indicated, of what grew, of any that was compared.
fn shown_band(diagnosis: &Diagnosis, lines: &[LineChange]) -> Option<[f64; 2]> {
    let named = |line: &LineChange| {
        let mut named = diagnosis.named();
        named.any(|verdict| Some(verdict.fault) == line.fault)
    };
    let compared = || lines.iter().filter(|line| line.order_now.is_some());
    let line = compared()
        .find(|line| named(line))
        .or_else(|| compared().find(|line| line.conclusion == ChangeConclusion::Grew))
        .or_else(|| compared().next());
    line.and_then(|line| line.band_hz)
}

/// The parts whose lines chance does not make and that grew strongly, most first; not those of which a case says that they are sound.
fn strong_growth(diagnosis: &Diagnosis, lines: &[LineChange], settings: &AnalysisSettings) -> Vec<String> {
    let strong = lines.iter().filter_map(|line| {
        let low_db = line.interval_db[0].filter(|db| *db >= STRONG_CHANGE_DB)?;
        let mut faults = diagnosis.faults.iter();
        let verdict = faults.find(|verdict| Some(verdict.fault) == line.fault)?;
        let certain = verdict.false_alarm.is_some_and(|chance| chance < NAMED_BELOW);
        (certain && !settings.is_sound(verdict.fault)).then_some((low_db, line))
    });
    let mut strong: Vec<(f64, &LineChange)> = strong.collect();
    strong.sort_by(|a, b| b.0.total_cmp(&a.0));
    strong.into_iter().map(|(_, line)| format!("{}, {}", line.name, line.words())).collect()
}

/// Adds to the evidence of each verdict what the comparison says of it. The conclusions stay.
fn explain(diagnosis: &mut Diagnosis, lines: &[LineChange]) {
    for verdict in &mut diagnosis.faults {
        let line = lines.iter().find(|line| line.fault == Some(verdict.fault));
        let Some(line) = line else { continue };
        let indicated = verdict.conclusion == Conclusion::Named;
        let words = line.words();
        let unclear = verdict.conclusion == Conclusion::NotEnough;
        let text = match line.conclusion {
            ChangeConclusion::Grew => format!("It grew since the earlier signal: {words}."),
            ChangeConclusion::AsBefore if indicated && verdict.fault == Fault::OuterRace => format!(
                "It was as strong in the earlier signal: {words}. If the bearing was sound then, these are balls that enter the load zone."
            ),
            ChangeConclusion::NotCompared if indicated => {
                format!("It cannot be compared with the earlier signal. {}", line.why)
            }
            _ if !indicated && !unclear => continue,
            ChangeConclusion::AsBefore => format!("It was as strong in the earlier signal: {words}."),
            ChangeConclusion::Fell => format!("It was stronger in the earlier signal: {words}."),
            ChangeConclusion::NotCertain => {
                format!("Whether it grew since the earlier signal is not certain: {words}.")
            }
            ChangeConclusion::NotCompared => continue,
        };
        verdict.why = format!("{} {text}", verdict.why);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::commands::analyze::compute_analysis;
    use crate::bearing::SpeedProfile;
    use crate::numerics::Unwatched;
    use crate::signal::diagnosis::FaultOrders;

    /// Four seconds at 25 Hz with impacts of the outer race of a strength, 1 % apart from even, in noise of 0.05.
    fn signal(strength: f64, mut seed: u64) -> MeasuredSignal {
        let pass_s = 1.0 / (25.0 * 3.57);
        let (mut begun, mut wait) = (0.0, pass_s);
        let value = |k: u32| {
            let t = f64::from(k) / 12e3;
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let noise = (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            if t - begun >= wait {
                begun += wait;
                wait = pass_s * (1.0 + 0.02 * noise);
            }
            let since = t - begun;
            strength * (-800.0 * since).exp() * (std::f64::consts::TAU * 3000.0 * since).sin() + 0.17 * noise
        };
        let series = TimeSeries::new(0.0, 1.0 / 12e3, "m/s^2", (0..48_000).map(value).collect()).unwrap();
        MeasuredSignal { name: "P1".to_owned(), series, speed_hz: None, own_rate_hz: None, doubts: Vec::new() }
    }

    /// What is said of impacts beside weaker ones, each with what its case says of the outer race: sound or not, or nothing.
    fn compared(now: [Option<bool>; 2]) -> (String, Vec<String>) {
        let orders = FaultOrders::new([Some(3.57), Some(5.43), None, None], 0.01).unwrap();
        let kinematics = Kinematics::Given { orders, speed: SpeedProfile::constant(25.0).unwrap() };
        let settings = now.map(|sound| AnalysisSettings {
            no_signs: sound.map(|sound| (Fault::OuterRace, sound, "Known.".to_owned())).into_iter().collect(),
            ..AnalysisSettings::default()
        });
        let [strong, weak] = [signal(20.0, 1), signal(0.5, 2)];
        let analysed = compute_analysis(std::slice::from_ref(&strong), &settings[0], &kinematics, &Unwatched);
        let mut window = analysed.unwrap().remove(0);
        let earlier =
            EarlierSignal { name: "old", signal: &weak, window: None, kinematics: &kinematics, settings: &settings[1] };
        compare_windows(std::slice::from_mut(&mut window), &settings[0], &strong, &kinematics, &earlier).unwrap();
        (window.diagnosis.unwrap().headline(), window.change.unwrap().warnings)
    }

    #[test]
    fn an_earlier_signal_is_judged_as_it_is_alone() {
        let (_, warnings) = compared([None, None]);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].starts_with("The earlier signal indicates a fault by itself: outer race."), "{warnings:?}");
        assert_eq!(compared([None, Some(true)]).1, [""; 0], "its case says that the race is sound");
    }

    #[test]
    fn strong_growth_is_the_headline_where_the_signal_alone_proves_nothing() {
        let headline = |sound| compared([sound, Some(true)]).0;
        assert_eq!(headline(None), "fault indicated: outer race");
        let strong = headline(Some(false));
        assert!(strong.starts_with("strong growth: outer race, +32."), "{strong}");
        assert_eq!(headline(Some(true)), "not enough evidence: outer race");
    }
}
