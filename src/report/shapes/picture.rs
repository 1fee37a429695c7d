//! One picture of a structure as SVG: hidden surfaces removed by a depth buffer, what is left painted from far to near,
//! each triangle cut where its colour changes.
//!
//! What of a projected surface can be seen: a depth buffer.

use super::camera::{Camera, Vector, bounds, cross, diagonal, dot, magnitude, minus, unit};
use super::surface::Surface;
use crate::report::svg;
use crate::report::svg::Rgb;
use std::fmt::Write;

/// Colours from no displacement to the largest.
pub(super) const BANDS: usize = 14;
/// Where the light comes from, seen by the viewer.
const LIGHT: Vector = [0.32, 0.55, 0.77];
/// Light on a face that the light only grazes.
const AMBIENT: f64 = 0.66;
/// Steps of light; more make the picture larger, not better.
const SHADES: f64 = 14.0;

/// How a structure is set into a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) camera: Camera,
    pub(super) size: [f64; 2],
    /// Pixels a metre.
    pub(super) scale: f64,
    centre: Vector,
    /// Diagonal of the structure, m.
    pub(super) diagonal: f64,
}

impl Frame {
    /// Fits a structure with displacements up to `amplitude` (part of its size) into a picture, with a margin.
    pub(super) fn fit(points: &[[f64; 3]], camera: Camera, size: [f64; 2], [margin, amplitude]: [f64; 2]) -> Self {
        let diagonal = diagonal(points);
        let seen: Vec<Vector> = points.iter().map(|p| camera.project(*p)).collect();
        let (near, far) = bounds(&seen);
        // Seen end on, a bar has no width.
        let least = 1e-3 * diagonal;
        let room = |k: usize| (far[k] - near[k] + 2.0 * amplitude * diagonal).max(least);
        let scale = f64::min((size[0] - 2.0 * margin) / room(0), (size[1] - 2.0 * margin) / room(1));
        Self { camera, size, scale, centre: std::array::from_fn(|k| 0.5 * (near[k] + far[k])), diagonal }
    }

    /// Where a point is in the picture.
    pub(super) fn spot(&self, point: Vector) -> Spot {
        let [x, y, z] = minus(self.camera.project(point), self.centre);
        [0.5 * self.size[0] + self.scale * x, 0.5 * self.size[1] - self.scale * y, self.scale * z]
    }
}

