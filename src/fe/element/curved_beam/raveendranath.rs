//! The coupled-polynomial element of Raveendranath, Singh and Pradhan, Int. J. Numer. Meth. Engng
//! 44 (1999) 265-280, rebuilt from its idea: the radial displacement is a cubic, the tangential
//! displacement and the rotation follow from it by equilibrium.
//!
//! With primes for d/dphi, `N + M / R = const` and `M' = R V` give
//!
//! ```text
//! u = c5 phi + c6 - integral w - beta theta              beta = EI / (EA R)
//! (R + beta) theta - lambda theta'' = c5 phi + c6 - w' - integral w,   lambda = EI / (kappa G A R)
//! ```
//!
//! whose polynomial solution makes u and theta quartics. Four coefficients of w with c5 and c6 are
//! six parameters for six degrees of freedom. The span lacks sin and cos, so a rigid translation is
//! not exact: its frequency comes out near 1e-3 of the first elastic one with 72 elements.

use super::force_method::over_arc;
use crate::fe::material::BeamSection;
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector3};

/// Polynomial in phi, coefficients from the constant upwards.
type Polynomial = [f64; 6];

/// The six generalised functions and their coefficients over the nodal displacements.
#[derive(Debug, Clone)]
pub(super) struct CoupledPolynomial {
    half: f64,
    /// (u, w, theta) of each of the six functions.
    functions: [[Polynomial; 3]; 6],
    /// Generalised coefficients from nodal displacements.
    coefficients: Matrix6<f64>,
}

impl CoupledPolynomial {
    pub(super) fn new(section: &BeamSection, half: f64) -> Self {
        let radius = section.radius;
        let beta = section.bending / (section.axial * radius);
        let lambda = section.bending * section.shear_compliance / radius;
        let functions = std::array::from_fn(|index| {
            // powers are scaled by the half angle so that all six have the same size
            let (mut w, mut source) = ([0.0; 6], [0.0; 6]);
            match index {
                0..=3 => w[index] = half.powi(-(index as i32)),
                4 => source[1] = 1.0 / half,
                _ => source[0] = 1.0,
            }
            let integral = integral(&w);
            let load = combine(&[(1.0, source), (-1.0, derivative(&w)), (-1.0, integral)]);
            let theta = rotation(&load, radius + beta, lambda);
            let u = combine(&[(1.0, source), (-1.0, integral), (-beta, theta)]);
            [u, w, theta]
        });
        let mut element = Self { half, functions, coefficients: Matrix6::identity() };
        let mut ends = Matrix6::zeros();
        ends.fixed_view_mut::<3, 6>(0, 0).copy_from(&element.generalised(-half));
        ends.fixed_view_mut::<3, 6>(3, 0).copy_from(&element.generalised(half));
        // six independent functions on two distinct points: regular for half > 0
        element.coefficients = ends.try_inverse().unwrap_or_else(Matrix6::zeros);
        element
    }

    pub(super) fn interpolation(&self, phi: f64) -> Matrix3x6<f64> {
        self.generalised(phi) * self.coefficients
    }

    pub(super) fn stiffness(&self, section: &BeamSection) -> Matrix6<f64> {
        let r = section.radius;
        let shear = if section.shear_compliance > 0.0 { 1.0 / section.shear_compliance } else { 0.0 };
        let moduli = Matrix3::from_diagonal(&Vector3::new(section.axial, shear, section.bending));
        over_arc(self.half, |phi| {
            let strains = self.strains(phi, r) * self.coefficients;
            strains.transpose() * moduli * strains * r
        })
    }

    /// Functions at phi: rows u, w, theta.
    fn generalised(&self, phi: f64) -> Matrix3x6<f64> {
        Matrix3x6::from_fn(|row, column| value(&self.functions[column][row], phi))
    }

    /// Strains eps, gamma, kappa of the six functions at phi.
    fn strains(&self, phi: f64, radius: f64) -> Matrix3x6<f64> {
        Matrix3x6::from_fn(|row, column| {
            let [u, w, theta] = &self.functions[column];
            let slope = |f: &Polynomial| value(&derivative(f), phi);
            match row {
                0 => (slope(u) + value(w, phi)) / radius,
                1 => (slope(w) - value(u, phi)) / radius + value(theta, phi),
                _ => slope(theta) / radius,
            }
        })
    }
}

/// Polynomial solution of `k theta - lambda theta'' = load` for a quartic load.
fn rotation(load: &Polynomial, k: f64, lambda: f64) -> Polynomial {
    let second = derivative(&derivative(load));
    let fourth = derivative(&derivative(&second));
    combine(&[(1.0 / k, *load), (lambda / k.powi(2), second), (lambda.powi(2) / k.powi(3), fourth)])
}

fn combine(terms: &[(f64, Polynomial)]) -> Polynomial {
    std::array::from_fn(|power| terms.iter().map(|(factor, p)| factor * p[power]).sum())
}

fn derivative(p: &Polynomial) -> Polynomial {
    std::array::from_fn(|power| p.get(power + 1).map_or(0.0, |coefficient| (power + 1) as f64 * coefficient))
}

fn integral(p: &Polynomial) -> Polynomial {
    std::array::from_fn(|power| match power {
        0 => 0.0,
        _ => p[power - 1] / power as f64,
    })
}

fn value(p: &Polynomial, phi: f64) -> f64 {
    p.iter().rev().fold(0.0, |sum, coefficient| sum * phi + coefficient)
}
