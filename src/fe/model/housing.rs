//! A housing, plane or solid: mesh, materials, supports, degrees of freedom. Node n has the displacements
//! `d n`, `d n + 1`, ... along the mesh's axes x, y (d = 2) or x, y, z (d = 3).

use super::parts::{HousingElements, HousingPart, ThinPlates};
use super::spread::not_on_housing;
use super::support::{HousingSupport, Link, NodalMatrix, NodalSource, PointMass, TiedNodes, unique};
use super::{Apart, Bodies, Crossing, MixedOrders, ModelError, Overlap, OverlapRule, RingFrame, Touching};
use crate::fe::element::continuum::{ContinuumProperties, Formulation, PlaneAssumption};
use crate::fe::mesh::{Mesh, PhysicalGroup};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a plane mesh assumes across its plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneModel {
    /// Which stress or strain vanishes.
    pub assumption: PlaneAssumption,
    /// Thickness in m, > 0.
    pub thickness: f64,
}

/// Everything that a housing is beside its mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HousingDescription {
    /// What it is made of; every element of the highest dimension belongs to one part.
    pub parts: Vec<HousingPart>,
    /// `Some` for a plane mesh, `None` for a solid one.
    pub plane: Option<PlaneModel>,
    /// How element stiffness is formulated.
    pub formulation: Formulation,
    /// What holds it.
    pub supports: Vec<HousingSupport>,
    /// Masses without size.
    pub masses: Vec<PointMass>,
    /// Connections between its groups.
    pub links: Vec<Link>,
    /// Whether bodies may lie in one another.
    pub overlap: OverlapRule,
    /// Where the bearing sits.
    pub frame: RingFrame,
    /// Groups that a ring or the user of a superelement will hold.
    pub attached: Vec<String>,
    /// The same by gmsh's tags of nodes.
    pub attached_nodes: Vec<u64>,
}

/// A housing with everything that its matrices need.
#[derive(Debug, Clone)]
pub struct HousingModel {
    /// Displacement components a node, 2 or 3.
    pub(crate) dimension: usize,
    pub(crate) frame: RingFrame,
    /// Coordinates of all mesh nodes in the mesh's axes, m.
    pub(crate) coordinates: Vec<[f64; 3]>,
    pub(crate) elements: HousingElements,
    /// Properties of the parts, in the order asked for.
    pub(crate) properties: Vec<ContinuumProperties>,
    /// Springs: d rows a node.
    pub(crate) springs: Vec<NodalMatrix>,
    /// Point masses: one row a node.
    pub(crate) masses: Vec<NodalMatrix>,
    /// Fixed components, with the index of the support that fixes them.
    pub(crate) fixed: Vec<[Option<usize>; 3]>,
    /// Nodes that a link ties.
    pub(crate) tied: TiedNodes,
    /// Nodes that an element uses; the others have no degrees of freedom.
    pub(crate) used: Vec<bool>,
    /// What was asked for; an element's part is an index into its parts.
    pub(crate) description: HousingDescription,
    /// Parts that lie in one another; none unless the description allows it.
    pub overlaps: Vec<Overlap>,
    /// Parts whose faces lie on each other without common nodes and without a link.
    pub touching: Vec<Touching>,
    /// Ties whose sides do not lie on each other.
    pub apart: Vec<Apart>,
    /// Parts that reach into one another, of which the others say nothing.
    pub crossings: Vec<Crossing>,
    /// Nodes that the groups of each link have in common.
    pub(crate) common_nodes: Vec<usize>,
    /// The mesh file, for messages.
    pub(crate) path: String,
    pub(crate) node_tags: Vec<u64>,
    pub(super) thin_plates: Option<ThinPlates>,
}

impl HousingModel {
    /// Builds the model of a mesh.
    ///
    /// # Errors
    /// [`ModelError`] for groups that are missing or of the wrong kind, elements in no part or in two, a
    /// plane housing that is not plane, and supports, masses or links that would hang on nothing.
    pub fn new(mesh: &Mesh, description: HousingDescription) -> Result<Self, ModelError> {
        let path = mesh.source.display().to_string();
        // without surfaces and volumes the message about missing parts speaks of surfaces
        let dimension = mesh.dimension().max(2);
        let HousingDescription { parts, plane, frame, overlap, .. } = &description;
        check_plane(mesh, dimension, *plane, frame, &path)?;
        let elements = HousingElements::of_parts(mesh, parts, &path)?;
        let overlaps = accepted_overlaps(mesh, &elements, parts, *overlap, &path)?;
        let properties = parts.iter().map(|part| properties(part, *plane, &path)).collect::<Result<Vec<_>, _>>()?;
        let mut used = vec![false; mesh.nodes.len()];
        elements.connectivity.iter().for_each(|&node| used[node] = true);
        let mut model = Self {
            dimension,
            frame: *frame,
            coordinates: mesh.nodes.clone(),
            elements,
            properties,
            springs: Vec::new(),
            masses: Vec::new(),
            fixed: vec![[None; 3]; mesh.nodes.len()],
            tied: TiedNodes::new(),
            used,
            description,
            overlaps,
            touching: Vec::new(),
            apart: Vec::new(),
            crossings: Vec::new(),
            common_nodes: Vec::new(),
            path,
            node_tags: mesh.node_tags.clone(),
            thin_plates: None,
        };
        for index in 0..model.description.supports.len() {
            model.attach_support(mesh, index)?;
        }
        for index in 0..model.description.masses.len() {
            model.attach_mass(mesh, index)?;
        }
        for index in 0..model.description.links.len() {
            model.attach_link(mesh, index)?;
        }
        model.apart = model.ties_apart()?;
        model.find_unconnected();
        model.find_plates(mesh);
        Ok(model)
    }

