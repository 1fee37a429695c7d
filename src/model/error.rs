//! What can be wrong between a mesh and what is asked of it.

use crate::element::ElementError;
use crate::mesh::MeshError;
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
        source: ElementError,
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
    /// Surface elements that no part names.
    #[error(
        "{path}: {count} of {total} surface elements belong to no part (the first is element {tag}); add their group to [housing] parts"
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
        "the tie finds no nodes of group \"{group}\" ({path}) at the ring's outer radius {expected:.6e} m: they lie {nearest:.6e} to {farthest:.6e} m from the centre ({x:e}, {y:e}) m; check length_unit, tie.centre and ring.outer_radius",
        x = centre[0], y = centre[1]
    )]
    TieRadius {
        /// The mesh file.
        path: String,
        /// The group.
        group: String,
        /// Outer radius of the ring, m.
        expected: f64,
        /// Smallest distance of the group's nodes from the centre, m.
        nearest: f64,
        /// Largest distance, m.
        farthest: f64,
        /// Centre of the ring, m.
        centre: [f64; 2],
    },
    /// A tied node that is also fixed.
    #[error(
        "{path}: node {tag} is tied to the ring by group \"{tied}\" and fixed by group \"{fixed}\": a node can be one or the other"
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
    /// A group of nodes that no element of the housing uses.
    #[error(
        "group \"{group}\" in {path}: none of its nodes belongs to an element of the housing, so {purpose} would hang on nothing"
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
