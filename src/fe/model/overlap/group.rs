//! Elements of a group that are not the edges or faces of the bodies on whose nodes they lie.

use super::MixedOrders;
use super::bodies::{Bodies, Solid};
use super::doubled::{NO_NODE, edges, faces, quadrilateral};
use crate::fe::mesh::{ElementId, ElementKind, Mesh, PhysicalGroup, sorted_corners};
use std::collections::{BTreeMap, BTreeSet};

/// What tells an edge, a triangle or a quadrilateral by its corners, from whichever corner on and either way round: all of
/// them, of a quadrilateral by its diagonals.
fn outline(corners: &[usize]) -> [u32; 4] {
    match *corners {
        [a, b, c, d] => {
            let [a, b, c, d] = [a, b, c, d].map(|node| node as u32);
            let mut diagonals = [[a.min(c), a.max(c)], [b.min(d), b.max(d)]];
            diagonals.sort_unstable();
            let [[a, c], [b, d]] = diagonals;
            [a, c, b, d]
        }
        _ => sorted_corners(corners.iter().copied()),
    }
}

/// The quadrilaterals among a surface element itself and the faces of a solid.
fn quadrilaterals(kind: ElementKind, nodes: &[usize]) -> impl Iterator<Item = [u32; 5]> {
    let itself = (kind.dimension() == 2 && kind.corners() == 4).then(|| quadrilateral(|at| nodes.get(at).copied()));
    itself.into_iter().chain(faces(kind, nodes))
}

