//! Cubic spline through the samples of a profile, with continuous curvature onto the race at both ends.
//!
//! Between samples D is a cubic polynomial; value, slope and second derivative are continuous. At the first and
//! the last sample all three are zero, as on the race. Two conditions more at each end than a cubic spline has
//! room for are made room for by one knot in the middle of the first and of the last interval, where nothing is
//! prescribed: with x from the end, `D = c x³` up to `h/2` and `c x³ + e (x − h/2)³` beyond, so that at the
//! next sample
//!
//! ```text
//! D'' = (6/h) D' − (12/h²) D
//! ```
//!
//! closes the tridiagonal system for D'' at the samples in between (diagonally dominant: always solvable).

use super::circles::Circles;
use super::curve::CurvePoint;
use super::vector::Vector;

/// A cubic polynomial on one interval of the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    /// Start and end of the interval, rad.
    pub ends: [f64; 2],
    /// Coefficients of rising powers of the angle from the start, m/rad^n.
    coefficients: [f64; 4],
    /// Number of the sample before the piece, from 0.
    pub sample: usize,
}

impl Piece {
    /// D and its first two derivatives with respect to the angle.
    #[inline]
    pub(super) fn at(&self, angle: f64) -> [f64; 3] {
        let x = angle - self.ends[0];
        let [c0, c1, c2, c3] = self.coefficients;
        [c0 + x * (c1 + x * (c2 + x * c3)), c1 + x * (2.0 * c2 + x * (3.0 * c3)), 2.0 * c2 + x * (6.0 * c3)]
    }
}

/// Fewest knots that a spline with these ends needs.
pub(super) const LEAST_KNOTS: usize = 4;

/// The spline through `knots`, [`LEAST_KNOTS`] at least (angle strictly ascending, depth; zero depth at both ends).
pub(super) fn through(knots: &[(f64, f64)]) -> Vec<Piece> {
    let last = knots.len() - 1;
    let width = |i: usize| knots[i + 1].0 - knots[i].0;
    let depth = |i: usize| knots[i].1;
    let slope = |i: usize| (depth(i + 1) - depth(i)) / width(i);
    let bend = second_derivatives(knots);
    let mut pieces = Vec::with_capacity(last + 2);
    let (h, y) = (width(0), depth(1));
    let end = EndPair::new(h, y, bend[1]);
    let middle = knots[0].0 + 0.5 * h;
    pieces.push(Piece { ends: [knots[0].0, middle], coefficients: [0.0, 0.0, 0.0, end.c], sample: 0 });
    pieces.push(Piece { ends: [middle, knots[1].0], coefficients: end.past_half(1.0, end.c + end.e), sample: 0 });
    for i in 1..last - 1 {
        let h = width(i);
        pieces.push(Piece {
            ends: [knots[i].0, knots[i + 1].0],
            coefficients: [
                depth(i),
                slope(i) - h * (2.0 * bend[i] + bend[i + 1]) / 6.0,
                0.5 * bend[i],
                (bend[i + 1] - bend[i]) / (6.0 * h),
            ],
            sample: i,
        });
    }
    let (h, y) = (width(last - 1), depth(last - 1));
    let end = EndPair::new(h, y, bend[last - 1]);
    let middle = knots[last].0 - 0.5 * h;
    pieces.push(Piece {
        ends: [knots[last - 1].0, middle],
        coefficients: [y, -3.0 * h * h * (end.c + 0.25 * end.e), 0.5 * bend[last - 1], -(end.c + end.e)],
        sample: last - 1,
    });
    pieces.push(Piece { ends: [middle, knots[last].0], coefficients: end.past_half(-1.0, -end.c), sample: last - 1 });
    pieces
}

/// The two cubics of an end interval of width h, counted from the end.
struct EndPair {
    h: f64,
    c: f64,
    e: f64,
}

impl EndPair {
    /// From depth and second derivative at the sample next to the end.
    fn new(h: f64, depth: f64, bend: f64) -> Self {
        let e = (bend - 6.0 * depth / (h * h)) * 4.0 / (9.0 * h);
        Self { h, c: depth / (h * h * h) - 0.125 * e, e }
    }

