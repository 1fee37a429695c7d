//! `$Entities` and `$PartitionedEntities` of MSH 4: which physical groups an entity belongs to, and which entity it is a
//! part of.
//!
//! Every number is walked over first, which checks it and knows its place; of MSH 4.1 mshio then reads the values, from
//! small files made of a few entities each.

use super::MshError;
use super::cursor::{Cursor, Encoding};
use super::nodes;
use super::numbers::Item;
use crate::fe::mesh::{ElementBlock, Entity, MshVersion};
use std::collections::BTreeSet;
use std::fmt;

/// Entities that belong to physical groups.
#[derive(Default)]
pub(super) struct Physical {
    /// Entity and where its groups begin in `tags`, sorted by entity.
    entities: Vec<(Entity, usize, usize)>,
    tags: Vec<i32>,
    /// Parts of a partitioned mesh and what they are cut from, sorted.
    parents: Vec<(Entity, Entity)>,
}

/// How a mesh is partitioned.
#[derive(Default)]
struct Cut {
    /// Parts and what they are cut from.
    parts: Vec<(Entity, Entity)>,
    /// Partitions in which the highest dimension so far is cut.
    own: BTreeSet<i32>,
}

impl Physical {
    /// Tags of the groups of an entity, > 0.
    pub(super) fn of(&self, entity: Entity) -> impl Iterator<Item = i32> + '_ {
        let start = self.entities.partition_point(|(other, ..)| *other < entity);
        let own = self.entities[start..].iter();
        own.take_while(move |(other, ..)| *other == entity).flat_map(|&(_, first, end)| &self.tags[first..end]).copied()
    }

    /// Takes the parts of a partitioned mesh in.
    pub(super) fn add_parts(&mut self, parts: Vec<(Entity, Entity)>) {
        self.parents.extend(parts);
        self.parents.sort_unstable();
    }

    /// Gives the blocks of parts to the entity that was cut. Blocks between parts (a part of an entity of a higher dimension)
    /// are no geometry of the body and go.
    pub(super) fn join_parts(&self, blocks: &mut Vec<ElementBlock>) {
        blocks.retain_mut(|block| {
            let start = self.parents.partition_point(|(part, _)| *part < block.entity);
            match self.parents.get(start).filter(|(part, _)| *part == block.entity) {
                Some((part, parent)) if part.dimension != parent.dimension => return false,
                Some((_, parent)) => block.entity = *parent,
                None => {}
            }
            true
        });
    }

    fn add(&mut self, dimension: usize, tag: i32, physical: &[i32]) {
        let first = self.tags.len();
        // gmsh writes a negative tag for a reversed entity
        let tags = physical.iter().map(|tag| tag.saturating_abs());
        self.tags.extend(tags.filter(|&tag| tag > 0));
        if self.tags.len() > first {
            let entity = Entity { dimension, tag };
            self.entities.push((entity, first, self.tags.len()));
        }
    }

    /// Reads entities of one dimension with mshio.
    fn parse(&mut self, file: &[u8]) -> Result<(), MshError> {
        let parsed = mshio::parse_msh_bytes(file).map_err(|error| {
            MshError(format!("{}: expected what the MSH 4.1 format prescribes", reader_message(&error)))
        })?;
        if let Some(entities) = &parsed.data.entities {
            for point in &entities.points {
                self.add(0, point.tag, &point.physical_tags);
            }
            for curve in &entities.curves {
                self.add(1, curve.tag, &curve.physical_tags);
            }
            for surface in &entities.surfaces {
                self.add(2, surface.tag, &surface.physical_tags);
            }
            for volume in &entities.volumes {
                self.add(3, volume.tag, &volume.physical_tags);
            }
        }
        Ok(())
    }
}

/// How many entities mshio is given at once: it takes up to twenty times the length of a list.
const PORTION: usize = 64;

pub(super) fn read(cursor: &mut Cursor<'_>, version: MshVersion) -> Result<Physical, MshError> {
    let counts = counts(cursor, version)?;
    let mut found = Physical::default();
    for (dimension, mut left) in counts.into_iter().enumerate() {
        while left > 0 && version == MshVersion::V41 {
            let portion = left.min(PORTION);
            let start = cursor.position;
            for _ in 0..portion {
                walk(cursor, version, dimension, None)?;
            }
            let content = &cursor.bytes[start..cursor.position];
            found.parse(&alone(cursor.encoding, dimension, portion, content))?;
            left -= portion;
        }
        for _ in 0..left {
            let (tag, physical) = walk(cursor, version, dimension, None)?;
            found.add(dimension, tag, &physical);
        }
    }
    found.entities.sort_unstable();
    Ok(found)
}

/// Parts of a partitioned mesh, and what they are cut from.
pub(super) fn read_partitioned(
    cursor: &mut Cursor<'_>,
    version: MshVersion,
) -> Result<Vec<(Entity, Entity)>, MshError> {
    let partitions = cursor.size("the number of partitions")?;
    for _ in 0..cursor.count("the number of ghost entities", Item::new(0, 2, 0))? {
        cursor.int("the tag of a ghost entity")?;
        cursor.int("its partition")?;
    }
    let mut cut = Cut::default();
    for (dimension, count) in counts(cursor, version)?.into_iter().enumerate() {
        if count > 0 {
            cut.own.clear();
        }
        for _ in 0..count {
            walk(cursor, version, dimension, Some(&mut cut))?;
        }
    }
    if (cut.own.len() as u64) < partitions {
        return Err(one_partition(cursor, &cut.own, format_args!("{partitions}")));
    }
    Ok(cut.parts)
}

