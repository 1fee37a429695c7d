//! The beams of a ring put together: its stiffness and mass.

use crate::fe::element::curved_beam::{CurvedBeam, OutOfPlaneArc, RingInterpolation};
use crate::fe::material::BeamSection;
use crate::numerics::linalg::DenseMatrix;
use nalgebra::Matrix6;
use std::f64::consts::{PI, TAU};
use thiserror::Error;

/// Degrees of freedom of a node in each block: u_x, u_y, theta_z in the plane, u_z, theta_x, theta_y
/// out of it.
pub(super) const NODE_DOF: usize = 3;

/// A closed ring of curved beams about the origin; node i stands at the angle `2 pi i / nodes`,
/// counter-clockwise from +x.
///
/// The displacement vector starts with the plane: u_x, u_y (m) and theta_z (rad), node by node. In
/// space a second block follows, as long as the first: u_z (m), theta_x and theta_y (rad), node by
/// node; z is the axis towards who sees the angles count counter-clockwise, rotations are right-handed.
/// The two blocks have no stiffness and no mass in common.
#[derive(Debug, Clone)]
pub struct Ring {
    pub(super) nodes: usize,
    pub(super) section: BeamSection,
    pub(super) element: CurvedBeam,
    /// None in a plane.
    pub(super) out_of_plane: Option<OutOfPlaneArc>,
    pub(super) stiffness: DenseMatrix,
    mass: DenseMatrix,
    /// Each along one direction.
    pub(crate) springs: Vec<RingSpring>,
}

/// A ring that cannot be built: too few nodes, or a support that no node stands on.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct RingError(pub(super) String);

/// A spring to the ground: `stiffness (row . d)^2 / 2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RingSpring {
    pub dofs: [usize; NODE_DOF],
    pub row: [f64; NODE_DOF],
    /// N/m, > 0.
    pub stiffness: f64,
}

impl RingSpring {
    /// Displacement of the attachment for the ring displacements `d`, m.
    pub(crate) fn stretch(&self, d: &[f64]) -> f64 {
        let pairs = self.dofs.iter().zip(&self.row);
        pairs.map(|(&dof, factor)| factor * d[dof]).sum()
    }
}

impl Ring {
    /// A free ring in its plane, three degrees of freedom a node.
    ///
    /// # Errors
    /// [`RingError`] for fewer than 3 nodes.
    pub fn new(nodes: usize, section: BeamSection, interpolation: RingInterpolation) -> Result<Self, RingError> {
        Self::assemble(nodes, section, interpolation, false)
    }

    /// A free ring in space, six degrees of freedom a node: the ring of [`Ring::new`], and out of its
    /// plane the exact arc, whichever interpolation the plane has.
    ///
    /// # Errors
    /// [`RingError`] for fewer than 3 nodes.
    pub fn in_space(nodes: usize, section: BeamSection, interpolation: RingInterpolation) -> Result<Self, RingError> {
        Self::assemble(nodes, section, interpolation, true)
    }

    fn assemble(
        nodes: usize,
        section: BeamSection,
        interpolation: RingInterpolation,
        in_space: bool,
    ) -> Result<Self, RingError> {
        if nodes < 3 {
            return Err(RingError(format!("a ring needs at least 3 nodes, found {nodes}")));
        }
        let half_angle = PI / nodes as f64;
        let dof = if in_space { 2 } else { 1 } * NODE_DOF * nodes;
        let mut ring = Self {
            nodes,
            section,
            element: CurvedBeam::new(&section, half_angle, interpolation),
            out_of_plane: in_space.then(|| OutOfPlaneArc::new(&section, half_angle)),
            stiffness: DenseMatrix::zeros(dof, dof),
            mass: DenseMatrix::zeros(dof, dof),
            springs: Vec::new(),
        };
        for index in 0..nodes {
            let (dofs, turn) = ring.frame(index);
            add(&mut ring.stiffness, ring.element.stiffness(), &dofs, &turn);
            add(&mut ring.mass, &ring.element.mass, &dofs, &turn);
            let (dofs, turn) = ring.space_frame(index);
            if let Some(arc) = &ring.out_of_plane {
                add(&mut ring.stiffness, arc.stiffness(), &dofs, &turn);
                add(&mut ring.mass, &arc.mass, &dofs, &turn);
            }
        }
        Ok(ring)
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Number of degrees of freedom: three a node in a plane, six in space.
    pub fn dof(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Whether the ring has displacements out of its plane.
    pub(crate) fn is_in_space(&self) -> bool {
        self.out_of_plane.is_some()
    }

    /// The beam's section; its radius is that of the nodes.
    pub fn section(&self) -> &BeamSection {
        &self.section
    }

    /// Stiffness with supports [dof x dof].
    pub fn stiffness(&self) -> &DenseMatrix {
        &self.stiffness
    }

    /// Consistent mass [dof x dof].
    pub fn mass(&self) -> &DenseMatrix {
        &self.mass
    }

    /// Angle of a node, rad.
    pub fn node_angle(&self, node: usize) -> f64 {
        TAU * node as f64 / self.nodes as f64
    }

    /// Position (x, y, z) of a node in the ring's own frame, m.
    pub(crate) fn node_position(&self, node: usize) -> [f64; 3] {
        let (sin, cos) = self.node_angle(node).sin_cos();
        [self.section.radius * cos, self.section.radius * sin, 0.0]
    }

    /// Element that contains an angle, and the angle from that element's middle, rad.
    pub fn locate(&self, angle: f64) -> (usize, f64) {
        let turns = angle.rem_euclid(TAU) / TAU * self.nodes as f64;
        let index = (turns.floor() as usize).min(self.nodes - 1);
        let width = TAU / self.nodes as f64;
        (index, (turns - index as f64 - 0.5) * width)
    }

    /// Displacement (x, y, z) of a node for the displacements `d` \[dof\]; z is zero for a ring in its plane.
    pub(crate) fn node_displacement(&self, node: usize, d: &[f64]) -> [f64; 3] {
        let first = NODE_DOF * node;
        let across = d.get(NODE_DOF * (self.nodes + node)).copied();
        [d[first], d[first + 1], across.unwrap_or(0.0)]
    }

    /// Rigid motion of all nodes: translation (x, y) plus rotation about the origin \[dof\]; in space
    /// the second block is zero.
    pub fn rigid_motion(&self, x: f64, y: f64, rotation: f64) -> Vec<f64> {
        self.rigid_motion_in_space([x, y, 0.0], [0.0, 0.0, rotation])
    }
}

/// Adds an element's matrix in polar components to a ring's.
fn add(whole: &mut DenseMatrix, polar: &Matrix6<f64>, dofs: &[usize; 6], turn: &Matrix6<f64>) {
    let part = turn.transpose() * polar * turn;
    for (row, &global_row) in dofs.iter().enumerate() {
        for (column, &global_column) in dofs.iter().enumerate() {
            whole[(global_row, global_column)] += part[(row, column)];
        }
    }
}
