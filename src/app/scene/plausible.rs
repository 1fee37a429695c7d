//! Whether materials, housing and shaft are as those of machines are, a sentence each where they are not.
//!
//! A value in another unit is off by a power of ten at least. So limits are wide: no solid, housing or bearing that is made is beyond
//! them, and the sentence says which unit the value looks like.

use super::ring::metres;
use crate::app::case::{self, Case, short};
use crate::bearing::RaceContacts;
use crate::bearing::life::STATIC_PRESSURE;
use crate::fe::element::continuum::measure;
use crate::fe::mesh::BoundingBox;
use crate::fe::model::HousingModel;
use crate::numerics::Brief;
use crate::numerics::units::LengthUnit;
use crate::report::{mass_in_words, significant, size_in_words};
use crate::system::BearingSetup;

/// Bar speeds of sound of solids, `sqrt(E / rho)`, m/s: soft rubber has 30, steel 5200, diamond 18 000 (M. F. Ashby, *Materials
/// Selection in Mechanical Design*, 4th edition, 2011, the chart of modulus and density).
const SPEEDS_OF_SOUND: [f64; 2] = [10.0, 20_000.0];

/// Densities of solids, kg/m^3: from foams to osmium (22 590).
const DENSITIES: [f64; 2] = [5.0, 23_000.0];

/// Density (kg/m^3) above that of every rubber and foam, and the least speed of sound there, m/s: PTFE has 470, lead 1190 (Ashby).
const HEAVY: [f64; 2] = [2300.0, 300.0];

/// Density of the lightest metals that housings are made of, kg/m^3: magnesium has 1740.
const METALS_FROM: f64 = 1500.0;

/// Highest modulus of a solid, Pa: diamond has 1.22e12.
const STIFFEST: f64 = 1.3e12;

/// Moduli (Pa), densities (kg/m^3) and speeds of sound (m/s) of what machines are made of, by which a unit is guessed: from
/// polyethylene to tungsten carbide.
const USUAL: [[f64; 2]; 3] = [[0.2e9, 700e9], [850.0, 20_000.0], [400.0, 13_500.0]];

/// Speed of sound of steel, iron, aluminium, magnesium and titanium, m/s, within 15 %.
const METAL: f64 = 5000.0;

/// Units of modulus and density that tables and other programs have, in Pa and kg/m^3.
const MODULUS_UNITS: [(&str, f64); 4] = [("GPa", 1e9), ("MPa", 1e6), ("psi", 6894.757), ("ksi", 6.894_757e6)];
const DENSITY_UNITS: [(&str, f64); 4] = [("t/mm^3", 1e12), ("g/cm^3", 1e3), ("kg/mm^3", 1e9), ("lb/in^3", 27_679.9)];

/// Longest sides of housings of rolling bearings, m: the smallest ball bearings have an outer diameter of 1.5 mm, the largest
/// bearings, of tunnel boring machines, one of 8 m.
const SIDES: [f64; 2] = [1.5e-3, 16.0];

/// Longest side of a usual housing, m, by which a unit is guessed.
const USUAL_SIDES: [f64; 2] = [0.01, 5.0];

/// Masses of housings, kg: that of a millimetre's cube of plastic, and of the largest ship's engines.
const MASSES: [f64; 2] = [1e-6, 3e6];

/// Thickness of a plane housing over its longest side that is told.
const THICK: f64 = 5.0;

/// Highest speed of ball bearings, mean diameter (mm) times revolutions a minute: those of aircraft engines reach 3e6 (E. V. Zaretsky,
/// *Tribology for Aerospace Applications*, 1997).
const SPEED: f64 = 4e6;

/// Largest ball's share of a radial load, over that of all balls alike (R. Stribeck 1907; Harris, *Rolling Bearing Analysis*, 4th
/// edition, chapter 7).
const STRIBECK: f64 = 5.0;

/// How many times a given contact stiffness may be above or below that by Hertz.
const STIFFNESS: f64 = 100.0;

/// Stiffest modulus over the softest that is told where an equation fails: soft rubber and steel have 2e5.
const CONTRAST: f64 = 1e6;

fn within([low, high]: [f64; 2], value: f64) -> bool {
    (low..=high).contains(&value)
}

