//! The data of the plots, for the script of the page: JSON with the numbers as base64 of little-endian floats.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use super::layout::{AxisView, Layout};
use super::plot::is_positive;
use super::svg::COLOURS;
use super::svg_plot::colour;
use super::{Abscissa, Curve, CurveStyle, Family, Level, Plot, ReportError, Sides, curve};

/// Bytes of numbers that all plots of a report may embed; base64 makes four thirds of them, 3.7 MB.
const BUDGET: usize = 2_800_000;

/// Points that the signals of a report may have together such that it embeds them whole beside its other curves.
pub(crate) const SIGNAL_POINTS: usize = 500_000;

#[derive(Debug, Serialize)]
struct PlotData<'a> {
    #[serde(flatten)]
    layout: &'a Layout<'a>,
    curves: Vec<CurveData<'a>>,
    markers: Vec<MarkerData<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    families: Vec<FamilyData>,
    levels: Vec<Level>,
    /// Edges of the picture, whose address the script takes from the SVG.
    #[serde(skip_serializing_if = "Option::is_none")]
    raster: Option<RasterData>,
}

/// In shown units.
#[derive(Debug, Serialize)]
struct RasterData {
    x: [f64; 2],
    y: [f64; 2],
}

/// How a curve is drawn, in the legend too.
#[derive(Debug, Serialize)]
pub(super) struct CurveLook<'a> {
    name: &'a str,
    colour: usize,
    style: &'static str,
    /// Path data of its symbol, of points alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    symbol: Option<String>,
    open: bool,
}

impl<'a> CurveLook<'a> {
    /// Of the curve with this number in its plot, from 0.
    pub(super) fn of(curve: &'a Curve, number: usize) -> Self {
        Self {
            name: &curve.name,
            colour: colour(curve, number),
            style: curve.style.class(),
            symbol: (curve.style == CurveStyle::Points).then(|| curve.symbol.path()),
            open: curve.symbol.is_open(),
        }
    }
}

#[derive(Debug, Serialize)]
struct CurveData<'a> {
    #[serde(flatten)]
    look: CurveLook<'a>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    labels: Vec<&'a str>,
    /// Of even abscissas, in shown units.
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<f64>,
    /// Of others: f64, in shown units.
    #[serde(skip_serializing_if = "Option::is_none")]
    x: Option<String>,
    /// f32, in shown units.
    y: String,
}

#[derive(Debug, Serialize)]
struct MarkerData<'a> {
    at: f64,
    label: &'a str,
    colour: usize,
}

/// In shown units.
#[derive(Debug, Serialize)]
struct FamilyData {
    at: f64,
    colour: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    sides: Option<Sides>,
}

/// Bytes a curve needs in full.
fn size(curve: &Curve) -> usize {
    curve.y.len() * bytes_a_point(curve)
}

fn bytes_a_point(curve: &Curve) -> usize {
    match curve.x {
        Abscissa::Even { .. } => 4,
        Abscissa::Points(_) => 12,
    }
}

/// Bytes that each curve may take such that all together stay within [`BUDGET`]: short curves whole, the rest of the
/// budget shared evenly among the long ones.
pub(super) fn share<'a>(plots: impl Iterator<Item = &'a Plot>) -> usize {
    let mut sizes: Vec<usize> = plots.flat_map(|p| p.curves.iter().map(size)).collect();
    sizes.sort_unstable();
    let mut left = BUDGET;
    for (k, size) in sizes.iter().enumerate() {
        let even = left / (sizes.len() - k);
        if *size > even {
            return even;
        }
        left -= size;
    }
    BUDGET
}

/// The data of one plot as JSON that may stand inside a script element; each curve takes at most `share` bytes.
pub(super) fn json(plot: &Plot, layout: &Layout, share: usize) -> Result<String, ReportError> {
    let curves = plot.curves.iter().enumerate();
    let levels = plot.levels.iter().filter(|level| level.at.is_finite());
    let markers = plot.markers.iter().filter(|m| m.at.is_finite());
    let data = PlotData {
        layout,
        curves: curves.map(|(k, c)| curve_data(c, layout, k, share)).collect(),
        markers: markers
            .map(|marker| MarkerData {
                at: marker.at / layout.x.factor,
                label: &marker.label,
                colour: marker.family % COLOURS,
            })
            .collect(),
        families: family_data(plot, &layout.x),
        levels: levels.map(|level| Level { at: level.at / layout.y.factor, label: level.label.clone() }).collect(),
        raster: plot.raster.as_ref().map(|raster| RasterData {
            x: raster.x.map(|x| x / layout.x.factor),
            y: raster.y.map(|y| y / layout.y.factor),
        }),
    };
    for_script(&plot.title, &data)
}

