//! Thins a surface: points in one cell of a grid become one point (J. Rossignac, P. Borrel, "Multi-resolution 3D
//! approximations for rendering complex scenes", 1993). The point that stays is one of the mesh, with its own
//! displacement.

use std::collections::{HashMap, HashSet};

use super::camera::bounds;
use super::surface::{Surface, SurfaceLine, renumbered, rotated};

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
        let mut cells = (self.points.len() as f64).sqrt();
        loop {
            let thinned = self.clustered(cells);
            if thinned.points.len() <= most || cells <= 1.0 {
                return thinned;
            }
            // The points of a surface go with the square of the cells.
            let step = (most as f64 / thinned.points.len() as f64).sqrt();
            cells *= step.clamp(0.3, 0.95);
        }
    }

    /// One point for each cell of a grid with so many cells along the longest edge of the surface.
    fn clustered(&self, cells: f64) -> Self {
        let (low, high) = bounds(&self.points);
        let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let per_metre = cells.clamp(1.0, MOST_CELLS) / longest.max(f64::MIN_POSITIVE);
        let key = |p: &[f64; 3]| -> [u32; 3] { std::array::from_fn(|k| ((p[k] - low[k]) * per_metre) as u32) };
        let cell: Vec<[u32; 3]> = self.points.iter().map(key).collect();
        let stays = self.representatives(&cell);
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

    /// The point that stays for each cell: one on an edge of the structure if there is one, and of these the nearest to
    /// their mean.
    fn representatives(&self, cell: &[[u32; 3]]) -> HashMap<[u32; 3], usize> {
        let mut sharp = vec![false; self.points.len()];
        let lines = self.lines.iter().flat_map(|line| &line.points);
        for k in self.outline.iter().flatten().chain(lines) {
            sharp[*k] = true;
        }
        // Sum and number of the points that count.
        let mut means: HashMap<[u32; 3], (bool, [f64; 3], f64)> = HashMap::new();
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
        let mut best: HashMap<[u32; 3], (f64, usize)> = HashMap::new();
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

#[cfg(test)]
mod tests {
    use super::super::samples::cube;
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
