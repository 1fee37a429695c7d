//! The still pictures of a view: the mesh with its groups, and the first mode shapes side by side.

use super::camera::{Camera, NAMES, Vector, bounds};
use super::picture;
use super::picture::{BANDS, Colouring, Frame};
use super::surface::Surface;
use super::view::ModeShapeView;
use crate::report::svg;
use crate::report::svg::ScaleBar;

/// Mode shapes in still pictures.
pub(in crate::report) const MOST_STILLS: usize = 9;
const MESH_SIZE: [f64; 2] = [720.0, 440.0];
const STILL_SIZE: [f64; 2] = [300.0, 225.0];
/// Points of a picture at most: triangles of some 12 square pixels, and a few hundred kilobytes.
const MESH_POINTS: usize = 14_000;
const STILL_POINTS: usize = 5_000;
/// Elements' edges are drawn where they stand so far apart, pixels on average.
const EDGE_PITCH: f64 = 5.0;
/// Length of an axis of the triad, pixels.
const TRIAD: f64 = 34.0;

const SHAPE: &str = "class=\"shape\"";

/// A mode shape in a still picture.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub(in crate::report) struct Still {
    svg: String,
    title: String,
    note: String,
}

/// Draws the mesh in its groups' colours, with the axes and a scale bar; beside it a sentence on the elements' edges.
pub(in crate::report) fn mesh_picture(view: &ModeShapeView, surface: &Surface) -> (String, &'static str) {
    let thin = surface.thinned(MESH_POINTS);
    let camera = chosen(view, &thin);
    let frame = Frame::fit(&thin.points, camera, MESH_SIZE, [34.0, 0.0]);
    let colours: Vec<_> = view.groups.iter().map(|g| svg::group(g.colour)).collect();
    let fine = thin.points.len() == surface.points.len() && wide_apart(&thin, &frame);
    let mut out = svg::opening(SHAPE, MESH_SIZE, &format!("{}: mesh and groups", view.title));
    let grouped = Colouring::Groups(&colours);
    picture::draw(&mut out, &frame, &thin, &[], &grouped, fine);
    triad(&mut out, &camera);
    scale_bar(&mut out, &frame);
    out.push_str("</svg>");
    let edges = match fine {
        true => "Thin lines are the edges of the elements.",
        false => "The edges of the elements are too close together to be drawn.",
    };
    (out, edges)
}

/// Draws the first mode shapes, each to its own largest displacement.
pub(in crate::report) fn stills(view: &ModeShapeView, surface: &Surface) -> Vec<Still> {
    let thin = surface.thinned(STILL_POINTS);
    let camera = chosen(view, &thin);
    let frame = Frame::fit(&thin.points, camera, STILL_SIZE, [5.0, view.amplitude]);
    let modes = view.modes.iter().take(MOST_STILLS);
    modes
        .map(|mode| {
            let unit = thin.displacement(&mode.displacement);
            let metres = view.amplitude * frame.diagonal;
            let shown: Vec<Vector> = unit.iter().map(|d| d.map(|v| v * metres)).collect();
            let title = format!("Mode {} · {}", mode.label, mode.frequency());
            let mut out = svg::opening(SHAPE, STILL_SIZE, &title);
            let coloured = Colouring::Displacement(&unit);
            picture::draw(&mut out, &frame, &thin, &shown, &coloured, false);
            out.push_str("</svg>");
            Still { svg: out, title, note: mode.note.clone() }
        })
        .collect()
}

/// The bar of colours from no displacement to the largest, as the still pictures use them.
pub(in crate::report) fn bar() -> String {
    let title = "Colours: displacement from 0 to the largest";
    let mut out = svg::opening(SHAPE, [300.0, 34.0], title);
    let width = 240.0 / BANDS as f64;
    for band in 0..BANDS {
        let colour = svg::viridis((band as f64 + 0.5) / BANDS as f64);
        let look = format!("fill=\"{}\"", svg::hex(colour));
        let x = 30.0 + width * band as f64;
        svg::rect(&mut out, &look, [x, 2.0, width + 0.3, 12.0], "");
    }
    for (x, text) in [(30.0, "0"), (150.0, "0.5"), (270.0, "largest")] {
        svg::text(&mut out, svg::MIDDLE, [x, 29.0], text);
    }
    out + "</svg>"
}