/// Data as JSON that may stand inside a script element.
pub(super) fn for_script(title: &str, data: &impl Serialize) -> Result<String, ReportError> {
    let failed = |error| ReportError(format!("\"{title}\": data cannot be embedded: {error}"));
    let json = serde_json::to_string(data).map_err(failed)?;
    // "</script" or "<!--" in a name would end the element.
    Ok(json.replace('<', "\\u003c"))
}

/// Names of the families that a plot offers, in the order of the data.
pub(super) fn family_names(plot: &Plot) -> Vec<&str> {
    let shown = plot.families.iter().filter(|family| is_positive(family.fundamental));
    shown.map(|family| family.name.as_str()).collect()
}

/// What the script of the page needs of the families.
fn family_data(plot: &Plot, x: &AxisView) -> Vec<FamilyData> {
    let shown = plot.families.iter().filter(|family| is_positive(family.fundamental));
    let sides = |family: &Family| {
        let sides = family.sides.as_ref()?;
        is_positive(sides.spacing).then(|| Sides { name: sides.name.clone(), spacing: sides.spacing / x.factor })
    };
    shown
        .map(|family| FamilyData {
            at: family.fundamental / x.factor,
            colour: family.family % COLOURS,
            sides: sides(family),
        })
        .collect()
}

fn curve_data<'a>(curve: &'a Curve, layout: &Layout, number: usize, share: usize) -> CurveData<'a> {
    let (most, factor) = (share / bytes_a_point(curve), layout.x.factor);
    let (mut even, mut x, mut labels) = (None, None, Vec::new());
    let y: Vec<f64> = match &curve.x {
        Abscissa::Even { start, step } => {
            let thinned = curve::even(&curve.y, most);
            even = Some((start / factor, step * thinned.stride / factor));
            thinned.values
        }
        Abscissa::Points(all) => {
            let kept = curve::indices(&curve.y, most);
            labels.extend(kept.iter().map_while(|k| curve.labels.get(*k)).map(String::as_str));
            x = Some(base64(kept.iter().flat_map(|k| (all[*k] / factor).to_le_bytes())));
            kept.iter().map(|k| curve.y[*k]).collect()
        }
    };
    let (start, step) = even.unzip();
    let shown = y.iter().map(|v| (v / layout.y.factor) as f32);
    let y = base64(shown.flat_map(f32::to_le_bytes));
    CurveData { look: CurveLook::of(curve, number), labels, start, step, x, y }
}

fn base64(bytes: impl Iterator<Item = u8>) -> String {
    STANDARD.encode(bytes.collect::<Vec<u8>>())
}

#[cfg(test)]
mod tests {
    use super::super::plot::Marker;
    use super::super::{Axis, Report, Section};
    use super::*;

    fn plot(points: usize) -> Plot {
        let even = Abscissa::Even { start: 2.0, step: 1e-5 };
        let y = (0..points).map(|k| (k as f64 * 0.3).sin()).collect();
        Plot::new("t", Axis::new("Time", "s"), Axis::new("a", "m/s^2")).curve(Curve::new("P1", even, y))
    }

    fn embedded(plot: &Plot, share: usize) -> serde_json::Value {
        let layout = Layout::of(plot).expect("a valid plot");
        let json = json(plot, &layout, share).expect("json");
        serde_json::from_str(&json).expect("valid JSON")
    }

    fn numbers(value: &serde_json::Value) -> Vec<f32> {
        let bytes = STANDARD.decode(value.as_str().expect("text")).expect("base64");
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
    }

    #[test]
    fn short_curves_are_whole_and_long_ones_thinned() {
        let data = embedded(&plot(1000), BUDGET);
        let y = numbers(&data["curves"][0]["y"]);
        assert_eq!(y.len(), 1000);
        assert!((f64::from(y[7]) - 2.1_f64.sin()).abs() < 1e-6);
        assert_eq!(data["curves"][0]["step"], 1e-5);
        let data = embedded(&plot(100_000), 40_000);
        assert_eq!(numbers(&data["curves"][0]["y"]).len(), 10_000);
        assert!((data["curves"][0]["step"].as_f64().expect("step") - 1e-4).abs() < 1e-12);
    }

