//! The sections of a file, one after the other.

use super::build::Content;
use super::cursor::Cursor;
use super::elements_v22::Listed;
use super::entities::Physical;
use super::membership::{self, Allowance};
use super::names::{self, Name};
use super::nodes::{self, NodeTable};
use super::{MshError, collect_v22, elements, elements_v22, entities, header};
use crate::fe::mesh::{ElementBlock, MshFormat, MshVersion};

/// Sections read so far.
#[derive(Default)]
pub(super) struct Found {
    file_bytes: usize,
    names: Option<Vec<Name>>,
    entities: Option<Physical>,
    nodes: Option<NodeTable>,
    elements: Option<Elements>,
}

enum Elements {
    V41(Vec<ElementBlock>),
    V22(Listed),
}

/// Reads a whole file; one of its units is so many metres.
pub(super) fn read(bytes: &[u8], metres: f64) -> Result<(MshFormat, Found), MshError> {
    let mut cursor = Cursor::new(bytes);
    let format = header::read(&mut cursor)?;
    let mut found = Found { file_bytes: bytes.len(), ..Found::default() };
    loop {
        cursor.skip_blanks();
        let line = cursor.take_line();
        if line.is_empty() {
            break;
        }
        cursor.section = section_name(&cursor, line)?;
        match found.section(&mut cursor, format.version, metres)? {
            true => cursor.close_section()?,
            false => {
                let name = cursor.section.clone();
                cursor.skip_section(&name)?;
            }
        }
    }
    Ok((format, found))
}

impl Found {
    /// Reads a section up to its end; false if it is of no use.
    fn section(&mut self, cursor: &mut Cursor<'_>, version: MshVersion, metres: f64) -> Result<bool, MshError> {
        use MshVersion::{V22, V41};
        match (cursor.section.as_str(), version) {
            ("PhysicalNames", _) => once(&mut self.names, cursor, names::read)?,
            ("Entities", V41) => once(&mut self.entities, cursor, entities::read)?,
            ("Nodes", V41) => once(&mut self.nodes, cursor, |c| nodes::read_v41(c, metres))?,
            ("Nodes", V22) => once(&mut self.nodes, cursor, |c| nodes::read_v22(c, metres))?,
            ("Elements", _) => {
                let known = self
                    .nodes
                    .as_ref()
                    .ok_or(MshError::MissingSection { section: "Nodes", hint: " before $Elements" })?;
                once(&mut self.elements, cursor, |c| match version {
                    V41 => elements::read_v41(c, &known.index).map(Elements::V41),
                    V22 => elements_v22::read(c, &known.index).map(Elements::V22),
                })?;
            }
            ("ParametricNodes", V22) => return Err(nodes::parametric(cursor)),
            ("PartitionedEntities", V41) => {
                return Err(cursor.feature(
                    "a partitioned mesh",
                    "save it unpartitioned (Mesh.NbPartitions = 0, or UnpartitionMesh)",
                ));
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Blocks and which groups they belong to; nothing of the file is needed any more.
    pub(super) fn complete(self, format: MshFormat) -> Result<Content, MshError> {
        let hint = "; is the file complete?";
        let missing = |section| MshError::MissingSection { section, hint };
        let nodes = self.nodes.ok_or_else(|| missing("Nodes"))?;
        let mut allowance = Allowance::new(self.file_bytes);
        let (blocks, memberships) = match self.elements.ok_or_else(|| missing("Elements"))? {
            Elements::V41(blocks) => {
                let entities = self.entities.unwrap_or_default();
                let memberships = membership::by_entity(&blocks, &entities, &mut allowance)?;
                (blocks, memberships)
            }
            Elements::V22(listed) => collect_v22::blocks(listed, &mut allowance)?,
        };
        Ok(Content { format, nodes, blocks, memberships, names: self.names.unwrap_or_default(), allowance })
    }
}

/// Reads and keeps a section, or refuses the second of its name.
fn once<T>(
    slot: &mut Option<T>,
    cursor: &mut Cursor<'_>,
    read: impl FnOnce(&mut Cursor<'_>) -> Result<T, MshError>,
) -> Result<(), MshError> {
    if slot.is_some() {
        return Err(MshError::RepeatedSection { section: cursor.section.clone(), place: cursor.place() });
    }
    *slot = Some(read(cursor)?);
    Ok(())
}

fn section_name(cursor: &Cursor<'_>, line: &[u8]) -> Result<String, MshError> {
    const LONGEST: usize = 100;
    let name = line.strip_prefix(b"$").filter(|name| (1..=LONGEST).contains(&name.len()));
    let name = name.map(|name| String::from_utf8_lossy(name).into_owned());
    name.ok_or_else(|| {
        let expected = format!("a section ($...) after $End{}", cursor.section);
        cursor.malformed(expected, line)
    })
}
