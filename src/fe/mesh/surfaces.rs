//! What the CAD surfaces of a body are (in a plane mesh its curves): cylinders, planes, or neither.
//!
//! CAD programs cut a bore into halves: pieces of one cylinder that share nodes are one, and so are pieces of one plane.

use super::cylinder::{Cylinder, Facet, fit};
use super::{BoundingBox, ElementId, Mesh, Rim};
use nalgebra::Vector3;

/// A surface, or several that are one.
#[derive(Debug, Clone)]
pub(crate) struct CadSurface {
    /// Tags of the entities.
    pub tags: Vec<i32>,
    pub elements: Vec<ElementId>,
    /// Sorted, each once.
    pub nodes: Vec<usize>,
    pub shape: SurfaceShape,
    /// Area between the corners (length in a plane mesh).
    pub size: f64,
}

/// What a surface is. Lengths in the mesh's unit.
#[derive(Debug, Clone)]
pub(crate) enum SurfaceShape {
    Cylinder(Cylinder),
    /// Unit normal, away from the body if it bounds one, and the normal's product with a point of the plane.
    Plane(Vector3<f64>, f64),
    Other,
}

/// Distance from a plane over the size of the body: CAD files hold lengths to 1e-7.
const FLAT: f64 = 1e-6;

/// Difference of two pieces of one cylinder, over the radius: what chords of second order miss stays below.
const SAME: f64 = 1e-3;

impl CadSurface {
    /// Every entity one dimension below the body, one by one, by tag.
    pub(crate) fn all(mesh: &Mesh, rim: &Rim, tags: &[i32]) -> Vec<Self> {
        let below = mesh.dimension().saturating_sub(1);
        let size = BoundingBox::of(mesh.nodes.iter().copied()).longest_side();
        let of_tag = tags.iter().map(|&tag| {
            let elements: Vec<ElementId> = mesh.entity_elements(below, tag).collect();
            Self::of(mesh, rim, vec![tag], elements, size)
        });
        of_tag.collect()
    }

    fn of(mesh: &Mesh, rim: &Rim, tags: Vec<i32>, elements: Vec<ElementId>, size: f64) -> Self {
        let of_element = |id: &ElementId| mesh.blocks[id.block].nodes_of(id.index).iter().copied();
        let mut nodes: Vec<usize> = elements.iter().flat_map(of_element).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let facets = rim.facets_of(mesh, &elements);
        let points: Vec<[f64; 3]> = nodes.iter().map(|&node| mesh.nodes[node]).collect();
        let shape = match plane(&facets, &points, FLAT * size) {
            Some((normal, offset)) => SurfaceShape::Plane(normal, offset),
            None => match fit(&facets, &points).filter(Cylinder::is_round) {
                Some(cylinder) => SurfaceShape::Cylinder(cylinder),
                None => SurfaceShape::Other,
            },
        };
        let size = facets.iter().map(|facet| facet.area().norm()).sum();
        Self { tags, elements, nodes, shape, size }
    }

    /// The surfaces with the pieces of one cylinder or plane together, largest first.
    pub(crate) fn joined(mesh: &Mesh, rim: &Rim, tags: &[i32]) -> Vec<Self> {
        let size = BoundingBox::of(mesh.nodes.iter().copied()).longest_side();
        let mut pieces = Self::all(mesh, rim, tags);
        // the largest piece tells its shape best
        pieces.sort_by(|a, b| b.size.total_cmp(&a.size));
        let mut found: Vec<Self> = Vec::new();
        while !pieces.is_empty() {
            let mut whole = pieces.remove(0);
            while let Some(place) = pieces.iter().position(|piece| whole.continues_in(piece, FLAT * size)) {
                let piece = pieces.remove(place);
                let tags = [whole.tags, piece.tags].concat();
                let elements = [whole.elements, piece.elements].concat();
                whole = Self::of(mesh, rim, tags, elements, size);
            }
            whole.tags.sort_unstable();
            found.push(whole);
        }
        found.sort_by(|a, b| b.size.total_cmp(&a.size));
        found
    }

    fn continues_in(&self, other: &Self, flat: f64) -> bool {
        match (&self.shape, &other.shape) {
            (SurfaceShape::Plane(normal, offset), SurfaceShape::Plane(normal2, offset2)) => {
                (normal - normal2).norm() < FLAT && (offset - offset2).abs() < flat
            }
            (SurfaceShape::Cylinder(own), SurfaceShape::Cylinder(others)) => {
                own.continues_in(others) && self.touches(&other.nodes)
            }
            _ => false,
        }
    }

    /// Whether it shares nodes, given sorted.
    pub(crate) fn touches(&self, nodes: &[usize]) -> bool {
        self.nodes.iter().any(|node| nodes.binary_search(node).is_ok())
    }

    /// Whether it is flat with the whole body behind it: something that the body may stand on.
    pub(crate) fn is_flat_outside(&self, mesh: &Mesh) -> bool {
        let SurfaceShape::Plane(normal, offset) = &self.shape else {
            return false;
        };
        let beyond = FLAT * BoundingBox::of(mesh.nodes.iter().copied()).longest_side();
        mesh.nodes.iter().all(|&node| normal.dot(&Vector3::from(node)) < offset + beyond)
    }
}

impl Cylinder {
    fn continues_in(&self, other: &Self) -> bool {
        let near = SAME * self.radius;
        let [axis, axis2] = [self.axis, other.axis].map(Vector3::from);
        let arm = Vector3::from(other.centre) - Vector3::from(self.centre);
        self.hole == other.hole
            && (self.radius - other.radius).abs() < near
            && axis.cross(&axis2).norm() < SAME
            && (arm - axis * axis.dot(&arm)).norm() < near
    }
}

/// Normal and offset of the plane that all points are in; its sign is that of the first facet with a body behind it.
fn plane(facets: &[Facet], points: &[[f64; 3]], within: f64) -> Option<(Vector3<f64>, f64)> {
    let largest = facets.iter().max_by(|a, b| a.area().norm().total_cmp(&b.area().norm()))?;
    let mut normal = largest.area().try_normalize(f64::MIN_POSITIVE)?;
    // neighbours in a file may be turned against each other
    let turned = |own: Vector3<f64>| if own.dot(&normal) < 0.0 { -own } else { own };
    normal = facets.iter().map(|facet| turned(facet.area())).sum::<Vector3<f64>>().try_normalize(f64::MIN_POSITIVE)?;
    let mean = points.iter().map(|&point| normal.dot(&Vector3::from(point))).sum::<f64>() / points.len() as f64;
    if points.iter().any(|&point| (normal.dot(&Vector3::from(point)) - mean).abs() > within) {
        return None;
    }
    let inside = facets.iter().find_map(|facet| facet.inside).map(|inside| normal.dot(&Vector3::from(inside)));
    match inside {
        Some(inside) if inside > mean => Some((-normal, -mean)),
        _ => Some((normal, mean)),
    }
}
