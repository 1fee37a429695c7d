//! Connections between two groups of a housing: springs, and ties of surfaces that do not match.
//!
//! The two sides of a link: which faces and nodes of two groups are connected.

use super::housing::HousingModel;
use super::parts::check_dimension;
use super::spread::{Share, spread};
use super::support::{
    Connection, NodalMatrix, NodalSource, SpringStiffness, SupportShare, TiedNode, TiedNodes, unique,
};
use super::surface::{Foot, SideFace, nearest};
use super::{Apart, ModelError, OverlapRule};
use crate::fe::mesh::{BoundaryFace, BoundingBox, Mesh, PhysicalGroup};
use crate::numerics::Brief;
use crate::numerics::linalg::{SparseMatrix, TripletBuilder};
use nalgebra::DMatrix;

/// Largest gap of a tie, in sizes of the face that the node is tied to: the sagitta of two coarse arcs is an eighth
/// of it, a part that was drawn elsewhere is many.
const LARGEST_GAP: f64 = 0.5;

impl HousingModel {
    /// Adds what a link asks for.
    pub(super) fn attach_link(&mut self, mesh: &Mesh, index: usize) -> Result<(), ModelError> {
        let link = self.description.links[index].clone();
        let [first, second] = &link.between;
        let first = self.group_on_housing(mesh, first, "the link")?;
        let second = self.group_on_housing(mesh, second, "the link")?;
        let sides = Side::both(mesh, [first, second], &self.used, &self.path)?;
        self.common_nodes.push(self.common(&sides)?);
        match link.connection {
            Connection::Spring(stiffness, share) => {
                let [side, other] = &sides;
                let shares = match share {
                    SupportShare::PerGroup => side.spread(mesh)?.0,
                    SupportShare::PerNode => side.nodes.iter().map(|&node| Share::of_node(node)).collect(),
                };
                for share in shares {
                    let feet = share.nodes.iter().filter_map(|&node| other.nearest(mesh, mesh.nodes[node]));
                    let feet: Vec<Foot> = feet.collect();
                    let (nodes, matrix) = self.relative_springs(&share, &feet, stiffness);
                    self.springs.push(NodalMatrix { nodes, matrix, source: NodalSource::Link(index) });
                }
                Ok(())
            }
            Connection::Tie => {
                for Side { name, faces, .. } in &sides {
                    let dimension = faces.first().map_or(0, |face| face.kind.dimension());
                    check_dimension(&self.path, name, dimension, self.dimension - 1, "a tie between parts")?;
                }
                let [finer, coarser] = finer_first(mesh, &sides)?;
                let tied = self.feet(mesh, index, finer, coarser).or_else(|gap| {
                    // a coarse surface beyond whose edges the finer one reaches: the other way round
                    self.feet(mesh, index, coarser, finer).map_err(|_| gap)
                })?;
                for (node, feet) in tied {
                    if self.tied.insert(node, feet).is_some() {
                        return Err(self.chain(node, &sides));
                    }
                }
                self.check_chains(&sides)
            }
        }
    }

    /// Number of nodes that both sides have, which no link joins to themselves.
    ///
    /// # Errors
    /// [`ModelError::Refused`] if one side has no others.
    fn common(&self, [first, second]: &[Side; 2]) -> Result<usize, ModelError> {
        let (least, other) = match first.nodes.len() <= second.nodes.len() {
            true => (first, second),
            false => (second, first),
        };
        let in_other = |node: &&usize| other.nodes.binary_search(node).is_ok();
        let common = least.nodes.iter().filter(in_other).count();
        if common < least.nodes.len() {
            return Ok(common);
        }
        Err(ModelError::Refused(format!(
            "{}: a link joins \"{}\" to \"{}\", and all {common} nodes of the one are nodes of the other: it joins them to themselves; expected two surfaces with nodes of their own; give the faces of each body a group of its own, or leave the link out",
            self.path, least.name, other.name
        )))
    }

