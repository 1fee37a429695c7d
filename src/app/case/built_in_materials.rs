//! Materials that a case may name without giving them, each with its source and how far real ones lie from it.

use super::material::{IsotropicMaterial, Material};

/// A material that is known by name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BuiltInMaterial {
    /// Its name in a case.
    pub name: &'static str,
    /// Its values at 20 °C, without a loss factor.
    pub material: IsotropicMaterial,
    /// How far real ones lie from these values, and by what.
    pub range: &'static str,
    /// Where they are published.
    pub source: &'static str,
}

impl BuiltInMaterial {
    /// The material as a case has it.
    pub(super) fn as_given(&self) -> Material {
        Material::Isotropic(self.material)
    }
}

/// Name, modulus (GPa), Poisson's ratio, density (kg/m^3), range, source.
const fn known(
    name: &'static str,
    [gigapascals, poisson, density]: [f64; 3],
    range: &'static str,
    source: &'static str,
) -> BuiltInMaterial {
    let material = IsotropicMaterial { young: 1e9 * gigapascals, poisson, density, loss_factor: 0.0 };
    BuiltInMaterial { name, material, range, source }
}

/// A table of the same name in the case file takes their place. The sources were read at the makers' and universities' own pages, but for
/// the standards (EN, ASTM), the data sheet of A3EG6 and GMN's of bearing steel, which are cited from memory; brass has the ratio of C36000.
/// Both steels have the modulus at which the source paper's contact stiffness
/// is computed.
pub const BUILT_IN_MATERIALS: [BuiltInMaterial; 13] = [
    known(
        "steel",
        [206.0, 0.3, 7850.0],
        "E 200 to 212 GPa",
        "usual for low-alloy steels; EN 1993-1-1:2005, 3.2.6 has 210 GPa and 0.3; TU Delft, AEASM1x, table 1: AISI 4340 with 205 GPa, 0.29, 7850 kg/m^3",
    ),
    known(
        "bearing steel",
        [206.0, 0.3, 7850.0],
        "E 206 to 212 GPa",
        "usual for 100Cr6; GMN, catalogue 4000 0813 EN (2013), pp. 12-13 has 210 GPa, 0.3 and 7800 kg/m^3",
    ),
    known(
        "1.4301",
        [200.0, 0.3, 7900.0],
        "stainless steel X5CrNi18-10; E 193 to 200 GPa, less after cold work",
        "Woite Edelstahl, data sheet of 1.4301 (as EN 10088-1:2014, annex E); Poisson's ratio: EN 1993-1-4:2006, 2.1.3, 0.28 to 0.29 elsewhere",
    ),
    known(
        "EN-GJL-200",
        [100.0, 0.26, 7150.0],
        "grey iron; a range, E 88 to 113 GPa: it falls with load, and in thick sections",
        "EN 1561:2011, annex A; E is the middle of its range",
    ),
    known(
        "EN-GJL-250",
        [110.0, 0.26, 7200.0],
        "grey iron; a range, E 103 to 118 GPa: it falls with load, and in thick sections",
        "EN 1561:2011, annex A; E is the middle of its range",
    ),
    known(
        "EN-GJS-400-15",
        [169.0, 0.275, 7100.0],
        "ductile iron; E 160 to 175 GPa by shape and share of the graphite",
        "Dandong Foundry, table of EN 1563:1997; SN Castiron has 170 GPa and 0.28",
    ),
    known(
        "aluminium",
        [70.0, 0.33, 2700.0],
        "wrought alloys; E 69 to 72 GPa",
        "EN 1999-1-1:2007, 3.2.5, which takes 0.3 for Poisson's ratio; TU Delft, AEASM1x, table 1, has 0.33 and 70 to 72 GPa",
    ),
    known(
        "cast aluminium",
        [71.0, 0.33, 2710.0],
        "A380, near EN AC-46000 (AlSi9Cu3); E 71 to 76 GPa, more with more silicon, less with pores",
        "NADCA, table A-3-2 (alloy A380); Poisson's ratio: makeitfrom.com, cast aluminium",
    ),
    known(
        "cast magnesium",
        [45.0, 0.35, 1810.0],
        "AZ91D; E 44 to 46 GPa, Poisson's ratio 0.29 to 0.35",
        "Meridian, lightweight alloys (AZ91D); Poisson's ratio: TU Delft, AEASM1x, table 1 (AZ31B)",
    ),
    known(
        "brass",
        [97.0, 0.31, 8470.0],
        "CuZn39Pb3 (CW614N); other brasses 96 to 115 GPa; Poisson's ratio 0.31 to 0.37",
        "E-Z LOK, free-cutting brass C36000: 97 GPa, 0.31, 8490 kg/m^3; density: data sheets of CW614N (EN 12164)",
    ),
    known(
        "POM",
        [2.85, 0.35, 1410.0],
        "copolymer at 23 °C, for short times; E 2.6 to 3.1 GPa, about half at 80 °C",
        "Ticona, data sheet of Hostaform C 9021 (ISO 527, ISO 1183); Poisson's ratio is a usual one",
    ),
    known(
        "PA66-GF30",
        [7.2, 0.35, 1360.0],
        "a range: 7.2 GPa is that along the fibres in air of 50 %, 10 GPa when dry, about half across the fibres",
        "data sheet of Ultramid A3EG6 (ISO 527, ISO 1183); Poisson's ratio is a usual one",
    ),
    known(
        "silicon nitride",
        [310.0, 0.26, 3200.0],
        "balls of hybrid bearings; E 270 to 330 GPa, Poisson's ratio 0.23 to 0.29 (ASTM F2094)",
        "Lily Bearing, ceramic materials: 300 to 315 GPa, 3200 kg/m^3 and more; Poisson's ratio within ASTM F2094",
    ),
];

