//! Where things stand in a plot: ranges, units, margins, and the map from values to pixels.

use serde::Serialize;

use super::number::{DisplayUnit, display_unit, with_unit};
use super::ticks::{self, Tick};
use super::{Abscissa, Axis, Curve, CurveStyle, Level, Marker, Plot, Raster, ReportError, Scale};

/// Size of a plot, in pixels of its own coordinates; the page scales it.
pub(super) const WIDTH: f64 = 920.0;
/// Height of the plotting area.
const AREA_HEIGHT: f64 = 250.0;
const TALL_AREA_HEIGHT: f64 = 430.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 18.0;
/// Room for the bar of a picture's colours, right of the area.
pub(super) const BAR_ROOM: f64 = 88.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 46.0;
/// Height of a row of marker labels, and most rows.
const MARKER_ROW: f64 = 15.0;
const MOST_MARKER_ROWS: usize = 6;
/// Width of a character of a marker label, pixels; generous, for the fonts that a reader may have.
const MARKER_CHARACTER: f64 = 6.4;
/// Part of the range left free below and above the curves.
const HEADROOM: f64 = 0.06;

/// Ticks wanted on the x axis and on the y axis.
const TICKS: [usize; 2] = [9, 6];
/// Part of the x range that is added to end on a round number.
const SNAP: f64 = 0.005;

/// An axis as it is shown: range and title in shown units. The script of the page gets what is not skipped.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct AxisView {
    pub(super) log: bool,
    pub(super) low: f64,
    pub(super) high: f64,
    /// Shown value = value / factor.
    #[serde(skip)]
    pub(super) factor: f64,
    /// Unit of the shown values ("" for none).
    pub(super) unit: String,
    #[serde(skip)]
    pub(super) title: String,
    /// Of an axis over time or frequency: what one over a difference of shown values is.
    #[serde(skip_serializing_if = "Option::is_none")]
    reciprocal: Option<Reciprocal>,
}

/// 1 / difference = factor / difference of shown values, in `unit`.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Reciprocal {
    unit: &'static str,
    factor: f64,
}

/// A marker that is in view: pixels from the left, and its row (0 the lowest), if there is room.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlacedMarker<'a> {
    pub(super) marker: &'a Marker,
    pub(super) x: f64,
    pub(super) label: Option<(usize, f64)>,
}

/// A plot laid out, pixels. The script of the page gets all but the markers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Layout<'a> {
    width: f64,
    pub(super) height: f64,
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
    /// Ticks wanted on the x axis and on the y axis.
    pub(super) ticks: [usize; 2],
    /// Rows of marker labels, height of a row, and width of a character.
    pub(super) rows: usize,
    pub(super) row: f64,
    character: f64,
    pub(super) x: AxisView,
    pub(super) y: AxisView,
    #[serde(skip)]
    pub(super) markers: Vec<PlacedMarker<'a>>,
}

impl AxisView {
    /// Position of a shown value between low (0) and high (1); not finite for what a logarithmic axis cannot show.
    pub(super) fn part(&self, shown: f64) -> f64 {
        if self.log {
            (shown.log10() - self.low.log10()) / (self.high.log10() - self.low.log10())
        } else {
            // halves: the difference of the largest numbers is none
            (0.5 * shown - 0.5 * self.low) / (0.5 * self.high - 0.5 * self.low)
        }
    }

    /// Lines and numbers of the axis, about `wanted`.
    pub(super) fn ticks(&self, wanted: usize) -> Vec<Tick> {
        if self.log { ticks::log(self.low, self.high, wanted) } else { ticks::linear(self.low, self.high, wanted) }
    }