    #[test]
    fn one_over_a_difference_has_its_unit() {
        let reciprocal = |plot: &Plot| embedded(plot, BUDGET)["x"]["reciprocal"].clone();
        let mut short = plot(1000);
        assert_eq!(reciprocal(&short)["unit"], "Hz");
        // from 2 s on; in milliseconds below 0.1 s
        assert_eq!(reciprocal(&short)["factor"], 1.0);
        short.x = Axis::new("Frequency", "Hz");
        short.curves[0].x = Abscissa::Even { start: 0.0, step: 40.0 };
        let data = embedded(&short, BUDGET);
        assert_eq!(data["x"]["unit"], "kHz");
        assert_eq!(data["x"]["reciprocal"]["unit"], "s");
        // 1 / 1 kHz
        assert_eq!(data["x"]["reciprocal"]["factor"], 1e-3);
        assert_eq!(data["y"]["unit"], "m/s²");
        assert!(data["y"]["reciprocal"].is_null() && data["families"].is_null());
        short.x = Axis::new("Order", "");
        assert!(reciprocal(&short).is_null());
    }

    #[test]
    fn the_budget_is_shared() {
        let (short, long) = (plot(1000), plot(800_000));
        assert_eq!(share([&short].into_iter()), BUDGET);
        let each = share([&long, &short, &long].into_iter());
        assert_eq!(each, (BUDGET - 4000) / 2);
        assert_eq!(share(std::iter::empty()), BUDGET);
    }

    #[test]
    fn names_cannot_end_the_script() {
        let mut plot = plot(3).marker(Marker::new(2.0, "<!-- x"));
        plot.curves[0].name = "</script><b>".to_owned();
        let layout = Layout::of(&plot).expect("a valid plot");
        let json = json(&plot, &layout, BUDGET).expect("json");
        assert!(!json.contains('<'));
        let data: serde_json::Value = serde_json::from_str(&json).expect("valid JSON");
        assert_eq!(data["curves"][0]["name"], "</script><b>");
    }

    fn with_families() -> Plot {
        let even = Abscissa::Even { start: 0.0, step: 100.0 };
        Plot::new("Envelope spectrum", Axis::new("Frequency", "Hz"), Axis::new("Amplitude", "m/s^2"))
            .curve(Curve::new("P1", even, vec![1.0; 401]))
            .family(Family::new("</script><b>race", 2500.0, 8).sides("shaft & co", 500.0))
            .family(Family::new("nothing", 0.0, 1))
            .family(Family::new("cage", 400.0, 1).sides("none", f64::NAN))
    }

    #[test]
    fn families_are_in_shown_units_and_those_without_frequency_left_out() {
        let plot = with_families();
        let layout = Layout::of(&plot).expect("a valid plot");
        assert_eq!(family_names(&plot), ["</script><b>race", "cage"]);
        let data = serde_json::to_value(family_data(&plot, &layout.x)).expect("JSON");
        // 40 kHz are shown, in kHz; the eighth of six colours is the third
        let sides = serde_json::json!({"name": "shaft & co", "spacing": 0.5});
        assert_eq!(data, serde_json::json!([{"at": 2.5, "colour": 2, "sides": sides}, {"at": 0.4, "colour": 1}]));
    }

    #[test]
    fn the_page_offers_families_by_name_as_text() {
        let html = |plot| {
            let report = Report::new("t", "c", "0").section(Section::new("S").plot(plot));
            report.to_html().expect("a valid report")
        };
        let page = html(with_families());
        let option = |text| format!("<option value=\"{text}</option>");
        assert!(page.contains(&option("0\">&lt;&#x2f;script&gt;&lt;b&gt;race")));
        assert!(page.contains(&option("1\">cage")));
        assert!(page.contains("aria-label=\"Cursors of figure 1\""));
        assert!(page.contains("<label hidden>A [kHz] <input type=\"number\""));
        assert!(!page.contains("<b>race"));
        let mut bare = with_families();
        bare.families.clear();
        let page = html(bare);
        assert!(!page.contains("<select") && page.contains("Cursors A, B"));
    }
}