/// Parts of names, in small letters without what separates words, and the built-in material that is the nearest.
const SAID: [(&[&str], &str); 13] = [
    (&["castalu", "alsi", "alusi", "a380", "adc12"], "cast aluminium"),
    (&["alu", "almg", "6061", "6082", "7075"], "aluminium"),
    (&["gjl200", "gg20"], "EN-GJL-200"),
    (&["gjs", "ggg", "ductileiron", "nodular", "spheroidal"], "EN-GJS-400-15"),
    (&["gjl", "gg25", "gg30", "greyiron", "grayiron", "castiron", "grauguss"], "EN-GJL-250"),
    (&["stainless", "14301", "aisi304", "x5crni"], "1.4301"),
    (&["100cr6", "52100", "bearingsteel"], "bearing steel"),
    (&["steel", "stahl", "42crmo", "16mncr", "c45", "s235", "s355"], "steel"),
    (&["magnesium", "az91"], "cast magnesium"),
    (&["brass", "messing", "cuzn"], "brass"),
    (&["delrin", "acetal"], "POM"),
    (&["gf30"], "PA66-GF30"),
    (&["si3n4", "siliconnitride"], "silicon nitride"),
];

/// The built-in material that is nearest to what a name says in the words of standards and workshops.
pub(in crate::app) fn built_in_like(name: &str) -> Option<&'static str> {
    let plain: String = name.to_lowercase().chars().filter(|letter| letter.is_alphanumeric()).collect();
    let said = SAID.iter().find(|(words, _)| words.iter().any(|word| plain.contains(word)));
    said.map(|(_, material)| *material)
}

#[cfg(test)]
mod tests {
    use super::{BUILT_IN_MATERIALS, SAID, built_in_like};

    #[test]
    fn names_of_standards_and_workshops_have_a_nearest_material() {
        for (name, near) in [
            ("GG25", "EN-GJL-250"),
            ("grey iron", "EN-GJL-250"),
            ("en-gjl-250", "EN-GJL-250"),
            ("GGG40", "EN-GJS-400-15"),
            ("C45", "steel"),
            ("42CrMo4", "steel"),
            ("S355", "steel"),
            ("AlSi10Mg", "cast aluminium"),
            ("100Cr6", "bearing steel"),
        ] {
            assert_eq!(built_in_like(name), Some(near), "{name}");
        }
        assert_eq!(built_in_like("housing"), None);
        assert!(SAID.iter().all(|(_, near)| BUILT_IN_MATERIALS.iter().any(|known| known.name == *near)));
    }

    /// The modulus of steel within its range, and so on: the first two numbers before "GPa".
    #[test]
    fn values_lie_within_their_ranges() {
        for built_in in BUILT_IN_MATERIALS {
            let material = built_in.material;
            if let Some((before, _)) = built_in.range.split_once(" GPa")
                && let Some((_, range)) = before.rsplit_once("E ")
                && let Some((least, most)) = range.split_once(" to ")
            {
                let [least, most] = [least, most].map(|text| text.parse::<f64>().unwrap());
                assert!((least..=most).contains(&(1e-9 * material.young)), "{}", built_in.name);
            }
            // a wave in a bar: plastics 1.4 km/s and more, silicon nitride 9.8
            let speed = (material.young / material.density).sqrt();
            assert!((1e3..1e4).contains(&speed), "{}: {speed}", built_in.name);
            assert!((0.2..0.4).contains(&material.poisson), "{}", built_in.name);
            let twice = BUILT_IN_MATERIALS.iter().filter(|other| other.name.eq_ignore_ascii_case(built_in.name));
            assert_eq!(twice.count(), 1);
            assert!(!built_in.range.is_empty() && !built_in.source.is_empty());
        }
    }
}
