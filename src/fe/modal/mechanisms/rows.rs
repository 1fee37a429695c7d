//! Constraints on the rigid motions of bodies: rows that vanish for every motion without energy.
//!
//! A body's motion is its translation and its rotation times its radius, about its centre: all of one unit, so that
//! entries are of the order 1 for bodies of any size.

use super::super::motions::{rigid_component, rigid_count, ring_motions};
use super::super::spring_rows::{SpringRow, spring_rows};
use super::bodies::BodyMap;
use crate::fe::model::{HousingModel, NodalSource, Ring, RingFrame, RingTie};
use crate::numerics::linalg::{DenseMatrix, SparseMatrix};
use nalgebra::DMatrix;
use std::collections::{BTreeMap, BTreeSet};

/// Singular values below this count as zero: nodes of a hinge that are out of line by less than a millionth of the
/// body. Coordinates have 1e-16 of its place, the least joint of a mesh is one element, 1e-3 of it.
const RANK: f64 = 1e-6;

/// Which bodies a constraint acts on, and whether it holds them to the ground or to each other.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Between {
    pub bodies: Vec<usize>,
    pub ground: bool,
}

/// Constraints between the same bodies.
#[derive(Debug, Default)]
pub(super) struct Constraints {
    /// Rows over the motions of the bodies in their order, each `motions` long.
    rows: Vec<Vec<f64>>,
    count: usize,
    /// Nodes that the bodies share.
    pub shared_nodes: BTreeSet<usize>,
    /// Links by springs between them.
    pub links: BTreeSet<usize>,
    /// Whether a tie joins them.
    pub tied: bool,
}

/// A row: factors of the motions of each body.
type Row = BTreeMap<usize, [f64; 6]>;

/// All constraints of a housing.
pub(super) struct AllConstraints<'m> {
    model: &'m HousingModel,
    bodies: &'m BodyMap,
    pub between: BTreeMap<Between, Constraints>,
}

impl<'m> AllConstraints<'m> {
    pub(super) fn new(model: &'m HousingModel, bodies: &'m BodyMap) -> Self {
        let mut all = Self { model, bodies, between: BTreeMap::new() };
        all.shared_nodes();
        all.fixed_nodes();
        all.tied_nodes();
        all.springs();
        all
    }

    /// Adds `factor` times a displacement component of a node, as a node of `body`.
    fn displacement(&self, row: &mut Row, body: usize, node: usize, component: usize, factor: f64) {
        let extent = self.bodies.extents[body];
        let size = if extent.radius > 0.0 { extent.radius } else { 1.0 };
        let at = self.model.coordinates[node];
        let arm = [0, 1, 2].map(|axis| (at[axis] - extent.centre[axis]) / size);
        let d = self.model.dimension;
        let own = row.entry(body).or_default();
        for (motion, entry) in own.iter_mut().enumerate().take(rigid_count(d)) {
            *entry += factor * rigid_component(d, arm, component, motion);
        }
    }

    /// The ring: every driven displacement of the bore follows it, and its springs hold it.
    pub(super) fn add_ring(&mut self, tie: &RingTie, ring: &Ring) {
        let Some(number) = self.bodies.ring else {
            return;
        };
        for &dof in &tie.partition().driven {
            let mut row = Row::new();
            let node = dof / self.model.dimension;
            let Some(body) = self.bodies.of_node(node) else {
                continue;
            };
            self.driven(&mut row, body, dof, tie.rotation(), 1.0);
            self.driven(&mut row, number, dof, tie.rotation(), -1.0);
            if let Some(constraints) = self.add(&row, false) {
                constraints.tied = true;
            }
        }
        for own in ring_spring_rows(ring, &self.model.frame) {
            self.add(&Row::from([(number, own)]), true);
        }
    }

    /// Holds displacements, which `rotation` turns to the mesh's axes if they are not along them.
    pub(super) fn hold(&mut self, dofs: &[usize], rotation: Option<&SparseMatrix>) {
        for &dof in dofs {
            let mut row = Row::new();
            if let Some(body) = self.bodies.of_node(dof / self.model.dimension) {
                self.driven(&mut row, body, dof, rotation, 1.0);
                self.add(&row, true);
            }
        }
    }

    /// Adds `factor` times a displacement in the axes that `rotation` turns to the mesh's, as one of `body`.
    fn driven(&self, row: &mut Row, body: usize, dof: usize, rotation: Option<&SparseMatrix>, factor: f64) {
        let d = self.model.dimension;
        let (node, component) = (dof / d, dof % d);
        for i in 0..d {
            let along = match rotation {
                // u' = rotation^T u
                Some(rotation) => rotation.get(d * node + i, dof).copied().unwrap_or(0.0),
                None => f64::from(u8::from(i == component)),
            };
            self.displacement(row, body, node, i, factor * along);
        }
    }

    fn add(&mut self, row: &Row, ground: bool) -> Option<&mut Constraints> {
        let motions = rigid_count(self.model.dimension);
        let key = Between { bodies: row.keys().copied().collect(), ground };
        // what only joins a body to itself, a link within it, says nothing
        if key.bodies.is_empty() || (key.bodies.len() == 1 && !ground) {
            return None;
        }
        let constraints = self.between.entry(key).or_default();
        let flat = row.values().flat_map(|own| own[..motions].iter().copied());
        constraints.push(flat.collect());
        Some(constraints)
    }