    /// `1/2 sum_ab w_ab (u_a - v_a) . S (u_b - v_b)`, v the displacement of the other group at each foot.
    fn relative_springs(&self, share: &Share, feet: &[Foot], stiffness: SpringStiffness) -> (Vec<usize>, DMatrix<f64>) {
        let d = self.dimension;
        let of_feet = feet.iter().flat_map(|foot| &foot.nodes);
        let nodes = unique(share.nodes.iter().chain(of_feet).copied());
        let place = |node: usize| nodes.binary_search(&node).unwrap_or_default();
        let mut relative: DMatrix<f64> = DMatrix::zeros(d * share.nodes.len(), d * nodes.len());
        for ((row, &node), foot) in share.nodes.iter().enumerate().zip(feet) {
            for i in 0..d {
                relative[(d * row + i, d * place(node) + i)] += 1.0;
                for (&other, follow) in foot.nodes.iter().zip(&foot.follow) {
                    for j in 0..d {
                        relative[(d * row + i, d * place(other) + j)] -= follow[(i, j)];
                    }
                }
            }
        }
        let spring = self.spring_matrix(share, stiffness);
        let matrix = relative.transpose() * spring * &relative;
        (nodes, matrix)
    }

    /// The nodes of a side with the faces of the other that they follow.
    ///
    /// # Errors
    /// [`ModelError::Refused`] if some of them are not near it.
    fn feet(&self, mesh: &Mesh, link: usize, side: &Side, to: &Side) -> Result<TiedNodes, ModelError> {
        let mut tied = TiedNodes::new();
        let (mut far, mut worst) = (0, (0.0, 0));
        for &node in &side.nodes {
            if to.nodes.binary_search(&node).is_ok() {
                continue; // shared by both: the meshes are one here
            }
            let foot = to.nearest(mesh, mesh.nodes[node]);
            let Some(foot) = foot.filter(|foot| !foot.nodes.contains(&node)) else {
                continue;
            };
            if foot.distance > LARGEST_GAP * foot.size {
                far += 1;
                if foot.distance > worst.0 {
                    worst = (foot.distance, node);
                }
            }
            tied.insert(node, TiedNode { foot, link });
        }
        if far == 0 {
            return Ok(tied);
        }
        let (distance, farthest) = worst;
        Err(ModelError::Refused(format!(
            "{}: {far} of the {} nodes of group \"{}\" are too far from \"{}\" to be tied to it (node {}: {} m, more than half a face): expected two surfaces that lie on each other, one within the other",
            self.path,
            side.nodes.len(),
            side.name,
            to.name,
            self.node_tags[farthest],
            Brief::rounded(distance, 4)
        )))
    }

    /// Ties whose sides do not lie on each other.
    ///
    /// # Errors
    /// [`ModelError::Refused`] for one that ends within the other body, unless bodies may lie in one another.
    pub(super) fn ties_apart(&self) -> Result<Vec<Apart>, ModelError> {
        let ties = self.description.links.iter().enumerate();
        let ties = ties.filter(|(_, link)| link.connection == Connection::Tie);
        let density: Vec<f64> = self.properties.iter().map(|part| part.density * part.thickness).collect();
        let found = ties.filter_map(|(index, link)| {
            let own = self.tied.iter().filter(|(_, tied)| tied.link == index);
            let own: Vec<(usize, &TiedNode)> = own.map(|(&node, tied)| (node, tied)).collect();
            self.bodies().apart(&link.between, &own, &self.node_tags, &density)
        });
        let found: Vec<Apart> = found.collect();
        match found.iter().find(|apart| apart.inside > 0) {
            Some(apart) if self.description.overlap == OverlapRule::Refuse => Err(ModelError::Refused(format!(
                "{}: {}: a tie joins faces that lie on each other; move or cut one of the bodies in gmsh, or check the groups of the link; housing.overlap = \"allow\" takes them as they are",
                self.path,
                apart.sentence("m")
            ))),
            _ => Ok(found),
        }
    }

    fn chain(&self, node: usize, sides: &[Side; 2]) -> ModelError {
        ModelError::Refused(format!(
            "{}: node {} carries other nodes of the link from \"{}\" to \"{}\" or is tied twice: tie each surface once, or merge the nodes in gmsh",
            self.path, self.node_tags[node], sides[0].name, sides[1].name
        ))
    }

