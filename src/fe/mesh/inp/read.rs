//! Nodes and elements of an input file, with the errors of their lines.

use super::MshError;
use super::block::{Block, capitals, items};
use super::deck::Deck;
use super::kinds::{self, Purpose, Type, inp_nodes};
use super::numbers::{Numbers, coordinate, number};
use super::sets::Sets;
use crate::fe::mesh::gmsh::{quoted, short};
use crate::fe::mesh::{ElementBlock, ElementId, ElementKind, Entity};
use std::collections::BTreeMap;

/// Nodes and elements.
pub(super) struct Bodies {
    /// In m.
    pub(super) nodes: Vec<[f64; 3]>,
    pub(super) node_numbers: Numbers,
    /// One block a kind, in the order of the kinds; some are empty.
    pub(super) blocks: Vec<ElementBlock>,
    pub(super) element_numbers: Numbers,
    /// Where an element is; `None` for one that is left out.
    pub(super) places: Vec<Option<ElementId>>,
    /// Purposes that occur, with the first type and element of each.
    pub(super) purposes: BTreeMap<Purpose, (String, u64)>,
    /// Types that are left out: number of elements, the first one.
    pub(super) left_out: BTreeMap<String, (usize, u64)>,
    /// Sets that keywords of nodes and elements name.
    pub(super) node_sets: Sets,
    pub(super) element_sets: Sets,
}

impl Bodies {
    /// Reads nodes and elements; one unit of the file is so many metres.
    pub(super) fn read(deck: &Deck<'_>, metres: f64) -> Result<Self, MshError> {
        let of = |keyword: &'static str| deck.of_mesh(keyword);
        let empty = |kind: ElementKind| ElementBlock {
            kind,
            tags: Vec::new(),
            connectivity: Vec::new(),
            entity: Entity { dimension: kind.dimension(), tag: 1 },
        };
        let mut bodies = Self {
            nodes: Vec::new(),
            node_numbers: Numbers::for_blocks(of("NODE")),
            blocks: ElementKind::all().map(empty).collect(),
            element_numbers: Numbers::for_blocks(of("ELEMENT")),
            places: Vec::new(),
            purposes: BTreeMap::new(),
            left_out: BTreeMap::new(),
            node_sets: Sets::default(),
            element_sets: Sets::default(),
        };
        for block in of("NODE") {
            bodies.read_nodes(block, metres)?;
        }
        for node in &mut bodies.nodes {
            (0..3).for_each(|axis| node[axis] += metres * deck.shift[axis]);
        }
        for block in of("ELEMENT") {
            bodies.read_elements(block)?;
        }
        for (missing, keyword) in [(bodies.nodes.is_empty(), "NODE"), (bodies.places.is_empty(), "ELEMENT")] {
            if missing {
                return Err(MshError(format!(
                    "the file has no *{keyword} with data: expected a mesh; is it complete?"
                )));
            }
        }
        Ok(bodies)
    }

    /// Whether there are no solids.
    pub(super) fn is_plane(&self) -> bool {
        self.blocks.iter().all(|block| block.is_empty() || block.kind.dimension() < 3)
    }

    fn read_nodes(&mut self, block: &Block<'_>, metres: f64) -> Result<(), MshError> {
        if let Some(system) = block.parameter("SYSTEM").filter(|system| !system.eq_ignore_ascii_case("R")) {
            return Err(block.fault(
                block.line,
                format_args!("found SYSTEM={}: expected rectangular coordinates", short(system.as_bytes())),
            ));
        }
        let set = block.parameter("NSET").map(|name| self.node_sets.named(&name, false));
        for (line, text) in block.lines() {
            let mut words = items(text);
            let tag = number(block, line, "the number of a node", words.next().unwrap_or_default())?;
            let mut node = [0.0; 3];
            for x in &mut node {
                // Abaqus takes what is not given as 0
                let word = words.next().filter(|word| !word.is_empty());
                if let Some(word) = word {
                    let found = coordinate(word).map(|found| found * metres);
                    *x = found.ok_or_else(|| {
                        block.fault(line, format_args!("node {tag}: expected a coordinate, found {}", quoted(word)))
                    })?;
                }
            }
            let index = self.node_numbers.get(tag).unwrap_or(self.nodes.len());
            if index == self.nodes.len() {
                self.node_numbers.push(tag);
                self.nodes.push(node);
            } else if self.nodes[index].iter().zip(node).any(|(known, other)| (known - other).abs() > 0.0) {
                return Err(block.fault(
                    line,
                    format_args!("node {tag} occurs a second time in another place: expected every number once"),
                ));
            }
            set.iter().for_each(|&set| self.node_sets.list[set].members.push(index as u32));
        }
        Ok(())
    }

