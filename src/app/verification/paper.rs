//! Tadina and Boltezar (2011) in numbers, and the built-in case that stands for it.

use super::VerificationError;
use crate::app::case::{Case, Source};
use crate::bearing::{BearingDimensions, ContactStiffness};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;

/// `examples/tadina2011/beam.toml` as it was when the program was built.
pub const BEAM_CASE: &str = include_str!("../../../examples/tadina2011/beam.toml");

/// The source, as checks name it.
pub const PAPER: &str = "Tadina & Boltezar 2011";

/// Weight of the shaft over its mass as the source rounds it, m/s^2.
pub const GRAVITY: f64 = 9.81;

/// Table 1's contact stiffness, N/m^1.5 (printed as N/m).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct TableStiffness {
    /// Inner race.
    pub inner: f64,
    /// Outer race.
    pub outer: f64,
}

/// Table 1's contact stiffness.
pub const TABLE_ONE: TableStiffness = TableStiffness {
    inner: 3.828e9,
    outer: 3.867e9,
};

/// Table 1's bearing.
pub const BEARING: BearingDimensions = BearingDimensions {
    balls: 7,
    ball_radius: 1e-3,
    ball_mass: 3.29e-5,
    inner_race_radius: 2.754e-3,
    outer_race_radius: 4.7565e-3,
    inner_groove_radius: 1.04e-3,
    outer_groove_radius: 1.07e-3,
};

/// The source's eigenfrequencies, Hz, in its own digits ("around").
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct PaperFrequencies {
    /// "Eigenfrequency of the bearing/housing-pedestal system" (section 4.2).
    pub sway: f64,
    /// "Eigenfrequency of the shaft" (section 4.2).
    pub bounce: f64,
    /// "First eigenfrequency of the outer ring": 35 kHz in section 4.1, 36 kHz in section 4.2.
    pub ring: [f64; 2],
}

impl Default for PaperFrequencies {
    fn default() -> Self {
        Self {
            sway: 8.2e3,
            bounce: 11.3e3,
            ring: [35e3, 36e3],
        }
    }
}

impl PaperFrequencies {
    /// How far a frequency (Hz) lies outside what the source says of the ring, relatively: 0 between its two figures, negative
    /// below them.
    #[must_use]
    pub fn outside_of_ring(&self, hz: f64) -> f64 {
        let [low, high] = self.ring;
        if hz < low {
            hz / low - 1.0
        } else if hz > high {
            hz / high - 1.0
        } else {
            0.0
        }
    }

    /// Relative distance of three frequencies (Hz) from the source's.
    #[must_use]
    pub fn errors(&self, hz: [f64; 3]) -> [f64; 3] {
        [
            hz[0] / self.sway - 1.0,
            hz[1] / self.bounce - 1.0,
            self.outside_of_ring(hz[2]),
        ]
    }
}

/// The built-in case, with keys set as on the command line.
///
/// # Errors
/// [`VerificationError::Case`].
pub fn beam_case(set: &[String]) -> Result<Case, VerificationError> {
    Ok(Case::from_source(Source {
        path: PathBuf::from("beam.toml"),
        text: BEAM_CASE.to_owned(),
        set: set.to_vec(),
    })?)
}

/// Table 1's contact stiffness as the system takes it.
///
/// # Errors
/// [`VerificationError::Stiffness`].
pub fn table_one() -> Result<ContactStiffness, VerificationError> {
    Ok(ContactStiffness::given(TABLE_ONE.inner, TABLE_ONE.outer)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_may_be_anywhere_between_the_sources_two_figures() {
        let paper = PaperFrequencies::default();
        for (hz, expected) in [(34.3e3, -0.02), (35e3, 0.0), (35.9e3, 0.0), (37.8e3, 0.05)] {
            assert!((paper.outside_of_ring(hz) - expected).abs() < 1e-12, "{hz}");
        }
        let errors = paper.errors([8.2e3 * 1.01, 11.3e3 * 0.98, 36e3]);
        assert!((errors[0] - 0.01).abs() < 1e-12 && (errors[1] + 0.02).abs() < 1e-12);
    }

    #[test]
    fn the_built_in_bearing_is_that_of_the_case() {
        let case = beam_case(&[]).unwrap();
        let setup = crate::app::scene::bearing_setup(&case).unwrap().unwrap();
        assert_eq!(*setup.geometry.dimensions(), BEARING);
        assert!((setup.gravity[1] + GRAVITY).abs() < 1e-12);
    }
}
