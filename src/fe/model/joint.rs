//! The two sides of a link: which faces and nodes of two groups are connected.

use super::ModelError;
use super::nodal::unique;
use super::surface::{Foot, SideFace, nearest};
use crate::fe::mesh::{BoundaryFace, BoundingBox, Mesh, PhysicalGroup};

/// Distance up to which faces of two bodies count as lying on each other, in sizes of the face: the sagitta of an arc
/// of 60 degrees over its chord.
const TOUCH: f64 = 0.134;

/// Distance from the faces of a body that lie on the other side, in sizes of the face, from which on the others are looked
/// at too: those that reach over the edge of the other side.
const BESIDE: f64 = 1e-6;

/// What of a group is connected.
#[derive(Debug, Clone)]
pub(super) struct Side {
    pub name: String,
    /// Nodes of the faces, sorted, each once.
    pub nodes: Vec<usize>,
    pub faces: Vec<SideFace>,
    /// The whole boundary of a body, `faces` and the others; empty for other groups.
    pub boundary: Vec<SideFace>,
}

impl Side {
    /// Both sides of a link. Groups of points, curves and surfaces are taken as they are; of a body its boundary, as
    /// far as that lies on the other side.
    ///
    /// # Errors
    /// [`ModelError::Refused`] if nothing of one side is on the housing or on the other side.
    pub(super) fn both(
        mesh: &Mesh,
        groups: [&PhysicalGroup; 2],
        used: &[bool],
        path: &str,
    ) -> Result<[Self; 2], ModelError> {
        let is_body = groups.map(|group| group.dimension == mesh.dimension());
        let whole = [0, 1].map(|k| Self::whole(mesh, groups[k], is_body[k], used));
        let [first, second] = &whole;
        let sides = [first.touching(mesh, second, is_body[0]), second.touching(mesh, first, is_body[1])];
        if sides.iter().all(|side| !side.faces.is_empty()) {
            return Ok(sides);
        }
        Err(ModelError::Refused(format!(
            "{path}: no face of \"{}\" lies on \"{}\": expected two bodies that touch, or groups of the surfaces to be linked",
            groups[0].name, groups[1].name
        )))
    }

    fn whole(mesh: &Mesh, group: &PhysicalGroup, is_body: bool, used: &[bool]) -> Self {
        let elements = group.elements.iter().copied();
        let faces: Vec<BoundaryFace> = match is_body {
            true => mesh.boundary_faces(elements),
            false => elements.map(|element| mesh.whole_element(element)).collect(),
        };
        let on_housing = faces.into_iter().filter(|face| face.nodes.iter().all(|&node| used[node]));
        let sides = on_housing.map(|BoundaryFace { element, kind, nodes }| {
            SideFace::new(mesh, kind, nodes, mesh.blocks[element.block].tags[element.index])
        });
        Self::of_faces(&group.name, sides.collect())
    }

    fn of_faces(name: &str, faces: Vec<SideFace>) -> Self {
        Self {
            name: name.to_owned(),
            nodes: unique(faces.iter().flat_map(|face| face.nodes.iter().copied())),
            faces,
            boundary: Vec::new(),
        }
    }

    /// The point of this side that is nearest to another one.
    pub(super) fn nearest(&self, mesh: &Mesh, point: [f64; 3]) -> Option<Foot> {
        let foot = nearest(mesh, &self.faces, point)?;
        if foot.distance <= BESIDE * foot.size {
            return Some(foot);
        }
        // as near on both: a face that belongs to the joint
        let nearer = |other: &Foot| other.distance < 0.5 * foot.distance;
        nearest(mesh, &self.boundary, point).filter(nearer).or(Some(foot))
    }

    /// The faces of a body that lie on the other side; another group as it is.
    fn touching(&self, mesh: &Mesh, other: &Self, is_body: bool) -> Self {
        if !is_body {
            return self.clone();
        }
        let mut distances = vec![None; mesh.nodes.len()];
        for &node in &self.nodes {
            distances[node] = nearest(mesh, &other.faces, mesh.nodes[node]).map(|foot| foot.distance);
        }
        let touches = |face: &&SideFace| {
            let size = BoundingBox::of(face.nodes.iter().map(|&node| mesh.nodes[node])).longest_side();
            face.nodes.iter().all(|&node| distances[node].is_some_and(|distance| distance <= TOUCH * size))
        };
        let faces = self.faces.iter().filter(touches).cloned().collect();
        Self { boundary: self.faces.clone(), ..Self::of_faces(&self.name, faces) }
    }
}
