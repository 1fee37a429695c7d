//! The tie of a housing's bore to the ring's own interpolation.
//!
//! A bore node at angle theta and radius r moves with the ring's section there. In the plane,
//!
//! ```text
//! u_r = w(theta)      u_t = u(theta) + (r - R_C) theta_z(theta)      bonded
//! u_r = w(theta)      u_t free                                       sliding
//! ```
//!
//! in space with the section's displacement and rotation `omega` about its centroid x_C,
//!
//! ```text
//! u = u_C(theta) + omega(theta) x (x - x_C)                          bonded
//! u_r of it           u_t, u_z free                                  sliding
//! ```
//!
//! Each node takes the ring's displacement at its own angle, radius and axial place, so that no mesh has
//! to match and rigid motions of ring and housing are one and the same, three or six.
//!
//! How the degrees of freedom of a housing split at its interface, and nodes of the mesh as one.

use super::{HousingModel, MeanTie, ModelError, Ring};
use crate::fe::mesh::Mesh;
use crate::numerics::Brief;
use crate::numerics::linalg::{SparseMatrix, TripletBuilder};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Deviation of a bore node from the ring's outer radius, and of the ring's plane from the bore, that a tie accepts,
/// relative to that radius. Chords of a
/// coarse first-order mesh keep their nodes on the circle; a wrong unit or centre does not.
const RADIUS_TOLERANCE: f64 = 0.01;

/// Share of a group's nodes at the ring's outer radius from which on the others are what is wrong: fewer are where a cylinder of
/// another radius or centre crosses it.
const LEAST_SHARE: f64 = 0.25;

/// What the bore follows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Fit {
    /// The ring's section in all directions.
    #[default]
    Bonded,
    /// The ring's radial displacement only; the ring may turn in the bore and, in a solid housing, move along it.
    Sliding,
}

/// A tie, ready to partition the housing's degrees of freedom.
///
/// With a sliding fit the bore nodes' displacements are (radial, tangential, axial) instead of (x, y, z).
#[derive(Debug, Clone)]
pub struct RingTie {
    partition: HousingPartition,
    /// Turns the partition's displacements to the mesh's axes: `u = rotation u'` [dof x dof].
    rotation: Option<SparseMatrix>,
}

impl RingTie {
    /// Ties the nodes of `group` to the ring, whose outer radius is `outer_radius` (m); where it is not known, the nodes may be anywhere.
    ///
    /// # Errors
    /// [`ModelError::Refused`] if the nodes are not at the ring, are fixed or tied elsewhere, for a plane ring in a solid
    /// housing or the other way round, and what finding the group reports.
    pub fn new(
        mesh: &Mesh,
        housing: &HousingModel,
        group: &str,
        ring: &Ring,
        outer_radius: impl Into<Option<f64>>,
        fit: Fit,
    ) -> Result<Self, ModelError> {
        if ring.is_in_space() != (housing.dimension == 3) {
            return Err(ModelError::Refused(format!(
                "{}: a solid housing needs a ring in space, a plane one a ring in the plane",
                housing.path
            )));
        }
        let bore = housing.group_on_housing(mesh, group, "the tie")?;
        let on_housing = |node: &usize| housing.used[*node];
        let nodes: Vec<usize> = bore.nodes.iter().copied().filter(on_housing).collect();
        if let Some(outer_radius) = outer_radius.into() {
            check_places(housing, group, &nodes, outer_radius)?;
        }
        check_free(housing, group, &nodes)?;
        let d = housing.dimension;
        let components = if fit == Fit::Bonded { d } else { 1 };
        let mut driven = Vec::with_capacity(components * nodes.len());
        let mut tie = TripletBuilder::new(components * nodes.len(), ring.dof());
        for &node in &nodes {
            let polar = section_rows(housing, ring, node);
            let axes = housing.frame.polar_axes(housing.coordinates[node]);
            for component in 0..components {
                let along = axes.map(|axis| axis[component]);
                let row = driven.len();
                driven.push(d * node + component);
                for (dof, moves) in &polar {
                    let factor = match fit {
                        Fit::Bonded => (0..3).map(|k| moves[k] * along[k]).sum(),
                        Fit::Sliding => moves[0],
                    };
                    tie.add(row, *dof, factor);
                }
            }
        }
        Ok(Self {
            partition: HousingPartition::new(housing, driven, tie.build()),
            rotation: (fit == Fit::Sliding).then(|| polar_rotation(housing, &nodes)),
        })
    }

    /// The split of the housing's degrees of freedom.
    pub fn partition(&self) -> &HousingPartition {
        &self.partition
    }

