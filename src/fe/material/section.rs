//! The section of a ring: one or more rings fitted into each other, reduced to one curved beam.
//!
//! The beam that the rings of a section make together.
//!
//! One ring of a section: its area, its second moments and its torsion constant.

use super::Material;
use crate::fe::material::MaterialError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// How the rings of a section hold together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bond {
    /// Radial contact, free to slide round: bending stiffnesses add.
    Slip(RadiusRule),
    /// Plane sections through all rings: parallel-axis terms.
    Composite,
}

/// On which radius sections that slip bend.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RadiusRule {
    /// Each on its own: EI / R^3 and rho A R are summed ring by ring.
    #[default]
    Own,
    /// All on the centroid weighted by EA: EI and rho A are summed. Slip does not justify it, the source paper's frequencies need it.
    CommonCentroid,
}

/// Stiffness and inertia of a curved beam per unit length on its reference radius.
///
/// Energy of an arc: `1/2 integral (EA eps^2 + GA gamma^2 + EI kappa^2) R dphi`, kinetic energy
/// `1/2 integral (rho_A (u'^2 + w'^2) + 2 rho_S u' theta' + rho_I theta'^2) R dphi`, with the
/// strains of [`crate::fe::element::curved_beam`]; out of the plane see [`OutOfPlaneSection`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamSection {
    /// Reference radius R, on which the nodes lie, m.
    pub radius: f64,
    /// Axial stiffness EA, N.
    pub axial: f64,
    /// Bending stiffness EI, N m^2.
    pub bending: f64,
    /// Shear compliance 1 / (kappa G A), 1/N; zero: rigid in shear.
    pub shear_compliance: f64,
    /// Mass per length rho A, kg/m.
    pub mass: f64,
    /// First moment of mass per length about the reference radius rho S, kg.
    pub mass_moment: f64,
    /// Rotary inertia per length rho I, kg m; zero: none.
    pub rotary: f64,
    /// What the beam is out of its plane.
    pub out_of_plane: OutOfPlaneSection,
}

/// Stiffness and inertia per unit length out of the ring's plane, on the same reference radius.
///
/// Energy of an arc: `1/2 integral (GA gamma^2 + EI_a kappa^2 + GJ tau^2) R dphi`, kinetic energy
/// `1/2 integral (rho_A v'^2 - 2 rho_S v' beta' + rho_I_a alpha'^2 + rho_I_p beta'^2) R dphi`, with
/// the strains of [`crate::fe::element::curved_beam::OutOfPlaneArc`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfPlaneSection {
    /// Bending stiffness EI_a about the radial axis, N m^2.
    pub bending: f64,
    /// Torsion stiffness GJ, N m^2.
    pub torsion: f64,
    /// Shear compliance 1 / (kappa G A) along the ring's axis, 1/N; zero: rigid in shear.
    pub shear_compliance: f64,
    /// Rotary inertia per length rho I_a about the radial axis, kg m; zero: none.
    pub radial_rotary: f64,
    /// Rotary inertia per length rho I_p about the tangent, of the section's both second moments
    /// `I + I_a`, kg m; zero: none.
    pub polar_rotary: f64,
}

