//! Structures for the tests.

use super::view::{ModeShapeView, ShapeGroup, ShapeLine, ShapeMode, ShapeTriangle};
use std::collections::HashMap;

/// The surface of a unit cube, `n` squares an edge, in two groups (the top and the rest), with `modes` smooth shapes and
/// a closed line round the top.
pub(crate) fn cube(n: usize, modes: usize) -> ModeShapeView {
    let mut view = ModeShapeView {
        groups: ["body", "top"]
            .iter()
            .zip(0..)
            .map(|(name, colour)| ShapeGroup { name: (*name).to_owned(), colour })
            .collect(),
        ..ModeShapeView::new("Cube")
    };
    let mut index: HashMap<[usize; 3], usize> = HashMap::new();
    for (axis, end) in [(0, 0), (0, n), (1, 0), (1, n), (2, 0), (2, n)] {
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let corner = |a: usize, b: usize| {
                let mut at = [end; 3];
                at[(axis + 1) % 3] = i + a;
                at[(axis + 2) % 3] = j + b;
                at
            };
            let ring = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            let ids = ring.map(|at| {
                *index.entry(at).or_insert_with(|| {
                    view.points.push(at.map(|k| k as f64 / n as f64));
                    view.points.len() - 1
                })
            });
            let group = usize::from(axis == 2 && end == n);
            for corners in [[ids[0], ids[1], ids[2]], [ids[0], ids[2], ids[3]]] {
                view.triangles.push(ShapeTriangle { corners, group });
            }
            for k in 0..4 {
                let (a, b) = (ids[k], ids[(k + 1) % 4]);
                view.edges.push([a.min(b), a.max(b)]);
            }
        }
    }
    view.edges.sort_unstable();
    view.edges.dedup();
    let tops = [[0, 0, n], [n, 0, n], [n, n, n], [0, n, n]];
    view.lines.push(ShapeLine {
        name: "rim".to_owned(),
        points: tops.iter().map(|at| index[at]).collect(),
        closed: true,
    });
    view.modes = (1..=modes).map(|k| mode(&view.points, k)).collect();
    view
}

fn mode(points: &[[f64; 3]], k: usize) -> ShapeMode {
    let wave = k as f64 * 1.1;
    let displacement = points.iter().map(|&[x, y, z]| {
        let lift = z * z;
        [lift * (wave * x).cos(), lift * (wave * y + 0.3).sin(), 0.4 * z * (wave * (x + y)).sin()]
    });
    ShapeMode {
        label: k.to_string(),
        frequency_hz: 100.0 * wave,
        note: "smooth".to_owned(),
        displacement: displacement.collect(),
    }
}
