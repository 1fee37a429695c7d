//! The sections of a file, one after the other.

use super::cursor::Cursor;
use super::names::{self, Names};
use super::walk::{self, ElementWalk, NodeWalk};
use super::{MshError, Place, header};

/// What a first pass over a file has found and checked.
pub(super) struct Scan {
    /// The sections that mshio is to read, end to end; it never sees the others.
    pub(super) body: Vec<u8>,
    /// Names of physical groups.
    pub(super) names: Names,
    /// Node tags in the order of the file (mshio drops them where their range is dense).
    pub(super) nodes: NodeWalk,
}

/// Walks through a whole file; whatever passes can be read by mshio without surprise.
pub(super) fn scan(bytes: &[u8]) -> Result<Scan, MshError> {
    let mut cursor = Cursor::new(bytes);
    let start = header::read(&mut cursor)?;
    let mut body = bytes[start..cursor.position()].to_vec();
    let mut names: Option<Names> = None;
    let mut entities: Option<()> = None;
    let mut nodes: Option<NodeWalk> = None;
    let mut elements: Option<ElementWalk> = None;
    loop {
        cursor.skip_blanks();
        let (start, place) = (cursor.position(), cursor.place());
        let line = cursor.take_line();
        if line.is_empty() {
            break;
        }
        let name = section_name(&cursor, line)?;
        cursor.section = name;
        match cursor.section.as_str() {
            "PhysicalNames" => once(&mut names, names::read(&mut cursor)?, &cursor, place)?,
            "Entities" => once(&mut entities, walk::entities(&mut cursor)?, &cursor, place)?,
            "Nodes" => once(&mut nodes, walk::nodes(&mut cursor)?, &cursor, place)?,
            "Elements" => {
                let known = nodes.as_ref().ok_or(MshError::MissingSection {
                    section: "Nodes",
                    hint: " before $Elements",
                })?;
                let found = walk::elements(&mut cursor, &known.index)?;
                once(&mut elements, found, &cursor, place)?;
            }
            "PartitionedEntities" => {
                return Err(MshError::Feature {
                    section: cursor.section,
                    place,
                    feature: "a partitioned mesh",
                    advice: "save it unpartitioned (Mesh.NbPartitions = 0, or UnpartitionMesh)",
                });
            }
            _ => {
                let name = cursor.section.clone();
                skip(&mut cursor, &name)?;
                continue;
            }
        }
        close(&mut cursor)?;
        if cursor.section != "PhysicalNames" {
            body.extend_from_slice(&bytes[start..cursor.position()]);
        }
    }
    let hint = "; is the file complete?";
    let missing = |section| MshError::MissingSection { section, hint };
    let nodes = nodes.ok_or_else(|| missing("Nodes"))?;
    elements.ok_or_else(|| missing("Elements"))?;
    Ok(Scan {
        body,
        names: names.unwrap_or_default(),
        nodes,
    })
}

/// Keeps a section, or refuses the second of its name.
fn once<T>(
    slot: &mut Option<T>,
    found: T,
    cursor: &Cursor<'_>,
    place: Place,
) -> Result<(), MshError> {
    match slot.replace(found) {
        None => Ok(()),
        Some(_) => Err(MshError::RepeatedSection {
            section: cursor.section.clone(),
            place,
        }),
    }
}

fn section_name(cursor: &Cursor<'_>, line: &[u8]) -> Result<String, MshError> {
    let name = line.strip_prefix(b"$").filter(|name| !name.is_empty());
    let name = name.map(|name| String::from_utf8_lossy(name).into_owned());
    name.ok_or_else(|| {
        let expected = format!("a section ($...) after $End{}", cursor.section);
        cursor.malformed(expected, line)
    })
}

/// Passes over a section that is not read, to the line after its end.
pub(super) fn skip(cursor: &mut Cursor<'_>, name: &str) -> Result<(), MshError> {
    cursor.section = name.to_owned();
    let end = format!("$End{name}");
    let starts_line = |rest: &[u8], at: usize| at == 0 || rest[at - 1] == b'\n';
    let rest = cursor.rest();
    let found = rest
        .windows(end.len())
        .enumerate()
        .find(|(at, window)| *window == end.as_bytes() && starts_line(rest, *at));
    match found {
        Some((at, _)) => {
            cursor.advance(at);
            cursor.take_line();
            Ok(())
        }
        None => Err(cursor.truncated(end)),
    }
}

/// The end of the section that the cursor is in.
pub(super) fn close(cursor: &mut Cursor<'_>) -> Result<(), MshError> {
    let end = format!("$End{}", cursor.section);
    cursor.skip_blanks();
    let word = cursor.take_word();
    if word == end.as_bytes() {
        match cursor.take_line() {
            b"" => Ok(()),
            after => Err(cursor.malformed(format!("nothing after {end}"), after)),
        }
    } else if cursor.rest().is_empty() && end.as_bytes().starts_with(word) {
        Err(cursor.truncated(end))
    } else {
        Err(cursor.malformed(end, word))
    }
}