/// Materials that no solid is.
pub(super) fn materials(case: &Case) -> Vec<String> {
    let told = case.materials.iter().filter_map(|(name, material)| {
        let density = material.density();
        let [least, most] = moduli(material);
        if is_solid([least, most], density) {
            return None;
        }
        let help = unit_of_material(least, density).unwrap_or_else(|| "check the units (Pa and kg/m^3, with meshes in mm too)".to_owned());
        Some(format!(
            "materials.{name}: young = {} Pa and density = {} kg/m^3 give a speed of sound of {} m/s, and no solid has these; steel has 2.1e11 Pa, 7850 kg/m^3 and 5.2e3 m/s: {help}",
            short(least),
            short(density),
            exponent((least / density).sqrt())
        ))
    });
    told.collect()
}

/// Least and largest Young's modulus, Pa.
fn moduli(material: &case::Material) -> [f64; 2] {
    match material {
        case::Material::Isotropic(material) => [material.young; 2],
        case::Material::Orthotropic(material) => {
            let along = material.young.iter();
            along.fold([f64::INFINITY, 0.0], |[least, most], young| [young.min(least), young.max(most)])
        }
    }
}

/// What to do about parts of which one is so much stiffer than another that its round-off hides the other's stiffness.
pub(crate) fn contrast(case: &Case) -> Option<String> {
    let parts = case.meshed_housing()?.parts.iter();
    let parts: Vec<_> = parts.filter_map(|part| Some((part, moduli(case.material(&part.material)?)))).collect();
    let (soft, [least, _]) = parts.iter().min_by(|a, b| a.1[0].total_cmp(&b.1[0]))?;
    let (stiff, [_, most]) = parts.iter().max_by(|a, b| a.1[1].total_cmp(&b.1[1]))?;
    (most / least > CONTRAST).then(|| {
        format!(
            "part \"{}\" ({}, young = {} Pa) is {} times softer than part \"{}\" ({}, young = {} Pa): check both in Pa, or leave the soft part out of housing.parts and put springs in its place (housing.links)",
            soft.group,
            soft.material,
            short(*least),
            Brief::rounded(most / least, 2),
            stiff.group,
            stiff.material,
            short(*most)
        )
    })
}

/// Whether there may be a solid with moduli from `least` to `most` (Pa) and this density (kg/m^3).
fn is_solid([least, most]: [f64; 2], density: f64) -> bool {
    let speeds = [least, most].map(|young| (young / density).sqrt());
    let soft_for_its_weight = density > HEAVY[0] && speeds[0] < HEAVY[1];
    let known = within(DENSITIES, density) && speeds.iter().all(|&speed| within(SPEEDS_OF_SOUND, speed));
    known && !soft_for_its_weight && most <= STIFFEST
}

/// Three digits, plain between 1 and 10 000.
fn exponent(value: f64) -> String {
    let digits = format!("{value:.2e}");
    match within([1.0, 1e4], value) {
        true => short(digits.parse().unwrap_or(value)),
        false => digits,
    }
}

