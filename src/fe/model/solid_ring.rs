//! A ring of rectangular section as a body of elements, in a mesh of its own or added to another.

use super::RingFrame;
use super::support::unique;
use crate::fe::mesh::{ElementBlock, ElementId, ElementKind, Entity, Mesh, PhysicalGroup};
use std::collections::HashMap;
use std::f64::consts::PI;

/// Corners of a cell, in halves of its sides: across, along, up. Plane cells take the first four.
const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2]];

/// A ring of rectangular section about the axis of a frame, its centroid line in the frame's plane z = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidRing {
    /// Radius of the centroid line, m, > height / 2.
    pub radius: f64,
    /// Radial side of the section, m, > 0.
    pub height: f64,
    /// Side of the section along the axis, m, > 0; without meaning in the plane.
    pub width: f64,
    /// Elements round the ring, at least 3.
    pub around: usize,
    /// Elements across the height, at least 1.
    pub across: usize,
    /// Elements along the width, at least 1; without meaning in the plane.
    pub along: usize,
}

/// A mesh with a ring in it.
#[derive(Debug, Clone)]
pub struct MeshedRing {
    /// What was there before, its nodes and elements in their places, and the ring behind it.
    pub mesh: Mesh,
    /// Group of the ring's elements.
    pub body: String,
    /// Group of its outer face.
    pub outer_face: String,
    /// Radius of the centroid line, m.
    pub radius: f64,
    /// Sections between elements, by angle from 0: corner nodes with their shares of the area, which add up to 1.
    pub sections: Vec<Vec<(usize, f64)>>,
}

impl SolidRing {
    /// Number of elements in space (`dimension` 3) or in the plane.
    pub(crate) fn elements(&self, dimension: usize) -> usize {
        self.around * self.across * self.layers(dimension).unwrap_or(1)
    }

    fn layers(&self, dimension: usize) -> Option<usize> {
        (dimension == 3).then_some(self.along)
    }

    /// Adds the ring, of Hex20 in space and of Quad8 in the plane, to `mesh`, whose nodes it does not share.
    ///
    /// `frame` says where the axis is; that of a plane ring is along the mesh's z, and all nodes take the z of the mesh's
    /// first node. Middle nodes lie on the circles themselves.
    pub(crate) fn added_to(&self, mesh: &Mesh, frame: &RingFrame, dimension: usize) -> MeshedRing {
        let grid = Grid::new(self, mesh, frame, dimension);
        let mut mesh = mesh.clone();
        let first_tag = mesh.node_tags.iter().max().map_or(1, |tag| tag + 1);
        mesh.node_tags.extend((first_tag..).take(grid.points.len()));
        mesh.nodes.extend_from_slice(&grid.points);
        let mirrored = frame.axis()[2] < 0.0;
        // corners of a cell, and of the face on its outside
        let (solid, corners, face, outside): (_, Vec<[usize; 3]>, _, &[_]) = match dimension {
            // outward normal: e_t x e_z
            3 => (
                ElementKind::Hex20,
                CORNERS.to_vec(),
                ElementKind::Quad8,
                &[[0, 0, 0], [0, 2, 0], [0, 2, 2], [0, 0, 2]],
            ),
            _ => {
                // counter-clockwise in the mesh's x and y, where angles may run clockwise
                let turned = |&[across, along, up]: &[usize; 3]| match mirrored {
                    true => [along, across, up],
                    false => [across, along, up],
                };
                let corners = CORNERS[..4].iter().map(turned);
                (ElementKind::Quad8, corners.collect(), ElementKind::Line3, &[[0, 0, 0], [0, 2, 0]])
            }
        };
        let layers = self.layers(dimension).unwrap_or(1);
        let cells = grid.elements(solid, origins([self.across, self.around, layers]), &corners);
        let body = add_group(&mut mesh, "solid ring", solid, cells);
        let on_outside = origins([1, self.around, layers]).map(|[_, i, k]| [2 * self.across, i, k]);
        let faces = grid.elements(face, on_outside, outside);
        let outer_face = add_group(&mut mesh, "solid ring, outside", face, faces);
        MeshedRing {
            radius: self.radius,
            sections: (0..self.around).map(|station| grid.section(self, station, dimension)).collect(),
            mesh,
            body,
            outer_face,
        }
    }
}

/// Nodes of the ring by their place: halves of elements across, round and along.
struct Grid {
    nodes: HashMap<[usize; 3], usize>,
    points: Vec<[f64; 3]>,
    round: usize,
}

