//! Strain energy of a ring's shapes, element by element and spring by spring.

use super::Ring;
use crate::numerics::linalg::DenseMatrix;
use nalgebra::{Matrix6, Vector6};

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
