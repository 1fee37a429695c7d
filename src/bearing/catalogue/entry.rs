//! A bearing of a catalogue, and where its numbers are published.

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
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Gmn => "GMN",
            Self::Timken => "Timken",
        }
    }

    /// Title, number, year and page.
    #[must_use]
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
