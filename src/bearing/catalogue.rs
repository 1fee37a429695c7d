//! Common deep groove ball bearings with their inner dimensions, each number with its source.
//!
//! Number and size of the balls are the maker's own choice, which the standard of outer dimensions (ISO 15) leaves open: of the
//! bearings that GMN and Timken publish, 6004 and 6208 differ (8 balls of 6.35 mm and 9 of 12.70 mm at Timken, against 9 of
//! 6.350 mm and 9 of 11.906 mm at GMN). Orders of a bearing at hand are best taken from its own maker.
//!
//! **Limitations**: no raceway radii and no groove radii: makers do not publish them. They follow from ball and pitch diameter, a
//! [clearance](normal_clearance) and [typical grooves](GROOVES).
//!
//! The numbers are as printed: millimetres, kilograms; balls in inches where they are no GMN's. GMN's 609 is left out: the mass printed for
//! it is more than that of full steel.

mod designation;

use Source::{Gmn, Nsk, Timken};
use designation::{Designation, SEPARATORS};
use schemars::JsonSchema;
use serde::Serialize;

const INCH: f64 = 25.4;

/// Of GMN: designation, d, D, B, d_m and D_W in mm, Z, then D1 in mm and the mass in kg.
const fn gmn(
    name: &'static str,
    [bore, outer, width, pitch, ball]: [f64; 5],
    balls: u32,
    [shoulder, mass]: [f64; 2],
) -> CatalogueBearing {
    CatalogueBearing {
        name,
        bore: 1e-3 * bore,
        outer_diameter: 1e-3 * outer,
        width: 1e-3 * width,
        balls,
        ball_diameter: 1e-3 * ball,
        pitch_diameter: 1e-3 * pitch,
        pitch_published: true,
        shoulder_diameter: Some(1e-3 * shoulder),
        mass,
        source: Gmn,
    }
}

/// Without a published pitch diameter: source, designation, d, D and B in mm, number of balls, their diameter as a fraction of an inch,
/// mass in kg.
const fn inches(
    source: Source,
    name: &'static str,
    [bore, outer, width]: [f64; 3],
    balls: u32,
    [numerator, denominator]: [f64; 2],
    mass: f64,
) -> CatalogueBearing {
    CatalogueBearing {
        ball_diameter: 1e-3 * INCH * numerator / denominator,
        pitch_diameter: 1e-3 * 0.5 * (bore + outer),
        pitch_published: false,
        shoulder_diameter: None,
        source,
        ..gmn(name, [bore, outer, width, 0.0, 0.0], balls, [0.0, mass])
    }
}