/// Which unit a modulus or a density that no solid has looks like, and what to write: the one that makes a metal's speed of sound
/// where the density is a metal's, else the first that makes a usual solid.
fn unit_of_material(young: f64, density: f64) -> Option<String> {
    let units = |list: [(&'static str, f64); 4]| std::iter::once(("", 1.0)).chain(list);
    let pairs = units(MODULUS_UNITS).flat_map(|modulus| units(DENSITY_UNITS).map(move |density| (modulus, density)));
    let usual = pairs.filter_map(|(modulus, heavy)| {
        let (young, density) = (young * modulus.1, density * heavy.1);
        let speed = (young / density).sqrt();
        let fits = [young, density, speed].into_iter().zip(USUAL).all(|(value, range)| within(range, value));
        let off = if density > METALS_FROM { (speed / METAL).ln().abs() } else { 0.0 };
        let changed = usize::from(!modulus.0.is_empty()) + usize::from(!heavy.0.is_empty());
        fits.then_some(((modulus.0, young), (heavy.0, density), changed, off))
    });
    let least = usual.min_by(|a, b| a.2.cmp(&b.2).then(a.3.total_cmp(&b.3)))?;
    let ((modulus, new_young), (heavy, new_density), ..) = least;
    let words = [(modulus, young, new_young), (heavy, density, new_density)].into_iter();
    let words = words.filter(|(unit, ..)| !unit.is_empty());
    let words = words.map(|(unit, typed, new)| {
        let new: f64 = format!("{new:.4e}").parse().unwrap_or(new);
        format!("{} looks like {unit}: write {}", short(typed), short(new))
    });
    Some(words.collect::<Vec<_>>().join("; "))
}

/// A housing that is larger, smaller, thicker, heavier or lighter than any.
pub(super) fn housing(case: &Case, model: &HousingModel) -> Vec<String> {
    let Some(asked) = case.meshed_housing() else {
        return Vec::new();
    };
    let used = model.coordinates().iter().zip(&model.used).filter(|(_, used)| **used);
    let sides = BoundingBox::of(used.map(|(point, _)| *point)).extent();
    if let Some(told) = size_doubt(sides, asked.length_unit, "housing.length_unit =") {
        return vec![told];
    }
    let longest = sides.into_iter().fold(0.0, f64::max);
    if let Some(thickness) = asked.plane.map(|plane| plane.thickness).filter(|&thickness| thickness > THICK * longest) {
        return vec![format!(
            "housing.plane.thickness is {} and the housing is {} large: no housing is as long along its bearing's axis; check that the thickness is in m",
            metres(thickness),
            size_in_words(sides)
        )];
    }
    let mass = mass_of(case, asked, model);
    // materials that no solid is are told by themselves
    let doubt = mass_doubt(sides, asked.length_unit, mass).filter(|_| materials(case).is_empty());
    doubt.into_iter().collect()
}

/// That a housing with sides of these lengths (m) by its unit is heavier or lighter than any, kg. Few sizes and densities are, so that the
/// unit is to be checked too.
fn mass_doubt(sides: [f64; 3], unit: LengthUnit, mass: f64) -> Option<String> {
    if within(MASSES, mass) || mass <= 0.0 {
        return None;
    }
    Some(format!(
        "the housing is {} by housing.length_unit = \"{}\" and has a mass of {}: none of a rolling bearing is as {}; check the unit and the densities of its materials (kg/m^3)",
        size_in_words(sides),
        unit.symbol(),
        mass_in_words(mass, 3),
        if mass > MASSES[1] { "heavy" } else { "light" }
    ))
}

/// That a mesh with sides of these lengths (m) by its unit is larger or smaller than any housing of a bearing, and which unit it looks
/// like; `key` is what says the unit.
pub(crate) fn size_doubt(sides: [f64; 3], unit: LengthUnit, key: &str) -> Option<String> {
    let longest = sides.into_iter().fold(0.0, f64::max);
    if within(SIDES, longest) {
        return None;
    }
    let other = |other: &LengthUnit| within(USUAL_SIDES, longest / unit.to_metres() * other.to_metres());
    let likely = [LengthUnit::Millimetre, LengthUnit::Metre, LengthUnit::Inch, LengthUnit::Centimetre];
    let help = match likely.iter().find(|unit| other(unit)) {
        Some(other) => {
            let scale = other.to_metres() / unit.to_metres();
            format!(
                "its mesh looks like one in {}: write {key} \"{}\" ({})",
                other.symbol(),
                other.symbol(),
                size_in_words(sides.map(|side| scale * side))
            )
        }
        None => format!("check the mesh and {key} \"{}\"", unit.symbol()),
    };
    let (how, why) = match longest > SIDES[1] {
        true => ("large", "the largest rolling bearings are 8 m across"),
        false => ("small", "the smallest ball bearings are 1.5 mm across"),
    };
    Some(format!(
        "the housing is {} by {key} \"{}\": none is as {how} ({why}); {help}",
        size_in_words(sides),
        unit.symbol()
    ))
}

/// Mass of the elements, kg; those without a valid shape are left out.
fn mass_of(case: &Case, asked: &case::Housing, model: &HousingModel) -> f64 {
    let thickness = asked.plane.map_or(1.0, |plane| plane.thickness);
    let density = |part: &case::Part| case.material(&part.material).map_or(0.0, case::Material::density);
    let densities: Vec<f64> = asked.parts.iter().map(density).collect();
    let elements = model.elements();
    let mass = elements.iter().map(|element| {
        let nodes = elements.nodes(element).iter();
        let at: Vec<[f64; 3]> = nodes.map(|&node| model.coordinates()[node]).collect();
        densities[element.part] * thickness * measure(element.kind, &at).unwrap_or(0.0)
    });
    mass.sum()
}

/// A shaft that is lighter than the balls, farther off balance than its race or faster than any.
pub(super) fn shaft(case: &Case) -> Vec<String> {
    let mut found = Vec::new();
    let bearings: Vec<&case::Bearing> = case.seats().iter().filter_map(|seat| seat.bearing).collect();
    let (Some(shaft), [first, ..]) = (&case.shaft, &bearings[..]) else {
        return found;
    };
    let mass = |bearing: &&case::Bearing| bearing.balls as f64 * case.mass_of_ball(bearing).unwrap_or(0.0);
    let balls = bearings.iter().map(mass).sum();
    if shaft.mass < balls {
        found.push(format!(
            "shaft.mass is {} and the {} balls have {} together: the inner ring alone has more; check that it is in kg, with all that the shaft carries on {}",
            mass_in_words(shaft.mass, 3),
            bearings.iter().map(|bearing| bearing.balls).sum::<usize>(),
            mass_in_words(balls, 3),
            if bearings.len() > 1 { "its bearings" } else { "this bearing" }
        ));
    }
    let off = shaft.unbalance / shaft.mass;
    if off > first.inner_race_radius {
        found.push(format!(
            "shaft.unbalance is {} kg m and puts the centre of a shaft of {} off its axis by {}, beyond bearing.inner_race_radius: check that it is in kg m (1 g mm is 1e-6)",
            short(shaft.unbalance),
            mass_in_words(shaft.mass, 3),
            metres(off)
        ));
    }
    let fastest =
        case.speed.iter().flat_map(|speed| &speed.profile).map(|knot| knot.frequency_hz.abs()).fold(0.0, f64::max);
    let pitches = bearings.iter().map(|bearing| bearing.inner_race_radius + bearing.outer_race_radius);
    let pitch = pitches.fold(0.0, f64::max);
    if 1e3 * pitch * 60.0 * fastest > SPEED {
        found.push(format!(
            "speed.profile reaches {} Hz ({} rpm): no ball bearing of {} mean diameter runs as fast; check which of `hz` and `rpm` is meant",
            Brief(fastest),
            Brief::rounded(60.0 * fastest, 4),
            metres(pitch)
        ));
    }
    found
}

/// A given contact stiffness far from that by Hertz, and loads of a later time that leave dents in the races.
pub(super) fn contacts(case: &Case, setup: &BearingSetup, hertz: &RaceContacts) -> Vec<String> {
    let mut found = Vec::new();
    let by_hertz = hertz.stiffness();
    for (race, given, own) in
        [("inner", setup.stiffness.inner(), by_hertz.inner()), ("outer", setup.stiffness.outer(), by_hertz.outer())]
    {
        if !within([1.0 / STIFFNESS, STIFFNESS], given / own) {
            found.push(format!(
                "bearing.stiffness.{race} is {} N/m^(3/2), and Hertz's theory gives {} for these balls and races: check that it is in N/m^(3/2) (1 N/mm^(3/2) is 3.16e4)",
                short(given),
                Brief::rounded(own, 4)
            ));
        }
    }
    let loads = case.shaft.iter().flat_map(|shaft| &shaft.loads);
    let later = loads.filter_map(|load| match load.in_space().1.as_slice() {
        [_] => None,
        points => Some(points.iter().map(|(_, [x, y, ..])| x.hypot(*y)).fold(0.0, f64::max)),
    });
    let load: f64 = later.sum();
    let force = STRIBECK * load / f64::from(setup.geometry.balls());
    let pressure = hertz.inner.patch(force).peak_pressure;
    if by_hertz == setup.stiffness && pressure > STATIC_PRESSURE {
        found.push(format!(
            "shaft.loads reaches {} N, under which the most loaded ball bears about {} N with a pressure of {:.0} MPa at the inner race, above the {:.0} MPa of the static load rating (ISO 76): check that the loads are in N",
            short(load),
            significant(force, 3),
            1e-6 * pressure,
            1e-6 * STATIC_PRESSURE
        ));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{is_solid, mass_doubt, size_doubt, unit_of_material};
    use crate::numerics::units::LengthUnit;

    /// A plate of aluminium; its mass is right.
    #[test]
    fn a_light_housing_may_be_in_another_unit() {
        let sides = [2e-3, 2e-3, 0.1e-3];
        let told = mass_doubt(sides, LengthUnit::Millimetre, 8.27e-7).unwrap();
        let (unit, densities) = (told.find("housing.length_unit = \"mm\""), told.find("densities"));
        assert!(unit.is_some() && unit < densities && told.contains("is as light"), "{told}");
        assert_eq!(mass_doubt(sides, LengthUnit::Millimetre, 1.1e-6), None);
    }

    /// Young's modulus in GPa and density in kg/m^3 (Ashby, tables A.3 and A.7, rounded).
    #[test]
    fn what_machines_are_made_of_is_a_solid_and_in_another_unit_is_none() {
        for (what, young, density) in [
            ("steel", 210.0, 7850.0),
            ("grey cast iron", 100.0, 7200.0),
            ("nodular cast iron", 170.0, 7100.0),
            ("aluminium", 70.0, 2700.0),
            ("magnesium", 45.0, 1740.0),
            ("titanium", 110.0, 4500.0),
            ("copper", 120.0, 8960.0),
            ("lead", 16.0, 11_340.0),
            ("gold", 79.0, 19_300.0),
            ("zinc", 95.0, 7140.0),
            ("tungsten carbide", 650.0, 15_600.0),
            ("alumina", 380.0, 3950.0),
            ("silicon nitride", 310.0, 3200.0),
            ("zirconia", 210.0, 6050.0),
            ("glass", 70.0, 2500.0),
            ("concrete", 30.0, 2400.0),
            ("polyamide with glass", 10.0, 1370.0),
            ("PEEK", 3.6, 1320.0),
            ("POM", 2.8, 1410.0),
            ("PTFE", 0.5, 2200.0),
            ("polyethylene", 0.2, 920.0),
            ("carbon fibres", 140.0, 1600.0),
            ("rubber", 0.005, 1150.0),
            ("foam", 0.03, 100.0),
            ("diamond", 1220.0, 3520.0),
        ] {
            let gigapascals = |young: f64, density: f64| is_solid([1e9 * young, 1e9 * young], density);
            assert!(gigapascals(young, density), "{what}");
            // psi
            assert!(density < 2300.0 || !is_solid([1e9 * young / 6894.757; 2], density), "{what}");
            // GPa, MPa, t/mm^3, both, g/cm^3
            for (modulus, heavy) in [(1e-9, 1.0), (1e-6, 1.0), (1.0, 1e-12), (1e-6, 1e-12), (1.0, 1e-3)] {
                assert!(!gigapascals(young * modulus, density * heavy), "{what} {modulus} {heavy}");
            }
        }
    }

    #[test]
    fn units_are_told_by_what_they_make() {
        for (young, density, words) in [
            (206e3, 7.85e-9, "206000 looks like MPa: write 2.06e11; 7.85e-9 looks like t/mm^3: write 7850"),
            (210e3, 7850.0, "210000 looks like MPa: write 2.1e11"),
            (210.0, 7850.0, "210 looks like GPa: write 2.1e11"),
            (70e9, 2.7, "2.7 looks like g/cm^3: write 2700"),
            (30e6, 7850.0, "3e7 looks like psi: write 2.0684e11"),
            (10e6, 2700.0, "1e7 looks like psi: write 6.8948e10"),
            (2500.0, 1100.0, "2500 looks like MPa: write 2.5e9"),
            (2.5, 1100.0, "2.5 looks like GPa: write 2.5e9"),
            (110e3, 7.2e-9, "110000 looks like MPa: write 1.1e11; 7.2e-9 looks like t/mm^3: write 7200"),
        ] {
            assert_eq!(unit_of_material(young, density).as_deref(), Some(words));
        }
        assert_eq!(unit_of_material(1e-6, 1.0), None);
    }

    #[test]
    fn lengths_are_told_by_the_size_of_bearings() {
        let sides = [120.0, 80.0, 30.0];
        let told = size_doubt(sides, LengthUnit::Metre, "housing.length_unit =").unwrap();
        assert_eq!(
            told,
            "the housing is 120 x 80 x 30 m by housing.length_unit = \"m\": none is as large (the largest rolling bearings are 8 m across); its mesh looks like one in mm: write housing.length_unit = \"mm\" (120 x 80 x 30 mm)"
        );
        let told = size_doubt([1.2e-4, 8e-5, 3e-5], LengthUnit::Millimetre, "--length-unit").unwrap();
        assert!(
            told.contains("120 x 80 x 30 µm") && told.contains("write --length-unit \"m\" (120 x 80 x 30 mm)"),
            "{told}"
        );
        assert_eq!(size_doubt([10.0, 10.0, 1.0], LengthUnit::Metre, ""), None);
        assert_eq!(size_doubt([3e-3, 3e-3, 1e-3], LengthUnit::Millimetre, ""), None);
    }
}
