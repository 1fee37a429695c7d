//! From what has been read to a [`Mesh`]: sets and surfaces as groups, and what is said of the rest.

use super::MshError;
use super::block::capitals;
use super::boundaries::Boundaries;
use super::deck::{Deck, JOINTS};
use super::kinds::Purpose;
use super::materials::Materials;
use super::read::Bodies;
use super::sets::Set;
use super::surfaces::{Surface, read_sets, surfaces};
use crate::fe::mesh::gmsh::Allowance;
use crate::fe::mesh::{
    BoundaryFace, ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshNote, MeshNotes, MshFormat, MshVersion,
    PhysicalGroup, sorted_corners,
};
use std::collections::{BTreeSet, HashMap};
use std::path::Path;

/// Name of the group of all elements where no set holds any.
const WITHOUT_SET: &str = "body";

/// Reads a file; one of its units is so many metres.
pub(super) fn mesh(bytes: &[u8], path: &Path, metres: f64) -> Result<Mesh, MshError> {
    let deck = Deck::cut(bytes)?;
    let mut bodies = Bodies::read(&deck, metres)?;
    let mut allowance = Allowance { file_bytes: bytes.len(), listed: 0 };
    read_sets(&deck, &mut bodies, &mut allowance)?;
    let surfaces = surfaces(&deck, &bodies, &mut allowance)?;
    check_bodies(&bodies)?;
    let (materials, boundaries) = (Materials::read(&deck, &mut bodies), Boundaries::read(&deck, &mut bodies));
    let notes = notes(&deck, &bodies);
    let Bodies { nodes, node_numbers, mut blocks, places, element_numbers, node_sets, element_sets, .. } = bodies;
    // blocks without elements go
    let moved: Vec<usize> =
        (0..blocks.len()).map(|at| blocks[..at].iter().filter(|block| !block.is_empty()).count()).collect();
    blocks.retain(|block| !block.is_empty());
    let places: Vec<_> =
        places.into_iter().map(|place| place.map(|id| ElementId { block: moved[id.block], ..id })).collect();
    let mut mesh = Mesh {
        nodes,
        node_tags: node_numbers.listed,
        blocks,
        groups: Vec::new(),
        format: MshFormat { version: MshVersion::Inp, binary: false },
        notes,
        source: path.to_path_buf(),
    };
    let next_tag = element_numbers.listed.iter().max().map_or(1, |last| last + 1);
    let mut groups = Groups::new(&mut mesh, next_tag, allowance);
    for (name, surface) in surfaces {
        groups.add_surface(name, surface, &places)?;
    }
    for set in node_sets.list.into_iter().filter(|set| !set.internal) {
        groups.add_node_set(set)?;
    }
    for set in element_sets.list.into_iter().filter(|set| !set.internal) {
        let members = set.members.iter().filter_map(|&element| places[element as usize]);
        groups.add_element_set(set.name, members.collect())?;
    }
    groups.finish()?;
    materials.note(&mut mesh, &places);
    boundaries.note(&mut mesh);
    Ok(mesh)
}

/// Solids, or plane elements that are no shells.
fn check_bodies(bodies: &Bodies) -> Result<(), MshError> {
    let first = |purpose: Purpose| bodies.purposes.get(&purpose);
    let expected = "expected solids (C3D4 to C3D20), or plane elements (CPS, CPE)";
    let left_out: Vec<&str> = bodies.left_out.keys().map(String::as_str).take(10).collect();
    let has_body = bodies.blocks.iter().any(|block| !block.is_empty() && block.kind.dimension() >= 2);
    if bodies.is_plane() {
        for (purpose, what) in
            [(Purpose::Shell, "a shell or membrane"), (Purpose::Axisymmetric, "of a body of revolution")]
        {
            if let Some((name, tag)) = first(purpose) {
                return Err(MshError(format!(
                    "element {tag} of type {name} is {what} and the file has no solids: {expected}; mesh the volume"
                )));
            }
        }
    }
    if !has_body {
        let others = if left_out.is_empty() { "curves alone".to_owned() } else { left_out.join(", ") };
        return Err(MshError(format!("the file has no element that a body is made of: {expected}, found {others}")));
    }
    Ok(())
}

