//! The data of a view for the script of the page: whole numbers, each list compressed on its own such that a mode is
//! unpacked when it is looked at.
//!
//! A list of numbers is written as the difference of each from the one `stride` places before it, made positive
//! (0, -1, 1, -2 become 0, 1, 2, 3), the lowest bytes of all first, then the next: neighbours differ little, so that
//! the high bytes are mostly zero. Then zlib (RFC 1950), then base64.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use rayon::prelude::*;
use serde::Serialize;

use super::super::embed::for_script;
use super::super::{ReportError, fixed, svg};
use super::camera::{Camera, NAMES, bounds, diagonal};
use super::surface::{Surface, SurfaceLine};
use super::view::{LegendEntry, ModeShapeView, ShapeMode, legend};

/// Largest coordinate: 16 bits.
const GRID: f64 = 65_535.0;
/// Largest displacement. A step at 10 % of the structure's size is a fortieth of a pixel in 1000.
const STEPS: f64 = 4095.0;
/// Modes that a view keeps before its surface is thinned.
const LEAST_MODES: usize = 8;
/// Points below which a surface is not thinned further.
const LEAST_POINTS: usize = 1000;

/// A view for the page.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::report) struct Packed {
    /// JSON that may stand inside a script element.
    pub(in crate::report) json: String,
    /// What was left out, a sentence.
    pub(in crate::report) left_out: Option<String>,
    /// How many modes it has.
    pub(in crate::report) modes: usize,
}

#[derive(Debug, Serialize)]
struct Data<'a> {
    title: &'a str,
    low: [f64; 3],
    step: f64,
    size: f64,
    amplitude: f64,
    count: usize,
    #[serde(flatten)]
    geometry: Geometry,
    /// First triangle of each group, and the end of the last.
    starts: Vec<usize>,
    lines: &'a [SurfaceLine],
    legend: Vec<LegendEntry>,
    modes: Vec<ModeData>,
    displacement_steps: f64,
    views: Vec<ViewData>,
    start: usize,
    palette: Vec<svg::Rgb>,
}

#[derive(Debug, Serialize)]
struct ModeData {
    label: String,
    frequency: String,
    note: String,
    displacement: String,
}

#[derive(Debug, Serialize)]
struct ViewData {
    name: &'static str,
    #[serde(flatten)]
    camera: Camera,
}

/// Packs a checked view into about `budget` bytes: fewer modes first, down to eight; then a coarser surface; then fewer
/// modes still.
pub(in crate::report) fn pack(view: &ModeShapeView, whole: &Surface, budget: usize) -> Result<Packed, ReportError> {
    let wanted = view.modes.len().min(LEAST_MODES);
    let mut surface = whole.clone();
    let (geometry, modes) = loop {
        let geometry = geometry(&surface);
        let modes = modes(view, &surface, budget.saturating_sub(geometry.bytes()));
        if (modes.len() >= wanted && geometry.bytes() <= budget) || surface.points.len() <= LEAST_POINTS {
            break (geometry, modes);
        }
        let most = (surface.points.len() * 3 / 4).max(LEAST_POINTS);
        surface = whole.thinned(most);
        if surface.points.len() > most {
            break (geometry, modes);
        }
    };
    let kept = modes.len();
    let left_out = left_out(view, whole, &surface, kept);
    let (low, high) = bounds(&surface.points);
    let views = Camera::standard(view.up);
    let data = Data {
        title: &view.title,
        low,
        step: step(&surface),
        size: diagonal(&surface.points),
        amplitude: view.amplitude,
        count: surface.points.len(),
        geometry,
        starts: (0..=view.groups.len()).map(|group| surface.groups.partition_point(|g| *g < group)).collect(),
        lines: &surface.lines,
        legend: legend(view),
        modes,
        displacement_steps: STEPS,
        start: Camera::best(&views, low, high),
        views: NAMES.into_iter().zip(views).map(|(name, camera)| ViewData { name, camera }).collect(),
        palette: svg::VIRIDIS.to_vec(),
    };
    Ok(Packed { json: for_script(&view.title, &data)?, left_out, modes: kept })
}