/// What the colours say.
pub(super) enum Colouring<'a> {
    /// The group's own colour, by index of the group.
    Groups(&'a [Rgb]),
    /// How far each point moves, largest 1.
    Displacement(&'a [[f64; 3]]),
}

/// Draws a surface; `displacement` is in metres as shown, or empty. With `fine` the elements' edges too.
pub(super) fn draw(
    out: &mut String,
    frame: &Frame,
    surface: &Surface,
    displacement: &[Vector],
    colouring: &Colouring,
    fine: bool,
) {
    let still: Vec<Spot> = surface.points.iter().map(|p| frame.spot(*p)).collect();
    let moved = |(k, p): (usize, &Vector)| {
        let d = displacement.get(k).copied().unwrap_or([0.0; 3]);
        frame.spot(std::array::from_fn(|i| p[i] + d[i]))
    };
    let spots: Vec<Spot> = surface.points.iter().enumerate().map(moved).collect();
    let buffer = DepthBuffer::of(frame.size, &spots, &surface.triangles);
    if !displacement.is_empty() {
        let parts = surface.outline.iter().map(|e| e.map(|k| still[k]));
        lines(out, "ghost", parts);
    }
    let seen = buffer.seen(surface.triangles.len());
    let mut order: Vec<usize> = (0..seen.len()).filter(|k| seen[*k]).collect();
    let near = |k: usize| surface.triangles[k].iter().map(|c| spots[*c][2]).sum::<f64>();
    order.sort_by(|a, b| near(*a).total_cmp(&near(*b)));
    let mut paint = Paint::new(out);
    for k in order {
        let corners = surface.triangles[k];
        let triangle = corners.map(|c| spots[c]);
        let light = light(triangle);
        match colouring {
            Colouring::Groups(colours) => {
                let colour = colours.get(surface.groups[k]).copied();
                let colour = svg::shaded(colour.unwrap_or([200; 3]), light);
                paint.polygon(colour, triangle.map(|[x, y, _]| [x, y]).iter());
            }
            Colouring::Displacement(all) => {
                let values = corners.map(|c| magnitude(&all[c]).min(1.0) * BANDS as f64);
                bands(&mut paint, triangle, values, light);
            }
        }
    }
    paint.end();
    // Half a percent of the structure: less than a wall, more than the error of the buffer on a slope.
    let slack = 0.006 * frame.diagonal * frame.scale;
    let visible = |[a, b]: [usize; 2]| buffer.visible_parts(spots[a], spots[b], slack);
    if fine {
        let edges = surface.edges.iter().copied();
        lines(out, "fine", edges.flat_map(visible));
    }
    lines(out, "edge", surface.outline.iter().copied().flat_map(visible));
    for line in &surface.lines {
        let first = line.points.first().copied().filter(|_| line.closed);
        let ends = line.points.iter().skip(1).copied().chain(first);
        let parts = line.points.iter().copied().zip(ends);
        // On top of all: a ring in its bore is hidden for the most part, and is what one looks for.
        lines(out, "ring", parts.map(|(a, b)| [spots[a], spots[b]]));
    }
}

/// Part of the light that a triangle sends to the viewer, in steps; both its sides are bright.
fn light([a, b, c]: [Spot; 3]) -> f64 {
    // Pixels count downwards.
    let flip = |v: Vector| [v[0], -v[1], v[2]];
    let normal = unit(cross(flip(minus(b, a)), flip(minus(c, a))));
    let facing = if normal[2] < 0.0 { normal.map(|v| -v) } else { normal };
    let light = AMBIENT + (1.0 - AMBIENT) * dot(facing, unit(LIGHT)).max(0.0);
    (light * SHADES).round() / SHADES
}

/// A triangle cut along the lines on which the colour changes; `values` at its corners, 0 to [`BANDS`].
fn bands(paint: &mut Paint, triangle: [Spot; 3], values: [f64; 3], light: f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(0.0, f64::max);
    let first = (low.floor() as usize).min(BANDS - 1);
    let last = ((high - 1e-9).ceil() as usize).clamp(first + 1, BANDS);
    for band in first..last {
        let whole = last == first + 1;
        let corners = (0..3).map(|k| ([triangle[k][0], triangle[k][1]], values[k]));
        let mut piece: Vec<([f64; 2], f64)> = corners.collect();
        if !whole {
            piece = clipped(&piece, |v| v - band as f64);
            piece = clipped(&piece, |v| (band + 1) as f64 - v);
        }
        if piece.len() > 2 {
            let colour = svg::viridis((band as f64 + 0.5) / BANDS as f64);
            paint.polygon(svg::shaded(colour, light), piece.iter().map(|(p, _)| p));
        }
    }
}

/// The part of a convex polygon on which `inside` of its value is positive.
fn clipped(polygon: &[([f64; 2], f64)], inside: impl Fn(f64) -> f64) -> Vec<([f64; 2], f64)> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (k, (point, value)) in polygon.iter().enumerate() {
        let (next, next_value) = &polygon[(k + 1) % polygon.len()];
        let (here, there) = (inside(*value), inside(*next_value));
        if here >= 0.0 {
            out.push((*point, *value));
        }
        if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
            let part = here / (here - there);
            let between = |a: f64, b: f64| a + part * (b - a);
            out.push(([between(point[0], next[0]), between(point[1], next[1])], between(*value, *next_value)));
        }
    }
    out
}