    /// The view of a range that the axis can show, in its unit.
    pub(super) fn new(axis: &Axis, [low, high]: [f64; 2]) -> Self {
        let log = axis.scale == Scale::Log;
        // powers of ten need no prefix; a logarithmic axis of less than a decade has none
        let powers = log && high >= 10.0 * low;
        let largest = if powers { 1.0 } else { low.abs().max(high.abs()) };
        let DisplayUnit { factor, text } = display_unit(&axis.unit, largest);
        let unit = match axis.unit.as_str() {
            "s" => Some("Hz"),
            "Hz" => Some("s"),
            _ => None,
        };
        let reciprocal = unit.map(|unit| Reciprocal { unit, factor: 1.0 / factor });
        let title = with_unit(&axis.label, &text);
        Self { log, low: low / factor, high: high / factor, factor, title, unit: text, reciprocal }
    }
}

impl<'a> Layout<'a> {
    /// Lays a plot out.
    pub(super) fn of(plot: &'a Plot) -> Result<Self, ReportError> {
        for curve in &plot.curves {
            check_length(plot, curve)?;
        }
        let of_raster = |of: fn(&Raster) -> [f64; 2]| plot.raster.as_ref().map(of);
        let x_range = match plot.x.range.or(of_raster(|raster| raster.x)) {
            Some(range) => checked(plot, &plot.x, range)?,
            None => {
                let found = extent(plot, &plot.x, [f64::NEG_INFINITY, f64::INFINITY], |p| p.0)?;
                let dots = plot.curves.iter().any(|c| c.style == CurveStyle::Points);
                let room = if dots { HEADROOM } else { 0.0 };
                snapped(&plot.x, widened(&plot.x, found, room))
            }
        };
        let shown = |level: &&Level| level.at.is_finite() && (plot.y.scale == Scale::Linear || level.at > 0.0);
        let levels = plot.levels.iter().filter(shown).map(|level| level.at);
        let found =
            levels.fold(extent(plot, &plot.y, x_range, |p| p.1)?, |[low, high], at| [low.min(at), high.max(at)]);
        let y_range = match plot.y.range.or(of_raster(|raster| raster.y)) {
            Some(range) => checked(plot, &plot.y, range)?,
            None => widened(&plot.y, found, HEADROOM),
        };
        let x = AxisView::new(&plot.x, x_range);
        let y = AxisView::new(&plot.y, y_range);
        let (markers, rows) = place_markers(plot, &x);
        let top = TOP + MARKER_ROW * rows as f64;
        let area = if plot.tall { TALL_AREA_HEIGHT } else { AREA_HEIGHT };
        Ok(Self {
            width: WIDTH,
            height: top + area + BOTTOM,
            left: LEFT,
            right: WIDTH - RIGHT - plot.raster.as_ref().map_or(0.0, |_| BAR_ROOM),
            top,
            bottom: top + area,
            ticks: TICKS,
            rows,
            row: MARKER_ROW,
            character: MARKER_CHARACTER,
            x,
            y,
            markers,
        })
    }

    /// Pixels from the left, for a shown value.
    pub(super) fn x_px(&self, shown: f64) -> f64 {
        self.left + self.x.part(shown) * (self.right - self.left)
    }

    /// Pixels from the top, for a shown value.
    pub(super) fn y_px(&self, shown: f64) -> f64 {
        self.bottom - self.y.part(shown) * (self.bottom - self.top)
    }
}

fn check_length(plot: &Plot, curve: &Curve) -> Result<(), ReportError> {
    match &curve.x {
        Abscissa::Points(x) if x.len() != curve.y.len() => Err(ReportError(format!(
            "plot \"{}\": curve \"{}\" has {} abscissas for {} ordinates",
            plot.title,
            curve.name,
            x.len(),
            curve.y.len()
        ))),
        _ => Ok(()),
    }
}

/// A range given by the caller, if the axis can show it.
pub(super) fn checked(plot: &Plot, axis: &Axis, [from, to]: [f64; 2]) -> Result<[f64; 2], ReportError> {
    let positive = axis.scale == Scale::Linear || from > 0.0;
    if from.is_finite() && to.is_finite() && from < to && positive {
        Ok([from, to])
    } else {
        Err(ReportError(format!("plot \"{}\": axis \"{}\" cannot show {from} to {to}", plot.title, axis.label)))
    }
}

