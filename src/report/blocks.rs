//! The pieces of a section as the page template takes them: checked, drawn and numbered.

use serde::Serialize;

use super::content::{Block, Fact, Section, TableFiles};
use super::curve::CurveStyle;
use super::layout::Layout;
use super::palette::COLOURS;
use super::plot::Plot;
use super::shapes::{self, LegendEntry, ModeShapeView, Packed, ShapeFigures, Still, Surface};
use super::table::{Cell, Column, Table};
use super::{ReportError, bars, csv, embed, matrix, spans, step_map, svg_drawing, svg_plot};

/// Bytes that the shapes of a report may take for its script, beside still pictures (2 MB at most for a view), plots and
/// the library: the file stays below 15 MB.
const SHAPES_BUDGET: usize = 7_500_000;

#[derive(Debug, Serialize)]
pub(super) struct SectionView<'a> {
    title: &'a str,
    blocks: Vec<BlockView<'a>>,
}

#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum BlockView<'a> {
    Paragraph {
        text: &'a str,
    },
    Facts {
        facts: &'a [Fact],
    },
    Table {
        number: usize,
        caption: &'a str,
        columns: &'a [Column],
        rows: Vec<Row<'a>>,
        footnotes: &'a [String],
        file: String,
        /// Folder beside the report that has the file too.
        folder: Option<String>,
        address: String,
    },
    Plot {
        number: usize,
        title: &'a str,
        caption: Option<&'a str>,
        svg: String,
        data: String,
        legend: Vec<Entry<'a>>,
        /// Unit of the x axis as it is shown.
        unit: String,
        families: Vec<&'a str>,
    },
    Picture {
        number: usize,
        class: &'static str,
        title: &'a str,
        caption: Option<&'a str>,
        svg: String,
        legend: Vec<Name<'a>>,
    },
    Shapes(Box<ShapesView<'a>>),
}

/// A row of a table, and the mode that it speaks of.
#[derive(Debug, Serialize)]
struct Row<'a> {
    cells: &'a [Cell],
    mode: Option<usize>,
}

/// A name in the legend of a chart.
#[derive(Debug, Serialize)]
struct Name<'a> {
    name: &'a str,
    colour: usize,
}

/// A name in the legend of a plot.
#[derive(Debug, Serialize)]
struct Entry<'a> {
    name: &'a str,
    colour: usize,
    style: &'static str,
    /// Path data of its symbol, and whether it is open.
    symbol: Option<String>,
    open: bool,
}

/// The figures of a structure in space.
#[derive(Debug, Serialize)]
struct ShapesView<'a> {
    title: &'a str,
    caption: Option<&'a str>,
    legend: Vec<LegendEntry>,
    mesh: Option<MeshFigure>,
    modes: Option<ModesFigure>,
}

#[derive(Debug, Serialize)]
struct MeshFigure {
    number: usize,
    svg: String,
    edges: &'static str,
}

#[derive(Debug, Serialize)]
struct ModesFigure {
    number: usize,
    /// Whether rows of tables point to it.
    first: bool,
    list: Vec<ModeEntry>,
    data: String,
    left_out: Option<String>,
    stills: Vec<Still>,
    /// Modes without a still picture.
    more: usize,
    bar: String,
    amplitude_percent: f64,
}

#[derive(Debug, Serialize)]
struct ModeEntry {
    label: String,
    frequency: String,
    note: String,
}

/// Numbers that figures and tables have had so far, and what each may take.
#[derive(Debug)]
pub(super) struct Numbers {
    figure: usize,
    table: usize,
    table_files: Option<TableFiles>,
    live: usize,
    curve_share: usize,
    shapes_share: usize,
}

impl Numbers {
    /// Nothing numbered yet; the budgets shared among what the sections hold.
    pub(super) fn new(sections: &[Section], table_files: Option<&TableFiles>) -> Self {
        let blocks = || sections.iter().flat_map(|s| &s.blocks);
        Self {
            figure: 0,
            table: 0,
            table_files: table_files.cloned(),
            live: 0,
            curve_share: embed::share(blocks().filter_map(Block::plot)),
            shapes_share: SHAPES_BUDGET / blocks().filter(|b| is_live(b)).count().max(1),
        }
    }
}

/// Whether a piece needs the script for shapes.
pub(super) fn is_live(block: &Block) -> bool {
    matches!(block, Block::Shapes(view) if shows_modes(view))
}

fn shows_modes(view: &ModeShapeView) -> bool {
    view.figures != ShapeFigures::Mesh && !view.modes.is_empty()
}

pub(super) fn section_view<'a>(section: &'a Section, numbers: &mut Numbers) -> Result<SectionView<'a>, ReportError> {
    let blocks = section.blocks.iter().map(|block| block_view(block, numbers)).collect::<Result<_, _>>()?;
    Ok(SectionView { title: &section.title, blocks })
}

