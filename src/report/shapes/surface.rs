//! What of a structure is shown: the points that its surface and lines use, near ones near each other in order.
//!
//! Thins a surface: points in one cell of a grid become one point (J. Rossignac, P. Borrel, "Multi-resolution 3D
//! approximations for rendering complex scenes", 1993), as far as edges join them within it: the two faces of a thin wall
//! stay apart. The point that stays is one of the mesh, with its own displacement.

use super::camera::{Vector, bounds, cross, dot, magnitude, minus, unit};
use super::view::ModeShapeView;
use serde::Serialize;
use std::collections::{HashMap, HashSet};

/// A line through points of the surface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(in crate::report) struct SurfaceLine {
    pub(super) points: Vec<usize>,
    pub(super) closed: bool,
}

/// A structure brought down to its visible points. Triangles are sorted by group.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::report) struct Surface {
    pub(super) points: Vec<[f64; 3]>,
    /// Index of each point in the view that it came from.
    pub(super) source: Vec<usize>,
    pub(super) triangles: Vec<[usize; 3]>,
    /// Group of each triangle.
    pub(super) groups: Vec<usize>,
    pub(super) edges: Vec<[usize; 2]>,
    pub(super) outline: Vec<[usize; 2]>,
    pub(super) lines: Vec<SurfaceLine>,
}

impl Surface {
    /// The surface of a checked view.
    pub(in crate::report) fn of(view: &ModeShapeView) -> Self {
        let outline = if view.outline.is_empty() { outline(view) } else { view.outline.clone() };
        let edges = if view.edges.is_empty() { all_edges(view) } else { view.edges.clone() };
        let corners = view.triangles.iter().flat_map(|t| t.corners);
        let mut source: Vec<usize> = corners
            .chain(outline.iter().chain(&edges).flatten().copied())
            .chain(view.lines.iter().flat_map(|line| line.points.clone()))
            .collect();
        source.sort_unstable();
        source.dedup();
        let points: Vec<[f64; 3]> = source.iter().map(|k| view.points[*k]).collect();
        let (low, high) = bounds(&points);
        let codes: Vec<u64> = points.iter().map(|p| morton(*p, low, high)).collect();
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|k| codes[*k]);
        let mut place = vec![0; view.points.len()];
        for (new, old) in order.iter().enumerate() {
            place[source[*old]] = new;
        }
        let mut triangles: Vec<_> =
            view.triangles.iter().map(|t| (t.group, rotated(t.corners.map(|k| place[k])))).collect();
        triangles.sort_unstable();
        let lines = view
            .lines
            .iter()
            .map(|line| SurfaceLine { points: line.points.iter().map(|k| place[*k]).collect(), closed: line.closed });
        Self {
            points: order.iter().map(|k| points[*k]).collect(),
            source: order.iter().map(|k| source[*k]).collect(),
            groups: triangles.iter().map(|t| t.0).collect(),
            triangles: triangles.into_iter().map(|t| t.1).collect(),
            edges: renumbered(&edges, &place),
            outline: renumbered(&outline, &place),
            lines: lines.collect(),
        }
    }

    /// Displacements of this surface's points out of those of all points, the largest made 1.
    pub(super) fn displacement(&self, all: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let own: Vec<[f64; 3]> = self.source.iter().map(|k| all[*k]).collect();
        // Scaled by the largest component first: squares of very small or large numbers leave the range of f64.
        let component = own.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
        if component <= 0.0 {
            return vec![[0.0; 3]; own.len()];
        }
        let own: Vec<[f64; 3]> = own.iter().map(|d| d.map(|v| v / component)).collect();
        let largest = own.iter().map(magnitude).fold(0.0_f64, f64::max);
        own.iter().map(|d| d.map(|v| v / largest)).collect()
    }
}

/// Least angle between two triangles that makes an edge: cosine of 30 degrees.
const SHARP: f64 = 0.866_025_403_784_438_6;

/// What is known of an edge: the first triangle on it, and whether it is drawn.
struct Found {
    normal: Vector,
    group: usize,
    count: usize,
    sharp: bool,
}