/// Lowest and highest value of one coordinate over the points that both axes can show, x in `x_range`.
fn extent(
    plot: &Plot,
    axis: &Axis,
    x_range: [f64; 2],
    coordinate: impl Fn((f64, f64)) -> f64,
) -> Result<[f64; 2], ReportError> {
    let can_show = |axis: &Axis, v: f64| v.is_finite() && (axis.scale == Scale::Linear || v > 0.0);
    let found = plot
        .curves
        .iter()
        .flat_map(|curve| (0..curve.y.len()).map(move |k| (curve.x_at(k), curve.y[k])))
        .filter(|(x, y)| can_show(&plot.x, *x) && can_show(&plot.y, *y))
        .filter(|(x, _)| (x_range[0]..=x_range[1]).contains(x))
        .map(coordinate)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
    // A range set by the caller needs no data of its own, but a plot of nothing is a mistake.
    let fixed = axis.range.is_some() || plot.raster.is_some();
    if found[0] <= found[1] || fixed && plot.curves.is_empty() {
        Ok(found)
    } else {
        let what = "has nothing to draw: no finite point (positive on a logarithmic axis) in its range";
        Err(ReportError(format!("plot \"{}\" {what}", plot.title)))
    }
}

/// A range found in data with `headroom` (part of it) at both ends; zero kept as the end of what is never negative and
/// comes near it; a single value given some width.
fn widened(axis: &Axis, [low, high]: [f64; 2], headroom: f64) -> [f64; 2] {
    if axis.scale == Scale::Log {
        let room = if high > low * (1.0 + 1e-9) {
            // the quotient of the largest number and the least is none
            10_f64.powf(headroom * (high.log10() - low.log10()))
        } else {
            2.0
        };
        return [(low / room).max(f64::MIN_POSITIVE), (high * room).min(f64::MAX)];
    }
    let width = (high - low).min(f64::MAX);
    if width <= 1e-9 * low.abs().max(high.abs()) {
        let half = if high.abs() > 0.0 { 0.1 * high.abs() } else { 1.0 };
        return [(low - half).max(-f64::MAX), (high + half).min(f64::MAX)];
    }
    let room = headroom * width;
    let from_zero = headroom > 0.0 && low >= 0.0 && low < 0.3 * high;
    let low = if from_zero { 0.0 } else { low - room };
    [low.max(-f64::MAX), (high + room).min(f64::MAX)]
}

/// A range whose end misses a round number by less than half a percent, as the last sample of a signal does, taken up
/// to it.
fn snapped(axis: &Axis, [low, high]: [f64; 2]) -> [f64; 2] {
    let near = SNAP * (high - low);
    let round = |from: f64, to: f64| {
        let ticks = ticks::linear(from, to, TICKS[0]);
        ticks.first().map(|first| first.at).zip(ticks.last().map(|last| last.at))
    };
    match (axis.scale, round(low - near, high + near)) {
        (Scale::Linear, Some((first, last))) => [low.min(first), high.max(last)],
        _ => [low, high],
    }
}