/// What does not depend on a mode.
#[derive(Debug, Serialize)]
struct Geometry {
    points: String,
    triangles: String,
    edges: String,
    outline: String,
}

impl Geometry {
    fn bytes(&self) -> usize {
        self.points.len() + self.triangles.len() + self.edges.len() + self.outline.len()
    }
}

/// Metres a step of the coordinates.
fn step(surface: &Surface) -> f64 {
    let (low, high) = bounds(&surface.points);
    let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    longest / GRID
}

fn geometry(surface: &Surface) -> Geometry {
    let (low, _) = bounds(&surface.points);
    let step = step(surface).max(f64::MIN_POSITIVE);
    let points = surface.points.iter();
    let points = points.flat_map(|p| (0..3).map(|k| ((p[k] - low[k]) / step).round() as i32));
    let index = |k: &usize| i32::try_from(*k).unwrap_or(i32::MAX);
    Geometry {
        points: packed(points, 3),
        triangles: packed(surface.triangles.iter().flatten().map(index), 3),
        edges: packed(surface.edges.iter().flatten().map(index), 2),
        outline: packed(surface.outline.iter().flatten().map(index), 2),
    }
}

/// The first modes that take at most `budget` bytes together; one at least.
fn modes(view: &ModeShapeView, surface: &Surface, budget: usize) -> Vec<ModeData> {
    let mut left = budget;
    let mut kept = Vec::new();
    let displacement = |mode: &ShapeMode| {
        let unit = surface.displacement(&mode.displacement);
        packed(unit.iter().flatten().map(|v| (v * STEPS).round() as i32), 3)
    };
    for some in view.modes.chunks(LEAST_MODES) {
        let displacements: Vec<String> = some.par_iter().map(displacement).collect();
        for (mode, displacement) in some.iter().zip(displacements) {
            if displacement.len() > left && !kept.is_empty() {
                return kept;
            }
            left = left.saturating_sub(displacement.len());
            kept.push(ModeData {
                label: mode.label.clone(),
                frequency: mode.frequency(),
                note: mode.note.clone(),
                displacement,
            });
        }
    }
    kept
}

fn left_out(view: &ModeShapeView, whole: &Surface, surface: &Surface, modes: usize) -> Option<String> {
    let count = |n: usize| fixed(n as f64, 0);
    let mut parts = Vec::new();
    if modes < view.modes.len() {
        let all = view.modes.len();
        parts.push(format!("the first {modes} of {all} modes"));
    }
    if surface.points.len() < whole.points.len() {
        parts.push(format!(
            "a surface thinned from {} to {} triangles",
            count(whole.triangles.len()),
            count(surface.triangles.len())
        ));
    }
    (!parts.is_empty()).then(|| {
        format!(
            "The view in space shows {}, such that this file stays small; all results are those of the whole model.",
            parts.join(" and ")
        )
    })
}

/// A list of numbers as described on top of this file.
fn packed(values: impl Iterator<Item = i32>, stride: usize) -> String {
    let values: Vec<i32> = values.collect();
    let differences: Vec<u32> = values
        .iter()
        .enumerate()
        .map(|(k, value)| {
            let before = k.checked_sub(stride).map_or(0, |k| values[k]);
            let difference = value.wrapping_sub(before);
            ((difference << 1) ^ (difference >> 31)) as u32
        })
        .collect();
    let mut bytes = Vec::with_capacity(4 * differences.len());
    for shift in [0, 8, 16, 24] {
        bytes.extend(differences.iter().map(|d| (d >> shift) as u8));
    }
    STANDARD.encode(compressed(&bytes))
}

