//! A ring's interpolation and rigid motions in space.

use super::Ring;
use nalgebra::Matrix6;

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
