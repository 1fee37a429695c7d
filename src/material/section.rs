//! The section of a ring: one or more rings fitted into each other, reduced to one curved beam.

use super::Material;
use thiserror::Error;

/// One ring of a section: its own area, second moment and radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingLayer {
    /// What it is made of.
    pub material: Material,
    /// Cross-section area A, m^2, > 0.
    pub area: f64,
    /// Second moment I of the area about its own centroid, axis along the ring's axis, m^4, > 0.
    pub inertia: f64,
    /// Radius of its centroid line, m, > 0.
    pub radius: f64,
    /// Shear coefficient kappa in (0, 1]; 5/6 for a rectangle (Timoshenko's first value).
    pub shear_coefficient: f64,
}

/// How the rings of a section hold together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bond {
    /// Radial contact, free to slide round: bending stiffnesses add.
    Slip(RadiusRule),
    /// Plane sections through all rings: parallel-axis terms.
    Composite,
}

/// On which radius a ring of a slipping section bends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RadiusRule {
    /// Each on its own: EI / R^3 and rho A R are summed ring by ring.
    Own,
    /// All on the EA-weighted centroid radius: EI and rho A are summed. Slip does not justify it,
    /// but it reproduces the source paper's 36 kHz.
    CommonCentroid,
}

/// A section that is no section.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SectionError {
    /// No ring given.
    #[error("a ring needs at least one section")]
    Empty,
    /// A quantity out of its range.
    #[error("ring section {index}: {quantity} must be {rule}, found {value}")]
    OutOfRange {
        /// Which section, from 0.
        index: usize,
        /// Name of the quantity.
        quantity: &'static str,
        /// The value found.
        value: f64,
        /// What it must be.
        rule: &'static str,
    },
}

/// Stiffness and inertia of a curved beam per unit length on its reference radius.
///
/// Energy of an arc: `1/2 integral (EA eps^2 + GA gamma^2 + EI kappa^2) R dphi`, kinetic energy
/// `1/2 integral (rho_A (u'^2 + w'^2) + 2 rho_S u' theta' + rho_I theta'^2) R dphi`, with the
/// strains of [`crate::element::curved_beam`].
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
    /// # Errors
    /// [`SectionError`] naming the section and the quantity.
    pub fn combine(layers: &[RingLayer], bond: Bond) -> Result<Self, SectionError> {
        for (index, layer) in layers.iter().enumerate() {
            check(index, layer)?;
        }
        let first = layers.first().ok_or(SectionError::Empty)?;
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
            Bond::Slip(_) => {
                sum(&|layer| layer.material.young * layer.inertia / ratio(layer).powi(3))
            }
            Bond::Composite => sum(&|layer| {
                layer.material.young * (layer.inertia + layer.area * arm(layer).powi(2))
            }),
        };
        let along = |layer: &RingLayer| match bond {
            Bond::Slip(_) => 1.0 / ratio(layer),
            Bond::Composite => 1.0,
        };
        let shear = sum(&|layer| {
            layer.shear_coefficient * layer.material.shear_modulus() * layer.area * along(layer)
        });
        let line_mass = |layer: &RingLayer| layer.material.density * layer.area * ratio(layer);
        let rotary = match bond {
            Bond::Slip(RadiusRule::Own) => {
                sum(&|layer| layer.material.density * layer.inertia / ratio(layer))
            }
            Bond::Slip(RadiusRule::CommonCentroid) | Bond::Composite => sum(&|layer| {
                let own = layer.material.density * layer.inertia * ratio(layer);
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
        })
    }

    /// The same section, rigid in shear.
    pub fn without_shear(self) -> Self {
        Self {
            shear_compliance: 0.0,
            ..self
        }
    }

    /// The same section without rotary inertia.
    pub fn without_rotary_inertia(self) -> Self {
        Self {
            rotary: 0.0,
            mass_moment: 0.0,
            ..self
        }
    }
}

fn check(index: usize, layer: &RingLayer) -> Result<(), SectionError> {
    let positive = [
        ("area", layer.area),
        ("inertia", layer.inertia),
        ("radius", layer.radius),
        ("shear_coefficient", layer.shear_coefficient),
    ];
    for (quantity, value) in positive {
        if !(value > 0.0 && value.is_finite()) {
            return Err(SectionError::OutOfRange {
                index,
                quantity,
                value,
                rule: "positive and finite",
            });
        }
    }
    if layer.shear_coefficient > 1.0 {
        return Err(SectionError::OutOfRange {
            index,
            quantity: "shear_coefficient",
            value: layer.shear_coefficient,
            rule: "at most 1",
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steel_in_aluminium() -> [RingLayer; 2] {
        let layer = |young, density, area, inertia, radius| RingLayer {
            material: Material::new(young, 0.3, density).expect("valid"),
            area,
            inertia,
            radius,
            shear_coefficient: 5.0 / 6.0,
        };
        [
            layer(210e9, 7850.0, 5.37e-6, 8.88e-13, 5.314e-3),
            layer(72e9, 2700.0, 12e-6, 9e-12, 7.5e-3),
        ]
    }

    /// Inextensional frequency of a thin ring, n = 2, Hz.
    fn thin_frequency(section: &BeamSection) -> f64 {
        let stiffness = section.bending / (section.mass * section.radius.powi(4));
        6.0 / 5.0_f64.sqrt() * stiffness.sqrt() / std::f64::consts::TAU
    }

    #[test]
    fn the_published_two_rings() {
        // 32.9 and 36.4 kHz: computed for the design page, given there to three digits
        let combine = |bond| BeamSection::combine(&steel_in_aluminium(), bond).expect("valid");
        let own = combine(Bond::Slip(RadiusRule::Own));
        let common = combine(Bond::Slip(RadiusRule::CommonCentroid));
        assert!((thin_frequency(&own) - 32.94e3).abs() < 50.0);
        assert!((thin_frequency(&common) - 36.4e3).abs() < 50.0);
        assert!((common.radius - 6.262e-3).abs() < 1e-6);
    }

    #[test]
    fn halves_of_one_ring_bonded_are_the_whole() {
        // a rectangle of height h, cut in two, put together again: I = b h^3 / 12
        let (width, height, radius) = (4e-3, 3e-3, 7.5e-3);
        let material = Material::new(70e9, 0.33, 2700.0).expect("valid");
        let half = |offset: f64| RingLayer {
            material,
            area: width * height / 2.0,
            inertia: width * (height / 2.0_f64).powi(3) / 12.0,
            radius: radius + offset,
            shear_coefficient: 5.0 / 6.0,
        };
        let layers = [half(-height / 4.0), half(height / 4.0)];
        let whole = BeamSection::combine(&layers, Bond::Composite).expect("valid");
        let exact = 70e9 * width * height.powi(3) / 12.0;
        assert!((whole.bending / exact - 1.0).abs() < 1e-12);
        assert!((whole.radius / radius - 1.0).abs() < 1e-12);
        assert!((whole.mass / (2700.0 * width * height) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_section_out_of_range_is_named() {
        let mut layers = steel_in_aluminium();
        layers[1].area = -1.0;
        let error = BeamSection::combine(&layers, Bond::Composite).expect_err("negative area");
        assert_eq!(
            error.to_string(),
            "ring section 1: area must be positive and finite, found -1"
        );
        assert_eq!(
            BeamSection::combine(&[], Bond::Composite),
            Err(SectionError::Empty)
        );
    }
}
