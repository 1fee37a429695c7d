//! The still pictures of a view: the mesh with its groups, and the first mode shapes side by side.

use std::fmt::Write;

use super::ModeShapeView;
use super::camera::{Camera, NAMES, Vector, dot};
use super::palette;
use super::picture::{self, BANDS, Colouring, Frame};
use super::surface::{Surface, bounds};
use crate::report::number::display_unit;
use crate::report::svg::escape;
use crate::report::svg_drawing::round_length;

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

/// The mesh with its groups.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::report) struct MeshPicture {
    pub(in crate::report) svg: String,
    /// How the elements' edges are shown, in words.
    pub(in crate::report) edges: &'static str,
}

/// A mode shape in a still picture.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub(in crate::report) struct Still {
    svg: String,
    title: String,
    note: String,
}

/// Draws the mesh in its groups' colours, with the axes and a scale bar.
pub(in crate::report) fn mesh_picture(view: &ModeShapeView, surface: &Surface) -> MeshPicture {
    let thin = surface.thinned(MESH_POINTS);
    let camera = chosen(view, &thin);
    let frame = Frame::fit(&thin.points, camera, MESH_SIZE, [34.0, 0.0]);
    let colours: Vec<_> = view
        .groups
        .iter()
        .map(|g| palette::group(g.colour))
        .collect();
    let fine = thin.points.len() == surface.points.len() && wide_apart(&thin, &frame);
    let mut svg = opening(MESH_SIZE, &format!("{}: mesh and groups", view.title));
    let grouped = Colouring::Groups(&colours);
    picture::draw(&mut svg, &frame, &thin, &[], &grouped, fine);
    triad(&mut svg, &camera);
    scale_bar(&mut svg, &frame);
    svg.push_str("</svg>");
    MeshPicture {
        svg,
        edges: if fine {
            "Thin lines are the edges of the elements."
        } else {
            "The edges of the elements are too close together to be drawn."
        },
    }
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
            let title = mode.title();
            let mut svg = opening(STILL_SIZE, &title);
            let coloured = Colouring::Displacement(&unit);
            picture::draw(&mut svg, &frame, &thin, &shown, &coloured, false);
            svg.push_str("</svg>");
            Still {
                svg,
                title,
                note: mode.note.clone(),
            }
        })
        .collect()
}

/// The bar of colours from no displacement to the largest, as the still pictures use them.
pub(in crate::report) fn bar() -> String {
    let mut svg = opening([300.0, 34.0], "Colours: displacement from 0 to the largest");
    let width = 240.0 / BANDS as f64;
    for band in 0..BANDS {
        let colour = palette::viridis((band as f64 + 0.5) / BANDS as f64);
        let x = 30.0 + width * band as f64;
        // Writing to a string cannot fail, here and below.
        let _ = write!(
            svg,
            "<rect x=\"{x:.1}\" y=\"2\" width=\"{:.1}\" height=\"12\" fill=\"{}\"/>",
            width + 0.3,
            palette::hex(colour)
        );
    }
    svg.push_str(
        "<text x=\"30\" y=\"29\" text-anchor=\"middle\">0</text><text x=\"150\" y=\"29\" text-anchor=\"middle\">0.5</text>\
         <text x=\"270\" y=\"29\" text-anchor=\"middle\">largest</text></svg>",
    );
    svg
}

/// The standard view that suits a structure.
fn chosen(view: &ModeShapeView, surface: &Surface) -> Camera {
    let views = Camera::standard(view.up);
    let (low, high) = bounds(&surface.points);
    views[Camera::best(&views, low, high).min(NAMES.len() - 1)]
}

fn opening([width, height]: [f64; 2], title: &str) -> String {
    let title = escape(title);
    format!(
        "<svg class=\"shape\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>"
    )
}

