//! A bore as one node at its centre, with which rotor and gearbox programs couple.
//!
//! The centre c at `x_c` has the displacements u and rotations theta, in the mesh's axes: `u_x, u_y, u_z, theta_x, theta_y,
//! theta_z` of a solid housing, `u_x, u_y, theta_z` of a plane one. A rigid motion of it moves node i of the bore by
//!
//! ```text
//! u_i = u + theta x (x_i - x_c) = R_i c
//! ```
//!
//! **Rigid** (RBE2): the nodes do move so, and the bore keeps its form. **Mean** (RBE3): the centre follows the nodes, which
//! stay free; c is the rigid motion nearest to theirs,
//!
//! ```text
//! sum_i |u_i - R_i c|^2 -> min        c = (R^T R)^-1 R^T u = W u
//! ```
//!
//! A load on the centre becomes `W^T f`: forces on the nodes with the same resultant and the least sum of squares. This is
//! the RBE3 of MSC.Nastran with weights 1 at the components 123 (Quick Reference Guide, RBE3), as all nodes count alike, and
//! those of its remark on the reference point: `W` about any point follows from that about the mean of the nodes. Equal weights
//! follow the mesh: where it is finer, the mean counts more.

use super::{HousingModel, HousingPartition, MeanTie, ModelError};
use crate::fe::mesh::Mesh;
use crate::numerics::Brief;
use crate::numerics::linalg::{SparseMatrix, TripletBuilder};
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Spread of nodes across a line, relative to that along it, below which they lie in the line.
const IN_LINE: f64 = 1e-6;

/// Distance of a centre node from the mean of its bore, as a multiple of the bore's size, beyond which it is a slip of units.
const FARTHEST: f64 = 1e3;

/// How a centre node and the nodes of its bore move with each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CentreTie {
    /// The bore moves as a rigid body with the centre: Nastran's RBE2.
    Rigid,
    /// The centre follows the mean motion of the bore, which stays free to deform: Nastran's RBE3.
    Mean,
}

/// A bore with its centre node.
#[derive(Debug, Clone)]
pub struct CentreNode {
    /// Place of the node in the mesh's axes, m.
    pub point: [f64; 3],
    /// How it is tied.
    pub tie: CentreTie,
    /// Nodes of the bore (indices), ascending.
    pub nodes: Vec<usize>,
    partition: HousingPartition,
    dimension: usize,
}

impl CentreNode {
    /// Makes the nodes of `group` that are on the housing follow a node at `point` (m, mesh axes; z counts in space only), or
    /// that node follow them.
    ///
    /// # Errors
    /// [`ModelError::Refused`] for nodes that are fixed, tied by a link, too few or in a line, and a point that is not finite or
    /// far away; what finding the group reports.
    pub fn new(
        mesh: &Mesh,
        housing: &HousingModel,
        group: &str,
        point: [f64; 3],
        tie: CentreTie,
    ) -> Result<Self, ModelError> {
        let bore = housing.group_on_housing(mesh, group, "the centre node")?;
        let nodes: Vec<usize> = bore.nodes.iter().copied().filter(|&node| housing.used[node]).collect();
        check_nodes(housing, group, &nodes, point)?;
        let (d, motions) = (housing.dimension, motions_of(housing.dimension));
        let driven: Vec<usize> = nodes.iter().flat_map(|&node| d * node..d * node + d).collect();
        let partition = match tie {
            CentreTie::Rigid => {
                let mut rows = TripletBuilder::new(driven.len(), motions);
                for (place, &node) in nodes.iter().enumerate() {
                    let arm = arm(housing.coordinates[node], point);
                    for motion in 0..motions {
                        let moves = rigid(d, motion, arm);
                        (0..d).filter(|&k| moves[k] != 0.0).for_each(|k| rows.add(d * place + k, motion, moves[k]));
                    }
                }
                HousingPartition::new(housing, driven, rows.build())
            }
            CentreTie::Mean => {
                let none = TripletBuilder::new(0, motions).build();
                let mut partition = HousingPartition::new(housing, Vec::new(), none);
                partition.mean = Box::new(MeanTie {
                    coordinates: (0..motions).collect(),
                    weights: mean_weights(housing, &nodes, point),
                });
                partition
            }
        };
        Ok(Self { point, tie, nodes, partition, dimension: d })
    }

    /// The split of the housing's degrees of freedom; the interface coordinates are those of the node.
    pub fn partition(&self) -> &HousingPartition {
        &self.partition
    }