const BEARINGS: [CatalogueBearing; 69] = [
    gmn("625", [5.0, 16.0, 5.0, 10.0, 3.175], 6, [12.50, 0.005]),
    gmn("626", [6.0, 19.0, 6.0, 13.3, 3.175], 8, [15.80, 0.008]),
    gmn("607", [7.0, 19.0, 6.0, 13.3, 3.175], 8, [15.80, 0.008]),
    gmn("627", [7.0, 22.0, 7.0, 14.7, 3.969], 7, [17.60, 0.012]),
    gmn("608", [8.0, 22.0, 7.0, 14.7, 3.969], 7, [17.60, 0.012]),
    gmn("629", [9.0, 26.0, 8.0, 18.0, 4.762], 7, [21.40, 0.020]),
    gmn("6000", [10.0, 26.0, 8.0, 18.0, 4.762], 7, [21.40, 0.019]),
    gmn("6001", [12.0, 28.0, 8.0, 20.0, 4.762], 8, [23.40, 0.022]),
    gmn("6002", [15.0, 32.0, 9.0, 23.5, 4.762], 9, [26.90, 0.030]),
    gmn("6003", [17.0, 35.0, 10.0, 26.0, 4.762], 10, [29.40, 0.039]),
    gmn("6004", [20.0, 42.0, 12.0, 31.0, 6.350], 9, [35.45, 0.069]),
    gmn("6005", [25.0, 47.0, 12.0, 36.0, 6.350], 10, [40.05, 0.080]),
    gmn("6006", [30.0, 55.0, 13.0, 42.5, 7.144], 11, [46.95, 0.128]),
    inches(Timken, "6007", [35.0, 62.0, 14.0], 11, [5.0, 16.0], 0.144),
    inches(Timken, "6008", [40.0, 68.0, 15.0], 12, [5.0, 16.0], 0.180),
    inches(Timken, "6009", [45.0, 75.0, 16.0], 13, [11.0, 32.0], 0.230),
    inches(Timken, "6010", [50.0, 80.0, 16.0], 14, [11.0, 32.0], 0.248),
    inches(Timken, "6011", [55.0, 90.0, 18.0], 13, [13.0, 32.0], 0.362),
    inches(Timken, "6012", [60.0, 95.0, 18.0], 14, [13.0, 32.0], 0.430),
    inches(Timken, "6013", [65.0, 100.0, 18.0], 15, [13.0, 32.0], 0.450),
    inches(Timken, "6014", [70.0, 110.0, 20.0], 14, [15.0, 32.0], 0.620),
    inches(Timken, "6015", [75.0, 115.0, 20.0], 15, [15.0, 32.0], 0.606),
    inches(Timken, "6016", [80.0, 125.0, 22.0], 14, [17.0, 32.0], 0.804),
    inches(Timken, "6017", [85.0, 130.0, 22.0], 15, [17.0, 32.0], 0.845),
    inches(Timken, "6018", [90.0, 140.0, 24.0], 14, [19.0, 32.0], 1.092),
    inches(Nsk, "6019", [95.0, 145.0, 24.0], 15, [19.0, 32.0], 1.180),
    inches(Timken, "6020", [100.0, 150.0, 24.0], 15, [19.0, 32.0], 1.208),
    gmn("6200", [10.0, 30.0, 9.0, 20.0, 5.556], 7, [24.45, 0.032]),
    gmn("6201", [12.0, 32.0, 10.0, 22.0, 5.953], 7, [26.00, 0.037]),
    gmn("6202", [15.0, 35.0, 11.0, 25.3, 5.953], 8, [29.00, 0.045]),
    gmn("6203", [17.0, 40.0, 12.0, 28.5, 6.747], 8, [32.95, 0.065]),
    gmn("6204", [20.0, 47.0, 14.0, 33.5, 7.938], 8, [38.55, 0.106]),
    gmn("6205", [25.0, 52.0, 15.0, 39.1, 7.938], 9, [44.05, 0.128]),
    gmn("6206", [30.0, 62.0, 16.0, 46.0, 9.525], 9, [52.05, 0.199]),
    gmn("6207", [35.0, 72.0, 17.0, 53.5, 11.112], 9, [60.50, 0.315]),
    gmn("6208", [40.0, 80.0, 18.0, 60.0, 11.906], 9, [67.60, 0.402]),
    inches(Timken, "6209", [45.0, 85.0, 19.0], 9, [1.0, 2.0], 0.377),
    inches(Timken, "6210", [50.0, 90.0, 20.0], 10, [1.0, 2.0], 0.425),
    inches(Timken, "6211", [55.0, 100.0, 21.0], 10, [9.0, 16.0], 0.564),
    inches(Timken, "6212", [60.0, 110.0, 22.0], 10, [5.0, 8.0], 0.727),
    inches(Timken, "6213", [65.0, 120.0, 23.0], 10, [21.0, 32.0], 0.928),
    inches(Timken, "6214", [70.0, 125.0, 24.0], 10, [11.0, 16.0], 0.994),
    inches(Timken, "6215", [75.0, 130.0, 25.0], 10, [11.0, 16.0], 1.074),
    inches(Timken, "6216", [80.0, 140.0, 26.0], 10, [3.0, 4.0], 1.317),
    inches(Nsk, "6217", [85.0, 150.0, 28.0], 10, [13.0, 16.0], 1.800),
    inches(Nsk, "6218", [90.0, 160.0, 30.0], 10, [7.0, 8.0], 2.150),
    inches(Nsk, "6219", [95.0, 170.0, 32.0], 10, [15.0, 16.0], 2.600),
    inches(Nsk, "6220", [100.0, 180.0, 34.0], 10, [1.0, 1.0], 3.200),
    inches(Nsk, "6300", [10.0, 35.0, 11.0], 6, [9.0, 32.0], 0.050),
    inches(Nsk, "6301", [12.0, 37.0, 12.0], 6, [5.0, 16.0], 0.060),
    inches(Nsk, "6302", [15.0, 42.0, 13.0], 7, [5.0, 16.0], 0.080),
    inches(Nsk, "6303", [17.0, 47.0, 14.0], 7, [11.0, 32.0], 0.120),
    inches(Nsk, "6304", [20.0, 52.0, 15.0], 7, [3.0, 8.0], 0.140),
    inches(Timken, "6305", [25.0, 62.0, 17.0], 7, [15.0, 32.0], 0.222),
    inches(Timken, "6306", [30.0, 72.0, 19.0], 7, [17.0, 32.0], 0.327),
    inches(Timken, "6307", [35.0, 80.0, 21.0], 7, [9.0, 16.0], 0.431),
    inches(Timken, "6308", [40.0, 90.0, 23.0], 8, [5.0, 8.0], 0.594),
    inches(Timken, "6309", [45.0, 100.0, 25.0], 8, [11.0, 16.0], 0.807),
    inches(Timken, "6310", [50.0, 110.0, 27.0], 8, [3.0, 4.0], 1.052),
    inches(Timken, "6311", [55.0, 120.0, 29.0], 8, [13.0, 16.0], 1.329),
    inches(Timken, "6312", [60.0, 130.0, 31.0], 8, [7.0, 8.0], 1.665),
    inches(Timken, "6313", [65.0, 140.0, 33.0], 8, [15.0, 16.0], 2.046),
    inches(Timken, "6314", [70.0, 150.0, 35.0], 8, [1.0, 1.0], 2.486),
    inches(Nsk, "6315", [75.0, 160.0, 37.0], 8, [17.0, 16.0], 3.000),
    inches(Nsk, "6316", [80.0, 170.0, 39.0], 8, [9.0, 8.0], 3.600),
    inches(Nsk, "6317", [85.0, 180.0, 41.0], 8, [19.0, 16.0], 4.250),
    inches(Nsk, "6318", [90.0, 190.0, 43.0], 8, [5.0, 4.0], 4.900),
    inches(Nsk, "6319", [95.0, 200.0, 45.0], 8, [21.0, 16.0], 5.750),
    inches(Nsk, "6320", [100.0, 215.0, 47.0], 8, [23.0, 16.0], 6.980),
];

