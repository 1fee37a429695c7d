//! A file from its header through its sections to a mesh.

use super::build::{Allowance, Name, by_entity, groups};
use super::cursor::{Cursor, Encoding, quoted};
use super::elements::{Degenerate, Listed};
use super::entities::Physical;
use super::nodes::NodeTable;
use super::{MshError, collect_v22, elements, entities, nodes};
use crate::fe::mesh::{ElementBlock, Mesh, MeshError, MeshNote, MeshNotes, MshFormat, MshVersion};
use crate::numerics::units::LengthUnit;
use std::collections::HashSet;
use std::path::Path;

impl Mesh {
    /// Reads a gmsh mesh, MSH 2.0 to 2.2, 4.0 or 4.1, ASCII or binary; `unit` is that of its coordinates.
    ///
    /// Sections that are not needed (`$Periodic`, `$NodeData`, comments, unknown ones) are passed over.
    /// An entity may belong to several physical groups; a group without a name is called by its tag.
    /// Parts of a partitioned mesh become one mesh; what lies between them is left out.
    /// Elements that MSH 2.2 repeats for every group of their entity become one element of all of them.
    /// Curve and surface elements of a solid body (curve elements of a plane one) that have a node twice are left out.
    /// Surfaces of a plane mesh whose elements all run clockwise are turned.
    ///
    /// # Errors
    /// [`MeshError::Read`] if the file cannot be read, [`MeshError::Gmsh`] with section, place, what was
    /// found and what was expected if its content cannot be used.
    pub fn read_gmsh(path: &Path, unit: LengthUnit) -> Result<Self, MeshError> {
        let bytes = crate::files::read(path).map_err(|cause| MeshError::Read { path: path.to_path_buf(), cause })?;
        Self::from_gmsh_bytes(bytes, path, unit)
    }

    /// The same from the content of a file; `path` is what messages call it.
    ///
    /// # Errors
    /// [`MeshError::Gmsh`], as from [`Self::read_gmsh`].
    pub fn from_gmsh_bytes(bytes: impl AsRef<[u8]>, path: &Path, unit: LengthUnit) -> Result<Self, MeshError> {
        let found = Found::read(bytes.as_ref(), unit.to_metres());
        // blocks and groups can have this room
        drop(bytes);
        let mesh = found.and_then(|found| found.into_mesh(path));
        let mut mesh = mesh.map_err(|fault| MeshError::Gmsh { path: path.to_path_buf(), fault })?;
        mesh.turn_clockwise();
        mesh.tell_what_is_beside();
        Ok(mesh)
    }
}

/// Sections read so far.
struct Found {
    format: MshFormat,
    file_bytes: usize,
    names: Option<Vec<Name>>,
    entities: Option<Physical>,
    nodes: Option<NodeTable>,
    elements: Option<Elements>,
}

enum Elements {
    /// MSH 4.
    Blocks(Vec<ElementBlock>, Degenerate),
    /// MSH 2.
    Listed(Listed),
}

impl Found {
    /// Reads a whole file; one of its units is so many metres.
    fn read(bytes: &[u8], metres: f64) -> Result<Self, MshError> {
        let mut cursor = Cursor::new(bytes);
        let format = header(&mut cursor)?;
        let mut found =
            Self { format, file_bytes: bytes.len(), names: None, entities: None, nodes: None, elements: None };
        loop {
            cursor.skip_blanks();
            let line = cursor.take_line();
            if line.is_empty() {
                return Ok(found);
            }
            cursor.section = section_name(&cursor, line)?;
            if found.section(&mut cursor, metres)? {
                cursor.close_section()?;
            } else {
                cursor.skip_section()?;
            }
        }
    }

