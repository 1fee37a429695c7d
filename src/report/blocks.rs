//! The pieces of a section as the page template takes them: checked, drawn and numbered.

use minijinja::context;
use minijinja::value::{Serde, Value};

use super::embed::CurveLook;
use super::layout::Layout;
use super::shapes::{Packed, Surface};
use super::svg::COLOURS;
use super::{
    Block, ModeShapeView, Plot, ReportError, Section, ShapeFigures, Table, TableFiles, bars, csv, embed, matrix,
    shapes, spans, step_map, svg_drawing, svg_plot,
};

/// Bytes that the shapes of a report may take for its script, beside still pictures (2 MB at most for a view), plots and
/// the library: the file stays below 15 MB.
const SHAPES_BUDGET: usize = 7_500_000;

/// Numbers that figures and tables have had so far, and what each may take.
#[derive(Debug)]
pub(super) struct Numbers<'a> {
    figure: usize,
    table: usize,
    table_files: Option<&'a TableFiles>,
    live: usize,
    curve_share: usize,
    shapes_share: usize,
}

impl<'a> Numbers<'a> {
    /// Nothing numbered yet; the budgets shared among what the sections hold.
    pub(super) fn new(sections: &[Section], table_files: Option<&'a TableFiles>) -> Self {
        let blocks = || sections.iter().flat_map(|s| &s.blocks);
        Self {
            figure: 0,
            table: 0,
            table_files,
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

/// A section for the template: its title, and its blocks of a `kind` each.
pub(super) fn section(section: &Section, numbers: &mut Numbers) -> Result<Value, ReportError> {
    let blocks: Vec<Value> = section.blocks.iter().map(|of| block(of, numbers)).collect::<Result<_, _>>()?;
    Ok(context! { title => &section.title, blocks })
}

fn block(block: &Block, numbers: &mut Numbers) -> Result<Value, ReportError> {
    let (class, title, caption, svg) = match block {
        Block::Paragraph(text) => return Ok(context! { kind => "paragraph", text }),
        Block::Facts(facts) => return Ok(context! { kind => "facts", facts => Serde(facts) }),
        Block::Table(of) => return table(of, numbers),
        Block::Plot(of) => return plot(of, numbers),
        Block::Shapes(view) => return shapes(view, numbers),
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
    let names = series.iter().zip((0..COLOURS).cycle());
    let legend: Vec<Value> = names.map(|(series, colour)| context! { name => &series.name, colour }).collect();
    let number = next(&mut numbers.figure);
    Ok(context! { kind => "picture", number, class, title, caption, svg, legend })
}

fn next(number: &mut usize) -> usize {
    *number += 1;
    *number
}

fn table(table: &Table, numbers: &mut Numbers) -> Result<Value, ReportError> {
    table.check()?;
    let number = next(&mut numbers.table);
    Ok(context! {
        kind => "table",
        number,
        table => Serde(table),
        file => csv::file_name(numbers.table_files, number, table),
        // the folder beside the report that has the file too
        folder => numbers.table_files.map(|files| &files.folder),
        address => csv::address(table),
    })
}

fn plot(plot: &Plot, numbers: &mut Numbers) -> Result<Value, ReportError> {
    let number = next(&mut numbers.figure);
    let layout = Layout::of(plot)?;
    let legend: Vec<CurveLook> = plot.curves.iter().enumerate().map(|(k, curve)| CurveLook::of(curve, k)).collect();
    Ok(context! {
        kind => "plot",
        number,
        title => &plot.title,
        caption => &plot.caption,
        svg => svg_plot::draw(plot, &layout, &format!("figure-{number}"))?,
        data => embed::json(plot, &layout, numbers.curve_share)?,
        legend => Serde(legend),
        // of the x axis as it is shown
        unit => &layout.x.unit,
        families => Serde(embed::family_names(plot)),
    })
}

/// The figures of a structure in space.
fn shapes(view: &ModeShapeView, numbers: &mut Numbers) -> Result<Value, ReportError> {
    view.check()?;
    let surface = Surface::of(view);
    let with_mesh = view.figures != ShapeFigures::Modes || view.modes.is_empty();
    let mesh = with_mesh.then(|| {
        let (svg, edges) = shapes::mesh_picture(view, &surface);
        context! { number => next(&mut numbers.figure), svg, edges }
    });
    let modes = shows_modes(view).then(|| modes(view, &surface, numbers)).transpose()?;
    let legend = Serde(shapes::legend(view));
    Ok(context! { kind => "shapes", title => &view.title, caption => &view.caption, legend, mesh, modes })
}

fn modes(view: &ModeShapeView, surface: &Surface, numbers: &mut Numbers) -> Result<Value, ReportError> {
    let number = next(&mut numbers.figure);
    let Packed { json, left_out, modes } = shapes::pack(view, surface, numbers.shapes_share)?;
    let list = view.modes.iter().take(modes);
    let list = list.map(|mode| context! { label => &mode.label, frequency => mode.frequency(), note => &mode.note });
    let stills = shapes::stills(view, surface);
    Ok(context! {
        number,
        // whether rows of tables point to it
        first => next(&mut numbers.live) == 1,
        list => list.collect::<Vec<_>>(),
        data => json,
        left_out,
        // modes without a still picture
        more => view.modes.len() - stills.len(),
        stills => Serde(stills),
        bar => shapes::colour_bar(),
        amplitude_percent => 100.0 * view.amplitude,
    })
}
