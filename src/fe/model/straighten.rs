//! Second-order elements that fold are mended by their nodes between corners.
//!
//! A mesher that bends edges onto the CAD surface can fold an element that is thinner than the surface is curved. Edges
//! inside the body and in plane faces follow the surface then. Only where that does not mend the element, nodes leave the
//! surface.

use crate::fe::element::continuum::{measure, quality, straight_edges};
use crate::fe::mesh::{BoundaryFace, ElementId, ElementKind, Mesh, MeshNote};
use crate::fe::model::overlap::part;
use crate::fe::model::{Bodies, ModelError};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Tags that are listed.
const LISTED: usize = 10;

/// Distance over the longest edge up to which a node has not moved: files have nine digits at least.
const UNMOVED: f64 = 1e-9;

/// What a mended element has at least: its smallest Jacobian determinant over that of the straight element.
const MARGIN: f64 = 0.1;

/// Rounds in which inner edges become straight where that helps, nodes move that keep the body's shape, and others too.
/// After them all edges of the elements that still fold become straight.
const ROUNDS: [usize; 3] = [1, 6, 24];

/// Part of the way to its straight edge that a node on a surface goes at a time.
const STEP: f64 = 0.125;

/// First and last step of the search for the place of a node that keeps the body's shape, over the longest edge.
const SEARCH: [f64; 2] = [0.03, 0.002];

/// How far from its straight edge the search may take a node, over the longest edge.
const FARTHEST: f64 = 0.05;

/// Distance of a node from the plane or line through the corners of a face, over its size, up to which that is flat; and
/// part of a unit normal that the others have not, up to which it is one of them.
const FLAT: [f64; 2] = [1e-6, 1e-4];

/// Largest change of the size of a part, %.
const LARGEST_CHANGE: f64 = 2.0;

/// Moves the nodes between the corners of folded second-order elements, also of neighbours that fold by this, until none
/// is left that straight edges mend. What was changed is a remark of the mesh.
///
/// The corners stay, and so do elements that are inverted or without size by their corners.
///
/// # Errors
/// [`ModelError::Refused`] if the volume of a part changes too much (the area in a plane mesh).
pub(crate) fn straighten(mesh: &mut Mesh) -> Result<(), ModelError> {
    let open: Vec<ElementId> = mesh.element_ids(mesh.dimension()).filter(|&id| folds(mesh, id)).collect();
    if open.is_empty() {
        return Ok(());
    }
    let before = Bodies::of_mesh(mesh).sizes_of_parts();
    let mut sentence = mend_all(mesh, open);
    let after = Bodies::of_mesh(mesh).sizes_of_parts().into_values();
    let changes = before.into_iter().zip(after).map(|((name, before), after)| (name, after / before - 1.0));
    let (name, change) = changes.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or_default();
    let what = if mesh.dimension() == 2 { "area" } else { "volume" };
    let (of, change) = (format!("the {what} of {}", part(&name)), 100.0 * change);
    if change.abs() > LARGEST_CHANGE {
        return Err(ModelError::Refused(format!(
            "{}: mending folded elements would change {of} by {change:+.2} %: expected at most {LARGEST_CHANGE} %; mesh finer where thin walls are curved, or with Mesh.HighOrderOptimize = 2 in gmsh",
            mesh.source.display()
        )));
    }
    // writing to a String cannot fail
    let _ = write!(sentence, "; {of} changed by {change:+.2} %");
    mesh.notes.told.push(MeshNote::Sentence(sentence));
    Ok(())
}

/// Mends these elements and says what moved.
fn mend_all(mesh: &mut Mesh, open: Vec<ElementId>) -> String {
    let before = mesh.nodes.clone();
    let sentence = mend(mesh, open.clone(), 0);
    if Bodies::of_mesh(mesh).overlaps().is_empty() {
        return sentence;
    }
    // the surface itself is folded there
    mesh.nodes = before;
    mend(mesh, open, ROUNDS[2])
}

