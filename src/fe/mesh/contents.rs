//! What a mesh is made of: nodes, blocks of elements, physical groups, and how its file was written.
//!
//! Plane meshes that are seen from behind.

use super::{DeckMaterial, DeckSupport, ElementKind, MeshError};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

/// A checked mesh in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Coordinates (x, y, z) of each node, m.
    pub nodes: Vec<[f64; 3]>,
    /// gmsh's tag of each node, unique, > 0.
    pub node_tags: Vec<u64>,
    /// Elements, one kind and one geometrical entity a block, in the order of the file.
    pub blocks: Vec<ElementBlock>,
    /// Physical groups, by dimension, then by tag.
    pub groups: Vec<PhysicalGroup>,
    /// How the file was written.
    pub format: MshFormat,
    /// What of the file is not in the mesh.
    pub notes: MeshNotes,
    /// The file that it was read from.
    pub source: PathBuf,
}

/// A geometrical entity of the CAD model behind the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct Entity {
    /// 0 point, 1 curve, 2 surface, 3 volume.
    pub dimension: usize,
    /// gmsh's tag, unique within its dimension.
    pub tag: i32,
}

/// Which element of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct ElementId {
    /// Index into the mesh's blocks.
    pub block: usize,
    /// Index into the block's elements.
    pub index: usize,
}

/// Elements of one kind on one entity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ElementBlock {
    /// Their kind.
    pub kind: ElementKind,
    /// gmsh's tag of each element, unique in the mesh, > 0.
    pub tags: Vec<u64>,
    /// Node indices from 0, `kind.nodes()` an element, gmsh's order.
    pub connectivity: Vec<usize>,
    /// The entity that they lie on.
    pub entity: Entity,
}

impl ElementBlock {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.tags.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.tags.is_empty()
    }

    /// Node indices of each element in turn.
    pub fn elements(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        self.connectivity.chunks_exact(self.kind.nodes())
    }

    /// Node indices of one element, if there is one of this index.
    pub fn element(&self, index: usize) -> Option<&[usize]> {
        self.elements().nth(index)
    }

    /// Node indices of an element that is known to exist.
    pub(crate) fn nodes_of(&self, index: usize) -> &[usize] {
        let nodes = self.kind.nodes();
        &self.connectivity[index * nodes..][..nodes]
    }
}

/// A named part of a mesh: gmsh's physical group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhysicalGroup {
    /// Its name; the tag in digits if gmsh gave it none.
    pub name: String,
    /// 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: usize,
    /// gmsh's tag, unique within its dimension, > 0; 0 for CAD entities that a case names.
    pub tag: i32,
    /// Indices of its nodes, sorted, each once.
    pub nodes: Vec<usize>,
    /// Its elements, in the order of the mesh.
    pub elements: Vec<ElementId>,
}

/// A curve's or a surface's element with a node twice. The reader leaves it out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeftOut {
    /// gmsh's tag.
    pub tag: u64,
    /// 1 or 2.
    pub dimension: usize,
    /// Tag of the CAD entity that it lies on.
    pub entity: i32,
    /// Tag of its physical group; 0: none, or that of its entity.
    pub physical: i32,
}

/// What was changed or left out and matters to results. It is written as a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MeshNote {
    /// Elements below the body's dimension that have a node twice, at least one.
    NodeTwice(Vec<LeftOut>),
    /// Anything else.
    Sentence(String),
}

/// What of a file was changed, or is not in the mesh.
#[derive(Debug, Clone, PartialEq, Default, Serialize, JsonSchema)]
pub struct MeshNotes {
    /// What was changed or left out and matters to results, a sentence each.
    #[schemars(with = "Vec<String>")]
    pub told: Vec<MeshNote>,
    /// Node sets that hold whole faces and other nodes, and are points for that, a sentence each.
    pub as_points: Vec<String>,
    /// Keywords of an Abaqus or CalculiX file that are passed over, the first 64 of them; most belong to the case.
    pub passed_over: Vec<String>,
    /// Materials of such a file.
    pub materials: Vec<DeckMaterial>,
    /// Groups that `*BOUNDARY` of such a file names.
    pub supports: Vec<DeckSupport>,
    /// What such a file holds and no support can say, and which step counts, a sentence each.
    pub not_supports: Vec<String>,
}

impl MeshNotes {
    /// The file's material of a group of the bodies.
    pub(crate) fn material_of(&self, group: &str) -> Option<&DeckMaterial> {
        self.materials.iter().find(|material| material.groups.iter().any(|own| own == group))
    }
}

/// Version of gmsh's MSH format, or the other format that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
pub enum MshVersion {
    /// 2.0, whose groups may be named without a dimension.
    #[serde(rename = "2.0")]
    V20,
    /// 2.1.
    #[serde(rename = "2.1")]
    V21,
    /// 2.2, which gmsh wrote until version 3 and many programs still write.
    #[serde(rename = "2.2")]
    V22,
    /// 4.0, which gmsh 4.0 wrote.
    #[serde(rename = "4.0")]
    V40,
    /// 4.1, which gmsh has written since version 4.1.
    #[serde(rename = "4.1")]
    V41,
    /// No MSH: an input file of Abaqus or CalculiX.
    #[serde(rename = "inp")]
    Inp,
}