/// What of the file is not in the mesh.
fn notes(deck: &Deck<'_>, bodies: &Bodies) -> MeshNotes {
    let mut told = Vec::new();
    for (name, (count, first)) in &bodies.left_out {
        told.push(format!("elements of type {name} are not modelled and left out: {count}, the first is {first}"));
    }
    let sections = [
        (Purpose::Shell, ["SHELLSECTION", "MEMBRANESECTION"], "shells and membranes"),
        (Purpose::Curve, ["BEAMSECTION", "BEAMGENERALSECTION"], "beams"),
    ];
    for (purpose, keywords, what) in sections {
        let has_section = keywords.iter().any(|keyword| deck.passed_over.contains_key(*keyword));
        if let Some((name, tag)) = bodies.purposes.get(&purpose).filter(|_| has_section) {
            told.push(format!(
                "the {what} (the first is element {tag} of type {name}) have no stiffness and no mass here"
            ));
        }
    }
    let joints = deck.passed_over.iter().filter(|(keyword, _)| JOINTS.contains(&keyword.as_str()));
    let joints: Vec<String> = joints.map(|(keyword, line)| format!("*{keyword} (line {line})")).collect();
    if !joints.is_empty() {
        told.push(format!(
            "these are not taken from the file: {}; housing.links and housing.masses of the case can say the like",
            joints.join(", ")
        ));
    }
    let told = told.into_iter().map(MeshNote::Sentence).collect();
    let passed_over = deck.passed_over.keys().map(|keyword| format!("*{keyword}")).collect();
    MeshNotes { told, passed_over, ..MeshNotes::default() }
}

/// Groups under way, and the faces and points that they need.
struct Groups<'m> {
    mesh: &'m mut Mesh,
    /// Blocks from this index on are made here.
    first_block: usize,
    faces: HashMap<[u32; 4], ElementId>,
    points: HashMap<usize, ElementId>,
    /// The faces on the outside of the bodies.
    outside: Vec<BoundaryFace>,
    /// For each node where its faces begin in the list, and the list.
    faces_of: (Vec<u32>, Vec<u32>),
    /// Whether an element of the bodies uses a node, and the number of such nodes.
    used: Vec<bool>,
    used_count: usize,
    next_tag: u64,
    allowance: Allowance,
}

impl<'m> Groups<'m> {
    fn new(mesh: &'m mut Mesh, next_tag: u64, allowance: Allowance) -> Self {
        let dimension = mesh.dimension();
        let outside = mesh.boundary_faces(mesh.element_ids(dimension));
        let mut begins = vec![0_u32; mesh.nodes.len() + 1];
        outside.iter().flat_map(|face| &face.nodes).for_each(|&node| begins[node + 1] += 1);
        for node in 0..mesh.nodes.len() {
            begins[node + 1] += begins[node];
        }
        let (mut next, mut list) = (begins.clone(), vec![0; begins[mesh.nodes.len()] as usize]);
        for (number, face) in (0..).zip(&outside) {
            for &node in &face.nodes {
                list[next[node] as usize] = number;
                next[node] += 1;
            }
        }
        let mut used = vec![false; mesh.nodes.len()];
        for block in mesh.blocks.iter().filter(|block| block.kind.dimension() == dimension) {
            block.connectivity.iter().for_each(|&node| used[node] = true);
        }
        Self {
            first_block: mesh.blocks.len(),
            mesh,
            faces: HashMap::new(),
            points: HashMap::new(),
            outside,
            faces_of: (begins, list),
            used_count: used.iter().filter(|used| **used).count(),
            used,
            next_tag,
            allowance,
        }
    }

