//! Integration along an arc.

use nalgebra::{Matrix3, Matrix3x6, Matrix6};
use std::ops::{Add, Mul};

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
