//! Linear elastic materials, isotropic and orthotropic, and the sections of rings.

mod elastic;
mod section;

pub use elastic::{ElasticMaterial, OrthotropicMaterial};
pub use section::{BeamSection, Bond, OutOfPlaneSection, RadiusRule, RingLayer};

use thiserror::Error;

/// A linear elastic, isotropic material.
///
/// Built by [`Material::new`] alone, so its numbers are in range.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Material {
    /// Young's modulus E, Pa, > 0.
    pub young: f64,
    /// Poisson's ratio nu, in (-1, 0.5).
    pub poisson: f64,
    /// Density rho, kg/m^3, > 0.
    pub density: f64,
    /// Structural loss factor eta, in [0, 2): the stiffness is `C (1 + i eta)` under harmonic motion.
    pub loss_factor: f64,
}

/// A material or a section of a ring that cannot be.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MaterialError {
    /// Axes that are parallel.
    #[error("{0}")]
    ParallelAxes(String),
    /// A number out of its range, constants that do not go together, an axis without direction, a ring without sections.
    #[error("{0}")]
    Refused(String),
}

impl Material {
    /// A material from Young's modulus (Pa, > 0), Poisson's ratio (-1 < nu < 0.5) and density
    /// (kg/m^3, > 0), all finite.
    ///
    /// The bounds on nu are those of a positive shear and a positive, finite bulk modulus
    /// (Timoshenko and Goodier, Theory of Elasticity, section 6).
    ///
    /// # Errors
    /// [`MaterialError::Refused`] for the first quantity out of its range.
    pub fn new(young: f64, poisson: f64, density: f64) -> Result<Self, MaterialError> {
        let positive = "positive and finite";
        check(young > 0.0, "Young's modulus (Pa)", positive, young)?;
        let stable = poisson > -1.0 && poisson < 0.5;
        check(stable, "Poisson's ratio", "between -1 and 0.5", poisson)?;
        check(density > 0.0, "density (kg/m^3)", positive, density)?;
        Ok(Self { young, poisson, density, loss_factor: 0.0 })
    }

    /// The same material with a structural loss factor, 0 <= eta < 2.
    ///
    /// # Errors
    /// [`MaterialError::Refused`].
    pub fn with_loss_factor(self, loss_factor: f64) -> Result<Self, MaterialError> {
        check((0.0..2.0).contains(&loss_factor), "loss factor", "from 0 to below 2", loss_factor)?;
        Ok(Self { loss_factor, ..self })
    }

    /// Shear modulus `G = E / (2 (1 + nu))`, Pa.
    pub fn shear_modulus(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// Lame's first constant `lambda = E nu / ((1 + nu)(1 - 2 nu))`, Pa.
    pub fn lame_lambda(&self) -> f64 {
        let nu = self.poisson;
        self.young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }
}

fn check(in_range: bool, quantity: &'static str, rule: &'static str, value: f64) -> Result<(), MaterialError> {
    if in_range && value.is_finite() {
        Ok(())
    } else {
        Err(MaterialError::Refused(format!("{quantity} must be {rule}, found {value}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(young: f64, poisson: f64, density: f64) -> String {
        match Material::new(young, poisson, density) {
            Ok(material) => format!("accepted {material:?}"),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn shear_modulus_of_steel() -> Result<(), MaterialError> {
        let steel = Material::new(208e9, 0.3, 7800.0)?;
        assert!((steel.shear_modulus() - 80e9).abs() < 1e-3);
        Ok(())
    }

    #[test]
    fn a_loss_factor_is_below_two() -> Result<(), MaterialError> {
        let steel = Material::new(208e9, 0.3, 7800.0)?;
        let wood =
            OrthotropicMaterial::new([10e9, 1e9, 1e9], [0.3; 3], [1e9; 3], 500.0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])?;
        let kept = [
            ElasticMaterial::from(steel.with_loss_factor(1.9)?).loss_factor(),
            ElasticMaterial::from(wood.with_loss_factor(0.02)?).loss_factor(),
            ElasticMaterial::from(wood).loss_factor(),
        ];
        assert_eq!(kept.map(|factor| factor.to_string()), ["1.9", "0.02", "0"]);
        for value in [-0.01, 2.0, f64::NAN] {
            let expected = format!("loss factor must be from 0 to below 2, found {value}");
            let found = [steel.with_loss_factor(value).err(), wood.with_loss_factor(value).err()];
            for error in found {
                assert_eq!(error.map(|error| error.to_string()), Some(expected.clone()));
            }
        }
        Ok(())
    }

    #[test]
    fn every_rule_fires_with_its_message() {
        let rule = "Young's modulus (Pa) must be positive and finite, found";
        assert_eq!(message(0.0, 0.3, 1.0), format!("{rule} 0"));
        assert_eq!(message(-1.0, 0.3, 1.0), format!("{rule} -1"));
        assert_eq!(message(f64::NAN, 0.3, 1.0), format!("{rule} NaN"));
        assert_eq!(message(f64::INFINITY, 0.3, 1.0), format!("{rule} inf"));
        let rule = "Poisson's ratio must be between -1 and 0.5, found";
        assert_eq!(message(1.0, 0.5, 1.0), format!("{rule} 0.5"));
        assert_eq!(message(1.0, -1.0, 1.0), format!("{rule} -1"));
        assert_eq!(message(1.0, f64::NAN, 1.0), format!("{rule} NaN"));
        let rule = "density (kg/m^3) must be positive and finite, found";
        assert_eq!(message(1.0, 0.3, 0.0), format!("{rule} 0"));
        assert_eq!(message(1.0, 0.3, f64::INFINITY), format!("{rule} inf"));
    }
}