    /// A node that is tied can neither carry another one nor be fixed.
    fn check_chains(&self, sides: &[Side; 2]) -> Result<(), ModelError> {
        for (&node, tied) in &self.tied {
            if let Some(&carrier) = tied.foot.nodes.iter().find(|node| self.tied.contains_key(node)) {
                return Err(self.chain(carrier, sides));
            }
            self.check_not_fixed(node, &sides[0].name)?;
        }
        Ok(())
    }

    /// A node that the group `tied` ties cannot be fixed as well.
    pub(super) fn check_not_fixed(&self, node: usize, tied: &str) -> Result<(), ModelError> {
        match self.fixed[node].iter().flatten().next() {
            None => Ok(()),
            Some(&support) => Err(ModelError::Refused(format!(
                "{}: node {} is tied by group \"{tied}\" and fixed by group \"{}\": a node can be one or the other; take it out of one of the groups in gmsh, or support the housing elsewhere",
                self.path, self.node_tags[node], self.description.supports[support].group
            ))),
        }
    }

    /// T with `u = T u'`: all displacements from those of the nodes that no link ties; `None` without ties.
    /// Columns of tied nodes are empty.
    pub(crate) fn tie_matrix(&self) -> Option<SparseMatrix> {
        if self.tied.is_empty() {
            return None;
        }
        let mut matrix = TripletBuilder::new(self.dof(), self.dof());
        for (row, column, factor) in (0..self.coordinates.len()).flat_map(|node| self.tied_entries(node)) {
            matrix.add(row, column, factor);
        }
        Some(matrix.build())
    }

    /// The row of a displacement component at a node: pairs (degree of freedom, factor). `direction` is in the mesh's
    /// axes; its z does not count in the plane. A tied node moves with those that it follows.
    pub(crate) fn displacement_row(&self, node: usize, direction: [f64; 3]) -> Vec<(usize, f64)> {
        let d = self.dimension;
        let entries = self.tied_entries(node).into_iter();
        entries.map(|(component, dof, factor)| (dof, factor * direction[component % d])).collect()
    }

    /// The rows of T that belong to a node, as (row, column, factor).
    pub(super) fn tied_entries(&self, node: usize) -> Vec<(usize, usize, f64)> {
        let d = self.dimension;
        let Some(tied) = self.tied.get(&node) else {
            return (0..d).map(|i| (d * node + i, d * node + i, 1.0)).collect();
        };
        let mut entries = Vec::new();
        for (&other, follow) in tied.foot.nodes.iter().zip(&tied.foot.follow) {
            for i in 0..d {
                for j in 0..d {
                    entries.push((d * node + i, d * other + j, follow[(i, j)]));
                }
            }
        }
        entries
    }
}

/// The side with more nodes an area (or length) first: its nodes are tied to the other, for a coarse surface tied at its
/// few nodes to a fine one leaves that free between them. Two bodies have one joint, and the side with more nodes there is
/// first: faces of a body that reach over the edge of the joint are no part of its side.
fn finer_first<'s>(mesh: &Mesh, [a, b]: &'s [Side; 2]) -> Result<[&'s Side; 2], ModelError> {
    let [of_a, of_b] = [a.spread(mesh)?.1, b.spread(mesh)?.1];
    let [nodes_a, nodes_b] = [a.nodes.len() as f64, b.nodes.len() as f64];
    let bodies = !a.boundary.is_empty() && !b.boundary.is_empty();
    let b_first = match bodies {
        true => (nodes_b, of_b) > (nodes_a, of_a),
        false => nodes_b / of_b > nodes_a / of_a,
    };
    Ok(if b_first { [b, a] } else { [a, b] })
}

impl Side {
    fn spread(&self, mesh: &Mesh) -> Result<(Vec<Share>, f64), ModelError> {
        let faces = self.faces.iter();
        spread(mesh, faces.map(|face| (face.kind, face.nodes.as_slice(), face.tag)))
    }
}

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