    /// A node of several bodies moves with each of them.
    fn shared_nodes(&mut self) {
        let bodies = self.bodies;
        for (&node, others) in &bodies.shared {
            let Some(first) = bodies.of_node(node) else {
                continue;
            };
            for &other in others {
                for component in 0..self.model.dimension {
                    let mut row = Row::new();
                    self.displacement(&mut row, first, node, component, 1.0);
                    self.displacement(&mut row, other, node, component, -1.0);
                    if let Some(constraints) = self.add(&row, false) {
                        constraints.shared_nodes.insert(node);
                    }
                }
            }
        }
    }

    fn fixed_nodes(&mut self) {
        let model = self.model;
        for (node, fixed) in model.fixed.iter().enumerate() {
            let Some(body) = self.bodies.of_node(node) else {
                continue;
            };
            for (component, _) in fixed.iter().enumerate().filter(|fixed| fixed.1.is_some()) {
                if component < model.dimension {
                    let mut row = Row::new();
                    self.displacement(&mut row, body, node, component, 1.0);
                    self.add(&row, true);
                }
            }
        }
    }

    fn tied_nodes(&mut self) {
        let model = self.model;
        for (&node, tied) in &model.tied {
            let Some(body) = self.bodies.of_node(node) else {
                continue;
            };
            for i in 0..model.dimension {
                let mut row = Row::new();
                self.displacement(&mut row, body, node, i, 1.0);
                for (&leader, follow) in tied.foot.nodes.iter().zip(&tied.foot.follow) {
                    let Some(other) = self.bodies.of_node(leader) else {
                        continue;
                    };
                    for j in 0..model.dimension {
                        self.displacement(&mut row, other, leader, j, -follow[(i, j)]);
                    }
                }
                if let Some(constraints) = self.add(&row, false) {
                    constraints.tied = true;
                }
            }
        }
    }

    fn springs(&mut self) {
        let (model, d) = (self.model, self.model.dimension);
        for spring in &model.springs {
            for SpringRow { factors, .. } in spring_rows(&spring.matrix) {
                let mut row = Row::new();
                for (place, &factor) in factors.iter().enumerate() {
                    let node = spring.nodes.get(place / d).copied();
                    let body = node.and_then(|node| self.bodies.of_node(node));
                    if let (Some(node), Some(body)) = (node, body) {
                        self.displacement(&mut row, body, node, place % d, factor);
                    }
                }
                match spring.source {
                    NodalSource::Link(link) => {
                        if let Some(constraints) = self.add(&row, false) {
                            constraints.links.insert(link);
                        }
                    }
                    _ => {
                        self.add(&row, true);
                    }
                }
            }
        }
    }
}

impl Constraints {
    fn push(&mut self, row: Vec<f64>) {
        let columns = row.len();
        self.rows.push(row);
        self.count += 1;
        if self.rows.len() > 8 * columns {
            self.compress();
        }
    }

    /// As many rows as columns with the same null space and the same singular values.
    fn compress(&mut self) {
        let Some(columns) = self.rows.first().map(Vec::len) else {
            return;
        };
        let stacked = DMatrix::from_fn(self.rows.len(), columns, |i, j| self.rows[i][j]);
        let r = stacked.qr().r();
        self.rows = r.row_iter().map(|row| row.iter().copied().collect()).collect();
    }

    /// The rows over the root of their number, so that a large joint does not drown a small one.
    pub(super) fn scaled_rows(&self) -> impl Iterator<Item = Vec<f64>> + '_ {
        let scale = (self.count.max(1) as f64).sqrt().recip();
        self.rows.iter().map(move |row| row.iter().map(|x| x * scale).collect())
    }
}

/// What each spring of a ring resists, in the motions of the ring about its own centre.
pub(super) fn ring_spring_rows(ring: &Ring, frame: &RingFrame) -> Vec<[f64; 6]> {
    let motions = ring_motions(ring, frame, frame.centre());
    let translations = if ring.is_in_space() { 3 } else { 2 };
    let of_spring = ring.springs.iter().map(|spring| {
        let mut row = [0.0; 6];
        for (motion, entry) in row.iter_mut().enumerate().take(motions.ncols()) {
            let turn = if motion < translations { 1.0 } else { ring.section().radius };
            *entry = spring.stretch(motions.col_as_slice(motion)) / turn;
        }
        row
    });
    of_spring.collect()
}

/// Number of singular values of some rows that do not count as zero.
pub(super) fn rank(rows: &[Vec<f64>]) -> usize {
    let columns = rows.first().map_or(0, Vec::len);
    if columns == 0 {
        return 0;
    }
    let matrix = DenseMatrix::from_fn(rows.len(), columns, |i, j| rows[i][j]);
    // rows that are not finite hold nothing
    let values = matrix.singular_values().unwrap_or_default();
    values.into_iter().filter(|value| *value > RANK).count()
}
