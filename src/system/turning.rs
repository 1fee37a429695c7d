//! Cosine and sine of an angle in turns, in line: the library's took a tenth of a step.

use super::lanes::{Lanes, each};
use super::raceway::{lowest_bits, nearest_whole};
use std::f64::consts::TAU;

/// Steps of Horner's rule in x^4.
const STEPS: usize = 5;

/// Coefficients by powers of x^4, highest first: of every second power of x^2, even and odd ones, in sin(x) / x and in
/// cos(x).
const COEFFICIENTS: [Lanes; STEPS] = coefficients();

/// Cosine and sine at whole quarters of a turn.
const QUARTERS: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];

/// Unit vector at an angle in turns, 0 <= turn < 1; its components are within 3e-16.
///
/// The nearest quarter turn is taken out, and Taylor's polynomials hold for what is left, at most an eighth of a turn: the
/// first terms left out are 5e-17 and 2e-18.
#[inline(always)]
pub(super) fn direction(turn: f64) -> [f64; 2] {
    let quarters = nearest_whole(4.0 * turn);
    let x = TAU * (turn - 0.25 * quarters);
    let square = x * x;
    let fourth = square * square;
    let mut sums = COEFFICIENTS[0];
    for row in &COEFFICIENTS[1..] {
        sums = each(|l| sums[l] * fourth + row[l]);
    }
    let sine = x * (sums[0] + square * sums[1]);
    let cosine = sums[2] + square * sums[3];
    let [c, s] = QUARTERS[lowest_bits(quarters) as usize & 3];
    [c * cosine - s * sine, s * cosine + c * sine]
}

/// `(-1)^k / (2 k + 1)!` and `(-1)^k / (2 k)!` for k = 2 n and 2 n + 1, n from `STEPS` - 1 down to 0; as far as k = 7 in
/// the sine and 8 in the cosine.
const fn coefficients() -> [Lanes; STEPS] {
    let mut out = [[0.0; 4]; STEPS];
    let (mut factorial, mut sign, mut k) = (1.0, 1.0, 0);
    while k < 2 * STEPS - 1 {
        if k > 0 {
            factorial *= (2 * k) as f64;
        }
        let cosine = sign / factorial;
        factorial *= (2 * k + 1) as f64;
        let row = &mut out[STEPS - 1 - k / 2];
        row[2 + k % 2] = cosine;
        row[k % 2] = if k < 8 { sign / factorial } else { 0.0 };
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
            let turn = f64::from(i) / 100_000.0;
            let ([c, s], (sin, cos)) = (direction(turn), (TAU * turn).sin_cos());
            // the library's argument is rounded by up to 4e-16, and 2 pi in it by 2e-16
            assert!(
                (c - cos).abs() < 1.1e-15 && (s - sin).abs() < 1.1e-15,
                "{turn}"
            );
            assert!((c * c + s * s - 1.0).abs() < 6e-16, "{turn}");
        }
        assert_eq!(direction(0.25), [0.0, 1.0]);
        assert_eq!(direction(0.5), [-1.0, 0.0]);
    }
}