    /// Finds what lies on each other, or in one another, where no link connects it.
    fn find_unconnected(&mut self) {
        let mut linked = vec![false; self.coordinates.len()];
        let tied = self.tied.iter();
        let tied = tied.flat_map(|(node, tied)| std::iter::once(node).chain(&tied.foot.nodes));
        let springs = self.springs.iter();
        let springs = springs.filter(|spring| matches!(spring.source, NodalSource::Link(_)));
        for &node in tied.chain(springs.flat_map(|spring| &spring.nodes)) {
            linked[node] = true;
        }
        let (bodies, linked) = (self.bodies(), |node| linked[node]);
        (self.touching, self.crossings) = bodies.unconnected(linked, &self.overlaps);
    }

    pub(super) fn bodies(&self) -> Bodies<'_> {
        Bodies::of_housing(&self.coordinates, &self.elements, &self.description.parts)
    }

    /// Groups of the parts, in the order asked for.
    pub(crate) fn part_groups(&self) -> Vec<String> {
        self.description.parts.iter().map(|part| part.group.clone()).collect()
    }

    /// Displacement components a node: 2 in the plane, 3 in space.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Number of degrees of freedom, those of unused nodes included (they stay out of every
    /// partition).
    pub fn dof(&self) -> usize {
        self.dimension * self.coordinates.len()
    }

    /// Where the bearing sits.
    pub fn frame(&self) -> &RingFrame {
        &self.frame
    }

    /// Coordinates of the nodes in the mesh's axes, m.
    pub fn coordinates(&self) -> &[[f64; 3]] {
        &self.coordinates
    }

    /// Coordinates of a node in the bearing's frame, m.
    pub(crate) fn ring_coordinates(&self, node: usize) -> [f64; 3] {
        self.frame.point(self.coordinates[node])
    }

    /// The elements.
    pub fn elements(&self) -> &HousingElements {
        &self.elements
    }

    /// Nodes with a spring, each once.
    pub fn spring_nodes(&self) -> Vec<usize> {
        unique(self.springs.iter().flat_map(|spring| spring.nodes.iter().copied()))
    }

    /// Degrees of freedom that are neither fixed nor tied nor without an element.
    pub fn free_dofs(&self) -> Vec<usize> {
        let d = self.dimension;
        let moves = |node: &usize| self.used[*node] && !self.tied.contains_key(node);
        (0..self.coordinates.len())
            .filter(moves)
            .flat_map(|node| (0..d).map(move |component| (node, component)))
            .filter(|&(node, component)| self.fixed[node][component].is_none())
            .map(|(node, component)| d * node + component)
            .collect()
    }

    /// A group of which at least one node is on the housing, with the middle nodes that the housing has there.
    ///
    /// # Errors
    /// [`ModelError::Mesh`], or [`ModelError::Refused`] for a group beside the housing, without the middle and centre nodes there,
    /// or with elements that are no edges or faces.
    pub(crate) fn group_on_housing<'m>(
        &self,
        mesh: &'m Mesh,
        name: &str,
        purpose: &'static str,
    ) -> Result<&'m PhysicalGroup, ModelError> {
        let group = mesh.group(name)?;
        let path = &self.path;
        if !group.nodes.iter().any(|&node| self.used[node]) {
            return Err(not_on_housing(path, name, purpose));
        }
        if let Some(tag) = mesh.left_out_of(group) {
            return Err(ModelError::Refused(format!(
                "group \"{name}\" in {path}: its element {tag} has a node twice; {purpose} needs whole faces: expected different nodes; mesh again, or take the element out of the group"
            )));
        }
        let bodies = self.bodies();
        if let Some(MixedOrders { edges, faces, tags: [own, other], place: [x, y, z], .. }) =
            bodies.without_middle_nodes(mesh, group)
        {
            let what = match edges {
                0 => format!("{faces} of its faces differ in the centre"),
                _ => format!("{edges} of its edges differ in the middle"),
            };
            return Err(ModelError::Refused(format!(
                "group \"{name}\" in {path}: {what} node from the elements there, the first is that of element {own} of the group on element {other} at ({x:.6}, {y:.6}, {z:.6}) m; {purpose} would take hold of other nodes than the elements have: expected faces in the order of the elements; mesh the geometry again in one order and with one setting of Mesh.SecondOrderIncomplete: gmsh PART.step -3 -order 2 -o PART.msh"
            )));
        }
        let Some((count, first)) = bodies.beside_faces(mesh, group, &self.used) else {
            return Ok(group);
        };
        let block = &mesh.blocks[first.block];
        let nodes: Vec<String> =
            block.nodes_of(first.index).iter().map(|&node| self.node_tags[node].to_string()).collect();
        let (what, order) = match group.dimension {
            1 => ("edge", "its two ends, then the node between them"),
            _ => ("face", "its corners in their order round it, then the nodes between them"),
        };
        Err(ModelError::Refused(format!(
            "group \"{name}\" in {path}: its element {} is no {what} of the housing's elements, the first of {count} such; {purpose} would have a wrong size: found nodes {}, expected those of one {what}, {order}; mesh the geometry again, or take the element out of the group",
            block.tags[first.index],
            nodes.join(", ")
        )))
    }
}

