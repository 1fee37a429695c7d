//! `[[bearings]]`: several bearings in one housing; and the one view of them and of `[ring]` with `[bearing]`.

use super::bearing::named_or_table;
use super::check::{BrokenRule, Rule};
use super::named_bearing::named_or_sections;
use super::{Bearing, Case, Ring};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One of several bearings in a housing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("allOf" = named_or_sections()))]
pub struct SeatedBearing {
    /// What results call it; absent: A, B, C and so on in the order of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Its outer ring, as `[ring]`.
    pub ring: Ring,
    /// Balls, races and contacts, as `[bearing]`; or the name of a bearing of the catalogue.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "named_or_table")]
    pub bearing: Option<Bearing>,
}

/// A ring of a case with its bearing: `[ring]` and `[bearing]`, or an item of `[[bearings]]`.
#[derive(Debug, Clone)]
pub struct Seat<'c> {
    /// What results call it; empty for the only one.
    pub label: String,
    /// The outer ring.
    pub ring: &'c Ring,
    /// Balls, races and contacts.
    pub bearing: Option<&'c Bearing>,
    /// What stands before its keys, `bearings[1].`; nothing for the only one.
    prefix: String,
    /// Its place among all.
    place: usize,
}

impl Seat<'_> {
    /// Full path of one of its keys: `ring.nodes`, or `bearings[1].ring.nodes`.
    #[must_use]
    pub(crate) fn key(&self, key: &str) -> String {
        format!("{}{key}", self.prefix)
    }

    /// A rule that its ring or its bearing breaks, with the full path of the key.
    pub(crate) fn broken(&self, broken: BrokenRule) -> BrokenRule {
        BrokenRule { key: self.key(&broken.key), ..broken }
    }

    /// Whether it is the only one or the first of several.
    pub(crate) fn is_first(&self) -> bool {
        self.place == 0
    }

    /// A sentence about it, which names it where there are several.
    pub(crate) fn told(&self, sentence: String) -> String {
        if self.label.is_empty() { sentence } else { format!("bearing {}: {sentence}", self.label) }
    }
}

impl Case {
    /// Returns every ring of the case with its bearing, in the order of the file; empty for a housing alone.
    #[must_use]
    pub fn seats(&self) -> Vec<Seat<'_>> {
        let one = self.ring.iter().map(|ring| Seat {
            label: String::new(),
            ring,
            bearing: self.bearing.as_ref(),
            prefix: String::new(),
            place: 0,
        });
        let several = self.bearings.iter().enumerate().map(|(index, seated)| Seat {
            label: seated.label.clone().unwrap_or_else(|| letter(index)),
            ring: &seated.ring,
            bearing: seated.bearing.as_ref(),
            prefix: format!("bearings[{index}]."),
            place: index,
        });
        one.chain(several).collect()
    }

    /// The bearings of the case in words: with their rings, or `[bearing]` alone.
    pub(crate) fn all_bearings(&self) -> Vec<(String, &Bearing)> {
        let seats = self.seats().into_iter().filter_map(|seat| Some((seat.label.clone(), seat.bearing?)));
        let alone = self.bearing.iter().filter(|_| !self.has_rings()).map(|bearing| (String::new(), bearing));
        seats.chain(alone).collect()
    }

    /// Whether the case has a ring, or several.
    pub(crate) fn has_rings(&self) -> bool {
        self.ring.is_some() || !self.bearings.is_empty()
    }

    /// `[[bearings]]` stand alone, are several, and have a label each.
    pub(super) fn check_bearings(&self) -> Result<(), BrokenRule> {
        if self.bearings.is_empty() {
            return Ok(());
        }
        for (found, table) in [(self.ring.is_some(), "[ring]"), (self.bearing.is_some(), "[bearing]")] {
            if found {
                let rule = Rule::found(format!("`bearings` beside {table}"), "one of the two");
                let help = "write each ring into its item of [[bearings]], as bearings.ring and bearings.bearing";
                return Err(rule.with_help(help).at("bearings"));
            }
        }
        if self.bearings.len() == 1 {
            let rule = Rule::found("one item", "two or more");
            return Err(rule.with_help("write a single bearing as [ring] and [bearing]").at("bearings"));
        }
        let seats = self.seats();
        for (index, seat) in seats.iter().enumerate() {
            let key = format!("bearings[{index}].label");
            if seat.label.trim().is_empty() || seat.label.chars().any(char::is_control) {
                let found = format!("{:?}", seat.label);
                return Err(Rule::found(found, "a name on one line with visible characters, such as \"A\"").at(key));
            }
            if seats[..index].iter().any(|other| other.label == seat.label) {
                return Err(
                    Rule::found(format!("\"{}\" twice", seat.label), "a label of its own for each bearing").at(key)
                );
            }
        }
        Ok(())
    }
}

/// A, B, C and so on; beyond Z a number.
fn letter(index: usize) -> String {
    let letter = u8::try_from(index).ok().filter(|index| *index < 26).map(|index| char::from(b'A' + index));
    letter.map_or_else(|| (index + 1).to_string(), String::from)
}
