//! The arc out of its plane: bending about the radius, torsion and shear along the axis.
//!
//! Polar components on an arc of radius R, angle phi counter-clockwise from the element's middle, in
//! the right-handed frame (e_r outwards, e_t counter-clockwise, e_z): v displacement along e_z, alpha
//! rotation of the section about e_r, beta about e_t. Strains (primes: d/dphi)
//!
//! ```text
//! gamma = v' / R - alpha      kappa = (alpha' - beta) / R      tau = (beta' + alpha) / R
//! ```
//!
//! are those of `du/ds - omega x e_t` and `d omega/ds`, with `e_r' = e_t` and `e_t' = -e_r`: a section
//! that bends twists on its way round, and the other way about. With the forces `Q = kGA gamma`,
//! `M = EI_a kappa` (about e_r) and `T = GJ tau` (about e_t), equilibrium of an unloaded arc is
//!
//! ```text
//! Q' = 0      M' = T - R Q      T' = -M
//! ```
//!
//! (Timoshenko, Strength of Materials II, 3rd ed., section on the curved bar loaded out of its plane).
//! It has three force states; with the middle of the arc as origin,
//!
//! ```text
//! q: Q = 1, M = -R sin phi, T = R (1 - cos phi)
//! m: Q = 0, M = cos phi,    T = -sin phi
//! t: Q = 0, M = sin phi,    T = cos phi
//! ```
//!
//! The displacements that belong to them, with v = alpha = beta = 0 in the middle, follow by
//! integrating the strains: `z = alpha + i beta` obeys `z' = -i z + R (kappa + i tau)`, then
//! `v' = R (alpha + gamma)`. Derived here. With the three rigid motions they span {1, phi, sin, cos,
//! phi sin, phi cos}.

use super::force_method::{Differences, ForceStates, SolvedArc, arc_mass};
use crate::fe::material::BeamSection;
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector3};

/// One element of a ring out of its plane, exact in statics for loads on its nodes.
///
/// Degrees of freedom (v, alpha, beta) at the first node, then at the second, the first being the one
/// at the smaller angle: displacement along e_z in m, rotation about the radius e_r (bending out of
/// the plane) and about the tangent e_t (torsion) in rad, by the right-hand rule. A material point at
/// the arm a outside the centroid line moves along e_z by `v - a beta`.
#[derive(Debug, Clone)]
pub struct OutOfPlaneArc {
    solved: SolvedArc<Arc>,
    /// Consistent mass matrix [6 x 6] with rotary inertia, in kg, kg m and kg m^2.
    pub(crate) mass: Matrix6<f64>,
}

#[derive(Debug, Clone)]
struct Arc {
    radius: f64,
    /// R / (kappa G A), m/N.
    shear: f64,
    /// R / EI_a, 1/(N m).
    bending: f64,
    /// R / GJ, 1/(N m).
    torsion: f64,
}

impl OutOfPlaneArc {
    /// The element of a section over an included angle `2 half_angle`, rad, 0 < half_angle < pi/2.
    pub fn new(section: &BeamSection, half_angle: f64) -> Self {
        let radius = section.radius;
        let out = &section.out_of_plane;
        let arc = Arc {
            radius,
            shear: radius * out.shear_compliance,
            bending: radius / out.bending,
            torsion: radius / out.torsion,
        };
        let solved = SolvedArc::new(arc, half_angle);
        // [[rho A, 0, -rho S], [0, rho I_a, 0], [-rho S, 0, rho I_p]]
        let (mass, moment) = (section.mass, -section.mass_moment);
        let density = Matrix3::new(mass, 0.0, moment, 0.0, out.radial_rotary, 0.0, moment, 0.0, out.polar_rotary);
        let mass = arc_mass(half_angle, radius, density, |phi| solved.interpolation(phi));
        Self { solved, mass }
    }

    /// Stiffness matrix [6 x 6] in N/m, N and N m.
    pub fn stiffness(&self) -> &Matrix6<f64> {
        &self.solved.stiffness
    }

    /// Interpolation (v, alpha, beta)(phi) = N(phi) d [3 x 6]; phi in rad from the middle,
    /// |phi| <= half_angle.
    pub(crate) fn interpolation(&self, phi: f64) -> Matrix3x6<f64> {
        self.solved.interpolation(phi)
    }
}

impl ForceStates for Arc {
    fn compliances(&self) -> [f64; 3] {
        [self.shear, self.bending, self.torsion]
    }

    /// (Q, M, T) of the three states at phi, each a vector over (q, m, t).
    fn force_states(&self, phi: f64) -> [Vector3<f64>; 3] {
        let (sin, cos) = phi.sin_cos();
        [
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(-self.radius * sin, cos, sin),
            Vector3::new(self.radius * Differences::at(phi).cosine, -sin, cos),
        ]
    }

    fn deformation(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        let (radius, bending, torsion) = (self.radius, self.bending, self.torsion);
        let d = Differences::at(phi);
        let half_sine = 0.5 * phi * sin;
        let half_sum = 0.5 * (sin + phi * cos);
        // alpha of q is -R (..), v of m is R (..): Maxwell's reciprocity
        let crossed = radius * (bending * half_sine + torsion * d.fourth);
        let twist = radius * (bending + torsion) * d.third;
        Matrix3::new(
            // v of q, m, t
            self.shear * phi - radius * radius * (bending * d.third - torsion * d.fifth),
            crossed,
            twist,
            // alpha
            -crossed,
            bending * half_sum - torsion * d.third,
            (bending + torsion) * half_sine,
            // beta
            twist,
            -(bending + torsion) * half_sine,
            torsion * half_sum - bending * d.third,
        )
    }

    /// (v, alpha, beta) at phi of the rigid motions (z, turn about x, turn about y) [3 x 3]: axes
    /// through the middle of the arc, x along its radius, y along its tangent.
    fn rigid_displacement(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        let ahead = self.radius * sin;
        let inside = self.radius * Differences::at(phi).cosine;
        Matrix3::new(1.0, ahead, inside, 0.0, cos, sin, 0.0, -sin, cos)
    }

    fn rigid_from_displacement(&self, phi: f64) -> Matrix3<f64> {
        let (sin, cos) = phi.sin_cos();
        let inside = self.radius * Differences::at(phi).cosine;
        // z = v - R sin (alpha cos - beta sin) - R (1 - cos) (alpha sin + beta cos)
        //   = v - R sin alpha + R (1 - cos) beta
        Matrix3::new(1.0, -self.radius * sin, inside, 0.0, cos, -sin, 0.0, sin, cos)
    }
}

#[cfg(test)]
#[path = "out_of_plane_tests.rs"]
mod tests;