    /// Coefficients from the middle knot on, `way` +1 away from the start of the profile, −1 towards its end.
    fn past_half(&self, way: f64, third: f64) -> [f64; 4] {
        let x = 0.5 * self.h;
        let slope = 3.0 * self.c * x * x;
        [self.c * x * x * x, way * slope, 3.0 * self.c * x, third]
    }
}

/// D'' at the samples, zero at both ends: Thomas's algorithm.
fn second_derivatives(knots: &[(f64, f64)]) -> Vec<f64> {
    let last = knots.len() - 1;
    let width = |i: usize| knots[i + 1].0 - knots[i].0;
    let slope = |i: usize| (knots[i + 1].1 - knots[i].1) / width(i);
    // rows (below, diagonal, above, right-hand side) of samples 1 to last − 1
    let row = |i: usize| -> [f64; 4] {
        let (h, after) = (width(i - 1), width(i));
        if i == 1 {
            let right = 6.0 * slope(1) - 12.0 * knots[1].1 / h;
            [0.0, h + 2.0 * after, after, right]
        } else if i == last - 1 {
            let right = -6.0 * slope(i - 1) - 12.0 * knots[i].1 / after;
            [h, after + 2.0 * h, 0.0, right]
        } else {
            [h, 2.0 * (h + after), after, 6.0 * (slope(i) - slope(i - 1))]
        }
    };
    let mut bend = vec![0.0; last + 1];
    let mut above = vec![0.0; last + 1];
    for i in 1..last {
        let [below, diagonal, over, right] = row(i);
        let pivot = diagonal - below * above[i - 1];
        above[i] = over / pivot;
        bend[i] = (right - below * bend[i - 1]) / pivot;
    }
    for i in (1..last).rev() {
        bend[i] -= above[i] * bend[i + 1];
    }
    bend
}

/// A profile's curve: polynomials of the angle over a circle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Profile {
    pub circles: Circles,
    pub pieces: Vec<Piece>,
}

impl Profile {
    /// Point of `piece` at `angle` (rad) from the middle; the parameter is the angle.
    #[inline]
    pub(super) fn at(&self, piece: &Piece, angle: f64) -> CurvePoint {
        let [depth, slope, bend] = piece.at(angle);
        let Circles { carrier, side, .. } = self.circles;
        CurvePoint::polar(Vector::radial(angle), [carrier + side * depth, side * slope, side * bend], [1.0, 0.0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Interpolation, and continuity of the value and two derivatives at every joint, both ends included.
        #[test]
        fn passes_through_the_samples_and_is_smooth(
            steps in prop::collection::vec((0.05..1.0_f64, -1.0..1.0_f64), 3..12),
        ) {
            let mut knots = vec![(-0.7, 0.0)];
            for (i, &(width, depth)) in steps.iter().enumerate() {
                let depth = if i + 1 == steps.len() { 0.0 } else { depth };
                knots.push((knots[i].0 + width, depth));
            }
            let pieces = through(&knots);
            prop_assert_eq!(pieces.len(), knots.len() + 1);
            for &(angle, depth) in &knots {
                let piece = pieces.iter().find(|p| p.ends[0] <= angle && angle <= p.ends[1]).unwrap();
                prop_assert!((piece.at(angle)[0] - depth).abs() < 1e-11);
            }
            let flat = [0.0; 3];
            let mut before = flat;
            let mut largest = 1.0_f64;
            for piece in &pieces {
                let after = piece.at(piece.ends[0]);
                largest = after.iter().fold(largest, |most, value| most.max(value.abs()));
                for (a, b) in before.iter().zip(after) {
                    prop_assert!((a - b).abs() < 1e-11 * largest, "{} and {} at {}", a, b, piece.ends[0]);
                }
                before = piece.at(piece.ends[1]);
            }
            for value in before {
                prop_assert!(value.abs() < 1e-11 * largest);
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let pieces = through(&[(0.0, 0.0), (1.0, 2.0), (1.5, -1.0), (3.0, 0.5), (4.0, 0.0)]);
        let h = 1e-5;
        for piece in &pieces {
            let x = 0.3 * piece.ends[0] + 0.7 * piece.ends[1];
            let (before, here, after) = (piece.at(x - h), piece.at(x), piece.at(x + h));
            for i in 0..2 {
                let difference = (after[i] - before[i]) / (2.0 * h);
                assert!((difference - here[i + 1]).abs() < 1e-7);
            }
        }
    }
}
