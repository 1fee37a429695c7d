//! Ranges and relations that many keys share.

use std::ops::RangeBounds;

use super::super::nearest::Choices;
use super::super::{Case, IsotropicMaterial, Material};
use super::rule::{BrokenRule, Rule, short};

fn within(holds: bool, key: impl Into<String>, found: f64, expected: &'static str) -> Result<(), BrokenRule> {
    kept(holds, key, || Rule::found(short(found), expected))
}

/// A rule that a key keeps or breaks.
pub(super) fn kept(holds: bool, key: impl Into<String>, rule: impl FnOnce() -> Rule) -> Result<(), BrokenRule> {
    if holds { Ok(()) } else { Err(rule().at(key)) }
}

/// A key that makes sense only with another.
pub(super) fn needs(key: impl Into<String>, other: &'static str, there: bool) -> Result<(), BrokenRule> {
    kept(there, key, || Rule::new(format!("needs {other}, which the case lacks")))
}

/// A key that excludes another.
pub(super) fn not_beside(key: impl Into<String>, other: &'static str, there: bool) -> Result<(), BrokenRule> {
    kept(!there, key, || Rule::found(format!("beside `{other}`"), "one of the two"))
}

pub(super) fn count(
    key: impl Into<String>,
    found: usize,
    range: impl RangeBounds<usize>,
    expected: &'static str,
) -> Result<(), BrokenRule> {
    kept(range.contains(&found), key, || Rule::found(found, expected))
}

/// What is not given is not refused.
pub(super) fn above_zero(key: impl Into<String>, found: impl Into<Option<f64>>) -> Result<(), BrokenRule> {
    match found.into() {
        Some(found) => within(found > 0.0, key, found, "a number above 0"),
        None => Ok(()),
    }
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
    kept(found > other, key, || Rule::beyond(found, &format!("more than {what}"), other))
}

pub(super) fn below(key: impl Into<String>, found: f64, what: &'static str, other: f64) -> Result<(), BrokenRule> {
    kept(found < other, key, || Rule::beyond(found, &format!("below {what}"), other))
}

pub(super) fn direction(key: impl Into<String>, vector: [f64; 3]) -> Result<(), BrokenRule> {
    let longest = vector.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    if longest <= 0.0 {
        return Err(Rule::found("a vector of length zero", "a direction").at(key));
    }
    // beyond, the square of its length is zero or infinite
    let expected = "a direction whose largest component is from 1e-150 to 1e150";
    within((1e-150..=1e150).contains(&longest), key, longest, expected)
}

pub(super) fn not_empty(key: impl Into<String>, length: usize, expected: &'static str) -> Result<(), BrokenRule> {
    kept(length > 0, key, || Rule::found("nothing", expected))
}

/// No name twice; `key` gives the path of the item at a position.
pub(super) fn each_once<'a>(
    names: impl IntoIterator<Item = &'a str>,
    key: impl Fn(usize) -> String,
) -> Result<(), BrokenRule> {
    let mut seen = Vec::new();
    for (index, name) in names.into_iter().enumerate() {
        if seen.contains(&name) {
            return Err(repeated(name).at(key(index)));
        }
        seen.push(name);
    }
    Ok(())
}

pub(super) fn repeated(name: &str) -> Rule {
    Rule::new(format!("\"{name}\" stands here a second time, expected each once"))
}

/// The material of a name.
pub(in crate::app::case) fn known_material<'c>(
    case: &'c Case,
    key: impl Into<String>,
    name: &str,
) -> Result<&'c Material, BrokenRule> {
    case.material(name).ok_or_else(|| {
        let names = Choices::new(name, case.materials.keys().cloned().collect());
        Rule::new(format!("no material is called \"{name}\"")).with_help(names.help("materials")).at(key)
    })
}

/// A name of one of the case's sensors.
pub(super) fn known_sensor(case: &Case, key: impl Into<String>, name: &str) -> Result<(), BrokenRule> {
    let names: Vec<String> = case.sensors.iter().map(|sensor| sensor.name.clone()).collect();
    kept(names.iter().any(|known| known == name), key, || {
        let names = Choices::new(name, names.clone());
        Rule::new(format!("no sensor is called \"{name}\"")).with_help(names.help("sensors"))
    })
}

/// A material that rings and contacts can be made of.
pub(in crate::app::case) fn known_isotropic<'c>(
    case: &'c Case,
    key: impl Into<String>,
    name: &str,
) -> Result<&'c IsotropicMaterial, BrokenRule> {
    let key = key.into();
    match known_material(case, key.as_str(), name)? {
        Material::Isotropic(material) if material.loss_factor > 0.0 => Err(Rule::new(format!(
            "\"{name}\" has a loss factor, expected a material without: structural damping is for parts of the housing"
        ))
        .with_help("give this part a material of its own name, without `loss_factor`")
        .at(key)),
        Material::Isotropic(material) => Ok(material),
        Material::Orthotropic(_) => Err(Rule::new(format!(
            "\"{name}\" is orthotropic, expected an isotropic material: rings and contacts have no other"
        ))
        .at(key)),
    }
}
