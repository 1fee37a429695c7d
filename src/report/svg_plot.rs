//! Draws a plot as SVG. The script of the page draws the same picture again when the reader zooms.

use std::fmt::Write;

use super::layout::{Layout, PlacedMarker, WIDTH};
use super::palette::COLOURS;
use super::svg::{self, Path, escape};
use super::ticks::Tick;
use super::{Curve, CurveStyle, Plot, ReportError, decimate, raster};

/// Most points of a curve in the picture: two a pixel column.
const MOST_POINTS: usize = 2 * WIDTH as usize;

/// Lines of the grid that lie over a picture.
const FAINT: &str = " stroke-opacity=\"0.2\"";

/// The SVG element of a plot; `id` must be unique on the page.
///
/// # Errors
/// [`ReportError`] for a picture that cannot be shown.
pub(super) fn draw(plot: &Plot, layout: &Layout, id: &str) -> Result<String, ReportError> {
    let mut out = format!(
        "<svg class=\"plot\" viewBox=\"0 0 {WIDTH} {}\" role=\"img\" tabindex=\"0\" aria-label=\"{}\">",
        layout.height,
        escape(&plot.title)
    );
    let (left, top) = (layout.left, layout.top);
    let (width, height) = (layout.right - left, layout.bottom - top);
    let area = [left, top, width, height];
    // Writing to a string cannot fail, here and below.
    let _ = write!(out, "<clipPath id=\"{id}-clip\">");
    svg::rect(&mut out, "", area, "");
    out.push_str("</clipPath>");
    svg::rect(&mut out, "class=\"area\"", area, "");
    out.push_str("<g class=\"view\">");
    if let Some(raster) = &plot.raster {
        out.push_str(&raster::picture(raster, plot, layout, id)?);
    }
    grid(&mut out, plot, layout);
    markers(&mut out, layout);
    levels(&mut out, plot, layout);
    let _ = write!(out, "<g clip-path=\"url(#{id}-clip)\">");
    for (k, curve) in plot.curves.iter().enumerate() {
        draw_curve(&mut out, curve, layout, k);
    }
    out.push_str("</g></g>");
    svg::rect(&mut out, "class=\"frame\"", area, "");
    if let Some(raster) = &plot.raster {
        raster::bar(&mut out, raster, plot, layout, id)?;
    }
    svg::text(&mut out, svg::TITLE, [left + 0.5 * width, layout.height - 8.0], &layout.x.title);
    svg::upward(&mut out, svg::TITLE, [16.0, top + 0.5 * height], &layout.y.title);
    Ok(out + "</svg>")
}

fn grid(out: &mut String, plot: &Plot, layout: &Layout) {
    // faint over a picture
    let faint = plot.raster.as_ref().map_or("", |_| FAINT);
    let look = |tick: &Tick| {
        let class = if tick.label.is_some() { "grid" } else { "fine" };
        format!("class=\"{class}\"{faint}")
    };
    let (left, right, top, bottom) = (layout.left, layout.right, layout.top, layout.bottom);
    for tick in layout.x.ticks(layout.ticks[0]) {
        let x = layout.x_px(tick.at);
        svg::line(out, &look(&tick), [x, top, x, bottom]);
        if let Some(label) = tick.label {
            svg::text(out, "class=\"tick\" text-anchor=\"middle\"", [x, bottom + 16.0], &label);
        }
    }
    for tick in layout.y.ticks(layout.ticks[1]) {
        let y = layout.y_px(tick.at);
        svg::line(out, &look(&tick), [left, y, right, y]);
        if let Some(label) = tick.label {
            svg::text(out, "class=\"tick\" text-anchor=\"end\"", [left - 7.0, y + 4.0], &label);
        }
    }
}

/// Lines first, labels after: a label covers the lines behind it.
fn markers(out: &mut String, layout: &Layout) {
    let top = |placed: &PlacedMarker| layout.top - layout.row * placed.label.map_or(0, |(row, _)| row) as f64;
    let begin = |out: &mut String, placed: &PlacedMarker| {
        let family = placed.marker.family % COLOURS;
        let _ = write!(out, "<g class=\"marker m{family}\">");
    };
    for placed in &layout.markers {
        begin(out, placed);
        let _ = write!(out, "<title>{}</title>", escape(&placed.marker.label));
        svg::line(out, "", [placed.x, top(placed), placed.x, layout.bottom]);
        out.push_str("</g>");
    }
    for placed in &layout.markers {
        if let Some((_, centre)) = placed.label {
            begin(out, placed);
            let at = [centre, top(placed) - 4.0];
            svg::text(out, svg::MIDDLE, at, &placed.marker.label);
            out.push_str("</g>");
        }
    }
}

