//! What can be wrong between a mesh and what is asked of it.

use super::{Apart, Doubled, MixedOrders, Overlap, RingFrame};
use crate::fe::element::ElementError;
use crate::fe::mesh::MeshError;
use thiserror::Error;

/// A housing model that cannot be built.
#[derive(Debug, Error)]
pub enum ModelError {
    /// A group that the mesh lacks, or that is empty or ambiguous.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// An element whose matrices cannot be computed.
    #[error("{path}: element {tag}: {source}")]
    Element {
        /// The mesh file.
        path: String,
        /// gmsh's tag of the element.
        tag: u64,
        /// What is wrong with it.
        source: Box<ElementError>,
    },
    /// A group of the wrong dimension.
    #[error(
        "group \"{group}\" in {path} is made of {found}; {purpose} needs {expected}: name another group or change the physical group in gmsh"
    )]
    GroupDimension {
        /// The mesh file.
        path: String,
        /// The group.
        group: String,
        /// What its elements are.
        found: &'static str,
        /// What they should be.
        expected: &'static str,
        /// What the group is used for.
        purpose: &'static str,
    },
    /// An element that belongs to two parts.
    #[error(
        "{path}: element {tag} belongs to the parts \"{first}\" and \"{second}\": a part of the housing has one material"
    )]
    TwoParts {
        /// The mesh file.
        path: String,
        /// gmsh's tag of the element.
        tag: u64,
        /// The part met first.
        first: String,
        /// The part met second.
        second: String,
    },
    /// Elements that stand twice.
    #[error(
        "{path}: {}; their mass and stiffness would count twice: keep each element once; put every volume (surface of a plane mesh) into one physical group, and save the mesh again",
        doubled.sentence()
    )]
    Doubled {
        /// The mesh file.
        path: String,
        /// Which elements.
        doubled: Box<Doubled>,
    },
    /// Elements of two orders on one edge.
    #[error(
        "{path}: {}; the body would come apart between the corners: expected all its elements in one order; set Mesh.ElementOrder in gmsh and mesh again, or tie bodies with nodes of their own by a link",
        mixed.sentence()
    )]
    MixedOrders {
        /// The mesh file.
        path: String,
        /// Which edges.
        mixed: Box<MixedOrders>,
    },
    /// A group of curves or faces of another order than the elements beneath it.
    #[error(
        "group \"{group}\" in {path}: {} of its edges lack the middle node of the elements there, the first is that of element {} of the group on element {} at ({:.6}, {:.6}, {:.6}) m; {purpose} would take hold of the corners alone: expected faces in the order of the elements; set Mesh.ElementOrder in gmsh and mesh again",
        mixed.edges, mixed.tags[0], mixed.tags[1], mixed.place[0], mixed.place[1], mixed.place[2]
    )]
    GroupOrder {
        /// The mesh file.
        path: String,
        /// The group.
        group: String,
        /// What the group is used for.
        purpose: &'static str,
        /// Which edges; the first tag is that of the group's element.
        mixed: Box<MixedOrders>,
    },
    /// A link between nodes and themselves.
    #[error(
        "{path}: a link joins \"{}\" to \"{}\", and all {nodes} nodes of the one are nodes of the other: it joins them to themselves; expected two surfaces with nodes of their own; give the faces of each body a group of its own, or leave the link out",
        groups[0], groups[1]
    )]
    LinkToItself {
        /// The mesh file.
        path: String,
        /// The groups of the link, the one first whose nodes are all in the other.
        groups: [String; 2],
        /// Number of these nodes.
        nodes: usize,
    },
    /// Bodies that fill one space.
    #[error(
        "{path}: {}; mass and stiffness would count twice there: cut one from the other in gmsh (BooleanDifference or BooleanFragments) or delete the copy; housing.overlap = \"allow\" takes them as they are",
        overlap.sentence()
    )]
    Overlap {
        /// The mesh file.
        path: String,
        /// Which parts, and where.
        overlap: Box<Overlap>,
    },
    /// A tie to a face from within the body behind it.
    #[error(
        "{path}: {}: a tie joins faces that lie on each other; move or cut one of the bodies in gmsh, or check the groups of the link; housing.overlap = \"allow\" takes them as they are",
        apart.sentence()
    )]
    TieInside {
        /// The mesh file.
        path: String,
        /// Which tie, and where.
        apart: Box<Apart>,
    },
    /// Elements of the housing that no part names.
    #[error(
        "{path}: {count} of {total} elements belong to no part (the first is element {tag}); add their group to [housing] parts"
    )]
    Unassigned {
        /// The mesh file.
        path: String,
        /// How many.
        count: usize,
        /// Of how many.
        total: usize,
        /// gmsh's tag of the first.
        tag: u64,
    },
    /// A mesh that does not lie in a plane.
    #[error(
        "{path}: node {tag} lies at z = {z:e} m, the first one at z = {first:e} m: a plane housing needs a mesh in one plane z = const"
    )]
    NotPlane {
        /// The mesh file.
        path: String,
        /// gmsh's tag of the node.
        tag: u64,
        /// Its z, m.
        z: f64,
        /// z of the first node, m.
        first: f64,
    },
    /// A tie whose nodes are not where the ring is.
    #[error(
        "the tie finds no nodes of group \"{group}\" ({path}) at the ring's outer radius {expected:.6e} m: they lie {nearest:.6e} to {farthest:.6e} m from the axis through ({x:e}, {y:e}, {z:e}) m along ({a}, {b}, {c}); check length_unit, tie.centre, tie.axis and ring.outer_radius",
        x = frame.centre()[0], y = frame.centre()[1], z = frame.centre()[2],
        a = frame.axis()[0], b = frame.axis()[1], c = frame.axis()[2]
    )]
    TieRadius {
        /// The mesh file.
        path: String,
        /// The group.
        group: String,
        /// Outer radius of the ring, m.
        expected: f64,
        /// Smallest distance of the group's nodes from the axis, m.
        nearest: f64,
        /// Largest distance, m.
        farthest: f64,
        /// Where the ring sits.
        frame: Box<RingFrame>,
    },
    /// A ring beside its bore.
    #[error(
        "the ring's plane, through ({x:e}, {y:e}, {z:e}) m across ({a}, {b}, {c}), does not cut the group \"{group}\" ({path}) that it is tied to: its nodes lie {lowest:.6e} to {highest:.6e} m from there along the axis, expected on both sides; check length_unit and tie.centre",
        x = frame.centre()[0], y = frame.centre()[1], z = frame.centre()[2],
        a = frame.axis()[0], b = frame.axis()[1], c = frame.axis()[2]
    )]
    TieAxial {
        /// The mesh file.
        path: String,
        /// The group.
        group: String,
        /// Least place of its nodes along the axis, m from the ring's plane.
        lowest: f64,
        /// Largest.
        highest: f64,
        /// Where the ring sits.
        frame: Box<RingFrame>,
    },
    /// A bore node that a link ties elsewhere.
    #[error(
        "{path}: node {tag} of the bore \"{bore}\" is tied to the ring and, by a link, to another part: keep the bore out of the linked surfaces, or join the parts by stiff springs (spring in the place of tie)"
    )]
    TiedTwice {
        /// The mesh file.
        path: String,
        /// gmsh's tag of the node.
        tag: u64,
        /// Group of the ring's tie.
        bore: String,
    },
    /// A link between bodies that do not touch.
    #[error(
        "{path}: no face of \"{}\" lies on \"{}\": expected two bodies that touch, or groups of the surfaces to be linked",
        groups[0], groups[1]
    )]
    LinkApart {
        /// The mesh file.
        path: String,
        /// The groups of the link.
        groups: [String; 2],
    },
    /// A link that finds no surface near its nodes.
    #[error(
        "{path}: {count} of the {total} nodes of group \"{group}\" are too far from \"{to}\" to be tied to it (node {tag}: {distance:.3e} m, more than half a face): expected two surfaces that lie on each other, one within the other"
    )]
    TieGap {
        /// The mesh file.
        path: String,
        /// The group whose nodes are tied.
        group: String,
        /// The surface that they are tied to.
        to: String,
        /// How many are too far.
        count: usize,
        /// Of how many.
        total: usize,
        /// gmsh's tag of the farthest.
        tag: u64,
        /// Its distance, m.
        distance: f64,
    },
    /// A tied node on a face that other nodes are tied to.
    #[error(
        "{path}: node {tag} carries other nodes of the link from \"{group}\" to \"{to}\" or is tied twice: tie each surface once, or merge the nodes in gmsh"
    )]
    TieChain {
        /// The mesh file.
        path: String,
        /// gmsh's tag of the node.
        tag: u64,
        /// The group whose nodes are tied.
        group: String,
        /// The surface that they are tied to.
        to: String,
    },
    /// A ring of elements that has no section where a ring of beams has a node.
    #[error("springs at {nodes} ring nodes need as many sections of the solid ring or a multiple, found {sections}")]
    RingSections {
        /// Nodes of the ring of beams.
        nodes: usize,
        /// Sections between the elements of the other.
        sections: usize,
    },
    /// A ring of the plane with a solid housing, or the other way round.
    #[error("{path}: a solid housing needs a ring in space, a plane one a ring in the plane")]
    RingDimension {
        /// The mesh file.
        path: String,
    },
    /// A part whose material does not fit the model.
    #[error("{path}: part \"{group}\": {source}")]
    Part {
        /// The mesh file.
        path: String,
        /// The part's group.
        group: String,
        /// What is wrong.
        source: Box<ElementError>,
    },
    /// Solids with a plane model.
    #[error("{path} is a mesh of solids: leave `housing.plane` out")]
    PlaneForSolids {
        /// The mesh file.
        path: String,
    },
    /// A plane mesh without a plane model.
    #[error(
        "{path} is a mesh of surfaces: expected `housing.plane = {{ assumption = \"stress\", thickness = ... }}` (or mesh the volume in gmsh and save it)"
    )]
    PlaneMissing {
        /// The mesh file.
        path: String,
    },
    /// The axis of the bearing is not across a plane housing.
    #[error(
        "{path} is a plane mesh in x and y: expected a tie along the axis [0, 0, 1] or [0, 0, -1], found [{x}, {y}, {z}]",
        x = axis[0], y = axis[1], z = axis[2]
    )]
    AxisInPlane {
        /// The mesh file.
        path: String,
        /// The axis found.
        axis: [f64; 3],
    },
    /// A tied node that is also fixed.
    #[error(
        "{path}: node {tag} is tied by group \"{tied}\" and fixed by group \"{fixed}\": a node can be one or the other; take it out of one of the groups in gmsh, or support the housing elsewhere"
    )]
    TiedAndFixed {
        /// The mesh file.
        path: String,
        /// gmsh's tag of the node.
        tag: u64,
        /// Group of the tie.
        tied: String,
        /// Group of the support.
        fixed: String,
    },
    /// A group that is not, or with no whole element, on the housing.
    #[error(
        "group \"{group}\" in {path}: no part of it belongs to an element of the housing, so {purpose} would hang on nothing"
    )]
    NotOnHousing {
        /// The mesh file.
        path: String,
        /// The group.
        group: String,
        /// What the group is used for.
        purpose: &'static str,
    },
}
