//! Contact of a ball with a groove, as a potential.
//!
//! ```text
//! d = ball's centre − groove's centre,  l = |d|,  δ = l − (r_groove − D/2)        V = (2/5) k(cos α) δ^{5/2}
//! inner: Σρ = (4 − 1/f_i + 2γ/(1 − γ)) / D      outer: Σρ = (4 − 1/f_o − 2γ/(1 + γ)) / D      γ = D cos α / d_m
//! ```
//!
//! The stiffness k depends on the angle of the contact, by the curvature of the race along the rolling direction. Its derivative is part
//! of the force, so that all stays a potential. Source of the curvatures: T. A. Harris, *Rolling Bearing Analysis*, 4th edition, (2.28),
//! (2.30).

use crate::bearing::error::BearingError;
use crate::bearing::hertz::{self, HertzStiffness, PrincipalCurvatures};
use crate::bearing::{BearingGeometry, Race};
use nalgebra::{Matrix2, Vector2};

/// Degrees of the polynomial that are tried; a usual bearing takes the first or second.
const DEGREES: [usize; 5] = [8, 12, 18, 27, 40];

/// Relative error of the polynomial that passes, against the elliptic integrals between its nodes.
const ACCURACY: f64 = 1e-10;

/// Hertz constant k of one race over the cosine of the contact angle, N/m^{3/2}: a series of Chebyshev polynomials on 0 to 1.
///
/// Elliptic integrals take a hundred times as long and have no derivative at hand.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AngleStiffness(Vec<f64>);

impl AngleStiffness {
    /// The same at every angle, N/m^{3/2}.
    pub(crate) fn constant(stiffness: f64) -> Self {
        Self(vec![stiffness])
    }

    /// Fits k over the cosine.
    ///
    /// # Errors
    /// [`BearingError`] of [`hertz::stiffness`], and where no degree meets the accuracy.
    pub(crate) fn fit(exact: impl Fn(f64) -> Result<f64, BearingError>) -> Result<Self, BearingError> {
        use std::f64::consts::PI;
        let mut worst = f64::INFINITY;
        for degree in DEGREES {
            let count = degree + 1;
            let angle = |node: usize| PI * (node as f64 + 0.5) / count as f64;
            let values = (0..count).map(|node| exact(0.5 * (1.0 + angle(node).cos())));
            let values = values.collect::<Result<Vec<f64>, _>>()?;
            let coefficient = |order: usize| {
                let terms = values.iter().enumerate().map(|(node, value)| value * (order as f64 * angle(node)).cos());
                let weight = if order == 0 { 1.0 } else { 2.0 };
                weight * terms.sum::<f64>() / count as f64
            };
            let fitted = Self((0..count).map(coefficient).collect());
            worst = 0.0;
            // between the nodes, and at both ends
            for node in 0..=count {
                let cosine = 0.5 * (1.0 + (PI * node as f64 / count as f64).cos());
                let value = exact(cosine)?;
                worst = f64::max(worst, (fitted.at(cosine)[0] / value - 1.0).abs());
            }
            if worst <= ACCURACY {
                return Ok(fitted);
            }
        }
        Err(BearingError(format!(
            "the Hertz constant over the contact angle is met to {worst:.1e} only, expected {ACCURACY:.0e}: the balls are too large for the pitch circle"
        )))
    }

    /// Coefficients of the Chebyshev polynomials over 2 x - 1, x the cosine, from T_0 on.
    pub(crate) fn coefficients(&self) -> &[f64] {
        &self.0
    }

    /// k and its first two derivatives by the cosine; constant below a cosine of zero.
    #[inline]
    pub(crate) fn at(&self, cosine: f64) -> [f64; 3] {
        let t = 2.0 * cosine.clamp(0.0, 1.0) - 1.0;
        // Clenshaw's recurrence with its derivatives by t
        let [mut b1, mut b2, mut d1, mut d2, mut e1, mut e2] = [0.0; 6];
        for &coefficient in self.0[1..].iter().rev() {
            (e1, e2) = (4.0 * d1 + 2.0 * t * e1 - e2, e1);
            (d1, d2) = (2.0 * b1 + 2.0 * t * d1 - d2, d1);
            (b1, b2) = (coefficient + 2.0 * t * b1 - b2, b1);
        }
        let inside = if cosine > 0.0 { 2.0 } else { 0.0 };
        [self.0[0] + t * b1 - b2, inside * (b1 + t * d1 - d2), inside * inside * (2.0 * d1 + t * e1 - e2)]
    }
}

