//! CAD entities as groups: "surface 7" and "surfaces 12, 13" are what lies on them, if no physical group is called so.

use super::{ElementId, Mesh, MshVersion, PhysicalGroup};
use std::collections::HashSet;

/// What gmsh calls entities of dimension 0 to 3.
const KINDS: [&str; 4] = ["point", "curve", "surface", "volume"];

/// Entities that an error lists.
const LISTED: usize = 20;

/// The name of entities of one dimension.
pub(crate) fn entity_name(dimension: usize, tags: &[i32]) -> String {
    let list: Vec<String> = tags.iter().map(i32::to_string).collect();
    let plural = if tags.len() == 1 { "" } else { "s" };
    format!("{}{plural} {}", KINDS[dimension.min(3)], list.join(", "))
}

/// Dimension and tags in the name of entities; `None` for another name.
fn entities_of(name: &str) -> Option<(usize, Vec<i32>)> {
    let (kind, list) = name.trim().split_once(' ')?;
    let kind = kind.to_ascii_lowercase();
    let kind = kind.strip_suffix('s').unwrap_or(&kind);
    let dimension = KINDS.iter().position(|known| *known == kind)?;
    let tags = list.split(',').map(|tag| tag.trim().parse().ok());
    Some((dimension, tags.collect::<Option<_>>()?))
}

impl Mesh {
    /// Adds a group, of tag 0, for each of the names that means CAD entities ("surface 7", "volumes 1, 2") which all have
    /// elements. A physical group of the same name stands before it.
    pub fn add_entity_groups<'a>(&mut self, names: impl IntoIterator<Item = &'a str>) {
        for name in names {
            if self.groups.iter().any(|group| group.name == name) {
                continue;
            }
            let Some((dimension, tags)) = entities_of(name) else {
                continue;
            };
            let known = self.entities(|_| true, dimension);
            if tags.iter().any(|tag| known.binary_search(tag).is_err()) {
                continue;
            }
            let elements = |tag: &i32| self.entity_elements(dimension, *tag);
            let mut elements: Vec<ElementId> = tags.iter().flat_map(elements).collect();
            elements.sort_unstable();
            elements.dedup();
            let of_element = |id: &ElementId| self.blocks[id.block].nodes_of(id.index).iter().copied();
            let mut nodes: Vec<usize> = elements.iter().flat_map(of_element).collect();
            nodes.sort_unstable();
            nodes.dedup();
            self.groups.push(PhysicalGroup { name: name.to_owned(), dimension, tag: 0, nodes, elements });
        }
        self.groups.sort_by_key(|group| (group.dimension, group.tag));
    }

    /// The elements on an entity, in the order of the mesh.
    pub(super) fn entity_elements(&self, dimension: usize, tag: i32) -> impl Iterator<Item = ElementId> + '_ {
        let own = self.blocks.iter().enumerate();
        let own = own.filter(move |(_, block)| block.kind.dimension() == dimension && block.entity.tag == tag);
        own.flat_map(|(block, list)| (0..list.len()).map(move |index| ElementId { block, index }))
    }

    /// Tags of the entities of a dimension that have elements, none of which is in a group of that dimension; sorted.
    pub(crate) fn entities_without_group(&self, dimension: usize) -> Vec<i32> {
        let mut grouped = vec![false; self.blocks.len()];
        for group in self.groups.iter().filter(|group| group.dimension == dimension) {
            group.elements.iter().for_each(|id| grouped[id.block] = true);
        }
        let with = self.entities(|block| !grouped[block], dimension);
        // an entity has a block for each kind of its elements
        let some = self.entities(|block| grouped[block], dimension);
        with.into_iter().filter(|tag| some.binary_search(tag).is_err()).collect()
    }

    /// Tags of the entities of a dimension that have elements; sorted. An input file has none: its tags are made up.
    pub(crate) fn entities(&self, asked: impl Fn(usize) -> bool, dimension: usize) -> Vec<i32> {
        let blocks = self.blocks.iter().enumerate().filter(|_| self.format.version != MshVersion::Inp);
        let own = blocks.filter(|(place, block)| block.kind.dimension() == dimension && asked(*place));
        let mut tags: Vec<i32> =
            own.filter(|(_, block)| !block.is_empty()).map(|(_, block)| block.entity.tag).collect();
        tags.sort_unstable();
        tags.dedup();
        tags
    }

    /// Names that a case may give: those of the groups, and of the bodies and their surfaces that are in none.
    pub(crate) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::with_capacity(self.groups.len());
        let mut known = HashSet::new();
        names.extend(self.groups.iter().filter(|group| known.insert(&group.name)).map(|group| group.name.clone()));
        let dimension = self.dimension();
        for dimension in [dimension, dimension.saturating_sub(1)] {
            let tags = self.entities_without_group(dimension).into_iter().take(LISTED);
            names.extend(tags.map(|tag| entity_name(dimension, &[tag])));
        }
        names
    }
}

#[cfg(test)]
mod tests {
    use super::{entities_of, entity_name};
    use crate::fe::mesh::{Mesh, MeshError};
    use crate::numerics::units::LengthUnit;
    use std::path::Path;

    #[test]
    fn entities_are_named_as_gmsh_does() {
        for (name, expected) in [
            ("surface 7", Some((2, vec![7]))),
            ("Surfaces 12,13", Some((2, vec![12, 13]))),
            ("volume 1", Some((3, vec![1]))),
            ("curves 2, 1", Some((1, vec![2, 1]))),
            ("surface", None),
            ("surface seven", None),
            ("surface 7,", None),
            ("face 7", None),
        ] {
            assert_eq!(entities_of(name), expected, "{name}");
        }
        assert_eq!(entity_name(2, &[12, 13]), "surfaces 12, 13");
    }

    /// A square without any physical group: surface 4, its lower side curve 1, its left one curve 2.
    const SQUARE: &str =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes
$Elements\n3\n1 1 2 0 1 1 2\n2 1 2 0 2 4 1\n3 3 2 0 4 1 2 3 4\n$EndElements\n";

    #[test]
    fn an_entity_is_a_group_under_its_name() -> Result<(), MeshError> {
        let mut mesh = Mesh::from_gmsh_bytes(SQUARE.as_bytes(), Path::new("a.msh"), LengthUnit::Metre)?;
        assert_eq!(mesh.names(), ["surface 4", "curve 1", "curve 2"]);
        mesh.add_entity_groups(["surface 4", "curves 1, 2", "curve 3", "curves 1, 3", "feet"]);
        let names: Vec<&str> = mesh.groups.iter().map(|group| group.name.as_str()).collect();
        assert_eq!(names, ["curves 1, 2", "surface 4"]);
        assert_eq!(mesh.group("curves 1, 2")?.nodes, [0, 1, 3]);
        assert_eq!(mesh.body("surface 4")?.elements.len(), 1);
        Ok(())
    }
}
