//! The figures of a sweep over what was varied.

use super::SweepResult;
use super::outputs::{ERROR, LINES, PlotOf};
use super::result::{NamedColumn, Values};
use super::tables::{Scaled, short_name};
use crate::app::commands::analyze::report::capital;
use crate::report::{Abscissa, Axis as PlotAxis, Curve, CurveStyle, Plot, Symbol, significant};

/// Most curves of a plot: as many as can be told apart.
const MOST_CURVES: usize = 12;
/// Colours of curves; further ones are dashed and have the next symbol.
const COLOURS: usize = 6;
const SYMBOLS: [Symbol; 4] = [Symbol::Dot, Symbol::Diamond, Symbol::Square, Symbol::Triangle];

/// A plot a title, over the first axis that has two or more numbers; a curve a figure and combination of the other axes'
/// values. A ring is where the verdict indicates the part.
pub(super) fn plots(result: &SweepResult) -> Vec<Plot> {
    let axes = result.plan.axes.iter().enumerate();
    let mut numeric = axes.filter_map(|(place, axis)| {
        let numbers = axis.numbers()?;
        (numbers.len() > 1).then_some((place, numbers))
    });
    let Some((place, numbers)) = numeric.next() else {
        return Vec::new();
    };
    let varied = result.axes();
    let key = &varied[place];
    // a range over decades shows nothing on a linear axis
    let [least, most] = [f64::min, f64::max].map(|pick| numbers.iter().copied().reduce(pick));
    let ratios = least.zip(most).is_some_and(|(least, most)| least > 0.0 && most >= 100.0 * least);
    let axis = PlotAxis::new(capital(&key.label), Scaled::of(key.unit, &numbers).unit);
    let x = if ratios { axis.log() } else { axis };
    let figures = result.figures();
    let mut titles: Vec<&PlotOf> = Vec::new();
    for plot in figures.iter().filter_map(|column| column.plot.as_ref()) {
        if !titles.iter().any(|known| known.title == plot.title) {
            titles.push(plot);
        }
    }
    // what a fault is looked for by comes first
    titles.sort_by_key(|plot| plot.axis != LINES);
    let of_title = |of: &PlotOf| {
        let same = |column: &&NamedColumn| column.plot.as_ref().is_some_and(|plot| plot.title == of.title);
        let columns: Vec<&NamedColumn> = figures.iter().filter(same).collect();
        let unit = columns.first().map_or("", |column| column.unit);
        let families = columns.iter().flat_map(|column| families(result, &varied, place, column));
        let families = families.filter(|family| family.points.iter().any(|point| point.y.is_finite()));
        draw(Plot::new(of.title.clone(), x.clone(), PlotAxis::new(of.axis, unit)), families.collect(), key)
    };
    let mut plots: Vec<Plot> = titles.into_iter().map(of_title).filter(|plot| !plot.curves.is_empty()).collect();
    let errors = figures.iter().find(|column| column.name == ERROR).map(|column| &column.values);
    if let Some(Values::Numbers(errors)) = errors {
        let known = || errors.iter().copied().filter(|error| error.is_finite());
        for plot in plots.iter_mut().filter(|_| known().next().is_some()) {
            let [least, most] = [known().fold(f64::INFINITY, f64::min), known().fold(0.0, f64::max)];
            let [least, most] = [least, most].map(|error| significant(100.0 * error, 2));
            let caption = plot.caption.get_or_insert_default();
            let range = if least == most { most } else { format!("{least} to {most}") };
            *caption += &format!(" The estimated error of the points' signals is {range} % of their RMS.");
        }
    }
    plots
}

/// The points of a curve.
struct Family {
    name: String,
    points: Vec<At>,
}

#[derive(Clone, Copy)]
struct At {
    x: f64,
    y: f64,
    indicated: bool,
}

/// The curves of one figure, one a combination of the other axes' values, in the order of the points.
fn families(result: &SweepResult, varied: &[NamedColumn], place: usize, column: &NamedColumn) -> Vec<Family> {
    let Values::Numbers(values) = &column.values else {
        return Vec::new();
    };
    let others: Vec<&NamedColumn> = {
        let axes = varied.iter().zip(&result.plan.axes).enumerate();
        axes.filter(|(other, (_, axis))| *other != place && axis.values.len() > 1)
            .map(|(_, (column, _))| column)
            .collect()
    };
    let Values::Numbers(at) = &varied[place].values else {
        return Vec::new();
    };
    let mut families: Vec<Family> = Vec::new();
    for (row, (&x, &y)) in at.iter().zip(values).enumerate() {
        let mut name = column.plot.as_ref().map_or_else(String::new, |plot| plot.curve.clone());
        for other in &others {
            name.push_str(&format!(", {} = {}", short_name(&other.label), in_words(other, row)));
        }
        let point = At { x, y, indicated: column.indicated[row] && y.is_finite() };
        match families.iter_mut().find(|family| family.name == name) {
            Some(family) => family.points.push(point),
            None => families.push(Family { name, points: vec![point] }),
        }
    }
    for family in &mut families {
        family.points.sort_by(|a, b| a.x.total_cmp(&b.x));
    }
    families
}

/// A value of a column with its unit.
pub(super) fn in_words(column: &NamedColumn, row: usize) -> String {
    match &column.values {
        Values::Numbers(numbers) => Scaled::of(column.unit, numbers).words(numbers[row]),
        Values::Texts(texts) => texts[row].clone(),
    }
}