/// Curvatures of a race at a contact whose angle has this cosine, 1/m.
pub(crate) fn race_curvatures(geometry: &BearingGeometry, race: Race, cosine: f64) -> PrincipalCurvatures {
    let diameter = 2.0 * geometry.ball_radius();
    let gamma = geometry.diameter_ratio() * cosine;
    let (groove, rolling) = match race {
        Race::Inner => (geometry.dimensions().inner_groove_radius, 2.0 * gamma / (1.0 - gamma)),
        Race::Outer => (geometry.dimensions().outer_groove_radius, -2.0 * gamma / (1.0 + gamma)),
    };
    PrincipalCurvatures { plane_1: -1.0 / groove, plane_2: rolling / diameter }
}

/// Hertz contact at a race and a contact angle of this cosine, for a modulus E* in Pa.
///
/// # Errors
/// [`BearingError`] that names the race.
pub(crate) fn hertz_at(
    geometry: &BearingGeometry,
    race: Race,
    cosine: f64,
    modulus: f64,
) -> Result<HertzStiffness, BearingError> {
    let curvatures = race_curvatures(geometry, race, cosine);
    hertz::stiffness(geometry.ball_curvatures(), curvatures, modulus)
        .map_err(|error| BearingError(format!("{race} race: {error}")))
}

/// A groove that a ball touches.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GrooveContact {
    pub stiffness: AngleStiffness,
    /// Distance of the centres at contact, r_groove − D/2, m, positive.
    pub seat: f64,
    /// 1 where the groove lies outside of the ball (outer race), −1 where it lies inside.
    pub side: f64,
}

/// A ball in a groove: energy, gradient and second derivatives by the vector d (radial, axial), and what they are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GrooveState {
    /// V, J.
    pub energy: f64,
    /// ∇V, N: minus the force on the ball.
    pub gradient: Vector2<f64>,
    /// ∇∇V, N/m.
    pub hessian: Matrix2<f64>,
    /// Penetration δ, m, negative without contact.
    pub penetration: f64,
    /// Normal force k δ^{3/2}, N.
    pub load: f64,
    /// Cosine and sine of the contact angle, counted from the radial direction towards +z for a force that pushes the inner ring
    /// that way.
    pub direction: Vector2<f64>,
    /// |d|, m.
    pub distance: f64,
}

impl GrooveState {
    /// Contact angle, the direction of the contact's force, rad; `None` without contact. The line of centres differs from it by
    /// `(2/5) (delta / l) k' / k`, 2e-4 rad in usual bearings: the race's curvature changes across the patch.
    pub(crate) fn force_angle(&self) -> Option<f64> {
        let force = self.gradient * self.gradient.dot(&self.direction).signum();
        (self.load > 0.0).then(|| force.y.atan2(force.x))
    }
}

