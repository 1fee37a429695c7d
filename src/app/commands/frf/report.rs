//! The report of `plummer frf`.

use super::compute::FrfResult;
use super::full::FullDamping;
use super::reduced::{FrfHousing, TransferPath};
use crate::app::case::{Case, Purpose};
use crate::app::commands::computed::Computed;
use crate::app::commands::parts::{self, HousingSize, signed_report};
use crate::app::error::ComputeError;
use crate::fe::reduction::ResponseEstimate;
use crate::fe::reduction::frf::FrfQuantity;
use crate::report::{
    Abscissa, Axis, Cell, Column, Curve, CurveStyle, Fact, Plot, Report, Section, Table, Verdict, significant,
};
use faer::c64;

/// Modes listed of those that carry a path.
const LISTED: usize = 8;

impl Computed for FrfResult {
    fn report(&self, case: &Case, command: &str) -> Result<Report, ComputeError> {
        frf_report(case, self, command)
    }
}

/// Composes the report; `command` is the line that made it.
///
/// # Errors
/// [`ComputeError::Frf`].
pub(crate) fn frf_report(case: &Case, result: &FrfResult, command: &str) -> Result<Report, ComputeError> {
    let mut report = signed_report(case, command, "Transfer paths");
    let judged = |report: Report, what: &str, error: f64| {
        report.headline(what, significant(error, 2), Verdict::of(error <= result.target))
    };
    let estimate = result.estimate.as_ref().map(|estimate| estimate.largest().unwrap_or_default().1);
    report = match estimate {
        None => report.headline("Estimated error", "not known", Verdict::None),
        Some(error) => judged(report, "Largest estimated error of a response", error),
    };
    report = match result.largest_difference() {
        None => report.headline("Difference from the full model", "not computed", Verdict::None),
        Some((_, error)) => judged(report, "Largest difference from the full model", error),
    };
    report = report.section(inputs(case, result)).section(model(result));
    for path in 0..result.paths.len() {
        report = report.section(of_path(result, path)?);
    }
    report.sections.extend(result.estimate.as_ref().map(|estimate| errors(result, estimate)));
    if !result.ranking.is_empty() {
        report = report.section(ranking(result));
    }
    report.warnings.extend_from_slice(&result.doubts);
    Ok(report)
}

/// The case in words.
fn inputs(case: &Case, result: &FrfResult) -> Section {
    let size = match &result.housing {
        FrfHousing::Mesh(stage) => Some(HousingSize::of_housing(&stage.housing)),
        FrfHousing::File(_) => None,
    };
    Section::new("Inputs").facts(parts::inputs(case, Purpose::Frf, size.as_ref()))
}

fn model(result: &FrfResult) -> Section {
    let element = result.housing.element();
    let coordinates = Fact::new("Interface coordinates", element.interface_dof.to_string());
    let of_housing = match &result.housing {
        FrfHousing::Mesh(stage) => {
            let (substructure, basis) = (&stage.condensed.substructure, &stage.condensed.basis);
            let modes = basis.count() - basis.residual_vectors;
            vec![
                Fact::new("Interior degrees of freedom", substructure.interior_dof().to_string()),
                coordinates,
                Fact::new("Fixed-interface modes", modes.to_string()),
                Fact::new("Residual vectors", basis.residual_vectors.to_string()).note("static responses to every force and to a force at every sensor, and what their responses lacked where the estimated error was largest"),
            ]
        }
        FrfHousing::File(imported) => vec![
            Fact::new("Superelement", imported.0.path.display().to_string()),
            coordinates,
            Fact::new("Modes", element.modal_dof().to_string()),
        ],
    };
    let of_response = [Fact::new("Frequencies", result.response.frequencies_hz().len().to_string())
        .note("equal steps of the band, and four to the half-power bandwidth of every resonance")];
    Section::new("Model").facts(of_housing.into_iter().chain(of_response))
}