/// Whether the elements' edges are long enough in the picture.
fn wide_apart(surface: &Surface, frame: &Frame) -> bool {
    let length = |[a, b]: &[usize; 2]| {
        let (a, b) = (
            frame.spot(surface.points[*a]),
            frame.spot(surface.points[*b]),
        );
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    let total: f64 = surface.edges.iter().map(length).sum();
    total > EDGE_PITCH * surface.edges.len() as f64
}

/// The directions of x, y and z, at the lower left.
fn triad(svg: &mut String, camera: &Camera) {
    let (x0, y0) = (52.0, MESH_SIZE[1] - 52.0);
    svg.push_str("<g class=\"triad\">");
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let mut e = [0.0; 3];
        e[axis] = 1.0;
        let [u, v, _] = camera.project(e);
        if u.hypot(v) < 0.05 {
            let _ = write!(
                svg,
                "<circle cx=\"{x0}\" cy=\"{y0}\" r=\"3\" class=\"a{axis}\"/><text x=\"{}\" y=\"{}\">{name}</text>",
                x0 - 13.0,
                y0 + 14.0
            );
            continue;
        }
        let end = |length: f64| (x0 + length * u, y0 - length * v);
        let ((x, y), (tx, ty)) = (end(TRIAD), end(TRIAD + 10.0 / u.hypot(v)));
        let _ = write!(
            svg,
            "<path class=\"a{axis}\" d=\"M{x0} {y0}L{x:.1} {y:.1}\"/><text x=\"{tx:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{name}</text>",
            ty + 4.0
        );
    }
    svg.push_str("</g>");
}

/// A bar of a round length, at the lower right. In the isometric view it measures along the axes, which are all
/// shortened alike there.
fn scale_bar(svg: &mut String, frame: &Frame) {
    let right = frame.camera.right;
    let isometric = right.iter().filter(|v| v.abs() > 0.1).count() > 1;
    let shortening = if isometric {
        let [u, v, _] = frame.camera.project([1.0, 0.0, 0.0]);
        dot([u, v, 0.0], [u, v, 0.0]).sqrt()
    } else {
        1.0
    };
    let pixels = frame.scale * shortening;
    let length = round_length(110.0 / pixels);
    let unit = display_unit("m", length);
    let (x2, y) = (MESH_SIZE[0] - 20.0, MESH_SIZE[1] - 34.0);
    let x1 = x2 - length * pixels;
    let _ = write!(
        svg,
        "<g class=\"scale\"><path d=\"M{x1:.1} {top}V{y}H{x2:.1}V{top}\"/><text x=\"{x2:.1}\" y=\"{text}\" text-anchor=\"end\">{} {}{}</text></g>",
        length / unit.factor,
        unit.text,
        if isometric { " along x, y, z" } else { "" },
        top = y - 5.0,
        text = y + 17.0,
    );
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
        assert_eq!(pictures[2].title, "Mode 3 · 330.0 Hz");
        assert!(pictures[2].svg.contains("<title>Mode 3 · 330.0 Hz</title>"));
        assert!(pictures.iter().all(|p| p.svg.contains("class=\"ghost\"")));
        // Blue to yellow: where nothing moves and where most does.
        assert!(pictures[0].svg.matches("<path color=").count() > BANDS);
    }

    #[test]
    fn the_mesh_has_axes_and_a_scale() {
        let mut view = cube(4, 0);
        view.title = "A <b> & c".to_owned();
        let picture = mesh_picture(&view, &Surface::of(&view));
        for text in [
            "aria-label=\"A &lt;b&gt; &amp; c: mesh and groups\"",
            ">x</text>",
            ">z</text>",
            "class=\"ring\"",
            "class=\"fine\"",
            ">0.5 m along x, y, z</text>",
        ] {
            assert!(picture.svg.contains(text), "{text}");
        }
        assert!(picture.edges.starts_with("Thin lines"));
    }

    #[test]
    fn pictures_of_large_surfaces_stay_small() {
        let view = cube(120, 1);
        let surface = Surface::of(&view);
        assert_eq!(surface.triangles.len(), 172_800);
        let mesh = mesh_picture(&view, &surface);
        assert!(mesh.svg.len() < 900_000, "{}", mesh.svg.len());
        assert!(!mesh.svg.contains("class=\"fine\""));
        let mode = &stills(&view, &surface)[0];
        assert!(mode.svg.len() < 400_000, "{}", mode.svg.len());
    }
}
