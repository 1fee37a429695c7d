//! What a report says of an analysed window, and the report of `plummer analyze`.

use super::band_search_report::{band_facts, kurtogram_plot};
use super::change_report::{change_headlines, change_section, last_order, order_curve};
use super::window::WindowAnalysis;
use crate::report::{
    Axis, Cell, Column, Curve, CurveStyle, Fact, Family, Marker, Plot, Report, Section, Table, Verdict, significant,
};
use crate::signal::diagnosis::{Conclusion, Diagnosis, Fault, FaultVerdict, NAMED_BELOW, SpeedSource};

/// Composes the report of signals from files; `source` is the file or folder, `command` the line that made it.
pub(crate) fn analysis_report(
    source: &str,
    assumptions: &[String],
    windows: &[WindowAnalysis],
    command: &str,
) -> Report {
    let mut report = Report::new(source, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Diagnosis of a ball bearing by its vibration signal");
    report = verdict_headlines(report, windows);
    report = change_headlines(report, windows);
    for window in windows {
        if let Err(reason) = &window.diagnosis {
            report = report.warning(format!("{}: no verdict: {reason}", window.sensor));
        }
        report = report.section(window_section(window));
    }
    for text in assumptions {
        report = report.assumption(text.clone());
    }
    report
}

/// The verdict on each window, on top of a report.
pub(crate) fn verdict_headlines(mut report: Report, windows: &[WindowAnalysis]) -> Report {
    for window in windows {
        if let Ok(diagnosis) = &window.diagnosis {
            let named: Vec<&str> = diagnosis.named().map(|v| v.fault.name()).collect();
            let text = match (named.is_empty(), diagnosis.is_judged(), diagnosis.unexplained.first()) {
                (false, ..) => format!("fault indicated: {}", named.join(", ")),
                (true, _, Some(impacts)) => format!(
                    "impacts at {} Hz belong to no part: check bearing and speed",
                    significant(impacts.frequency_hz, 4)
                ),
                (true, true, None) => match uncertain(diagnosis).as_slice() {
                    [] if diagnosis.speed_doubt().is_some() => {
                        "no fault indicated at this speed, which is doubtful".to_owned()
                    }
                    [] => "no fault indicated".to_owned(),
                    parts => format!("not enough evidence: {}", parts.join(", ")),
                },
                (true, false, None) => "too short for a verdict".to_owned(),
            };
            let names = |faults: Vec<Fault>| {
                let names = faults.into_iter().map(Fault::name);
                names.collect::<Vec<_>>().join(", ")
            };
            let not_judged: Vec<Fault> = diagnosis.not_judged().map(|v| v.fault).collect();
            let mut text = text;
            if diagnosis.is_judged() && !not_judged.is_empty() {
                text = format!("{text}; not judged: {}", names(not_judged));
            }
            if !diagnosis.by_signal_alone.is_empty() {
                let alone = names(diagnosis.by_signal_alone.clone());
                text = format!("{text}; by the signal alone: {alone}");
            }
            let what = format!("{}, {}-{} s", window.sensor, round(window.from), round(window.to));
            report = report.headline(what, text, Verdict::None);
        }
    }
    report
}

/// Parts whose lines chance does not make, and that are not indicated.
fn uncertain(diagnosis: &Diagnosis) -> Vec<&'static str> {
    let faults = diagnosis.faults.iter();
    let uncertain = faults.filter(|verdict| {
        verdict.conclusion == Conclusion::NotEnough && verdict.false_alarm.is_some_and(|p| p < NAMED_BELOW)
    });
    uncertain.map(|verdict| verdict.fault.name()).collect()
}

/// With a capital first letter.
pub(crate) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

fn round(time: f64) -> String {
    significant(time, 4)
}

/// All about a window.
pub(crate) fn window_section(window: &WindowAnalysis) -> Section {
    let amount = |value: f64| format!("{} {}", significant(value, 3), window.unit);
    let mut section = Section::new(format!("{}, {}-{} s", window.sensor, round(window.from), round(window.to)));
    if let Ok(diagnosis) = &window.diagnosis {
        section = section.table(verdict_table(diagnosis));
        section = change_section(section, window);
        section = section.plot(order_plot(window, diagnosis));
    } else {
        section = change_section(section, window);
    }
    let facts = [
        speed_fact(window),
        Fact::new("RMS", amount(window.rms)),
        Fact::new("Peak", amount(window.peak)),
        Fact::new("Kurtosis", window.kurtosis.map_or_else(|| "none".to_owned(), |value| significant(value, 4)))
            .note("3 for a normal distribution"),
        Fact::new(
            "Window",
            format!(
                "{} s: separates {} Hz",
                significant(window.to - window.from, 3),
                significant(window.spectrum.resolution_hz, 3)
            ),
        )
        .note(format!(
            "zero-padded {} times, which draws finer and separates no more",
            significant(window.spectrum.zero_padding, 3)
        )),
    ];
    section = section
        .plot(envelope_plot(window))
        .plot(time_plot(window))
        .facts(facts.into_iter().chain(band_facts(&window.band)))
        .table(peak_table(window));
    if let Some(text) = smeared(window) {
        section = section.paragraph(text);
    }
    if let Some(search) = window.band.found() {
        section = section.plot(kurtogram_plot(&window.sensor, search));
    }
    match &window.diagnosis {
        Ok(diagnosis) => section.table(harmonic_table(diagnosis)),
        Err(reason) => section.paragraph(format!("No verdict: {reason}.")),
    }
}

