//! Materials and what is made of them: no part of the mesh, but of the case that is made from it.
//!
//! Source: CalculiX CrunchiX user's manual 2.20, "*MATERIAL", "*ELASTIC", "*SOLID SECTION"; Abaqus names the same ones alike.

use super::block::{capitals, items};
use super::deck::{Deck, OTHER_LAWS};
use super::numbers::coordinate;
use super::read::Bodies;
use crate::fe::mesh::gmsh::{quoted, short};
use crate::fe::mesh::{DeckMaterial, ElementId, Mesh, MeshNote};
use std::collections::HashMap;

/// The materials, before there are groups.
pub(super) struct Materials {
    list: Vec<DeckMaterial>,
    /// For each element the index of its material; `usize::MAX`: it has none.
    made_of: Vec<usize>,
    /// What names nothing, in sentences.
    lost: Vec<String>,
}

impl Materials {
    /// Reads materials and sections. A set that a section names and that is not of all elements becomes a group.
    pub(super) fn read(deck: &Deck<'_>, bodies: &mut Bodies) -> Self {
        let (list, nameless) = read_list(deck);
        let mut by_name = HashMap::new();
        for (index, own) in list.iter().enumerate() {
            by_name.entry(capitals(own.name.as_bytes())).or_insert(index);
        }
        let (mut sections, mut unknown) = (Vec::new(), Vec::new());
        for block in deck.of("SOLIDSECTION") {
            let named = |key: &str| block.parameter(key).unwrap_or_default();
            let material = by_name.get(&capitals(named("MATERIAL").as_bytes()));
            match (material, bodies.element_sets.find(named("ELSET").as_bytes(), false, deck)) {
                (Some(&material), Some(set)) => sections.push((set, material)),
                (None, _) => unknown.push(format!("{}, MATERIAL={}", block.line, quoted(named("MATERIAL").as_bytes()))),
                (_, None) => unknown.push(format!("{}, ELSET={}", block.line, quoted(named("ELSET").as_bytes()))),
            }
        }
        // later sections take over
        let last: HashMap<usize, usize> = sections.iter().enumerate().map(|(order, (set, _))| (*set, order)).collect();
        let mut made_of = vec![usize::MAX; bodies.places.len()];
        for (order, (set, material)) in sections.into_iter().enumerate() {
            if last[&set] == order {
                let set = &mut bodies.element_sets.list[set];
                set.internal &= set.members.len() == made_of.len();
                set.members.iter().for_each(|&element| made_of[element as usize] = material);
            }
        }
        let mut lost = Vec::new();
        if let [first, ..] = &unknown[..] {
            let count = unknown.len();
            lost.push(format!(
                "*SOLID SECTION names what the file does not have ({count}, first line {first}): give it a *MATERIAL and an *ELSET of the file"
            ));
        }
        if let [first, ..] = nameless[..] {
            let count = nameless.len();
            lost.push(format!(
                "*MATERIAL has no NAME ({count}, first line {first}) and is not taken: give it NAME=..."
            ));
        }
        Self { list, made_of, lost }
    }

    /// Names the groups that materials are of, in the mesh that has them.
    pub(super) fn note(mut self, mesh: &mut Mesh, places: &[Option<ElementId>]) {
        let mut made_of = mesh.for_each_element(usize::MAX);
        for (place, material) in places.iter().zip(self.made_of) {
            place.iter().for_each(|id| made_of[id.block][id.index] = material);
        }
        let dimension = mesh.dimension();
        for group in mesh.groups.iter().filter(|group| group.dimension == dimension) {
            let of = |id: &ElementId| made_of[id.block][id.index];
            let Some(first) = group.elements.first().map(of) else { continue };
            if let Some(material) = self.list.get_mut(first).filter(|_| group.elements.iter().all(|id| of(id) == first))
            {
                material.groups.push(group.name.clone());
            }
        }
        mesh.notes.materials = self.list;
        mesh.notes.told.extend(self.lost.into_iter().map(MeshNote::Sentence));
    }
}

/// The materials, and the lines of those without a name.
fn read_list(deck: &Deck<'_>) -> (Vec<DeckMaterial>, Vec<usize>) {
    let (mut list, mut nameless): (Vec<DeckMaterial>, Vec<usize>) = Default::default();
    let mut is_open = false;
    for block in &deck.blocks {
        let keyword = block.keyword();
        if keyword == "MATERIAL" {
            let name = block.parameter("NAME").unwrap_or_default();
            is_open = !name.is_empty();
            if is_open {
                list.push(DeckMaterial { name, ..DeckMaterial::default() });
            } else {
                nameless.push(block.line);
            }
            continue;
        }
        let is_law = OTHER_LAWS.contains(&keyword.as_str());
        is_open &= is_law || keyword == "DENSITY" || keyword == "ELASTIC";
        let Some(own) = list.last_mut().filter(|_| is_open) else { continue };
        let mut lines = block.lines().map(|(_, text)| items(text).map(coordinate).collect::<Vec<_>>());
        // more lines are over temperature
        let (numbers, is_first) = (lines.next().unwrap_or_default(), lines.next().is_some());
        let kind = block.parameter("TYPE").filter(|kind| !capitals(kind.as_bytes()).starts_with("ISO"));
        match (kind, &numbers[..]) {
            _ if is_law => own.other_law = Some(format!("*{keyword}")),
            (_, numbers) if keyword == "DENSITY" => {
                own.density = numbers.first().copied().flatten();
                own.first_line |= is_first;
            }
            (Some(kind), _) => own.other_law = Some(format!("*ELASTIC, TYPE={}", short(kind.as_bytes()))),
            (None, numbers) => {
                own.elastic = match *numbers {
                    [Some(young), Some(poisson), ..] => Some([young, poisson]),
                    _ => None,
                };
                own.first_line |= is_first;
            }
        }
    }
    list.iter_mut().filter(|own| own.other_law.is_some()).for_each(|own| own.elastic = None);
    (list, nameless)
}
