//! From what mshio has read to a [`Mesh`].

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use mshio::MshFile;

use super::names::Names;
use super::sections::Scan;
use super::{MshError, walk::NodeWalk};
use crate::mesh::{ElementBlock, ElementId, ElementKind, Entity, Mesh, PhysicalGroup};
use crate::units::LengthUnit;

type File = MshFile<u64, i32, f64>;

/// Values from mshio, tags and names from our own walk, lengths in metres.
pub(super) fn mesh(scan: Scan, path: &Path, unit: LengthUnit) -> Result<Mesh, MshError> {
    let file = mshio::parse_msh_bytes(&scan.body).map_err(|error| MshError::Reader {
        what: reader_message(&error),
    })?;
    let nodes = nodes(&file, unit.to_metres());
    if nodes.len() != scan.nodes.tags.len() {
        return Err(disagreement("nodes", scan.nodes.tags.len(), nodes.len()));
    }
    let blocks = blocks(&file, &scan.nodes)?;
    let groups = groups(&blocks, &physical_tags(&file), scan.names);
    Ok(Mesh {
        nodes,
        node_tags: scan.nodes.tags,
        blocks,
        groups,
        source: path.to_path_buf(),
    })
}

/// The library's own words, outermost first, without its dump of the file.
fn reader_message(error: &mshio::MshParserError<&[u8]>) -> String {
    let steps: Vec<String> = error
        .filter_msh_errors()
        .map(|(_, kind)| kind.to_string().trim_end_matches('.').to_owned())
        .collect();
    match steps.is_empty() {
        true => "the file cannot be parsed".to_owned(),
        false => steps.into_iter().rev().collect::<Vec<_>>().join(": "),
    }
}

fn disagreement(what: &str, walked: usize, read: usize) -> MshError {
    MshError::Reader {
        what: format!("{walked} {what} walked over, {read} read"),
    }
}

fn nodes(file: &File, metres: f64) -> Vec<[f64; 3]> {
    let blocks = file.data.nodes.iter().flat_map(|nodes| &nodes.node_blocks);
    blocks
        .flat_map(|block| &block.nodes)
        .map(|node| [node.x * metres, node.y * metres, node.z * metres])
        .collect()
}

fn blocks(file: &File, nodes: &NodeWalk) -> Result<Vec<ElementBlock>, MshError> {
    let mut blocks = Vec::new();
    let read = file.data.elements.iter().flat_map(|e| &e.element_blocks);
    for block in read {
        let kind = ElementKind::from_gmsh_type(block.element_type as i32);
        let kind = kind.ok_or_else(|| MshError::Reader {
            what: format!("element type {:?}", block.element_type),
        })?;
        let mut connectivity = Vec::with_capacity(block.elements.len() * kind.nodes());
        for tag in block.elements.iter().flat_map(|element| &element.nodes) {
            let index = nodes.index.get(tag).ok_or_else(|| MshError::Reader {
                what: format!("node {tag} of an element"),
            })?;
            connectivity.push(*index);
        }
        let walked = block.elements.len() * kind.nodes();
        if connectivity.len() != walked {
            return Err(disagreement("element nodes", walked, connectivity.len()));
        }
        blocks.push(ElementBlock {
            kind,
            tags: block.elements.iter().map(|e| e.element_tag).collect(),
            connectivity,
            entity: Entity {
                dimension: kind.dimension(),
                tag: block.entity_tag,
            },
        });
    }
    Ok(blocks)
}

/// Physical tags of each entity; gmsh writes a negative one for a reversed entity.
fn physical_tags(file: &File) -> HashMap<Entity, Vec<i32>> {
    let mut found = HashMap::new();
    let mut add = |dimension, tag, physical: &[i32]| {
        let tags = physical.iter().map(|tag| tag.saturating_abs()).collect();
        found.insert(Entity { dimension, tag }, tags);
    };
    if let Some(entities) = &file.data.entities {
        entities
            .points
            .iter()
            .for_each(|e| add(0, e.tag, &e.physical_tags));
        entities
            .curves
            .iter()
            .for_each(|e| add(1, e.tag, &e.physical_tags));
        entities
            .surfaces
            .iter()
            .for_each(|e| add(2, e.tag, &e.physical_tags));
        entities
            .volumes
            .iter()
            .for_each(|e| add(3, e.tag, &e.physical_tags));
    }
    found
}

/// Groups by dimension and tag: those that elements belong to and those that only have a name.
fn groups(
    blocks: &[ElementBlock],
    physical: &HashMap<Entity, Vec<i32>>,
    names: Names,
) -> Vec<PhysicalGroup> {
    let empty = |(dimension, tag): (usize, i32), name: String| PhysicalGroup {
        name,
        dimension,
        tag,
        nodes: Vec::new(),
        elements: Vec::new(),
    };
    let mut groups: BTreeMap<(usize, i32), PhysicalGroup> = names
        .into_iter()
        .map(|(key, name)| (key, empty(key, name)))
        .collect();
    for (number, block) in blocks.iter().enumerate() {
        for &tag in physical.get(&block.entity).into_iter().flatten() {
            let key = (block.entity.dimension, tag);
            let group = groups
                .entry(key)
                .or_insert_with(|| empty(key, tag.to_string()));
            group.nodes.extend_from_slice(&block.connectivity);
            let ids = (0..block.len()).map(|index| ElementId {
                block: number,
                index,
            });
            group.elements.extend(ids);
        }
    }
    for group in groups.values_mut() {
        group.nodes.sort_unstable();
        group.nodes.dedup();
    }
    groups.into_values().collect()
}
