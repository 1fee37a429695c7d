//! Common deep groove ball bearings with their inner dimensions, each number with its source.
//!
//! Number and size of the balls are the maker's own choice, which the standard of outer dimensions (ISO 15) leaves open: of the
//! bearings that both makers below publish, 6004 and 6208 differ (8 balls of 6.35 mm and 9 of 12.70 mm at Timken, against 9 of
//! 6.350 mm and 9 of 11.906 mm at GMN). Orders of a bearing at hand are best taken from its own maker.
//!
//! **Limitations**: no raceway radii and no groove radii: makers do not publish them. They follow from ball and pitch diameter, a
//! [clearance](normal_clearance) and [typical grooves](GROOVES).

mod clearance;
mod ring_section;
mod source;
mod table;

pub use clearance::normal_clearance;
pub use ring_section::OuterRingSection;
pub use source::Source;

/// Groove radii over the ball's diameter, inner and outer: typical values, no maker's. They are those on which the load ratings of
/// ISO 281 rest, and within the usual 0.515 to 0.53 of T. A. Harris, *Rolling Bearing Analysis*.
pub const GROOVES: [f64; 2] = [0.52, 0.53];

/// A deep groove ball bearing as its maker publishes it. Lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CatalogueBearing {
    /// Designation by ISO 15 dimensions, without suffixes.
    pub name: &'static str,
    /// Bore diameter d.
    pub bore: f64,
    /// Outer diameter D.
    pub outer_diameter: f64,
    /// Width B.
    pub width: f64,
    /// Number of balls.
    pub balls: u32,
    /// Ball diameter.
    pub ball_diameter: f64,
    /// Diameter of the circle of the balls' centres.
    pub pitch_diameter: f64,
    /// Whether the maker publishes the pitch diameter; if not, it is (d + D)/2, which is within 2 % of the published ones of the
    /// series 60 and 62.
    pub pitch_published: bool,
    /// Diameter of the outer ring's shoulders; `None`: not published.
    pub shoulder_diameter: Option<f64>,
    /// Mass of the whole bearing, kg.
    pub mass: f64,
    /// Where all of this is published.
    pub source: Source,
}

impl CatalogueBearing {
    /// Every bearing, by series and bore.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &table::BEARINGS
    }

    /// The bearing of this designation; suffixes after a blank, a hyphen or a slash (`6205-2RS`, `6205/C3`) count for nothing.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        let wanted = name.trim().split([' ', '-', '/']).next()?;
        Self::all().iter().find(|bearing| bearing.name == wanted)
    }

    /// The bearings whose outer diameter is nearest to a length in m, with the relative difference; those of equal difference in
    /// the order of the table. Empty for a length that is not above 0.
    #[must_use]
    pub fn nearest(outer_diameter: f64) -> Vec<(&'static Self, f64)> {
        if !(outer_diameter.is_finite() && outer_diameter > 0.0) {
            return Vec::new();
        }
        let off = |bearing: &Self| bearing.outer_diameter / outer_diameter - 1.0;
        let least = Self::all()
            .iter()
            .map(|bearing| off(bearing).abs())
            .fold(f64::INFINITY, f64::min);
        let near = Self::all().iter().filter(|bearing| {
            // equal diameters are equal numbers of the table
            off(bearing).abs() <= least * (1.0 + 1e-9)
        });
        near.map(|bearing| (bearing, off(bearing))).collect()
    }

    /// Diameter of the outer raceway at the groove's bottom without clearance: pitch and ball diameter.
    #[must_use]
    pub fn outer_race_diameter(&self) -> f64 {
        self.pitch_diameter + self.ball_diameter
    }

    /// Diameter of the inner raceway at the groove's bottom without clearance.
    #[must_use]
    pub fn inner_race_diameter(&self) -> f64 {
        self.pitch_diameter - self.ball_diameter
    }
}

#[cfg(test)]
mod tests;
