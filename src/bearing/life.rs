//! How long a ball bearing lasts: its load rating by geometry, and the rating life under the loads of its balls.
//!
//! ```text
//! C = 1.3 f_c cos(α)^0.7 Z^(2/3) D^1.8, above 25.4 mm 3.647 D^1.4 in the place of D^1.8 (N, mm)           γ = D cos α/d_m
//! f_c = 0.41 · 98.0665 · 0.95 (2 f_i/(2 f_i − 1))^0.41 γ^0.3 (1 − γ)^1.39 (1 + γ)^(−1/3) (1 + (1.04 x)^(10/3))^(−0.3)
//! x = ((1 − γ)/(1 + γ))^1.72 (f_i (2 f_o − 1)/(f_o (2 f_i − 1)))^0.41
//! Q_ci = C/(0.407 Z cos α) (1 + (1.044 x)^(10/3))^0.3         Q_co = C/(0.389 Z cos α) (1 + (1.044 x)^(−10/3))^0.3
//! Q_i = (ΣQ³/Z)^(1/3), turning with the shaft                  Q_o = (ΣQ^(10/3)/Z)^(3/10), at rest under the load
//! L10r = ((Q_i/Q_ci)^(10/3) + (Q_o/Q_co)^(10/3))^(−9/10)       millions of revolutions
//! ```
//!
//! Sources: ISO 281:2007, 5.1, and ISO/TR 1281-1 for f_c (G. Lundberg and A. Palmgren 1947); ISO/TS 16281:2008 for the life.
//!
//! cos α stands in the first power: 0.407 is J_r/J_1 of half a loaded ring, whose largest load is F_r/(J_r Z cos α). So F_r = C lasts a
//! million revolutions at every contact angle. Copies with cos(α)^0.7 there give lives that are too short, by a fifth at 40 degrees.
//!
//! **Limitations**: one row, bearing steel, the load at rest against the outer ring, 90 % reliability. No shoulders, lubricant or
//! contamination (no a_ISO).

use super::error::{BearingError, refused};
use super::{BearingGeometry, Race};
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Contact pressure of the basic static load rating of ball bearings, Pa (ISO 76:2006, 3.2): a permanent deformation of 1e-4 of the
/// ball's diameter. Above it no life is given.
pub(crate) const STATIC_PRESSURE: f64 = 4.2e9;

/// Widest grooves over the ball's diameter, inner and outer, of the standard's full rating (ISO 281:2007, 5.1).
const WIDEST: [f64; 2] = [0.52, 0.53];

/// γ of the standard's table of f_c.
const RATIOS: std::ops::RangeInclusive<f64> = 0.01..=0.40;

/// Effective moduli of steel on steel, Pa: 190 to 220 GPa with Poisson's ratios of 0.27 to 0.31.
const STEEL: std::ops::RangeInclusive<f64> = 102e9..=122e9;

/// Share of the load rating below which balls may skid: the rule of thumb of makers' catalogues for ball bearings.
const LEAST_SHARE: f64 = 0.01;

/// Load rating and rating life of a bearing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct RatingLife {
    /// Basic dynamic load rating C (ISO 281), N.
    pub load_rating_n: f64,
    /// Dynamic equivalent reference load, C / L10r^(1/3), N; null without life.
    pub reference_load_n: Option<f64>,
    /// Basic reference rating life L10r (ISO/TS 16281), millions of revolutions; null without load and above 4200 MPa.
    pub life_mrev: Option<f64>,
    /// The same in hours; null also without speed.
    pub life_h: Option<f64>,
}

/// What a bearing carries for a million revolutions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LoadRating {
    /// Basic dynamic load rating C, N.
    rating: f64,
    /// The same of one ball at the inner and the outer race, Q_ci and Q_co, N.
    of_ball: [f64; 2],
}

impl RatingLife {
    /// What of the life is to be looked at.
    pub(crate) fn doubt(&self) -> Option<String> {
        let (load, rating) = (self.reference_load_n?, self.load_rating_n);
        let least = LEAST_SHARE * rating;
        if load < least {
            return Some(format!(
                "the reference load of {load:.3} N is below 1 % of the load rating, {least:.1} N: the balls may skid, and the life says little"
            ));
        }
        // ISO 281:2007, 5.3: the life of heavier loads is the maker's to tell
        (load > 0.5 * rating).then(|| {
            format!("the reference load of {load:.0} N is above half the load rating: ISO 281 leaves such a life to the maker")
        })
    }
}