    /// Matrix that turns the partition's displacements to the mesh's axes, if they are not along them already.
    pub fn rotation(&self) -> Option<&SparseMatrix> {
        self.rotation.as_ref()
    }

    /// The row of a displacement component at a node, in the partition's displacements:
    /// pairs (degree of freedom, factor). `direction` is in the mesh's axes; its z does not count in the plane.
    pub(crate) fn displacement_row(
        &self,
        housing: &HousingModel,
        node: usize,
        direction: [f64; 3],
    ) -> Vec<(usize, f64)> {
        let row = housing.displacement_row(node, direction);
        let Some(rotation) = &self.rotation else {
            return row;
        };
        let d = housing.dimension;
        let turned = row.into_iter().flat_map(|(dof, factor)| {
            let first = dof - dof % d;
            (first..first + d).map(move |column| {
                let turned = rotation.get(dof, column).copied().unwrap_or(0.0);
                (column, factor * turned)
            })
        });
        turned.collect()
    }
}

/// Displacement (radial, tangential, axial) of the ring's section at a bore node, for each of the ring's
/// degrees of freedom that moves it.
fn section_rows(housing: &HousingModel, ring: &Ring, node: usize) -> Vec<(usize, [f64; 3])> {
    let [x, y, z] = housing.ring_coordinates(node);
    let (arm, angle) = (x.hypot(y) - ring.section().radius, y.atan2(x));
    match ring.space_rows_at(angle) {
        None => {
            let rows = ring.rows_at(angle);
            let tangential = rows.tangential_at(arm);
            let pairs = rows.dofs.into_iter().zip(rows.radial).zip(tangential);
            pairs.map(|((dof, w), u)| (dof, [w, u, 0.0])).collect()
        }
        Some(rows) => {
            let moves = rows.displacement_at(arm, z);
            (0..rows.dofs.len()).map(|k| (rows.dofs[k], moves.map(|row| row[k]))).collect()
        }
    }
}

/// The nodes stand at the ring's outer radius. In space the ring's plane cuts the bore: a section that reached beyond it as a
/// rigid arm would be stiffer than any bore.
fn check_places(housing: &HousingModel, group: &str, nodes: &[usize], outer_radius: f64) -> Result<(), ModelError> {
    let extremes = |of: fn([f64; 3]) -> f64| {
        nodes.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &node| {
            let value = of(housing.ring_coordinates(node));
            [low.min(value), high.max(value)]
        })
    };
    let [nearest, farthest] = extremes(|[x, y, _]| x.hypot(y));
    let [lowest, highest] = extremes(|[_, _, z]| z);
    let tolerance = RADIUS_TOLERANCE * outer_radius;
    let ([x, y, z], [a, b, c]) = (housing.frame.centre().map(Brief), housing.frame.axis());
    if outer_radius - nearest > tolerance || farthest - outer_radius > tolerance {
        let at_ring = nodes.iter().filter(|&&node| {
            let [x, y, _] = housing.ring_coordinates(node);
            (x.hypot(y) - outer_radius).abs() <= tolerance
        });
        let share = at_ring.count() as f64 / nodes.len() as f64;
        let [outer_radius, nearest, farthest] = [outer_radius, nearest, farthest].map(Brief);
        if share >= LEAST_SHARE {
            return Err(ModelError::Refused(format!(
                "{:.0} % of the nodes of group \"{group}\" ({}) lie at the ring's outer radius {outer_radius} m, and the others do not: all lie {nearest} to {farthest} m from the axis through ({x}, {y}, {z}) m along ({a}, {b}, {c}); a tie takes the cylinder alone: leave shoulders and chamfers out of the group",
                100.0 * share,
                housing.path
            )));
        }
        return Err(ModelError::Refused(format!(
            "the tie finds no nodes of group \"{group}\" ({}) at the ring's outer radius {outer_radius} m: they lie {nearest} to {farthest} m from the axis through ({x}, {y}, {z}) m along ({a}, {b}, {c}); check length_unit, tie.centre, tie.axis and ring.outer_radius",
            housing.path
        )));
    }
    if housing.dimension == 3 && (lowest > tolerance || highest < -tolerance) {
        let [lowest, highest] = [lowest, highest].map(Brief);
        return Err(ModelError::Refused(format!(
            "the ring's plane, through ({x}, {y}, {z}) m across ({a}, {b}, {c}), does not cut the group \"{group}\" ({}) that it is tied to: its nodes lie {lowest} to {highest} m from there along the axis, expected on both sides; check length_unit and tie.centre",
            housing.path
        )));
    }
    Ok(())
}