/// Writes filled polygons; those of one colour that follow each other share a path.
struct Paint<'a> {
    out: &'a mut String,
    colour: Option<Rgb>,
}

impl<'a> Paint<'a> {
    fn new(out: &'a mut String) -> Self {
        out.push_str("<g class=\"skin\">");
        Self { out, colour: None }
    }

    fn polygon<'p>(&mut self, colour: Rgb, corners: impl Iterator<Item = &'p [f64; 2]>) {
        let mut last: Option<[i64; 2]> = None;
        let mut piece = String::new();
        for corner in corners {
            let at = corner.map(tenths);
            // Writing to a string cannot fail, here and below.
            let _ = match last {
                None => write!(piece, "M{}l", pair(at)),
                Some(before) if before == at => continue,
                Some([x, y]) => write!(piece, "{}", pair([at[0] - x, at[1] - y])),
            };
            last = Some(at);
        }
        if piece.ends_with('l') || piece.is_empty() {
            return;
        }
        if self.colour != Some(colour) {
            if self.colour.is_some() {
                self.out.push_str("\"/>");
            }
            let _ = write!(self.out, "<path color=\"{}\" d=\"", svg::hex(colour));
            self.colour = Some(colour);
        }
        self.out.push_str(&piece);
        self.out.push('z');
    }

    fn end(self) {
        if self.colour.is_some() {
            self.out.push_str("\"/>");
        }
        self.out.push_str("</g>");
    }
}

/// Lines of one class in one path; a line that goes on where the last ended is joined to it.
fn lines(out: &mut String, class: &str, parts: impl Iterator<Item = [Spot; 2]>) {
    let mut data = String::new();
    let mut last = None;
    for [a, b] in parts {
        let [a, b] = [a, b].map(|[x, y, _]| [tenths(x), tenths(y)]);
        if a == b {
            continue;
        }
        if last != Some(a) {
            let _ = write!(data, "M{}", pair(a));
        }
        let _ = write!(data, "l{}", pair([b[0] - a[0], b[1] - a[1]]));
        last = Some(b);
    }
    if !data.is_empty() {
        let _ = write!(out, "<path class=\"{class}\" d=\"{data}\"/>");
    }
}

fn tenths(pixels: f64) -> i64 {
    (pixels * 10.0).round() as i64
}

/// Two numbers of path data, from tenths of a pixel, as short as they get.
fn pair([x, y]: [i64; 2]) -> String {
    let short = |v: i64| {
        let sign = if v < 0 { "-" } else { "" };
        let (whole, tenth) = (v.abs() / 10, v.abs() % 10);
        match (whole, tenth) {
            (_, 0) => format!("{sign}{whole}"),
            (0, _) => format!("{sign}.{tenth}"),
            _ => format!("{sign}{whole}.{tenth}"),
        }
    };
    let y = short(y);
    let gap = if y.starts_with('-') { "" } else { " " };
    format!(" {}{gap}{y}", short(x))
}

/// A point of the picture: right and down in pixels, and nearness to the viewer in any unit.
pub(super) type Spot = [f64; 3];

/// Samples a pixel, along each edge.
const FINE: f64 = 2.0;

/// The nearest triangle in each sample of a picture.
#[derive(Debug)]
pub(super) struct DepthBuffer {
    width: usize,
    height: usize,
    nearest: Vec<f64>,
    triangle: Vec<Option<usize>>,
}

impl DepthBuffer {
    /// The buffer of a picture of `width` x `height` pixels with these triangles in it.
    pub(super) fn of(size: [f64; 2], spots: &[Spot], triangles: &[[usize; 3]]) -> Self {
        let samples = |pixels: f64| (pixels * FINE).ceil().clamp(1.0, 8192.0) as usize;
        let (width, height) = (samples(size[0]), samples(size[1]));
        let mut buffer = Self {
            width,
            height,
            nearest: vec![f64::NEG_INFINITY; width * height],
            triangle: vec![None; width * height],
        };
        for (number, corners) in triangles.iter().enumerate() {
            buffer.fill(number, corners.map(|k| spots[k]));
        }
        buffer
    }

