//! What a report says of an analysed window, and the report of `plummer analyze`.

use super::band_search::{band_facts, kurtogram_plot};
use super::change_report::{change_headlines, change_section, last_order, order_curve};
use super::window::WindowAnalysis;
use crate::report::{
    Axis, Block, Cell, Column, Curve, CurveStyle, Fact, Family, Marker, Plot, Report, Section, Table, Verdict, given,
    shaft_speed, signed_fixed, significant,
};
use crate::signal::diagnosis::{Conclusion, Diagnosis, Fault, FaultVerdict, SpeedSource};

/// Composes the report of signals from files; `source` is the file or folder, `inputs` says in words what was analysed, `truth` what is
/// known to be there and not shown, `command` is the line that made it.
pub(crate) fn analysis_report(
    source: &str,
    inputs: Section,
    windows: &[WindowAnalysis],
    truth: impl Fn(&WindowAnalysis) -> Option<String>,
    command: &str,
) -> Report {
    let report = Report::new(source, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Diagnosis of a ball bearing by its vibration signal");
    let mut report = change_headlines(verdict_headlines(report, windows, truth), windows).section(inputs);
    report.warnings.extend(windows.iter().filter_map(|window| {
        let words = match &window.diagnosis {
            Err(reason) => format!("no verdict: {reason}"),
            Ok(diagnosis) => diagnosis.speed_doubt()?,
        };
        Some(format!("{}: {words}", window.sensor))
    }));
    report.sections.extend(windows.iter().map(window_section));
    report
}

/// The verdict on each window, on top of a report; `truth` says what is known to be there and not shown.
pub(crate) fn verdict_headlines(
    mut report: Report,
    windows: &[WindowAnalysis],
    truth: impl Fn(&WindowAnalysis) -> Option<String>,
) -> Report {
    for window in windows {
        let Ok(diagnosis) = &window.diagnosis else { continue };
        let missed = truth(window).map_or_else(String::new, |missed| format!("{}. ", capital(&missed)));
        let note = missed + &diagnosis.reason();
        report = report.headline(place_and_time(window), diagnosis.headline(), Verdict::None).note(note);
    }
    report
}

/// The same on a terminal, with the table of the parts.
pub(crate) fn verdict_lines(window: &WindowAnalysis, truth: impl Fn(&WindowAnalysis) -> Option<String>) -> Vec<String> {
    let place = format!("{} from {} to {} s", window.place(), given(window.from), given(window.to));
    let diagnosis = match &window.diagnosis {
        Ok(diagnosis) => diagnosis,
        Err(reason) => return vec![format!("{place}: no verdict: {reason}")],
    };
    let mut lines = vec![format!(
        "{place} (shaft {} Hz, {} rpm, {} turns): {}",
        significant(diagnosis.speed_hz, 4),
        significant(60.0 * diagnosis.speed_hz, 4),
        significant(diagnosis.spectrum.turns, 3),
        diagnosis.headline()
    )];
    let doubts = window.doubts().into_iter().map(|doubt| format!("warning: {doubt}"));
    let said = [Some(diagnosis.reason()), truth(window)].into_iter().flatten().chain(doubts);
    lines.extend(said.map(|text| format!("  {text}")));
    let table = verdict_table(diagnosis, "Reason", |verdict| &verdict.reason).plain();
    lines.extend(table.lines().skip(1).map(str::to_owned));
    lines
}

/// With a capital first letter.
pub(crate) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

/// Sensor and window of time.
fn place_and_time(window: &WindowAnalysis) -> String {
    format!("{}, {} to {} s", window.place(), given(window.from), given(window.to))
}

/// All about a window.
pub(crate) fn window_section(window: &WindowAnalysis) -> Section {
    let amount = |value: f64| format!("{} {}", significant(value, 3), window.unit);
    let diagnosis = window.diagnosis.as_ref();
    let mut section = Section::new(place_and_time(window));
    section.blocks.extend(
        diagnosis
            .ok()
            .map(|found| Block::Table(verdict_table(found, "Evidence, and why not more", |verdict| &verdict.why))),
    );
    section = change_section(section, window);
    section.blocks.extend(diagnosis.ok().map(|found| Block::Plot(Box::new(order_plot(window, found)))));
    let facts = [
        speed_fact(window),
        match window.rms_in_band.and_then(|level| level.beside(window.rms, &window.unit)) {
            Some(text) => Fact::new("RMS", amount(window.rms)).note(text),
            None => Fact::new("RMS", amount(window.rms)),
        },
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
    let title = format!("{} and its envelope", window.sensor);
    let [signal, envelope] = window.shown.clone();
    section = section
        .plot(envelope_plot(window))
        .plot(
            Plot::new(title, Axis::new("Time", "s"), Axis::new("Amplitude", &window.unit))
                .curve(signal)
                .curve(envelope)
                .caption("The filtered signal and its envelope. Each impact is a burst that dies away; damage strikes at equal distances."),
        )
        .facts(facts.into_iter().chain(band_facts(&window.band)))
        .table(peak_table(window));
    if let Some(text) = smeared(window) {
        section = section.paragraph(text);
    }
    if let Some(search) = window.band.found() {
        section = section.plot(kurtogram_plot(&window.sensor, search));
    }
    match diagnosis {
        Ok(diagnosis) => section.table(harmonic_table(diagnosis)),
        Err(reason) => section.paragraph(format!("No verdict: {reason}.")),
    }
}

/// The mean speed that the verdict rests on, and what shows it.
fn speed_fact(window: &WindowAnalysis) -> Fact {
    let name = "Mean shaft speed";
    let hz = |speed_hz: f64| shaft_speed(speed_hz, 5);
    let Ok(diagnosis) = &window.diagnosis else {
        return Fact::new(name, hz(window.speed_hz));
    };
    let shown = match diagnosis.speed_source {
        SpeedSource::Sharpened | SpeedSource::EverySecond | SpeedSource::EvenOnly | SpeedSource::Races => {
            format!("; given: {}", hz(diagnosis.given_speed_hz))
        }
        SpeedSource::Exact | SpeedSource::Given => String::new(),
    };
    let words = diagnosis.speed_source.words();
    let error = Some(100.0 * diagnosis.speed_error).filter(|percent| *percent > 0.0);
    let error = error.map_or_else(String::new, |percent| format!(", to {} %", significant(percent, 1)));
    Fact::new(name, hz(diagnosis.speed_hz)).note(format!("{words}{error}{shown}"))
}

fn order_plot(window: &WindowAnalysis, diagnosis: &Diagnosis) -> Plot {
    let spectrum = &diagnosis.spectrum;
    let mut plot = Plot::new(
        format!("{} over the shaft's angle, {}", capital(&diagnosis.envelope), place_and_time(window)),
        Axis::new("Order", "").range(0.0, last_order(spectrum)),
        Axis::new("Amplitude", &spectrum.unit),
    )
    .curve(order_curve("envelope", spectrum))
    .caption("Spectrum of the envelope over the shaft's angle. An order counts events per shaft turn, so that a speed that changes smears nothing. Damage of a part shows as a row of lines at its mark and the multiples.")
    .marker(Marker::new(1.0, "shaft").family(0));
    plot.families = families(diagnosis, 1.0);
    for (family, verdict) in (1..).zip(&diagnosis.faults) {
        let name = verdict.fault.name();
        plot = plot.marker(Marker::new(place(verdict), name).family(family));
        // where a part was not found its harmonics would only cover others
        let found = verdict.harmonics.iter().filter(|h| h.side == 0 && verdict.order.is_some()).skip(1);
        let shown = found.filter(|harmonic| harmonic.order < last_order(spectrum));
        plot.markers.extend(
            shown.map(|harmonic| Marker::new(harmonic.order, format!("{}x {name}", harmonic.harmonic)).family(family)),
        );
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

/// A row a part; the last column, of this name, says why.
fn verdict_table(diagnosis: &Diagnosis, last: &str, why: fn(&FaultVerdict) -> &String) -> Table {
    let columns = [
        Column::text("Part"),
        Column::text("Verdict"),
        Column::number("Probability by chance", ""),
        Column::number("Strength", "dB"),
        Column::number("Order, expected", ""),
        Column::number("Order, found", ""),
        Column::number("Line", "Hz"),
        Column::text(last),
    ];
    let parts = diagnosis.faults.iter().map(|verdict| {
        let judged = if verdict.conclusion == Conclusion::Named { Verdict::Bad } else { Verdict::None };
        [
            Cell::text(format!("{} ({})", verdict.fault.name(), verdict.fault.line())),
            Cell::text(verdict.conclusion.words()).judged(judged),
            Cell::number_or(verdict.false_alarm, 2, ""),
            Cell::number_or(verdict.strength_db.filter(|_| verdict.order.is_some()), 2, ""),
            Cell::number(verdict.expected_order, 5),
            Cell::number_or(verdict.order, 5, ""),
            Cell::number_or(verdict.frequency_hz, 4, ""),
            Cell::text(why(verdict)),
        ]
    });
    let unexplained = diagnosis.unexplained.iter().map(|impacts| {
        [
            Cell::text("none of these"),
            Cell::text("impacts").judged(Verdict::Bad),
            Cell::number(impacts.false_alarm, 2),
            Cell::number_or(impacts.strength_db, 2, ""),
            Cell::text(""),
            Cell::number(impacts.order, 5),
            Cell::number(impacts.frequency_hz, 4),
            Cell::text(format!(
                "{} harmonics stand out. These impacts belong to no part of this bearing: check bearing and speed, and what else turns.",
                impacts.harmonics_seen
            )),
        ]
    });
    Table::new("Verdict", columns).rows(parts.chain(unexplained))
}

fn harmonic_table(diagnosis: &Diagnosis) -> Table {
    let columns = [
        Column::text("Line"),
        Column::number("Order", ""),
        Column::number("Frequency", "Hz"),
        Column::number("Of the mean envelope", "%"),
        Column::number("Above the floor", "dB"),
        Column::text("Remark"),
    ];
    let seen = diagnosis.faults.iter().filter(|verdict| verdict.conclusion != Conclusion::NotSeen);
    let harmonics = seen.flat_map(|verdict| {
        let cage = verdict.cage_lines.iter();
        verdict.harmonics.iter().chain(cage.flat_map(|lines| &lines.harmonics))
    });
    Table::new("Harmonics", columns).rows(harmonics.map(|harmonic| {
        let remark = match &harmonic.coincides_with {
            Some(other) => format!("coincides with {other}: does not count"),
            None if harmonic.seen => "stands out".to_owned(),
            None => String::new(),
        };
        [
            Cell::text(&harmonic.name),
            Cell::number(harmonic.order, 5),
            Cell::number(harmonic.frequency_hz, 4),
            Cell::number(100.0 * harmonic.depth, 2),
            Cell::number(harmonic.above_floor_db, 3),
            Cell::text(remark),
        ]
    }))
}

fn envelope_plot(window: &WindowAnalysis) -> Plot {
    let top = 14.0 * window.speed_hz;
    let what = if window.whitened { "Squared envelope spectrum, whitened," } else { "Envelope spectrum" };
    let mut plot = Plot::new(
        format!("{what} of {}", place_and_time(window)),
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
            plot = plot.caption(
                "Spectrum of the envelope: how often impacts come back. Damage shows as a row of equally spaced lines at one of the marked frequencies.",
            );
            plot.families.extend(window.diagnosis.iter().flat_map(|found| families(found, window.speed_hz)));
        }
    }
    for (family, line) in window.lines.iter().enumerate() {
        let harmonics = (1..=line.harmonics()).map(|harmonic| (harmonic, f64::from(harmonic) * line.frequency_hz()));
        plot.markers.extend(harmonics.filter(|(_, at)| *at < top).map(|(harmonic, at)| {
            let times = if harmonic == 1 { String::new() } else { format!("{harmonic}x ") };
            Marker::new(at, format!("{times}{}", line.name())).family(family)
        }));
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
    let columns = [
        Column::number("Frequency", "Hz"),
        Column::number("Amplitude", &window.spectrum.unit),
        Column::number("Above the median within 5 / T", "dB"),
        Column::text("Line"),
        Column::number("Expected", "Hz"),
        Column::number("Deviation", "%"),
    ];
    Table::new("Strongest peaks", columns).rows(window.peaks.iter().map(|peak| {
        let named = peak.line.as_ref().filter(|_| !peak.labels.is_empty());
        let deviation = |deviation: f64| Cell::text(signed_fixed(100.0 * deviation, 1)).value(100.0 * deviation);
        [
            Cell::number(peak.frequency_hz, 4),
            Cell::number(peak.amplitude, 3),
            Cell::number(peak.above_median_db, 3),
            Cell::text(named.map_or_else(|| "–".to_owned(), |_| peak.labels.join(", "))),
            Cell::number_or(named.map(|line| line.expected_hz), 4, ""),
            named.map_or_else(|| Cell::text(""), |line| deviation(line.deviation)),
        ]
    }))
}