/// Parts that lie in one another as far as the rule allows it.
///
/// # Errors
/// [`ModelError::Refused`] for elements on the same corners, elements of two orders on one edge, and the first overlap
/// that is not allowed.
fn accepted_overlaps(
    mesh: &Mesh,
    elements: &HousingElements,
    parts: &[HousingPart],
    rule: OverlapRule,
    path: &str,
) -> Result<Vec<Overlap>, ModelError> {
    let refused = |sentence: String, advice: &str| Err(ModelError::Refused(format!("{path}: {sentence}; {advice}")));
    let bodies = Bodies::of_housing(&mesh.nodes, elements, parts);
    if let Some(doubled) = bodies.doubled() {
        return refused(
            doubled.sentence("m"),
            "their mass and stiffness would count twice: keep each element once; put every volume (surface of a plane mesh) into one physical group, and save the mesh again",
        );
    }
    if let Some(mixed) = bodies.mixed_orders() {
        return refused(
            mixed.sentence("m"),
            "the body would come apart between the corners: expected all its elements in one order; mesh the geometry again: gmsh PART.step -3 -order 2 -o PART.msh, or tie bodies with nodes of their own by a link",
        );
    }
    let overlaps = bodies.overlaps();
    match overlaps.first() {
        Some(first) if rule == OverlapRule::Refuse => refused(
            first.sentence("m"),
            &format!(
                "mass and stiffness would count twice there: {}; housing.overlap = \"allow\" takes them as they are",
                first.advice()
            ),
        ),
        _ => Ok(overlaps),
    }
}

fn properties(part: &HousingPart, plane: Option<PlaneModel>, path: &str) -> Result<ContinuumProperties, ModelError> {
    let found = match plane {
        None => Ok(ContinuumProperties::solid(&part.material)),
        Some(plane) => ContinuumProperties::plane(&part.material, plane.assumption, plane.thickness),
    };
    found.map_err(|source| ModelError::Refused(format!("{path}: part \"{}\": {source}", part.group)))
}

/// A plane mesh has a plane model and lies in a plane z = const, a solid one has none.
fn check_plane(
    mesh: &Mesh,
    dimension: usize,
    plane: Option<PlaneModel>,
    frame: &RingFrame,
    path: &str,
) -> Result<(), ModelError> {
    let refused = |message: String| Err(ModelError::Refused(format!("{path}{message}")));
    match (dimension, plane) {
        (3, None) => return Ok(()),
        (3, Some(_)) => return refused(" is a mesh of solids: leave `housing.plane` out".to_owned()),
        (_, None) => {
            return refused(
                " is a mesh of surfaces: expected `housing.plane = { assumption = \"stress\", thickness = ... }` (or mesh the volume in gmsh and save it)".to_owned(),
            );
        }
        _ => {}
    }
    let [x, y, z] = frame.axis();
    if x.hypot(y) > 1e-9 * z.abs() {
        return refused(format!(
            " is a plane mesh in x and y: expected a tie along the axis [0, 0, 1] or [0, 0, -1], found [{x}, {y}, {z}]"
        ));
    }
    let Some(index) = mesh.node_off_plane() else {
        return Ok(());
    };
    let (tag, z, first) = (mesh.node_tags[index], mesh.nodes[index][2], mesh.nodes[0][2]);
    refused(format!(
        ": node {tag} lies at z = {z:e} m, the first one at z = {first:e} m: a plane housing needs a mesh in one plane z = const"
    ))
}