    fn read_elements(&mut self, block: &Block<'_>) -> Result<(), MshError> {
        let name = capitals(block.required("TYPE")?.as_bytes());
        let found = kinds::of_name(&name);
        let name = short(name.as_bytes());
        let known = match found {
            Type::Known(kind, purpose) => Some((kind, purpose)),
            Type::LeftOut => None,
            Type::Refused => {
                return Err(block.fault(
                    block.line,
                    format_args!("TYPE={name} cannot be read: expected C3D4, C3D6, C3D8, C3D10, C3D15, C3D20 or CPS and CPE with 3, 4, 6 or 8 nodes; mesh again with these"),
                ));
            }
        };
        let order = known.map_or(Vec::new(), |(kind, _)| inp_nodes(kind));
        let set = block.parameter("ELSET").map(|name| self.element_sets.named(&name, false));
        let mut lines = block.lines();
        let mut words: Vec<&[u8]> = Vec::new();
        while let Some((line, text)) = lines.next() {
            words.clear();
            words.extend(items(text));
            let mut open = text.ends_with(b",");
            // some programs leave out the comma at the end of a long line
            while words.len() <= order.len() && (open || order.len() > 8) || known.is_none() && open {
                let Some((_, text)) = lines.next() else { break };
                words.extend(items(text));
                open = text.ends_with(b",");
            }
            let tag = number(block, line, "the number of an element", words[0])?;
            // some programs give a beam of three nodes its ends alone
            let known = known.filter(|(kind, purpose)| *purpose != Purpose::Curve || words.len() == kind.nodes() + 1);
            let nodes = match known {
                Some((ElementKind::Line3, _)) => {
                    let nodes = self.nodes_of(block, line, tag, &words[1..], &order)?;
                    self.middle_last([nodes[0], nodes[1], nodes[2]]).to_vec()
                }
                Some(_) => self.nodes_of(block, line, tag, &words[1..], &order)?,
                None => Vec::new(),
            };
            let index = self.element_numbers.get(tag).unwrap_or(self.places.len());
            set.iter().for_each(|&set| self.element_sets.list[set].members.push(index as u32));
            if index < self.places.len() {
                let same = match (self.places[index], known) {
                    (Some(id), Some((kind, _))) => {
                        id.block == kind as usize && self.blocks[id.block].nodes_of(id.index) == nodes
                    }
                    (place, known) => place.is_none() && known.is_none(),
                };
                if same {
                    continue;
                }
                return Err(block.fault(
                    line,
                    format_args!("element {tag} occurs a second time with other nodes: expected every number once"),
                ));
            }
            self.element_numbers.push(tag);
            self.places.push(known.map(|(kind, purpose)| {
                self.purposes.entry(purpose).or_insert_with(|| (name.clone(), tag));
                let own = &mut self.blocks[kind as usize];
                own.tags.push(tag);
                own.connectivity.extend(nodes);
                ElementId { block: kind as usize, index: own.len() - 1 }
            }));
            if known.is_none() {
                self.left_out.entry(name.clone()).or_insert((0, tag)).0 += 1;
            }
        }
        Ok(())
    }

    /// The nodes of a curve with its middle last: Abaqus has it between the ends, gmsh writes it last.
    fn middle_last(&self, [first, second, third]: [usize; 3]) -> [usize; 3] {
        let off_middle = |middle: usize, ends: [usize; 2]| {
            let [a, b, c] = [ends[0], ends[1], middle].map(|node| self.nodes[node]);
            (0..3).map(|axis| (2.0 * c[axis] - a[axis] - b[axis]).powi(2)).sum::<f64>()
        };
        match off_middle(second, [first, third]) < off_middle(third, [first, second]) {
            true => [first, third, second],
            false => [first, second, third],
        }
    }

    /// Indices of the nodes of an element, brought into an order that gives for each its place in the file.
    fn nodes_of(
        &self,
        block: &Block<'_>,
        line: usize,
        tag: u64,
        words: &[&[u8]],
        order: &[usize],
    ) -> Result<Vec<usize>, MshError> {
        if words.len() != order.len() {
            let (found, expected) = (words.len(), order.len());
            let what = format_args!("element {tag} has {found} nodes: expected {expected}");
            return Err(block.fault(line, what));
        }
        let mut nodes = Vec::with_capacity(order.len());
        for &place in order {
            let node = number(block, line, "the number of a node", words[place])?;
            let index = self.node_numbers.get(node).ok_or_else(|| {
                block.fault(line, format_args!("element {tag} refers to node {node}: expected one that *NODE lists"))
            })?;
            if nodes.contains(&index) {
                return Err(block.fault(
                    line,
                    format_args!("element {tag} has the node {node} twice: expected different nodes; mesh again without collapsed elements"),
                ));
            }
            nodes.push(index);
        }
        Ok(nodes)
    }
}