/// Version and encoding of an MSH file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, JsonSchema)]
pub struct MshFormat {
    /// Version of the format.
    #[schemars(with = "String")]
    pub version: MshVersion,
    /// Binary numbers, not decimal digits.
    pub binary: bool,
}

impl fmt::Display for MshVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::V20 => "2.0",
            Self::V21 => "2.1",
            Self::V22 => "2.2",
            Self::V40 => "4.0",
            Self::V41 => "4.1",
            Self::Inp => "inp",
        })
    }
}

impl fmt::Display for MshFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.version == MshVersion::Inp {
            return f.write_str("Abaqus or CalculiX input");
        }
        let encoding = if self.binary { "binary" } else { "ASCII" };
        write!(f, "MSH {} {encoding}", self.version)
    }
}

impl Mesh {
    /// Highest dimension of an element, 0 to 3; 0 without elements.
    pub(crate) fn dimension(&self) -> usize {
        self.blocks.iter().map(|block| block.kind.dimension()).max().unwrap_or(0)
    }

    /// A value for each element of each block.
    pub(crate) fn for_each_element<T: Clone>(&self, value: T) -> Vec<Vec<T>> {
        self.blocks.iter().map(|block| vec![value.clone(); block.len()]).collect()
    }

    /// The elements of one dimension (0 points to 3 volumes), in the order of the mesh.
    pub(crate) fn element_ids(&self, dimension: usize) -> impl Iterator<Item = ElementId> + '_ {
        let blocks = self.blocks.iter().enumerate();
        blocks
            .filter(move |(_, block)| block.kind.dimension() == dimension)
            .flat_map(|(block, list)| (0..list.len()).map(move |index| ElementId { block, index }))
    }

    /// The group of this name that a bore, support, sensor or link means; case matters. Of several it is that of surfaces
    /// (of curves in a plane mesh), then the next below.
    ///
    /// # Errors
    /// [`MeshError::Group`] with the nearest name and all names if there is none, and if it has no elements;
    /// [`MeshError::AmbiguousGroup`] if several groups of the dimension share the name.
    pub fn group(&self, name: &str) -> Result<&PhysicalGroup, MeshError> {
        self.group_below(name, self.dimension().saturating_sub(1))
    }

    /// The same for a part: of several groups that of the body's own dimension.
    ///
    /// # Errors
    /// As [`Mesh::group`].
    pub fn body(&self, name: &str) -> Result<&PhysicalGroup, MeshError> {
        self.group_below(name, self.dimension())
    }

    /// Of the groups of a name that with the highest dimension up to `highest`, else the lowest above.
    fn group_below(&self, name: &str, highest: usize) -> Result<&PhysicalGroup, MeshError> {
        let path = self.source.display();
        let (word, program) = match self.format.version {
            MshVersion::Inp => ("set or surface", "the file"),
            _ => ("physical group", "gmsh"),
        };
        let mut named: Vec<&PhysicalGroup> = self.groups.iter().filter(|group| group.name == name).collect();
        if named.is_empty() {
            return Err(MeshError::Group(format!("{path} has no {word} \"{name}\"; {}", self.known_groups(name))));
        }
        named.retain(|group| !group.elements.is_empty());
        let rank = |group: &PhysicalGroup| (group.dimension > highest, highest.abs_diff(group.dimension));
        let best = named.iter().map(|group| rank(group)).min();
        named.retain(|group| Some(rank(group)) == best);
        match named.as_slice() {
            [] => {
                Err(MeshError::Group(format!("{path}: the {word} \"{name}\" has no elements: expected at least one")))
            }
            [group] => Ok(group),
            several => {
                let tags: Vec<String> =
                    several.iter().map(|group| format!("({}, {})", group.dimension, group.tag)).collect();
                Err(MeshError::AmbiguousGroup(format!(
                    "{path} has {} {word}s \"{name}\" (dimension, tag: {}): rename all but one in {program}",
                    several.len(),
                    tags.join(", ")
                )))
            }
        }
    }

    /// The names of all groups in words, that with the fewest edits (Damerau-Levenshtein, case ignored) from the one given
    /// first.
    fn known_groups(&self, name: &str) -> String {
        let wanted = name.to_lowercase();
        let edits = |known: &&PhysicalGroup| strsim::damerau_levenshtein(&known.name.to_lowercase(), &wanted);
        let Some(nearest) = self.groups.iter().min_by_key(edits) else {
            return match self.format.version {
                MshVersion::Inp => "it has none at all (add *NSET, *ELSET or *SURFACE)".to_owned(),
                _ => "it has none at all (plummer inspect lists what a name such as \"surface 7\" may mean)".to_owned(),
            };
        };
        let names: Vec<String> = self.groups.iter().map(|group| format!("\"{}\"", group.name)).collect();
        format!("nearest is \"{}\", it has {}", nearest.name, names.join(", "))
    }
}

