//! Cases and numbers that are part of the program: three example cases, and the bearing of Tadina & Boltezar (2011).

use super::section::VerificationError;
use crate::app::case::{Case, Source};
use crate::bearing::BearingDimensions;
use std::path::PathBuf;

/// `examples/tadina2011/beam.toml` as it was when the program was built.
pub const BEAM_CASE: &str = include_str!("../../../examples/tadina2011/beam.toml");

/// `examples/scenes/smooth.toml`, the scene without impacts.
pub(super) const SMOOTH: &str = include_str!("../../../examples/scenes/smooth.toml");

/// `examples/scenes/impact.toml`, the scene with a dent.
pub(super) const IMPACT: &str = include_str!("../../../examples/scenes/impact.toml");

/// Weight of the shaft over its mass as the paper rounds it, m/s^2.
pub(super) const GRAVITY: f64 = 9.81;

/// The bearing of the paper's Table 1.
pub const BEARING: BearingDimensions = BearingDimensions {
    balls: 7,
    ball_radius: 1e-3,
    ball_mass: 3.29e-5,
    inner_race_radius: 2.754e-3,
    outer_race_radius: 4.7565e-3,
    inner_groove_radius: 1.04e-3,
    outer_groove_radius: 1.07e-3,
};

/// A built-in case with keys set as on the command line; `name` is the file name that messages show.
///
/// # Errors
/// Those of [`Case::from_source`].
pub(super) fn built_in(name: &str, text: &str, set: &[&str]) -> Result<Case, VerificationError> {
    Ok(Case::from_source(Source {
        path: PathBuf::from(name),
        text: text.to_owned(),
        set: set.iter().map(|key| (*key).to_owned()).collect(),
    })?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_bearing_is_that_of_the_case() {
        let case = built_in("beam.toml", BEAM_CASE, &[]).unwrap();
        let setup = crate::app::scene::bearing_setup(&case).unwrap().unwrap();
        assert_eq!(*setup.geometry.dimensions(), BEARING);
        assert!((setup.gravity[1] + GRAVITY).abs() < 1e-12);
    }
}