impl Grid {
    fn new(ring: &SolidRing, mesh: &Mesh, frame: &RingFrame, dimension: usize) -> Self {
        let mut grid = Self { nodes: HashMap::new(), points: Vec::new(), round: 2 * ring.around };
        let layers = ring.layers(dimension);
        for i in 0..grid.round {
            for j in 0..=2 * ring.across {
                for k in 0..=2 * layers.unwrap_or(0) {
                    if i % 2 + j % 2 + k % 2 > 1 {
                        continue; // neither a corner nor the middle of an edge
                    }
                    let radius = ring.radius + ring.height * (j as f64 / (2 * ring.across) as f64 - 0.5);
                    let (sin, cos) = (PI * i as f64 / ring.around as f64).sin_cos();
                    let height = layers.map_or(0.0, |layers| ring.width * (k as f64 / (2 * layers) as f64 - 0.5));
                    let mut point = frame.point_to_mesh([radius * cos, radius * sin, height]);
                    if let (None, Some(first)) = (layers, mesh.nodes.first()) {
                        point[2] = first[2];
                    }
                    let node = mesh.nodes.len() + grid.points.len();
                    grid.nodes.insert([j, i, k], node);
                    grid.points.push(point);
                }
            }
        }
        grid
    }

    fn node(&self, [j, i, k]: [usize; 3]) -> Option<usize> {
        self.nodes.get(&[j, i % self.round, k]).copied()
    }

    /// Nodes of elements at some origins: at the corners, given in halves from there, then in the middles of the edges.
    fn elements(
        &self,
        kind: ElementKind,
        origins: impl Iterator<Item = [usize; 3]>,
        corners: &[[usize; 3]],
    ) -> Vec<usize> {
        let edges = kind.middle_edges().iter();
        let middles = edges.map(|&[a, b]| [0, 1, 2].map(|axis| (corners[a][axis] + corners[b][axis]) / 2));
        let places: Vec<[usize; 3]> = corners.iter().copied().chain(middles).collect();
        let nodes = |origin: [usize; 3]| {
            let at = |place: &[usize; 3]| self.node([0, 1, 2].map(|axis| origin[axis] + place[axis]));
            places.iter().filter_map(at).collect::<Vec<_>>()
        };
        origins.flat_map(nodes).collect()
    }

    /// Corner nodes of a section, weighted by the trapezoidal rule.
    fn section(&self, ring: &SolidRing, station: usize, dimension: usize) -> Vec<(usize, f64)> {
        let share = |place: usize, cells: usize| match place == 0 || place == cells {
            true => 0.5 / cells as f64,
            false => 1.0 / cells as f64,
        };
        let layers = ring.layers(dimension);
        let mut section = Vec::new();
        for j in 0..=ring.across {
            for k in 0..=layers.unwrap_or(0) {
                let along = layers.map_or(1.0, |cells| share(k, cells));
                let node = self.node([2 * j, 2 * station, 2 * k]);
                section.extend(node.map(|node| (node, share(j, ring.across) * along)));
            }
        }
        section
    }
}

/// First corners of the cells, in halves.
fn origins([across, around, along]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let plane = move |i| (0..across).map(move |j| (i, j));
    let cells = (0..around).flat_map(plane);
    cells.flat_map(move |(i, j)| (0..along).map(move |k| [2 * j, 2 * i, 2 * k]))
}

/// Adds a block of elements and a group of them, whose name is `name` or, if there is one already, `name` with a number.
fn add_group(mesh: &mut Mesh, name: &str, kind: ElementKind, connectivity: Vec<usize>) -> String {
    let dimension = kind.dimension();
    let blocks = mesh.blocks.iter();
    let tags = blocks.clone().flat_map(|block| block.tags.iter().copied());
    let first_tag = tags.max().map_or(1, |tag| tag + 1);
    let entities = blocks.map(|block| block.entity);
    let entities = entities.filter(|entity| entity.dimension == dimension);
    let entity = entities.map(|entity| entity.tag).max().unwrap_or(0) + 1;
    let same = mesh.groups.iter().filter(|group| group.dimension == dimension);
    let tag = same.map(|group| group.tag).max().unwrap_or(0) + 1;
    let taken = |name: &str| mesh.groups.iter().any(|group| group.name == name);
    let numbered = (2..).map(|number| format!("{name} {number}"));
    let name = std::iter::once(name.to_owned()).chain(numbered).find(|name| !taken(name)).unwrap_or_default();
    let count = connectivity.len() / kind.nodes();
    let block = mesh.blocks.len();
    let nodes = unique(connectivity.iter().copied());
    mesh.blocks.push(ElementBlock {
        kind,
        tags: (first_tag..).take(count).collect(),
        connectivity,
        entity: Entity { dimension, tag: entity },
    });
    mesh.groups.push(PhysicalGroup {
        name: name.clone(),
        dimension,
        tag,
        nodes,
        elements: (0..count).map(|index| ElementId { block, index }).collect(),
    });
    mesh.groups.sort_by_key(|group| (group.dimension, group.tag));
    name
}

#[cfg(test)]
#[path = "solid_ring_tests.rs"]
mod tests;