/// Markers in view from left to right, each with the lowest row in which its label meets no other; and the number of
/// rows in use. A label without room in six rows is left out; its line is drawn.
fn place_markers<'a>(plot: &'a Plot, x: &AxisView) -> (Vec<PlacedMarker<'a>>, usize) {
    let area = [LEFT, WIDTH - RIGHT];
    let mut markers: Vec<&Marker> = plot.markers.iter().collect();
    markers.sort_by(|a, b| a.at.total_cmp(&b.at));
    let mut row_ends: Vec<f64> = Vec::new();
    let mut placed = Vec::new();
    for marker in markers {
        let part = x.part(marker.at / x.factor);
        if !(0.0..=1.0).contains(&part) {
            continue;
        }
        let at = area[0] + part * (area[1] - area[0]);
        let half = 0.5 * MARKER_CHARACTER * marker.label.chars().count() as f64;
        let centre = at.clamp(area[0] + half.min(400.0), area[1] - half.min(400.0));
        let free = row_ends.iter().position(|end| centre - half > end + 6.0);
        let row = free.or_else(|| {
            (row_ends.len() < MOST_MARKER_ROWS).then(|| {
                row_ends.push(f64::NEG_INFINITY);
                row_ends.len() - 1
            })
        });
        if let Some(row) = row {
            row_ends[row] = centre + half;
        }
        placed.push(PlacedMarker { marker, x: at, label: row.map(|row| (row, centre)) });
    }
    (placed, row_ends.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(x: Axis, y: Axis, ordinates: &[f64]) -> Plot {
        let even = Abscissa::Even { start: 0.0, step: 100.0 };
        Plot::new("Spectrum", x, y).curve(Curve::new("P1", even, ordinates.to_vec()))
    }

    fn message(plot: &Plot) -> String {
        Layout::of(plot).expect_err("must fail").to_string()
    }

    #[test]
    fn ranges_fit_the_data_and_units_get_prefixes() {
        let ordinates: Vec<f64> = (0..401).map(|k| 2e-6 * f64::from(k % 50)).collect();
        let plot = plot(Axis::new("Frequency", "Hz"), Axis::new("Displacement", "m"), &ordinates);
        let layout = Layout::of(&plot).expect("a valid plot");
        assert_eq!(layout.x.title, "Frequency [kHz]");
        assert!((layout.x.high - 40.0).abs() < 1e-9);
        assert_eq!(layout.y.title, "Displacement [µm]");
        assert!(layout.y.low.abs() < 1e-12 && (layout.y.high - 98.0 * 1.06).abs() < 1e-9);
        assert!((layout.x_px(40.0) - layout.right).abs() < 1e-9);
        assert!((layout.y_px(0.0) - layout.bottom).abs() < 1e-9);
    }

    #[test]
    fn a_signal_that_ends_a_sample_early_is_shown_to_the_round_number() {
        let even = Abscissa::Even { start: 2.2, step: 1e-3 };
        let curve = Curve::new("P1", even, (0..600).map(f64::from).collect());
        let plot = Plot::new("Signal", Axis::new("Time", "s"), Axis::new("a", "")).curve(curve);
        let layout = Layout::of(&plot).expect("a valid plot");
        assert!((layout.x.low - 2.2).abs() < 1e-9 && (layout.x.high - 2.8).abs() < 1e-9);
    }

    #[test]
    fn ordinates_outside_the_shown_abscissas_do_not_count() {
        let plot = plot(Axis::new("f", "Hz").range(100.0, 300.0), Axis::new("a", ""), &[99.0, 1.0, 2.0, 1.5, 50.0]);
        let layout = Layout::of(&plot).expect("a valid plot");
        assert!(layout.y.high < 3.0);
    }

    #[test]
    fn a_logarithmic_axis_of_less_than_a_decade_gets_a_prefix() {
        let of = |sizes: [f64; 2]| {
            let curve = Curve::new("a", Abscissa::Points(sizes.to_vec()), vec![1.0, 2.0]);
            let axis = Axis::new("Step", "s").log();
            let plot = Plot::new("Steps", axis, Axis::new("e", "")).curve(curve);
            Layout::of(&plot).expect("a valid plot").x
        };
        let narrow = of([8e-8, 3e-7]);
        assert_eq!(narrow.title, "Step [ns]");
        assert!((narrow.low - 80.0).abs() < 1e-9 && (narrow.high - 300.0).abs() < 1e-9);
        assert_eq!(of([8e-8, 3e-6]).title, "Step [s]");
    }

    #[test]
    fn log_axes_leave_out_what_is_not_positive() {
        let plot = plot(Axis::new("f", "Hz").log(), Axis::new("a", "").log(), &[1e6, 1e-3, 0.0, -4.0, 10.0]);
        let layout = Layout::of(&plot).expect("a valid plot");
        assert!((layout.x.low - 100.0).abs() < 1e-9 && (layout.x.high - 400.0).abs() < 1e-9);
        assert!(layout.y.low < 1e-3 && layout.y.low > 1e-4 && layout.y.high > 10.0 && layout.y.high < 100.0);
    }

    #[test]
    fn marker_labels_do_not_overlap() {
        let mut plot = plot(Axis::new("f", "Hz"), Axis::new("a", ""), &[1.0; 5]);
        for (at, label) in [
            (200.0, "outer 1×"),
            (205.0, "shaft 3×"),
            (210.0, "ball"),
            (390.0, "a label at the far right"),
            (900.0, "unseen"),
        ] {
            plot = plot.marker(Marker::new(at, label));
        }
        let layout = Layout::of(&plot).expect("a valid plot");
        let rows: Vec<_> = layout.markers.iter().map(|m| m.label.map(|l| l.0)).collect();
        assert_eq!(rows, [Some(0), Some(1), Some(2), Some(0)]);
        assert_eq!(layout.rows, 3);
        let last = layout.markers[3].label.map_or(0.0, |l| l.1);
        assert!(last + 12.0 * MARKER_CHARACTER <= layout.right + 1e-9);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let axes = || (Axis::new("f", "Hz"), Axis::new("a", ""));
        let (x, y) = axes();
        assert_eq!(
            message(&plot(x, y, &[f64::NAN])),
            "plot \"Spectrum\" has nothing to draw: no finite point (positive on a logarithmic axis) in its range"
        );
        let (x, y) = axes();
        assert_eq!(message(&plot(x.range(3.0, 1.0), y, &[1.0])), "plot \"Spectrum\": axis \"f\" cannot show 3 to 1");
        let (x, y) = axes();
        assert_eq!(
            message(&plot(x, y.log().range(0.0, 1.0), &[1.0, 2.0])),
            "plot \"Spectrum\": axis \"a\" cannot show 0 to 1"
        );
        let (x, y) = axes();
        let short = Curve::new("P1", Abscissa::Points(vec![1.0]), vec![1.0, 2.0]);
        assert_eq!(
            message(&Plot::new("Spectrum", x, y).curve(short)),
            "plot \"Spectrum\": curve \"P1\" has 1 abscissas for 2 ordinates"
        );
    }

    #[test]
    fn a_single_value_gets_some_width() {
        let (x, y) = (Axis::new("f", "Hz"), Axis::new("a", ""));
        let plot = plot(x, y, &[5.0]);
        let layout = Layout::of(&plot).expect("a valid plot");
        assert!(layout.x.low < layout.x.high && layout.y.low < 5.0 && layout.y.high > 5.0);
    }

    /// Where quotients and differences of the values are no numbers.
    #[test]
    fn the_widest_ranges_keep_their_places() {
        let of = |y: Axis, values: &[f64]| {
            let plot = plot(Axis::new("f", "Hz"), y, values);
            let y = Layout::of(&plot).expect("a valid plot").y;
            (y.low, y.high, y.part(0.0))
        };
        let axis = || Axis::new("a", "Hz");
        let (low, high, _) = of(axis().log(), &[1e-160, 1e160]);
        assert!(low > 1e-200 && high < 1e200, "{low:e} {high:e}");
        let (_, high, _) = of(axis().log(), &[1.0, f64::MAX]);
        assert!(high.is_finite());
        let (.., middle) = of(axis(), &[-f64::MAX, f64::MAX]);
        assert!((middle - 0.5).abs() < 1e-12, "{middle}");
        let (low, high, _) = of(axis(), &[f64::MAX]);
        assert!(low < high && high.is_finite());
    }
}
