//! The dent that a case file offers: how large it is, how far a ball drops into it, and where the balls start beside it.

use super::scene::{BearingNumbers, STEEL};
use crate::bearing::defect::{CurvatureReading, DEFAULT_RIM_RADIUS, Dent, DentShape, RaceProfile, SurfaceDent};
use crate::bearing::{BearingDimensions, BearingError, BearingGeometry, ContactStiffness, Race};
use serde::Serialize;
use std::f64::consts::PI;

/// Length and width of the dent over the ball's diameter: a spall across the track that balls have run in. A guess, with numbers: in a pillow block
/// with a 6204 under 100 N, a dent of this size makes 7.3 m/s^2 and its fault is indicated, as a groove of its length and depth does with 7.8
/// m/s^2; half as wide it makes 2.9 m/s^2, as sound races do, and there is not enough evidence.
const LENGTH: f64 = 0.2;
const WIDTH: f64 = 0.4;

/// Its depth over the ball's diameter. A guess.
const DEPTH: f64 = 0.004;

/// Angle of the dent, degrees: under the shaft's weight.
const BELOW_DEG: f64 = 270.0;

/// A pit in the outer race; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Pit {
    angle_deg: f64,
    /// Along the race.
    length: f64,
    /// Across it.
    width: f64,
    depth: f64,
    /// How far a ball drops into it, over which it bridges, and into a groove of its section; `None` where a ball or its radii are not such
    /// that a dent fits.
    pub(super) drops: Option<[f64; 2]>,
    /// Angle of the first ball with which it lies midway between two balls, degrees.
    pub(super) first_ball_deg: f64,
}

impl Pit {
    /// That of a bearing whose lengths are multiplied by `scale`.
    pub(crate) fn of(numbers: &BearingNumbers, scale: f64) -> Self {
        let [length, width, depth] = [LENGTH, WIDTH, DEPTH].map(|part| part * scale * numbers.bearing.ball_diameter);
        Self {
            angle_deg: BELOW_DEG,
            length,
            width,
            depth,
            drops: drops(numbers, scale, [length, width, depth]).ok(),
            first_ball_deg: BELOW_DEG + 180.0 / f64::from(numbers.bearing.balls),
        }
    }
}

fn drops(numbers: &BearingNumbers, scale: f64, [length, width, depth]: [f64; 3]) -> Result<[f64; 2], BearingError> {
    let bearing = numbers.bearing;
    let ball_radius = 0.5 * scale * bearing.ball_diameter;
    let geometry = BearingGeometry::new(BearingDimensions {
        balls: bearing.balls,
        ball_radius,
        ball_mass: 4.0 / 3.0 * PI * ball_radius.powi(3) * STEEL,
        inner_race_radius: 0.5 * scale * bearing.inner_race_diameter(),
        outer_race_radius: 0.5 * scale * bearing.outer_race_diameter(),
        inner_groove_radius: scale * numbers.usual.inner_groove,
        outer_groove_radius: scale * numbers.usual.outer_groove,
    })?;
    // where a ball without load comes to lie does not depend on how stiff the contacts are
    let any = ContactStiffness::given(1.0, 1.0)?;
    let shape = DentShape {
        angle: BELOW_DEG.to_radians(),
        length,
        width: Some(width),
        depth,
        rim_radius: DEFAULT_RIM_RADIUS,
        curvature: CurvatureReading::default(),
    };
    Ok([
        SurfaceDent::new(&geometry, Race::Outer, shape, any)?.ball_drop(),
        Dent::new(&geometry, Race::Outer, shape, any)?.ball_drop(),
    ])
}
