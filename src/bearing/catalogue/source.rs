//! Where the numbers are published.

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
            Self::Gmn => {
                "GMN, High precision ball bearings, catalogue 4000 0813 EN (2013), pp. 52-55"
            }
            Self::Timken => {
                "Timken, Products catalog (2014), section D: MM9100K p. D84, MM200K p. D96, MM300K p. D106"
            }
        }
    }
}
