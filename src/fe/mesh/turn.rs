//! Plane meshes that are seen from behind.

use super::{ElementId, Mesh};

/// Farthest that a node of a plane mesh may lie from its plane z = const, relative to its size: gmsh writes 16 digits, and
/// what is off by more is meant.
const PLANE: f64 = 1e-9;

impl Mesh {
    /// Turns the elements of each physical group of a plane mesh whose elements all run clockwise, and those of no group
    /// if these all do: gmsh makes such surfaces where their curves were drawn clockwise or extruded backwards. A group
    /// of both kinds stays as it is.
    pub(super) fn turn_clockwise(&mut self) {
        if self.dimension() != 2 || self.node_off_plane().is_some() {
            return;
        }
        let (mut grouped, mut turned) = (self.for_each_element(false), self.for_each_element(false));
        let mut turn = |ids: &[ElementId]| {
            if ids.iter().all(|&id| self.signed_area(id) < 0.0) {
                ids.iter().for_each(|id| turned[id.block][id.index] = true);
            }
        };
        for group in self.groups.iter().filter(|group| group.dimension == 2) {
            group.elements.iter().for_each(|id| grouped[id.block][id.index] = true);
            turn(&group.elements);
        }
        let alone = self.element_ids(2).filter(|id| !grouped[id.block][id.index]);
        turn(&alone.collect::<Vec<_>>());
        for (block, turned) in self.blocks.iter_mut().zip(turned) {
            let elements = block.connectivity.chunks_exact_mut(block.kind.nodes());
            for (nodes, _) in elements.zip(turned).filter(|(_, turned)| *turned) {
                // from the first corner on the other way round
                let (corners, middles) = nodes.split_at_mut(block.kind.corners());
                corners[1..].reverse();
                middles.reverse();
            }
        }
    }

    /// The first node that is off the plane z = const of the others, if there is one.
    pub(crate) fn node_off_plane(&self) -> Option<usize> {
        let first = self.nodes.first()?[2];
        let sides = self.nodes.iter().map(|node| node[0].abs().max(node[1].abs()));
        let size = sides.fold(0.0, f64::max);
        let off = |node: &[f64; 3]| (node[2] - first).abs() > PLANE * size;
        self.nodes.iter().position(off)
    }

    /// Area of the polygon of an element's corners, positive counter-clockwise, m^2.
    fn signed_area(&self, id: ElementId) -> f64 {
        let block = &self.blocks[id.block];
        let corners = &block.nodes_of(id.index)[..block.kind.corners()];
        let [x, y, _] = self.nodes[corners[0]];
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        // from the first corner on: far from the origin nothing is lost
        let twice: f64 = sides
            .map(|(&a, &b)| {
                let [a, b] = [self.nodes[a], self.nodes[b]].map(|node| [node[0] - x, node[1] - y]);
                a[0] * b[1] - a[1] * b[0]
            })
            .sum();
        0.5 * twice
    }
}
