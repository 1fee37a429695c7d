//! The numbers, as printed: millimetres, kilograms; Timken's balls in inches. GMN's 609 is left out: the mass printed for it is more
//! than that of full steel.

use super::entry::{CatalogueBearing, Source};

const INCH: f64 = 25.4;

/// GMN: designation, d, D, B, d_m, D_W, Z, D1, m.
macro_rules! gmn {
    ($name:literal, $bore:literal, $outer:literal, $width:literal, $pitch:literal, $ball:literal, $balls:literal, $shoulder:literal, $mass:literal) => {
        CatalogueBearing {
            name: $name,
            bore: 1e-3 * $bore,
            outer_diameter: 1e-3 * $outer,
            width: 1e-3 * $width,
            balls: $balls,
            ball_diameter: 1e-3 * $ball,
            pitch_diameter: 1e-3 * $pitch,
            pitch_published: true,
            shoulder_diameter: Some(1e-3 * $shoulder),
            mass: $mass,
            source: Source::Gmn,
        }
    };
}

/// Timken: designation, bore, outer diameter, width, balls, ball diameter in inches, mass.
macro_rules! timken {
    ($name:literal, $bore:literal, $outer:literal, $width:literal, $balls:literal, $numerator:literal / $denominator:literal, $mass:literal) => {
        CatalogueBearing {
            name: $name,
            bore: 1e-3 * $bore,
            outer_diameter: 1e-3 * $outer,
            width: 1e-3 * $width,
            balls: $balls,
            ball_diameter: 1e-3 * INCH * $numerator / $denominator,
            pitch_diameter: 1e-3 * 0.5 * ($bore + $outer),
            pitch_published: false,
            shoulder_diameter: None,
            mass: $mass,
            source: Source::Timken,
        }
    };
}

const BEARINGS: [CatalogueBearing; 34] = [
    gmn!("625", 5.0, 16.0, 5.0, 10.0, 3.175, 6, 12.50, 0.005),
    gmn!("626", 6.0, 19.0, 6.0, 13.3, 3.175, 8, 15.80, 0.008),
    gmn!("607", 7.0, 19.0, 6.0, 13.3, 3.175, 8, 15.80, 0.008),
    gmn!("627", 7.0, 22.0, 7.0, 14.7, 3.969, 7, 17.60, 0.012),
    gmn!("608", 8.0, 22.0, 7.0, 14.7, 3.969, 7, 17.60, 0.012),
    gmn!("629", 9.0, 26.0, 8.0, 18.0, 4.762, 7, 21.40, 0.020),
    gmn!("6000", 10.0, 26.0, 8.0, 18.0, 4.762, 7, 21.40, 0.019),
    gmn!("6001", 12.0, 28.0, 8.0, 20.0, 4.762, 8, 23.40, 0.022),
    gmn!("6002", 15.0, 32.0, 9.0, 23.5, 4.762, 9, 26.90, 0.030),
    gmn!("6003", 17.0, 35.0, 10.0, 26.0, 4.762, 10, 29.40, 0.039),
    gmn!("6004", 20.0, 42.0, 12.0, 31.0, 6.350, 9, 35.45, 0.069),
    gmn!("6005", 25.0, 47.0, 12.0, 36.0, 6.350, 10, 40.05, 0.080),
    gmn!("6006", 30.0, 55.0, 13.0, 42.5, 7.144, 11, 46.95, 0.128),
    timken!("6007", 35.0, 62.0, 14.0, 11, 5.0 / 16.0, 0.144),
    timken!("6008", 40.0, 68.0, 15.0, 12, 5.0 / 16.0, 0.180),
    timken!("6009", 45.0, 75.0, 16.0, 13, 11.0 / 32.0, 0.230),
    timken!("6010", 50.0, 80.0, 16.0, 14, 11.0 / 32.0, 0.248),
    gmn!("6200", 10.0, 30.0, 9.0, 20.0, 5.556, 7, 24.45, 0.032),
    gmn!("6201", 12.0, 32.0, 10.0, 22.0, 5.953, 7, 26.00, 0.037),
    gmn!("6202", 15.0, 35.0, 11.0, 25.3, 5.953, 8, 29.00, 0.045),
    gmn!("6203", 17.0, 40.0, 12.0, 28.5, 6.747, 8, 32.95, 0.065),
    gmn!("6204", 20.0, 47.0, 14.0, 33.5, 7.938, 8, 38.55, 0.106),
    gmn!("6205", 25.0, 52.0, 15.0, 39.1, 7.938, 9, 44.05, 0.128),
    gmn!("6206", 30.0, 62.0, 16.0, 46.0, 9.525, 9, 52.05, 0.199),
    gmn!("6207", 35.0, 72.0, 17.0, 53.5, 11.112, 9, 60.50, 0.315),
    gmn!("6208", 40.0, 80.0, 18.0, 60.0, 11.906, 9, 67.60, 0.402),
    timken!("6209", 45.0, 85.0, 19.0, 9, 1.0 / 2.0, 0.377),
    timken!("6210", 50.0, 90.0, 20.0, 10, 1.0 / 2.0, 0.425),
    timken!("6305", 25.0, 62.0, 17.0, 7, 15.0 / 32.0, 0.222),
    timken!("6306", 30.0, 72.0, 19.0, 7, 17.0 / 32.0, 0.327),
    timken!("6307", 35.0, 80.0, 21.0, 7, 9.0 / 16.0, 0.431),
    timken!("6308", 40.0, 90.0, 23.0, 8, 5.0 / 8.0, 0.594),
    timken!("6309", 45.0, 100.0, 25.0, 8, 11.0 / 16.0, 0.807),
    timken!("6310", 50.0, 110.0, 27.0, 8, 3.0 / 4.0, 1.052),
];

impl CatalogueBearing {
    /// Every bearing, by series and bore.
    pub fn all() -> &'static [Self] {
        &BEARINGS
    }

    /// The bearing of this designation; suffixes after a blank, a hyphen or a slash (`6205-2RS`, `6205/C3`) count for nothing.
    pub fn named(name: &str) -> Option<&'static Self> {
        let wanted = name.trim().split([' ', '-', '/']).next()?;
        Self::all().iter().find(|bearing| bearing.name == wanted)
    }

    /// The bearings whose outer diameter is nearest to a length in m, with the relative difference; those of equal difference in
    /// the order of the table. Empty for a length that is not above 0.
    pub fn nearest(outer_diameter: f64) -> Vec<(&'static Self, f64)> {
        if !(outer_diameter.is_finite() && outer_diameter > 0.0) {
            return Vec::new();
        }
        let off = |bearing: &Self| bearing.outer_diameter / outer_diameter - 1.0;
        let least = Self::all().iter().map(|bearing| off(bearing).abs()).fold(f64::INFINITY, f64::min);
        let near = Self::all().iter().filter(|bearing| {
            // equal diameters are equal numbers of the table
            off(bearing).abs() <= least * (1.0 + 1e-9)
        });
        near.map(|bearing| (bearing, off(bearing))).collect()
    }
}