/// Mends these elements, beginning with a round, and says what moved.
fn mend(mesh: &mut Mesh, mut open: Vec<ElementId>, first: usize) -> String {
    let (before, held) = (mesh.nodes.clone(), surface_nodes(mesh));
    let plane = if mesh.dimension() == 2 { vec![Vector3::z()] } else { Vec::new() };
    let free = |node: usize| complement(held.get(&node).unwrap_or(&plane).clone());
    let mut mended = BTreeSet::new();
    for round in first.. {
        mended.extend(open.iter().copied());
        let patches = patches(mesh, &open);
        for &id in &open {
            for (node, to) in middles(mesh, id) {
                if round >= ROUNDS[2] {
                    mesh.nodes[node] = to;
                } else if !free(node).is_empty() {
                    let length = if round < ROUNDS[0] { 0.0 } else { longest_edge(mesh, id) };
                    mesh.nodes[node] = best_place(mesh, node, to, (length, &free(node)), &patches[&node]);
                }
            }
            if (ROUNDS[1]..ROUNDS[2]).contains(&round) {
                leave_surface(mesh, id, &before, |node| free(node).is_empty(), &patches);
            }
        }
        let near: BTreeSet<ElementId> = patches.values().flatten().copied().collect();
        open = near
            .into_iter()
            .filter(|&id| folds(mesh, id) || has_moved(mesh, id, &before) && is_thin(mesh, id))
            .collect();
        if open.is_empty() {
            break;
        }
    }
    sentence(mesh, &mended, &before, |node| free(node).is_empty())
}

/// Whether an element is no valid one, and would be with straight edges.
pub(crate) fn folds(mesh: &Mesh, id: ElementId) -> bool {
    let kind = mesh.blocks[id.block].kind;
    kind.order() == 2 && measure(kind, &places(mesh, id)).is_err() && measure(kind, &straight(mesh, id)).is_ok()
}

fn has_moved(mesh: &Mesh, id: ElementId, before: &[[f64; 3]]) -> bool {
    mesh.blocks[id.block].nodes_of(id.index).iter().any(|&node| distance(mesh.nodes[node], before[node]) > 0.0)
}

fn is_thin(mesh: &Mesh, id: ElementId) -> bool {
    Shape::of(mesh, id, None).is_some_and(|shape| shape.lack() > 0.0)
}

/// The directions in which a move of a node on a surface would change the body's shape, as unit vectors: the normal of a
/// plane face, those of a straight edge, all on a curved face. Surfaces are faces without a neighbour, and elements of a
/// lower dimension.
fn surface_nodes(mesh: &Mesh) -> BTreeMap<usize, Vec<Vector3<f64>>> {
    let dimension = mesh.dimension();
    let listed = (1..dimension).flat_map(|below| mesh.element_ids(below)).map(|id| mesh.whole_element(id));
    let mut held: BTreeMap<usize, Vec<Vector3<f64>>> = BTreeMap::new();
    for face in mesh.boundary_faces(mesh.element_ids(dimension)).into_iter().chain(listed) {
        let normals = normals(mesh, &face);
        for &node in &face.nodes {
            normals.iter().for_each(|&normal| add(held.entry(node).or_default(), normal, FLAT[1]));
        }
    }
    held
}

/// What is normal to a plane face or a straight edge; everything to a curved one.
fn normals(mesh: &Mesh, face: &BoundaryFace) -> Vec<Vector3<f64>> {
    let from = mesh.nodes[face.nodes[0]];
    let ways: Vec<_> =
        face.nodes[1..].iter().map(|&node| Vector3::from(mesh.nodes[node]) - Vector3::from(from)).collect();
    let size = ways.iter().map(Vector3::norm).fold(0.0, f64::max);
    let mut along = Vec::new();
    ways.iter().for_each(|way| add(&mut along, way / size, FLAT[0]));
    if along.len() > face.kind.dimension() {
        along.clear();
    }
    complement(along)
}