fn block_view<'a>(block: &'a Block, numbers: &mut Numbers) -> Result<BlockView<'a>, ReportError> {
    let (class, title, caption, svg) = match block {
        Block::Paragraph(text) => return Ok(BlockView::Paragraph { text }),
        Block::Facts(facts) => return Ok(BlockView::Facts { facts }),
        Block::Table(table) => return table_view(table, numbers),
        Block::Plot(plot) => return plot_view(plot, numbers),
        Block::Shapes(view) => {
            return Ok(BlockView::Shapes(Box::new(shapes_view(view, numbers)?)));
        }
        Block::Drawing(of) => ("drawing", &of.title, &of.caption, svg_drawing::draw(of)?),
        Block::Bars(of) => ("bars", &of.title, &of.caption, bars::draw(of)?),
        Block::Matrix(of) => ("matrix", &of.title, &of.caption, matrix::draw(of)?),
        Block::Spans(of) => ("bars", &of.title, &of.caption, spans::draw(of)?),
        Block::StepMap(of) => ("bars", &of.title, &of.caption, step_map::draw(of)?),
    };
    let series = match block {
        Block::Bars(chart) => &*chart.series,
        _ => &[],
    };
    let names = series.iter().map(|series| &*series.name);
    Ok(BlockView::Picture {
        number: next(&mut numbers.figure),
        class,
        title,
        caption: caption.as_deref(),
        svg,
        legend: names.zip((0..COLOURS).cycle()).map(|(name, colour)| Name { name, colour }).collect(),
    })
}

fn next(number: &mut usize) -> usize {
    *number += 1;
    *number
}

fn table_view<'a>(table: &'a Table, numbers: &mut Numbers) -> Result<BlockView<'a>, ReportError> {
    table.check()?;
    let number = next(&mut numbers.table);
    let rows =
        table.rows.iter().enumerate().map(|(k, cells)| Row { cells, mode: table.modes.get(k).copied().flatten() });
    Ok(BlockView::Table {
        number,
        caption: &table.caption,
        columns: &table.columns,
        rows: rows.collect(),
        footnotes: &table.footnotes,
        file: csv::file_name(numbers.table_files.as_ref(), number, table),
        folder: numbers.table_files.as_ref().map(|files| files.folder.clone()),
        address: csv::address(table),
    })
}

fn plot_view<'a>(plot: &'a Plot, numbers: &mut Numbers) -> Result<BlockView<'a>, ReportError> {
    let number = next(&mut numbers.figure);
    let layout = Layout::of(plot)?;
    let legend = plot.curves.iter().enumerate().map(|(k, curve)| Entry {
        name: &curve.name,
        colour: svg_plot::colour(curve, k),
        symbol: (curve.style == CurveStyle::Points).then(|| curve.symbol.path()),
        open: curve.symbol.is_open(),
        style: curve.style.class(),
    });
    Ok(BlockView::Plot {
        number,
        title: &plot.title,
        caption: plot.caption.as_deref(),
        svg: svg_plot::draw(plot, &layout, &format!("figure-{number}"))?,
        data: embed::json(plot, &layout, numbers.curve_share)?,
        legend: legend.collect(),
        unit: layout.x.unit,
        families: embed::family_names(plot),
    })
}

fn shapes_view<'a>(view: &'a ModeShapeView, numbers: &mut Numbers) -> Result<ShapesView<'a>, ReportError> {
    view.check()?;
    let surface = Surface::of(view);
    let with_mesh = view.figures != ShapeFigures::Modes || view.modes.is_empty();
    let mesh = with_mesh.then(|| {
        let (svg, edges) = shapes::mesh_picture(view, &surface);
        MeshFigure { number: next(&mut numbers.figure), svg, edges }
    });
    let modes = shows_modes(view).then(|| modes_figure(view, &surface, numbers)).transpose()?;
    Ok(ShapesView { title: &view.title, caption: view.caption.as_deref(), legend: shapes::legend(view), mesh, modes })
}

fn modes_figure(view: &ModeShapeView, surface: &Surface, numbers: &mut Numbers) -> Result<ModesFigure, ReportError> {
    let number = next(&mut numbers.figure);
    let Packed { json, left_out, modes } = shapes::pack(view, surface, numbers.shapes_share)?;
    let list = view.modes.iter().take(modes).map(|mode| ModeEntry {
        label: mode.label.clone(),
        frequency: mode.frequency(),
        note: mode.note.clone(),
    });
    let stills = shapes::stills(view, surface);
    Ok(ModesFigure {
        number,
        first: next(&mut numbers.live) == 1,
        list: list.collect(),
        data: json,
        left_out,
        more: view.modes.len() - stills.len(),
        stills,
        bar: shapes::colour_bar(),
        amplitude_percent: 100.0 * view.amplitude,
    })
}
