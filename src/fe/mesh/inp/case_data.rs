//! Materials and what is held: no part of the mesh, but of the case that is made from it.
//!
//! Source: CalculiX CrunchiX user's manual 2.20, "*BOUNDARY", "*MATERIAL", "*SOLID SECTION"; Abaqus names the same ones alike.

use super::block::{Block, capitals, items};
use super::deck::Deck;
use super::numbers::coordinate;
use super::read::Bodies;
use super::sets::Set;
use crate::fe::mesh::{DeckMaterial, DeckSupport, ElementId, Mesh};
use std::collections::{BTreeMap, BTreeSet};

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

/// What the file says of the case, before it has groups.
#[derive(Default)]
pub(super) struct CaseData {
    materials: Vec<DeckMaterial>,
    /// Set of a section, its elements, and the index of its material.
    sections: Vec<(String, Vec<u32>, usize)>,
    /// Sets that boundaries name by their names, each with its nodes and what of them is held.
    held: BTreeMap<String, (Vec<u32>, [bool; 3])>,
    /// Nodes that are held one by one, and the line of the first.
    nodes: BTreeSet<Vec<u8>>,
    first_node: usize,
    /// Lines that say what no support can.
    others: Vec<usize>,
    /// Lines that hold directions away from 0.
    valued: Vec<usize>,
    /// Which step counts, where the file has several.
    step: Option<String>,
}

impl CaseData {
    /// Reads materials, sections and boundaries. A set that a section names and that is not of all elements becomes a group.
    pub(super) fn read(deck: &Deck<'_>, bodies: &mut Bodies) -> Self {
        let mut data = Self::default();
        data.read_materials(deck);
        for block in deck.of("SOLIDSECTION") {
            let named = |key: &str| block.parameter(key).map(|name| capitals(name.as_bytes()));
            let is_named = |own: &DeckMaterial| named("MATERIAL") == Some(capitals(own.name.as_bytes()));
            let material = data.materials.iter().position(is_named);
            let set = named("ELSET").and_then(|set| bodies.element_sets.find(set.as_bytes(), false, deck));
            if let (Some(material), Some(set)) = (material, set) {
                let set = &mut bodies.element_sets.list[set];
                set.internal &= set.members.len() == bodies.places.len();
                // later sections take over
                let known = data.sections.iter().position(|(own, ..)| *own == set.name);
                let members = known.map_or_else(|| set.members.clone(), |known| data.sections.remove(known).1);
                data.sections.push((set.name.clone(), members, material));
            }
        }
        data.read_boundaries(deck, bodies);
        data
    }

    /// What holds in the step of the modes: steps go on from those before.
    fn read_boundaries(&mut self, deck: &Deck<'_>, bodies: &mut Bodies) {
        let counted = deck.frequency.unwrap_or(1);
        let mut step = 0;
        for block in deck.of("BOUNDARY") {
            // of the first of a step alone
            let is_first = std::mem::replace(&mut step, block.step) != block.step;
            let is_counted = block.step <= counted;
            if is_first && is_counted && block.parameter("OP").is_some_and(|op| op.eq_ignore_ascii_case("NEW")) {
                (self.nodes, self.others, self.valued) = Default::default();
                self.held.values_mut().for_each(|(_, fixed)| *fixed = [false; 3]);
            }
            if block.parameter("INPUT").is_some() && is_counted {
                // in another file
                self.others.push(block.line);
            }
            for (line, text) in block.lines() {
                if is_counted {
                    self.read_boundary(block, line, text, deck, bodies);
                } else if let Some(set) = items(text).next().and_then(|name| bodies.node_sets.find(name, true, deck)) {
                    self.named(&bodies.node_sets.list[set]);
                }
            }
        }
        if deck.steps > 1 && deck.of("BOUNDARY").next().is_some() {
            let why = if deck.frequency.is_some() { "the first that has *FREQUENCY" } else { "as none has *FREQUENCY" };
            self.step =
                Some(format!("the file has {} steps: *BOUNDARY counts up to step {counted}, {why}", deck.steps));
        }
    }

    /// What of a set is held.
    fn named(&mut self, set: &Set) -> &mut [bool; 3] {
        let (_, fixed) = self.held.entry(set.name.clone()).or_insert_with(|| (set.members.clone(), [false; 3]));
        fixed
    }

