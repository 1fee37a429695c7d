//! The elements that are searched, with the names of their parts.

use crate::fe::element::continuum::{measure, shape_derivatives};
use crate::fe::mesh::{BoundingBox, ElementKind, Mesh, sorted_corners};
use crate::fe::model::{HousingElements, HousingPart};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Distance below which two points are in one place, relative to the diagonal of all bodies. gmsh places coincident
/// geometry within 1e-8 of its size and single precision keeps 6e-8; an element of a mesh of 1e7 has edges of 1e-3.
const SAME_PLACE: f64 = 1e-6;

/// What stands for a part where elements are in none.
const NO_GROUP: &str = "no group";

/// An element and the part that it belongs to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solid<'m> {
    pub(super) tag: u64,
    pub(super) kind: ElementKind,
    pub(super) nodes: &'m [usize],
    /// Index into the names of the parts.
    pub(super) part: usize,
    /// Whether nodes behind the corners are not where straight edges and faces have them.
    pub(super) curved: bool,
}

impl Solid<'_> {
    pub(super) fn corners(&self) -> &[usize] {
        &self.nodes[..self.kind.corners()]
    }

    pub(super) fn sorted_corners(&self) -> [u32; 8] {
        sorted_corners(self.corners().iter().copied())
    }
}

/// The elements of the highest dimension of a mesh with the names of their parts.
#[derive(Debug)]
pub struct Bodies<'m> {
    pub(super) points: &'m [[f64; 3]],
    pub(super) solids: Vec<Solid<'m>>,
    pub(super) parts: Vec<String>,
    /// Distance below which two points are in one place, m.
    pub(super) tolerance: f64,
}

impl<'m> Bodies<'m> {
    /// The elements of a mesh; the part of each is the first group of its dimension that holds it.
    pub(crate) fn of_mesh(mesh: &'m Mesh) -> Self {
        let dimension = mesh.dimension();
        let groups: Vec<_> = mesh.groups.iter().filter(|group| group.dimension == dimension).collect();
        let mut parts: Vec<String> = groups.iter().map(|group| group.name.clone()).collect();
        parts.push(NO_GROUP.to_owned());
        let mut part = mesh.for_each_element(groups.len());
        for (number, group) in groups.iter().enumerate().rev() {
            for id in &group.elements {
                part[id.block][id.index] = number;
            }
        }
        // of points and lines none
        let solids = mesh.element_ids(dimension.max(2)).map(|id| {
            let block = &mesh.blocks[id.block];
            let (tag, nodes) = (block.tags[id.index], block.nodes_of(id.index));
            Solid { tag, kind: block.kind, nodes, part: part[id.block][id.index], curved: false }
        });
        Self::new(&mesh.nodes, solids.collect(), parts)
    }

    /// The elements of a housing by its own parts.
    pub(in crate::fe::model) fn of_housing(
        points: &'m [[f64; 3]],
        elements: &'m HousingElements,
        parts: &[HousingPart],
    ) -> Self {
        let solids = elements.iter().map(|element| Solid {
            tag: element.tag,
            kind: element.kind,
            nodes: elements.nodes(element),
            part: element.part,
            curved: false,
        });
        Self::new(points, solids.collect(), parts.iter().map(|part| part.group.clone()).collect())
    }

    fn new(points: &'m [[f64; 3]], mut solids: Vec<Solid<'m>>, parts: Vec<String>) -> Self {
        let corners = solids.iter().flat_map(|solid| solid.corners());
        let extent = BoundingBox::of(corners.map(|&node| points[node]));
        let tolerance = match solids.is_empty() {
            true => 0.0,
            false => SAME_PLACE * extent.diagonal(),
        };
        let place = |node: usize| Vector3::from(points[node]);
        solids.par_iter_mut().for_each(|solid| {
            let (corners, behind) = solid.nodes.split_at(solid.kind.corners());
            solid.curved = solid.kind.beyond_corners().zip(behind).any(|(around, &node)| {
                let mean =
                    around.iter().map(|&local| place(corners[local])).sum::<Vector3<f64>>() / around.len() as f64;
                (place(node) - mean).norm() > tolerance
            });
        });
        Self { points, solids, parts, tolerance }
    }

    /// Whether places inside have a meaning: solids, or plane elements in one plane z = const.
    pub(super) fn is_flat_or_solid(&self) -> bool {
        self.solids.first().is_some_and(|first| {
            let z = self.points[first.nodes[0]][2];
            let in_plane = |node: &usize| (self.points[*node][2] - z).abs() <= self.tolerance;
            first.kind.dimension() == 3 || self.solids.iter().all(|solid| solid.nodes.iter().all(in_plane))
        })
    }

    /// Box of some nodes.
    pub(super) fn extent(&self, nodes: &[usize]) -> BoundingBox {
        BoundingBox::of(nodes.iter().map(|&node| self.points[node]))
    }

    /// Places of some nodes, m.
    pub(super) fn places(&self, nodes: &[usize]) -> Vec<Vector3<f64>> {
        nodes.iter().map(|&node| Vector3::from(self.points[node])).collect()
    }

    /// Area (m^2) of a plane element, volume (m^3) of a solid; `None` for one that is inverted, folded or without size.
    pub(super) fn size(&self, solid: &Solid) -> Option<f64> {
        let coordinates: Vec<[f64; 3]> = solid.nodes.iter().map(|&node| self.points[node]).collect();
        measure(solid.kind, &coordinates).ok()
    }

    /// Signed area (m^2) or volume (m^3) of every part that has one by its elements' own maps: what folds counts against it.
    pub(in crate::fe::model) fn sizes_of_parts(&self) -> BTreeMap<String, f64> {
        let mut sizes = BTreeMap::new();
        for solid in &self.solids {
            let points = solid.kind.mass_rule().points().iter();
            let size = points.map(|point| {
                let slopes = shape_derivatives(solid.kind, point.natural);
                let mut jacobian = Matrix3::from_diagonal(&Vector3::z());
                if solid.kind.dimension() == 3 {
                    jacobian = Matrix3::zeros();
                }
                for (&node, slope) in solid.nodes.iter().zip(slopes) {
                    jacobian += Vector3::from(self.points[node]) * Vector3::from(slope).transpose();
                }
                point.weight * jacobian.determinant()
            });
            *sizes.entry(self.parts[solid.part].clone()).or_default() += size.sum::<f64>();
        }
        sizes
    }

    pub(super) fn names(&self, parts: [usize; 2]) -> [String; 2] {
        parts.map(|part| self.parts[part].clone())
    }
}

/// Size that two parts have in common, from that of the elements or faces of each; in one part both sides are counted.
pub(super) fn common_size([a, b]: [usize; 2], sizes: [f64; 2]) -> f64 {
    if a == b { 0.5 * sizes[0] } else { sizes[0].max(sizes[1]) }
}

/// A number of things in words.
pub(super) fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// Two parts in words, or the one that both are.
pub(super) fn both(parts: &[String; 2]) -> String {
    let [a, b] = parts.each_ref().map(|part| match part.as_str() {
        NO_GROUP => NO_GROUP.to_owned(),
        name => format!("\"{name}\""),
    });
    if a == b { a } else { format!("{a} and {b}") }
}

/// A part in words; elements in no group are of the mesh.
pub(in crate::fe::model) fn part(name: &str) -> String {
    if name == NO_GROUP { "the mesh".to_owned() } else { format!("the part \"{name}\"") }
}

/// A place in words.
pub(super) fn at([x, y, z]: [f64; 3], unit: &str) -> String {
    format!("({x:.6}, {y:.6}, {z:.6}) {unit}")
}