impl LoadRating {
    /// Of a bearing with this nominal contact angle (rad) and these effective moduli (Pa) at the two races.
    ///
    /// # Errors
    /// [`BearingError`]: what the standard does not hold for.
    pub(crate) fn new(geometry: &BearingGeometry, angle: f64, moduli: [f64; 2]) -> Result<Self, BearingError> {
        for (race, modulus) in [Race::Inner, Race::Outer].into_iter().zip(moduli) {
            if !STEEL.contains(&modulus) {
                let name = format!("effective modulus of the {race} contact in GPa");
                return refused(name, (1e-7 * modulus).round() * 1e-2, "must be that of steel on steel, 102 to 122");
            }
        }
        if angle.to_degrees() > 45.0 + 1e-9 {
            return refused(
                "nominal contact angle in degrees",
                angle.to_degrees(),
                "must be at most 45: above is a thrust bearing",
            );
        }
        let ratio = geometry.diameter_ratio() * angle.cos();
        if !RATIOS.contains(&ratio) {
            return refused("D cos(alpha) / d_m", ratio, "must be within 0.01 and 0.40");
        }
        let conformities = [geometry.inner_conformity(), geometry.outer_conformity()];
        let sizes = [geometry.ball_radius(), geometry.pitch_radius()].map(|radius| 2.0 * radius);
        let rating = basic_load_rating(f64::from(geometry.balls()), sizes, angle, conformities);
        Ok(Self::of(rating, geometry, angle))
    }

    /// With a load rating that is given, N.
    pub(super) fn of(rating: f64, geometry: &BearingGeometry, angle: f64) -> Self {
        let conformities = [geometry.inner_conformity(), geometry.outer_conformity()];
        let x = 1.044 * race_ratio(geometry.diameter_ratio() * angle.cos(), conformities);
        let share = rating / (f64::from(geometry.balls()) * angle.cos());
        let of_race = |factor: f64, power: f64| share / factor * (1.0 + x.powf(power)).powf(0.3);
        Self { rating, of_ball: [of_race(0.407, 10.0 / 3.0), of_race(0.389, -10.0 / 3.0)] }
    }

    /// Under the loads of all balls at both races (N), with the largest contact pressure (Pa), at a speed of the shaft (rad/s).
    pub(crate) fn life(&self, loads: &[[f64; 2]], peak_pressure: f64, speed: f64) -> RatingLife {
        let mean = |race: usize, power: f64| {
            let sum: f64 = loads.iter().map(|load| (load[race] / self.of_ball[race]).powf(power)).sum();
            (sum / loads.len() as f64).powf(10.0 / (3.0 * power))
        };
        let life = (mean(0, 3.0) + mean(1, 10.0 / 3.0)).powf(-0.9);
        let carries = loads.iter().any(|load| load[0] > 0.0);
        let life = (life.is_finite() && carries && peak_pressure <= STATIC_PRESSURE).then_some(life);
        let hours = |life: f64| 1e6 * life * TAU / (3600.0 * speed.abs());
        RatingLife {
            load_rating_n: self.rating,
            reference_load_n: life.map(|life| self.rating / life.cbrt()),
            life_mrev: life,
            life_h: life.map(hours).filter(|hours| hours.is_finite()),
        }
    }
}

/// Basic dynamic radial load rating C, N, of so many balls; diameters of ball and pitch circle in m, contact angle in rad, groove radii over
/// the ball's diameter. Wider grooves than the standard's have a lower rating (ISO 281:2007, 5.1), narrower ones no higher one.
pub(super) fn basic_load_rating(balls: f64, [ball, pitch]: [f64; 2], angle: f64, conformities: [f64; 2]) -> f64 {
    // conformities of drawings are rounded; f_c of the standard's table has 0.52 at both races
    let within = |race: usize| conformities[race] <= WIDEST[race] + 5e-5;
    let [inner, outer] = [0, 1].map(|race| if within(race) { WIDEST[0] } else { conformities[race] });
    let ratio = ball * angle.cos() / pitch;
    let x = 1.04 * race_ratio(ratio, [inner, outer]);
    let factor = 0.41
        * 98.0665
        * 0.95
        * (2.0 * inner / (2.0 * inner - 1.0)).powf(0.41)
        * ratio.powf(0.3)
        * (1.0 - ratio).powf(1.39)
        / (1.0 + ratio).cbrt()
        * (1.0 + x.powf(10.0 / 3.0)).powf(-0.3);
    let mm = 1e3 * ball;
    let size = if mm <= 25.4 + 1e-9 { mm.powf(1.8) } else { 3.647 * mm.powf(1.4) };
    1.3 * factor * angle.cos().powf(0.7) * balls.powf(2.0 / 3.0) * size
}

/// Rating of the inner over that of the outer race, but for a constant.
fn race_ratio(ratio: f64, [inner, outer]: [f64; 2]) -> f64 {
    let grooves = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0));
    ((1.0 - ratio) / (1.0 + ratio)).powf(1.72) * grooves.powf(0.41)
}

#[cfg(test)]
#[path = "life_tests.rs"]
mod tests;
