//! Grooves in the plane of a ball: where the centres of their circles stand.
//!
//! ```text
//! A = (f_i + f_o − 1) D        ρ_o = R_0 − r_o        ρ_i = r_eff + r_i = ρ_o + A − c        z_0 = ± A sin α_0, or 0
//! cos α_0 = 1 − c / A
//! ```
//!
//! Source: T. A. Harris, *Rolling Bearing Analysis*, 4th edition, sections 2.2 and 7.2.

use crate::bearing::BearingGeometry;
use crate::bearing::error::{BearingError, refused};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The direction along the axis in which the shaft may push the inner ring.
///
/// Back to back (contact lines diverge outwards, "O") is `[Positive, Negative]` for bearings at z1 < z2; face to face ("X") is
/// `[Negative, Positive]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Thrust {
    /// Either way: a deep groove bearing, whose grooves face each other at rest.
    #[default]
    Both,
    /// Along +z: an angular contact bearing that touches at its free contact angle at rest.
    Positive,
    /// Along −z.
    Negative,
}

impl Thrust {
    /// The two directions of a back-to-back pair, the bearing at the lower z first.
    pub const BACK_TO_BACK: [Self; 2] = [Self::Positive, Self::Negative];
    /// The two directions of a face-to-face pair, the bearing at the lower z first.
    pub const FACE_TO_FACE: [Self; 2] = [Self::Negative, Self::Positive];

    /// 1 along +z or either way, −1 along −z.
    pub(crate) fn sign(self) -> f64 {
        if self == Self::Negative { -1.0 } else { 1.0 }
    }
}

/// Centres and seats of the two grooves, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grooves {
    /// Radius ρ_o of the circle of the outer groove's centres.
    pub outer_centres: f64,
    /// Radius of the inner groove's centres less that of the outer one's, A − c.
    pub radial_gap: f64,
    /// Axial place z_0 of the inner groove's centres against the outer ones at rest.
    pub axial_gap: f64,
    /// Distance A of the centres at contact.
    pub centre_distance: f64,
    /// Distance of a ball's centre from the inner and the outer groove's centre at contact: r_i − D/2, r_o − D/2.
    pub seats: [f64; 2],
}

impl Grooves {
    /// The grooves of a `geometry` whose inner ring may be pushed along `thrust`.
    ///
    /// # Errors
    /// [`BearingError`]: radial play of the centre distance or more; a one-way bearing without play, which has no free contact
    /// angle.
    pub(crate) fn new(geometry: &BearingGeometry, thrust: Thrust) -> Result<Self, BearingError> {
        let dimensions = geometry.dimensions();
        let ball = geometry.ball_radius();
        let seats = [dimensions.inner_groove_radius - ball, dimensions.outer_groove_radius - ball];
        let centre_distance = seats[0] + seats[1];
        let play = geometry.radial_play();
        if play >= centre_distance {
            return refused(
                "radial_play",
                play,
                &format!(
                    "m must be below {centre_distance} m, the distance of the groove centres at contact: the contact angle would be 90 degrees or more"
                ),
            );
        }
        let axial_gap = match thrust {
            Thrust::Both => 0.0,
            _ if play > 0.0 => thrust.sign() * (play * (2.0 * centre_distance - play)).sqrt(),
            _ => {
                return refused(
                    "radial_play",
                    play,
                    "m must be positive where thrust is one-way: without play a bearing has no free contact angle",
                );
            }
        };
        Ok(Self {
            outer_centres: geometry.outer_race_radius() - dimensions.outer_groove_radius,
            radial_gap: centre_distance - play,
            axial_gap,
            centre_distance,
            seats,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::samples::source_bearing;
    use approx::assert_relative_eq;

    #[test]
    fn centres_stand_the_contact_distance_apart_at_the_free_angle() {
        for degrees in [15.0_f64, 25.0, 40.0] {
            let angle = degrees.to_radians();
            let geometry = source_bearing().with_free_contact_angle(angle).unwrap();
            let play = geometry.radial_play();
            // the play that gives the angle, c = A (1 - cos a), A = 0.11 mm
            assert_relative_eq!(play, 0.11e-3 * (1.0 - angle.cos()), max_relative = 1e-12);
            assert_relative_eq!(geometry.free_contact_angle().unwrap(), angle, max_relative = 1e-10);
            for (thrust, sign) in [(Thrust::Positive, 1.0), (Thrust::Negative, -1.0)] {
                let grooves = Grooves::new(&geometry, thrust).unwrap();
                assert_relative_eq!(grooves.axial_gap, sign * 0.11e-3 * angle.sin(), max_relative = 1e-10);
                let distance = grooves.radial_gap.hypot(grooves.axial_gap);
                assert_relative_eq!(distance, grooves.centre_distance, max_relative = 1e-14);
            }
            let inner = geometry.effective_inner_race_radius() + geometry.dimensions().inner_groove_radius;
            let grooves = Grooves::new(&geometry, Thrust::Both).unwrap();
            assert_relative_eq!(grooves.outer_centres + grooves.radial_gap, inner, max_relative = 1e-14);
            assert_relative_eq!(grooves.axial_gap, 0.0);
        }
    }

    #[test]
    fn each_rule_fires_with_its_message() {
        let message = |play: f64, thrust| {
            let geometry = source_bearing().with_radial_play(play).unwrap();
            Grooves::new(&geometry, thrust).unwrap_err().to_string()
        };
        assert_eq!(
            message(-1e-6, Thrust::Positive),
            "radial_play = -0.000001 m must be positive where thrust is one-way: without play a bearing has no free contact angle"
        );
        let dimensions = crate::bearing::BearingDimensions {
            inner_groove_radius: 1.005e-3,
            outer_groove_radius: 1.005e-3,
            ..*source_bearing().dimensions()
        };
        let geometry = BearingGeometry::new(dimensions).unwrap().with_radial_play(2e-5).unwrap();
        let error = Grooves::new(&geometry, Thrust::Both).unwrap_err().to_string();
        assert!(error.starts_with("radial_play = 0.00002 m must be below 0.0000"), "{error}");
        let error = source_bearing().with_free_contact_angle(1.6).unwrap_err().to_string();
        assert_eq!(error, "free contact angle = 91.6732 degrees must be above 0 and below 90");
    }
}
