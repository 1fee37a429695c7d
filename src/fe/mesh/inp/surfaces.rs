//! What `*ELSET`, `*NSET` and `*SURFACE` list.

use super::MshError;
use super::block::{Block, capitals, items};
use super::deck::Deck;
use super::kinds;
use super::numbers::number;
use super::read::Bodies;
use crate::fe::mesh::gmsh::{Allowance, quoted};

/// Reads the sets of elements, then those of nodes. A set may name sets that stand before it.
pub(super) fn read_sets(deck: &Deck<'_>, bodies: &mut Bodies, allowance: &mut Allowance) -> Result<(), MshError> {
    for block in deck.of("ELSET") {
        bodies.element_sets.add(block, deck, (&bodies.element_numbers, "the number of an element"), allowance)?;
    }
    bodies.element_sets.sort();
    for block in deck.of("NSET") {
        let Some(of) = block.parameter("ELSET") else {
            bodies.node_sets.add(block, deck, (&bodies.node_numbers, "the number of a node"), allowance)?;
            continue;
        };
        let in_assembly = deck.is_in_assembly(block);
        let set = bodies.element_sets.find(of.as_bytes(), in_assembly, deck);
        let set = set.ok_or_else(|| unknown(block, block.line, "a set of elements", of.as_bytes()))?;
        let places =
            bodies.element_sets.list[set].members.iter().filter_map(|&element| bodies.places[element as usize]);
        let mut nodes: Vec<u32> =
            places.flat_map(|id| bodies.blocks[id.block].nodes_of(id.index)).map(|&node| node as u32).collect();
        nodes.sort_unstable();
        nodes.dedup();
        allowance.take(nodes.len())?;
        let own = bodies.node_sets.named(&block.required("NSET")?, in_assembly);
        bodies.node_sets.list[own].members.extend(nodes);
    }
    bodies.node_sets.sort();
    Ok(())
}

fn unknown(block: &Block<'_>, line: usize, what: &str, found: &[u8]) -> MshError {
    block.fault(line, format_args!("expected {what} that the file has, found {}", quoted(found)))
}

/// What a surface is made of.
pub(super) enum Surface {
    /// Elements, and the index of a face of each; `None`: those of its faces that are on the outside.
    Faces(Vec<(u32, Option<u8>)>),
    /// Nodes.
    Nodes(Vec<u32>),
}

/// Reads the surfaces with their names.
pub(super) fn surfaces(
    deck: &Deck<'_>,
    bodies: &Bodies,
    allowance: &mut Allowance,
) -> Result<Vec<(String, Surface)>, MshError> {
    let mut found = Vec::new();
    for block in deck.of("SURFACE") {
        let name = block.required("NAME")?;
        let kind = capitals(block.parameter("TYPE").unwrap_or_default().as_bytes());
        let surface = match kind.as_str() {
            "" | "ELEMENT" => Surface::Faces(faces(block, deck, bodies, allowance)?),
            "NODE" => Surface::Nodes(nodes(block, deck, bodies, allowance)?),
            // of revolution, cut out of another one and so on: of rigid tools
            _ => continue,
        };
        if block.parameter("INTERNAL").is_none() {
            found.push((name, surface));
        }
    }
    Ok(found)
}

fn faces(
    block: &Block<'_>,
    deck: &Deck<'_>,
    bodies: &Bodies,
    allowance: &mut Allowance,
) -> Result<Vec<(u32, Option<u8>)>, MshError> {
    let mut faces = Vec::new();
    for (line, text) in block.lines() {
        let mut words = items(text);
        let of = words.next().unwrap_or_default();
        let label = capitals(words.next().unwrap_or_default());
        let one;
        let members = match bodies.element_sets.find(of, deck.is_in_assembly(block), deck) {
            Some(set) => &bodies.element_sets.list[set].members,
            None if of.iter().all(u8::is_ascii_digit) => {
                let element = number(block, line, "the number of an element", of)?;
                let element = bodies.element_numbers.get(element);
                one = vec![element.ok_or_else(|| unknown(block, line, "an element", of))? as u32];
                &one
            }
            None => return Err(unknown(block, line, "an element or a set of elements", of)),
        };
        allowance.take(members.len())?;
        for &element in members {
            let Some(id) = bodies.places[element as usize] else { continue };
            let kind = bodies.blocks[id.block].kind;
            // a shell's label is a side, SPOS or SNEG
            let is_whole = label.is_empty() || kind.dimension() < 3 && !bodies.is_plane();
            let digit = label.strip_prefix('S').and_then(|number| number.parse().ok());
            let face = digit.and_then(|number| kinds::face(kind, number)).map(|face| face as u8);
            if face.is_none() && !is_whole {
                let tag = bodies.element_numbers.listed[element as usize];
                return Err(block.fault(
                    line,
                    format_args!(
                        "expected a face of element {tag} ({}), S1 to S{}, found {}",
                        kind.name(),
                        kind.faces().len(),
                        quoted(label.as_bytes())
                    ),
                ));
            }
            faces.push((element, face.filter(|_| !is_whole)));
        }
    }
    Ok(faces)
}

fn nodes(block: &Block<'_>, deck: &Deck<'_>, bodies: &Bodies, allowance: &mut Allowance) -> Result<Vec<u32>, MshError> {
    let mut nodes = Vec::new();
    for (line, text) in block.lines() {
        let of = items(text).next().unwrap_or_default();
        match bodies.node_sets.find(of, deck.is_in_assembly(block), deck) {
            Some(set) => {
                let members = &bodies.node_sets.list[set].members;
                allowance.take(members.len())?;
                nodes.extend_from_slice(members);
            }
            None if of.iter().all(u8::is_ascii_digit) => {
                let node = bodies.node_numbers.get(number(block, line, "the number of a node", of)?);
                nodes.push(node.ok_or_else(|| unknown(block, line, "a node", of))? as u32);
            }
            None => return Err(unknown(block, line, "a node or a set of nodes", of)),
        }
    }
    nodes.sort_unstable();
    nodes.dedup();
    Ok(nodes)
}