/// Farthest that a node of a plane mesh may lie from its plane z = const, relative to its size: gmsh writes 16 digits, and
/// what is off by more is meant.
const PLANE: f64 = 1e-9;

impl Mesh {
    /// Turns the plane elements that run clockwise, as far as all elements that share their surface and their first
    /// physical group do, and tells it: gmsh makes such surfaces where their curves were drawn clockwise or extruded
    /// backwards. Where elements of one surface run both ways, some are folded, and all stay as they are.
    pub(super) fn turn_clockwise(&mut self) {
        if self.dimension() != 2 || self.node_off_plane().is_some() {
            return;
        }
        let mut first_group = self.for_each_element(None);
        for (number, group) in self.groups.iter().enumerate().filter(|(_, group)| group.dimension == 2) {
            for id in &group.elements {
                first_group[id.block][id.index].get_or_insert(number);
            }
        }
        let together = |id: ElementId| (self.blocks[id.block].entity, first_group[id.block][id.index]);
        let mut all_clockwise = BTreeMap::new();
        for id in self.element_ids(2) {
            *all_clockwise.entry(together(id)).or_insert(true) &= self.signed_area(id) < 0.0;
        }
        let turned: Vec<ElementId> = self.element_ids(2).filter(|&id| all_clockwise[&together(id)]).collect();
        let Some(first) = turned.first().map(|id| self.blocks[id.block].tags[id.index]) else {
            return;
        };
        for id in &turned {
            let ElementBlock { kind, connectivity, .. } = &mut self.blocks[id.block];
            let nodes = &mut connectivity[id.index * kind.nodes()..][..kind.nodes()];
            // from the first corner on the other way round; a node in the middle of the face stays the last
            let (corners, middles) = nodes.split_at_mut(kind.corners());
            corners[1..].reverse();
            middles[..kind.middle_edges().len()].reverse();
        }
        self.notes.told.push(MeshNote::Sentence(format!(
            "{} elements of the plane mesh ran clockwise and were turned round, the first is element {first}",
            turned.len()
        )));
    }

    /// The first node that is off the plane z = const of the others, if there is one.
    pub(crate) fn node_off_plane(&self) -> Option<usize> {
        let first = self.nodes.first()?[2];
        let sides = self.nodes.iter().map(|node| node[0].abs().max(node[1].abs()));
        let size = sides.fold(0.0, f64::max);
        let off = |node: &[f64; 3]| (node[2] - first).abs() > PLANE * size;
        self.nodes.iter().position(off)
    }

    /// Area of the polygon of an element's corners, positive counter-clockwise, m^2.
    fn signed_area(&self, id: ElementId) -> f64 {
        let block = &self.blocks[id.block];
        let corners = &block.nodes_of(id.index)[..block.kind.corners()];
        let [x, y, _] = self.nodes[corners[0]];
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        // from the first corner on: far from the origin nothing is lost
        let twice: f64 = sides
            .map(|(&a, &b)| {
                let [a, b] = [self.nodes[a], self.nodes[b]].map(|node| [node[0] - x, node[1] - y]);
                a[0] * b[1] - a[1] * b[0]
            })
            .sum();
        0.5 * twice
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from behind, every kind has its measure again, the nodes behind the corners in their places.
    #[test]
    fn clockwise_elements_are_turned() {
        for kind in ElementKind::all().filter(|kind| kind.dimension() == 2) {
            let nodes: Vec<[f64; 3]> = kind.natural_nodes().iter().map(|&[x, y, _]| [-x, y, 0.0]).collect();
            let block = ElementBlock {
                kind,
                tags: vec![1],
                connectivity: (0..kind.nodes()).collect(),
                entity: Entity { dimension: 2, tag: 1 },
            };
            let mut mesh = Mesh {
                node_tags: (1..=nodes.len() as u64).collect(),
                nodes,
                blocks: vec![block],
                groups: Vec::new(),
                format: MshFormat { version: MshVersion::V41, binary: false },
                source: PathBuf::from("behind.msh"),
                notes: MeshNotes::default(),
            };
            mesh.turn_clockwise();
            let coords: Vec<[f64; 3]> = mesh.blocks[0].connectivity.iter().map(|&node| mesh.nodes[node]).collect();
            let quality = crate::fe::element::continuum::quality(kind, &coords).unwrap();
            assert!((quality.scaled_jacobian - 1.0).abs() < 1e-12, "{kind:?}: {quality:?}");
        }
    }

    #[test]
    fn formats_are_named_as_gmsh_names_them() {
        let format = MshFormat { version: MshVersion::V22, binary: true };
        assert_eq!(format.to_string(), "MSH 2.2 binary");
        assert_eq!(MshVersion::V41.to_string(), "4.1");
    }
}