impl BeamSection {
    /// The beam that one or more rings make together.
    ///
    /// With `Slip(Own)` every ring bends on its own radius R_k under the common radial
    /// displacement, so `EI = R^3 sum EI_k / R_k^3`, `rho A = sum rho_k A_k R_k / R`, and axial,
    /// shear and rotary terms scale with `R / R_k`; R is the first ring's radius. With
    /// `Slip(CommonCentroid)` stiffness and mass sums are plain and R is the EA-weighted centroid
    /// radius, but the masses stay where they are: moments of mass are taken about R (without them
    /// a rigid rotation of two rings such as the source's would miss 3 % of its inertia). With
    /// `Composite` the parallel-axis terms come in everywhere, R the same.
    ///
    /// Out of the plane the rings share v and both rotations of the section, so that with `Slip(Own)`
    /// the strains of ring k are the reference's times `R / R_k`, and every stiffness is scaled by
    /// `R / R_k`, every inertia by `R_k / R`: no cube as for EI, where each ring's rotation follows from
    /// the common w. With `Slip(CommonCentroid)` and `Composite` the sums are plain. The rings'
    /// centroids are taken to lie in one plane: no parallel-axis term for EI_a. GJ is the sum of the
    /// rings' own in every case: exact where they slide, a lower bound for `Composite`, whose joint
    /// carries shear. Moments of mass have the arms of the plane's rule.
    ///
    /// # Errors
    /// [`MaterialError`] naming the section and the quantity.
    pub fn combine(layers: &[RingLayer], bond: Bond) -> Result<Self, MaterialError> {
        for (index, layer) in layers.iter().enumerate() {
            check(index, layer)?;
        }
        let first =
            layers.first().ok_or_else(|| MaterialError::Refused("a ring needs at least one section".to_owned()))?;
        let sum = |term: &dyn Fn(&RingLayer) -> f64| layers.iter().map(term).sum::<f64>();
        let axial_stiffness = |layer: &RingLayer| layer.material.young * layer.area;
        let centroid = sum(&|layer| axial_stiffness(layer) * layer.radius) / sum(&axial_stiffness);
        let radius = match bond {
            Bond::Slip(RadiusRule::Own) => first.radius,
            Bond::Slip(RadiusRule::CommonCentroid) | Bond::Composite => centroid,
        };
        // ratio of a ring's own radius to the reference; 1 where the rule puts it on the reference
        let ratio = |layer: &RingLayer| match bond {
            Bond::Slip(RadiusRule::CommonCentroid) => 1.0,
            Bond::Slip(RadiusRule::Own) | Bond::Composite => layer.radius / radius,
        };
        let arm = |layer: &RingLayer| match bond {
            Bond::Slip(RadiusRule::Own) => 0.0,
            Bond::Slip(RadiusRule::CommonCentroid) | Bond::Composite => layer.radius - radius,
        };
        let bending = match bond {
            Bond::Slip(_) => sum(&|layer| layer.material.young * layer.inertia / ratio(layer).powi(3)),
            Bond::Composite => sum(&|layer| layer.material.young * (layer.inertia + layer.area * arm(layer).powi(2))),
        };
        let along = |layer: &RingLayer| match bond {
            Bond::Slip(_) => 1.0 / ratio(layer),
            Bond::Composite => 1.0,
        };
        let shear = sum(&|layer| layer.shear_coefficient * layer.material.shear_modulus() * layer.area * along(layer));
        let line_mass = |layer: &RingLayer| layer.material.density * layer.area * ratio(layer);
        let rotary = match bond {
            Bond::Slip(RadiusRule::Own) => sum(&|layer| layer.material.density * layer.inertia / ratio(layer)),
            Bond::Slip(RadiusRule::CommonCentroid) | Bond::Composite => sum(&|layer| {
                let own = layer.material.density * layer.inertia * ratio(layer);
                own + line_mass(layer) * arm(layer).powi(2)
            }),
        };
        let out_of_plane = OutOfPlaneSection {
            bending: sum(&|layer| layer.material.young * layer.out_of_plane_inertia() * along(layer)),
            torsion: sum(&|layer| layer.material.shear_modulus() * layer.torsion_constant() * along(layer)),
            shear_compliance: 1.0 / shear,
            radial_rotary: sum(&|layer| layer.material.density * layer.out_of_plane_inertia() * ratio(layer)),
            polar_rotary: sum(&|layer| {
                let polar = layer.inertia + layer.out_of_plane_inertia();
                let own = layer.material.density * polar * ratio(layer);
                own + line_mass(layer) * arm(layer).powi(2)
            }),
        };
        Ok(Self {
            radius,
            axial: sum(&|layer| axial_stiffness(layer) * along(layer)),
            bending,
            shear_compliance: 1.0 / shear,
            mass: sum(&line_mass),
            mass_moment: sum(&|layer| line_mass(layer) * arm(layer)),
            rotary,
            out_of_plane,
        })
    }