/// The standard view that suits a structure.
fn chosen(view: &ModeShapeView, surface: &Surface) -> Camera {
    let views = Camera::standard(view.up);
    let (low, high) = bounds(&surface.points);
    views[Camera::best(&views, low, high).min(NAMES.len() - 1)]
}

/// Whether the elements' edges are long enough in the picture.
fn wide_apart(surface: &Surface, frame: &Frame) -> bool {
    let length = |[a, b]: &[usize; 2]| {
        let (a, b) = (frame.spot(surface.points[*a]), frame.spot(surface.points[*b]));
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    let total: f64 = surface.edges.iter().map(length).sum();
    total > EDGE_PITCH * surface.edges.len() as f64
}

/// The directions of x, y and z, at the lower left.
fn triad(out: &mut String, camera: &Camera) {
    let (x0, y0) = (52.0, MESH_SIZE[1] - 52.0);
    out.push_str("<g class=\"triad\">");
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let look = format!("class=\"a{axis}\"");
        let mut e = [0.0; 3];
        e[axis] = 1.0;
        let [u, v, _] = camera.project(e);
        if u.hypot(v) < 0.05 {
            svg::circle(out, &look, [x0, y0], 3.0, "");
            svg::text(out, "", [x0 - 13.0, y0 + 14.0], name);
            continue;
        }
        let end = |length: f64| [x0 + length * u, y0 - length * v];
        let ([x, y], [tx, ty]) = (end(TRIAD), end(TRIAD + 10.0 / u.hypot(v)));
        svg::path(out, &look, &format!("M{x0} {y0}L{x:.1} {y:.1}"), "");
        svg::text(out, svg::MIDDLE, [tx, ty + 4.0], name);
    }
    out.push_str("</g>");
}

/// A bar of a round length, at the lower right. In the isometric view it measures along the axes, which are all
/// shortened alike there.
fn scale_bar(out: &mut String, frame: &Frame) {
    let right = frame.camera.right;
    let isometric = right.iter().filter(|v| v.abs() > 0.1).count() > 1;
    let (shortening, along) = if isometric {
        let [u, v, _] = frame.camera.project([1.0, 0.0, 0.0]);
        (u.hypot(v), " along x, y, z")
    } else {
        (1.0, "")
    };
    let bar = ScaleBar::of(frame.scale * shortening);
    let (x, y) = (MESH_SIZE[0] - 20.0, MESH_SIZE[1] - 34.0);
    out.push_str("<g class=\"scale\">");
    bar.draw(out, [x - bar.pixels, y]);
    let label = format!("{}{along}", bar.label);
    svg::text(out, svg::END, [x, y + 17.0], &label);
    out.push_str("</g>");
}

#[cfg(test)]
mod tests {
    use super::super::samples::cube;
    use super::*;

    #[test]
    fn the_first_modes_are_drawn_and_named() {
        let view = cube(4, 12);
        let pictures = stills(&view, &Surface::of(&view));
        assert_eq!(pictures.len(), MOST_STILLS);
        assert_eq!(pictures[2].title, "Mode 3 · 330.0000 Hz");
        assert!(pictures[2].svg.contains("<title>Mode 3 · 330.0000 Hz</title>"));
        assert!(pictures.iter().all(|p| p.svg.contains("class=\"ghost\"")));
        // Blue to yellow: where nothing moves and where most does.
        assert!(pictures[0].svg.matches("<path color=").count() > BANDS);
    }

    #[test]
    fn the_mesh_has_axes_and_a_scale() {
        let mut view = cube(4, 0);
        view.title = "A <b> & c".to_owned();
        let (svg, edges) = mesh_picture(&view, &Surface::of(&view));
        for text in [
            "aria-label=\"A &lt;b&gt; &amp; c: mesh and groups\"",
            ">x</text>",
            ">z</text>",
            "class=\"ring\"",
            "class=\"fine\"",
            ">0.5 m along x, y, z</text>",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(edges.starts_with("Thin lines"));
    }

    #[test]
    fn pictures_of_large_surfaces_stay_small() {
        let view = cube(120, 1);
        let surface = Surface::of(&view);
        assert_eq!(surface.triangles.len(), 172_800);
        let (svg, _) = mesh_picture(&view, &surface);
        assert!(svg.len() < 900_000, "{}", svg.len());
        assert!(!svg.contains("class=\"fine\""));
        let mode = &stills(&view, &surface)[0];
        assert!(mode.svg.len() < 400_000, "{}", mode.svg.len());
    }
}
