//! Cosines and sines of two angles in turns side by side, in line: the library's took a tenth of a step.

use super::raceway::{lowest_bits, nearest_whole};
use crate::numerics::lanes::{Lanes, each, together};
use std::f64::consts::TAU;

/// Terms of the cosine's polynomial; the sine's has one less.
const TERMS: usize = 9;

/// Coefficients by powers of x^2, highest first: of sin(x) / x, cos(x) and the same again.
const COEFFICIENTS: [Lanes; TERMS] = coefficients();

/// Cosine and sine at whole quarters of a turn.
const QUARTERS: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];

/// Unit vectors at two angles in turns, 0 <= turn < 1; their components are within 2e-16.
///
/// The nearest quarter turn is taken out, and Taylor's polynomials hold for what is left, at most an eighth of a turn: the
/// first terms left out are 5e-17 and 2e-18.
#[inline(always)]
pub(super) fn directions(turns: [f64; 2]) -> [[f64; 2]; 2] {
    let quarters = turns.map(|turn| nearest_whole(4.0 * turn));
    let [first, second] = [0, 1].map(|i| TAU * (turns[i] - 0.25 * quarters[i]));
    let squares = [first * first, first * first, second * second, second * second];
    let mut sums = COEFFICIENTS[0];
    for row in &COEFFICIENTS[1..] {
        sums = each(|l| sums[l] * squares[l] + row[l]);
    }
    let sums = together(sums);
    let rest = [[sums[1], first * sums[0]], [sums[3], second * sums[2]]];
    [0, 1].map(|i| {
        let quarter = lowest_bits(quarters[i]) as usize & 3;
        let ([c, s], [cosine, sine]) = (QUARTERS[quarter], rest[i]);
        [c * cosine - s * sine, s * cosine + c * sine]
    })
}

/// `(-1)^k / (2 k + 1)!` and `(-1)^k / (2 k)!` for k from `TERMS` - 1 down to 0.
const fn coefficients() -> [Lanes; TERMS] {
    let mut out = [[0.0; 4]; TERMS];
    let (mut factorial, mut sign, mut k) = (1.0, 1.0, 0);
    while k < TERMS {
        if k > 0 {
            factorial *= (2 * k) as f64;
        }
        let cosine = sign / factorial;
        factorial *= (2 * k + 1) as f64;
        let sine = if k + 1 < TERMS { sign / factorial } else { 0.0 };
        out[TERMS - 1 - k] = [sine, cosine, sine, cosine];
        sign = -sign;
        k += 1;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosine_and_sine_are_those_of_the_library() {
        for i in 0..100_000 {
            let turns = [f64::from(i) / 100_000.0, 1.0 - f64::from(i + 1) / 100_000.0];
            for (turn, [c, s]) in turns.into_iter().zip(directions(turns)) {
                let (sin, cos) = (TAU * turn).sin_cos();
                // the library's argument is rounded by up to 4e-16, and 2 pi in it by 2e-16
                assert!((c - cos).abs() < 1.1e-15 && (s - sin).abs() < 1.1e-15, "{turn}");
                assert!((c * c + s * s - 1.0).abs() < 5e-16, "{turn}");
            }
        }
        assert_eq!(directions([0.25, 0.5]), [[0.0, 1.0], [-1.0, 0.0]]);
    }
}
