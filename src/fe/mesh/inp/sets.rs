//! Sets of nodes and elements by their names.

use super::MshError;
use super::block::{Block, capitals, items};
use super::deck::Deck;
use super::numbers::{Numbers, number};
use crate::fe::mesh::gmsh::{Allowance, quoted};
use std::collections::HashMap;

/// A set of nodes or elements.
pub(super) struct Set {
    /// As it is written first.
    pub(super) name: String,
    /// Abaqus/CAE made it for itself.
    pub(super) internal: bool,
    /// Indices, sorted and each once when all are read.
    pub(super) members: Vec<u32>,
}

/// Sets of nodes, or of elements. An assembly and its part each have names of their own.
#[derive(Default)]
pub(super) struct Sets {
    pub(super) list: Vec<Set>,
    by_name: HashMap<(bool, String), usize>,
}

impl Sets {
    /// Index of the set of a name, a new one if there is none.
    pub(super) fn named(&mut self, name: &str, in_assembly: bool) -> usize {
        let next = self.list.len();
        let found = *self.by_name.entry((in_assembly, capitals(name.as_bytes()))).or_insert(next);
        if found == next {
            self.list.push(Set { name: name.to_owned(), internal: false, members: Vec::new() });
        }
        found
    }

    /// Index of the set that an item names: `instance.name` is one of the part.
    pub(super) fn find(&self, name: &[u8], in_assembly: bool, deck: &Deck<'_>) -> Option<usize> {
        let name = capitals(name);
        let known = |in_assembly, name: &str| self.by_name.get(&(in_assembly, name.to_owned())).copied();
        match of_part(&name, deck) {
            Some(name) => known(false, name),
            None => known(in_assembly, &name).or_else(|| known(false, &name)),
        }
    }

    pub(super) fn sort(&mut self) {
        for set in &mut self.list {
            set.members.sort_unstable();
            set.members.dedup();
        }
    }

    /// Adds what an `*NSET` or `*ELSET` lists, of the items that are called `what`.
    pub(super) fn add(
        &mut self,
        block: &Block<'_>,
        deck: &Deck<'_>,
        (numbers, what): (&Numbers, &'static str),
        allowance: &mut Allowance,
    ) -> Result<(), MshError> {
        let keyword = block.keyword();
        let name = block.required(&keyword)?;
        let in_assembly = deck.is_in_assembly(block);
        // its plain numbers are those of reference points
        let of_points = in_assembly && block.parameter("INSTANCE").is_none();
        let own = self.named(&name, in_assembly);
        self.list[own].internal |= block.parameter("INTERNAL").is_some();
        let generate = block.parameter("GENERATE").is_some();
        for (line, text) in block.lines() {
            let mut members = Vec::new();
            if generate {
                let words = items(text).filter(|word| !word.is_empty());
                let range = words.map(|word| number(block, line, what, word)).collect::<Result<Vec<_>, _>>()?;
                let (first, last, step) = match *range.as_slice() {
                    [first, last] if first <= last => (first, last, 1),
                    [first, last, step] if first <= last => (first, last, step),
                    _ => {
                        let found = quoted(text);
                        return Err(block.fault(line, format_args!("expected first, last and step, found {found}")));
                    }
                };
                members = if of_points { members } else { numbers.between(first, last, step) };
            } else {
                for word in items(text).filter(|word| !word.is_empty()) {
                    if let Some(set) = self.find(word, in_assembly, deck) {
                        allowance.take(self.list[set].members.len())?;
                        members.extend_from_slice(&self.list[set].members);
                        continue;
                    }
                    let upper = capitals(word);
                    let of_part = of_part(&upper, deck);
                    let digits = of_part.unwrap_or(&upper);
                    if !digits.starts_with(|c: char| c.is_ascii_digit()) {
                        let found = quoted(word);
                        return Err(block.fault(
                            line,
                            format_args!("expected {what} or the name of a set that stands before, found {found}"),
                        ));
                    }
                    let tag = number(block, line, what, digits.as_bytes())?;
                    if of_part.is_none() && of_points {
                        continue;
                    }
                    let index = numbers.get(tag).ok_or_else(|| {
                        block.fault(
                            line,
                            format_args!(
                                "the set {} has {tag}: expected {what} that the file lists",
                                quoted(name.as_bytes())
                            ),
                        )
                    })?;
                    members.push(index as u32);
                }
            }
            allowance.take(if generate { members.len() } else { 0 })?;
            self.list[own].members.extend(members);
        }
        Ok(())
    }
}

/// What follows `instance.`; both in capitals.
fn of_part<'n>(name: &'n str, deck: &Deck<'_>) -> Option<&'n str> {
    name.strip_prefix(deck.instance.as_ref()?)?.strip_prefix('.')
}
