//! Draws a plot as SVG. The script of the page draws the same picture again when the reader zooms.
//!
//! Draws values over the area of a plot as a picture, such as a scalogram, with a bar that says what its colours are.

use super::layout::{AxisView, BAR_ROOM, Layout, PlacedMarker, WIDTH, checked};
use super::svg::{COLOURS, Path, VIRIDIS, escape, hex, viridis};
use super::ticks::Tick;
use super::{Curve, CurveStyle, Plot, Raster, ReportError, curve, svg};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

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
        out.push_str(&picture(raster, plot, layout, id)?);
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
        bar(&mut out, raster, plot, layout, id)?;
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
        curve::indices(values, MOST_POINTS)
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

/// Distance of the bar from the area, and its width, pixels.
const BAR: [f64; 2] = [14.0, 14.0];

/// Ticks wanted on the bar.
const BAR_TICKS: usize = 5;

impl Raster {
    /// A view of the colours, with checked range and shape.
    ///
    /// # Errors
    /// [`ReportError`] for values that do not fill rows, or a range that the scale cannot show.
    fn view(&self, plot: &Plot) -> Result<AxisView, ReportError> {
        let fits = self.columns > 0 && !self.values.is_empty();
        if !fits || !self.values.len().is_multiple_of(self.columns) {
            let (title, values, columns) = (&plot.title, self.values.len(), self.columns);
            let what = format!("{values} values do not fill rows of {columns}, which must be at least one");
            return Err(ReportError(format!("plot \"{title}\": {what}")));
        }
        let range = self.colours.range.unwrap_or([f64::NAN; 2]);
        Ok(AxisView::new(&self.colours, checked(plot, &self.colours, range)?))
    }

    /// The picture as a PNG in a data address, its highest row first.
    fn address(&self, plot: &Plot, view: &AxisView) -> Result<String, ReportError> {
        let rows = self.values.chunks(self.columns).rev().flatten();
        let pixels: Vec<u8> = rows
            .map(|value| {
                let part = view.part(value / view.factor);
                // what is not a number becomes zero
                (255.0 * part).round().clamp(0.0, 255.0) as u8
            })
            .collect();
        let height = self.values.len() / self.columns;
        let png = png(&pixels, [self.columns, height])
            .map_err(|_| ReportError(format!("plot \"{}\": its picture cannot be made", plot.title)))?;
        Ok(format!("data:image/png;base64,{}", STANDARD.encode(png)))
    }
}

/// A picture of 256 colours.
fn png(pixels: &[u8], [width, height]: [usize; 2]) -> Result<Vec<u8>, png::EncodingError> {
    let mut out = Vec::new();
    let size = |pixels: usize| u32::try_from(pixels).map_err(std::io::Error::other);
    let mut encoder = png::Encoder::new(&mut out, size(width)?, size(height)?);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    let palette: Vec<u8> = (0..=255).flat_map(|k| viridis(f64::from(k) / 255.0)).collect();
    encoder.set_palette(palette);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(out)
}

/// The picture of a plot that has one, inside its clip path.
pub(super) fn picture(raster: &Raster, plot: &Plot, layout: &Layout, id: &str) -> Result<String, ReportError> {
    let view = raster.view(plot)?;
    let [left, right] = raster.x.map(|x| layout.x_px(x / layout.x.factor));
    let [bottom, top] = raster.y.map(|y| layout.y_px(y / layout.y.factor));
    Ok(format!(
        "<g clip-path=\"url(#{id}-clip)\"><image class=\"raster\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" preserveAspectRatio=\"none\" href=\"{}\"/></g>",
        right - left,
        bottom - top,
        raster.address(plot, &view)?
    ))
}

