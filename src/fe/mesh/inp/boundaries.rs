//! What `*BOUNDARY` holds: no part of the mesh, but supports of the case that is made from it.
//!
//! Source: CalculiX CrunchiX user's manual 2.20, "*BOUNDARY" and "*TRANSFORM"; Abaqus names the same ones alike.

use super::block::{Block, capitals, items};
use super::deck::Deck;
use super::numbers::coordinate;
use super::read::Bodies;
use crate::fe::mesh::{DeckSupport, Mesh, PhysicalGroup};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Words for directions that are held, in Abaqus.
const WORDS: [(&str, [bool; 3]); 8] = [
    ("ENCASTRE", [true; 3]),
    ("PINNED", [true; 3]),
    ("XSYMM", [true, false, false]),
    ("YSYMM", [false, true, false]),
    ("ZSYMM", [false, false, true]),
    ("XASYMM", [false, true, true]),
    ("YASYMM", [true, false, true]),
    ("ZASYMM", [true, true, false]),
];

/// Parameters of a `*BOUNDARY` that holds nothing at rest, or not what its lines say.
const MOVING: [&str; 6] = ["BASEMOTION", "LOADCASE", "MASSFLOW", "SUBMODEL", "TYPE", "USER"];

/// A set that boundaries name: its nodes, and what of them is held.
struct Held {
    nodes: Vec<usize>,
    fixed: [bool; 3],
}

/// What stands in axes of its own, which a line of `*BOUNDARY` does not show.
#[derive(Default)]
struct Turned {
    nodes: Vec<bool>,
    /// Sets that have such nodes.
    sets: Vec<bool>,
}

impl Turned {
    fn read(deck: &Deck<'_>, bodies: &Bodies, counted: usize) -> Self {
        let sets = &bodies.node_sets;
        let blocks = deck.of("TRANSFORM").filter(|block| block.step <= counted);
        let named =
            |block: &Block<'_>| sets.find(block.parameter("NSET")?.as_bytes(), deck.is_in_assembly(block), deck);
        let named: BTreeSet<Option<usize>> = blocks.map(named).collect();
        // a set that the file does not have may be of any nodes
        let mut nodes = vec![named.contains(&None); bodies.nodes.len()];
        let of_sets = named.iter().flatten().flat_map(|&set| &sets.list[set].members);
        of_sets.for_each(|&node| nodes[node as usize] = true);
        let has_turned = |members: &[u32]| !named.is_empty() && members.iter().any(|&node| nodes[node as usize]);
        let sets = sets.list.iter().map(|set| has_turned(&set.members)).collect();
        Self { nodes, sets }
    }
}

/// What the file holds, before it has groups.
#[derive(Default)]
pub(super) struct Boundaries {
    /// By the set's name and index.
    held: BTreeMap<(String, usize), Held>,
    turned: Turned,
    /// Nodes that are held one by one, and the line of the first.
    nodes: BTreeSet<Vec<u8>>,
    first_node: usize,
    /// Lines that say what no support can.
    others: Vec<usize>,
    /// Lines that hold directions away from 0.
    valued: Vec<usize>,
    /// Which step counts, where the file has several.
    step: Option<String>,
    /// Line of the first file that a step takes in.
    include: Option<usize>,
}

impl Boundaries {
    /// What holds in the step of the modes: steps go on from those before.
    pub(super) fn read(deck: &Deck<'_>, bodies: &mut Bodies) -> Self {
        let counted = deck.frequency.unwrap_or(1);
        let mut found = Self { turned: Turned::read(deck, bodies, counted), ..Self::default() };
        found.include = deck.of("INCLUDE").find(|block| block.step <= counted).map(|block| block.line);
        let mut step = 0;
        for block in deck.of("BOUNDARY") {
            // of the first of a step alone
            let is_first = std::mem::replace(&mut step, block.step) != block.step;
            let is_counted = block.step <= counted;
            if is_first && is_counted && block.parameter("OP").is_some_and(|op| op.eq_ignore_ascii_case("NEW")) {
                (found.nodes, found.others, found.valued) = Default::default();
                found.held.values_mut().for_each(|held| held.fixed = [false; 3]);
            }
            if block.parameter("INPUT").is_some() && is_counted {
                // in another file
                found.others.push(block.line);
            }
            for (line, text) in block.lines() {
                if is_counted {
                    found.read_line(block, line, text, deck, bodies);
                } else if let Some(set) = items(text).next().and_then(|name| bodies.node_sets.find(name, true, deck)) {
                    found.named(set, bodies);
                }
            }
        }
        if deck.steps > 1 && deck.of("BOUNDARY").next().is_some() {
            let why = if deck.frequency.is_some() { "the first that has *FREQUENCY" } else { "as none has *FREQUENCY" };
            found.step =
                Some(format!("the file has {} steps: *BOUNDARY counts up to step {counted}, {why}", deck.steps));
        }
        found
    }

    /// What of a set is held.
    fn named(&mut self, set: usize, bodies: &Bodies) -> &mut [bool; 3] {
        let own = &bodies.node_sets.list[set];
        let nodes = || own.members.iter().map(|&node| node as usize).collect();
        let held = self.held.entry((own.name.clone(), set));
        &mut held.or_insert_with(|| Held { nodes: nodes(), fixed: [false; 3] }).fixed
    }

