//! The beams of a ring put together: its stiffness and mass.
//!
//! Interpolation of a ring at any angle, in its plane.
//!
//! Strain energy of a ring's shapes, element by element and spring by spring.
//!
//! A ring's interpolation and rigid motions in space.

use crate::fe::element::curved_beam::{CurvedBeam, OutOfPlaneArc, RingInterpolation};
use crate::fe::material::BeamSection;
use crate::numerics::linalg::DenseMatrix;
use nalgebra::{Matrix6, Vector6};
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

/// Interpolation at one angle: six entries in the vector of ring displacements for each polar
/// component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingRows {
    /// Where the six entries stand in the displacement vector.
    pub dofs: [usize; 6],
    /// Radial displacement w = radial . d.
    pub radial: [f64; 6],
    /// Tangential displacement of the centroid line u = tangential . d.
    pub tangential: [f64; 6],
    /// Rotation of the section theta = rotation . d.
    pub rotation: [f64; 6],
}

impl Ring {
    /// Interpolation at any angle, rad: continuous inside an element and from one to the next.
    pub fn rows_at(&self, angle: f64) -> RingRows {
        let (index, phi) = self.locate(angle);
        self.rows_in_element(index, phi)
    }

    /// The row of a displacement of the centroid line at an angle (rad) in a direction of the ring's frame: pairs (degree of
    /// freedom, factor). A ring in its plane takes what of the direction lies in the plane.
    pub fn displacement_row(&self, angle: f64, [x, y, z]: [f64; 3]) -> Vec<(usize, f64)> {
        let rows = self.rows_at(angle);
        let (sin, cos) = angle.sin_cos();
        let (radial, tangential) = (x * cos + y * sin, y * cos - x * sin);
        let in_plane = (0..6).map(|k| {
            let factor = radial * rows.radial[k] + tangential * rows.tangential[k];
            (rows.dofs[k], factor)
        });
        let mut row: Vec<(usize, f64)> = in_plane.collect();
        // directions in the plane have rows of the plane alone
        if z.abs() > 0.0
            && let Some(space) = self.space_rows_at(angle)
        {
            let axial = space.dofs.into_iter().zip(space.axial).skip(6);
            row.extend(axial.map(|(dof, factor)| (dof, z * factor)));
        }
        row
    }

    /// Interpolation in element `index` at the angle `phi` from its middle, rad.
    pub(crate) fn rows_in_element(&self, index: usize, phi: f64) -> RingRows {
        let (dofs, turn) = self.frame(index);
        let n = self.element.interpolation(phi) * turn;
        let row = |component: usize| std::array::from_fn(|column| n[(component, column)]);
        RingRows { dofs, tangential: row(0), radial: row(1), rotation: row(2) }
    }

    /// Interpolation of the radial displacement at `phi` from an element's middle (rad) in the polar
    /// components (tangential, radial, rotation) of its two nodes; the same for every element.
    pub(crate) fn polar_radial_row(&self, phi: f64) -> [f64; 6] {
        let n = self.element.interpolation(phi);
        std::array::from_fn(|column| n[(1, column)])
    }

    /// In-plane degrees of freedom of an element and the matrix that turns them to polar components.
    pub(super) fn frame(&self, index: usize) -> ([usize; 6], Matrix6<f64>) {
        self.frame_of_block(index, 0, |sin, cos| [[-sin, cos, 0.0], [cos, sin, 0.0], [0.0, 0.0, 1.0]])
    }

    /// Degrees of freedom of an element in a block of the displacements, whose first node is `first_node`, and the matrix that
    /// turns them to polar components; `rows` does so at one node, from the sine and the cosine of its angle.
    pub(super) fn frame_of_block(
        &self,
        index: usize,
        first_node: usize,
        rows: impl Fn(f64, f64) -> [[f64; NODE_DOF]; NODE_DOF],
    ) -> ([usize; 6], Matrix6<f64>) {
        let mut turn = Matrix6::zeros();
        let mut dofs = [0; 6];
        for (end, node) in [index, (index + 1) % self.nodes].into_iter().enumerate() {
            let (sin, cos) = self.node_angle(node).sin_cos();
            let first = NODE_DOF * end;
            for (i, row) in rows(sin, cos).into_iter().enumerate() {
                dofs[first + i] = NODE_DOF * (first_node + node) + i;
                row.into_iter().enumerate().for_each(|(j, factor)| turn[(first + i, first + j)] = factor);
            }
        }
        (dofs, turn)
    }
}

