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
//! phi cos}. (Derived here; the force method for arcs is in
//! Timoshenko, Strength of Materials II, 3rd ed., section 80.)

use super::differences::Differences;
use super::force_method::ForceStates;
use crate::fe::material::BeamSection;
use nalgebra::{Matrix3, Vector3};

/// The arc in its plane.
#[derive(Debug, Clone)]
pub(super) struct ExactArc {
    radius: f64,
    /// R / EA, m/N.
    axial: f64,
    /// R / (kappa G A), m/N.
    shear: f64,
    /// R / EI, 1/(N m).
    bending: f64,
}

impl ExactArc {
    /// The arc of a section.
    pub(super) fn new(section: &BeamSection) -> Self {
        let radius = section.radius;
        Self {
            radius,
            axial: radius / section.axial,
            shear: radius * section.shear_compliance,
            bending: radius / section.bending,
        }
    }
}

impl ForceStates for ExactArc {
    fn compliances(&self) -> [f64; 3] {
        [self.axial, self.shear, self.bending]
    }

    /// (N, V, M) of the three states at phi, each a vector over (a, b, m).
    fn force_states(&self, phi: f64) -> [Vector3<f64>; 3] {
        let (sin, cos) = phi.sin_cos();
        [
            Vector3::new(cos, sin, 0.0),
            Vector3::new(sin, -cos, 0.0),
            Vector3::new(self.radius * Differences::at(phi).cosine, -self.radius * sin, 1.0),
        ]
    }

    fn deformation(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        let (b, b2) = (self.bending * self.radius, self.bending * self.radius * self.radius);
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

    fn rigid_from_displacement(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        let r = self.radius;
        Matrix3::new(-sin, cos, r * sin, cos, sin, -r * cos, 0.0, 0.0, 1.0)
    }
}