    fn fill(&mut self, number: usize, corners: [Spot; 3]) {
        let [a, b, c] = corners.map(|[x, y, z]| [x * FINE - 0.5, y * FINE - 0.5, z]);
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if twice.abs() <= 1e-12 || !twice.is_finite() {
            return;
        }
        let range = |k: usize, end: usize| {
            let low = a[k].min(b[k]).min(c[k]).ceil().max(0.0) as usize;
            let high = a[k].max(b[k]).max(c[k]).floor().min(end as f64 - 1.0);
            low..(high + 1.0).max(0.0) as usize
        };
        for y in range(1, self.height) {
            for x in range(0, self.width) {
                let (px, py) = (x as f64, y as f64);
                let part = |p: Spot, q: Spot| ((p[0] - px) * (q[1] - py) - (q[0] - px) * (p[1] - py)) / twice;
                let parts = [part(b, c), part(c, a), part(a, b)];
                // A sample on a common edge belongs to both.
                if parts.iter().any(|p| *p < -1e-9) {
                    continue;
                }
                let near = parts[0] * a[2] + parts[1] * b[2] + parts[2] * c[2];
                let place = y * self.width + x;
                if near > self.nearest[place] {
                    self.nearest[place] = near;
                    self.triangle[place] = Some(number);
                }
            }
        }
    }

    /// For each of `count` triangles whether any of it can be seen.
    pub(super) fn seen(&self, count: usize) -> Vec<bool> {
        let mut seen = vec![false; count];
        for number in self.triangle.iter().flatten() {
            seen[*number] = true;
        }
        seen
    }