impl RingRows {
    /// Value of one component for the ring displacements `d`.
    pub(crate) fn apply(&self, row: &[f64; 6], d: &[f64]) -> f64 {
        self.dofs.iter().zip(row).map(|(&dof, factor)| factor * d[dof]).sum()
    }

    /// Tangential displacement of the section's point at `arm` outside the node radius:
    /// `u + arm theta`.
    pub(crate) fn tangential_at(&self, arm: f64) -> [f64; 6] {
        std::array::from_fn(|k| self.tangential[k] + arm * self.rotation[k])
    }
}

/// Products of the shapes of a ring with its stiffness, `D^T K D`, by what is strained.
#[derive(Debug, Clone, PartialEq)]
pub struct RingStrain {
    /// In the beams [count x count].
    pub beams: DenseMatrix,
    /// In the springs [count x count].
    pub springs: DenseMatrix,
}

impl Ring {
    /// `D^T K D` for displacements D [dof x count].
    ///
    /// Of every element the motion of its first node is taken out, as a rigid motion, before its stiffness is
    /// applied: that changes nothing but round-off, which is then relative to the element's own deformation. In its
    /// plane the element of Raveendranath et al. resists rigid motions; there nothing is taken out.
    pub fn strain_products(&self, shapes: &DenseMatrix) -> RingStrain {
        let count = shapes.ncols();
        let mut beams = DenseMatrix::zeros(count, count);
        for index in 0..self.nodes {
            let (dofs, turn) = self.frame(index);
            let [dx, dy] = self.chord(index);
            let exact = self.element.is_exact_for_rigid_motions();
            let moves = |d: &[f64]| {
                // (u_x, u_y, theta_z) of both nodes
                let [x, y, about_z, x2, y2, about_z2] = dofs.map(|dof| d[dof]);
                turn * match exact {
                    true => {
                        let [x, y] = [x2 - x + about_z * dy, y2 - y - about_z * dx];
                        Vector6::new(0.0, 0.0, 0.0, x, y, about_z2 - about_z)
                    }
                    false => Vector6::new(x, y, about_z, x2, y2, about_z2),
                }
            };
            add_products(&mut beams, self.element.stiffness(), shapes, &moves);
            if let Some(arc) = &self.out_of_plane {
                let (dofs, turn) = self.space_frame(index);
                let moves = |d: &[f64]| {
                    // (u_z, theta_x, theta_y) of both nodes
                    let [z, about_x, about_y, z2, about_x2, about_y2] = dofs.map(|dof| d[dof]);
                    let z = z2 - z - about_x * dy + about_y * dx;
                    turn * Vector6::new(0.0, 0.0, 0.0, z, about_x2 - about_x, about_y2 - about_y)
                };
                add_products(&mut beams, arc.stiffness(), shapes, &moves);
            }
        }
        let mut springs = DenseMatrix::zeros(count, count);
        for spring in &self.springs {
            let stretch: Vec<f64> = (0..count).map(|mode| spring.stretch(shapes.col_as_slice(mode))).collect();
            for a in 0..count {
                for b in 0..count {
                    springs[(a, b)] += spring.stiffness * stretch[a] * stretch[b];
                }
            }
        }
        RingStrain { beams, springs }
    }

    /// From an element's first node to its second, m.
    fn chord(&self, index: usize) -> [f64; 2] {
        let [first, second] = [index, index + 1].map(|node| self.node_angle(node).sin_cos());
        let radius = self.section.radius;
        [radius * (second.1 - first.1), radius * (second.0 - first.0)]
    }
}

fn add_products(
    sum: &mut DenseMatrix,
    stiffness: &Matrix6<f64>,
    shapes: &DenseMatrix,
    moves: &dyn Fn(&[f64]) -> Vector6<f64>,
) {
    let all: Vec<Vector6<f64>> = (0..shapes.ncols()).map(|mode| moves(shapes.col_as_slice(mode))).collect();
    for (b, own) in all.iter().enumerate() {
        let force = stiffness * own;
        for (a, other) in all.iter().enumerate() {
            sum[(a, b)] += other.dot(&force);
        }
    }
}

