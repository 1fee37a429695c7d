//! Units at the edges: what a file uses, turned into SI on the way in.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Unit of length of the coordinates in a file. Inside the program every length is in metres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
pub enum LengthUnit {
    /// m
    #[serde(rename = "m")]
    Metre,
    /// cm, 1e-2 m
    #[serde(rename = "cm")]
    Centimetre,
    /// mm, 1e-3 m
    #[serde(rename = "mm")]
    Millimetre,
    /// um, 1e-6 m
    #[serde(rename = "um")]
    Micrometre,
    /// in, 25.4e-3 m exactly (international inch, 1959)
    #[serde(rename = "in")]
    Inch,
}

impl LengthUnit {
    /// Every unit, largest SI unit first, the inch last.
    pub const ALL: [Self; 5] = [Self::Metre, Self::Centimetre, Self::Millimetre, Self::Micrometre, Self::Inch];

    /// The unit with this symbol: `m`, `cm`, `mm`, `um` or `in`; case matters, blanks around do not.
    ///
    /// # Errors
    /// A sentence with the symbol for anything else.
    pub fn parse(symbol: &str) -> Result<Self, String> {
        let unit = Self::ALL.into_iter().find(|unit| unit.symbol() == symbol.trim());
        unit.ok_or_else(|| format!("unknown length unit \"{symbol}\": expected one of m, cm, mm, um, in"))
    }

    /// How the unit is written in a case file.
    pub fn symbol(self) -> &'static str {
        self.symbol_and_metres().0
    }

    /// Length of one unit in metres: `x_metres = x * unit.to_metres()`.
    pub fn to_metres(self) -> f64 {
        self.symbol_and_metres().1
    }

    fn symbol_and_metres(self) -> (&'static str, f64) {
        match self {
            Self::Metre => ("m", 1.0),
            Self::Centimetre => ("cm", 1e-2),
            Self::Millimetre => ("mm", 1e-3),
            Self::Micrometre => ("um", 1e-6),
            Self::Inch => ("in", 25.4e-3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_symbol_reads_back_and_has_its_length() {
        let metres = [1.0, 0.01, 0.001, 1e-6, 0.0254];
        for (unit, expected) in LengthUnit::ALL.into_iter().zip(metres) {
            assert_eq!(LengthUnit::parse(unit.symbol()), Ok(unit));
            assert!((unit.to_metres() - expected).abs() <= 1e-18);
        }
        assert_eq!(LengthUnit::parse(" mm "), Ok(LengthUnit::Millimetre));
    }

    #[test]
    fn unknown_unit_names_the_known_ones() {
        let message = LengthUnit::parse("MM");
        assert_eq!(message, Err("unknown length unit \"MM\": expected one of m, cm, mm, um, in".to_owned()));
    }
}