    /// Which of [`CENTRE_COORDINATES`] the node has, in order: all, of a plane housing 0, 1 and 5.
    pub fn coordinates(&self) -> &'static [usize] {
        if self.dimension == 3 { &[0, 1, 2, 3, 4, 5] } else { &[0, 1, 5] }
    }

    /// Coordinates of the node in a rigid motion of the whole housing: `displacement` (m) of the mesh's origin and `rotation`
    /// (rad) about it, in the mesh's axes. In the plane displacements along x and y and the rotation about z count.
    pub fn rigid_motion(&self, displacement: [f64; 3], rotation: [f64; 3]) -> Vec<f64> {
        let turned = Vector3::from(rotation).cross(&Vector3::from(self.point));
        let moved = Vector3::from(displacement) + turned;
        match self.dimension {
            3 => moved.iter().chain(&rotation).copied().collect(),
            _ => vec![moved.x, moved.y, rotation[2]],
        }
    }
}

/// Names of a centre node's coordinates, in their order.
pub const CENTRE_COORDINATES: [&str; 6] = ["u_x", "u_y", "u_z", "theta_x", "theta_y", "theta_z"];

fn motions_of(dimension: usize) -> usize {
    if dimension == 3 { 6 } else { 3 }
}

fn arm(node: [f64; 3], point: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| node[k] - point[k])
}

/// Displacement at an arm from the centre in a unit motion of it: a column of `R_i`.
fn rigid(dimension: usize, motion: usize, [x, y, z]: [f64; 3]) -> [f64; 3] {
    match (motion, dimension) {
        (0, _) => [1.0, 0.0, 0.0],
        (1, _) => [0.0, 1.0, 0.0],
        (2, 3) => [0.0, 0.0, 1.0],
        (3, _) => [0.0, -z, y],
        (4, _) => [z, 0.0, -x],
        _ => [-y, x, 0.0],
    }
}

/// The mean of points, m.
fn mean_point(housing: &HousingModel, nodes: &[usize]) -> Vector3<f64> {
    let sum: Vector3<f64> = nodes.iter().map(|&node| Vector3::from(housing.coordinates[node])).sum();
    sum / nodes.len() as f64
}

/// `sum_i (|a|^2 1 - a a^T)` over the arms a from the mean of the nodes, m^2; in the plane its last entry alone counts.
fn inertia(housing: &HousingModel, nodes: &[usize], mean: &Vector3<f64>) -> Matrix3<f64> {
    let arms = nodes.iter().map(|&node| Vector3::from(housing.coordinates[node]) - mean);
    arms.map(|arm| Matrix3::from_diagonal_element(arm.norm_squared()) - arm * arm.transpose()).sum()
}

/// `W^T` [dof x 6]: about the mean m of the n nodes `R^T R` falls apart into `n 1` and the inertia J, so that there
///
/// ```text
/// theta = J^-1 sum_i a_i x u_i       u_m = sum_i u_i / n       u = u_m + theta x (x_c - m)
/// ```
fn mean_weights(housing: &HousingModel, nodes: &[usize], point: [f64; 3]) -> SparseMatrix {
    let d = housing.dimension;
    let mean = mean_point(housing, nodes);
    let inertia = inertia(housing, nodes, &mean);
    let inverse = match d {
        3 => inertia.try_inverse().unwrap_or_else(Matrix3::zeros),
        _ => Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, inertia[(2, 2)].recip())),
    };
    let to_point = Vector3::from(point) - mean;
    let share = (nodes.len() as f64).recip();
    let mut weights = TripletBuilder::new(housing.dof(), motions_of(d));
    for &node in nodes {
        let arm = Vector3::from(housing.coordinates[node]) - mean;
        // columns: what a unit displacement of the node adds to the centre's motion
        let theta = inverse * arm.cross_matrix();
        let moved = Matrix3::from_diagonal_element(share) - to_point.cross_matrix() * theta;
        for component in 0..d {
            let displacement = (0..d).map(|k| (k, moved[(k, component)]));
            let rotation = if d == 3 { 0..3 } else { 2..3 };
            let rotation = rotation.enumerate().map(|(place, k)| (d + place, theta[(k, component)]));
            for (motion, weight) in displacement.chain(rotation).filter(|(_, weight)| *weight != 0.0) {
                weights.add(d * node + component, motion, weight);
            }
        }
    }
    weights.build()
}