/// The mean speed that the verdict rests on, and what shows it.
fn speed_fact(window: &WindowAnalysis) -> Fact {
    let name = "Mean shaft speed";
    let hz = |speed_hz: f64| format!("{} Hz", significant(speed_hz, 5));
    let Ok(diagnosis) = &window.diagnosis else {
        return Fact::new(name, hz(window.speed_hz));
    };
    let shown = match diagnosis.speed_source {
        SpeedSource::Sharpened | SpeedSource::EverySecond | SpeedSource::EvenOnly | SpeedSource::Races => {
            format!("; given: {}", hz(diagnosis.given_speed_hz))
        }
        SpeedSource::Exact | SpeedSource::Given => String::new(),
    };
    Fact::new(name, hz(diagnosis.speed_hz)).note(format!(
        "{}, to {} %{shown}",
        diagnosis.speed_source.words(),
        significant(100.0 * diagnosis.speed_error, 1)
    ))
}

fn time_plot(window: &WindowAnalysis) -> Plot {
    let plot = Plot::new(
        format!("{} and its envelope", window.sensor),
        Axis::new("Time", "s"),
        Axis::new("Amplitude", &window.unit),
    );
    let [signal, envelope] = window.shown.clone();
    plot.curve(signal).curve(envelope)
}

fn order_plot(window: &WindowAnalysis, diagnosis: &Diagnosis) -> Plot {
    let spectrum = &diagnosis.spectrum;
    let mut plot = Plot::new(
        format!(
            "{} over the shaft's angle, {}, {}-{} s",
            capital(&diagnosis.envelope),
            window.sensor,
            round(window.from),
            round(window.to)
        ),
        Axis::new("Order", "").range(0.0, last_order(spectrum)),
        Axis::new("Amplitude", &spectrum.unit),
    )
    .curve(order_curve("envelope", spectrum))
    .caption("Order: events per shaft turn; a speed that changes smears nothing here. Marked: the shaft and the lines of each part.");
    plot = plot.marker(Marker::new(1.0, "shaft").family(0));
    for family in families(diagnosis, 1.0) {
        plot = plot.family(family);
    }
    for (family, verdict) in (1..).zip(&diagnosis.faults) {
        let order = place(verdict);
        let name = verdict.fault.name();
        plot = plot.marker(Marker::new(order, name).family(family));
        // where a part was not found its harmonics would only cover others
        let found = verdict.harmonics.iter().filter(|h| h.side == 0);
        for harmonic in found.skip(1).filter(|_| verdict.order.is_some()) {
            if harmonic.order < last_order(spectrum) {
                let label = format!("{}x {name}", harmonic.harmonic);
                plot = plot.marker(Marker::new(harmonic.order, label).family(family));
            }
        }
    }
    plot
}

/// Order of a part's line: where it was found, else where it is expected.
fn place(verdict: &FaultVerdict) -> f64 {
    verdict.order.unwrap_or(verdict.expected_order)
}

/// The shaft's and the parts' lines for a plot whose x axis is the order times `scale`.
fn families(diagnosis: &Diagnosis, scale: f64) -> Vec<Family> {
    let of = |(family, verdict): (usize, &FaultVerdict)| {
        let line = Family::new(verdict.fault.name(), place(verdict) * scale, family);
        match (verdict.fault, verdict.side_spacing) {
            (Fault::Ball, Some(spacing)) => line.sides("cage", spacing * scale),
            (_, Some(spacing)) => line.sides("shaft", spacing * scale),
            (_, None) => line,
        }
    };
    let shaft = Family::new("shaft", scale, 0);
    std::iter::once(shaft).chain((1..).zip(&diagnosis.faults).map(of)).collect()
}

fn verdict_table(diagnosis: &Diagnosis) -> Table {
    let mut table = Table::new(
        "Verdict",
        [
            Column::text("Part"),
            Column::text("Verdict"),
            Column::number("Probability by chance", ""),
            Column::number("Order, expected", ""),
            Column::number("Order, found", ""),
            Column::number("Line", "Hz"),
            Column::text("Evidence, and why not more"),
        ],
    );
    let number = |value: Option<f64>, digits| value.map_or_else(|| Cell::text(""), |value| Cell::number(value, digits));
    for verdict in &diagnosis.faults {
        let judged = match verdict.conclusion {
            Conclusion::Named => Verdict::Bad,
            Conclusion::NotEnough | Conclusion::NotSeen => Verdict::None,
        };
        table = table.row([
            Cell::text(format!("{} ({})", verdict.fault.name(), verdict.fault.line())),
            Cell::text(verdict.conclusion.words()).judged(judged),
            number(verdict.false_alarm, 2),
            Cell::number(verdict.expected_order, 5),
            number(verdict.order, 5),
            number(verdict.frequency_hz, 4),
            Cell::text(verdict.why.clone()),
        ]);
    }
    for impacts in &diagnosis.unexplained {
        table = table.row([
            Cell::text("none of these"),
            Cell::text("impacts").judged(Verdict::Bad),
            Cell::number(impacts.false_alarm, 2),
            Cell::text(""),
            Cell::number(impacts.order, 5),
            Cell::number(impacts.frequency_hz, 4),
            Cell::text(format!(
                "{} harmonics stand out. These impacts belong to no part of this bearing: check bearing and speed, and what else turns.",
                impacts.harmonics_seen
            )),
        ]);
    }
    table
}