/// A file of one partition, which is no whole body.
pub(super) fn one_partition(cursor: &Cursor<'_>, own: &BTreeSet<i32>, all: fmt::Arguments<'_>) -> MshError {
    let own: Vec<String> = own.iter().take(5).map(i32::to_string).collect();
    cursor.fault(format_args!(
        "the file holds partition {} of {all}, which is not the whole body: expected all of them in one file; save the mesh again with gmsh, without -part_split",
        own.join(", ")
    ))
}

/// Elements of other partitions that touch those of the file: in a file of all partitions each sees its neighbours.
pub(super) fn read_ghosts(cursor: &mut Cursor<'_>) -> Result<(), MshError> {
    let (mut owners, mut viewers) = (BTreeSet::new(), BTreeSet::new());
    let partition = "the partition of a ghost element";
    for _ in 0..cursor.count("the number of ghost elements", Item::new(2, 2, 0))? {
        cursor.size("the tag of a ghost element")?;
        owners.insert(cursor.int(partition)?);
        for _ in 0..cursor.count("the number of partitions that see it", Item::new(0, 1, 0))? {
            viewers.insert(cursor.int(partition)?);
        }
    }
    match owners.is_subset(&viewers) {
        true => Ok(()),
        false => Err(one_partition(cursor, &viewers, format_args!("a mesh of several"))),
    }
}

fn counts(cursor: &mut Cursor<'_>, version: MshVersion) -> Result<[usize; 4], MshError> {
    const COUNTS: [&str; 4] =
        ["the number of points", "the number of curves", "the number of surfaces", "the number of volumes"];
    let mut counts = [0; 4];
    for (dimension, (count, what)) in counts.iter_mut().zip(COUNTS).enumerate() {
        *count = cursor.count(what, smallest(version, dimension))?;
    }
    Ok(counts)
}

/// A file of `$MeshFormat` and `$Entities` with some entities of one dimension.
fn alone(encoding: Encoding, dimension: usize, count: usize, content: &[u8]) -> Vec<u8> {
    let mut counts = [0; 4];
    counts[dimension] = count as u64;
    let [points, curves, surfaces, volumes] = counts;
    let (start, numbers) = match encoding {
        Encoding::Ascii => {
            let mut numbers = format!("{points} {curves} {surfaces} {volumes}").into_bytes();
            // not every blank is one to mshio
            for word in content.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
                numbers.push(b' ');
                numbers.extend_from_slice(word);
            }
            (b"$MeshFormat\n4.1 0 8".to_vec(), numbers)
        }
        Encoding::Binary { big_endian, size_bytes } => {
            let order = |mut bytes: Vec<u8>| {
                if big_endian {
                    bytes.reverse();
                }
                bytes
            };
            let mut start = format!("$MeshFormat\n4.1 1 {size_bytes}\n").into_bytes();
            start.extend(order(1_i32.to_le_bytes().to_vec()));
            let size = |count: u64| order(count.to_le_bytes()[..size_bytes].to_vec());
            let mut numbers: Vec<u8> = counts.into_iter().flat_map(size).collect();
            numbers.extend_from_slice(content);
            (start, numbers)
        }
    };
    let middle = b"\n$EndMeshFormat\n$Entities\n".as_slice();
    let end = b"\n$EndEntities\n".as_slice();
    [start.as_slice(), middle, numbers.as_slice(), end].concat()
}

/// The library's own words, outermost first, without its dump of the file.
fn reader_message(error: &mshio::MshParserError<&[u8]>) -> String {
    let steps: Vec<String> =
        error.filter_msh_errors().map(|(_, kind)| kind.to_string().trim_end_matches('.').to_owned()).collect();
    match steps.is_empty() {
        true => "the section $Entities cannot be parsed".to_owned(),
        false => steps.into_iter().rev().collect::<Vec<_>>().join(": "),
    }
}

/// Walks over an entity: with `parts` its parent, which is added there, and its partitions; then its box, its physical tags
/// and its boundary. Returns its tag and the physical ones. An entity without points has an empty box, from the largest
/// number to the smallest.
fn walk(
    cursor: &mut Cursor<'_>,
    version: MshVersion,
    dimension: usize,
    cut: Option<&mut Cut>,
) -> Result<(i32, Vec<i32>), MshError> {
    const TAG: &str = "the tag of an entity";
    let tag = cursor.int(TAG)?;
    if let Some(Cut { parts, own }) = cut {
        let parent = Entity { dimension: nodes::dimension(cursor)?, tag: cursor.int(TAG)? };
        parts.push((Entity { dimension, tag }, parent));
        let partitions = list(cursor, "the number of partitions", "a partition")?;
        if parent.dimension == dimension {
            own.extend(partitions);
        }
    }
    for _ in 0..smallest(version, dimension).floats {
        if cursor.float("a coordinate of an entity")?.is_nan() {
            let found = &cursor.bytes[cursor.mark..cursor.position];
            return Err(cursor.malformed("a coordinate of an entity", found));
        }
    }
    let physical = list(cursor, "the number of physical tags", "a physical tag")?;
    if dimension > 0 {
        list(cursor, "the number of bounding entities", "the tag of a bounding entity")?;
    }
    Ok((tag, physical))
}

/// A list of tags after its length.
fn list(cursor: &mut Cursor<'_>, length: &'static str, item: &'static str) -> Result<Vec<i32>, MshError> {
    (0..cursor.count(length, Item::new(0, 1, 0))?).map(|_| cursor.int(item)).collect()
}

/// An entity without physical tags and boundary. MSH 4.0 gives points a box too.
fn smallest(version: MshVersion, dimension: usize) -> Item {
    match (dimension, version) {
        (0, MshVersion::V41) => Item::new(1, 1, 3),
        (0, _) => Item::new(1, 1, 6),
        _ => Item::new(2, 1, 6),
    }
}