impl GrooveContact {
    /// The contact at a vector `d`, m.
    #[inline]
    pub(crate) fn at(&self, d: Vector2<f64>) -> GrooveState {
        // a ball on the groove's centre touches nothing, whatever its direction
        let distance = d.norm().max(f64::MIN_POSITIVE);
        let normal = d / distance;
        let penetration = distance - self.seat;
        let direction = self.side * normal;
        let mut state = GrooveState {
            energy: 0.0,
            gradient: Vector2::zeros(),
            hessian: Matrix2::zeros(),
            penetration,
            load: 0.0,
            direction,
            distance,
        };
        if penetration <= 0.0 {
            return state;
        }
        let [k, k_x, k_xx] = self.stiffness.at(direction.x);
        // derivatives of the cosine by the polar angle of d
        let (x_a, x_aa) = (-direction.y, -direction.x);
        let root = penetration.sqrt();
        let power = penetration * root;
        let volume = 0.4 * penetration * power;
        let tangent = Vector2::new(-normal.y, normal.x);
        let (v_l, v_a) = (k * power, volume * k_x * x_a);
        let (v_ll, v_la) = (1.5 * k * root, power * k_x * x_a);
        let v_aa = volume * (k_xx * x_a * x_a + k_x * x_aa);
        state.energy = volume * k;
        state.load = v_l;
        state.gradient = v_l * normal + v_a / distance * tangent;
        let across = (v_la - v_a / distance) / distance;
        let along = (v_aa / distance + v_l) / distance;
        state.hessian = v_ll * normal * normal.transpose()
            + across * (normal * tangent.transpose() + tangent * normal.transpose())
            + along * tangent * tangent.transpose();
        state
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::RaceContacts;
    use crate::bearing::samples::{source_bearing, steel};
    use approx::assert_relative_eq;

    fn contact(race: Race) -> GrooveContact {
        let geometry = source_bearing();
        let exact = |cosine| Ok(hertz_at(&geometry, race, cosine, 113e9)?.stiffness);
        let (seat, side) = if race == Race::Outer { (7e-5, 1.0) } else { (4e-5, -1.0) };
        GrooveContact { stiffness: AngleStiffness::fit(exact).unwrap(), seat, side }
    }

    /// At no contact angle and without play the constants are those of the plane model; the fit is good to 1e-10 by itself.
    #[test]
    fn at_no_angle_the_constants_are_those_of_the_plane() {
        let geometry = source_bearing();
        let radius = 0.5 * (geometry.outer_race_radius() - 2.0 * geometry.ball_radius() + 2.754e-3);
        let dimensions = crate::bearing::BearingDimensions {
            inner_race_radius: radius,
            outer_race_radius: radius + 2.0 * geometry.ball_radius(),
            ..*geometry.dimensions()
        };
        let geometry = BearingGeometry::new(dimensions).unwrap();
        let plane = RaceContacts::new(&geometry, steel(), steel(), steel()).unwrap();
        for (race, plane) in [(Race::Inner, plane.inner), (Race::Outer, plane.outer)] {
            let modulus = plane.effective_modulus;
            let fitted =
                AngleStiffness::fit(|cosine| Ok(hertz_at(&geometry, race, cosine, modulus)?.stiffness)).unwrap();
            assert_relative_eq!(fitted.at(1.0)[0], plane.stiffness, max_relative = 1e-10);
            for step in 0..=200 {
                let cosine = f64::from(step) / 200.0;
                let exact = hertz_at(&geometry, race, cosine, modulus).unwrap().stiffness;
                assert_relative_eq!(fitted.at(cosine)[0], exact, max_relative = 2e-10);
            }
        }
    }

    /// Force and second derivatives are those of the energy, the constant's own included.
    #[test]
    fn force_and_hessian_are_derivatives_of_the_energy() {
        for race in [Race::Inner, Race::Outer] {
            let contact = contact(race);
            for (angle, depth) in [(0.0_f64, 1e-6), (0.3, 2e-6), (-0.7, 5e-6), (1.2, 1e-5)] {
                let length = contact.seat + depth;
                let d = contact.side * length * Vector2::new(angle.cos(), angle.sin());
                let at = contact.at(d);
                assert_relative_eq!(at.direction.y.atan2(at.direction.x), angle, epsilon = 1e-14);
                let step = 1e-4 * depth;
                for axis in 0..2 {
                    let mut shift = Vector2::zeros();
                    shift[axis] = step;
                    let [before, after] = [contact.at(d - shift), contact.at(d + shift)];
                    let slope = (after.energy - before.energy) / (2.0 * step);
                    // central differences over 1e-4 of the penetration: 1e-8 / 24 of the largest derivative, and round-off
                    assert_relative_eq!(slope, at.gradient[axis], epsilon = 1e-8 * at.load);
                    let change = (after.gradient - before.gradient) / (2.0 * step);
                    let column: Vector2<f64> = at.hessian.column(axis).into();
                    assert!((change - column).norm() <= 1e-8 * at.hessian.norm(), "{race} {angle} {change} {column}");
                }
                // the constant does change with the angle, so that the force is not along the normal
                if angle.abs() > 0.1 {
                    let tangent = Vector2::new(-at.direction.y, at.direction.x);
                    assert!(at.gradient.dot(&tangent).abs() > 1e-5 * depth / length * at.load);
                }
            }
            assert_relative_eq!(contact.at(Vector2::new(contact.side * 0.9 * contact.seat, 0.0)).load, 0.0);
            assert_relative_eq!(contact.at(Vector2::zeros()).load, 0.0);
        }
    }

    #[test]
    fn a_constant_that_no_polynomial_meets_is_refused() {
        let error = AngleStiffness::fit(|cosine| Ok(1.0 + (cosine - 0.3).abs())).unwrap_err().to_string();
        assert!(error.starts_with("the Hertz constant over the contact angle is met to"), "{error}");
        assert_relative_eq!(AngleStiffness::constant(3e9).at(0.4)[0], 3e9);
        assert_relative_eq!(AngleStiffness::constant(3e9).at(0.4)[1], 0.0);
    }
}