fn harmonic_table(diagnosis: &Diagnosis) -> Table {
    let mut table = Table::new(
        "Harmonics",
        [
            Column::text("Line"),
            Column::number("Order", ""),
            Column::number("Frequency", "Hz"),
            Column::number("Of the mean envelope", "%"),
            Column::number("Above the floor", "dB"),
            Column::text("Remark"),
        ],
    );
    let harmonics = diagnosis.faults.iter().flat_map(|verdict: &FaultVerdict| {
        let cage = verdict.cage_lines.iter();
        verdict.harmonics.iter().chain(cage.flat_map(|lines| &lines.harmonics))
    });
    for harmonic in harmonics {
        let remark = match &harmonic.coincides_with {
            Some(other) => format!("coincides with {other}: does not count"),
            None if harmonic.seen => "stands out".to_owned(),
            None => String::new(),
        };
        table = table.row([
            Cell::text(harmonic.name.clone()),
            Cell::number(harmonic.order, 5),
            Cell::number(harmonic.frequency_hz, 4),
            Cell::number(100.0 * harmonic.depth, 2),
            Cell::number(harmonic.above_floor_db, 3),
            Cell::text(remark),
        ]);
    }
    table
}

fn envelope_plot(window: &WindowAnalysis) -> Plot {
    let top = 14.0 * window.speed_hz;
    let mut plot = Plot::new(
        format!(
            "{} of {}, {}-{} s",
            if window.whitened { "Squared envelope spectrum, whitened," } else { "Envelope spectrum" },
            window.sensor,
            round(window.from),
            round(window.to)
        ),
        Axis::new("Frequency", "Hz").range(0.0, top.max(1.0)),
        Axis::new("Amplitude", &window.spectrum.unit),
    )
    .curve(
        Curve::of_spectrum("envelope", &window.spectrum.frequency_hz, &window.spectrum.amplitude)
            .within(0.0, top.max(1.0))
            .style(CurveStyle::Line),
    );
    match smeared(window) {
        Some(text) => plot = plot.caption(text),
        None => {
            let diagnosis = window.diagnosis.iter();
            for family in diagnosis.flat_map(|found| families(found, window.speed_hz)) {
                plot = plot.family(family);
            }
        }
    }
    for (family, line) in window.lines.iter().enumerate() {
        for harmonic in 1..=line.harmonics() {
            let at = f64::from(harmonic) * line.frequency_hz();
            if at < top {
                let label = if harmonic == 1 { line.name().to_owned() } else { format!("{harmonic}x {}", line.name()) };
                plot = plot.marker(Marker::new(at, label).family(family));
            }
        }
    }
    plot
}

/// Why lines over Hz are not compared with peaks, if the speed changes too much for it.
fn smeared(window: &WindowAnalysis) -> Option<String> {
    let order = window.smeared_above?;
    let what =
        if order < 1.0 { "all lines".to_owned() } else { format!("lines above the order {}", significant(order, 3)) };
    Some(format!(
        "The speed changes in this window and smears {what} over Hz: peaks are not compared with them. The order spectrum and the table of harmonics compare orders instead."
    ))
}

fn peak_table(window: &WindowAnalysis) -> Table {
    let mut peaks = Table::new(
        "Strongest peaks",
        [
            Column::number("Frequency", "Hz"),
            Column::number("Amplitude", &window.spectrum.unit),
            Column::number("Above the median within 5 / T", "dB"),
            Column::text("Line"),
            Column::number("Expected", "Hz"),
            Column::number("Deviation", "%"),
        ],
    );
    for peak in &window.peaks {
        let named = peak.line.as_ref().filter(|_| !peak.labels.is_empty());
        let (name, expected, deviation) = match named {
            Some(line) => (
                peak.labels.join(", "),
                Cell::number(line.expected_hz, 4),
                Cell::text(format!("{:+.1}", 100.0 * line.deviation)).value(100.0 * line.deviation),
            ),
            None => ("–".to_owned(), Cell::text(""), Cell::text("")),
        };
        peaks = peaks.row([
            Cell::number(peak.frequency_hz, 4),
            Cell::number(peak.amplitude, 3),
            Cell::number(peak.above_median_db, 3),
            Cell::text(name),
            expected,
            deviation,
        ]);
    }
    peaks
}