/// No node of the bore is fixed or tied by a link.
fn check_free(housing: &HousingModel, group: &str, nodes: &[usize]) -> Result<(), ModelError> {
    for &node in nodes {
        housing.check_not_fixed(node, group)?;
        if housing.tied.contains_key(&node) {
            return Err(ModelError::Refused(format!(
                "{}: node {} of the bore \"{group}\" is tied to the ring and, by a link, to another part: keep the bore out of the linked surfaces, or join the parts by stiff springs (spring in the place of tie)",
                housing.path, housing.node_tags[node]
            )));
        }
    }
    Ok(())
}

/// Identity but for the bore nodes, whose displacements become (radial, tangential, axial).
fn polar_rotation(housing: &HousingModel, nodes: &[usize]) -> SparseMatrix {
    let d = housing.dimension;
    let mut polar = vec![false; housing.coordinates.len()];
    nodes.iter().for_each(|&node| polar[node] = true);
    let mut rotation = TripletBuilder::new(housing.dof(), housing.dof());
    for (node, &point) in housing.coordinates.iter().enumerate() {
        if !polar[node] {
            (d * node..d * node + d).for_each(|dof| rotation.add(dof, dof, 1.0));
            continue;
        }
        let axes = housing.frame.polar_axes(point);
        for (k, axis) in axes.iter().enumerate().take(d) {
            for (i, &component) in axis.iter().enumerate().take(d) {
                rotation.add(d * node + i, d * node + k, component);
            }
        }
    }
    rotation.build()
}

/// Degrees of freedom of a housing seen from its interface.
#[derive(Debug, Clone)]
pub struct HousingPartition {
    /// Degrees of freedom that the tie drives.
    pub driven: Vec<usize>,
    /// Degrees of freedom that stay free, neither driven nor fixed, ascending.
    pub interior: Vec<usize>,
    /// T: displacements of `driven` from the interface coordinates [driven x interface].
    pub tie: SparseMatrix,
    /// Interface coordinates that follow the interior instead of driving it; their columns of T are empty.
    pub mean: Box<MeanTie>,
}

impl HousingPartition {
    /// The partition of a housing by the degrees of freedom that a tie drives.
    pub(super) fn new(model: &HousingModel, driven: Vec<usize>, tie: SparseMatrix) -> Self {
        let mut is_driven = vec![false; model.dof()];
        driven.iter().for_each(|&dof| is_driven[dof] = true);
        let free = model.free_dofs().into_iter();
        let interior = free.filter(|&dof| !is_driven[dof]).collect();
        Self { interior, driven, tie, mean: Box::default() }
    }
}

/// Nodes as an interface, and what could not be part of it.
#[derive(Debug, Clone)]
pub struct NodeInterface {
    /// The split: every free displacement of the nodes is a coordinate, node by node in the order given.
    pub partition: HousingPartition,
    /// Node (index) and component of every coordinate \[interface\].
    pub coordinates: Vec<(usize, usize)>,
    /// Displacements of the nodes (index, component) that a support holds or a link ties: they are no coordinates.
    pub held: Vec<(usize, usize)>,
}

impl NodeInterface {
    /// What holds or ties the displacements that are left out, in words.
    pub(crate) fn holders(&self, model: &HousingModel) -> String {
        let support = |&(node, component): &(usize, usize)| model.fixed[node][component];
        let supports: BTreeSet<usize> = self.held.iter().filter_map(support).collect();
        let groups = supports.iter().map(|&place| &model.description.supports[place].group);
        let mut words: Vec<String> = groups.map(|group| format!("the support \"{group}\"")).collect();
        if self.held.iter().any(|held| model.tied.contains_key(&held.0)) {
            words.push("a link".to_owned());
        }
        words.join(" and ")
    }

    /// Makes `nodes` (indices, each once) the interface of a housing.
    pub fn new(model: &HousingModel, nodes: &[usize]) -> Self {
        let d = model.dimension();
        let free = model.free_dofs();
        let wanted = nodes.iter().flat_map(|&node| (0..d).map(move |component| (node, component)));
        let (coordinates, held): (Vec<_>, Vec<_>) =
            wanted.partition(|&(node, component)| free.binary_search(&(d * node + component)).is_ok());
        let driven: Vec<usize> = coordinates.iter().map(|&(node, component)| d * node + component).collect();
        let identity = SparseMatrix::eye_csc(driven.len());
        Self { partition: HousingPartition::new(model, driven, identity), coordinates, held }
    }
}