    /// The same section, rigid in shear, in the plane and out of it.
    pub fn without_shear(self) -> Self {
        Self {
            shear_compliance: 0.0,
            out_of_plane: OutOfPlaneSection { shear_compliance: 0.0, ..self.out_of_plane },
            ..self
        }
    }

    /// The same section without rotary inertia, in the plane and out of it. Torsion has no other
    /// inertia: the mass matrix of a free ring in space is then singular to round-off from about 40
    /// elements on, and its modes cannot be computed.
    pub fn without_rotary_inertia(self) -> Self {
        Self {
            rotary: 0.0,
            mass_moment: 0.0,
            out_of_plane: OutOfPlaneSection { radial_rotary: 0.0, polar_rotary: 0.0, ..self.out_of_plane },
            ..self
        }
    }
}

/// One ring of a section: its own area, second moment and radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingLayer {
    /// What it is made of.
    pub material: Material,
    /// Cross-section area A, m^2, > 0.
    pub area: f64,
    /// Second moment I of the area about its own centroid, axis along the ring's axis, m^4, > 0.
    pub inertia: f64,
    /// Second moment I_a of the area about the radial axis, m^4, > 0: bending out of the ring's plane.
    /// `None`: that of the rectangle, `RingLayer::out_of_plane_inertia`.
    pub axial_inertia: Option<f64>,
    /// Torsion constant J, m^4, > 0. `None`: that of the rectangle, `RingLayer::torsion_constant`.
    pub torsion: Option<f64>,
    /// Radius of its centroid line, m, > 0.
    pub radius: f64,
    /// Shear coefficient kappa in (0, 1], for shear in the plane and out of it; 5/6 for a rectangle
    /// (Timoshenko's first value).
    pub shear_coefficient: f64,
}

impl RingLayer {
    /// Second moment I_a about the radial axis, m^4: as given, or that of the rectangle which has the
    /// layer's area A and second moment I, radially `h = sqrt(12 I / A)` and along the axis `b = A / h`:
    ///
    /// ```text
    /// I_a = h b^3 / 12
    /// ```
    pub(crate) fn out_of_plane_inertia(&self) -> f64 {
        self.axial_inertia.unwrap_or_else(|| {
            let [radial, axial] = self.rectangle();
            radial * axial.powi(3) / 12.0
        })
    }

    /// Torsion constant J, m^4: as given, or that of the same rectangle by its series.
    pub(crate) fn torsion_constant(&self) -> f64 {
        self.torsion.unwrap_or_else(|| rectangle_torsion(self.rectangle()))
    }

    /// Sides (radial h, axial b), m, of the rectangle with this area and second moment: `h = sqrt(12 I / A)`, `b = A / h`.
    pub(crate) fn rectangle(&self) -> [f64; 2] {
        let radial = (12.0 * self.inertia / self.area).sqrt();
        [radial, self.area / radial]
    }
}

/// Torsion constant J of a rectangle, m^4, sides in m, a the longer one:
///
/// ```text
/// J = a b^3 / 3 (1 - 192/pi^5 b/a sum over n = 1, 3, 5, ... of tanh(n pi a / (2 b)) / n^5)
/// ```
///
/// 0.1406 a^4 for a square, towards a b^3 / 3 for a thin strip. Source: Timoshenko and Goodier, Theory
/// of Elasticity, 3rd ed., section 109.
fn rectangle_torsion([first, second]: [f64; 2]) -> f64 {
    let (long, short) = (first.max(second), first.min(second));
    // sum of 1/n^5 over odd n: (1 - 2^-5) zeta(5), zeta(5) from Abramowitz and Stegun, table 23.3;
    // what tanh lacks to 1 falls by exp(-pi) and more a term: round-off after eight
    let zeta_5 = 1.036_927_755_143_37;
    let lack: f64 = (0..8)
        .map(|k| {
            let n = f64::from(2 * k + 1);
            2.0 / ((2.0 * n * FRAC_PI_2 * long / short).exp() + 1.0) / n.powi(5)
        })
        .sum();
    let sum = 31.0 / 32.0 * zeta_5 - lack;
    long * short.powi(3) / 3.0 * (1.0 - 192.0 / PI.powi(5) * short / long * sum)
}

