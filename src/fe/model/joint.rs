//! The two sides of a link: which faces and nodes of two groups are connected.

use super::ModelError;
use super::surface::{Foot, SideFace, Surface};
use crate::fe::mesh::{BoundingBox, Mesh, PhysicalGroup};

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
    /// 0 points, 1 curves, 2 surfaces.
    pub dimension: usize,
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
        let body = mesh.blocks.iter().map(|block| block.kind.dimension()).max();
        let is_body = groups.map(|group| Some(group.dimension) == body);
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
        let faces: Vec<SideFace> = if is_body {
            let boundary = mesh.boundary_faces(group.elements.iter().copied()).into_iter();
            boundary
                .map(|face| SideFace {
                    kind: face.kind,
                    tag: mesh.blocks[face.element.block].tags[face.element.index],
                    nodes: face.nodes,
                })
                .collect()
        } else {
            let elements = group.elements.iter().filter_map(|id| {
                let block = mesh.blocks.get(id.block)?;
                Some(SideFace { kind: block.kind, nodes: block.element(id.index)?.to_vec(), tag: block.tags[id.index] })
            });
            elements.collect()
        };
        let on_housing = |face: &SideFace| face.nodes.iter().all(|&node| used[node]);
        Self::of_faces(&group.name, faces.into_iter().filter(on_housing).collect())
    }

    fn of_faces(name: &str, faces: Vec<SideFace>) -> Self {
        let mut nodes: Vec<usize> = faces.iter().flat_map(|face| face.nodes.clone()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        Self {
            name: name.to_owned(),
            dimension: faces.first().map_or(0, |face| face.kind.dimension()),
            nodes,
            faces,
            boundary: Vec::new(),
        }
    }

    /// The search for the point of this side that is nearest to another one.
    pub(super) fn search<'m>(&self, mesh: &'m Mesh) -> impl Fn([f64; 3]) -> Option<Foot> + use<'m> {
        let [touching, whole] = [&self.faces, &self.boundary].map(|faces| Surface::new(mesh, faces));
        move |point| {
            let foot = touching.nearest(point)?;
            if foot.distance <= BESIDE * foot.size {
                return Some(foot);
            }
            // as near on both: a face that belongs to the joint
            let nearer = |other: &Foot| other.distance < 0.5 * foot.distance;
            whole.nearest(point).filter(nearer).or(Some(foot))
        }
    }

    /// The faces of a body that lie on the other side; another group as it is.
    fn touching(&self, mesh: &Mesh, other: &Self, is_body: bool) -> Self {
        if !is_body {
            return self.clone();
        }
        let surface = Surface::new(mesh, &other.faces);
        let near: Vec<Option<f64>> = {
            let mut distances = vec![None; mesh.nodes.len()];
            for &node in &self.nodes {
                distances[node] = surface.nearest(mesh.nodes[node]).map(|foot| foot.distance);
            }
            distances
        };
        let touches = |face: &&SideFace| {
            let size = extent(mesh, &face.nodes);
            let on_other = |node: &usize| near[*node].is_some_and(|distance| distance <= TOUCH * size);
            face.nodes.iter().all(on_other)
        };
        let faces = self.faces.iter().filter(touches).cloned().collect();
        Self { boundary: self.faces.clone(), ..Self::of_faces(&self.name, faces) }
    }
}

/// Longest side of the box of some nodes, m.
fn extent(mesh: &Mesh, nodes: &[usize]) -> f64 {
    let sides = BoundingBox::of(nodes.iter().map(|&node| mesh.nodes[node])).extent();
    sides.into_iter().fold(0.0, f64::max)
}
