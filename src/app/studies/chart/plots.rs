//! The chart as plots.

use super::{Chart, Growth, Parameter, Point, model_name};
use crate::report::{Abscissa, Axis, Curve, CurveStyle, Plot, Symbol, fixed, significant};

/// Methods in the order of the legend, their colour and symbol. What solves its equations has squares, what chooses its
/// steps diamonds.
const METHODS: [(&str, usize, Symbol); 7] = [
    ("exponential", 0, Symbol::Dot),
    ("exponential-adams", 1, Symbol::Dot),
    ("newmark-explicit", 2, Symbol::Dot),
    ("dop853", 3, Symbol::Diamond),
    ("newmark", 0, Symbol::Square),
    ("generalized-alpha", 4, Symbol::Square),
    ("splitting", 5, Symbol::Triangle),
];

/// Colour of what is marked.
const MARK: usize = 5;

/// Error against wall time of all points.
pub(crate) fn work_precision(chart: &Chart) -> Plot {
    let reference = &chart.reference;
    let mut plot = Plot::new(
        "Speed against accuracy",
        Axis::new("Wall time a simulated second, one thread", "s").log(),
        Axis::new("Relative error over the horizon", "").log(),
    )
    .tall()
    .caption(format!(
        "Mean error of the accelerations up to {} kHz over {} starts. The line joins the points that none beats in both. Ring: what the program chooses by itself; frame: the source paper's method, all modes and its step. Below the floor, the difference of the two reference methods, nothing can be told.",
        significant(chart.settings.band_hz / 1e3, 3),
        reference.starts.len().div_ceil(chart.settings.point_stride())
    ));
    let front = chart.front.iter().map(|&place| &chart.points[place]);
    plot.curves.extend(measured("front", front).map(|curve| curve.colour(MARK)));
    for (name, colour, symbol) in METHODS {
        let points = || chart.points.iter().filter(|point| point.model.method.name() == name);
        let labels = points().filter(|point| point.measured().is_some()).map(label).collect();
        plot.curves.extend(measured(name, points()).map(|curve| curve.points(symbol).colour(colour).labels(labels)));
    }
    for (name, place, symbol) in
        [("program's choice", chart.chosen, Symbol::Ring), ("source's method", chart.source, Symbol::Frame)]
    {
        let point = std::iter::once(&chart.points[place]);
        plot.curves.extend(measured(name, point).map(|curve| curve.points(symbol).colour(MARK)));
    }
    if reference.disagreement > 0.0 {
        let floor = significant(reference.disagreement, 2);
        plot = plot.level(reference.disagreement, format!("floor {floor}"));
    }
    let target = significant(chart.settings.target, 2);
    plot.level(chart.settings.target, format!("target {target}"))
}

/// Errors of points over their wall times; `None` if none of them has both.
fn measured<'a>(name: &str, points: impl Iterator<Item = &'a Point>) -> Option<Curve> {
    let (walls, errors): (Vec<f64>, Vec<f64>) = points.filter_map(Point::measured).unzip();
    (!errors.is_empty()).then(|| Curve::new(name, Abscissa::Points(walls), errors))
}

/// What a point is, in a line.
pub(super) fn label(point: &Point) -> String {
    let value = match Parameter::of(&point.model) {
        Parameter::StepS(step) => format!("step {} µs", significant(1e6 * step, 3)),
        Parameter::Tolerance(tolerance) => format!("tolerance {}", significant(tolerance, 2)),
    };
    let (wall, error) = point.measured().unwrap_or((f64::NAN, f64::NAN));
    format!(
        "{}, {}, {value}: error {}, {} s a second",
        point.model.method.name(),
        model_name(&point.model),
        significant(error, 2),
        significant(wall, 3)
    )
}

/// Distance of nearby solutions over time, by start.
pub(crate) fn growth(chart: &Chart) -> Plot {
    let starts = &chart.reference.starts;
    let mut plot = Plot::new(
        "Growth of a small perturbation",
        Axis::new("Time since the start", "s"),
        Axis::new("Distance over that at the start", "").log(),
    )
    .tall()
    .caption(format!(
        "Every coordinate of the start changed by up to {} of itself. The horizon of a start is where its curve crosses the line.",
        significant(chart.settings.ensemble.perturbation, 2)
    ))
    .level(1.0 / chart.settings.target, "1 / target");
    let colours = extremes(chart);
    for (place, start) in starts.iter().enumerate() {
        let curve = Curve::new(
            format!("{} s", fixed(start.start.time_s, 5)),
            Abscissa::Points(start.growth.times_s()),
            positive(start.growth.growth()),
        );
        let marked = colours.iter().find(|(marked, ..)| *marked == place);
        // a legend of twenty names says nothing: all but two are grey and go without
        plot = plot.curve(match marked {
            Some((_, name, colour)) => {
                Curve { name: format!("{name}: start at {}", curve.name), ..curve.colour(*colour) }
            }
            None => Curve { name: String::new(), ..curve.colour(MARK) },
        });
    }
    plot
}

/// Distance of the two reference methods over time: the mean of the starts and the largest.
pub(crate) fn between_methods(chart: &Chart) -> Plot {
    let starts = &chart.reference.starts;
    let growths: Vec<&Growth> = starts.iter().map(|start| &start.between).collect();
    let times = growths.first().map(|growth| growth.times_s());
    let times = times.unwrap_or_default();
    let at = |window: usize| growths.iter().map(move |growth| growth.distances[window]);
    let mean = |window| at(window).sum::<f64>() / growths.len() as f64;
    let largest = |window| at(window).fold(0.0, f64::max);
    let windows = || 0..times.len();
    let curve = |name: &str, values: Vec<f64>| Curve::new(name, Abscissa::Points(times.clone()), positive(values));
    Plot::new(
        "Distance of the two reference methods",
        Axis::new("Time since the start", "s"),
        Axis::new("Distance over the root mean square", "").log(),
    )
    .caption("Over the whole span; the floor is taken inside each start's horizon alone.")
    .curve(curve("mean over the starts", windows().map(mean).collect()))
    .curve(curve("largest", windows().map(largest).collect()).style(CurveStyle::Dashed))
    .level(chart.settings.target, "target")
}

/// The starts with the shortest and the longest horizon, what to call them, and their colours.
fn extremes(chart: &Chart) -> Vec<(usize, &'static str, usize)> {
    let starts = || chart.reference.starts.iter().enumerate();
    let by_horizon = |a: &(usize, &super::StartReference), b: &(usize, &super::StartReference)| {
        a.1.horizon_s.total_cmp(&b.1.horizon_s)
    };
    let shortest = (starts().min_by(by_horizon), "shortest horizon", 1);
    let longest = (starts().max_by(by_horizon), "longest", 0);
    [shortest, longest].into_iter().filter_map(|(start, name, colour)| Some((start?.0, name, colour))).collect()
}

/// Zeros, which a logarithm has no place for, as gaps.
fn positive(values: Vec<f64>) -> Vec<f64> {
    let gap = |value: f64| if value > 0.0 { value } else { f64::NAN };
    values.into_iter().map(gap).collect()
}