pub(super) fn check(index: usize, layer: &RingLayer) -> Result<(), MaterialError> {
    let positive = [
        ("area", layer.area),
        ("inertia", layer.inertia),
        ("radius", layer.radius),
        ("shear_coefficient", layer.shear_coefficient),
    ];
    let given = [("axial_inertia", layer.axial_inertia), ("torsion", layer.torsion)];
    let given = given.into_iter().filter_map(|(quantity, value)| Some((quantity, value?)));
    let refused = |quantity: &str, rule: &str, value: f64| {
        let message = format!("ring section {index}: {quantity} must be {rule}, found {value}");
        Err(MaterialError::Refused(message))
    };
    for (quantity, value) in positive.into_iter().chain(given) {
        if !(value > 0.0 && value.is_finite()) {
            return refused(quantity, "positive and finite", value);
        }
    }
    if layer.shear_coefficient > 1.0 {
        return refused("shear_coefficient", "at most 1", layer.shear_coefficient);
    }
    Ok(())
}

#[cfg(test)]
mod layer_tests {
    use super::*;

    #[test]
    fn the_torsion_of_rectangles_is_the_published_one() {
        // Timoshenko and Goodier, section 109, table of k1: four digits
        for (ratio, factor) in [(1.0, 0.1406), (1.2, 0.166), (1.5, 0.196), (2.0, 0.229), (3.0, 0.263), (10.0, 0.312)] {
            let found = rectangle_torsion([ratio, 1.0]) / ratio;
            assert!((found - factor).abs() < 6e-4, "{ratio}: {found}");
            // sides change places: the same section
            assert!((rectangle_torsion([1.0, ratio]) / ratio - found).abs() < 1e-15);
        }
        // the square to seven digits; a plain sum of a thousand terms for another ratio
        assert!((rectangle_torsion([2.0, 2.0]) / 16.0 - 0.140_577_0).abs() < 5e-8);
        let plain: f64 =
            (0..1000).map(|k| f64::from(2 * k + 1)).map(|n| (n * FRAC_PI_2 * 1.3).tanh() / n.powi(5)).sum();
        let expected = 1.3 / 3.0 * (1.0 - 192.0 / PI.powi(5) / 1.3 * plain);
        assert!((rectangle_torsion([1.3, 1.0]) / expected - 1.0).abs() < 1e-12);
        // thin strip: 1/3, less 0.63 b / a
        let thin = rectangle_torsion([1e4, 1.0]) / 1e4;
        assert!((thin - (1.0 - 0.630e-4) / 3.0).abs() < 1e-8, "{thin}");
    }

    #[test]
    fn a_rectangle_is_found_again_from_area_and_second_moment() {
        let (radial, axial) = (3e-3, 4e-3);
        let layer = RingLayer {
            material: Material::new(70e9, 0.33, 2700.0).expect("valid"),
            area: radial * axial,
            inertia: axial * radial * radial * radial / 12.0,
            axial_inertia: None,
            torsion: None,
            radius: 7.5e-3,
            shear_coefficient: 5.0 / 6.0,
        };
        let exact = radial * axial * axial * axial / 12.0;
        assert!((layer.out_of_plane_inertia() / exact - 1.0).abs() < 1e-12);
        let exact = rectangle_torsion([radial, axial]);
        assert!((layer.torsion_constant() / exact - 1.0).abs() < 1e-12);
        let given = RingLayer { axial_inertia: Some(1e-12), torsion: Some(2e-12), ..layer };
        assert!((given.out_of_plane_inertia() - 1e-12).abs() < 1e-27);
        assert!((given.torsion_constant() - 2e-12).abs() < 1e-27);
    }
}

#[cfg(test)]
mod tests;
