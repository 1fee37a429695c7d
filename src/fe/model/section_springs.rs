//! The springs of a ring of beams on a ring of elements in its place.
//!
//! A spring acts on the mean motion of the section at its node, displacement and rotation by least squares over the
//! section's corner nodes with their shares w of the area: with x outwards and z along the axis from the centroid,
//!
//! ```text
//! u_C = sum w u      omega_r = - sum w z u_t / sum w z^2      omega_z = sum w x u_t / sum w x^2
//! omega_t = sum w (z u_r - x u_z) / sum w (x^2 + z^2)
//! ```
//!
//! Exact for rigid motions of the section, which stays free to deform.

use super::housing::HousingModel;
use super::support::{NodalMatrix, NodalSource};
use super::{MeshedRing, ModelError, Ring};
use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Matrix6x3, Vector3};

impl HousingModel {
    /// Attaches the springs of `ring` to `solid`, part of this model, whose sections must include those at the ring's
    /// nodes.
    ///
    /// # Errors
    /// [`ModelError::Refused`] if they do not.
    pub(crate) fn attach_ring_springs(&mut self, solid: &MeshedRing, ring: &Ring) -> Result<(), ModelError> {
        for spring in &ring.springs {
            // the displacements out of the plane follow, node by node, those in the plane
            let place = spring.dofs[0] / spring.dofs.len();
            let (node, in_plane) = (place % ring.nodes(), place < ring.nodes());
            let stations = solid.sections.len();
            if !(node * stations).is_multiple_of(ring.nodes()) {
                return Err(ModelError::Refused(format!(
                    "springs at {} ring nodes need as many sections of the solid ring or a multiple, found {stations}",
                    ring.nodes()
                )));
            }
            let section = &solid.sections[node * stations / ring.nodes()];
            let motion = self.section_motion(section, ring.node_angle(node), solid.radius);
            let components = if in_plane { [0, 1, 5] } else { [2, 3, 4] };
            let mut stretch = DVector::zeros(motion.ncols());
            for (component, factor) in components.into_iter().zip(spring.row) {
                stretch += motion.row(component).transpose() * factor;
            }
            self.springs.push(NodalMatrix {
                nodes: section.iter().map(|&(node, _)| node).collect(),
                matrix: &stretch * stretch.transpose() * spring.stiffness,
                // what holds the ring came with its joint
                source: NodalSource::Link(self.description.links.len().saturating_sub(1)),
            });
        }
        Ok(())
    }

    /// The motion (u_x, u_y, u_z, omega_x, omega_y, omega_z) of a section in the ring's frame from the displacements of its
    /// nodes in the mesh's axes [6 x d nodes].
    fn section_motion(&self, section: &[(usize, f64)], angle: f64, radius: f64) -> DMatrix<f64> {
        let d = self.dimension;
        let (sin, cos) = angle.sin_cos();
        let polar = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let axes = polar.map(|axis| Vector3::from(self.frame.vector_to_mesh(axis)).transpose());
        let axes = Matrix3::from_rows(&axes);
        // displacement, then rotation, from (r, t, z) to the frame's (x, y, z)
        let mut to_frame = Matrix6::identity();
        for first in [0, 3] {
            to_frame[(first, first)] = cos;
            to_frame[(first, first + 1)] = -sin;
            to_frame[(first + 1, first)] = sin;
            to_frame[(first + 1, first + 1)] = cos;
        }
        let places: Vec<(f64, f64, f64)> = section
            .iter()
            .map(|&(node, weight)| {
                let [x, y, z] = self.ring_coordinates(node);
                let height = if d == 3 { z } else { 0.0 };
                (weight, x.hypot(y) - radius, height)
            })
            .collect();
        let sum = |term: &dyn Fn(f64, f64) -> f64| -> f64 { places.iter().map(|&(w, x, z)| w * term(x, z)).sum() };
        let (xx, zz) = (sum(&|x, _| x * x), sum(&|_, z| z * z));
        // a section without width has no such rotation
        let over = |value: f64, moment: f64| if moment > 0.0 { value / moment } else { 0.0 };
        let mut rows = DMatrix::zeros(6, d * section.len());
        for (place, &(w, x, z)) in places.iter().enumerate() {
            let (about_r, about_z) = (over(-w * z, zz), over(w * x, xx));
            let about_t = [over(w * z, xx + zz), over(-w * x, xx + zz)];
            #[rustfmt::skip]
            let from = Matrix6x3::new(
                w, 0.0, 0.0,
                0.0, w, 0.0,
                0.0, 0.0, w,
                0.0, about_r, 0.0,
                about_t[0], 0.0, about_t[1],
                0.0, about_z, 0.0,
            );
            let own = to_frame * from * axes;
            rows.view_mut((0, d * place), (6, d)).copy_from(&own.columns(0, d));
        }
        rows
    }
}

#[cfg(test)]
#[path = "section_springs_tests.rs"]
mod tests;