/// Bytes in zlib's format.
pub(in crate::report) fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    // Writing to memory cannot fail.
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::super::samples::cube;
    use super::*;

    /// The way back, as the script goes it.
    fn unpacked(text: &str, stride: usize) -> Vec<i32> {
        let bytes = STANDARD.decode(text).expect("base64");
        let mut raw = Vec::new();
        flate2::read::ZlibDecoder::new(&bytes[..]).read_to_end(&mut raw).expect("zlib");
        let n = raw.len() / 4;
        let mut out: Vec<i32> = Vec::new();
        for k in 0..n {
            let z = (0..4).fold(0_u32, |z, b| z | u32::from(raw[b * n + k]) << (8 * b));
            let difference = (z >> 1) as i32 ^ -((z & 1) as i32);
            let before = k.checked_sub(stride).map_or(0, |k| out[k]);
            out.push(before.wrapping_add(difference));
        }
        out
    }

    fn json(packed: &Packed) -> serde_json::Value {
        serde_json::from_str(&packed.json).expect("valid JSON")
    }

    #[test]
    fn numbers_come_back() {
        let values = [0, -1, 5, i32::MAX, i32::MIN, 65_535, -7, 8];
        assert_eq!(unpacked(&packed(values.into_iter(), 3), 3), values);
    }

    #[test]
    fn points_and_shapes_come_back_to_their_steps() {
        let view = cube(5, 2);
        let surface = Surface::of(&view);
        let data = json(&pack(&view, &surface, 1_000_000).expect("packs"));
        let text = |value: &serde_json::Value| value.as_str().expect("text").to_owned();
        let points = unpacked(&text(&data["points"]), 3);
        let step = data["step"].as_f64().expect("a number");
        for (found, point) in points.chunks_exact(3).zip(&surface.points) {
            // half a step is what rounding may take
            assert!((0..3).all(|k| (f64::from(found[k]) * step - point[k]).abs() <= 0.51 * step));
        }
        let shape = surface.displacement(&view.modes[1].displacement);
        let steps = unpacked(&text(&data["modes"][1]["displacement"]), 3);
        for (found, d) in steps.chunks_exact(3).zip(&shape) {
            assert!((0..3).all(|k| (f64::from(found[k]) / STEPS - d[k]).abs() <= 0.51 / STEPS));
        }
        assert_eq!(unpacked(&text(&data["triangles"]), 3).len(), 3 * view.triangles.len());
        assert_eq!(data["starts"], serde_json::json!([0, 250, 300]));
        assert_eq!(data["modes"][1]["frequency"], "220.0000 Hz");
    }

    #[test]
    fn names_cannot_end_the_script() {
        let mut view = cube(1, 1);
        view.groups[0].name = "</script><b>".to_owned();
        view.modes[0].note = "<!-- x".to_owned();
        let packed = pack(&view, &Surface::of(&view), 1_000_000).expect("packs");
        assert!(!packed.json.contains('<'));
        assert_eq!(json(&packed)["legend"][0]["name"], "</script><b>");
    }

    #[test]
    fn modes_go_first_and_then_the_surface_is_thinned() {
        let view = cube(30, 12);
        let surface = Surface::of(&view);
        let all = pack(&view, &surface, 10_000_000).expect("packs");
        assert_eq!(all.left_out, None);
        assert_eq!(json(&all)["modes"].as_array().map(Vec::len), Some(12));
        let some = pack(&view, &surface, all.json.len() * 9 / 10).expect("packs");
        let kept = json(&some)["modes"].as_array().map_or(0, Vec::len);
        assert!((LEAST_MODES..12).contains(&kept), "{kept}");
        assert_eq!(
            some.left_out.as_deref(),
            Some(&*format!(
                "The view in space shows the first {kept} of 12 modes, such that this file stays small; all results are those of the whole model."
            ))
        );
        let budget = all.json.len() / 4;
        let few = pack(&view, &surface, budget).expect("packs");
        assert!(few.json.len() < budget + 4000, "{} {budget}", few.json.len());
        assert!(json(&few)["modes"].as_array().map_or(0, Vec::len) >= LEAST_MODES);
        let sentence = few.left_out.expect("something is left out");
        assert!(sentence.contains("a surface thinned from 10\u{202f}800 to "), "{sentence}");
    }
}
