//! What an input file of Abaqus or CalculiX says of the case: materials in its own units, and what it holds.

use crate::numerics::units::LengthUnit;
use schemars::JsonSchema;
use serde::Serialize;

/// A material of the file. Its numbers are in the file's units.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct DeckMaterial {
    /// Its name.
    pub name: String,
    /// Groups of the bodies that are made of it alone.
    pub groups: Vec<String>,
    /// Young's modulus and Poisson's ratio, as the file has them; `None`: it has no isotropic ones.
    pub elastic: Option<[f64; 2]>,
    /// What it has in their place, or beside them: `*HYPERELASTIC`, or `*ELASTIC` with its type.
    pub other_law: Option<String>,
    /// Density, as the file has it; `None`: it has none.
    pub density: Option<f64>,
    /// The file has several lines over temperature, and the first is taken.
    pub first_line: bool,
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

/// The same of soft materials and light ones, where no other material shows the unit: rubber and wood.
const LIGHT: std::ops::RangeInclusive<f64> = 300.0..=1_600.0;
const SOFT: std::ops::RangeInclusive<f64> = 4e3..=4e8;

/// MPa beside kg/mm^3, a usual error, looks like a soft material in these.
const LIKE_AN_ERROR: &str = "mm-kg-s";

/// What is so light that it adds no mass looks like a solid in these.
const LIKE_A_DUMMY: &str = "um-kg-s";

impl ConsistentUnits {
    /// The system in which one material of the file is a solid, and in no other: it is that of all. `None` if there are none
    /// or several.
    pub(crate) fn of(materials: &[DeckMaterial]) -> Option<Self> {
        let is_solid = |_: &Self, [young, density]: [f64; 2]| {
            DENSITIES.contains(&density) && STIFFNESSES.contains(&(young / density))
        };
        let is_soft = |units: &Self, [young, density]: [f64; 2]| {
            LIGHT.contains(&density) && SOFT.contains(&(young / density)) && units.name != LIKE_AN_ERROR
        };
        let mut shown = Self::shown(materials, is_solid);
        if shown.is_empty() {
            shown = Self::shown(materials, is_soft);
        }
        if shown.len() > 1 {
            shown.retain(|units| units.name != LIKE_A_DUMMY);
        }
        let [units] = shown[..] else { return None };
        Some(units)
    }

    /// The systems that materials of a kind show, each material one alone.
    fn shown(materials: &[DeckMaterial], is_of_kind: impl Fn(&Self, [f64; 2]) -> bool) -> Vec<Self> {
        let mut shown: Vec<Self> = Vec::new();
        for material in materials {
            let fits = |units: &&Self| {
                units.to_si(material).is_some_and(|[young, _, density]| is_of_kind(units, [young, density]))
            };
            let mut fitting = SYSTEMS.iter().filter(fits);
            if let (Some(found), None) = (fitting.next(), fitting.next())
                && !shown.contains(found)
            {
                shown.push(*found);
            }
        }
        shown
    }

    /// Young's modulus (Pa), Poisson's ratio and density (kg/m^3) of a material that has all three.
    pub(crate) fn to_si(self, material: &DeckMaterial) -> Option<[f64; 3]> {
        let [young, poisson] = material.elastic?;
        let is_solid = young > 0.0 && poisson > -1.0 && poisson < 0.5;
        let density = material.density.filter(|density| is_solid && *density > 0.0)?;
        Some([self.stress * young, poisson, self.density * density])
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
        DeckMaterial {
            name: "m".to_owned(),
            elastic: Some([young, 0.3]),
            density: Some(density),
            ..DeckMaterial::default()
        }
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

    #[test]
    fn one_solid_shows_the_units_of_all() {
        let of = |own: &[[f64; 2]]| {
            ConsistentUnits::of(&own.iter().copied().map(material).collect::<Vec<_>>()).map(|units| units.name)
        };
        let (steel, rubber) = ([210_000.0, 7.85e-9], [1.0, 1.1e-9]);
        for dummy in [rubber, [210_000.0, 1e-14], [1.0, 1e-14], [1e-3, 1e-9]] {
            assert_eq!(of(&[steel, dummy]), Some("mm-t-s"), "{dummy:?}");
            assert_eq!(of(&[dummy, steel]), Some("mm-t-s"), "{dummy:?}");
        }
        assert_eq!(of(&[steel, [70e9, 2700.0]]), None);
        // rubber and wood alone
        for system in SYSTEMS.iter().filter(|system| system.name != "mm-kg-s") {
            for [young, density] in [[5e6, 1100.0], [20e6, 1100.0], [100e6, 1100.0], [11e9, 450.0]] {
                let own = [young / system.stress, density / system.density];
                assert!([None, Some(system.name)].contains(&of(&[own])), "{} {young}", system.name);
                let is_usual = ["m-kg-s", "mm-t-s", "mm-kg-ms"].contains(&system.name);
                assert!(!is_usual || of(&[own]).is_some(), "{} {young}", system.name);
            }
        }
        // MPa beside kg/mm^3
        for error in [[210_000.0, 7.85e-6], [70_000.0, 2.7e-6], [45_000.0, 1.8e-6], [2_500.0, 1.14e-6]] {
            assert_eq!(of(&[error]), None, "{error:?}");
        }
    }
}
