//! Supports, point masses and links of a housing, as they are asked for.
//!
//! What acts on the nodes of a housing beside its elements: matrices on some of them, and faces that others follow.

use super::surface::Foot;
use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a support does to the nodes of its group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Constraint {
    /// Displacement components (x, y, z) of the mesh's axes that are held at zero.
    Fixed([bool; 3]),
    /// Springs to the ground.
    Spring(SpringStiffness),
}

/// Stiffness of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpringStiffness {
    /// Along the mesh's axes x, y, z, N/m.
    Global([f64; 3]),
    /// Along the radius from the bearing's axis, N/m.
    Radial(f64),
}

/// Whether a stiffness stands at each node of a group or is shared by all of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum SupportShare {
    /// Each node has a spring of this stiffness, so the sum grows with the mesh.
    #[default]
    #[serde(rename = "node")]
    PerNode,
    /// The springs of the group sum up to this stiffness, spread evenly over its volume, area or length, or equally over points.
    #[serde(rename = "group")]
    PerGroup,
}

/// A support of a named group.
#[derive(Debug, Clone, PartialEq)]
pub struct HousingSupport {
    /// The group.
    pub group: String,
    /// What it does.
    pub constraint: Constraint,
    /// How a stiffness is meant; without meaning for `Fixed`.
    pub share: SupportShare,
}

/// A mass without size, spread over the nodes of a group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointMass {
    /// A group of the mesh: a physical group, a set, or CAD entities as "surface 7".
    pub group: String,
    /// Mass of the whole group in kg, > 0.
    pub mass: f64,
}

/// A connection between two groups of a housing. Nodes of one are connected to the nearest points of the other, so the meshes of two
/// parts need not match: those of the first group by springs, those of the finer surface by a tie.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Names of two physical groups of the mesh.
    pub between: [String; 2],
    /// How.
    pub connection: Connection,
}

/// How two groups are connected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Connection {
    /// By springs.
    Spring(SpringStiffness, SupportShare),
    /// Two surfaces move as one: the nodes of the finer follow the coarser.
    Tie,
}

/// A symmetric matrix on some nodes: springs, or the share of a point mass.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodalMatrix {
    pub nodes: Vec<usize>,
    pub matrix: DMatrix<f64>,
    /// What asked for it.
    pub source: NodalSource,
}

/// What a nodal matrix belongs to; indices into the lists of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum NodalSource {
    Support(usize),
    Link(usize),
    Mass(usize),
}

/// Tied nodes by their index.
pub(crate) type TiedNodes = BTreeMap<usize, TiedNode>;

/// A node that moves with a face: `u = sum_i follow_i u_i`.
#[derive(Debug, Clone)]
pub(crate) struct TiedNode {
    pub foot: Foot,
    /// Index of the link.
    pub link: usize,
}

/// Nodes in ascending order: the corners of a face, wherever it begins.
pub(super) fn sorted(nodes: &[usize]) -> Vec<usize> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes
}

/// Nodes in ascending order, each once.
pub(super) fn unique(nodes: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut nodes: Vec<usize> = nodes.collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
