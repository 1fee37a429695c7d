//! `$Entities` of MSH 4.1: which physical groups an entity belongs to.

use super::MshError;
use super::cursor::Cursor;
use super::numbers::Item;
use crate::fe::mesh::Entity;

/// Entities that belong to physical groups.
#[derive(Default)]
pub(super) struct Physical {
    /// Entity and where its groups begin and end in `tags`, sorted by entity.
    entities: Vec<(Entity, usize, usize)>,
    tags: Vec<i32>,
}

impl Physical {
    /// Tags of the groups of an entity, > 0.
    pub(super) fn of(&self, entity: Entity) -> impl Iterator<Item = i32> + '_ {
        let start = self.entities.partition_point(|(other, ..)| *other < entity);
        let own = self.entities[start..].iter();
        own.take_while(move |(other, ..)| *other == entity).flat_map(|&(_, first, end)| &self.tags[first..end]).copied()
    }

    /// Reads an entity with its box, its physical tags and its boundary.
    fn add(&mut self, cursor: &mut Cursor<'_>, dimension: usize) -> Result<(), MshError> {
        let entity = Entity { dimension, tag: cursor.int("the tag of an entity")? };
        for _ in 0..smallest(dimension).floats {
            if !cursor.float("a coordinate of an entity")?.is_finite() {
                let found = &cursor.bytes[cursor.mark..cursor.position];
                return Err(cursor.malformed("a finite coordinate of an entity", found));
            }
        }
        let first = self.tags.len();
        for _ in 0..cursor.count("the number of physical tags", Item::new(0, 1, 0))? {
            // gmsh writes a negative tag for a reversed entity
            let tag = cursor.int("a physical tag")?.saturating_abs();
            self.tags.extend((tag > 0).then_some(tag));
        }
        if self.tags.len() > first {
            self.entities.push((entity, first, self.tags.len()));
        }
        if dimension > 0 {
            for _ in 0..cursor.count("the number of bounding entities", Item::new(0, 1, 0))? {
                cursor.int("the tag of a bounding entity")?;
            }
        }
        Ok(())
    }
}

pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Physical, MshError> {
    const COUNTS: [&str; 4] =
        ["the number of points", "the number of curves", "the number of surfaces", "the number of volumes"];
    let mut counts = [0; 4];
    for (dimension, (count, what)) in counts.iter_mut().zip(COUNTS).enumerate() {
        *count = cursor.count(what, smallest(dimension))?;
    }
    let mut found = Physical::default();
    for (dimension, count) in counts.into_iter().enumerate() {
        for _ in 0..count {
            found.add(cursor, dimension)?;
        }
    }
    found.entities.sort_unstable();
    Ok(found)
}

/// An entity without physical tags and boundary.
fn smallest(dimension: usize) -> Item {
    match dimension {
        0 => Item::new(1, 1, 3),
        _ => Item::new(2, 1, 6),
    }
}
