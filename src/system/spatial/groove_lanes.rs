//! Contacts of balls side by side with a groove: energy's gradient and energy by the vector from the groove's centre.
//!
//! The law is that of [`GrooveContact`](crate::bearing::spatial); here it is written for [`LANES`] balls at once, without a branch.

use crate::bearing::spatial::GrooveContact;
use crate::numerics::lanes::{LANES, Lanes, each, positive};

/// A groove for the hot loop.
#[derive(Debug, Clone)]
pub(super) struct GrooveLaw {
    /// k and dk/dx over t = 2 x - 1, x the cosine of the contact angle: coefficients of Chebyshev polynomials, highest first.
    stiffness: Vec<[f64; 2]>,
    seat: f64,
    side: f64,
    /// Hunt-Crossley coefficient, s/m.
    pub damping: f64,
}

/// What balls feel at a groove.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Felt {
    /// Penetration, m.
    pub penetration: Lanes,
    /// Unit vector from the groove's centre to the ball: radial, axial.
    pub normal: [Lanes; 2],
    /// Gradient of the energy by that vector, N: minus the force on the ball.
    pub gradient: [Lanes; 2],
    /// Normal force, N.
    pub load: Lanes,
}

impl GrooveLaw {
    pub(crate) fn new(contact: &GrooveContact, damping: f64) -> Self {
        Self {
            stiffness: with_slopes(contact.stiffness.coefficients()),
            seat: contact.seat,
            side: contact.side,
            damping,
        }
    }

    /// The elastic contact at vectors `[radial, axial]` (m), each ball `oversize` (m) too large.
    #[inline(always)]
    pub(crate) fn felt(&self, d: [&Lanes; 2], oversize: &Lanes) -> Felt {
        let [r, z] = d;
        // a ball on the groove's centre touches nothing, whatever its direction
        let distance = each(|l| {
            let distance = (r[l] * r[l] + z[l] * z[l]).sqrt();
            if distance < f64::MIN_POSITIVE { f64::MIN_POSITIVE } else { distance }
        });
        let inverse = each(|l| 1.0 / distance[l]);
        let normal = [each(|l| r[l] * inverse[l]), each(|l| z[l] * inverse[l])];
        let penetration = each(|l| distance[l] - self.seat + oversize[l]);
        let deep = each(|l| positive(penetration[l]));
        let power = each(|l| deep[l] * deep[l].sqrt());
        let [k, slope] = self.stiffness_at(&normal[0]);
        let load = each(|l| k[l] * power[l]);
        // by the angle: (2/5) delta^(5/2) dk/dx side n_z, over the distance, along (n_z, -n_r)
        let turning = each(|l| 0.4 * deep[l] * power[l] * slope[l] * self.side * normal[1][l] * inverse[l]);
        let gradient = [
            each(|l| load[l] * normal[0][l] + turning[l] * normal[1][l]),
            each(|l| load[l] * normal[1][l] - turning[l] * normal[0][l]),
        ];
        Felt { penetration, normal, gradient, load }
    }

    /// The contact as springs along both coordinates, N/m: `1.5 F / delta` along the normal and `F / l` across it.
    #[inline(always)]
    pub(crate) fn springs(&self, felt: &Felt) -> [Lanes; 2] {
        let ([r, z], load, overlap) = (&felt.normal, &felt.load, &felt.penetration);
        // no branch, so that the lanes stay together
        let along = each(|l| 1.5 * load[l] / if overlap[l] > 0.0 { overlap[l] } else { f64::INFINITY });
        let across = each(|l| load[l] / self.seat);
        [
            each(|l| r[l] * r[l] * along[l] + z[l] * z[l] * across[l]),
            each(|l| z[l] * z[l] * along[l] + r[l] * r[l] * across[l]),
        ]
    }

    /// k and dk/dx where the normal's radial part is this.
    #[inline(always)]
    fn stiffness_at(&self, radial: &Lanes) -> [Lanes; 2] {
        let t = each(|l| {
            let cosine = self.side * radial[l];
            2.0 * if cosine > 0.0 { cosine } else { 0.0 } - 1.0
        });
        // Clenshaw's recurrence for both; the last coefficients stand for T_0
        let Some((last, higher)) = self.stiffness.split_last() else {
            return [[0.0; LANES]; 2];
        };
        let [mut k, mut k_two, mut slope, mut slope_two] = [[0.0; LANES]; 4];
        for [of_k, of_slope] in higher {
            let next = each(|l| of_k + 2.0 * t[l] * k[l] - k_two[l]);
            (k_two, k) = (k, next);
            let next = each(|l| of_slope + 2.0 * t[l] * slope[l] - slope_two[l]);
            (slope_two, slope) = (slope, next);
        }
        let slope = each(|l| last[1] + t[l] * slope[l] - slope_two[l]);
        [each(|l| last[0] + t[l] * k[l] - k_two[l]), each(|l| if self.side * radial[l] > 0.0 { slope[l] } else { 0.0 })]
    }

    /// Elastic energy of one ball of these, J.
    pub(crate) fn energy(&self, felt: &Felt, lane: usize) -> f64 {
        // load = k delta^(3/2)
        0.4 * positive(felt.penetration[lane]) * felt.load[lane]
    }
}

/// Coefficients of a Chebyshev series over t and of its derivative by x = (t + 1) / 2, highest first.
fn with_slopes(series: &[f64]) -> Vec<[f64; 2]> {
    let mut slopes = vec![0.0; series.len() + 1];
    // d_(n-1) = d_(n+1) + 2 n c_n by t (Clenshaw 1957), twice that by x
    for order in (1..series.len()).rev() {
        let above = slopes.get(order + 1).copied().unwrap_or(0.0);
        slopes[order - 1] = above + 4.0 * order as f64 * series[order];
    }
    if let Some(first) = slopes.first_mut() {
        *first *= 0.5;
    }
    series.iter().zip(slopes).map(|(&value, slope)| [value, slope]).rev().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::spatial::AngleStiffness;
    use nalgebra::Vector2;

    #[test]
    fn the_law_is_that_of_one_ball() {
        let exact = |x: f64| Ok(1e9 * (1.0 + 0.1 * x + 0.03 * (2.0 * x).exp()));
        for side in [1.0, -1.0] {
            let contact = GrooveContact { stiffness: AngleStiffness::fit(exact).unwrap(), seat: 7e-5, side };
            let law = GrooveLaw::new(&contact, 0.0);
            for (angle, depth, oversize) in
                [(0.0_f64, 1e-6, 0.0), (0.6, 3e-6, 0.0), (-1.1, 5e-6, 1e-6), (0.4, -1e-6, 0.0)]
            {
                let length = 7e-5 + depth - oversize;
                let d = side * length * Vector2::new(angle.cos(), angle.sin());
                let felt = law.felt([&[d.x; LANES], &[d.y; LANES]], &[oversize; LANES]);
                let one = GrooveContact { seat: 7e-5 - oversize, ..contact.clone() }.at(d);
                for (found, expected) in felt.gradient.iter().zip([one.gradient.x, one.gradient.y]) {
                    assert!((found[2] - expected).abs() <= 1e-12 * one.load, "{angle} {} {expected}", found[2]);
                }
                assert!((law.energy(&felt, 1) - one.energy).abs() <= 1e-13 * one.energy);
            }
        }
    }
}