    /// A new element of a face or point.
    fn element(&mut self, kind: ElementKind, nodes: &[usize]) -> ElementId {
        let blocks = &mut self.mesh.blocks;
        let own = blocks[self.first_block..].iter().position(|block| block.kind == kind);
        let block = own.map_or(blocks.len(), |own| self.first_block + own);
        if block == blocks.len() {
            let entity = Entity { dimension: kind.dimension(), tag: 1 };
            blocks.push(ElementBlock { kind, tags: Vec::new(), connectivity: Vec::new(), entity });
        }
        let index = blocks[block].len();
        blocks[block].tags.push(self.next_tag);
        blocks[block].connectivity.extend_from_slice(nodes);
        self.next_tag += 1;
        ElementId { block, index }
    }

    /// The element of a face, made once.
    fn face(&mut self, kind: ElementKind, nodes: &[usize]) -> ElementId {
        let key = sorted_corners(nodes[..kind.corners()].iter().copied());
        if let Some(&known) = self.faces.get(&key) {
            return known;
        }
        let new = self.element(kind, nodes);
        self.faces.insert(key, new);
        new
    }

    fn add_surface(&mut self, name: String, surface: Surface, places: &[Option<ElementId>]) -> Result<(), MshError> {
        let faces = match surface {
            Surface::Nodes(members) => return self.add_node_set(Set { name, internal: false, members }),
            Surface::Faces(faces) => faces,
        };
        let mut found = Vec::with_capacity(faces.len());
        let mut whole = BTreeSet::new();
        for (element, face) in faces {
            let Some(id) = places[element as usize] else { continue };
            let block = &self.mesh.blocks[id.block];
            match face {
                Some(face) => {
                    let face = block.kind.faces()[usize::from(face)];
                    let nodes: Vec<usize> = face.nodes.iter().map(|&local| block.nodes_of(id.index)[local]).collect();
                    found.push(self.face(face.kind, &nodes));
                }
                None if block.kind.dimension() < self.mesh.dimension() => found.push(id),
                None => drop(whole.insert(id)),
            }
        }
        if !whole.is_empty() {
            let outside = std::mem::take(&mut self.outside);
            let own = outside.iter().filter(|face| whole.contains(&face.element));
            found.extend(own.map(|face| self.face(face.kind, &face.nodes)));
            self.outside = outside;
        }
        self.push(name, found)
    }

    /// A node set as the faces that it covers, else as points; one of all nodes of the bodies is no group.
    fn add_node_set(&mut self, set: Set) -> Result<(), MshError> {
        let mut is_in = HashMap::with_capacity(set.members.len());
        is_in.extend(set.members.iter().map(|&node| (node as usize, false)));
        let of_bodies = set.members.iter().filter(|node| self.used[**node as usize]).count();
        if of_bodies == self.used_count {
            return Ok(());
        }
        let mut covered = BTreeSet::new();
        for &node in &set.members {
            let [begin, end] = [0, 1].map(|next| self.faces_of.0[node as usize + next] as usize);
            for &face in &self.faces_of.1[begin..end] {
                if self.outside[face as usize].nodes.iter().all(|node| is_in.contains_key(node)) {
                    covered.insert(face);
                }
            }
        }
        let outside = std::mem::take(&mut self.outside);
        for node in covered.iter().flat_map(|&face| &outside[face as usize].nodes) {
            is_in.insert(*node, true);
        }
        let elements = if is_in.values().all(|covered| *covered) {
            covered
                .iter()
                .map(|&face| (outside[face as usize].kind, &outside[face as usize].nodes))
                .map(|(kind, nodes)| self.face(kind, nodes))
                .collect()
        } else {
            let stray = set.members.iter().filter(|&&node| !is_in[&(node as usize)]);
            if let Some(&first) = stray.clone().next().filter(|_| !covered.is_empty()) {
                self.mesh.notes.as_points.push(format!(
                    "the node set \"{}\" is a group of points: beside whole faces ({}) it holds other nodes ({}, the first is {})",
                    set.name,
                    covered.len(),
                    stray.count(),
                    self.mesh.node_tags[first as usize]
                ));
            }
            let points = set.members.iter().map(|&node| node as usize);
            points
                .map(|node| {
                    let known = self.points.get(&node).copied();
                    known.unwrap_or_else(|| {
                        let new = self.element(ElementKind::Point, &[node]);
                        self.points.insert(node, new);
                        new
                    })
                })
                .collect()
        };
        self.outside = outside;
        self.push(set.name, elements)
    }

