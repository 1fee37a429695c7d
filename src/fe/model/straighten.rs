//! Second-order elements that fold get straight edges.
//!
//! A mesher that bends edges onto the CAD surface can fold an element that is thinner than the surface is curved. With the
//! nodes between its corners where the straight element has them, such an element is valid.

use crate::fe::element::continuum::measure;
use crate::fe::mesh::{ElementBlock, ElementId, Mesh, MeshNote};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Tags that are listed.
const LISTED: usize = 10;

/// Distance from the straight edge, over the longest edge, up to which a node lies on it: files have nine digits at least.
const ON_EDGE: f64 = 1e-9;

/// Puts the nodes between the corners of folded second-order elements on straight edges and plane faces, also those of
/// neighbours that fold by this, until none is left that straight edges mend. What was changed is a remark of the mesh.
///
/// The corners stay, and so do elements that are inverted or without size by their corners.
pub(crate) fn straighten(mesh: &mut Mesh) {
    let dimension = mesh.dimension();
    let mut moved: BTreeMap<usize, f64> = BTreeMap::new();
    let mut mended: BTreeSet<ElementId> = BTreeSet::new();
    loop {
        let folded: Vec<ElementId> =
            mesh.element_ids(dimension).filter(|id| !mended.contains(id) && folds(mesh, *id)).collect();
        if folded.is_empty() {
            break;
        }
        for &id in &folded {
            let nodes = mesh.blocks[id.block].nodes_of(id.index);
            let (straight, length) = (straight(mesh, id), longest_edge(mesh, id));
            for (&node, to) in nodes.iter().zip(straight).skip(mesh.blocks[id.block].kind.corners()) {
                let share = distance(mesh.nodes[node], to) / length;
                // a node that a neighbour has moved is there already
                if share > ON_EDGE {
                    mesh.nodes[node] = to;
                    moved.entry(node).or_insert(share);
                }
            }
        }
        mended.extend(folded);
    }
    if !mended.is_empty() {
        let sentence = sentence(mesh, &mended, &moved);
        mesh.notes.told.push(MeshNote::Sentence(sentence));
    }
}

/// Whether an element is no valid one, and would be with straight edges.
pub(crate) fn folds(mesh: &Mesh, id: ElementId) -> bool {
    let ElementBlock { kind, .. } = mesh.blocks[id.block];
    kind.order() == 2 && measure(kind, &places(mesh, id)).is_err() && measure(kind, &straight(mesh, id)).is_ok()
}

fn places(mesh: &Mesh, id: ElementId) -> Vec<[f64; 3]> {
    mesh.blocks[id.block].nodes_of(id.index).iter().map(|&node| mesh.nodes[node]).collect()
}

/// Where the nodes of an element lie if its edges are straight.
fn straight(mesh: &Mesh, id: ElementId) -> Vec<[f64; 3]> {
    let kind = mesh.blocks[id.block].kind;
    let mut at = places(mesh, id);
    for (node, corners) in (kind.corners()..).zip(kind.beyond_corners()) {
        let sum = |d: usize| corners.iter().map(|&corner| at[corner][d]).sum::<f64>();
        at[node] = [0, 1, 2].map(|d| sum(d) / corners.len() as f64);
    }
    at
}

fn longest_edge(mesh: &Mesh, id: ElementId) -> f64 {
    let (kind, at) = (mesh.blocks[id.block].kind, places(mesh, id));
    kind.corner_edges().iter().map(|&[a, b]| distance(at[a], at[b])).fold(0.0, f64::max)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

fn sentence(mesh: &Mesh, mended: &BTreeSet<ElementId>, moved: &BTreeMap<usize, f64>) -> String {
    let tags: Vec<String> =
        mended.iter().take(LISTED).map(|id| mesh.blocks[id.block].tags[id.index].to_string()).collect();
    let more = if mended.len() > LISTED { ", ..." } else { "" };
    let (word, tags) = (if mended.len() == 1 { "element" } else { "elements" }, tags.join(", "));
    let largest = 100.0 * moved.values().copied().fold(0.0, f64::max);
    let mut text = format!(
        "{} folded {word} of second order ({tags}{more}) got straight edges: {} between corners moved, by at most {largest:.2} % of the longest edge",
        mended.len(),
        if moved.len() == 1 { "1 node".to_owned() } else { format!("{} nodes", moved.len()) }
    );
    for group in mesh.groups.iter().filter(|group| group.dimension < mesh.dimension()) {
        let own = moved.keys().filter(|node| group.nodes.binary_search(node).is_ok()).count();
        if own > 0 {
            // writing to a String cannot fail
            let _ = write!(text, "; {own} of them in the group \"{}\"", group.name);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fe::mesh::{ElementKind, Entity, MeshNotes, MshFormat, MshVersion};
    use std::path::PathBuf;

    /// Two Tet10 on one face; the middle of an edge of it lies beyond the body, so that both fold.
    fn folded() -> Mesh {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
        let at = |nodes: &[[f64; 3]], place: [f64; 3]| nodes.iter().position(|node| distance(*node, place) < 1e-15);
        let mut nodes = corners.to_vec();
        let mut connectivity = Vec::new();
        for tetrahedron in [[0, 1, 2, 3], [1, 2, 3, 4]] {
            connectivity.extend(tetrahedron);
            for &[a, b] in ElementKind::Tet10.corner_edges() {
                let [a, b] = [a, b].map(|place| nodes[tetrahedron[place]]);
                let middle = [0, 1, 2].map(|d| 0.5 * (a[d] + b[d]));
                let known = at(&nodes, middle);
                connectivity.push(known.unwrap_or_else(|| {
                    nodes.push(middle);
                    nodes.len() - 1
                }));
            }
        }
        let far = at(&nodes, [0.5, 0.5, 0.0]).unwrap();
        nodes[far] = [0.05, 0.05, 0.0];
        Mesh {
            node_tags: (1..=nodes.len() as u64).collect(),
            nodes,
            blocks: vec![ElementBlock {
                kind: ElementKind::Tet10,
                tags: vec![7, 8],
                connectivity,
                entity: Entity { dimension: 3, tag: 1 },
            }],
            groups: Vec::new(),
            format: MshFormat { version: MshVersion::V41, binary: false },
            source: PathBuf::new(),
            notes: MeshNotes::default(),
        }
    }

    /// Reference: the volumes of the straight tetrahedra, 1/6 and 1/3.
    #[test]
    fn folded_elements_and_their_neighbours_become_straight() {
        let mut mesh = folded();
        let ids: Vec<ElementId> = mesh.element_ids(3).collect();
        assert!(folds(&mesh, ids[0]));
        straighten(&mut mesh);
        let volumes = ids.iter().map(|&id| measure(ElementKind::Tet10, &places(&mesh, id)).unwrap());
        for (found, expected) in volumes.zip([1.0 / 6.0, 1.0 / 3.0]) {
            assert!((found - expected).abs() < 1e-15, "{found}");
        }
        // 0.45 sqrt 2 of sqrt 2
        assert_eq!(
            mesh.notes.told.iter().map(ToString::to_string).collect::<Vec<_>>(),
            [
                "1 folded element of second order (7) got straight edges: 1 node between corners moved, by at most 45.00 % of the longest edge"
            ]
        );
        let before = mesh.clone();
        straighten(&mut mesh);
        assert_eq!(mesh, before);
    }

    #[test]
    fn inverted_elements_stay() {
        let mut mesh = folded();
        mesh.nodes.swap(0, 3);
        mesh.nodes[4] = [-1.0; 3];
        let before = mesh.clone();
        straighten(&mut mesh);
        assert_eq!(mesh, before);
    }
}
