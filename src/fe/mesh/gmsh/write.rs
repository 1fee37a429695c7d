//! MSH 4.1, binary: a mesh that another program has in memory becomes the bytes that the reader takes and checks.
//!
//! Format: gmsh reference manual, section "MSH file format". Entities have no geometry here: their boxes are zero.

use super::MshError;
use crate::fe::mesh::{ElementBlock, ElementKind, Entity};
use std::collections::BTreeMap;

/// A mesh by its parts, as a program in the same process has them; nothing is checked yet.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshParts {
    /// Coordinates (x, y, z) of each node, in the unit that the reader is told.
    pub nodes: Vec<[f64; 3]>,
    /// Tag of each node, unique, > 0.
    pub node_tags: Vec<u64>,
    /// Elements; `connectivity` has indices into `nodes`, in gmsh's order.
    pub blocks: Vec<ElementBlock>,
    /// Physical groups.
    pub groups: Vec<EntityGroup>,
}

/// A physical group by its entities.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EntityGroup {
    /// Its name; empty for one that has its tag alone.
    pub name: String,
    /// 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: usize,
    /// Its tag, unique within its dimension, > 0.
    pub tag: i32,
    /// Tags of its entities.
    pub entities: Vec<i32>,
}

/// Elements of one kind, and which of them belong to which named group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cells {
    /// Their kind.
    pub kind: ElementKind,
    /// Node indices from 0, `kind.nodes()` an element, gmsh's order.
    pub connectivity: Vec<usize>,
    /// Names of groups, and the elements in each by index from 0.
    pub groups: Vec<(String, Vec<usize>)>,
}

impl MeshParts {
    /// Makes entities of elements that belong to the same groups: nodes have the tags 1, 2, ..., elements too, block after block.
    /// An index that no element or node has is left for [`Self::to_msh`] to refuse.
    ///
    /// # Errors
    /// [`MshError`] for an element that lacks nodes, and for a group with an element that is not there.
    pub fn of_cells(nodes: Vec<[f64; 3]>, cells: &[Cells]) -> Result<Self, MshError> {
        let mut parts = Self { node_tags: (1..=nodes.len() as u64).collect(), nodes, ..Self::default() };
        let mut numbers: BTreeMap<(usize, &str), i32> = BTreeMap::new();
        let mut entities: BTreeMap<(usize, Vec<i32>), i32> = BTreeMap::new();
        let mut before = 0;
        for Cells { kind, connectivity, groups } in cells {
            let (dimension, count) = (kind.dimension(), connectivity.len() / kind.nodes());
            if connectivity.len() % kind.nodes() != 0 {
                let (kind, found, each) = (kind.name(), connectivity.len(), kind.nodes());
                return Err(MshError(format!("elements {kind} have {found} nodes: expected {each} each")));
            }
            let mut memberships: Vec<Vec<i32>> = vec![Vec::new(); count];
            for (name, members) in groups {
                let next = numbers.len() as i32 + 1;
                let number = *numbers.entry((dimension, name.as_str())).or_insert(next);
                for &member in members {
                    let own = memberships.get_mut(member).ok_or_else(|| {
                        let name_of_kind = kind.name();
                        MshError(format!(
                            "group \"{name}\" has element {member} of the {count} {name_of_kind}: expected one below {count}"
                        ))
                    })?;
                    own.push(number);
                }
            }
            let mut by_entity: BTreeMap<i32, ElementBlock> = BTreeMap::new();
            for (index, (mut own, nodes)) in
                memberships.into_iter().zip(connectivity.chunks_exact(kind.nodes())).enumerate()
            {
                own.sort_unstable();
                own.dedup();
                let next = entities.len() as i32 + 1;
                let tag = *entities.entry((dimension, own)).or_insert(next);
                let entity = Entity { dimension, tag };
                let empty = || ElementBlock { kind: *kind, tags: Vec::new(), connectivity: Vec::new(), entity };
                let block = by_entity.entry(tag).or_insert_with(empty);
                block.tags.push((before + index + 1) as u64);
                block.connectivity.extend_from_slice(nodes);
            }
            before += count;
            parts.blocks.extend(by_entity.into_values());
        }
        parts.groups = numbers
            .iter()
            .map(|(&(dimension, name), &tag)| {
                let own = entities.iter().filter(|((of, groups), _)| *of == dimension && groups.contains(&tag));
                EntityGroup {
                    name: name.to_owned(),
                    dimension,
                    tag,
                    entities: own.map(|(_, &entity)| entity).collect(),
                }
            })
            .collect();
        Ok(parts)
    }

