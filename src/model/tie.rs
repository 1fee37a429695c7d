//! The tie of a housing's bore to the ring's own interpolation.
//!
//! A bore node at angle theta and radius r moves with the ring's section there,
//!
//! ```text
//! u_r = w(theta)      u_t = u(theta) + (r - R_C) theta_z(theta)      bonded
//! u_r = w(theta)      u_t free                                       sliding
//! ```
//!
//! Each node takes the ring's displacement at its own angle and its own radius, so that no mesh has
//! to match and rigid motions of ring and housing are one and the same.

use super::{HousingModel, HousingPartition, ModelError, Ring};
use crate::linalg::{SparseMatrix, TripletBuilder};
use crate::mesh::Mesh;

/// Deviation of a bore node from the ring's outer radius that a tie accepts, relative. Chords of a
/// coarse first-order mesh keep their nodes on the circle; a wrong unit or centre does not.
const RADIUS_TOLERANCE: f64 = 0.01;

/// Whether the bore sticks to the ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fit {
    /// Both displacement components follow the ring.
    Bonded,
    /// The radial one follows, the tangential one is free.
    Sliding,
}

/// A tie, ready to partition the housing's degrees of freedom.
///
/// With a sliding fit the bore nodes' displacements are (radial, tangential) instead of (x, y).
#[derive(Debug, Clone)]
pub struct RingTie {
    partition: HousingPartition,
    /// Turns the partition's displacements to (x, y): `u = rotation u'` [dof x dof].
    rotation: Option<SparseMatrix>,
}

impl RingTie {
    /// Ties the nodes of `group` to the ring, whose outer radius is `outer_radius` (m).
    ///
    /// # Errors
    /// [`ModelError::TieRadius`] if the nodes are not at the ring, [`ModelError::TiedAndFixed`],
    /// and what finding the group reports.
    pub fn new(
        mesh: &Mesh,
        housing: &HousingModel,
        group: &str,
        ring: &Ring,
        outer_radius: f64,
        fit: Fit,
    ) -> Result<Self, ModelError> {
        let bore = housing.group_on_housing(mesh, group, "the tie")?;
        let nodes: Vec<usize> = bore
            .nodes
            .iter()
            .copied()
            .filter(|&node| housing.used[node])
            .collect();
        check_radius(mesh, housing, group, &nodes, outer_radius)?;
        check_fixed(housing, group, &nodes)?;
        let driven: Vec<usize> = nodes
            .iter()
            .flat_map(|&node| match fit {
                Fit::Bonded => vec![2 * node, 2 * node + 1],
                Fit::Sliding => vec![2 * node],
            })
            .collect();
        let mut tie = TripletBuilder::new(driven.len(), ring.dof());
        for (index, &node) in nodes.iter().enumerate() {
            let [x, y] = housing.coordinates[node];
            let (radius, angle) = (x.hypot(y), y.atan2(x));
            let rows = ring.rows_at(angle);
            let tangential = rows.tangential_at(radius - ring.section().radius);
            let (sin, cos) = angle.sin_cos();
            for ((dof, w), u) in rows.dofs.into_iter().zip(rows.radial).zip(tangential) {
                match fit {
                    Fit::Bonded => {
                        tie.add(2 * index, dof, w * cos - u * sin);
                        tie.add(2 * index + 1, dof, w * sin + u * cos);
                    }
                    Fit::Sliding => tie.add(index, dof, w),
                }
            }
        }
        let mut is_driven = vec![false; housing.dof()];
        for &dof in &driven {
            is_driven[dof] = true;
        }
        let interior = housing
            .free_dofs()
            .into_iter()
            .filter(|&dof| !is_driven[dof])
            .collect();
        Ok(Self {
            partition: HousingPartition {
                driven,
                interior,
                tie: tie.build(),
            },
            rotation: (fit == Fit::Sliding).then(|| polar_rotation(housing, &nodes)),
        })
    }

    /// The split of the housing's degrees of freedom.
    pub fn partition(&self) -> &HousingPartition {
        &self.partition
    }

    /// Matrix that turns the partition's displacements to (x, y), if they are not (x, y) already.
    pub fn rotation(&self) -> Option<&SparseMatrix> {
        self.rotation.as_ref()
    }

    /// The row of a displacement component at a node, in the partition's displacements:
    /// pairs (degree of freedom, factor).
    pub fn displacement_row(&self, node: usize, direction: [f64; 2]) -> Vec<(usize, f64)> {
        let components = [2 * node, 2 * node + 1];
        match &self.rotation {
            None => components.into_iter().zip(direction).collect(),
            Some(rotation) => components
                .into_iter()
                .map(|column| {
                    let factor = components
                        .into_iter()
                        .zip(direction)
                        .map(|(row, part)| part * rotation.get(row, column).unwrap_or(&0.0))
                        .sum();
                    (column, factor)
                })
                .collect(),
        }
    }
}

fn check_radius(
    mesh: &Mesh,
    housing: &HousingModel,
    group: &str,
    nodes: &[usize],
    outer_radius: f64,
) -> Result<(), ModelError> {
    let radius = |&node: &usize| {
        let [x, y] = housing.coordinates[node];
        x.hypot(y)
    };
    let nearest = nodes.iter().map(radius).fold(f64::INFINITY, f64::min);
    let farthest = nodes.iter().map(radius).fold(0.0, f64::max);
    let tolerance = RADIUS_TOLERANCE * outer_radius;
    if outer_radius - nearest > tolerance || farthest - outer_radius > tolerance {
        let any = nodes.first().copied().unwrap_or(0);
        return Err(ModelError::TieRadius {
            path: housing.path.clone(),
            group: group.to_owned(),
            expected: outer_radius,
            nearest,
            farthest,
            centre: [0, 1].map(|k| mesh.nodes[any][k] - housing.coordinates[any][k]),
        });
    }
    Ok(())
}

fn check_fixed(housing: &HousingModel, group: &str, nodes: &[usize]) -> Result<(), ModelError> {
    let clash = nodes
        .iter()
        .find_map(|&node| Some((node, housing.fixed[node].iter().flatten().next()?)));
    match clash {
        Some((node, &support)) => Err(ModelError::TiedAndFixed {
            path: housing.path.clone(),
            tag: housing.node_tags[node],
            tied: group.to_owned(),
            fixed: housing.supports[support].group.clone(),
        }),
        None => Ok(()),
    }
}

/// Identity but for the bore nodes, whose two displacements become (radial, tangential).
fn polar_rotation(housing: &HousingModel, nodes: &[usize]) -> SparseMatrix {
    let mut polar = vec![false; housing.coordinates.len()];
    for &node in nodes {
        polar[node] = true;
    }
    let mut rotation = TripletBuilder::new(housing.dof(), housing.dof());
    for (node, [x, y]) in housing.coordinates.iter().enumerate() {
        let (row, column) = (2 * node, 2 * node + 1);
        if polar[node] {
            let (sin, cos) = y.atan2(*x).sin_cos();
            rotation.add(row, row, cos);
            rotation.add(row, column, -sin);
            rotation.add(column, row, sin);
            rotation.add(column, column, cos);
        } else {
            rotation.add(row, row, 1.0);
            rotation.add(column, column, 1.0);
        }
    }
    rotation.build()
}