    /// Whether a point stands in front of the surface or on it, to `slack` in nearness: the farthest of the samples
    /// round it decides, such that a point on a rim counts as seen.
    pub(super) fn shows(&self, [x, y, z]: Spot, slack: f64) -> bool {
        let (column, row) = ((x * FINE) as i64, (y * FINE) as i64);
        (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (column + dx, row + dy))).any(|(column, row)| {
            let inside = (0..self.width as i64).contains(&column) && (0..self.height as i64).contains(&row);
            !inside || z + slack >= self.nearest[row as usize * self.width + column as usize]
        })
    }

    /// The parts of a line that can be seen.
    pub(super) fn visible_parts(&self, from: Spot, to: Spot, slack: f64) -> Vec<[Spot; 2]> {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let steps = (length / 1.5).ceil().clamp(1.0, 2000.0) as usize;
        let at = |k: usize| -> Spot {
            let part = k as f64 / steps as f64;
            std::array::from_fn(|i| from[i] + part * (to[i] - from[i]))
        };
        let shown: Vec<bool> = (0..steps)
            .map(|k| {
                let (a, b) = (at(k), at(k + 1));
                self.shows(std::array::from_fn(|i| 0.5 * (a[i] + b[i])), slack)
            })
            .collect();
        let (mut parts, mut first) = (Vec::new(), 0);
        for run in shown.chunk_by(|a, b| a == b) {
            let end = first + run.len();
            // The end of a hidden edge shows at a corner in front: too short to be an edge.
            let stub = run.len() < 3 && 2 * run.len() < steps;
            if run[0] && !stub {
                parts.push([at(first), at(end)]);
            }
            first = end;
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::super::camera::UpAxis;
    use super::super::samples::cube;
    use super::*;

    fn frame(surface: &Surface) -> Frame {
        let camera = Camera::standard(UpAxis::Z)[0];
        Frame::fit(&surface.points, camera, [300.0, 240.0], [10.0, 0.0])
    }

    #[test]
    fn only_the_three_faces_in_front_are_painted() {
        let surface = Surface::of(&cube(1, 0));
        let mut out = String::new();
        let colours = [[200; 3], [100; 3]];
        let grouped = Colouring::Groups(&colours);
        draw(&mut out, &frame(&surface), &surface, &[], &grouped, false);
        assert_eq!(out.matches('z').count(), 6, "{out}");
        // 9 of the cube's 12 edges are in front.
        let edges = out.split("class=\"edge\"").nth(1).expect("edges");
        let edges = edges.split("\"/>").next().expect("its end");
        assert_eq!(edges.matches('l').count(), 9, "{edges}");
    }

    #[test]
    fn a_triangle_is_cut_where_its_colour_changes() {
        let mut out = String::new();
        let mut paint = Paint::new(&mut out);
        let triangle = [[0.0, 0.0, 0.0], [28.0, 0.0, 0.0], [0.0, 28.0, 0.0]];
        bands(&mut paint, triangle, [0.0, 4.0, 4.0], 1.0);
        paint.end();
        assert_eq!(out.matches("<path").count(), 4, "{out}");
        assert!(out.contains("color=\"#460e61\" d=\"M 0 0l 7 0 -7 7z\""), "{out}");
        let mut plain = String::new();
        let mut paint = Paint::new(&mut plain);
        bands(&mut paint, triangle, [2.2, 2.4, 2.9], 1.0);
        paint.end();
        assert_eq!(plain.matches("<path").count(), 1, "{plain}");
    }

    #[test]
    fn everything_fits_the_picture() {
        let view = cube(6, 1);
        let surface = Surface::of(&view);
        let camera = Camera::standard(UpAxis::Z)[0];
        let frame = Frame::fit(&surface.points, camera, [300.0, 240.0], [10.0, 0.1]);
        let unit = surface.displacement(&view.modes[0].displacement);
        for (p, d) in surface.points.iter().zip(unit) {
            let moved = std::array::from_fn(|k| p[k] + 0.1 * frame.diagonal * d[k]);
            let [x, y, _] = frame.spot(moved);
            assert!((10.0..=290.0).contains(&x) && (10.0..=230.0).contains(&y));
        }
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(pair([5, -12]), " .5-1.2");
        assert_eq!(pair([-100, 4]), " -10 .4");
    }
}

#[cfg(test)]
mod depth_tests {
    use super::*;

    /// A far square and a near one over its right half.
    fn two_squares() -> (Vec<Spot>, Vec<[usize; 3]>) {
        let square = |left: f64, z: f64| [[left, 10.0, z], [50.0, 10.0, z], [50.0, 50.0, z], [left, 50.0, z]];
        let spots = [square(10.0, 0.0), square(30.0, 5.0), square(35.0, 1.0)].concat();
        let corners = [0, 4, 8].map(|k| [[k, k + 1, k + 2], [k, k + 2, k + 3]]);
        (spots, corners.concat())
    }

    #[test]
    fn what_is_covered_is_not_seen() {
        let (spots, triangles) = two_squares();
        let buffer = DepthBuffer::of([60.0, 60.0], &spots, &triangles);
        assert_eq!(buffer.seen(6), [true, true, true, true, false, false]);
    }

    #[test]
    fn lines_end_where_they_go_behind() {
        let (spots, triangles) = two_squares();
        let buffer = DepthBuffer::of([60.0, 60.0], &spots, &triangles);
        let parts = buffer.visible_parts([0.0, 20.0, 0.0], [60.0, 20.0, 0.0], 0.1);
        assert_eq!(parts.len(), 2, "{parts:?}");
        // A step is 1.5 pixels, and a sample is half a pixel.
        assert!((parts[0][1][0] - 30.0).abs() < 2.0, "{parts:?}");
        assert!((parts[1][0][0] - 50.0).abs() < 2.0, "{parts:?}");
        let front = buffer.visible_parts([0.0, 20.0, 5.0], [60.0, 20.0, 5.0], 0.1);
        assert_eq!(front.len(), 1);
    }
}