impl CatalogueBearing {
    /// Every bearing, by series and bore.
    pub fn all() -> &'static [Self] {
        &BEARINGS
    }

    /// The bearing of this designation; makers before it and suffixes behind it (`SKF 6205-2RS1/C3`, `6205zz`) count for nothing.
    pub fn named(name: &str) -> Option<&'static Self> {
        let (number, _) = Designation::of(name).known(Self::has)?;
        Self::all().iter().find(|bearing| bearing.name == number)
    }

    fn has(number: &str) -> bool {
        Self::all().iter().any(|bearing| bearing.name == number)
    }

    /// What of a designation that [`named`](Self::named) knows counts for nothing, in quotes; `None`: all of it counts.
    pub(crate) fn left_out(name: &str) -> Option<String> {
        let designation = Designation::of(name);
        let (_, suffix) = designation.known(Self::has)?;
        let parts = [designation.maker, suffix.trim_start_matches(SEPARATORS)];
        let parts = parts.into_iter().filter(|part| !part.is_empty()).map(|part| format!("\"{part}\""));
        Some(parts.collect::<Vec<_>>().join(" and ")).filter(|parts| !parts.is_empty())
    }

    /// What a designation names by its system, DIN 623-1, where that is no single-row deep groove ball bearing.
    pub(crate) fn other_type(name: &str) -> Option<&'static str> {
        Designation::of(name).other_type()
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