    /// Reads a section up to its end; false if it is of no use.
    fn section(&mut self, cursor: &mut Cursor<'_>, metres: f64) -> Result<bool, MshError> {
        use MshVersion::{V40, V41};
        let version = self.format.version;
        let is_4 = matches!(version, V40 | V41);
        match cursor.section.as_str() {
            "PhysicalNames" => once(&mut self.names, cursor, names)?,
            "Entities" if is_4 => once(&mut self.entities, cursor, |c| entities::read(c, version))?,
            "PartitionedEntities" if is_4 => {
                let parts = entities::read_partitioned(cursor, version)?;
                self.entities.get_or_insert_default().add_parts(parts);
            }
            "GhostElements" if is_4 => entities::read_ghosts(cursor)?,
            "Nodes" if is_4 => once(&mut self.nodes, cursor, |c| nodes::read_blocks(c, version, metres))?,
            "Nodes" | "ParametricNodes" => once(&mut self.nodes, cursor, |c| nodes::read_list(c, metres))?,
            "Elements" => {
                let known = self.nodes.as_ref().ok_or_else(|| missing("Nodes", " before $Elements"))?;
                once(&mut self.elements, cursor, |c| match is_4 {
                    true => elements::read_blocks(c, version, &known.index)
                        .map(|(blocks, left)| Elements::Blocks(blocks, left)),
                    false => elements::read(c, &known.index).map(Elements::Listed),
                })?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Blocks and groups from what was read; nothing of the file is needed any more.
    fn into_mesh(self, path: &Path) -> Result<Mesh, MshError> {
        let hint = "; is the file complete?";
        let nodes = self.nodes.ok_or_else(|| missing("Nodes", hint))?;
        drop(nodes.index);
        let mut allowance = Allowance { file_bytes: self.file_bytes, listed: 0 };
        let mut told = Vec::new();
        let (blocks, memberships, degenerate) = match self.elements.ok_or_else(|| missing("Elements", hint))? {
            Elements::Blocks(mut blocks, degenerate) => {
                let entities = self.entities.unwrap_or_default();
                entities.join_parts(&mut blocks);
                let memberships = by_entity(&blocks, &entities, &mut allowance)?;
                (blocks, memberships, degenerate)
            }
            Elements::Listed(mut listed) => {
                if listed.partitions.iter().eq(&[1]) {
                    told.push(MeshNote::Sentence(
                        "all elements are of partition 1 of a mesh: if it has others, in files of their own, the body is not whole".to_owned(),
                    ));
                }
                let degenerate = std::mem::take(&mut listed.degenerate);
                let (blocks, memberships) = collect_v22::blocks(listed, &mut allowance)?;
                (blocks, memberships, degenerate)
            }
        };
        let left_out = degenerate.beside(&blocks)?;
        told.extend((!left_out.is_empty()).then_some(MeshNote::NodeTwice(left_out)));
        let names = self.names.unwrap_or_default();
        let groups = groups(nodes.tags.len(), &blocks, memberships, names, &mut allowance)?;
        let source = path.to_path_buf();
        let (nodes, node_tags) = (nodes.coordinates, nodes.tags);
        let notes = MeshNotes { told, ..MeshNotes::default() };
        Ok(Mesh { nodes, node_tags, blocks, groups, format: self.format, notes, source })
    }
}

/// A section that every mesh has is not there.
fn missing(section: &str, hint: &str) -> MshError {
    MshError(format!("the file has no ${section} section: expected one{hint}"))
}

/// Reads and keeps a section, or refuses the second of its name.
fn once<T>(
    slot: &mut Option<T>,
    cursor: &mut Cursor<'_>,
    read: impl FnOnce(&mut Cursor<'_>) -> Result<T, MshError>,
) -> Result<(), MshError> {
    if slot.is_some() {
        return Err(MshError(format!("{}: a second ${} section, expected one", cursor.place(), cursor.section)));
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

/// Reads from the start of the file to the end of `$MeshFormat`, and sets the cursor's encoding.
fn header(cursor: &mut Cursor<'_>) -> Result<MshFormat, MshError> {
    loop {
        cursor.skip_blanks();
        match cursor.take_line() {
            b"$MeshFormat" => break,
            b"$Comments" => {
                cursor.section = "Comments".to_owned();
                cursor.skip_section()?;
            }
            b"$NOD" | b"$PARA" => return Err(unknown_version("1.0")),
            line if line.starts_with(b"ISO-10303") => {
                return Err(MshError(
                    "a STEP part, not a mesh: mesh it with gmsh PART.step -3 -order 2 -o PART.msh".to_owned(),
                ));
            }
            line => {
                let found = quoted(line);
                return Err(MshError(format!("not a gmsh mesh: expected $MeshFormat at the start, found {found}")));
            }
        }
    }
    cursor.section = "MeshFormat".to_owned();
    let version = version(cursor)?;
    let binary = flag(cursor, "the file type, 0 (ASCII) or 1 (binary)", [b"0", b"1"])?;
    let size_bytes = match version {
        MshVersion::V41 if flag(cursor, "the size of size_t, 4 or 8", [b"4", b"8"])? => 8,
        MshVersion::V41 => 4,
        // the others give the size of a double here; 4.0 counts with long, 2 with int
        other => {
            flag(cursor, "the size of a double, 8", [b"8", b"8"])?;
            if other == MshVersion::V40 { 8 } else { 4 }
        }
    };
    cursor.take_line();
    if binary {
        cursor.encoding = Encoding::Binary { big_endian: big_endian(cursor)?, size_bytes };
    }
    cursor.close_section()?;
    Ok(MshFormat { version, binary })
}

fn version(cursor: &mut Cursor<'_>) -> Result<MshVersion, MshError> {
    match cursor.take_word() {
        b"" => Err(cursor.truncated("the version")),
        b"4.1" => Ok(MshVersion::V41),
        b"4" | b"4.0" => Ok(MshVersion::V40),
        b"2" | b"2.0" => Ok(MshVersion::V20),
        b"2.1" => Ok(MshVersion::V21),
        // some writers print all decimals
        b"2.2" | b"2.20000" | b"2.200000" => Ok(MshVersion::V22),
        other if other.iter().all(|b| b.is_ascii_digit() || *b == b'.') => {
            Err(unknown_version(&String::from_utf8_lossy(&other[..other.len().min(20)])))
        }
        other => Err(cursor.malformed("the version", other)),
    }
}

fn unknown_version(found: &str) -> MshError {
    let command = "gmsh IN.msh -save -format msh41 -o OUT.msh";
    MshError(format!("MSH version {found}: expected 2.0 to 2.2, 4.0 or 4.1; convert it with: {command}"))
}

/// Byte order from the integer 1 that begins the binary data.
fn big_endian(cursor: &mut Cursor<'_>) -> Result<bool, MshError> {
    const WHAT: &str = "the integer 1 that shows the byte order";
    let one = cursor.chunk().ok_or_else(|| cursor.truncated(WHAT))?;
    match (i32::from_le_bytes(one), i32::from_be_bytes(one)) {
        (1, _) => Ok(false),
        (_, 1) => Ok(true),
        _ => Err(cursor.malformed(WHAT, &one)),
    }
}

/// One of two words: false for the first, true for the second.
fn flag(cursor: &mut Cursor<'_>, what: &str, words: [&[u8]; 2]) -> Result<bool, MshError> {
    let word = cursor.take_word();
    if word.is_empty() {
        return Err(cursor.truncated(what));
    }
    let found = words.iter().position(|&known| known == word);
    found.map(|index| index == 1).ok_or_else(|| cursor.malformed(what, word))
}

/// Reads the lines `dimension tag "name"` after their number; a name may hold blanks and quotes. The first programs wrote no
/// dimension or -1. What follows the name is passed over, and so are names of tags that are not above 0.
fn names(cursor: &mut Cursor<'_>) -> Result<Vec<Name>, MshError> {
    const COUNT: &str = "the number of physical names";
    const LINE: &str = "dimension, tag and \"name\" of a physical group";
    cursor.skip_blanks();
    let line = cursor.take_line();
    if line.is_empty() {
        return Err(cursor.truncated(COUNT));
    }
    let declared = std::str::from_utf8(line).ok();
    let declared = declared.and_then(|text| text.trim().parse().ok()).ok_or_else(|| cursor.malformed(COUNT, line))?;
    const SHORTEST_LINE: &str = "1\"\"\n";
    let count = cursor.check_count(COUNT, declared, SHORTEST_LINE.len())?;
    let mut names = Vec::with_capacity(count);
    let mut seen = HashSet::with_capacity(count);
    for _ in 0..count {
        cursor.skip_blanks();
        let line = cursor.take_line();
        if line.is_empty() {
            return Err(cursor.truncated(LINE));
        }
        let name = name(line).ok_or_else(|| cursor.malformed(LINE, line))?;
        if name.tag < 1 {
            continue;
        }
        if !seen.insert((name.dimension, name.tag)) {
            let dimension = name.dimension.map_or(String::new(), |dimension| format!(" of dimension {dimension}"));
            return Err(cursor.malformed(format!("one name for group {}{dimension}", name.tag), line));
        }
        names.push(name);
    }
    Ok(names)
}

fn name(line: &[u8]) -> Option<Name> {
    let text = std::str::from_utf8(line).ok()?;
    let (numbers, quoted) = text.split_once('"')?;
    let (name, _) = quoted.rsplit_once('"')?;
    let numbers = numbers.split_ascii_whitespace().map(|number| number.parse().ok()).collect::<Option<Vec<i32>>>()?;
    let (dimension, tag) = match *numbers.as_slice() {
        [tag] => (-1, tag),
        [dimension, tag] => (dimension, tag),
        _ => return None,
    };
    let dimension = match dimension {
        -1 => None,
        0..=3 => Some(dimension as usize),
        _ => return None,
    };
    Some(Name { dimension, tag, name: name.to_owned() })
}
