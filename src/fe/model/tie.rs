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

use super::{HousingModel, MeanTie, ModelError, Ring, RingFrame, RingSeat, Rings};
use crate::fe::mesh::Mesh;
use crate::numerics::Brief;
use crate::numerics::linalg::{SparseMatrix, TripletBuilder};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::ops::Range;

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

/// The bore that a ring is tied to.
#[derive(Debug, Clone, Copy)]
pub struct Bore<'a> {
    /// Group of its nodes.
    pub group: &'a str,
    /// Outer radius of the ring, m; where it is not known, the nodes may be anywhere.
    pub outer_radius: Option<f64>,
    /// What the nodes follow.
    pub fit: Fit,
}

/// The tie of one or more bores to their rings, ready to partition the housing's degrees of freedom.
///
/// With a sliding fit the bore nodes' displacements are (radial, tangential, axial) instead of (x, y, z).
#[derive(Debug, Clone)]
pub struct RingTie {
    partition: HousingPartition,
    /// Of each bore, which of the driven degrees of freedom are its.
    driven: Vec<Range<usize>>,
    /// Turns the partition's displacements to the mesh's axes: `u = rotation u'` [dof x dof].
    rotation: Option<SparseMatrix>,
}

impl RingTie {
    /// Ties the nodes of `group` to a ring in the model's frame, whose outer radius is `outer_radius` (m); where it is not known, the
    /// nodes may be anywhere.
    ///
    /// # Errors
    /// As [`RingTie::of_bores`].
    pub fn new(
        mesh: &Mesh,
        housing: &HousingModel,
        group: &str,
        ring: &Ring,
        outer_radius: impl Into<Option<f64>>,
        fit: Fit,
    ) -> Result<Self, ModelError> {
        let rings = Rings::one(ring.clone(), housing.frame);
        Self::of_bores(mesh, housing, &rings, &[Bore { group, outer_radius: outer_radius.into(), fit }])
    }