/// Interpolation at one angle in space: twelve entries in the vector of ring displacements for each
/// polar component.
///
/// The frame at the angle is right-handed: e_r outwards, e_t counter-clockwise, e_z along the ring's
/// axis. A material point x of the section moves by `u_C + omega x (x - x_C)`, C on the centroid line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingSpaceRows {
    /// Where the entries stand in the displacement vector: six in the plane, six out of it.
    pub dofs: [usize; 12],
    /// Displacement of the centroid line along e_r: radial . d, m.
    pub radial: [f64; 12],
    /// Displacement of the centroid line along e_t, m.
    pub tangential: [f64; 12],
    /// Displacement of the centroid line along e_z, m.
    pub axial: [f64; 12],
    /// Rotation of the section about e_r (bending out of the plane), rad.
    pub about_radial: [f64; 12],
    /// Rotation of the section about e_t (torsion), rad.
    pub about_tangential: [f64; 12],
    /// Rotation of the section about e_z (bending in the plane), rad.
    pub about_axial: [f64; 12],
}

impl Ring {
    /// Interpolation in space at any angle, rad: continuous inside an element and from one to the
    /// next, and exact for rigid motions (in the plane as far as its interpolation is). `None` for a
    /// ring in its plane.
    pub(crate) fn space_rows_at(&self, angle: f64) -> Option<RingSpaceRows> {
        let arc = self.out_of_plane.as_ref()?;
        let (index, phi) = self.locate(angle);
        let plane = self.rows_in_element(index, phi);
        let (dofs, turn) = self.space_frame(index);
        let n = arc.interpolation(phi) * turn;
        let in_plane = |row: &[f64; 6]| std::array::from_fn(|k| if k < 6 { row[k] } else { 0.0 });
        let out_of_plane = |component: usize| std::array::from_fn(|k| if k < 6 { 0.0 } else { n[(component, k - 6)] });
        Some(RingSpaceRows {
            dofs: std::array::from_fn(|k| if k < 6 { plane.dofs[k] } else { dofs[k - 6] }),
            radial: in_plane(&plane.radial),
            tangential: in_plane(&plane.tangential),
            axial: out_of_plane(0),
            about_radial: out_of_plane(1),
            about_tangential: out_of_plane(2),
            about_axial: in_plane(&plane.rotation),
        })
    }

    /// Rigid motion of all nodes: translation (m) plus rotation vector (rad) about the origin,
    /// components x, y, z \[dof\]. A ring in its plane takes what of it lies in the plane.
    pub fn rigid_motion_in_space(&self, translation: [f64; 3], rotation: [f64; 3]) -> Vec<f64> {
        let [x, y, z] = translation;
        let [about_x, about_y, about_z] = rotation;
        let radius = self.section.radius;
        let in_plane = (0..self.nodes).flat_map(|node| {
            let (sin, cos) = self.node_angle(node).sin_cos();
            let arm = radius * about_z;
            [x - arm * sin, y + arm * cos, about_z]
        });
        let out_of_plane = (0..self.nodes).flat_map(|node| {
            let (sin, cos) = self.node_angle(node).sin_cos();
            let lift = radius * (about_x * sin - about_y * cos);
            [z + lift, about_x, about_y]
        });
        in_plane.chain(out_of_plane).take(self.dof()).collect()
    }

    /// Out-of-plane degrees of freedom of an element and the matrix that turns them to the polar
    /// components (v, about e_r, about e_t).
    pub(super) fn space_frame(&self, index: usize) -> ([usize; 6], Matrix6<f64>) {
        self.frame_of_block(index, self.nodes, |sin, cos| [[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]])
    }
}

impl RingSpaceRows {
    /// Value of one component for the ring displacements `d`.
    pub(crate) fn apply(&self, row: &[f64; 12], d: &[f64]) -> f64 {
        self.dofs.iter().zip(row).map(|(&dof, factor)| factor * d[dof]).sum()
    }

