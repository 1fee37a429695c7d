//! A measured profile as a curve: polynomials of the angle over the circle of its race.

use super::circles::Circles;
use super::curve::CurvePoint;
use super::spline::Piece;
use super::vector::Vector;

/// A profile's curve: polynomials of the angle over a circle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Profile {
    pub circles: Circles,
    pub pieces: Vec<Piece>,
}

impl Profile {
    /// Point of `piece` at `angle` (rad) from the middle; the parameter is the angle.
    #[inline]
    pub fn at(&self, piece: &Piece, angle: f64) -> CurvePoint {
        let [depth, slope, bend] = piece.at(angle);
        let Circles { carrier, side, .. } = self.circles;
        CurvePoint::polar(
            Vector::radial(angle),
            [carrier + side * depth, side * slope, side * bend],
            [1.0, 0.0],
        )
    }
}