/// The bar of its colours, right of the area.
pub(super) fn bar(
    out: &mut String,
    raster: &Raster,
    plot: &Plot,
    layout: &Layout,
    id: &str,
) -> Result<(), ReportError> {
    let view = raster.view(plot)?;
    let [gap, width] = BAR;
    let (left, top, height) = (layout.right + gap, layout.top, layout.bottom - layout.top);
    // Writing to a string cannot fail, here and below.
    let _ = write!(out, "<linearGradient id=\"{id}-bar\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">");
    for (k, colour) in VIRIDIS.into_iter().enumerate() {
        let offset = k as f64 / (VIRIDIS.len() - 1) as f64;
        let _ = write!(out, "<stop offset=\"{offset:.4}\" stop-color=\"{}\"/>", hex(colour));
    }
    out.push_str("</linearGradient>");
    let look = format!("class=\"frame\" style=\"fill:url(#{id}-bar)\"");
    svg::rect(out, &look, [left, top, width, height], "");
    for tick in view.ticks(BAR_TICKS) {
        if let Some(label) = tick.label {
            let y = layout.bottom - view.part(tick.at) * height;
            let at = [left + width + 4.0, y + 4.0];
            svg::text(out, "class=\"tick\"", at, &label);
        }
    }
    let at = [layout.right + BAR_ROOM + 8.0, top + 0.5 * height];
    svg::upward(out, svg::TITLE, at, &view.title);
    Ok(())
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

#[cfg(test)]
mod raster_tests {
    use super::super::curve::{Abscissa, Curve};
    use super::super::plot::{Axis, Marker};
    use super::*;

    /// Two rows of three, from 1 to 100 on a logarithmic scale.
    fn plot() -> Plot {
        let colours = Axis::new("Level", "m/s^2").decades_below(100.0, 2.0);
        Plot::new("s", Axis::new("Time", "s"), Axis::new("Frequency", "Hz").log()).raster(Raster {
            x: [2.0, 2.3],
            y: [500.0, 40e3],
            columns: 3,
            values: vec![1.0, 10.0, 100.0, 0.0, f64::NAN, 1e9],
            colours,
        })
    }

    fn decoded(address: &str) -> (png::OutputInfo, Vec<u8>) {
        let data = address.strip_prefix("data:image/png;base64,").unwrap();
        let bytes = STANDARD.decode(data).unwrap();
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        (info, pixels)
    }

    #[test]
    fn the_highest_row_is_on_top_and_values_have_their_colours() {
        let plot = plot();
        let raster = plot.raster.as_ref().unwrap();
        let view = raster.view(&plot).unwrap();
        let (info, pixels) = decoded(&raster.address(&plot, &view).unwrap());
        assert_eq!((info.width, info.height), (3, 2));
        let [least, middle, most] = [0.0, 0.5, 1.0].map(viridis);
        // what is beyond the range, or no number, has the colour of its end
        let expected = [least, least, most, least, middle, most].concat();
        // 127.5 of 255 parts is rounded: the colour of half the range within one
        let near = |(a, b): (&u8, &u8)| a.abs_diff(*b) <= 1;
        assert!(pixels.iter().zip(&expected).all(near), "{pixels:?}");
    }

    #[test]
    fn a_picture_fills_the_area_and_has_its_bar() {
        let ridge = Curve::new("ridge", Abscissa::Points(vec![2.0, 2.3]), vec![1e3, 2e3]);
        let plot = plot().curve(ridge).marker(Marker::new(2.1, "burst"));
        let layout = Layout::of(&plot).unwrap();
        assert!((layout.x.low - 2.0).abs() < 1e-12 && (layout.y.low - 500.0).abs() < 1e-9);
        let svg = plot.to_svg().unwrap();
        let (width, height) = (layout.right - layout.left, layout.bottom - layout.top);
        let size = format!("width=\"{width:.1}\" height=\"{height:.1}\"");
        assert!(svg.contains("<image ") && svg.contains(&size), "{size}");
        assert!(svg.contains("url(#plot-bar)") && svg.contains(">Level [m/s²]</text>"));
        // the curve lies over the picture
        assert!(svg.find("<image ").unwrap() < svg.find("class=\"curve").unwrap());
    }

    #[test]
    fn a_picture_that_does_not_fit_is_an_error() {
        let message = |change: fn(&mut Raster)| {
            let mut plot = plot();
            plot.raster.as_mut().map(change).unwrap();
            plot.to_svg().unwrap_err().to_string()
        };
        let expected = "plot \"s\": 6 values do not fill rows of 4, which must be at least one";
        assert_eq!(message(|raster| raster.columns = 4), expected);
        assert!(message(|raster| raster.values.clear()).contains("0 values"));
        assert!(message(|raster| raster.columns = 0).contains("rows of 0"));
        assert!(message(|raster| raster.colours.range = None).contains("Level"));
    }
}
