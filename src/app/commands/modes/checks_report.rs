//! The report's sections on comparisons with other modes and on the convergence of the mesh.

use super::comparison::{ComparedPair, FileComparison, LoneMode, Miss};
use super::compute::ModesResult;
use super::convergence::{MeshConvergence, ModeOnMeshes};
use super::kinds::REPEATED;
use super::shape_view::shown_places;
use crate::fe::modal::{MatchedBy, ModalSurvey};
use crate::report::{
    Abscissa, Axis, Cell, Column, Curve, Matrix, Plot, Report, Section, Table, Verdict, given, signed, significant,
};

/// Modes in the plot over the mesh size: as many as have colours of their own.
const PLOTTED: usize = 6;

/// Column of what a pair misses.
const MISSES: usize = 6;

/// A limit as it was given, without trailing zeros.
pub(crate) fn plain(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Numbers of modes, counted from 1.
pub(crate) fn mode_numbers(modes: &[usize]) -> String {
    let numbers: Vec<String> = modes.iter().map(|mode| (mode + 1).to_string()).collect();
    numbers.join(", ")
}

/// What a pair or a lone mode misses, in words; "ok" for nothing.
pub(crate) fn misses_text(misses: &[Miss]) -> String {
    let words: Vec<&str> = misses.iter().map(|miss| miss.describe()).collect();
    if words.is_empty() { "ok".to_owned() } else { words.join(", ") }
}

/// The verdicts for the head of the report.
pub(crate) fn headlines(mut report: Report, result: &ModesResult) -> Report {
    for comparison in &result.comparisons {
        let [agree, judged] = comparison.agreeing();
        let mut value = format!("{agree} of {judged} modes");
        if comparison.missing_here() > 0 {
            value += &format!(", {} not found here", comparison.missing_here());
        }
        report = report.headline(format!("Agreement with {}", comparison.what), value, Verdict::of(comparison.ok));
    }
    let Some(convergence) = &result.convergence else {
        return report;
    };
    let value = match (convergence.worst(), convergence.without_limit()) {
        (None, _) => "not known".to_owned(),
        (Some(mode), 0) => format!("{} (mode {})", error_text(mode), mode.mode + 1),
        (Some(mode), unknown) => format!(
            "{} (mode {}); not known for {unknown} of {} modes",
            error_text(mode),
            mode.mode + 1,
            convergence.modes.len()
        ),
    };
    report.headline("Largest error of the mesh", value, Verdict::None)
}

/// Estimated error of the case's own mesh with its uncertainty, or what is known instead.
pub(crate) fn error_text(mode: &ModeOnMeshes) -> String {
    match (mode.mesh_error, mode.mesh_error_uncertainty) {
        (Some(error), Some(around)) => format!("{} % ± {} %", signed(100.0 * error, 2), significant(100.0 * around, 2)),
        (None, Some(range)) => format!("not known (range {} %)", significant(100.0 * range, 2)),
        _ => "not known".to_owned(),
    }
}

/// Modes of this case against those of a file.
pub(crate) fn comparison_section(comparison: &FileComparison, survey: &ModalSurvey) -> Section {
    let points = &comparison.points;
    let by = match points.by {
        MatchedBy::Tag => "by their tags".to_owned(),
        MatchedBy::Place => format!("by place, {} mm apart at most", significant(1e3 * points.largest_distance_m, 2)),
    };
    let mut text = format!(
        "Modes without contact against those of {}. Shapes are compared at {} points, matched {by}; this model has {}, the file {}. A pair passes with a modal assurance criterion (MAC) of at least {} and frequencies within {} %. Repeated modes are compared as a group, by the spaces that they span and their mean frequency.",
        comparison.file.display(),
        points.matched,
        points.here,
        points.there,
        given(comparison.mac_limit),
        plain(100.0 * comparison.within),
    );
    let outside = |modes: &[LoneMode]| modes.iter().filter(|mode| !mode.missing).count();
    let [here, there] = [outside(&comparison.lone_here), outside(&comparison.lone_there)];
    if here + there > 0 {
        text.push_str(&format!(
            " Not judged, because the other side does not reach as far: {here} modes of this case and {there} of the file."
        ));
    }
    let mut section = Section::new(format!("Comparison with {}", comparison.what))
        .paragraph(text)
        .table(pair_table(comparison, survey));
    if !comparison.mac.is_empty() && !comparison.there_hz.is_empty() {
        section = section.matrix(mac_matrix(comparison));
    }
    section
}

fn pair_table(comparison: &FileComparison, survey: &ModalSurvey) -> Table {
    let mut columns = vec![
        Column::text("Mode here"),
        Column::number("Frequency here", "Hz"),
        Column::text("Mode there"),
        Column::number("Frequency there", "Hz"),
        Column::number("Difference", "%"),
        Column::number("MAC", ""),
        Column::text("Misses"),
        Column::text("Verdict"),
    ];
    let pairs = comparison.pairs.iter().map(|pair| (pair.here_hz, pair.here.first().copied(), pair_row(pair)));
    let mut rows: Vec<(f64, Option<usize>, Vec<Cell>)> = pairs.collect();
    let none = || [Cell::text("–"), Cell::text("–")];
    let lone = |mode: &LoneMode, is_here: bool| {
        let own = [Cell::text((mode.mode + 1).to_string()), Cell::number(mode.hz, 7)];
        let [here, there] = if is_here { [own, none()] } else { [none(), own] };
        let misses = [Cell::text(Miss::Partner.describe()), Cell::badge(Verdict::Bad)];
        (mode.hz, is_here.then_some(mode.mode), [here, there, none(), misses].concat())
    };
    for (modes, is_here) in [(&comparison.lone_here, true), (&comparison.lone_there, false)] {
        rows.extend(modes.iter().filter(|mode| mode.missing).map(|mode| lone(mode, is_here)));
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    // what passes misses nothing
    if comparison.ok {
        columns.remove(MISSES);
        for row in &mut rows {
            row.2.remove(MISSES);
        }
    }
    let places = shown_places(survey);
    let shown: Vec<Option<usize>> = rows.iter().map(|row| places.get(row.1?).copied().flatten()).collect();
    Table::new(format!("Modes here and in {}", comparison.what), columns)
        .rows(rows.into_iter().map(|row| row.2))
        .showing_modes(shown)
        .footnote("Difference: (here - there) / there. MAC of a group: the squared cosine of the largest angle between the two spaces. Modes there are numbered in the order of the file.")
}

fn pair_row(pair: &ComparedPair) -> Vec<Cell> {
    let passes = pair.misses.is_empty();
    let missed = |miss| if pair.misses.contains(&miss) { Verdict::Bad } else { Verdict::None };
    let count = |modes: &[usize]| {
        let text = match modes.len() {
            1 => mode_numbers(modes),
            several => format!("{} (group of {several})", mode_numbers(modes)),
        };
        Cell::text(text).judged(missed(Miss::Count))
    };
    let difference = match pair.relative_difference {
        Some(difference) => Cell::text(signed(100.0 * difference, 3)).value(100.0 * difference),
        None => Cell::text("no stiffness"),
    };
    vec![
        count(&pair.here),
        Cell::number(pair.here_hz, 7),
        count(&pair.there),
        Cell::number(pair.there_hz, 7),
        difference.judged(missed(Miss::Frequency)),
        Cell::text(format!("{:.4}", pair.mac)).value(pair.mac).judged(missed(Miss::Mac)),
        Cell::text(if passes { String::new() } else { misses_text(&pair.misses) }),
        Cell::badge(Verdict::of(passes)),
    ]
}

fn mac_matrix(comparison: &FileComparison) -> Matrix {
    let numbers = |count: usize| (1..=count).map(|mode| mode.to_string()).collect::<Vec<_>>();
    let rows = ("Mode here", numbers(comparison.mac.len()));
    let columns = ("Mode there", numbers(comparison.there_hz.len()));
    let title = format!("Modal assurance criterion with {}", comparison.what);
    let mut matrix = Matrix::new(title, rows, columns, comparison.mac.clone());
    matrix.caption = Some(
        "Modal assurance criterion, mode by mode. Within a group of repeated modes any combination is a mode: single values say nothing there."
            .to_owned(),
    );
    matrix
}

/// The elastic modes on all meshes.
pub(crate) fn convergence_section(found: &MeshConvergence, survey: &ModalSurvey) -> Section {
    let count = found.meshes.len();
    let text = format!(
        "The modes of this case on {count} meshes, recognised by their shapes, and extrapolated to an infinitely fine one by f = f₀ + c hᵖ (Richardson). The elements promise p = {} in a smooth body. The mesh error is that of this case's own mesh, (f − f₀) / f₀; its uncertainty is that of the grid convergence index beyond the estimate (factor of safety 1.25 where the observed order is within 10 % of the promised one, otherwise 3). It is an estimate, not a bound.",
        plain(found.formal_order)
    );
    let section = Section::new("Convergence of the mesh").paragraph(text);
    let section = section.table(mesh_table(found)).table(limit_table(found, survey));
    plot(found).into_iter().fold(section, Section::plot)
}

fn mesh_table(found: &MeshConvergence) -> Table {
    let columns = [
        Column::text("Mesh"),
        Column::number("Element size h", "mm"),
        Column::number("Elements", ""),
        Column::text("Kind"),
        Column::number("Free degrees of freedom", ""),
        Column::number("Points compared", ""),
        Column::text(""),
    ];
    let rows = found.meshes.iter().map(|mesh| {
        [
            Cell::text(mesh.mesh.display().to_string()),
            Cell::number(1e3 * mesh.element_size_m, 4),
            Cell::text(mesh.elements.to_string()).value(mesh.elements as f64),
            Cell::text(mesh.kinds.clone()),
            Cell::text(mesh.free_dof.to_string()).value(mesh.free_dof as f64),
            Cell::text(mesh.matched_points.to_string()).value(mesh.matched_points as f64),
            Cell::text(match (mesh.own, mesh.extrapolated) {
                (true, _) => "this case",
                (false, true) => "",
                (false, false) => "shown only",
            }),
        ]
    });
    Table::new("Meshes", columns)
        .rows(rows)
        .footnote("h: (area or volume / elements) to the power of 1 over the dimension.")
}

fn limit_table(found: &MeshConvergence, survey: &ModalSurvey) -> Table {
    let mut columns = vec![Column::number("Mode", "")];
    columns.extend(found.meshes.iter().map(|mesh| {
        let own = if mesh.own { ", this case" } else { "" };
        Column::number(format!("h = {} mm{own}", significant(1e3 * mesh.element_size_m, 3)), "Hz")
    }));
    columns.extend([
        Column::number("Estimate", "Hz"),
        Column::number("Order", ""),
        Column::number("Mesh error", "%"),
        Column::number("Uncertainty", "± %"),
        Column::text("Behaviour"),
    ]);
    let number = |value: Option<f64>, digits| Cell::number_or(value, digits, "–");
    let rows = found.modes.iter().map(|mode| {
        let limit = mode.limit.as_ref();
        let mut cells = vec![Cell::text((mode.mode + 1).to_string())];
        cells.extend(mode.frequencies_hz.iter().map(|&hz| number(hz, 7)));
        let error = mode.mesh_error.map(|error| 100.0 * error);
        cells.extend([
            number(limit.and_then(|limit| limit.estimate), 7),
            number(limit.and_then(|limit| limit.order), 3),
            error.map_or_else(|| Cell::text("–"), |error| Cell::text(signed(error, 2)).value(error)),
            number(mode.mesh_error_uncertainty.map(|around| 100.0 * around), 2),
            Cell::text(limit.map_or("on no other mesh of its kind", |limit| limit.behaviour.describe())),
        ]);
        cells
    });
    let places = shown_places(survey);
    let shown = found.modes.iter().map(|mode| places.get(mode.mode).copied().flatten());
    let table = Table::new("Frequencies by mesh and their limit", columns).rows(rows);
    table.showing_modes(shown).footnote("Without an estimate the uncertainty is the range of the frequencies.")
}

/// Relative distance from the limit over the mesh size; of repeated modes one.
fn plot(found: &MeshConvergence) -> Option<Plot> {
    let x = Axis::new("Element size h", "mm").log();
    let y = Axis::new("|f − f₀| / f₀", "%").log();
    let mut plot = Plot::new("Distance from the limit", x, y);
    let mut last = 0.0;
    for mode in &found.modes {
        let estimate = mode.limit.as_ref().and_then(|limit| limit.estimate);
        let estimate = estimate.filter(|estimate| (estimate - last).abs() > REPEATED * estimate);
        let Some(estimate) = estimate else { continue };
        last = estimate;
        let points = found.meshes.iter().zip(&mode.frequencies_hz);
        let points = points.filter(|(mesh, _)| mesh.extrapolated);
        let points = points.filter_map(|(mesh, hz)| {
            let error = 100.0 * ((*hz)? / estimate - 1.0).abs();
            Some((1e3 * mesh.element_size_m, error))
        });
        let (h, error): (Vec<f64>, Vec<f64>) = points.unzip();
        let name = format!("mode {}, {} Hz", mode.mode + 1, significant(estimate, 5));
        plot = plot.curve(Curve::new(name, Abscissa::Points(h), error));
        if plot.curves.len() == PLOTTED {
            break;
        }
    }
    (!plot.curves.is_empty()).then(|| {
        plot.caption("Distance of the frequencies from their limit over the element size, one corner a mesh: the slope is the order. The first modes that have a limit, of repeated ones one.")
    })
}
