//! Reduction of an angle that has grown over many turns, and its place relative to a defect's arc.

use crate::bearing::error::{BearingError, refused};
use std::f64::consts::{PI, TAU};

/// Upper half of 2π: the last 26 bits are zero, so that its product with a turn count below 2²⁶ is exact.
const TAU_HIGH: f64 = f64::from_bits(TAU.to_bits() & !((1 << 26) - 1));

/// The rest of 2π: what `TAU` holds beyond `TAU_HIGH`, and what 2π holds beyond `TAU`.
const TAU_LOW: f64 = (TAU - TAU_HIGH) + 2.449_293_598_294_706_4e-16;

/// `angle` (rad) less a whole number of turns, within ±π (and rounding).
///
/// Accurate to rounding of the result for up to 6e7 turns, where the angle itself is known to 6e-8 rad.
#[inline]
pub(crate) fn reduced(angle: f64) -> f64 {
    if angle.abs() <= PI {
        return angle;
    }
    let turns = (angle * (1.0 / TAU)).round();
    (angle - turns * TAU_HIGH) - turns * TAU_LOW
}

/// `angle` (rad, any turn) less `middle` (within ±π), within ±π.
#[inline]
pub(super) fn offset_from(angle: f64, middle: f64) -> f64 {
    let offset = reduced(angle) - middle;
    if offset > PI {
        offset - TAU
    } else if offset < -PI {
        offset + TAU
    } else {
        offset
    }
}

/// `offset` in the half-open arc `[−half, half)`; false for NaN.
#[inline]
pub(super) fn within(offset: f64, half: f64) -> bool {
    -half <= offset && offset < half
}

/// Refuses the angle of a defect (rad) that is not finite.
pub(super) fn finite_angle(angle: f64) -> Result<(), BearingError> {
    if angle.is_finite() { Ok(()) } else { refused("defect angle_deg", angle.to_degrees(), "must be finite") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn multiples_of_a_turn_vanish() {
        for turns in [1.0, -3.0, 1e3, 1e6] {
            assert!((reduced(0.25 + turns * TAU) - 0.25).abs() < 4e-16 * turns.abs() * TAU + 1e-15);
        }
        assert!(reduced(f64::NAN).is_nan());
    }

    proptest! {
        /// The library's sine reduces its argument exactly: it must not notice ours.
        #[test]
        fn sine_and_cosine_do_not_notice(angle in -1e8..1e8_f64) {
            let small = reduced(angle);
            prop_assert!(small.abs() <= PI + 1e-12);
            prop_assert!((small.sin() - angle.sin()).abs() < 1e-15);
            prop_assert!((small.cos() - angle.cos()).abs() < 1e-15);
        }
    }
}