fn of_path(result: &FrfResult, index: usize) -> Result<Section, ComputeError> {
    let path = &result.paths[index];
    let title = format!("From {} to {}", path.from, path.to);
    if path.is_closed() {
        return Ok(Section::new(title).paragraph(format!("This path {}.", TransferPath::CLOSED)));
    }
    let (sensor, load) = path.place;
    let all = result.response.frequencies_hz();
    let accelerance = result.response.path(sensor, load, FrfQuantity::Accelerance)?;
    let full: Vec<(f64, c64)> =
        result.compared.iter().map(|at| (at.frequency_hz, accelerance_of(at.frequency_hz, at.full[index]))).collect();
    let reduced: Vec<(f64, c64)> = all.iter().copied().zip(accelerance).collect();
    let [low, high] = result.band_hz;
    let frequency = || Axis::new("Frequency", "Hz").range(low, high);
    let size = || Axis::new("Acceleration over force", "(m/s^2)/N").log();
    let plot = |title: &str, y: Axis, of: fn(c64) -> f64| {
        let plot = Plot::new(title, frequency(), y).curve(curve("reduced", &reduced, of));
        match full.as_slice() {
            [] => plot,
            full => plot.curve(curve("full", full, of).style(CurveStyle::Points)),
        }
    };
    let magnitude = plot("Accelerance, magnitude", size(), |h| h.norm()).caption(format!(
        "Acceleration at {} by a force of 1 N at {}, over frequency. Peaks are resonances, where the path transmits most.",
        path.to, path.from
    ));
    let phase = plot("Accelerance, phase", Axis::new("Phase", "deg"), |h| h.arg().to_degrees()).caption(
        "Phase of the acceleration against the force. It turns by 180 degrees through each resonance that carries the path.",
    );
    let mut parts =
        Plot::new("Accelerance of the modes that carry most", frequency(), size())
            .curve(curve("all", &reduced, |h| h.norm()))
            .caption("The whole path, and what each of the modes that carry most would bring alone. Where a mode lies on the whole curve, a change of that mode changes the path.");
    for part in &path.carried {
        let values: Vec<(f64, c64)> =
            all.iter().zip(&part.receptance).map(|(&hz, &receptance)| (hz, accelerance_of(hz, receptance))).collect();
        let name = format!("{:.0} Hz", part.frequency_hz);
        parts = parts.curve(curve(name, &values, |h| h.norm()));
    }
    let columns = [
        Column::number("Mode", ""),
        Column::number("Frequency", "Hz"),
        Column::number("Damping ratio", ""),
        Column::number("Share", "%"),
        Column::number("Alone", "%"),
    ];
    let rows = path.shares.modes.iter().take(LISTED).map(|share| {
        [
            Cell::text((share.mode + 1).to_string()),
            Cell::number(share.frequency_hz, 6),
            Cell::number_or(share.ratio, 3, "rigid"),
            Cell::number(100.0 * share.share, 3),
            Cell::number(100.0 * share.alone, 3),
        ]
    });
    let table = Table::new(format!("What carries the path from {} to {}", path.from, path.to), columns).rows(rows);
    Ok(Section::new(title)
        .plot(magnitude)
        .plot(phase)
        .plot(parts)
        .table(table.footnote("Share: integral of Re(conj(H) H_r) over that of |H|^2, receptances over the band; the shares of all modes add up to 100 %, modes that work against each other are above it and below zero. Alone: what the mode would bring without the others.")))
}

fn accelerance_of(hz: f64, receptance: c64) -> c64 {
    FrfQuantity::Accelerance.factor(hz) * receptance
}

/// A curve of what is not zero: at rest there is no acceleration, and no logarithm of it.
fn curve(name: impl Into<String>, values: &[(f64, c64)], of: impl Fn(c64) -> f64) -> Curve {
    let moving = || values.iter().filter(|(_, h)| h.norm() > 0.0);
    let hz = moving().map(|(hz, _)| *hz).collect();
    Curve::new(name, Abscissa::Points(hz), moving().map(|(_, h)| of(*h)).collect())
}

