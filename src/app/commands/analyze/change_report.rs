//! What a report says of a window beside an earlier signal, and the curve of an envelope's lines over orders.

use super::window::{WindowAnalysis, WindowChange};
use crate::report::{Abscissa, Axis, Cell, Column, Curve, Marker, Plot, Report, Section, Table, Verdict, significant};
use crate::signal::diagnosis::{ChangeConclusion, EnvelopeOrderSpectrum, change_words};

/// What grew in each window, on top of a report, and what makes a comparison doubtful.
pub(crate) fn change_headlines(mut report: Report, windows: &[WindowAnalysis]) -> Report {
    for window in windows {
        let Some(change) = &window.change else {
            continue;
        };
        for line in change.with(ChangeConclusion::Grew) {
            let what = format!("{} since {}", line.name, change.baseline);
            report = report.headline(what, line.words(), Verdict::None);
        }
        for text in &change.warnings {
            if !report.warnings.contains(text) {
                report = report.warning(text.clone());
            }
        }
    }
    report
}

/// Tables and plot of a window's change.
pub(crate) fn change_section(mut section: Section, window: &WindowAnalysis) -> Section {
    let Some(change) = &window.change else {
        return section;
    };
    section = section.table(line_table(window, change));
    if let Some((band_hz, spectra)) = &change.spectra {
        section = section.plot(change_plot(window, *band_hz, spectra));
    }
    section.table(level_table(window, change))
}

fn judged(conclusion: ChangeConclusion) -> Cell {
    let verdict = match conclusion {
        ChangeConclusion::Grew => Verdict::Bad,
        _ => Verdict::None,
    };
    Cell::text(conclusion.words()).judged(verdict)
}

fn line_table(window: &WindowAnalysis, change: &WindowChange) -> Table {
    let columns = [
        Column::text("Part"),
        Column::text("Change"),
        Column::text("95 % interval"),
        Column::number("Level, earlier", &window.unit),
        Column::number("Level, now", &window.unit),
        Column::number("Its band as a whole", "dB"),
        Column::text("Band"),
        Column::number("Order, earlier", ""),
        Column::number("Order, now", ""),
        Column::text("How it was compared, and why not"),
    ];
    Table::new(format!("What grew since {}", change.baseline), columns).rows(change.lines.iter().map(|line| {
        let band = line.band_hz.map(|[from, to]| format!("{} to {} Hz", significant(from, 4), significant(to, 4)));
        [
            Cell::text(&line.name),
            judged(line.conclusion),
            Cell::text(line.words()),
            Cell::number_or(line.earlier, 3, ""),
            Cell::number_or(line.now, 3, ""),
            Cell::number_or(line.band_change_db, 3, ""),
            Cell::text(band.unwrap_or_default()),
            Cell::number_or(line.order_earlier, 5, ""),
            Cell::number_or(line.order_now, 5, ""),
            Cell::text(&line.why),
        ]
    }))
}

fn level_table(window: &WindowAnalysis, change: &WindowChange) -> Table {
    let columns = [
        Column::text("What"),
        Column::number("Earlier", &window.unit),
        Column::number("Now", &window.unit),
        Column::text("Change"),
        Column::text("95 % interval"),
    ];
    let levels = change.levels.iter().map(|level| {
        let what = match level.centre_hz {
            Some(hz) => format!("octave about {} Hz", significant(hz, 3)),
            None => "the whole signal".to_owned(),
        };
        [
            Cell::text(what),
            Cell::number(level.earlier, 3),
            Cell::number(level.now, 3),
            judged(level.conclusion),
            Cell::text(change_words(level.change_db, level.interval_db)),
        ]
    });
    let plain = |what: &str, earlier: Option<f64>, now: Option<f64>| {
        let ratio = earlier.zip(now).filter(|(earlier, _)| *earlier > 0.0);
        let ratio = ratio.map(|(earlier, now)| format!("{} times", significant(now / earlier, 3)));
        let [earlier, now] = [earlier, now].map(|value| Cell::number_or(value, 3, ""));
        [Cell::text(what), earlier, now, Cell::text(ratio.unwrap_or_default()), Cell::text("")]
    };
    Table::new("RMS, earlier and now", columns)
        .rows(levels)
        .row(plain("peak", Some(change.peak), Some(window.peak)))
        .row(plain("kurtosis (no unit)", change.kurtosis, window.kurtosis))
}

fn change_plot(
    window: &WindowAnalysis,
    [from_hz, to_hz]: [f64; 2],
    [now, earlier]: &[EnvelopeOrderSpectrum; 2],
) -> Plot {
    let mut plot = Plot::new(
        format!(
            "Envelope of {} to {} Hz over the shaft's angle, earlier and now, {}",
            significant(from_hz, 4),
            significant(to_hz, 4),
            window.sensor
        ),
        Axis::new("Order", "").range(0.0, last_order(now)),
        Axis::new("Amplitude", &now.unit),
    )
    .curve(order_curve("now", now))
    .curve(order_curve("earlier", earlier))
    .caption("The band of the signals as they are, not whitened. Amplitudes of noise fall with the length of a window; those of lines do not.")
    .marker(Marker::new(1.0, "shaft").family(0));
    let faults = window.diagnosis.iter().flat_map(|found| &found.faults);
    for (family, verdict) in (1..).zip(faults) {
        let order = verdict.order.unwrap_or(verdict.expected_order);
        plot = plot.marker(Marker::new(order, verdict.fault.name()).family(family));
    }
    plot
}

/// Points of an order spectrum that are drawn.
const DRAWN_POINTS: usize = 20_000;

/// Highest order that is drawn: three harmonics of usual races.
const DRAWN_ORDERS: f64 = 16.0;

/// An order spectrum as it is drawn: of a long window, so many neighbours' largest each, so that no line is lost.
pub(crate) fn order_curve(name: &str, spectrum: &EnvelopeOrderSpectrum) -> Curve {
    let step = spectrum.order.get(1).copied().unwrap_or(1.0);
    let count = ((last_order(spectrum) / step) as usize + 1).min(spectrum.amplitude.len());
    let group = count.div_ceil(DRAWN_POINTS).max(1);
    let largest = |group: &[f64]| group.iter().fold(0.0_f64, |most, &value| most.max(value));
    let drawn = spectrum.amplitude[..count].chunks(group).map(largest).collect();
    Curve::new(name, Abscissa::Even { start: 0.5 * (group - 1) as f64 * step, step: group as f64 * step }, drawn)
}

/// Where the drawing of an order spectrum ends.
pub(crate) fn last_order(spectrum: &EnvelopeOrderSpectrum) -> f64 {
    spectrum.order.last().map_or(DRAWN_ORDERS, |last| last.min(DRAWN_ORDERS))
}