    /// An element set as a group of those of its elements that have the highest dimension.
    fn add_element_set(&mut self, name: String, mut elements: Vec<ElementId>) -> Result<(), MshError> {
        let kind = |id: &ElementId| self.mesh.blocks[id.block].kind.dimension();
        let highest = elements.iter().map(kind).max();
        elements.retain(|id| Some(kind(id)) == highest);
        self.push(name, elements)
    }

    fn push(&mut self, name: String, mut elements: Vec<ElementId>) -> Result<(), MshError> {
        let Some(first) = elements.first() else { return Ok(()) };
        let dimension = self.mesh.blocks[first.block].kind.dimension();
        elements.sort_unstable();
        elements.dedup();
        let mut nodes: Vec<usize> =
            elements.iter().flat_map(|id| self.mesh.blocks[id.block].nodes_of(id.index)).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        self.allowance.take(elements.len() + nodes.len() / 2)?;
        self.mesh.groups.push(PhysicalGroup { name, dimension, tag: 0, nodes, elements });
        Ok(())
    }

    /// Leaves one group of each name where the others say the same, and numbers them.
    fn finish(mut self) -> Result<(), MshError> {
        let dimension = self.mesh.dimension();
        if !self.mesh.groups.iter().any(|group| group.dimension == dimension) {
            let all = self.mesh.element_ids(dimension).collect();
            self.push(WITHOUT_SET.to_owned(), all)?;
        }
        let groups = &mut self.mesh.groups;
        let key = |group: &PhysicalGroup| capitals(group.name.as_bytes());
        let mut by_name: HashMap<String, Vec<usize>> = HashMap::new();
        for (index, group) in groups.iter().enumerate() {
            by_name.entry(key(group)).or_default().push(index);
        }
        // the size of the largest set that holds an element of the bodies
        let mut largest = self.mesh.blocks.iter().map(|block| vec![0; block.len()]).collect::<Vec<_>>();
        for group in groups.iter().filter(|group| group.dimension == dimension) {
            for id in &group.elements {
                let most = &mut largest[id.block][id.index];
                *most = group.elements.len().max(*most);
            }
        }
        let is_in_larger =
            |group: &PhysicalGroup| group.elements.iter().all(|id| largest[id.block][id.index] > group.elements.len());
        let is_said = |index: usize, group: &PhysicalGroup| {
            by_name[&key(group)].iter().filter(|&&other| other != index).any(|&other_index| {
                let other = &groups[other_index];
                if other.dimension == group.dimension {
                    // gmsh names surface elements and their nodes alike
                    let same = match group.dimension == dimension {
                        true => other.elements == group.elements,
                        false => other.nodes == group.nodes,
                    };
                    other_index < index && same
                } else if group.dimension == 0 {
                    // CAE names a set of elements and that of their nodes alike
                    other.nodes == group.nodes
                } else {
                    // and a set of faces and that of the elements behind them
                    group.dimension == dimension && other.dimension + 1 == dimension && is_in_larger(group)
                }
            })
        };
        let said: Vec<bool> = groups.iter().enumerate().map(|(index, group)| is_said(index, group)).collect();
        let mut said = said.into_iter();
        groups.retain(|_| !said.next().unwrap_or(false));
        groups.sort_by_key(|group| group.dimension);
        let mut last = [0; 4];
        for group in groups {
            last[group.dimension] += 1;
            group.tag = last[group.dimension];
        }
        Ok(())
    }
}