/// Class of a curve's colour.
pub(super) fn colour(curve: &Curve, number: usize) -> usize {
    curve.colour.unwrap_or(number) % COLOURS
}

/// Horizontal lines, each with its label above its left end.
fn levels(out: &mut String, plot: &Plot, layout: &Layout) {
    for level in &plot.levels {
        let y = tenth(layout.y_px(level.at / layout.y.factor));
        if (layout.top..=layout.bottom).contains(&y) {
            out.push_str("<g class=\"level\">");
            svg::line(out, "", [layout.left, y, layout.right, y]);
            svg::text(out, "", [layout.left + 6.0, y - 4.0], &level.label);
            out.push_str("</g>");
        }
    }
}

fn draw_curve(out: &mut String, curve: &Curve, layout: &Layout, number: usize) {
    let class = colour(curve, number);
    let shown = |k: usize| (layout.x_px(curve.x_at(k) / layout.x.factor), layout.y_px(curve.y[k] / layout.y.factor));
    // Far outside is as good as at the edge of the page, and keeps the numbers short.
    let near = |(x, y): (f64, f64)| (x, y.clamp(-2000.0, 3000.0));
    let points = in_view(curve, layout);
    if curve.style == CurveStyle::Points {
        let open = if curve.symbol.is_open() { " open" } else { "" };
        let _ = write!(out, "<g class=\"dots c{class}{open}\">");
        let path = curve.symbol.path();
        for place in points.into_iter().flatten() {
            let (x, y) = near(shown(place));
            if x.is_finite() && y.is_finite() {
                let look = format!("transform=\"translate({} {})\"", tenth(x), tenth(y));
                let tip = curve.labels.get(place).map_or("", String::as_str);
                svg::path(out, &look, &path, tip);
            }
        }
        out.push_str("</g>");
        return;
    }
    let mut path = Path::default();
    for point in points {
        match point.map(shown).map(near) {
            Some((x, y)) if x.is_finite() && y.is_finite() => path.to(x, y),
            _ => path.gap(),
        }
    }
    let dashed = if curve.style == CurveStyle::Dashed { " dashed" } else { "" };
    let look = format!("class=\"curve c{class}{dashed}\"");
    svg::path(out, &look, &path.data, "");
}

/// Points of a curve to draw, thinned to what a pixel column can show; `None` for a gap. Of curves with rising
/// abscissas only what is in view, and one point more on each side.
fn in_view(curve: &Curve, layout: &Layout) -> Vec<Option<usize>> {
    let x: Vec<f64> = (0..curve.y.len()).map(|k| curve.x_at(k)).collect();
    let range = if x.is_sorted() {
        let first = x.partition_point(|x| x / layout.x.factor < layout.x.low);
        let end = x.partition_point(|x| x / layout.x.factor <= layout.x.high);
        first.saturating_sub(1)..(end + 1).min(x.len())
    } else {
        0..x.len()
    };
    let start = range.start;
    let values = &curve.y[range];
    let kept = if curve.style == CurveStyle::Points {
        (0..values.len()).collect()
    } else {
        decimate::indices(values, MOST_POINTS)
    };
    let mut points = Vec::with_capacity(kept.len());
    let mut last = None;
    for k in kept {
        // A gap that fell between two points that stayed.
        if last.is_some_and(|l: usize| values[l..k].iter().any(|v| !v.is_finite())) {
            points.push(None);
        }
        points.push(Some(start + k));
        last = Some(k);
    }
    points
}

