//! Edges of a structure, found from its surface.

use std::collections::HashMap;

use super::ModeShapeView;
use super::camera::{Vector, cross, dot, minus, unit};

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
pub(super) fn outline(view: &ModeShapeView) -> Vec<[usize; 2]> {
    let mut edges: HashMap<[usize; 2], Found> = HashMap::new();
    for triangle in &view.triangles {
        let [a, b, c] = triangle.corners.map(|k| view.points[k]);
        let normal = unit(cross(minus(b, a), minus(c, a)));
        for edge in sides(triangle.corners) {
            let found = edges.entry(edge).or_insert(Found {
                normal,
                group: triangle.group,
                count: 0,
                sharp: false,
            });
            found.count += 1;
            // The sense of rotation of a triangle may be either.
            let kink = dot(found.normal, normal).abs() < SHARP;
            found.sharp |= kink || found.group != triangle.group;
        }
    }
    let mut sharp: Vec<_> = edges
        .into_iter()
        .filter(|(_, found)| found.sharp || found.count != 2)
        .map(|(edge, _)| edge)
        .collect();
    sharp.sort_unstable();
    sharp
}

/// All edges of the triangles, each once; sorted.
pub(super) fn all(view: &ModeShapeView) -> Vec<[usize; 2]> {
    let corners = view.triangles.iter().map(|t| t.corners);
    let mut edges: Vec<_> = corners.flat_map(sides).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

fn sides([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

#[cfg(test)]
mod tests {
    use super::super::samples::cube;
    use super::*;

    #[test]
    fn a_cube_has_twelve_edges() {
        for n in [1, 3] {
            assert_eq!(outline(&cube(n, 0)).len(), 12 * n, "{n}");
        }
        // 6 n^2 squares of two triangles: 3/2 edges a triangle
        assert_eq!(all(&cube(3, 0)).len(), 6 * 9 * 2 * 3 / 2);
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
