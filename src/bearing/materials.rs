//! Contact stiffness of the two races: from materials and geometry (Hertz), or given.

use super::geometry::BearingGeometry;
use crate::bearing::error::BearingError;
use crate::bearing::hertz::{self, HertzStiffness};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Elastic constants of a surface in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactMaterial {
    /// Young's modulus, Pa, positive.
    pub young: f64,
    /// Poisson's ratio, above −1 and at most 0.5.
    pub poisson: f64,
}

/// A race.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Race {
    /// The inner race: turns with the shaft.
    Inner,
    /// The outer race: fixed in the housing.
    Outer,
}

impl std::fmt::Display for Race {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Inner => "inner",
            Self::Outer => "outer",
        })
    }
}

/// Full Hertz results at both races, for the report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RaceContacts {
    /// Ball on inner race.
    pub inner: HertzStiffness,
    /// Ball on outer race.
    pub outer: HertzStiffness,
}

impl RaceContacts {
    /// Hertz theory for `ball` against each race of `bearing` (the paper's (21), (22), nominal radii).
    ///
    /// # Errors
    /// [`BearingError`] names the race and the reason.
    pub fn new(
        bearing: &BearingGeometry,
        ball: ContactMaterial,
        inner_race: ContactMaterial,
        outer_race: ContactMaterial,
    ) -> Result<Self, BearingError> {
        let contact = |race, material: ContactMaterial, curvatures| {
            hertz::effective_modulus([ball.young, material.young], [ball.poisson, material.poisson])
                .and_then(|modulus| hertz::stiffness(bearing.ball_curvatures(), curvatures, modulus))
                .map_err(|error| BearingError(format!("{race} race: {error}")))
        };
        Ok(Self {
            inner: contact(Race::Inner, inner_race, bearing.inner_curvatures())?,
            outer: contact(Race::Outer, outer_race, bearing.outer_curvatures())?,
        })
    }

    /// The two stiffnesses alone.
    pub fn stiffness(&self) -> ContactStiffness {
        ContactStiffness { inner: self.inner.stiffness, outer: self.outer.stiffness }
    }
}

/// k of `F = k δ^{3/2}` at each race, N/m^{3/2}, positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactStiffness {
    inner: f64,
    outer: f64,
}

impl ContactStiffness {
    /// As given, N/m^{3/2}.
    ///
    /// # Errors
    /// [`BearingError`] unless positive and finite.
    pub fn given(inner: f64, outer: f64) -> Result<Self, BearingError> {
        for (race, value) in [(Race::Inner, inner), (Race::Outer, outer)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(BearingError(format!("stiffness.{race} = {value} N/m^(3/2) must be positive and finite")));
            }
        }
        Ok(Self { inner, outer })
    }

    /// Ball on inner race, N/m^{3/2}.
    #[inline]
    pub fn inner(&self) -> f64 {
        self.inner
    }

    /// Ball on outer race, N/m^{3/2}.
    #[inline]
    pub fn outer(&self) -> f64 {
        self.outer
    }

    /// Ball on the given race, N/m^{3/2}.
    pub fn at(&self, race: Race) -> f64 {
        match race {
            Race::Inner => self.inner,
            Race::Outer => self.outer,
        }
    }

    /// Both in series, N/m^{3/2}: `(k_i^{-2/3} + k_o^{-2/3})^{-3/2}`, shaft against outer race through one ball.
    pub(crate) fn series(&self) -> f64 {
        let compliance = self.inner.powf(-2.0 / 3.0) + self.outer.powf(-2.0 / 3.0);
        compliance.powf(-1.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::samples::{source_bearing, source_stiffness, steel};
    use approx::assert_relative_eq;

    #[test]
    fn source_bearing_in_steel() {
        let stiffness = source_stiffness();
        assert_relative_eq!(stiffness.inner(), 1.257e10, max_relative = 5e-4);
        assert_relative_eq!(stiffness.outer(), 1.129e10, max_relative = 5e-4);
        assert_relative_eq!(stiffness.series(), 4.21e9, max_relative = 1.5e-3);
    }

    #[test]
    fn a_softer_outer_race_softens_the_outer_contact_alone() {
        let soft = ContactMaterial { young: 103e9, poisson: 0.3 };
        let mixed = RaceContacts::new(&source_bearing(), steel(), steel(), soft).unwrap().stiffness();
        let all = source_stiffness();
        assert_relative_eq!(mixed.inner(), all.inner(), max_relative = 1e-15);
        assert_relative_eq!(mixed.outer(), all.outer() * 2.0 / 3.0, max_relative = 1e-14);
    }

    #[test]
    fn errors_name_the_race() {
        let bad = ContactMaterial { young: -1.0, poisson: 0.3 };
        let error = RaceContacts::new(&source_bearing(), steel(), steel(), bad).unwrap_err();
        assert_eq!(error.to_string(), "outer race: Young's modulus -1 Pa must be positive");
        let error = ContactStiffness::given(0.0, 1.0).unwrap_err();
        assert_eq!(error.to_string(), "stiffness.inner = 0 N/m^(3/2) must be positive and finite");
        assert!(ContactStiffness::given(1.0, f64::NAN).is_err());
    }
}
