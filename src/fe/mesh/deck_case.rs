//! What an input file of Abaqus or CalculiX says of the case: materials in its own units, and what it holds.

use crate::numerics::units::LengthUnit;
use schemars::JsonSchema;
use serde::Serialize;

/// A material of the file. Its numbers are in the file's units.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DeckMaterial {
    /// Its name.
    pub name: String,
    /// Groups of the bodies that are made of it alone.
    pub groups: Vec<String>,
    /// Young's modulus and Poisson's ratio; `None`: the file has no isotropic ones, or several over temperature.
    pub elastic: Option<[f64; 2]>,
    /// Density; `None`: the file has none, or several over temperature.
    pub density: Option<f64>,
}

/// Directions in which the file holds the nodes of a group.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct DeckSupport {
    /// The group.
    pub group: String,
    /// Along x, y and z; none: its lines hold nothing, or could not be used.
    pub fixed: [bool; 3],
}

/// Units that go together, so that force is mass times length over time squared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct ConsistentUnits {
    /// Length, mass (or force) and time.
    pub(crate) name: &'static str,
    pub(crate) length: LengthUnit,
    /// One unit of stress, Pa.
    stress: f64,
    /// One unit of density, kg/m^3.
    density: f64,
}

const fn units(name: &'static str, length: LengthUnit, stress: f64, density: f64) -> ConsistentUnits {
    ConsistentUnits { name, length, stress, density }
}

const SYSTEMS: [ConsistentUnits; 8] = [
    units("m-kg-s", LengthUnit::Metre, 1.0, 1.0),
    units("mm-t-s", LengthUnit::Millimetre, 1e6, 1e12),
    units("mm-kg-ms", LengthUnit::Millimetre, 1e9, 1e9),
    units("mm-g-ms", LengthUnit::Millimetre, 1e6, 1e6),
    units("mm-kg-s", LengthUnit::Millimetre, 1e3, 1e9),
    units("cm-g-s", LengthUnit::Centimetre, 0.1, 1e3),
    units("um-kg-s", LengthUnit::Micrometre, 1e6, 1e18),
    // psi, and 0.0254^2 m^2 between stress and density
    units("in-lbf-s", LengthUnit::Inch, 6_894.757_293_168, 1.068_689_65e7),
];

/// Densities of what housings are made of, kg/m^3: from plastics to tungsten.
const DENSITIES: std::ops::RangeInclusive<f64> = 500.0..=23_000.0;

/// Modulus over density of these, m^2/s^2: from polyethylene to diamond.
const STIFFNESSES: std::ops::RangeInclusive<f64> = 1e5..=4e8;

impl ConsistentUnits {
    /// The one system in which all materials of the file are solids; `None` if none or several are.
    pub(crate) fn of(materials: &[DeckMaterial]) -> Option<Self> {
        materials.iter().find(|material| material.elastic.is_some() && material.density.is_some())?;
        let fits = |units: &&Self| {
            materials
                .iter()
                .filter_map(|material| units.to_si(material))
                .all(|[young, _, density]| DENSITIES.contains(&density) && STIFFNESSES.contains(&(young / density)))
        };
        let mut fitting = SYSTEMS.iter().filter(fits);
        let found = fitting.next();
        found.filter(|_| fitting.next().is_none()).copied()
    }

    /// Young's modulus (Pa), Poisson's ratio and density (kg/m^3) of a material that has all three.
    pub(crate) fn to_si(self, material: &DeckMaterial) -> Option<[f64; 3]> {
        let [young, poisson] = material.elastic?;
        Some([self.stress * young, poisson, self.density * material.density?])
    }
}

#[cfg(test)]
mod tests {
    use super::{ConsistentUnits, DeckMaterial, SYSTEMS};

    /// Steel, aluminium, cast iron, magnesium, brass, a plastic and silicon nitride.
    const SOLIDS: [[f64; 2]; 7] = [
        [210e9, 7850.0],
        [70e9, 2700.0],
        [110e9, 7200.0],
        [45e9, 1810.0],
        [97e9, 8470.0],
        [2.5e9, 1140.0],
        [310e9, 3200.0],
    ];

    fn material([young, density]: [f64; 2]) -> DeckMaterial {
        DeckMaterial { name: "m".to_owned(), groups: Vec::new(), elastic: Some([young, 0.3]), density: Some(density) }
    }

    #[test]
    fn every_system_is_known_by_every_solid() {
        for system in SYSTEMS {
            for [young, density] in SOLIDS {
                let own = material([young / system.stress, density / system.density]);
                assert_eq!(ConsistentUnits::of(&[own]).map(|found| found.name), Some(system.name), "{young}");
            }
        }
        let own = material([210_000.0, 7.85e-9]);
        let [young, poisson, density] =
            ConsistentUnits::of(std::slice::from_ref(&own)).and_then(|units| units.to_si(&own)).unwrap();
        assert!((young / 210e9 - 1.0).abs() < 1e-12 && (density / 7850.0 - 1.0).abs() < 1e-12 && poisson < 0.31);
    }

    #[test]
    fn numbers_that_do_not_go_together_have_no_system() {
        assert_eq!(ConsistentUnits::of(&[material([210_000.0, 7850.0])]), None);
        assert_eq!(ConsistentUnits::of(&[material([210e9, 7850.0]), material([70_000.0, 2.7e-9])]), None);
        assert_eq!(ConsistentUnits::of(&[DeckMaterial { density: None, ..material([210e9, 7850.0]) }]), None);
    }
}
