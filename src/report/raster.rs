//! Draws values over the area of a plot as a picture, such as a scalogram, with a bar that says what its colours are.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::layout::{AxisView, BAR_ROOM, Layout, checked};
use super::palette::{VIRIDIS, hex, viridis};
use super::{Plot, Raster, ReportError, svg};

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
