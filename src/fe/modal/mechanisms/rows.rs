//! Constraints on the rigid motions of bodies: rows that vanish for every motion without energy.
//!
//! A body's motion is its translation and its rotation times its radius, about its centre: all of one unit, so that
//! entries are of the order 1 for bodies of any size.

use super::super::motions::{rigid_component, rigid_count, seat_motions};
use super::super::strain_products::{SpringRow, spring_rows};
use super::bodies::BodyMap;
use crate::fe::model::{HousingModel, NodalSource, RingSeat, RingTie, Rings};
use crate::numerics::linalg::{DenseMatrix, SparseMatrix};
use nalgebra::DMatrix;
use std::collections::{BTreeMap, BTreeSet};
use std::iter::once;

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

/// A term of a constraint: the factor of a displacement component of a node, as a node of a body.
struct Term {
    body: usize,
    node: usize,
    component: usize,
    factor: f64,
}

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

    /// The rings: every driven displacement of a bore follows its ring, which its springs hold.
    pub(super) fn add_rings(&mut self, tie: &RingTie, rings: &Rings) {
        let bodies = self.bodies;
        for ((&number, seat), driven) in bodies.rings.iter().zip(rings.seats()).zip(tie.driven()) {
            self.add_ring(number, seat, driven, tie);
        }
    }

    fn add_ring(&mut self, number: usize, seat: &RingSeat, driven: &[usize], tie: &RingTie) {
        for &dof in driven {
            let Some(body) = self.bodies.of_node(dof / self.model.dimension) else {
                continue;
            };
            let moved = self.driven(body, dof, tie.rotation(), 1.0);
            let follows = self.driven(number, dof, tie.rotation(), -1.0);
            if let Some(constraints) = self.add(moved.chain(follows), false) {
                constraints.tied = true;
            }
        }
        for own in ring_spring_rows(seat) {
            self.add_row(&BTreeMap::from([(number, own)]), true);
        }
    }

    /// Holds displacements, which `rotation` turns to the mesh's axes if they are not along them.
    pub(super) fn hold(&mut self, dofs: &[usize], rotation: Option<&SparseMatrix>) {
        for &dof in dofs {
            if let Some(body) = self.bodies.of_node(dof / self.model.dimension) {
                self.add(self.driven(body, dof, rotation, 1.0), true);
            }
        }
    }

    /// `factor` times a displacement in the axes that `rotation` turns to the mesh's, as one of `body`.
    fn driven<'r>(
        &self,
        body: usize,
        dof: usize,
        rotation: Option<&'r SparseMatrix>,
        factor: f64,
    ) -> impl Iterator<Item = Term> + use<'r> {
        let d = self.model.dimension;
        let node = dof / d;
        (0..d).map(move |component| {
            let along = match rotation {
                // u' = rotation^T u
                Some(rotation) => rotation.get(d * node + component, dof).copied().unwrap_or(0.0),
                None => f64::from(u8::from(component == dof % d)),
            };
            Term { body, node, component, factor: factor * along }
        })
    }

    /// Adds the constraint that the sum of some terms vanishes.
    fn add(&mut self, terms: impl IntoIterator<Item = Term>, ground: bool) -> Option<&mut Constraints> {
        let d = self.model.dimension;
        let mut row: BTreeMap<usize, [f64; 6]> = BTreeMap::new();
        for Term { body, node, component, factor } in terms {
            let extent = self.bodies.extents[body];
            let size = if extent.radius > 0.0 { extent.radius } else { 1.0 };
            let at = self.model.coordinates[node];
            let arm = [0, 1, 2].map(|axis| (at[axis] - extent.centre[axis]) / size);
            let own = row.entry(body).or_default();
            for (motion, entry) in own.iter_mut().enumerate().take(rigid_count(d)) {
                *entry += factor * rigid_component(d, arm, component, motion);
            }
        }
        self.add_row(&row, ground)
    }

    /// Adds a constraint by the factors of the motions of each body.
    fn add_row(&mut self, row: &BTreeMap<usize, [f64; 6]>, ground: bool) -> Option<&mut Constraints> {
        let motions = rigid_count(self.model.dimension);
        let key = Between { bodies: row.keys().copied().collect(), ground };
        // what only joins a body to itself, a link within it, says nothing
        if key.bodies.is_empty() || (key.bodies.len() == 1 && !ground) {
            return None;
        }
        let constraints = self.between.entry(key).or_default();
        constraints.push(row.values().flat_map(|own| &own[..motions]).copied().collect());
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
                    let term = |body, factor| Term { body, node, component, factor };
                    if let Some(constraints) = self.add([term(first, 1.0), term(other, -1.0)], false) {
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
            for (component, _) in fixed.iter().enumerate().take(model.dimension).filter(|fixed| fixed.1.is_some()) {
                self.add([Term { body, node, component, factor: 1.0 }], true);
            }
        }
    }

    fn tied_nodes(&mut self) {
        let (model, bodies) = (self.model, self.bodies);
        for (&node, tied) in &model.tied {
            let Some(body) = bodies.of_node(node) else {
                continue;
            };
            for i in 0..model.dimension {
                let leaders = tied.foot.nodes.iter().zip(&tied.foot.follow).flat_map(|(&node, follow)| {
                    let body = bodies.of_node(node).into_iter();
                    let term = move |body, component| Term { body, node, component, factor: -follow[(i, component)] };
                    body.flat_map(move |body| (0..model.dimension).map(move |component| term(body, component)))
                });
                let own = Term { body, node, component: i, factor: 1.0 };
                if let Some(constraints) = self.add(once(own).chain(leaders), false) {
                    constraints.tied = true;
                }
            }
        }
    }

    fn springs(&mut self) {
        let (model, bodies, d) = (self.model, self.bodies, self.model.dimension);
        for spring in &model.springs {
            for SpringRow { factors, .. } in spring_rows(&spring.matrix) {
                let terms = factors.iter().enumerate().filter_map(|(place, &factor)| {
                    let node = *spring.nodes.get(place / d)?;
                    Some(Term { body: bodies.of_node(node)?, node, component: place % d, factor })
                });
                match spring.source {
                    NodalSource::Link(link) => {
                        if let Some(constraints) = self.add(terms, false) {
                            constraints.links.insert(link);
                        }
                    }
                    _ => {
                        self.add(terms, true);
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
            // as many rows as columns with the same null space and the same singular values
            let r = DMatrix::from_fn(self.rows.len(), columns, |i, j| self.rows[i][j]).qr().r();
            self.rows = r.row_iter().map(|row| row.iter().copied().collect()).collect();
        }
    }

    /// The rows over the root of their number, so that a large joint does not drown a small one.
    pub(super) fn scaled_rows(&self) -> impl Iterator<Item = Vec<f64>> + '_ {
        let scale = (self.count.max(1) as f64).sqrt().recip();
        self.rows.iter().map(move |row| row.iter().map(|x| x * scale).collect())
    }
}

/// What each spring of a ring resists, in the motions of the ring about its own centre.
pub(super) fn ring_spring_rows(seat: &RingSeat) -> Vec<[f64; 6]> {
    let (motions, ring) = (seat_motions(seat, seat.frame.centre()), &seat.ring);
    let translations = if ring.is_in_space() { 3 } else { 2 };
    let of_spring = ring.springs.iter().map(|spring| {
        std::array::from_fn(|motion| {
            if motion >= motions.ncols() {
                return 0.0;
            }
            let turn = if motion < translations { 1.0 } else { ring.section().radius };
            spring.stretch(motions.col_as_slice(motion)) / turn
        })
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
