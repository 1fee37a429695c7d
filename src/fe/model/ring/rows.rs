//! Interpolation of a ring at any angle, in its plane.

use super::{NODE_DOF, Ring};
use nalgebra::Matrix6;

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