/// Nodes that nothing else moves, which say where a rigid body is.
fn check_nodes(housing: &HousingModel, group: &str, nodes: &[usize], point: [f64; 3]) -> Result<(), ModelError> {
    let path = &housing.path;
    let refused = |what: String| Err(ModelError::Refused(format!("{path}: {what}")));
    if point.iter().any(|x| !x.is_finite()) {
        let point = point.map(|x| x.to_string()).join(", ");
        return refused(format!(
            "the centre node of the bore \"{group}\" is at ({point}): expected three finite coordinates in m"
        ));
    }
    for &node in nodes {
        housing.check_not_fixed(node, group)?;
        if housing.tied.contains_key(&node) {
            return refused(format!(
                "node {} of the bore \"{group}\" is tied to its centre node and, by a link, to another part: keep the bore out of the linked surfaces, or join the parts by stiff springs (spring in the place of tie)",
                housing.node_tags[node]
            ));
        }
    }
    let least = housing.dimension;
    if nodes.len() < least {
        return refused(format!(
            "the bore \"{group}\" has {} on the housing, which leave rotations of its centre node open: expected at least {least}; take the whole bore into the group",
            if nodes.len() == 1 { "1 node".to_owned() } else { format!("{} nodes", nodes.len()) }
        ));
    }
    // the least moment of inertia is that about the line
    let moments = inertia(housing, nodes, &mean_point(housing, nodes)).symmetric_eigenvalues();
    let (thin, wide) = (moments.min().max(0.0).sqrt(), moments.max().sqrt());
    if wide <= 0.0 || housing.dimension == 3 && thin <= IN_LINE * wide {
        let [thin, wide] = [thin, wide].map(Brief);
        return refused(format!(
            "all {} nodes of the bore \"{group}\" lie in one line, so that it says nothing about the rotation of its centre node round this line (root sum of squared distances {thin} m from the line, {wide} m along it): expected nodes round the bore",
            nodes.len()
        ));
    }
    let (mean, size) = (mean_point(housing, nodes), wide / (nodes.len() as f64).sqrt());
    let distance = (0..housing.dimension).map(|k| (point[k] - mean[k]).abs()).fold(0.0, f64::max);
    if distance > FARTHEST * size {
        let ([x, y, z], [distance, size]) = (point.map(Brief), [distance, size].map(Brief));
        return refused(format!(
            "the centre node ({x}, {y}, {z}) m is {distance} m from the bore \"{group}\" of {size} m: expected a point near it; give `point` in m"
        ));
    }
    Ok(())
}

impl HousingPartition {
    /// Several interfaces of one housing as one: their coordinates one after the other. `parts` have names for messages.
    ///
    /// # Errors
    /// [`ModelError::Refused`] for a node that belongs to two of them, and for none.
    pub fn joined(housing: &HousingModel, parts: &[(&str, &Self)]) -> Result<Self, ModelError> {
        let (d, path) = (housing.dimension, &housing.path);
        let mut owner: BTreeMap<usize, &str> = BTreeMap::new();
        for (name, part) in parts {
            let in_mean = part.mean.weights.outer_iterator().flat_map(|column| column.indices().to_vec());
            let mut dofs: Vec<usize> = part.driven.iter().copied().chain(in_mean).collect();
            dofs.sort_unstable();
            dofs.dedup();
            for dof in dofs {
                if let Some(other) = owner.insert(dof, name) {
                    return Err(ModelError::Refused(format!(
                        "{path}: node {} belongs to two interfaces, \"{other}\" and \"{name}\": expected each node in one of them; take it out of one of the groups in gmsh",
                        housing.node_tags[dof / d]
                    )));
                }
            }
        }
        let coordinates = parts.iter().map(|(_, part)| part.tie.cols()).sum();
        let driven: Vec<usize> = parts.iter().flat_map(|(_, part)| part.driven.iter().copied()).collect();
        let means = parts.iter().map(|(_, part)| part.mean.coordinates.len()).sum();
        let mut tie = TripletBuilder::new(driven.len(), coordinates);
        let mut weights = TripletBuilder::new(housing.dof(), means);
        let mut mean_coordinates = Vec::with_capacity(means);
        let [mut row, mut column] = [0; 2];
        for (_, part) in parts {
            for (own, entries) in part.tie.outer_iterator().enumerate() {
                entries.iter().for_each(|(at, &value)| tie.add(row + at, column + own, value));
            }
            for (&coordinate, entries) in part.mean.coordinates.iter().zip(part.mean.weights.outer_iterator()) {
                entries.iter().for_each(|(dof, &value)| weights.add(dof, mean_coordinates.len(), value));
                mean_coordinates.push(column + coordinate);
            }
            row += part.driven.len();
            column += part.tie.cols();
        }
        let mut joined = Self::new(housing, driven, tie.build());
        joined.mean = Box::new(MeanTie { coordinates: mean_coordinates, weights: weights.build() });
        Ok(joined)
    }
}

#[cfg(test)]
#[path = "centre_tests.rs"]
mod tests;