/// A maker's catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// GMN, high precision deep groove ball bearings.
    Gmn,
    /// Timken (Fafnir), super precision bearings of Conrad type.
    Timken,
    /// NSK, whose load ratings tell number and size of the balls; masses by Timken.
    Nsk,
}

impl Source {
    /// Every source.
    pub const ALL: [Self; 3] = [Self::Gmn, Self::Timken, Self::Nsk];

    /// A word for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gmn => "GMN",
            Self::Timken => "Timken",
            Self::Nsk => "NSK",
        }
    }

    /// Title, number, year and page.
    pub(crate) fn citation(self) -> &'static str {
        match self {
            Self::Gmn => "GMN, High precision ball bearings, catalogue 4000 0813 EN (2013), pp. 52-55",
            Self::Timken => "Timken, Products catalog (2014), section D: MM9100K p. D84, MM200K p. D96, MM300K p. D106",
            Self::Nsk => {
                "NSK, Rolling bearings, CAT. No. E1102e (2007), pp. B8-B15: sizes and load ratings, by which ISO 76 and ISO 281 have these balls alone; mass: Timken, order no. 10857 (2017)"
            }
        }
    }
}

/// Groove radii over the ball's diameter, inner and outer: typical values, no maker's. They are those on which the load ratings of
/// ISO 281 rest, and within the usual 0.515 to 0.53 of T. A. Harris, *Rolling Bearing Analysis*.
pub const GROOVES: [f64; 2] = [0.52, 0.53];

/// A deep groove ball bearing as its maker publishes it; NSK's balls follow from what is published. Lengths in m.
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
    pub(crate) fn outer_race_diameter(&self) -> f64 {
        self.pitch_diameter + self.ball_diameter
    }

    /// Diameter of the inner raceway at the groove's bottom without clearance.
    pub(crate) fn inner_race_diameter(&self) -> f64 {
        self.pitch_diameter - self.ball_diameter
    }
}

/// Numbers of a bearing that no maker publishes, as usual ones. SI.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct UsualNumbers {
    /// Radial play, m: half the middle of the [clearance](normal_clearance) of group N; 0 for a bore outside its table.
    pub play: f64,
    /// Radius of the inner groove, m, by [`GROOVES`].
    pub inner_groove: f64,
    /// Radius of the outer groove, m.
    pub outer_groove: f64,
}

impl UsualNumbers {
    /// Those of a bearing.
    pub fn of(bearing: &CatalogueBearing) -> Self {
        let [least, most] = normal_clearance(bearing.bore).unwrap_or_default();
        let [inner_groove, outer_groove] = GROOVES.map(|ratio| ratio * bearing.ball_diameter);
        // the clearance is of the diameter, and half way between its limits
        Self { play: 0.25 * (least + most), inner_groove, outer_groove }
    }
}

/// Bore above which, bore up to which (mm), smallest and largest clearance (µm): group N (C0). GMN, catalogue 4000 0813 EN (2013),
/// pp. 48-49, up to 40 mm; Timken, Deep groove ball bearing catalog, order no. 10857 (2017), table 5, which agrees with it, above.
const GROUP_N: [(f64, f64, f64, f64); 10] = [
    (1.5, 6.0, 2.0, 13.0),
    (6.0, 10.0, 2.0, 13.0),
    (10.0, 18.0, 3.0, 18.0),
    (18.0, 24.0, 5.0, 20.0),
    (24.0, 30.0, 5.0, 20.0),
    (30.0, 40.0, 6.0, 20.0),
    (40.0, 50.0, 6.0, 23.0),
    (50.0, 65.0, 8.0, 28.0),
    (65.0, 80.0, 10.0, 30.0),
    (80.0, 100.0, 12.0, 36.0),
];

