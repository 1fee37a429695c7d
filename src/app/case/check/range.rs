//! Ranges that many keys share.

use super::super::nearest::Choices;
use super::super::{Case, IsotropicMaterial, Material};
use super::rule::{BrokenRule, Rule};

fn within(holds: bool, key: impl Into<String>, found: f64, expected: &'static str) -> Result<(), BrokenRule> {
    if holds { Ok(()) } else { Err(Rule::Range { found, expected }.at(key)) }
}

pub(super) fn above_zero(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within(found > 0.0, key, found, "a number above 0")
}

/// Wide beyond all materials: further out, products of matrix entries leave the numbers.
pub(super) fn density(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    let key = key.into();
    above_zero(key.as_str(), found)?;
    let expected = "a density from 1e-9 to 1e9 kg/m^3";
    within((1e-9..=1e9).contains(&found), key, found, expected)
}

/// As [`density`].
pub(super) fn modulus(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    let key = key.into();
    above_zero(key.as_str(), found)?;
    let expected = "a modulus from 1e-6 to 1e18 Pa";
    within((1e-6..=1e18).contains(&found), key, found, expected)
}

pub(super) fn zero_or_more(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within(found >= 0.0, key, found, "a number not below 0")
}

/// Zero included, one not.
pub(super) fn ratio(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within((0.0..1.0).contains(&found), key, found, "a number from 0 to below 1")
}

/// Neither zero nor one.
pub(super) fn fraction(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within(found > 0.0 && found < 1.0, key, found, "a number above 0 and below 1")
}

/// Zero not, one included.
pub(super) fn share(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within(found > 0.0 && found <= 1.0, key, found, "a number above 0, at most 1")
}

/// Both included.
pub(super) fn zero_to_one(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within((0.0..=1.0).contains(&found), key, found, "a number from 0 to 1")
}

/// Zero included, two not.
pub(super) fn loss_factor(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within((0.0..2.0).contains(&found), key, found, "a number from 0 to below 2")
}

/// Cycles of a wavelet.
pub(super) fn cycles(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within((2.0..=1000.0).contains(&found), key, found, "a number from 2 to 1000")
}

/// Beyond, an angle has lost digits or is a number of something else.
pub(super) fn degrees(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    let expected = "an angle from -36000 to 36000 degrees";
    within(found.abs() <= 36_000.0, key, found, expected)
}

pub(super) fn poisson(key: impl Into<String>, found: f64) -> Result<(), BrokenRule> {
    within(found > -1.0 && found < 0.5, key, found, "a number above -1 and below 0.5")
}

pub(super) fn above(key: impl Into<String>, found: f64, what: &'static str, other: f64) -> Result<(), BrokenRule> {
    if found > other { Ok(()) } else { Err(Rule::NotAbove { found, what, other }.at(key)) }
}

pub(super) fn below(key: impl Into<String>, found: f64, what: &'static str, other: f64) -> Result<(), BrokenRule> {
    if found < other {
        Ok(())
    } else {
        let how = "below";
        Err(Rule::Beyond { found, how, what, other }.at(key))
    }
}

pub(super) fn direction(key: impl Into<String>, vector: [f64; 3]) -> Result<(), BrokenRule> {
    let longest = vector.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    if longest <= 0.0 {
        return Err(Rule::NoDirection.at(key));
    }
    // beyond, the square of its length is zero or infinite
    let expected = "a direction whose largest component is from 1e-150 to 1e150";
    within((1e-150..=1e150).contains(&longest), key, longest, expected)
}

pub(super) fn not_empty(key: impl Into<String>, length: usize, expected: &'static str) -> Result<(), BrokenRule> {
    if length > 0 { Ok(()) } else { Err(Rule::Empty { expected }.at(key)) }
}

/// No name twice; `key` gives the path of the item at a position.
pub(super) fn each_once<'a>(
    names: impl IntoIterator<Item = &'a str>,
    key: impl Fn(usize) -> String,
) -> Result<(), BrokenRule> {
    let mut seen = Vec::new();
    for (index, name) in names.into_iter().enumerate() {
        if seen.contains(&name) {
            let name = name.to_owned();
            return Err(Rule::Repeated { name }.at(key(index)));
        }
        seen.push(name);
    }
    Ok(())
}

/// The material of a name.
pub(in crate::app::case) fn known_material<'c>(
    case: &'c Case,
    key: impl Into<String>,
    name: &str,
) -> Result<&'c Material, BrokenRule> {
    case.material(name).ok_or_else(|| {
        Rule::UnknownMaterial {
            found: name.to_owned(),
            names: Box::new(Choices::new(name, case.materials.keys().cloned().collect())),
        }
        .at(key)
    })
}

/// A name of one of the case's sensors.
pub(super) fn known_sensor(case: &Case, key: impl Into<String>, name: &str) -> Result<(), BrokenRule> {
    let names = case.sensors.iter().map(|sensor| sensor.name.clone());
    let names: Vec<String> = names.collect();
    if names.iter().any(|known| known == name) {
        return Ok(());
    }
    Err(Rule::UnknownSensor { found: name.to_owned(), names: Box::new(Choices::new(name, names)) }.at(key))
}

/// A material that rings and contacts can be made of.
pub(in crate::app::case) fn known_isotropic<'c>(
    case: &'c Case,
    key: impl Into<String>,
    name: &str,
) -> Result<&'c IsotropicMaterial, BrokenRule> {
    let key = key.into();
    match known_material(case, key.as_str(), name)? {
        Material::Isotropic(material) if material.loss_factor > 0.0 => {
            let found = name.to_owned();
            Err(Rule::LossFactor { found }.at(key))
        }
        Material::Isotropic(material) => Ok(material),
        Material::Orthotropic(_) => {
            let found = name.to_owned();
            Err(Rule::NotIsotropic { found }.at(key))
        }
    }
}