fn tenth(pixels: f64) -> f64 {
    (pixels * 10.0).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::super::curve::{Abscissa, Symbol};
    use super::super::plot::{Axis, Marker};
    use super::*;

    fn svg(plot: &Plot) -> String {
        draw(plot, &Layout::of(plot).expect("a valid plot"), "p1").expect("a picture")
    }

    fn plot(y: Vec<f64>) -> Plot {
        let even = Abscissa::Even { start: 0.0, step: 1e-5 };
        Plot::new("P1 <top>", Axis::new("Time", "s"), Axis::new("Acceleration", "m/s^2"))
            .curve(Curve::new("P1", even, y))
    }

    #[test]
    fn a_long_signal_is_thinned_and_its_spike_stays() {
        let mut y: Vec<f64> = (0..300_000).map(|k| (f64::from(k) * 0.1).sin()).collect();
        y[123_456] = 40.0;
        let svg = svg(&plot(y));
        assert!(svg.len() < 60_000, "{}", svg.len());
        // The spike reaches to the headroom below the top of the area: y = 14 + 250 x 0.06 / 1.12 to a tenth.
        assert!(svg.contains(" 27.4L") || svg.contains(" 27.4\""), "spike");
        assert!(svg.contains("aria-label=\"P1 &lt;top&gt;\""));
        assert!(svg.contains(">Time [s]</text>") && svg.contains(">Acceleration [m/s²]</text>"));
    }

    #[test]
    fn gaps_break_the_line() {
        let svg = svg(&plot(vec![1.0, 2.0, f64::NAN, 3.0, 1.0]));
        let path = svg.split("<path class=\"curve c0\" d=\"").nth(1).expect("a path");
        let data = path.split('"').next().expect("its data");
        assert_eq!(data.matches('M').count(), 2, "{data}");
        assert_eq!(data.matches('L').count(), 2, "{data}");
    }

    #[test]
    fn markers_and_points_are_drawn() {
        let mut marked = plot(vec![1.0, 2.0, 3.0]).marker(Marker::new(1e-5, "a & b").family(2));
        marked.curves[0].style = CurveStyle::Points;
        let svg = svg(&marked);
        assert_eq!(svg.matches("<path transform").count(), 3);
        assert!(svg.contains("<g class=\"marker m2\"><title>a &amp; b</title>"));
    }

    #[test]
    fn points_have_symbols_colours_and_labels_and_levels_are_named() {
        let points = |symbol| {
            let x = Abscissa::Points(vec![1.0, 10.0]);
            Curve::new("a", x, vec![1e-3, 1e-2]).points(symbol)
        };
        let drawn = Plot::new("t", Axis::new("x", "s").log(), Axis::new("y", "").log())
            .curve(points(Symbol::Diamond).labels(vec!["one & two".to_owned()]))
            .curve(points(Symbol::Ring).colour(9))
            .level(1e-5, "floor")
            .tall();
        let drawn = svg(&drawn);
        assert_eq!(drawn.matches("d=\"M0 -4.375").count(), 2);
        assert_eq!(drawn.matches("<title>one &amp; two</title>").count(), 1);
        // nine is three of six colours; a ring is not filled
        assert!(drawn.contains("<g class=\"dots c3 open\">"));
        assert!(drawn.contains(">floor</text></g>"));
        // the range reaches the level, which lies inside the area of 430 from 14 on
        let level = drawn.split("<g class=\"level\"><line ").nth(1).expect("a level");
        let y: f64 = level
            .split("y1=\"")
            .nth(1)
            .and_then(|rest| rest.split('"').next())
            .and_then(|y| y.parse().ok())
            .expect("its place");
        assert!(y > 350.0 && y < 444.0, "{y}");
    }

    #[test]
    fn only_what_is_in_view_is_drawn() {
        let mut part = plot((0..1000).map(f64::from).collect());
        part.x = part.x.range(0.002, 0.003);
        let svg = svg(&part);
        let path = svg.split(" d=\"M").nth(1).and_then(|s| s.split('"').next()).expect("a path");
        assert!((100..105).contains(&path.matches('L').count()), "{}", path.matches('L').count());
    }

    /// Whatever the values, a drawing is small and soon made.
    #[test]
    fn the_ends_of_all_numbers_are_drawn() {
        let ends = [5e-324, 1e-308, 1e-307, 1.0, 1e300, f64::MAX];
        for (low, high) in ends.iter().flat_map(|low| ends.map(|high| (*low, high))) {
            for values in [[low, high], [-high, low]] {
                let mut drawn = plot(values.to_vec());
                let linear = svg(&drawn);
                drawn.y = drawn.y.log();
                let log = svg(&drawn);
                let line = " d=\"M";
                // numbers with fewer digits than others may fall on the frame
                let normal = low.is_normal() && high.is_normal();
                assert!(!normal || linear.contains(line), "{values:?}");
                assert!(!normal || values[0] < 0.0 || log.contains(line), "{values:?}");
                for text in [linear, log] {
                    assert!(text.len() < 20_000, "{values:?}: {}", text.len());
                    assert!(!text.contains("NaN") && !text.contains("inf"), "{values:?}");
                }
            }
        }
    }
}
