//! A file from its header through its sections to a mesh.

use super::build::{Allowance, Name, by_entity, groups};
use super::cursor::{Cursor, Encoding, quoted};
use super::elements::Listed;
use super::entities::Physical;
use super::nodes::NodeTable;
use super::{MshError, collect_v22, elements, entities, nodes};
use crate::fe::mesh::{ElementBlock, Mesh, MeshError, MshFormat, MshVersion};
use crate::numerics::units::LengthUnit;
use std::collections::HashSet;
use std::path::Path;

impl Mesh {
    /// Reads a gmsh mesh, MSH 4.1 or 2.2, ASCII or binary; `unit` is that of its coordinates.
    ///
    /// Sections that are not needed (`$Periodic`, `$NodeData`, comments, unknown ones) are passed over.
    /// An entity may belong to several physical groups; a group without a name is called by its tag.
    /// Elements that MSH 2.2 repeats for every group of their entity become one element of all of them.
    /// Groups of a plane mesh whose elements all run clockwise are turned.
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
    V41(Vec<ElementBlock>),
    V22(Listed),
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
        use MshVersion::{V22, V41};
        let version = self.format.version;
        match (cursor.section.as_str(), version) {
            ("PhysicalNames", _) => once(&mut self.names, cursor, names)?,
            ("Entities", V41) => once(&mut self.entities, cursor, entities::read)?,
            ("Nodes", V41) => once(&mut self.nodes, cursor, |c| nodes::read_v41(c, metres))?,
            ("Nodes", V22) => once(&mut self.nodes, cursor, |c| nodes::read_v22(c, metres))?,
            ("Elements", _) => {
                let known = self.nodes.as_ref().ok_or_else(|| missing("Nodes", " before $Elements"))?;
                once(&mut self.elements, cursor, |c| match version {
                    V41 => elements::read_v41(c, &known.index).map(Elements::V41),
                    V22 => elements::read(c, &known.index).map(Elements::V22),
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

    /// Blocks and groups from what was read; nothing of the file is needed any more.
    fn into_mesh(self, path: &Path) -> Result<Mesh, MshError> {
        let hint = "; is the file complete?";
        let nodes = self.nodes.ok_or_else(|| missing("Nodes", hint))?;
        drop(nodes.index);
        let mut allowance = Allowance { file_bytes: self.file_bytes, listed: 0 };
        let (blocks, memberships) = match self.elements.ok_or_else(|| missing("Elements", hint))? {
            Elements::V41(blocks) => {
                let entities = self.entities.unwrap_or_default();
                let memberships = by_entity(&blocks, &entities, &mut allowance)?;
                (blocks, memberships)
            }
            Elements::V22(listed) => collect_v22::blocks(listed, &mut allowance)?,
        };
        let names = self.names.unwrap_or_default();
        let groups = groups(nodes.tags.len(), &blocks, memberships, names, &mut allowance)?;
        let source = path.to_path_buf();
        Ok(Mesh { nodes: nodes.coordinates, node_tags: nodes.tags, blocks, groups, format: self.format, source })
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
        // 2.2 counts with int and gives the size of a double here
        MshVersion::V22 => {
            flag(cursor, "the size of a double, 8", [b"8", b"8"])?;
            4
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
        b"2.2" => Ok(MshVersion::V22),
        other if other.iter().all(|b| b.is_ascii_digit() || *b == b'.') => {
            Err(unknown_version(&String::from_utf8_lossy(&other[..other.len().min(20)])))
        }
        other => Err(cursor.malformed("the version", other)),
    }
}

fn unknown_version(found: &str) -> MshError {
    let command = "gmsh IN.msh -save -format msh41 -o OUT.msh";
    MshError(format!("MSH version {found}: expected 4.1 or 2.2; convert it with: {command}"))
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

/// Reads the lines `dimension tag "name"` after their number; a name may hold blanks and quotes.
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
    const SHORTEST_LINE: &str = "0 1 \"\"\n";
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
        if !seen.insert((name.dimension, name.tag)) {
            let expected = format!("one name for group {} of dimension {}", name.tag, name.dimension);
            return Err(cursor.malformed(expected, line));
        }
        names.push(name);
    }
    Ok(names)
}

fn name(line: &[u8]) -> Option<Name> {
    let text = std::str::from_utf8(line).ok()?;
    let (numbers, quoted) = text.split_once('"')?;
    let name = quoted.strip_suffix('"')?;
    let mut numbers = numbers.split_ascii_whitespace();
    let dimension = numbers.next()?.parse().ok().filter(|&d: &u8| d <= 3)?;
    let tag = numbers.next()?.parse().ok().filter(|&tag: &i32| tag > 0)?;
    match numbers.next() {
        None => Some(Name { dimension, tag, name: name.to_owned() }),
        Some(_) => None,
    }
}
