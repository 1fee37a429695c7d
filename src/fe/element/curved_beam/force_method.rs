//! The force method for an unloaded arc with three force states: its stiffness and the field between its ends.
//!
//! Stiffness `H^T F^-1 H`: F the flexibility of the states, H their work on the nodal displacements. A rigid motion does no work there,
//! so it has no energy to round-off however slender the section: nothing can lock.

use super::quadrature::over_arc;
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector3};

/// What an arc is made of: three force states, and the displacements that belong to them.
pub(super) trait ForceStates {
    /// Compliance of each component of the forces, times the radius.
    fn compliances(&self) -> [f64; 3];

    /// Each component of the forces at phi (rad), a vector over the three states.
    fn force_states(&self, phi: f64) -> [Vector3<f64>; 3];

    /// Displacements of the three states at phi \[3 x 3\], zero in the middle.
    fn deformation(&self, phi: f64) -> Matrix3<f64>;

    /// Displacements at phi of the three rigid motions of the middle \[3 x 3\].
    fn rigid_displacement(&self, phi: f64) -> Matrix3<f64>;

    /// Inverse of [`Self::rigid_displacement`].
    fn rigid_from_displacement(&self, phi: f64) -> Matrix3<f64>;
}

/// An arc solved by the force method, its coefficients over the six nodal displacements.
#[derive(Debug, Clone)]
pub(super) struct SolvedArc<A> {
    arc: A,
    /// Forces of the three states from nodal displacements [3 x 6].
    forces: Matrix3x6<f64>,
    /// Rigid motion of the middle from nodal displacements [3 x 6].
    rigid: Matrix3x6<f64>,
    /// Stiffness matrix [6 x 6].
    pub(super) stiffness: Matrix6<f64>,
}

impl<A: ForceStates> SolvedArc<A> {
    /// Solves `arc` over the included angle `2 half`, rad.
    pub(super) fn new(arc: A, half: f64) -> Self {
        let [first, second, third] = arc.compliances();
        let flexibility: Matrix3<f64> = over_arc(half, |phi| {
            let [a, b, c] = arc.force_states(phi);
            a * a.transpose() * first + b * b.transpose() * second + c * c.transpose() * third
        });
        let work = work(&arc, half);
        // F is a sum of squares, positive definite for every admissible section
        let inverse = flexibility.try_inverse().unwrap_or_else(Matrix3::zeros);
        let inverse = (inverse + inverse.transpose()) * 0.5;
        let forces = inverse * work;
        let stiffness = work.transpose() * forces;
        let mut rigid = Matrix3x6::zeros();
        for (end, first) in [(-half, 0), (half, 3)] {
            // what the end's displacement leaves once the deformation is taken away
            let mut rest = arc.deformation(end) * forces * -1.0;
            for component in 0..3 {
                rest[(component, first + component)] += 1.0;
            }
            rigid += arc.rigid_from_displacement(end) * rest * 0.5;
        }
        Self { arc, forces, rigid, stiffness: (stiffness + stiffness.transpose()) * 0.5 }
    }

    /// Displacements at phi (rad) from the nodal ones [3 x 6].
    pub(super) fn interpolation(&self, phi: f64) -> Matrix3x6<f64> {
        self.arc.rigid_displacement(phi) * self.rigid + self.arc.deformation(phi) * self.forces
    }
}

/// Virtual work of the states on the nodal displacements: that of the forces at the second end minus that at the first.
fn work(arc: &impl ForceStates, half: f64) -> Matrix3x6<f64> {
    let mut work = Matrix3x6::zeros();
    for (end, first, sign) in [(-half, 0, -1.0), (half, 3, 1.0)] {
        for (component, state) in arc.force_states(end).into_iter().enumerate() {
            work.set_column(first + component, &(state * sign));
        }
    }
    work
}