    /// Displacement along (e_r, e_t, e_z) of the section's point at `arm` outside the node radius and
    /// `height` above the ring's plane, m: `u_C + omega x (arm e_r + height e_z)`.
    pub(crate) fn displacement_at(&self, arm: f64, height: f64) -> [[f64; 12]; 3] {
        [
            std::array::from_fn(|k| self.radial[k] + height * self.about_tangential[k]),
            std::array::from_fn(|k| self.tangential[k] + arm * self.about_axial[k] - height * self.about_radial[k]),
            std::array::from_fn(|k| self.axial[k] - arm * self.about_tangential[k]),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Ring, RingSupport, SpringShare};
    use super::*;
    use crate::fe::element::curved_beam::RingInterpolation;
    use crate::fe::material::{BeamSection, Bond, Material, RingLayer};

    fn ring(interpolation: RingInterpolation, in_space: bool) -> Ring {
        let layer = RingLayer {
            material: Material::new(2.06e11, 0.3, 7850.0).expect("steel"),
            area: 5.37e-6,
            inertia: 8.88e-13,
            axial_inertia: in_space.then_some(2e-12),
            torsion: in_space.then_some(2e-12),
            radius: 5.314e-3,
            shear_coefficient: 5.0 / 6.0,
        };
        let section = BeamSection::combine(&[layer], Bond::Composite).expect("a section");
        let ring = match in_space {
            true => Ring::in_space(20, section, interpolation),
            false => Ring::new(20, section, interpolation),
        };
        let mut ring = ring.expect("twenty nodes");
        let support =
            RingSupport { from: 0.3, to: 4.0, spring: [3e6, 2e6, 1e6], share: SpringShare::Total, offset: 1e-3 };
        ring.add_support(&support).expect("nodes there");
        ring
    }

    /// Beams and springs together are the matrix.
    #[test]
    fn products_add_up_to_the_stiffness() {
        for interpolation in [RingInterpolation::ExactArc, RingInterpolation::Raveendranath] {
            for in_space in [false, true] {
                let ring = ring(interpolation, in_space);
                let shapes = DenseMatrix::from_fn(ring.dof(), 3, |dof, mode| {
                    (0.37 * (dof + 1) as f64 * (mode + 2) as f64).sin()
                });
                let strain = ring.strain_products(&shapes);
                let expected = shapes.transpose() * ring.stiffness() * &shapes;
                let difference = &strain.beams + &strain.springs - &expected;
                // round-off of sums of 60 or 120 terms of either sign
                assert!(difference.norm_max() < 1e-12 * expected.norm_max(), "{interpolation:?} {in_space}");
                assert!(strain.springs[(0, 0)] > 0.0);
            }
        }
    }

    /// A rigid motion leaves the square of round-off in the beams, where the matrix leaves round-off itself.
    #[test]
    fn rigid_motions_do_not_strain_the_beams() {
        let ring = ring(RingInterpolation::ExactArc, true);
        let turn = 1.0 / ring.section().radius;
        let motions = [
            ([1.0, 0.0, 0.0], [0.0; 3]),
            ([0.0, 1.0, 0.0], [0.0; 3]),
            ([0.0, 0.0, 1.0], [0.0; 3]),
            ([0.0; 3], [turn, 0.0, 0.0]),
            ([0.0; 3], [0.0, turn, 0.0]),
            ([0.0; 3], [0.0, 0.0, turn]),
        ];
        let motions = motions.map(|(along, about)| ring.rigid_motion_in_space(along, about));
        let shapes = DenseMatrix::from_fn(ring.dof(), 6, |dof, motion| motions[motion][dof]);
        let strain = ring.strain_products(&shapes);
        let stiffest = ring.stiffness().norm_max();
        // 20 elements, each off by a few eps of a motion of 1
        let limit = 1e3 * f64::EPSILON.powi(2) * stiffest;
        for motion in 0..6 {
            let energy = strain.beams[(motion, motion)];
            assert!(energy.abs() < limit, "{motion}: {energy:e} of {limit:e}");
            // each hangs on the springs, the translations with all of their stiffness
            assert!(strain.springs[(motion, motion)] > 1e4);
        }
        for (motion, spring) in [3e6, 2e6, 1e6].into_iter().enumerate() {
            // a sum of a dozen shares
            assert!((strain.springs[(motion, motion)] / spring - 1.0).abs() < 1e-13);
        }
    }
}