    /// The bytes of an MSH file, which [`Mesh::from_gmsh_bytes`](crate::fe::mesh::Mesh::from_gmsh_bytes) reads and checks.
    ///
    /// # Errors
    /// [`MshError`] for what no file can say: a node index beyond the nodes, tags and coordinates of different number, a name with a
    /// line break.
    pub fn to_msh(&self) -> Result<Vec<u8>, MshError> {
        self.check()?;
        let mut to = Bytes(Vec::with_capacity(32 * self.nodes.len() + 1024));
        to.text("$MeshFormat\n4.1 1 8\n");
        to.int(1);
        to.text("\n$EndMeshFormat\n$PhysicalNames\n");
        let named: Vec<&EntityGroup> = self.groups.iter().filter(|group| !group.name.is_empty()).collect();
        to.text(&format!("{}\n", named.len()));
        for group in named {
            to.text(&format!("{} {} \"{}\"\n", group.dimension, group.tag, group.name));
        }
        to.text("$EndPhysicalNames\n$Entities\n");
        self.entities(&mut to);
        to.text("\n$EndEntities\n$Nodes\n");
        let tags = [self.node_tags.iter().min(), self.node_tags.iter().max()].map(|tag| tag.copied().unwrap_or(0));
        let first = self.blocks.first().map_or(Entity { dimension: 0, tag: 1 }, |block| block.entity);
        to.sizes([1, self.nodes.len() as u64, tags[0], tags[1]]);
        to.entity(first);
        to.int(0);
        to.sizes([self.nodes.len() as u64]);
        to.sizes(self.node_tags.iter().copied());
        self.nodes.iter().flatten().for_each(|&x| to.real(x));
        to.text("\n$EndNodes\n$Elements\n");
        let all = || self.blocks.iter().flat_map(|block| &block.tags);
        let range = [all().min(), all().max()].map(|tag| tag.copied().unwrap_or(0));
        to.sizes([self.blocks.len() as u64, all().count() as u64, range[0], range[1]]);
        for block in &self.blocks {
            to.entity(block.entity);
            to.int(block.kind.gmsh_type());
            to.sizes([block.tags.len() as u64]);
            for (&tag, nodes) in block.tags.iter().zip(block.elements()) {
                to.sizes([tag]);
                to.sizes(nodes.iter().map(|&node| self.node_tags[node]));
            }
        }
        to.text("\n$EndElements\n");
        Ok(to.0)
    }

    fn check(&self) -> Result<(), MshError> {
        let count = self.nodes.len();
        if self.node_tags.len() != count {
            return Err(MshError(format!("{count} nodes have {} tags: expected one each", self.node_tags.len())));
        }
        for block in &self.blocks {
            let (kind, each) = (block.kind.name(), block.kind.nodes());
            if block.connectivity.len() != each * block.tags.len() {
                let found = block.connectivity.len();
                let elements = block.tags.len();
                return Err(MshError(format!("{elements} {kind} have {found} nodes: expected {each} each")));
            }
            let (own, of_kind) = (block.entity.dimension, block.kind.dimension());
            if own != of_kind {
                return Err(MshError(format!("{kind} lie on an entity of dimension {own}: expected {of_kind}")));
            }
            if let Some(beyond) = block.connectivity.iter().find(|&&node| node >= count) {
                return Err(MshError(format!("an element {kind} has node {beyond}: expected an index below {count}")));
            }
        }
        match self.groups.iter().find(|group| group.name.contains(['\n', '\r'])) {
            Some(group) => Err(MshError(format!("the group {:?} has a line break in its name", group.name))),
            None => Ok(()),
        }
    }

    /// `$Entities`: those that have elements or groups, each with its groups.
    fn entities(&self, to: &mut Bytes) {
        let mut groups: [BTreeMap<i32, Vec<i32>>; 4] = Default::default();
        for Entity { dimension, tag } in self.blocks.iter().map(|block| block.entity) {
            groups[dimension].entry(tag).or_default();
        }
        for group in self.groups.iter().filter(|group| group.dimension < 4) {
            for &entity in &group.entities {
                groups[group.dimension].entry(entity).or_default().push(group.tag);
            }
        }
        to.sizes(groups.each_ref().map(|own| own.len() as u64));
        for (dimension, own) in groups.iter().enumerate() {
            for (&tag, physical) in own {
                to.int(tag);
                let corners = if dimension == 0 { 3 } else { 6 };
                (0..corners).for_each(|_| to.real(0.0));
                to.sizes([physical.len() as u64]);
                physical.iter().for_each(|&tag| to.int(tag));
                if dimension > 0 {
                    to.sizes([0]);
                }
            }
        }
    }
}

/// A file in memory, little-endian.
struct Bytes(Vec<u8>);

impl Bytes {
    fn text(&mut self, text: &str) {
        self.0.extend_from_slice(text.as_bytes());
    }

    fn int(&mut self, number: i32) {
        self.0.extend_from_slice(&number.to_le_bytes());
    }

    fn real(&mut self, number: f64) {
        self.0.extend_from_slice(&number.to_le_bytes());
    }

    fn sizes(&mut self, numbers: impl IntoIterator<Item = u64>) {
        numbers.into_iter().for_each(|number| self.0.extend_from_slice(&number.to_le_bytes()));
    }

    fn entity(&mut self, Entity { dimension, tag }: Entity) {
        self.int(dimension as i32);
        self.int(tag);
    }
}
