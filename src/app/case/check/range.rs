//! Ranges and relations that many keys share.

use std::ops::RangeBounds;

use super::super::built_in_materials::{BUILT_IN_MATERIALS, built_in_like};
use super::super::error::names_help;
use super::super::{Case, IsotropicMaterial, Material};
use super::rule::{BrokenRule, Rule, short};

/// Numbers that a key takes: in words, and whether one is among them.
pub(super) struct Range(&'static str, fn(f64) -> bool);

pub(super) const ABOVE_ZERO: Range = Range("a number above 0", |x| x > 0.0);
pub(super) const ZERO_OR_MORE: Range = Range("a number not below 0", |x| x >= 0.0);
/// Zero included, one not.
pub(super) const RATIO: Range = Range("a number from 0 to below 1", |x| (0.0..1.0).contains(&x));
/// Neither zero nor one.
pub(super) const FRACTION: Range = Range("a number above 0 and below 1", |x| x > 0.0 && x < 1.0);
/// Zero not, one included.
pub(super) const SHARE: Range = Range("a number above 0, at most 1", |x| x > 0.0 && x <= 1.0);
/// Both included.
pub(super) const ZERO_TO_ONE: Range = Range("a number from 0 to 1", |x| (0.0..=1.0).contains(&x));
/// Zero included, two not.
pub(super) const LOSS_FACTOR: Range = Range("a number from 0 to below 2", |x| (0.0..2.0).contains(&x));
/// Cycles of a wavelet.
pub(super) const CYCLES: Range = Range("a number from 2 to 1000", |x| (2.0..=1000.0).contains(&x));
/// Wide beyond all recorders, and so fast that sound passes 5 um of steel between two samples.
pub(super) const RATE: Range = Range("a rate of at most 1e9 Hz", |x| x <= 1e9);
/// Hunt-Crossley damping c: a slow impact at v keeps 1 - 2/3 c v of its speed (K. H. Hunt and F. R. E. Crossley, 1975), at most
/// nothing already at 1.5 um/s.
pub(super) const CONTACT_DAMPING: Range =
    Range("at most 1e6 s/m, by which no ball rebounds from any impact", |x| x <= 1e6);
/// Below, round-off is larger: the accelerations are differences of contact forces a thousand times and more as large.
pub(super) const TARGET: Range = Range("at least 1e-9, which round-off allows", |x| x >= 1e-9);
/// Further from 0, the shaft's angle loses digits that steps of a run need: 2e-9 s at 1e7 s.
pub(super) const TIME: Range = Range("a time of at most 1e7 s from 0 (let the clock begin near 0)", |x| x.abs() <= 1e7);
/// Of masses, kg. Wide beyond all shafts: further out, squares leave the numbers.
pub(super) const MASS: Range = Range("a mass of at most 1e15 kg", |x| x <= 1e15);
/// As [`MASS`], of forces, accelerations and unbalances.
pub(super) const LOAD: Range = Range("at most 1e15 either way", |x| x.abs() <= 1e15);
/// Along a shaft, m.
pub(super) const PLACE: Range = Range("a place at most 1000 m away (in m)", |x| x.abs() <= 1e3);
/// As [`MASS`], of springs.
pub(super) const STIFFNESS: Range = Range("a stiffness of at most 1e20", |x| x <= 1e20);
/// Beyond, an angle has lost digits or is a number of something else.
pub(super) const DEGREES: Range = Range("an angle from -36000 to 36000 degrees", |x| x.abs() <= 36_000.0);
/// Neither zero nor ninety.
pub(super) const ACUTE: Range = Range("an angle above 0 and below 90 degrees", |x| x > 0.0 && x < 90.0);
pub(super) const POISSON: Range = Range("a number above -1 and below 0.5", |x| x > -1.0 && x < 0.5);
/// Wide beyond all materials: further out, products of matrix entries leave the numbers.
pub(super) const DENSITY: Range = Range("a density from 1e-9 to 1e9 kg/m^3", |x| (1e-9..=1e9).contains(&x));
/// As [`DENSITY`].
pub(super) const MODULUS: Range = Range("a modulus from 1e-6 to 1e18 Pa", |x| (1e-6..=1e18).contains(&x));

impl Range {
    /// What is not given is not refused.
    pub(super) fn check(&self, key: impl Into<String>, found: impl Into<Option<f64>>) -> Result<(), BrokenRule> {
        match found.into() {
            Some(found) => kept((self.1)(found), key, || Rule::found(short(found), self.0)),
            None => Ok(()),
        }
    }
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
    Range("a direction whose largest component is from 1e-150 to 1e150", |x| (1e-150..=1e150).contains(&x))
        .check(key, longest)
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
pub(crate) fn known_material<'c>(case: &'c Case, key: &str, name: &str) -> Result<&'c Material, BrokenRule> {
    case.material(name).ok_or_else(|| {
        let names: Vec<&str> = case.materials.keys().map(String::as_str).collect();
        let mut help = names_help(name, &names, "materials");
        if let Some(near) = built_in_like(name) {
            let meant = |other: &str| help.starts_with(&format!("did you mean `{other}`?"));
            let is_own = |other: &str| BUILT_IN_MATERIALS.iter().all(|known| known.name != other);
            // few letters may part grey iron from ductile iron, and not a name of the case from the same with a misprint
            if !meant(near) && !names.iter().any(|other| is_own(other) && meant(other)) {
                let list = help.split_once("`? ").map_or(help.as_str(), |(_, list)| list);
                help = format!("the nearest that is built in is \"{near}\" (plummer init --list-materials); or give it a table [materials.\"{name}\"]; {list}");
            }
        }
        Rule::new(format!("no material is called \"{name}\"")).with_help(help).at(key)
    })
}

/// A name of one of the case's sensors.
pub(super) fn known_sensor(case: &Case, key: impl Into<String>, name: &str) -> Result<(), BrokenRule> {
    let names: Vec<&str> = case.sensors.iter().map(|sensor| sensor.name.as_str()).collect();
    kept(names.contains(&name), key, || {
        Rule::new(format!("no sensor is called \"{name}\"")).with_help(names_help(name, &names, "sensors"))
    })
}

/// A material that rings and contacts can be made of.
pub(crate) fn known_isotropic<'c>(case: &'c Case, key: &str, name: &str) -> Result<&'c IsotropicMaterial, BrokenRule> {
    match known_material(case, key, name)? {
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