/// Smallest and largest diametral clearance (m) of a new bearing of group N that is not mounted, for a bore in m; `None` outside
/// the table, 1.5 to 100 mm. Interference fits take part of it away, and so does a warm inner ring.
pub fn normal_clearance(bore: f64) -> Option<[f64; 2]> {
    // bores of the table are whole millimetres: rounding must not put one into the next row
    let bore = 1e3 * bore - 1e-6;
    let row = GROUP_N.iter().find(|&&(above, up_to, ..)| bore > above && bore <= up_to);
    row.map(|&(_, _, least, most)| [1e-6 * least, 1e-6 * most])
}

/// Cross-section of an outer ring, without chamfers and seal grooves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OuterRingSection {
    /// Area A, m^2.
    pub area: f64,
    /// Radius of the centroid from the bearing's axis, m.
    pub radius: f64,
    /// Second moment of area about the axial line through the centroid, m^4: bending in the ring's plane.
    pub inertia: f64,
    /// Second moment of area about the radial line through the middle, m^4: bending out of the plane.
    pub axial_inertia: f64,
}

impl OuterRingSection {
    /// A rectangle between two diameters.
    pub fn rectangle(outer_diameter: f64, inner_diameter: f64, width: f64) -> Self {
        let height = 0.5 * (outer_diameter - inner_diameter);
        Self {
            area: width * height,
            radius: 0.25 * (outer_diameter + inner_diameter),
            inertia: width * height.powi(3) / 12.0,
            axial_inertia: height * width.powi(3) / 12.0,
        }
    }

    /// The section of a bearing's outer ring with a [typical groove](GROOVES): down to the shoulders where their diameter is
    /// published, else down to the groove's bottom alone, which leaves the shoulders out.
    pub fn of(bearing: &CatalogueBearing) -> Self {
        let bottom = bearing.outer_race_diameter();
        let Some(shoulder) = bearing.shoulder_diameter else {
            return Self::rectangle(bearing.outer_diameter, bottom, bearing.width);
        };
        let whole = Self::rectangle(bearing.outer_diameter, shoulder, bearing.width);
        let groove = GROOVES[1] * bearing.ball_diameter;
        whole.without_groove(groove, 0.5 * bottom, 0.5 * shoulder)
    }

    /// Takes a groove of this radius away: the part of a circle, tangent to the bottom's radius, that lies outside the shoulder's.
    fn without_groove(self, groove: f64, bottom: f64, shoulder: f64) -> Self {
        let centre = bottom - groove;
        // half the angle of the segment, seen from the groove's centre
        let half = ((shoulder - centre) / groove).clamp(-1.0, 1.0).acos();
        let (sin2, sin4) = ((2.0 * half).sin(), (4.0 * half).sin());
        // moments of the segment's area about its circle's centre: of order 0, 1 and 2 along the radius, and 2 across
        let cut = groove.powi(2) * (half - 0.5 * sin2);
        let cut_first = 2.0 / 3.0 * (groove * half.sin()).powi(3);
        let cut_second = 0.25 * groove.powi(4) * (half - 0.25 * sin4);
        let across = 2.0 / 3.0 * groove.powi(4) * (0.375 * half - 0.25 * sin2 + sin4 / 32.0);
        // about the bearing's axis, then back to the new centroid
        let area = self.area - cut;
        let first = self.area * self.radius - (cut_first + cut * centre);
        let second = self.inertia + self.area * self.radius.powi(2)
            - (cut_second + 2.0 * centre * cut_first + cut * centre.powi(2));
        let radius = first / area;
        Self { area, radius, inertia: second - area * radius.powi(2), axial_inertia: self.axial_inertia - across }
    }
}

#[cfg(test)]
mod tests;