/// Edges where the surface has a kink, ends, branches, or meets another group; sorted.
fn outline(view: &ModeShapeView) -> Vec<[usize; 2]> {
    let mut edges: HashMap<[usize; 2], Found> = HashMap::new();
    for triangle in &view.triangles {
        let [a, b, c] = triangle.corners.map(|k| view.points[k]);
        let normal = unit(cross(minus(b, a), minus(c, a)));
        for edge in sides(triangle.corners) {
            let found = edges.entry(edge).or_insert(Found { normal, group: triangle.group, count: 0, sharp: false });
            found.count += 1;
            // The sense of rotation of a triangle may be either.
            let kink = dot(found.normal, normal).abs() < SHARP;
            found.sharp |= kink || found.group != triangle.group;
        }
    }
    let mut sharp: Vec<_> =
        edges.into_iter().filter(|(_, found)| found.sharp || found.count != 2).map(|(edge, _)| edge).collect();
    sharp.sort_unstable();
    sharp
}

/// All edges of the triangles, each once; sorted.
fn all_edges(view: &ModeShapeView) -> Vec<[usize; 2]> {
    let corners = view.triangles.iter().map(|t| t.corners);
    let mut edges: Vec<_> = corners.flat_map(sides).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

fn sides([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

/// The same triangle, its lowest corner first: sorted triangles then follow the points.
pub(super) fn rotated([a, b, c]: [usize; 3]) -> [usize; 3] {
    match a.min(b).min(c) {
        low if low == a => [a, b, c],
        low if low == b => [b, c, a],
        _ => [c, a, b],
    }
}

/// Edges between renumbered points, each once, those of no length left out; sorted.
pub(super) fn renumbered(edges: &[[usize; 2]], place: &[usize]) -> Vec<[usize; 2]> {
    let mut out: Vec<[usize; 2]> = edges
        .iter()
        .map(|edge| edge.map(|k| place[k]))
        .filter(|[a, b]| a != b)
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    out.sort_unstable();
    out.dedup();
    out
}

/// Place of a point on a curve that visits near points one after the other (G. M. Morton, IBM, 1966): the bits of its
/// coordinates in turn, 20 of each.
fn morton(point: [f64; 3], low: [f64; 3], high: [f64; 3]) -> u64 {
    let size = (0..3).map(|k| high[k] - low[k]).fold(f64::MIN_POSITIVE, f64::max);
    let cell = std::array::from_fn::<u64, 3, _>(|k| ((point[k] - low[k]) / size * f64::from((1_u32 << 20) - 1)) as u64);
    (0..20).rev().flat_map(|bit| cell.map(|c| (c >> bit) & 1)).fold(0, |code, bit| code << 1 | bit)
}

/// Cells an edge of the grid at most.
const MOST_CELLS: f64 = 65_536.0;

impl Surface {
    /// The surface with at most about `most` points (not below 8): unchanged if it has no more, else thinned until it
    /// fits.
    pub(in crate::report) fn thinned(&self, most: usize) -> Self {
        let most = most.max(8);
        if self.points.len() <= most {
            return self.clone();
        }
        // a mesh in more pieces than points may stay loses what keeps them apart
        self.fitted(most, true).or_else(|| self.fitted(most, false)).unwrap_or_else(|| self.clustered(1.0, false))
    }

    /// Thinned until it fits, the pieces in a cell kept `apart` or not; `None` if it never does.
    fn fitted(&self, most: usize, apart: bool) -> Option<Self> {
        let mut cells = (self.points.len() as f64).sqrt();
        loop {
            let thinned = self.clustered(cells, apart);
            if thinned.points.len() <= most {
                return Some(thinned);
            }
            if cells <= 1.0 {
                return None;
            }
            // The points of a surface go with the square of the cells.
            let step = (most as f64 / thinned.points.len() as f64).sqrt();
            cells *= step.clamp(0.3, 0.95);
        }
    }

    /// One point for each cell of a grid with so many cells along the longest edge of the surface, or for each of the
    /// pieces in it that no edge joins there.
    fn clustered(&self, cells: f64, apart: bool) -> Self {
        let (low, high) = bounds(&self.points);
        let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let per_metre = cells.clamp(1.0, MOST_CELLS) / longest.max(f64::MIN_POSITIVE);
        let key = |p: &[f64; 3]| -> [u32; 3] { std::array::from_fn(|k| ((p[k] - low[k]) * per_metre) as u32) };
        let cell: Vec<[u32; 3]> = self.points.iter().map(key).collect();
        let sharp = self.sharp();
        let cell = if apart { self.pieces(&cell, &sharp) } else { first_of_each(&cell) };
        let stays = self.representatives(&cell, &sharp);
        let mut kept: Vec<usize> = stays.values().copied().collect();
        kept.sort_unstable();
        let mut new = vec![0; self.points.len()];
        for (place, old) in kept.iter().enumerate() {
            new[*old] = place;
        }
        let place: Vec<usize> = cell.iter().map(|c| new[stays[c]]).collect();
        let (triangles, groups) = self.triangles_of(&place);
        let lines = self.lines.iter().map(|line| {
            let mut points: Vec<usize> = line.points.iter().map(|k| place[*k]).collect();
            points.dedup();
            SurfaceLine { points, closed: line.closed }
        });
        Self {
            points: kept.iter().map(|k| self.points[*k]).collect(),
            source: kept.iter().map(|k| self.source[*k]).collect(),
            triangles,
            groups,
            edges: renumbered(&self.edges, &place),
            outline: renumbered(&self.outline, &place),
            lines: lines.collect(),
        }
    }

    /// For each point a point of the piece that it is of inside its cell. Edges of the structure and lines join their points,
    /// sides of triangles those between; these go with an edge that they meet, and two edges stay two.
    fn pieces(&self, cell: &[[u32; 3]], sharp: &[bool]) -> Vec<usize> {
        let within = |[a, b]: &[usize; 2]| cell[*a] == cell[*b];
        let sides: Vec<[usize; 2]> = self.triangles.iter().copied().flat_map(sides).filter(within).collect();
        let lines = self.lines.iter().flat_map(|line| line.points.windows(2).map(|ends| [ends[0], ends[1]]));
        let sharp_ones = self.outline.iter().copied().chain(lines).filter(within);
        let between = sides.iter().copied().filter(|ends| ends.iter().all(|k| !sharp[*k]));
        let mut first: Vec<usize> = (0..cell.len()).collect();
        for ends in sharp_ones.chain(between) {
            let [a, b] = ends.map(|k| root(&mut first, k));
            first[a] = b;
        }
        for [a, b] in sides.into_iter().map(|[a, b]| if sharp[a] { [b, a] } else { [a, b] }) {
            let [a, b] = [a, b].map(|k| root(&mut first, k));
            if !sharp[a] && sharp[b] {
                first[a] = b;
            }
        }
        (0..cell.len()).map(|k| root(&mut first, k)).collect()
    }

    /// The point that stays for each piece: one on an edge of the structure if there is one, and of these the nearest to
    /// their mean.
    fn representatives(&self, cell: &[usize], sharp: &[bool]) -> HashMap<usize, usize> {
        // Sum and number of the points that count.
        let mut means: HashMap<usize, (bool, [f64; 3], f64)> = HashMap::new();
        for (k, point) in self.points.iter().enumerate() {
            let mean = means.entry(cell[k]).or_insert((sharp[k], [0.0; 3], 0.0));
            if sharp[k] && !mean.0 {
                *mean = (true, [0.0; 3], 0.0);
            }
            if sharp[k] == mean.0 {
                mean.1 = std::array::from_fn(|i| mean.1[i] + point[i]);
                mean.2 += 1.0;
            }
        }
        let mut best: HashMap<usize, (f64, usize)> = HashMap::new();
        for (k, point) in self.points.iter().enumerate() {
            let (wanted, sum, count) = means[&cell[k]];
            if sharp[k] != wanted {
                continue;
            }
            let far: f64 = (0..3).map(|i| (point[i] - sum[i] / count).powi(2)).sum();
            let entry = best.entry(cell[k]).or_insert((far, k));
            if far < entry.0 {
                *entry = (far, k);
            }
        }
        best.into_iter().map(|(cell, (_, k))| (cell, k)).collect()
    }

    /// Whether a point is on an edge of the structure or on a line.
    fn sharp(&self) -> Vec<bool> {
        let mut sharp = vec![false; self.points.len()];
        let lines = self.lines.iter().flat_map(|line| &line.points);
        for k in self.outline.iter().flatten().chain(lines) {
            sharp[*k] = true;
        }
        sharp
    }

    /// Triangles that still have three corners, each once.
    fn triangles_of(&self, place: &[usize]) -> (Vec<[usize; 3]>, Vec<usize>) {
        let mut seen = HashSet::new();
        let mut kept: Vec<(usize, [usize; 3])> = Vec::new();
        for (triangle, group) in self.triangles.iter().zip(&self.groups) {
            let corners = triangle.map(|k| place[k]);
            let [a, b, c] = corners;
            let mut sorted = corners;
            sorted.sort_unstable();
            if a != b && b != c && c != a && seen.insert(sorted) {
                kept.push((*group, rotated(corners)));
            }
        }
        kept.sort_unstable();
        (kept.iter().map(|k| k.1).collect(), kept.iter().map(|k| k.0).collect())
    }
}

/// The first point of the piece that a point belongs to; on the way each is tied to its neighbour's neighbour.
fn root(first: &mut [usize], mut k: usize) -> usize {
    while first[k] != k {
        first[k] = first[first[k]];
        k = first[k];
    }
    k
}

/// For each point the first one in the same cell.
fn first_of_each(cell: &[[u32; 3]]) -> Vec<usize> {
    let mut first = HashMap::new();
    cell.iter().enumerate().map(|(k, cell)| *first.entry(*cell).or_insert(k)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::samples::cube;
    use super::*;

    #[test]
    fn unused_points_go_and_the_rest_stays_what_it_is() {
        let mut view = cube(4, 1);
        view.points.insert(0, [0.5; 3]);
        for mode in &mut view.modes {
            mode.displacement.insert(0, [99.0; 3]);
        }
        let up = |k: &mut usize| *k += 1;
        view.triangles.iter_mut().flat_map(|t| &mut t.corners).for_each(up);
        view.edges.iter_mut().flatten().for_each(up);
        view.lines[0].points.iter_mut().for_each(up);
        let surface = Surface::of(&view);
        assert_eq!(surface.points.len(), view.points.len() - 1);
        for (point, source) in surface.points.iter().zip(&surface.source) {
            assert_eq!(point.map(f64::to_bits), view.points[*source].map(f64::to_bits));
        }
        // The area is the cube's: no triangle lost, none changed.
        let area: f64 = surface.triangles.iter().map(|t| area(&surface, *t)).sum();
        assert!((area - 6.0).abs() < 1e-12);
        assert!(surface.groups.is_sorted() && surface.groups.contains(&1));
        let largest = surface.displacement(&view.modes[0].displacement);
        let largest = largest.iter().map(magnitude).fold(0.0, f64::max);
        // rounding of one division
        assert!((largest - 1.0).abs() < 1e-14);
    }

    fn area(surface: &Surface, corners: [usize; 3]) -> f64 {
        let [a, b, c] = corners.map(|k| surface.points[k]);
        let n = cross(minus(b, a), minus(c, a));
        0.5 * dot(n, n).sqrt()
    }

    #[test]
    fn neighbours_are_near_in_order() {
        let surface = Surface::of(&cube(32, 0));
        let steps = surface.points.windows(2).map(|w| {
            let d: [f64; 3] = std::array::from_fn(|k| w[1][k] - w[0][k]);
            magnitude(&d)
        });
        let mean = steps.sum::<f64>() / (surface.points.len() - 1) as f64;
        // A point is 1/32 from its neighbours; random order would give 0.66.
        assert!(mean < 0.07, "{mean}");
    }

    #[test]
    fn a_mode_that_does_not_move_is_zero() {
        let view = cube(1, 0);
        let still = Surface::of(&view).displacement(&[[0.0; 3]; 8]);
        assert!(still.iter().flatten().all(|v| v.abs() < 1e-300));
        let tiny = Surface::of(&view).displacement(&[[1e-200, 0.0, 0.0]; 8]);
        assert!((tiny[0][0] - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_cube_has_twelve_edges() {
        for n in [1, 3] {
            assert_eq!(outline(&cube(n, 0)).len(), 12 * n, "{n}");
        }
        // 6 n^2 squares of two triangles: 3/2 edges a triangle
        assert_eq!(all_edges(&cube(3, 0)).len(), 6 * 9 * 2 * 3 / 2);
    }

    #[test]
    fn groups_and_free_ends_are_edges() {
        let mut plate = cube(3, 0);
        plate.triangles.retain(|t| t.group == 1);
        assert_eq!(outline(&plate).len(), 12);
        plate.triangles[0].group = 0;
        assert!(outline(&plate).len() > 12);
    }
}

#[cfg(test)]
mod cluster_tests {
    use super::super::samples::cube;
    use super::super::view::ShapeTriangle;
    use super::*;

    #[test]
    fn a_thinned_cube_is_still_a_cube() {
        let view = cube(40, 1);
        let whole = Surface::of(&view);
        assert_eq!(whole.points.len(), 9602);
        let thin = whole.thinned(1500);
        assert!((900..=1500).contains(&thin.points.len()), "{}", thin.points.len());
        for (point, source) in thin.points.iter().zip(&thin.source) {
            assert_eq!(point.map(f64::to_bits), view.points[*source].map(f64::to_bits));
        }
        // It keeps its extent, within a cell, and its surface stays closed: every edge has two triangles.
        let (low, high) = bounds(&thin.points);
        assert!((0..3).all(|k| low[k] < 1e-9 && high[k] > 1.0 - 1e-9));
        let mut sides: HashMap<[usize; 2], usize> = HashMap::new();
        for [a, b, c] in &thin.triangles {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                *sides.entry([*a.min(b), *a.max(b)]).or_default() += 1;
            }
        }
        assert!(sides.values().all(|n| *n == 2));
        assert!(thin.groups.contains(&0) && thin.groups.contains(&1));
        assert_eq!(thin.lines[0].points.len(), 4);
    }

    /// An open box whose wall is a sixth of a cell: points of one face that stayed for both would tear the other, and its rim.
    #[test]
    fn the_faces_of_a_thin_wall_stay_apart() {
        let mut view = cube(40, 1);
        let outside = view.points.len();
        view.triangles.retain(|triangle| triangle.group == 0);
        let rim: Vec<[usize; 2]> =
            outline(&view).into_iter().filter(|ends| ends.iter().all(|k| view.points[*k][2] > 0.99)).collect();
        assert_eq!(rim.len(), 160);
        let inside = view.points.iter().map(|[x, y, z]| [0.005 + 0.99 * x, 0.005 + 0.99 * y, 0.005 + 0.995 * z]);
        let inside: Vec<[f64; 3]> = inside.collect();
        view.points.extend(inside);
        for mut triangle in view.triangles.clone() {
            triangle.corners = triangle.corners.map(|k| k + outside);
            view.triangles.push(triangle);
        }
        for [a, b] in rim {
            for corners in [[a, b, a + outside], [b, b + outside, a + outside]] {
                view.triangles.push(ShapeTriangle { corners, group: 0 });
            }
        }
        (view.edges, view.lines) = (Vec::new(), Vec::new());
        let thin = Surface::of(&view).thinned(3000);
        assert!((2000..=3000).contains(&thin.points.len()), "{}", thin.points.len());
        let is_outside = |k: &usize| thin.source[*k] < outside;
        let of_one_face = |points: &[usize]| points.iter().all(|k| is_outside(k) == is_outside(&points[0]));
        // within a cell: at a corner a point of the upright edge may stay
        let on_the_rim = |points: &[usize]| points.iter().all(|k| thin.points[*k][2] > 0.9);
        assert!(thin.triangles.iter().all(|corners| of_one_face(corners) || on_the_rim(corners)));
        assert!(thin.outline.iter().all(|ends| of_one_face(ends)));
    }

    /// Triangles that share no point: kept apart they would be as many for ever.
    #[test]
    fn a_surface_in_pieces_is_thinned_too() {
        let mut view = cube(20, 1);
        let corners: Vec<usize> = view.triangles.iter().flat_map(|t| t.corners).collect();
        let points: Vec<[f64; 3]> = corners.iter().map(|k| view.points[*k]).collect();
        view.points = points;
        for (number, triangle) in view.triangles.iter_mut().enumerate() {
            triangle.corners = [0, 1, 2].map(|k| 3 * number + k);
        }
        (view.edges, view.lines) = (Vec::new(), Vec::new());
        let points = Surface::of(&view).thinned(1000).points.len();
        assert!((600..=1000).contains(&points), "{points}");
    }

    #[test]
    fn a_small_surface_is_left_alone() {
        let mut view = cube(4, 1);
        // Two points that any grid would take for one.
        view.points[1] = view.points[0].map(|v| v + 1e-7);
        let whole = Surface::of(&view);
        assert_eq!(whole.thinned(1000), whole);
        // It ends even where nothing more can go.
        assert!(!whole.thinned(1).points.is_empty());
    }
}