    fn read_materials(&mut self, deck: &Deck<'_>) {
        let mut is_open = false;
        for block in &deck.blocks {
            let keyword = block.keyword();
            let mut lines = block.lines().map(|(_, text)| items(text).map(coordinate).collect::<Vec<_>>());
            // more lines are over temperature
            let (numbers, is_first) = (lines.next().unwrap_or_default(), lines.next().is_some());
            let is_isotropic = block.parameter("TYPE").is_none_or(|kind| capitals(kind.as_bytes()).starts_with("ISO"));
            match (keyword.as_str(), self.materials.last_mut().filter(|_| is_open)) {
                ("MATERIAL", _) => {
                    let name = block.parameter("NAME").unwrap_or_default();
                    self.materials.push(DeckMaterial {
                        name,
                        groups: Vec::new(),
                        elastic: None,
                        density: None,
                        first_line: false,
                    });
                }
                ("DENSITY", Some(own)) => {
                    own.density = numbers.first().copied().flatten();
                    own.first_line |= is_first;
                }
                ("ELASTIC", Some(own)) => {
                    own.elastic = match *numbers.as_slice() {
                        [Some(young), Some(poisson), ..] if is_isotropic => Some([young, poisson]),
                        _ => None,
                    };
                    own.first_line |= is_first && is_isotropic;
                }
                _ => {}
            }
            is_open = ["MATERIAL", "DENSITY", "ELASTIC"].contains(&keyword.as_str());
        }
    }

    fn read_boundary(&mut self, block: &Block<'_>, line: usize, text: &[u8], deck: &Deck<'_>, bodies: &mut Bodies) {
        let words: Vec<&[u8]> = items(text).collect();
        let word = capitals(words.get(1).copied().unwrap_or_default());
        let whole = |place: usize| words.get(place).and_then(|word| coordinate(word)).filter(|at| *at >= 1.0);
        let mut fixed = WORDS.iter().find(|(known, _)| *known == word).map(|(_, fixed)| *fixed);
        if let Some(first) = whole(1) {
            let last = whole(2).unwrap_or(first);
            fixed = Some([1.0, 2.0, 3.0].map(|axis| (first..=last).contains(&axis)));
            if first > 3.0 {
                // solids have no rotations, and temperatures hold nothing
                return;
            }
        }
        let value = words.get(3).copied().filter(|value| !value.is_empty()).map_or(Some(0.0), coordinate);
        // the usual type of a boundary
        let is_other = |value: String| !value.eq_ignore_ascii_case("DISPLACEMENT");
        let moves = value.is_none() || MOVING.iter().any(|name| block.parameter(name).is_some_and(is_other));
        // axes of its own that a line alone does not show
        let is_turned = deck.passed_over.contains_key("TRANSFORM");
        let fixed = fixed.filter(|fixed| !moves && (!is_turned || *fixed == [true; 3]));
        let tag = words[0].rsplit(|&byte| byte == b'.').next().unwrap_or_default();
        let is_node = !tag.is_empty() && tag.iter().all(u8::is_ascii_digit);
        let set = bodies.node_sets.find(words[0], true, deck);
        if let Some(set) = set {
            let set = &mut bodies.node_sets.list[set];
            // Abaqus/CAE makes sets for what was picked
            set.internal &= fixed.is_none();
            let own = self.named(set);
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

    /// Names the groups that materials and supports are of, in the mesh that has them.
    pub(super) fn note(mut self, mesh: &mut Mesh, places: &[Option<ElementId>]) {
        let mut made_of = mesh.for_each_element(usize::MAX);
        for (_, members, material) in &self.sections {
            for id in members.iter().filter_map(|&element| places[element as usize]) {
                made_of[id.block][id.index] = *material;
            }
        }
        let dimension = mesh.dimension();
        for group in mesh.groups.iter().filter(|group| group.dimension == dimension) {
            let of = |id: &ElementId| made_of[id.block][id.index];
            let Some(first) = group.elements.first().map(of) else { continue };
            if let Some(material) =
                self.materials.get_mut(first).filter(|_| group.elements.iter().all(|id| of(id) == first))
            {
                material.groups.push(group.name.clone());
            }
        }
        let notes = &mut mesh.notes;
        notes.materials = self.materials;
        let mut lost: Vec<String> = self.step.into_iter().collect();
        for (name, (members, fixed)) in self.held {
            let nodes: Vec<usize> = members.iter().map(|&node| node as usize).collect();
            let key = capitals(name.as_bytes());
            let groups = mesh.groups.iter().filter(|group| group.dimension < dimension);
            let named: Vec<_> = groups.filter(|group| capitals(group.name.as_bytes()) == key).collect();
            let own = named.iter().find(|group| group.nodes == nodes);
            // a group of the set's name is not guessed, whatever its nodes
            if let Some(group) = own.or(named.first()) {
                let fixed = fixed.map(|fixed| fixed && own.is_some());
                notes.supports.push(DeckSupport { group: group.name.clone(), fixed });
            }
            if own.is_none() && fixed.contains(&true) {
                lost.push(if nodes.len() == mesh.nodes.len() {
                    format!("*BOUNDARY holds \"{name}\", the set of all nodes: no support holds a whole body")
                } else {
                    format!("*BOUNDARY holds the set \"{name}\", which is no group: give its nodes a set of their own")
                });
            }
        }
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
        if let [first, ..] = self.others[..] {
            notes.not_supports.push(format!(
                "*BOUNDARY has lines ({}, first line {first}) that move nodes over time, stand in turned axes or another file, or cannot be read: they are no support",
                self.others.len()
            ));
        }
    }
}
