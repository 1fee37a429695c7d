//! The force method for an unloaded arc with three force states: its stiffness and the field between its ends.
//!
//! Stiffness `H^T F^-1 H`: F the flexibility of the states, H their work on the nodal displacements. A rigid motion does no work there,
//! so it has no energy to round-off however slender the section: nothing can lock.
//!
//! Integration along an arc.
//!
//! What small angles leave of sines and cosines, without cancellation.
//!
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

use crate::fe::material::BeamSection;
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector3};
use std::ops::{Add, Mul};

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

/// Positive abscissae and weights of the twelve-point Gauss-Legendre rule on [-1, 1], exact to
/// degree 23 (Abramowitz and Stegun 1964, table 25.4). The integrands are products of sines,
/// cosines and low polynomials over less than a half circle: round-off is left.
const GAUSS_12: [(f64, f64); 6] = [
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_78),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.587_317_954_286_617_4, 0.203_167_426_723_065_92),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_22),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
    (0.981_560_634_246_719_3, 0.047_175_336_386_511_83),
];

/// `integral of f over [-half, half]`.
pub(super) fn over_arc<T>(half: f64, f: impl Fn(f64) -> T) -> T
where
    T: Add<Output = T> + Mul<f64, Output = T>,
{
    let pair = |(abscissa, weight): (f64, f64)| (f(abscissa * half) + f(-abscissa * half)) * (weight * half);
    let [first, rest @ ..] = GAUSS_12;
    rest.into_iter().map(pair).fold(pair(first), |sum, term| sum + term)
}

/// Consistent mass `integral N^T density N R dphi` [6 x 6] of an interpolation N(phi) over [-half, half]; `density` [3 x 3]
/// is that per length for the three components.
pub(super) fn arc_mass(
    half: f64,
    radius: f64,
    density: Matrix3<f64>,
    interpolation: impl Fn(f64) -> Matrix3x6<f64>,
) -> Matrix6<f64> {
    over_arc(half, |phi| {
        let n = interpolation(phi);
        n.transpose() * density * n * radius
    })
}

/// Differences of trigonometric functions that cancel near zero, by their power series.
pub(super) struct Differences {
    /// phi - sin phi
    pub(super) sine: f64,
    /// 1 - cos phi
    pub(super) cosine: f64,
    /// (sin phi - phi cos phi) / 2, of third order
    pub(super) third: f64,
    /// phi sin phi / 2 - (1 - cos phi), of fourth order
    pub(super) fourth: f64,
    /// phi + phi cos phi / 2 - 3/2 sin phi, of fifth order
    pub(super) fifth: f64,
}

impl Differences {
    /// Sixteen terms reach round-off for |phi| <= pi / 2.
    pub(super) fn at(phi: f64) -> Self {
        let square = phi * phi;
        let mut sums = Self { sine: 0.0, cosine: 0.0, third: 0.0, fourth: 0.0, fifth: 0.0 };
        let mut power = phi; // phi^(2k-1) / (2k-1)! with the sign (-1)^(k-1)
        for k in 1..=16 {
            let order = f64::from(k);
            let even = power * phi / (2.0 * order);
            let odd = power * square / (2.0 * order * (2.0 * order + 1.0));
            sums.cosine += even;
            sums.fourth += (order - 1.0) * even;
            sums.sine += odd;
            sums.third += order * odd;
            sums.fifth -= (order - 1.0) * odd;
            power = -odd;
        }
        sums
    }
}

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

#[cfg(test)]
mod tests {
    use super::over_arc;

    #[test]
    fn even_powers_up_to_the_degree_of_the_rule() {
        for power in (0..=22).step_by(2) {
            let exact = 2.0 * 0.7_f64.powi(power + 1) / f64::from(power + 1);
            let found = over_arc(0.7, |x| x.powi(power));
            assert!((found / exact - 1.0).abs() < 1e-13, "{power}: {found} {exact}");
        }
    }
}

#[cfg(test)]
mod differences_tests {
    use super::Differences;

    #[test]
    fn the_series_are_the_differences() {
        for phi in [-1.5_f64, -0.4, 0.9, 1.57] {
            let (sin, cos) = phi.sin_cos();
            let found = Differences::at(phi);
            for (series, direct) in [
                (found.sine, phi - sin),
                (found.cosine, 1.0 - cos),
                (found.third, 0.5 * (sin - phi * cos)),
                (found.fourth, 0.5 * phi * sin - (1.0 - cos)),
                (found.fifth, phi + 0.5 * phi * cos - 1.5 * sin),
            ] {
                // round-off of the direct form, whose terms are of size 1
                assert!((series - direct).abs() < 1e-15, "{phi}: {series} {direct}");
            }
        }
    }

    #[test]
    fn small_angles_keep_their_digits() {
        let phi = 1e-4;
        let found = Differences::at(phi);
        // leading terms; the next ones are smaller by phi^2
        for (series, leading) in [
            (found.sine, phi.powi(3) / 6.0),
            (found.cosine, phi.powi(2) / 2.0),
            (found.third, phi.powi(3) / 6.0),
            (found.fourth, -phi.powi(4) / 24.0),
            (found.fifth, phi.powi(5) / 120.0),
        ] {
            assert!((series / leading - 1.0).abs() < 1e-8, "{series} {leading}");
        }
    }
}