    fn read_line(&mut self, block: &Block<'_>, line: usize, text: &[u8], deck: &Deck<'_>, bodies: &mut Bodies) {
        let words: Vec<&[u8]> = items(text).collect();
        let given = |place: usize| words.get(place).copied().filter(|word| !word.is_empty());
        let direction = |word: &[u8]| std::str::from_utf8(word).ok()?.parse::<u32>().ok();
        let fixed = match given(1).and_then(direction) {
            // solids have no rotations, and temperatures hold nothing
            Some(4..) => return,
            Some(first @ 1..) => {
                let last = given(2).map_or(Some(first), direction).filter(|last| *last >= first);
                last.map(|last| [1, 2, 3].map(|axis| (first..=last).contains(&axis)))
            }
            _ => {
                let word = capitals(given(1).unwrap_or_default());
                WORDS.iter().find(|(known, _)| *known == word).map(|(_, fixed)| *fixed)
            }
        };
        let value = given(3).map_or(Some(0.0), coordinate);
        // the usual type of a boundary
        let is_other = |value: String| !value.eq_ignore_ascii_case("DISPLACEMENT");
        let moves = value.is_none() || MOVING.iter().any(|name| block.parameter(name).is_some_and(is_other));
        let tag = words[0].rsplit(|&byte| byte == b'.').next().unwrap_or_default();
        let is_node = !tag.is_empty() && tag.iter().all(u8::is_ascii_digit);
        let set = bodies.node_sets.find(words[0], true, deck);
        let node = || bodies.node_numbers.get(std::str::from_utf8(tag).ok()?.parse().ok()?);
        let is_turned = set.map_or_else(|| node().is_some_and(|at| self.turned.nodes[at]), |set| self.turned.sets[set]);
        let fixed = fixed.filter(|fixed| !moves && (!is_turned || *fixed == [true; 3]));
        if let Some(set) = set {
            // Abaqus/CAE makes sets for what was picked
            bodies.node_sets.list[set].internal &= fixed.is_none();
            let own = self.named(set, bodies);
            (0..3).for_each(|axis| own[axis] |= fixed.is_some_and(|fixed| fixed[axis]));
        } else if fixed.is_some() && is_node {
            self.first_node = if self.nodes.is_empty() { line } else { self.first_node };
            self.nodes.insert(words[0].to_vec());
        }
        if fixed.is_none() || (set.is_none() && !is_node) {
            self.others.push(line);
        } else if value.is_some_and(|value| value.abs() > 0.0) {
            self.valued.push(line);
        }
    }

    /// Names the groups that supports are of, in the mesh that has them.
    pub(super) fn note(self, mesh: &mut Mesh) {
        let dimension = mesh.dimension();
        let mut by_name: HashMap<String, Vec<&PhysicalGroup>> = HashMap::new();
        for group in mesh.groups.iter().filter(|group| group.dimension < dimension) {
            by_name.entry(capitals(group.name.as_bytes())).or_default().push(group);
        }
        let mut lost: Vec<String> = self.step.into_iter().collect();
        let mut supports: BTreeMap<String, [bool; 3]> = BTreeMap::new();
        for ((name, _), Held { nodes, fixed }) in self.held {
            let named = by_name.get(&capitals(name.as_bytes())).map_or(&[][..], Vec::as_slice);
            // of groups of one name a case means that of the highest dimension
            let is_meant = |own: &PhysicalGroup| {
                named.iter().filter(|other| other.name == own.name && other.dimension >= own.dimension).count() == 1
            };
            let own = named.iter().find(|group| group.nodes == nodes && is_meant(group));
            // a group of the set's name is not guessed, whatever its nodes
            if let Some(group) = own.or(named.first()) {
                let held = supports.entry(group.name.clone()).or_default();
                (0..3).for_each(|axis| held[axis] |= fixed[axis] && own.is_some());
            }
            if own.is_none() && fixed.contains(&true) {
                lost.push(if nodes.len() == mesh.nodes.len() {
                    format!("*BOUNDARY holds \"{name}\", the set of all nodes: no support holds a whole body")
                } else if named.is_empty() {
                    format!("*BOUNDARY holds the set \"{name}\", which is no group: give its nodes a set of their own")
                } else {
                    format!("*BOUNDARY holds the set \"{name}\", whose name another set or surface has: name one anew")
                });
            }
        }
        let notes = &mut mesh.notes;
        notes.supports = supports.into_iter().map(|(group, fixed)| DeckSupport { group, fixed }).collect();
        notes.not_supports = lost;
        if let [first, ..] = self.valued[..] {
            notes.not_supports.push(format!(
                "*BOUNDARY has lines with values ({}, first line {first}): their directions are held, and the values are not used",
                self.valued.len()
            ));
        }
        if let count @ 1.. = self.nodes.len() {
            notes.not_supports.push(format!(
                "*BOUNDARY holds single nodes ({count}, first in line {}), which are no support: put them into an *NSET",
                self.first_node
            ));
        }
        if let Some(line) = self.include {
            notes.not_supports.push(format!(
                "*INCLUDE in line {line} takes another file into a step, which is not read: what it holds is no support"
            ));
        }
        if let [first, ..] = self.others[..] {
            notes.not_supports.push(format!(
                "*BOUNDARY has lines ({}, first line {first}) that move nodes over time, stand in axes of *TRANSFORM or in another file, or cannot be read: they are no support",
                self.others.len()
            ));
        }
    }
}