/// The plot with its curves, the strongest ones where there are too many.
fn draw(mut plot: Plot, mut families: Vec<Family>, key: &NamedColumn) -> Plot {
    let left_out = families.len().saturating_sub(MOST_CURVES);
    if left_out > 0 {
        let largest = |family: &Family| family.points.iter().map(|point| point.y).fold(f64::NEG_INFINITY, f64::max);
        families.sort_by(|a, b| largest(b).total_cmp(&largest(a)));
        families.truncate(MOST_CURVES);
    }
    let scaled = match &key.values {
        Values::Numbers(numbers) => Scaled::of(key.unit, numbers),
        Values::Texts(_) => Scaled::of("", &[]),
    };
    let points = |points: &[At]| {
        let x = points.iter().map(|point| point.x / scaled.factor).collect();
        (Abscissa::Points(x), points.iter().map(|point| point.y).collect::<Vec<f64>>())
    };
    for (number, family) in families.iter().enumerate() {
        let (x, y) = points(&family.points);
        let labels = family.points.iter().map(|point| format!("{}, {}", family.name, scaled.words(point.x)));
        let symbol = SYMBOLS[(number / COLOURS) % SYMBOLS.len()];
        let style = if (number / COLOURS).is_multiple_of(2) { CurveStyle::Line } else { CurveStyle::Dashed };
        let line = Curve::new(family.name.clone(), x.clone(), y.clone()).style(style).colour(number);
        plot = plot.curve(line).curve(Curve::new("", x, y).points(symbol).colour(number).labels(labels.collect()));
    }
    let indicated: Vec<At> =
        families.iter().flat_map(|family| &family.points).filter(|at| at.indicated).copied().collect();
    let mut caption = format!("{} over the {}.", plot.y.label, key.label);
    if !indicated.is_empty() {
        let (x, y) = points(&indicated);
        plot = plot.curve(Curve::new("fault indicated", x, y).points(Symbol::Ring).colour(COLOURS - 1));
        let part = if plot.y.label == LINES { " of that part" } else { "" };
        caption.push_str(&format!(" A ring is around points at which the verdict indicates a fault{part}."));
    }
    if left_out > 0 {
        caption.push_str(&format!(" {left_out} curves more, all below these, are in sweep.csv alone."));
    }
    plot.caption(caption)
}

#[cfg(test)]
mod tests {
    use super::super::result::tests::{dents, four};
    use super::{Abscissa, Symbol, plots};

    #[test]
    fn a_curve_a_figure_and_combination() {
        let plots = plots(&four());
        assert_eq!(plots.len(), 1);
        let lines = plots[0].curves.iter().filter(|curve| !curve.name.is_empty());
        let names: Vec<&str> = lines.map(|curve| curve.name.as_str()).collect();
        assert_eq!(
            names,
            [
                "mode 1, element = exact-arc",
                "mode 1, element = raveendranath",
                "mode 2, element = exact-arc",
                "mode 2, element = raveendranath",
                // the first element has no third frequency anywhere
                "mode 3, element = raveendranath",
            ]
        );
        assert_eq!(plots[0].curves[0].x, Abscissa::Points(vec![36.0, 72.0]));
        assert!((plots[0].curves[0].y[0] - 8200.5).abs() < 1e-9);
        assert!(plots[0].curves[0].y[1].is_nan(), "the point failed");
        assert_eq!(plots[0].curves[1].symbol, Symbol::Dot);
    }

    #[test]
    fn the_amplitude_of_a_faults_line_stands_over_what_was_varied_in_its_unit() {
        let plots = plots(&dents());
        let lines = plots.iter().find(|plot| plot.title.starts_with("Envelope at the lines")).unwrap();
        assert_eq!(lines.title, plots[0].title, "what a fault is looked for by comes first");
        assert_eq!([lines.x.label.as_str(), &lines.x.unit], ["Depth of the dent", "µm"]);
        assert_eq!(
            lines.caption.as_deref().map(|text| text.starts_with("Envelope amplitude over the depth of the dent. ")),
            Some(true)
        );
        let Abscissa::Points(depths) = &lines.curves[0].x else { panic!("{:?}", lines.curves[0].x) };
        assert!(depths.iter().zip([5.0, 15.0]).all(|(depth, typed)| (depth - typed).abs() < 1e-9), "{depths:?}");
        assert_eq!([lines.y.label.as_str(), &lines.y.unit], ["Envelope amplitude", "m/s^2"]);
        let named = lines.curves.iter().filter(|curve| !curve.name.is_empty());
        let names: Vec<&str> = named.map(|curve| curve.name.as_str()).collect();
        assert_eq!(names, ["BPFO", "BPFI", "fault indicated"]);
        let error = "The estimated error of the points' signals is 1.3 to 2.0 % of their RMS.";
        assert!(lines.caption.as_ref().unwrap().ends_with(error), "{:?}", lines.caption);
        assert_eq!(lines.curves[0].y, [2.0, 20.0]);
        assert_eq!(lines.curves[1].labels, ["BPFO, 5 µm", "BPFO, 15 µm"]);
        let ring = lines.curves.last().unwrap();
        assert_eq!((ring.symbol, &ring.y), (Symbol::Ring, &vec![20.0]), "the verdict at 15 µm alone names the race");
    }
}