fn errors(result: &FrfResult, estimate: &ResponseEstimate) -> Section {
    let estimated = estimate.frequencies_hz.iter().zip(&estimate.relative_errors);
    let positive = |(hz, error): (f64, f64)| (error > 0.0 && error.is_finite()).then_some((hz, error));
    let (hz, error) = estimated.filter_map(|(&hz, &error)| positive((hz, error))).unzip();
    let [low, high] = result.band_hz;
    let mut plot = Plot::new(
        "Error of the reduced responses, the largest of the paths",
        Axis::new("Frequency", "Hz").range(low, high),
        Axis::new("Error over response", "").log(),
    )
    .curve(Curve::new("estimated", Abscissa::Points(hz), error))
    .caption("Relative error of the reduced responses. Where the curve is below the target, the reduced model is as good as was asked for.");
    let target = vec![result.target; 2];
    plot = plot.curve(Curve::new("target", Abscissa::Points(vec![low, high]), target));
    if result.compared.is_empty() {
        return Section::new("Error of the reduced responses").plot(plot);
    }
    let compared = result.compared.iter();
    let (hz, difference) = compared.filter_map(|at| positive((at.frequency_hz, at.difference))).unzip();
    let points = Curve::new("against the full model", Abscissa::Points(hz), difference);
    let residual = result.compared.iter().map(|compared| compared.residual);
    let damping = result.full_damping.map(|FullDamping { modes, up_to_hz, ritz_vectors, left_out }| format!(
        "Every mode of the full model has the ratio of the case: {modes} modes up to {} Hz by themselves, those above by {ritz_vectors} Ritz vectors of the forces and sensors, which leave out damping that makes up to {} of a response.",
        significant(up_to_hz, 4),
        significant(left_out, 1)
    ));
    let mut section = Section::new("Error of the reduced responses")
        .plot(plot.curve(points.style(CurveStyle::Points)))
        .paragraph(format!(
            "Full: direct solutions of (K - w^2 M + i (w C + K_s)) x = f over all degrees of freedom, with residuals up to {}. The difference is that of complex receptances, phase included, relative to the response where it is read; it passes up to {}.",
            significant(residual.fold(0.0, f64::max), 1),
            significant(result.target, 2)
        ));
    if let Some(damping) = damping {
        section = section.paragraph(damping);
    }
    section.table(compared_table(result))
}

fn compared_table(result: &FrfResult) -> Table {
    let mut columns = vec![Column::number("Frequency", "Hz")];
    columns.extend(result.paths.iter().flat_map(|path| {
        ["reduced", "full"].map(|of| Column::number(format!("{} to {}, {of}", path.from, path.to), "m/N"))
    }));
    columns.extend([Column::number("Estimated error", ""), Column::number("Largest difference", "")]);
    let rows = result.compared.iter().map(|compared| {
        let mut cells = vec![Cell::number(compared.frequency_hz, 6)];
        for (reduced, full) in compared.reduced.iter().zip(&compared.full) {
            cells.extend([Cell::number(reduced.norm(), 6), Cell::number(full.norm(), 6)]);
        }
        cells.push(Cell::number_or(compared.estimated, 2, "outside the band"));
        let verdict = Verdict::of(compared.difference <= result.target);
        cells.push(Cell::number(compared.difference, 2).judged(verdict));
        cells
    });
    Table::new("Receptance, reduced and full", columns).rows(rows)
}

fn ranking(result: &FrfResult) -> Section {
    let [low, high] = result.band_hz;
    let mut section = Section::new("Which variant transmits least")
        .paragraph(format!("Energy mean of the accelerance from {low:.0} to {high:.0} Hz, the quietest first."));
    for ranked in &result.ranking {
        let path = &result.paths[ranked.path];
        let columns = [
            Column::text("Variant"),
            Column::number("Level", "dB re 1 (m/s^2)/N"),
            Column::number("Above the quietest", "dB"),
        ];
        let rows = ranked.variants.iter().map(|variant| {
            let (mean, above) = (Cell::number(variant.mean_db, 5), Cell::number(variant.above_quietest_db, 4));
            [Cell::text(&variant.name), mean, above]
        });
        section = section.table(Table::new(format!("From {} to {}", path.from, path.to), columns).rows(rows));
    }
    section
}