/// Unit vectors across these and each other.
fn complement(mut to: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
    let given = to.len();
    [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().for_each(|axis| add(&mut to, axis, FLAT[1]));
    to.split_off(given)
}

/// Adds what the orthogonal unit vectors lack of another vector, if it is more than this.
fn add(to: &mut Vec<Vector3<f64>>, vector: Vector3<f64>, least: f64) {
    let rest = to.iter().fold(vector, |rest, own| rest - own * own.dot(&rest));
    if rest.norm() > least {
        to.push(rest.normalize());
    }
}

/// The elements round each node between the corners of these elements.
fn patches(mesh: &Mesh, of: &[ElementId]) -> BTreeMap<usize, Vec<ElementId>> {
    let nodes = of.iter().flat_map(|&id| middles(mesh, id));
    let mut patches: BTreeMap<usize, Vec<ElementId>> = nodes.map(|(node, _)| (node, Vec::new())).collect();
    for id in mesh.element_ids(mesh.dimension()) {
        let block = &mesh.blocks[id.block];
        for node in &block.nodes_of(id.index)[block.kind.corners()..] {
            if let Some(patch) = patches.get_mut(node) {
                patch.push(id);
            }
        }
    }
    patches
}

/// An element of which one node moves.
struct Shape {
    kind: ElementKind,
    places: Vec<[f64; 3]>,
    /// Local number of the node.
    moves: Option<usize>,
    /// Smallest determinant of the straight element, m^2 or m^3.
    straight: f64,
}

impl Shape {
    /// `None` for an element that is none with straight edges either.
    fn of(mesh: &Mesh, id: ElementId, node: Option<usize>) -> Option<Self> {
        let block = &mesh.blocks[id.block];
        let straight = straight(mesh, id);
        measure(block.kind, &straight).ok()?;
        Some(Self {
            kind: block.kind,
            places: places(mesh, id),
            moves: block.nodes_of(id.index).iter().position(|&own| Some(own) == node),
            straight: quality(block.kind, &straight).ok()?.smallest_determinant,
        })
    }

    /// What its smallest determinant lacks, over that of the straight element.
    fn lack(&self) -> f64 {
        let determinant =
            quality(self.kind, &self.places).map_or(f64::NEG_INFINITY, |found| found.smallest_determinant);
        (MARGIN - determinant / self.straight).max(0.0)
    }
}

/// What the elements round a node lack in sum, wherever it is.
fn lack_of(mesh: &Mesh, node: usize, patch: &[ElementId]) -> impl FnMut([f64; 3]) -> f64 {
    let mut shapes: Vec<Shape> = patch.iter().filter_map(|&id| Shape::of(mesh, id, Some(node))).collect();
    move |at| {
        let lacks = shapes.iter_mut().map(|shape| {
            shape.moves.into_iter().for_each(|local| shape.places[local] = at);
            shape.lack()
        });
        lacks.sum()
    }
}

/// Where the elements round a node lack least: where it is, on the straight edge, or where a search from there ends, with
/// steps by this length in these directions.
fn best_place(
    mesh: &Mesh,
    node: usize,
    straight: [f64; 3],
    (length, free): (f64, &[Vector3<f64>]),
    patch: &[ElementId],
) -> [f64; 3] {
    let mut lack = lack_of(mesh, node, patch);
    let (mut at, mut step) = (mesh.nodes[node], SEARCH[0] * length);
    let mut least = lack(at);
    let mut try_at = |to: [f64; 3], at: &mut [f64; 3], least: &mut f64| {
        let found = lack(to);
        // less by a thousandth at least, so that the search ends
        if found < 0.999 * *least && distance(to, straight) <= FARTHEST * length {
            (*at, *least) = (to, found);
        }
        found
    };
    try_at(straight, &mut at, &mut least);
    while step > SEARCH[1] * length && least > 0.0 {
        let from = at;
        let mut slope = Vector3::zeros();
        for way in free {
            for side in [-step, step] {
                slope += side * way * try_at((Vector3::from(from) + side * way).into(), &mut at, &mut least);
            }
        }
        if slope.norm() > 0.0 {
            try_at((Vector3::from(from) - step * slope.normalize()).into(), &mut at, &mut least);
        }
        if distance(at, from) <= 0.0 {
            step *= 0.5;
        }
    }
    at
}

/// Moves that node, of those that cannot move otherwise, towards its straight edge by which the elements round it gain most
/// for the distance.
fn leave_surface(
    mesh: &mut Mesh,
    id: ElementId,
    before: &[[f64; 3]],
    is_held: impl Fn(usize) -> bool,
    patches: &BTreeMap<usize, Vec<ElementId>>,
) {
    let gains = middles(mesh, id).into_iter().filter(|(node, _)| is_held(*node)).filter_map(|(node, to)| {
        let (at, way) = (mesh.nodes[node], distance(mesh.nodes[node], to));
        let part = (STEP * distance(before[node], to) / way).min(1.0);
        let next = [0, 1, 2].map(|d| at[d] + part * (to[d] - at[d]));
        let mut lack = lack_of(mesh, node, &patches[&node]);
        let gain = (lack(at) - lack(next)) / (part * way);
        (gain > 0.0).then_some((gain, node, next))
    });
    if let Some((_, node, next)) = gains.max_by(|a, b| a.0.total_cmp(&b.0)) {
        mesh.nodes[node] = next;
    }
}

/// The nodes behind the corners of an element, and where they lie if its edges are straight.
fn middles(mesh: &Mesh, id: ElementId) -> Vec<(usize, [f64; 3])> {
    let block = &mesh.blocks[id.block];
    let nodes = block.nodes_of(id.index).iter().copied();
    nodes.zip(straight(mesh, id)).skip(block.kind.corners()).collect()
}
fn places(mesh: &Mesh, id: ElementId) -> Vec<[f64; 3]> {
    mesh.blocks[id.block].nodes_of(id.index).iter().map(|&node| mesh.nodes[node]).collect()
}

fn straight(mesh: &Mesh, id: ElementId) -> Vec<[f64; 3]> {
    straight_edges(mesh.blocks[id.block].kind, &places(mesh, id))
}

fn longest_edge(mesh: &Mesh, id: ElementId) -> f64 {
    let (kind, at) = (mesh.blocks[id.block].kind, places(mesh, id));
    kind.corner_edges().iter().map(|&[a, b]| distance(at[a], at[b])).fold(0.0, f64::max)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

fn sentence(mesh: &Mesh, mended: &BTreeSet<ElementId>, before: &[[f64; 3]], is_held: impl Fn(usize) -> bool) -> String {
    let tags: Vec<String> =
        mended.iter().take(LISTED).map(|id| mesh.blocks[id.block].tags[id.index].to_string()).collect();
    let more = if mended.len() > LISTED { ", ..." } else { "" };
    let (word, tags) = (if mended.len() == 1 { "element" } else { "elements" }, tags.join(", "));
    let mut text =
        format!("{} folded {word} of second order ({tags}{more}) mended by nodes between corners", mended.len());
    let mut moved: BTreeMap<usize, f64> = BTreeMap::new();
    for &id in mended {
        let length = longest_edge(mesh, id);
        for (node, _) in middles(mesh, id) {
            let share = distance(mesh.nodes[node], before[node]) / length;
            if share > UNMOVED {
                moved.entry(node).or_insert(share);
            }
        }
    }
    let (on_surface, inside): (Vec<_>, Vec<_>) = moved.iter().partition(|(node, _)| is_held(**node));
    for (place, shares) in [("inside the body and along its plane faces", inside), ("off its surfaces", on_surface)] {
        let largest = 100.0 * shares.iter().map(|(_, share)| **share).fold(0.0, f64::max);
        if !shares.is_empty() {
            // writing to a String cannot fail
            let _ = write!(text, "; {} {place} moved by at most {largest:.2} % of the longest edge", shares.len());
        }
    }
    for group in mesh.groups.iter().filter(|group| group.dimension < mesh.dimension()) {
        let own = moved.keys().filter(|node| group.nodes.binary_search(node).is_ok()).count();
        if own > 0 {
            let _ = write!(text, "; {own} of them in the group \"{}\"", group.name);
        }
    }
    text
}

#[cfg(test)]
#[path = "straighten_tests.rs"]
mod tests;