    /// Ties each bore to the ring of the same place in `rings`.
    ///
    /// # Errors
    /// [`ModelError::Refused`] if nodes are not at their ring, are fixed, tied elsewhere or in two bores, for a plane ring in a solid
    /// housing or the other way round, and what finding a group reports.
    pub fn of_bores(
        mesh: &Mesh,
        housing: &HousingModel,
        rings: &Rings,
        bores: &[Bore<'_>],
    ) -> Result<Self, ModelError> {
        if rings.are_in_space() != (housing.dimension == 3) {
            return Err(ModelError::Refused(format!(
                "{}: a solid housing needs a ring in space, a plane one a ring in the plane",
                housing.path
            )));
        }
        let mut rows = TieRows { of_node: vec![None; housing.coordinates.len()], ..TieRows::default() };
        let mut ranges = Vec::new();
        for (place, (seat, bore)) in rings.seats().iter().zip(bores).enumerate() {
            let before = rows.driven.len();
            rows.add(mesh, housing, seat, bore, place, bores)
                .map_err(|source| ModelError::Bore { place, source: Box::new(source) })?;
            ranges.push(before..rows.driven.len());
        }
        let TieRows { driven, entries, of_node } = rows;
        let mut tie = TripletBuilder::new(driven.len(), rings.dof());
        entries.into_iter().for_each(|(row, column, factor)| tie.add(row, column, factor));
        let sliding =
            |place: Option<usize>| Some(&rings.seats()[place.filter(|&place| bores[place].fit == Fit::Sliding)?]);
        let slides = bores.iter().any(|bore| bore.fit == Fit::Sliding);
        Ok(Self {
            partition: HousingPartition::new(housing, driven, tie.build()),
            driven: ranges,
            rotation: slides.then(|| polar_rotation(housing, |node| sliding(of_node[node]).map(|seat| &seat.frame))),
        })
    }

    /// Degrees of freedom that follow each ring.
    pub(crate) fn driven(&self) -> impl Iterator<Item = &[usize]> {
        self.driven.iter().map(|range| &self.partition.driven[range.clone()])
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

/// Rows of a tie under construction.
#[derive(Default)]
struct TieRows {
    driven: Vec<usize>,
    /// Row, column, factor.
    entries: Vec<(usize, usize, f64)>,
    /// Which bore has a node.
    of_node: Vec<Option<usize>>,
}

impl TieRows {
    /// The nodes of the bore at `place` follow the ring of `seat`.
    fn add(
        &mut self,
        mesh: &Mesh,
        housing: &HousingModel,
        seat: &RingSeat,
        bore: &Bore<'_>,
        place: usize,
        bores: &[Bore<'_>],
    ) -> Result<(), ModelError> {
        let group = bore.group;
        let found = housing.group_on_housing(mesh, group, "the tie")?;
        let on_housing = |node: &usize| housing.used[*node];
        let nodes: Vec<usize> = found.nodes.iter().copied().filter(on_housing).collect();
        if let Some(outer_radius) = bore.outer_radius {
            check_places(housing, &seat.frame, group, &nodes, outer_radius)?;
        }
        check_free(housing, group, &nodes)?;
        let d = housing.dimension;
        let components = if bore.fit == Fit::Bonded { d } else { 1 };
        for &node in &nodes {
            if let Some(other) = self.of_node[node].replace(place) {
                return Err(ModelError::Refused(format!(
                    "{}: node {} is in the bores \"{}\" and \"{group}\": expected bores without a common node, each ring in its own",
                    housing.path, housing.node_tags[node], bores[other].group
                )));
            }
            let point = housing.coordinates[node];
            let polar = section_rows(&seat.ring, seat.frame.point(point));
            let axes = seat.frame.polar_axes(point);
            for component in 0..components {
                let along = axes.map(|axis| axis[component]);
                let row = self.driven.len();
                self.driven.push(d * node + component);
                for (dof, moves) in &polar {
                    let factor = match bore.fit {
                        Fit::Bonded => (0..3).map(|k| moves[k] * along[k]).sum(),
                        Fit::Sliding => moves[0],
                    };
                    self.entries.push((row, seat.first + dof, factor));
                }
            }
        }
        Ok(())
    }
}

/// Displacement (radial, tangential, axial) of the ring's section at a bore node (m, the ring's frame), for each of the ring's
/// degrees of freedom that moves it.
fn section_rows(ring: &Ring, [x, y, z]: [f64; 3]) -> Vec<(usize, [f64; 3])> {
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
fn check_places(
    housing: &HousingModel,
    frame: &RingFrame,
    group: &str,
    nodes: &[usize],
    outer_radius: f64,
) -> Result<(), ModelError> {
    let in_ring = |node: usize| frame.point(housing.coordinates[node]);
    let extremes = |of: fn([f64; 3]) -> f64| {
        nodes.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &node| {
            let value = of(in_ring(node));
            [low.min(value), high.max(value)]
        })
    };
    let [nearest, farthest] = extremes(|[x, y, _]| x.hypot(y));
    let [lowest, highest] = extremes(|[_, _, z]| z);
    let tolerance = RADIUS_TOLERANCE * outer_radius;
    let ([x, y, z], [a, b, c]) = (frame.centre().map(Brief), frame.axis());
    if outer_radius - nearest > tolerance || farthest - outer_radius > tolerance {
        let at_ring = nodes.iter().filter(|&&node| {
            let [x, y, _] = in_ring(node);
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

/// Identity but for nodes with a frame of a ring, whose displacements become (radial, tangential, axial) there.
fn polar_rotation<'f>(housing: &HousingModel, frame: impl Fn(usize) -> Option<&'f RingFrame>) -> SparseMatrix {
    let d = housing.dimension;
    let mut rotation = TripletBuilder::new(housing.dof(), housing.dof());
    for (node, &point) in housing.coordinates.iter().enumerate() {
        let Some(frame) = frame(node) else {
            (d * node..d * node + d).for_each(|dof| rotation.add(dof, dof, 1.0));
            continue;
        };
        let axes = frame.polar_axes(point);
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
