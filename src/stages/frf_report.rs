//! The report of `plummer frf`.

use super::StageError;
use super::frf::{FrfResult, TransferPath};
use crate::case::Case;
use crate::reduction::frf::FrfQuantity;
use crate::report::{
    Abscissa, Axis, Cell, Column, Curve, Document, Fact, Plot, Report, Section, Table, Verdict,
    significant,
};

/// Modes listed of those that carry a path.
const LISTED: usize = 8;

/// Composes the report; `command` is the line that made it.
///
/// # Errors
/// [`StageError::Frf`].
pub fn frf_report(case: &Case, result: &FrfResult, command: &str) -> Result<Report, StageError> {
    let document = Document::new()
        .case(case.source.path.display().to_string())
        .signed_by("Prepared by")
        .signed_by("Checked by");
    let mut report = Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Transfer paths")
        .document(document);
    let largest = result.compared.iter().map(|compared| compared.difference);
    report = match largest.reduce(f64::max) {
        Some(largest) => report.headline(
            "Largest difference from the full model",
            significant(largest, 2),
            Verdict::of(result.passes()),
        ),
        None => report.headline(
            "Difference from the full model",
            "not computed",
            Verdict::None,
        ),
    };
    report = report.section(model(result));
    for path in &result.paths {
        report = report.section(of_path(result, path)?);
    }
    if !result.compared.is_empty() {
        report = report.section(compared(result));
    }
    if !result.ranking.is_empty() {
        report = report.section(ranking(result));
    }
    if let Some(why) = &result.not_compared {
        report = report.warning(format!("Nothing was compared with the full model: {why}."));
    }
    Ok(report)
}

fn model(result: &FrfResult) -> Section {
    let condensed = &result.stage.condensed;
    let basis = &condensed.basis;
    Section::new("Model").facts([
        Fact::new(
            "Interior degrees of freedom",
            condensed.substructure.interior_dof().to_string(),
        ),
        Fact::new(
            "Interface coordinates",
            condensed.superelement.interface_dof.to_string(),
        ),
        Fact::new(
            "Fixed-interface modes",
            (basis.count() - basis.residual_vectors()).to_string(),
        ),
        Fact::new("Residual vectors", basis.residual_vectors().to_string())
            .note("among them the static response to every force and to a force at every sensor"),
        Fact::new(
            "Frequencies",
            result.response.frequencies_hz().len().to_string(),
        )
        .note("equal steps of the band, and four to the half-power bandwidth of every resonance"),
    ])
}

fn of_path(result: &FrfResult, path: &TransferPath) -> Result<Section, StageError> {
    let (sensor, load) = path.place;
    let all = result.response.frequencies_hz();
    let accelerance = result
        .response
        .path(sensor, load, FrfQuantity::Accelerance)?;
    // at rest there is no acceleration, and no logarithm of it
    let moving = || {
        let pairs = all.iter().zip(&accelerance);
        pairs.filter(|(_, h)| h.norm() > 0.0)
    };
    let curve = |values: Vec<f64>| {
        let hz = moving().map(|(hz, _)| *hz).collect();
        Curve::new("reduced", Abscissa::Points(hz), values)
    };
    let [low, high] = result.band_hz;
    let frequency = || Axis::new("Frequency", "Hz").range(low, high);
    let magnitude = Plot::new(
        "Accelerance, magnitude",
        frequency(),
        Axis::new("Acceleration over force", "1/kg").log(),
    )
    .curve(curve(moving().map(|(_, h)| h.norm()).collect()));
    let phase = Plot::new("Accelerance, phase", frequency(), Axis::new("Phase", "deg"))
        .curve(curve(moving().map(|(_, h)| h.arg().to_degrees()).collect()));
    let mut table = Table::new(
        format!("What carries the path from {} to {}", path.from, path.to),
        [
            Column::number("Mode", ""),
            Column::number("Frequency", "Hz"),
            Column::number("Damping ratio", ""),
            Column::number("Share", "%"),
            Column::number("Alone", "%"),
        ],
    );
    for share in path.shares.modes.iter().take(LISTED) {
        table = table.row([
            Cell::text((share.mode + 1).to_string()),
            Cell::number(share.frequency_hz, 6),
            share
                .ratio
                .map_or_else(|| Cell::text("rigid"), |ratio| Cell::number(ratio, 3)),
            Cell::number(100.0 * share.share, 3),
            Cell::number(100.0 * share.alone, 3),
        ]);
    }
    Ok(Section::new(format!("From {} to {}", path.from, path.to))
        .plot(magnitude)
        .plot(phase)
        .table(table.footnote("Share: integral of Re(conj(H) H_r) over that of |H|^2, receptances over the band; the shares of all modes add up to 100 %, modes that work against each other are above it and below zero. Alone: what the mode would bring without the others.")))
}

fn compared(result: &FrfResult) -> Section {
    let mut columns = vec![Column::number("Frequency", "Hz")];
    for path in &result.paths {
        columns.push(Column::number(
            format!("{} to {}, reduced", path.from, path.to),
            "m/N",
        ));
        columns.push(Column::number(
            format!("{} to {}, full", path.from, path.to),
            "m/N",
        ));
    }
    columns.push(Column::number("Largest difference", ""));
    let mut table = Table::new("Receptance, reduced and full", columns);
    for compared in &result.compared {
        let mut cells = vec![Cell::number(compared.frequency_hz, 6)];
        for (reduced, full) in compared.reduced.iter().zip(&compared.full) {
            cells.push(Cell::number(reduced.norm(), 6));
            cells.push(Cell::number(full.norm(), 6));
        }
        let verdict = Verdict::of(compared.difference <= result.target);
        cells.push(Cell::number(compared.difference, 2).judged(verdict));
        table = table.row(cells);
    }
    let residual = result.compared.iter().map(|compared| compared.residual);
    Section::new("Against the full model")
        .paragraph(format!(
            "Direct solutions of (K - w^2 M + i (w C + K_s)) x = f over all degrees of freedom, with residuals up to {}. The difference is that of complex receptances, phase included; it passes up to {}.",
            significant(residual.fold(0.0, f64::max), 1),
            significant(result.target, 2)
        ))
        .table(table)
}

fn ranking(result: &FrfResult) -> Section {
    let [low, high] = result.band_hz;
    let mut section = Section::new("Which variant transmits least").paragraph(format!(
        "Energy mean of the accelerance from {low:.0} to {high:.0} Hz, the quietest first."
    ));
    for ranked in &result.ranking {
        let path = &result.paths[ranked.path];
        let mut table = Table::new(
            format!("From {} to {}", path.from, path.to),
            [
                Column::text("Variant"),
                Column::number("Level", "dB re 1/kg"),
                Column::number("Above the quietest", "dB"),
            ],
        );
        for variant in &ranked.variants {
            table = table.row([
                Cell::text(&variant.name),
                Cell::number(variant.mean_db, 5),
                Cell::number(variant.above_quietest_db, 4),
            ]);
        }
        section = section.table(table);
    }
    section
}