impl Bodies<'_> {
    /// The elements with some corners in a group.
    fn at_group(&self, group: &PhysicalGroup, corners: usize) -> impl Iterator<Item = &Solid<'_>> {
        let mut in_group = vec![false; self.points.len()];
        group.nodes.iter().for_each(|&node| in_group[node] = true);
        let solids = self.solids.iter();
        solids.filter(move |solid| solid.corners().iter().filter(|&&node| in_group[node]).count() >= corners)
    }

    /// The edges of a group of curves or faces without the middle node of the elements there, or else its faces without their
    /// centre node; the first tag is that of the group's element, and both parts are that of the other.
    pub(in crate::fe::model) fn without_middle_nodes(&self, mesh: &Mesh, group: &PhysicalGroup) -> Option<MixedOrders> {
        self.unlike(mesh, group, edges)
            .map(|(edges, mixed)| MixedOrders { edges, ..mixed })
            .or_else(|| self.unlike(mesh, group, quadrilaterals).map(|(faces, mixed)| MixedOrders { faces, ..mixed }))
    }

    /// The edges or faces, given by their corners and the node between these, where a group has another node than the elements:
    /// how many, and the first.
    fn unlike<'s, const N: usize, I: Iterator<Item = [u32; N]>>(
        &'s self,
        mesh: &'s Mesh,
        group: &PhysicalGroup,
        of_element: impl Fn(ElementKind, &'s [usize]) -> I,
    ) -> Option<(usize, MixedOrders)> {
        let mut of_group: BTreeMap<[u32; N], Vec<(u32, u64)>> = BTreeMap::new();
        let apart = |mut found: [u32; N]| (std::mem::replace(&mut found[N - 1], NO_NODE), found);
        for id in &group.elements {
            let block = &mesh.blocks[id.block];
            for (middle, corners) in of_element(block.kind, block.nodes_of(id.index)).map(apart) {
                of_group.entry(corners).or_default().push((middle, block.tags[id.index]));
            }
        }
        let mut found: BTreeMap<[u32; N], (u64, &Solid)> = BTreeMap::new();
        for solid in self.at_group(group, N - 1) {
            for (middle, corners) in of_element(solid.kind, solid.nodes).map(apart) {
                let own = of_group.get(&corners).and_then(|own| own.iter().find(|own| own.0 != middle));
                if let Some(&(_, tag)) = own {
                    found.entry(corners).or_insert((tag, solid));
                }
            }
        }
        let (corners, (tag, solid)) = found.first_key_value()?;
        let corners: Vec<usize> = corners[..N - 1].iter().map(|&node| node as usize).collect();
        let (tags, parts) = ([*tag, solid.tag], self.names([solid.part; 2]));
        Some((found.len(), MixedOrders { edges: 0, faces: 0, tags, parts, place: self.mean(&corners) }))
    }

    /// The elements of a group of curves or faces that lie on nodes of the bodies, but not on an edge or face of their
    /// elements: how many, and the first. Triangles within a quadrilateral lie on it.
    pub(in crate::fe::model) fn beside_faces(
        &self,
        mesh: &Mesh,
        group: &PhysicalGroup,
        used: &[bool],
    ) -> Option<(usize, ElementId)> {
        let of_bodies = self.solids.first()?.kind.dimension();
        if group.dimension == 0 || group.dimension >= of_bodies {
            return None;
        }
        let mut known = BTreeSet::new();
        for solid in self.at_group(group, group.dimension + 1) {
            if group.dimension == 1 {
                known.extend(edges(solid.kind, solid.nodes).map(|[a, b, _]| outline(&[a as usize, b as usize])));
                continue;
            }
            for face in solid.kind.faces() {
                let corners: Vec<usize> = face.nodes[..face.kind.corners()].iter().map(|&at| solid.nodes[at]).collect();
                known.insert(outline(&corners));
                if let [a, b, c, d] = corners[..] {
                    known.extend([[a, b, c], [b, c, d], [c, d, a], [d, a, b]].map(|half| outline(&half)));
                }
            }
        }
        let lies_beside = |id: &&ElementId| {
            let block = &mesh.blocks[id.block];
            let nodes = block.nodes_of(id.index);
            nodes.iter().all(|&node| used[node]) && !known.contains(&outline(&nodes[..block.kind.corners()]))
        };
        let mut beside = group.elements.iter().filter(lies_beside);
        let first = *beside.next()?;
        Some((1 + beside.count(), first))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fe::mesh::{ElementBlock, Entity, MeshNotes, MshFormat, MshVersion};

    /// One element, and a group of one element on these of its nodes; one node more is free.
    fn mesh(kind: ElementKind, own: ElementKind, nodes: &[usize]) -> Mesh {
        let places = kind.natural_nodes();
        let block = |kind: ElementKind, tag: i32, connectivity: Vec<usize>| ElementBlock {
            kind,
            tags: vec![tag as u64],
            connectivity,
            entity: Entity { dimension: kind.dimension(), tag },
        };
        let group = |kind: ElementKind, block: usize, nodes: &[usize]| PhysicalGroup {
            name: format!("{kind:?}"),
            dimension: kind.dimension(),
            tag: 1,
            nodes: nodes.to_vec(),
            elements: vec![ElementId { block, index: 0 }],
        };
        let all: Vec<usize> = (0..kind.nodes()).collect();
        Mesh {
            nodes: places.iter().copied().chain([[5.0; 3]]).collect(),
            node_tags: (1..=1 + places.len() as u64).collect(),
            groups: vec![group(kind, 0, &all), group(own, 1, nodes)],
            blocks: vec![block(kind, 1, all), block(own, 2, nodes.to_vec())],
            format: MshFormat { version: MshVersion::V41, binary: false },
            notes: MeshNotes::default(),
            source: "group.msh".into(),
        }
    }

    /// Edges and faces without their middle or centre node, and elements of the group that are no faces.
    fn faults(kind: ElementKind, own: ElementKind, nodes: &[usize]) -> ([usize; 2], usize) {
        let mesh = mesh(kind, own, nodes);
        let (bodies, used) = (Bodies::of_mesh(&mesh), [vec![true; kind.nodes()], vec![false]].concat());
        let mixed = bodies.without_middle_nodes(&mesh, &mesh.groups[1]);
        let beside = bodies.beside_faces(&mesh, &mesh.groups[1], &used);
        (mixed.map_or([0; 2], |mixed| [mixed.edges, mixed.faces]), beside.map_or(0, |(count, _)| count))
    }

    #[test]
    fn faces_are_those_of_the_elements_either_way_round() {
        for kind in ElementKind::all().filter(|kind| kind.dimension() > 1) {
            for face in kind.faces() {
                let nodes = face.nodes;
                assert_eq!(faults(kind, face.kind, nodes), ([0; 2], 0), "{kind:?} {nodes:?}");
                let (corners, rest) = nodes.split_at(face.kind.corners());
                let (middles, centre) = rest.split_at(face.kind.middle_edges().len());
                let back = |list: &[usize]| list.iter().rev().copied().collect::<Vec<usize>>();
                let mut middles = back(middles);
                // from the last corner on: the middle node of the edge back to it is the last
                if !middles.is_empty() {
                    middles.rotate_left(1);
                }
                let other = [back(corners), middles, centre.to_vec()];
                assert_eq!(faults(kind, face.kind, &other.concat()), ([0; 2], 0), "{kind:?} {nodes:?}");
                if let [a, b, c, d, ..] = *nodes
                    && corners.len() == 4
                {
                    let crossed = [&[a, c, b, d], rest].concat();
                    assert_eq!(faults(kind, face.kind, &crossed).1, 1, "{kind:?} {nodes:?}");
                    assert_eq!(faults(kind, ElementKind::Tri3, &[c, b, d]).1, 0, "{kind:?} {nodes:?}");
                }
                if let [a, b, middle] = *nodes
                    && face.kind == ElementKind::Line3
                {
                    assert_eq!(faults(kind, face.kind, &[a, middle, b]).1, 1, "{kind:?} {nodes:?}");
                }
            }
        }
    }

    #[test]
    fn faces_have_the_centre_nodes_of_the_elements() {
        for kind in ElementKind::all().filter(|kind| kind.dimension() == 3) {
            for face in kind.faces() {
                let free = kind.nodes();
                match face.kind {
                    ElementKind::Quad9 => {
                        let without = &face.nodes[..8];
                        assert_eq!(faults(kind, ElementKind::Quad8, without), ([0, 1], 0), "{kind:?}");
                    }
                    ElementKind::Quad8 => {
                        let with = [face.nodes, &[free]].concat();
                        assert_eq!(faults(kind, ElementKind::Quad9, &with), ([0, 1], 0), "{kind:?}");
                    }
                    ElementKind::Quad4 => {
                        let with = [face.nodes, &[free; 4]].concat();
                        assert_eq!(faults(kind, ElementKind::Quad8, &with), ([4, 0], 0), "{kind:?}");
                    }
                    _ => {}
                }
            }
        }
    }
}
