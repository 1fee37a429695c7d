//! The interpolation that solves the unloaded circular arc exactly.
//!
//! Equilibrium `N' = -V, V' = N, M' = R V` has three force states; with the middle of the arc as
//! origin,
//!
//! ```text
//! a: N = cos phi, V = sin phi,  M = R (1 - cos phi)
//! b: N = sin phi, V = -cos phi, M = -R sin phi
//! m: N = 0,       V = 0,        M = 1
//! ```
//!
//! The displacements that belong to them, with u = w = theta = 0 in the middle, follow by
//! integrating the strains; with the three rigid motions they span {1, phi, sin, cos, phi sin,
//! phi cos}. The stiffness is `H^T F^-1 H`: F the flexibility of the three states, H their work on
//! the nodal displacements. A rigid motion does no work there, so it has no energy to round-off
//! however slender the section: nothing can lock. (Derived here; the force method for arcs is in
//! Timoshenko, Strength of Materials II, 3rd ed., section 80.)

use super::differences::Differences;
use super::quadrature::over_arc;
use crate::fe::material::BeamSection;
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector3};

/// Coefficients of the field over the six nodal displacements.
#[derive(Debug, Clone)]
pub(super) struct ExactArc {
    arc: Arc,
    /// Forces (a, b, m) from nodal displacements [3 x 6].
    forces: Matrix3x6<f64>,
    /// Rigid motion of the middle (x, y, rotation) from nodal displacements [3 x 6].
    rigid: Matrix3x6<f64>,
    stiffness: Matrix6<f64>,
}

#[derive(Debug, Clone)]
struct Arc {
    radius: f64,
    /// R / EA, m/N.
    axial: f64,
    /// R / (kappa G A), m/N.
    shear: f64,
    /// R / EI, 1/(N m).
    bending: f64,
}

impl ExactArc {
    pub(super) fn new(section: &BeamSection, half: f64) -> Self {
        let radius = section.radius;
        let arc = Arc {
            radius,
            axial: radius / section.axial,
            shear: radius * section.shear_compliance,
            bending: radius / section.bending,
        };
        let flexibility: Matrix3<f64> = over_arc(half, |phi| {
            let [normal, shear, moment] = arc.force_states(phi);
            normal * normal.transpose() * arc.axial
                + shear * shear.transpose() * arc.shear
                + moment * moment.transpose() * arc.bending
        });
        let work = arc.work(half);
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
        Self {
            arc,
            forces,
            rigid,
            stiffness: (stiffness + stiffness.transpose()) * 0.5,
        }
    }

    pub(super) fn stiffness(&self) -> Matrix6<f64> {
        self.stiffness
    }

    pub(super) fn interpolation(&self, phi: f64) -> Matrix3x6<f64> {
        self.arc.rigid_displacement(phi) * self.rigid + self.arc.deformation(phi) * self.forces
    }
}

impl Arc {
    /// (N, V, M) of the three states at phi, each a vector over (a, b, m).
    fn force_states(&self, phi: f64) -> [Vector3<f64>; 3] {
        let (sin, cos) = phi.sin_cos();
        [
            Vector3::new(cos, sin, 0.0),
            Vector3::new(sin, -cos, 0.0),
            Vector3::new(
                self.radius * Differences::at(phi).cosine,
                -self.radius * sin,
                1.0,
            ),
        ]
    }

    /// Virtual work of the states on the nodal displacements: `[N u + V w + M theta]` at the
    /// second end minus at the first.
    fn work(&self, half: f64) -> Matrix3x6<f64> {
        let mut work = Matrix3x6::zeros();
        for (end, first, sign) in [(-half, 0, -1.0), (half, 3, 1.0)] {
            for (component, state) in self.force_states(end).into_iter().enumerate() {
                work.set_column(first + component, &(state * sign));
            }
        }
        work
    }

    /// Displacements of the three states at phi [3 x 3], zero in the middle.
    fn deformation(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        let (b, b2) = (
            self.bending * self.radius,
            self.bending * self.radius * self.radius,
        );
        let mean = 0.5 * (self.axial + self.shear);
        let d = Differences::at(phi);
        Matrix3::new(
            // u of a, b, m
            b2 * d.fifth + mean * (phi * cos - sin) + self.axial * sin,
            b2 * d.fourth + mean * phi * sin,
            b * d.sine,
            // w
            b2 * d.fourth + mean * phi * sin,
            b2 * d.third + self.axial * sin - mean * (sin + phi * cos),
            -b * d.cosine,
            // theta
            b * d.sine,
            -b * d.cosine,
            self.bending * phi,
        )
    }

    /// (u, w, theta) at phi of the rigid motions (x, y, rotation about the arc's centre), x along
    /// the radius through the middle [3 x 3].
    fn rigid_displacement(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        Matrix3::new(-sin, cos, self.radius, cos, sin, 0.0, 0.0, 0.0, 1.0)
    }

    /// Inverse of [`Self::rigid_displacement`].
    fn rigid_from_displacement(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        let r = self.radius;
        Matrix3::new(-sin, cos, r * sin, cos, sin, -r * cos, 0.0, 0.0, 1.0)
    }
}
