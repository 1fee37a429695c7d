//! The curved beam in its plane.

use super::force_method::{ExactArc, SolvedArc, arc_mass};
use super::raveendranath::CoupledPolynomial;
use crate::fe::material::BeamSection;
use nalgebra::{Matrix3, Matrix3x6, Matrix6};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The ring element's interpolation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RingInterpolation {
    /// The solution of the unloaded circular arc: exact rigid motions, exact nodal statics.
    #[default]
    ExactArc,
    /// The source paper's (Raveendranath, Singh, Pradhan 1999): a cubic radial displacement with the tangential one and the rotation that
    /// follow from equilibrium; rigid translations are not exact.
    Raveendranath,
}

/// One element of a ring: its interpolation and its matrices in polar nodal components.
#[derive(Debug, Clone)]
pub struct CurvedBeam {
    field: Field,
    stiffness: Matrix6<f64>,
    /// Consistent mass matrix [6 x 6] with rotary inertia, in kg, kg m and kg m^2.
    pub(crate) mass: Matrix6<f64>,
}

#[derive(Debug, Clone)]
enum Field {
    ExactArc(Box<SolvedArc<ExactArc>>),
    Polynomial(Box<CoupledPolynomial>),
}

impl CurvedBeam {
    /// The element of a section over an included angle `2 half_angle`, rad, 0 < half_angle < pi/2.
    pub fn new(section: &BeamSection, half_angle: f64, interpolation: RingInterpolation) -> Self {
        let (field, stiffness) = match interpolation {
            RingInterpolation::ExactArc => {
                let arc = SolvedArc::new(ExactArc::new(section), half_angle);
                let stiffness = arc.stiffness;
                (Field::ExactArc(Box::new(arc)), stiffness)
            }
            RingInterpolation::Raveendranath => {
                let polynomial = CoupledPolynomial::new(section, half_angle);
                let stiffness = polynomial.stiffness(section);
                (Field::Polynomial(Box::new(polynomial)), stiffness)
            }
        };
        let mut element = Self { field, stiffness, mass: Matrix6::zeros() };
        // [[rho A, 0, rho S], [0, rho A, 0], [rho S, 0, rho I]]
        let (mass, moment) = (section.mass, section.mass_moment);
        let density = Matrix3::new(mass, 0.0, moment, 0.0, mass, 0.0, moment, 0.0, section.rotary);
        element.mass = arc_mass(half_angle, section.radius, density, |phi| element.interpolation(phi));
        element
    }

    /// Whether a rigid motion of both nodes strains nothing; that of the polynomial element does.
    pub(crate) fn is_exact_for_rigid_motions(&self) -> bool {
        matches!(self.field, Field::ExactArc(_))
    }

    /// Stiffness matrix [6 x 6] in N/m, N and N m.
    pub fn stiffness(&self) -> &Matrix6<f64> {
        &self.stiffness
    }

    /// Interpolation (u, w, theta)(phi) = N(phi) d [3 x 6]; phi in rad from the middle,
    /// |phi| <= half_angle.
    pub(crate) fn interpolation(&self, phi: f64) -> Matrix3x6<f64> {
        match &self.field {
            Field::ExactArc(arc) => arc.interpolation(phi),
            Field::Polynomial(polynomial) => polynomial.interpolation(phi),
        }
    }
}
