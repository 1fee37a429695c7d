//! A bearing of a catalogue, and where its numbers are published.

use schemars::JsonSchema;
use serde::Serialize;

/// A maker's catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// GMN, high precision deep groove ball bearings.
    Gmn,
    /// Timken (Fafnir), super precision bearings of Conrad type.
    Timken,
}

impl Source {
    /// Every source.
    pub const ALL: [Self; 2] = [Self::Gmn, Self::Timken];

    /// A word for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gmn => "GMN",
            Self::Timken => "Timken",
        }
    }

    /// Title, number, year and page.
    pub fn citation(self) -> &'static str {
        match self {
            Self::Gmn => "GMN, High precision ball bearings, catalogue 4000 0813 EN (2013), pp. 52-55",
            Self::Timken => "Timken, Products catalog (2014), section D: MM9100K p. D84, MM200K p. D96, MM300K p. D106",
        }
    }
}

/// Groove radii over the ball's diameter, inner and outer: typical values, no maker's. They are those on which the load ratings of
/// ISO 281 rest, and within the usual 0.515 to 0.53 of T. A. Harris, *Rolling Bearing Analysis*.
pub const GROOVES: [f64; 2] = [0.52, 0.53];

/// A deep groove ball bearing as its maker publishes it. Lengths in m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct CatalogueBearing {
    /// Designation by ISO 15 dimensions, without suffixes.
    pub name: &'static str,
    /// Bore diameter d, m.
    #[serde(rename = "bore_m")]
    pub bore: f64,
    /// Outer diameter D, m.
    #[serde(rename = "outer_diameter_m")]
    pub outer_diameter: f64,
    /// Width B, m.
    #[serde(rename = "width_m")]
    pub width: f64,
    /// Number of balls.
    pub balls: u32,
    /// Ball diameter, m.
    #[serde(rename = "ball_diameter_m")]
    pub ball_diameter: f64,
    /// Diameter of the circle of the balls' centres, m.
    #[serde(rename = "pitch_diameter_m")]
    pub pitch_diameter: f64,
    /// Whether the maker publishes the pitch diameter; if not, it is (d + D)/2, which is within 2 % of the published ones of the
    /// series 60 and 62.
    pub pitch_published: bool,
    /// Diameter of the outer ring's shoulders, m; `None`: not published.
    #[serde(rename = "shoulder_diameter_m")]
    pub shoulder_diameter: Option<f64>,
    /// Mass of the whole bearing, kg.
    #[serde(rename = "mass_kg")]
    pub mass: f64,
    /// Where all of this is published.
    #[serde(skip)]
    pub source: Source,
}

impl CatalogueBearing {
    /// Diameter of the outer raceway at the groove's bottom without clearance: pitch and ball diameter.
    pub fn outer_race_diameter(&self) -> f64 {
        self.pitch_diameter + self.ball_diameter
    }

    /// Diameter of the inner raceway at the groove's bottom without clearance.
    pub fn inner_race_diameter(&self) -> f64 {
        self.pitch_diameter - self.ball_diameter
    }
}

/// Bore above which, bore up to which (mm), smallest and largest clearance (µm): group N (C0). GMN, catalogue 4000 0813 EN (2013),
/// pp. 48-49, up to 40 mm; Timken, Deep groove ball bearing catalog, order no. 10857 (2017), table 5, which agrees with it, above.
const GROUP_N: [(f64, f64, f64, f64); 7] = [
    (1.5, 6.0, 2.0, 13.0),
    (6.0, 10.0, 2.0, 13.0),
    (10.0, 18.0, 3.0, 18.0),
    (18.0, 24.0, 5.0, 20.0),
    (24.0, 30.0, 5.0, 20.0),
    (30.0, 40.0, 6.0, 20.0),
    (40.0, 50.0, 6.0, 23.0),
];

/// Smallest and largest diametral clearance (m) of a new bearing of group N that is not mounted, for a bore in m; `None` outside
/// the table, 1.5 to 50 mm. Interference fits take part of it away, and so does a warm inner ring.
pub fn normal_clearance(bore: f64) -> Option<[f64; 2]> {
    // bores of the table are whole millimetres: rounding must not put one into the next row
    let bore = 1e3 * bore - 1e-6;
    let row = GROUP_N.iter().find(|&&(above, up_to, ..)| bore > above && bore <= up_to);
    row.map(|&(_, _, least, most)| [1e-6 * least, 1e-6 * most])
}
