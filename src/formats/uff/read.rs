//! Reads mode shapes: datasets 55, with nodes from 2411, 781 or 15 and the unit of length from 164.
//!
//! One dataset 55: a mode, or results of another kind, which are passed over.

use super::super::mode_shapes::real_part;
use super::super::{FormatError, ModeShapes};
use super::binary::read_binary;
use super::cursor::{Cursor, Line};
use super::function::{read_units, skip_dataset};
use crate::files::{Fault, bytes_of};
use std::collections::{HashMap, HashSet};
use std::f64::consts::TAU;
use std::path::Path;

/// What a file has gathered so far.
#[derive(Default)]
struct Content {
    points: HashMap<u64, [f64; 3]>,
    /// Nodes whose displacements are along axes of their own system, with the line that says so.
    own_axes: Vec<(u64, i64, u64)>,
    /// Coordinate systems that turn the axes.
    turned: HashSet<i64>,
    /// File's units of length in a metre.
    per_metre: Option<f64>,
    modes: Vec<Mode>,
}

/// Reads the mode shapes of a universal file.
///
/// - Modes are datasets 55 of analysis type 2 (normal), 3 or 7 (complex) with three translations a node, or three
///   translations and three rotations, which are left out. Others, and all datasets of other numbers, are passed over.
/// - Complex shapes are turned by the angle that makes their imaginary part least, then their real part is taken; their
///   frequency is `|lambda| / 2 pi`. Of a pair of conjugates the one with the negative imaginary part is left out.
/// - A node that a mode does not mention does not move in it, as the format has it.
/// - Points are there if the file has a node for each label, in metres if the file has units (dataset 164).
///
/// # Errors
/// [`FormatError`] with file and line, what was found and what was expected; without modes; and for displacements along axes
/// that datasets 18, 2420 turn against the global ones.
pub fn read_modes_uff(path: &Path) -> Result<ModeShapes, FormatError> {
    modes_from_bytes(&bytes_of(path)?, path)
}

/// As [`read_modes_uff`], of a file that is in memory; `path` is for messages.
///
/// # Errors
/// As [`read_modes_uff`].
pub fn modes_from_bytes(bytes: &[u8], path: &Path) -> Result<ModeShapes, FormatError> {
    let content = read(bytes).map_err(|fault| fault.of(path))?;
    if content.modes.is_empty() {
        let expected = "mode shapes (dataset 55 of analysis type 2, 3 or 7 with displacements in space)";
        return Err(Fault::new(expected, "none").of(path).into());
    }
    let modes = content.mode_shapes();
    modes.check().map_err(|fault| fault.of(path))?;
    Ok(modes)
}

fn read(bytes: &[u8]) -> Result<Content, Fault> {
    let mut cursor = Cursor::new(bytes);
    let mut content = Content::default();
    while let Some(head) = cursor.next_dataset() {
        content.dataset(&mut cursor, &head)?;
    }
    let mentioned: HashSet<u64> =
        content.modes.iter().flat_map(|mode| mode.displacements.iter().map(|&(tag, _)| tag)).collect();
    let mut own_axes = content.own_axes.iter();
    let own = own_axes.find(|(tag, system, _)| content.turned.contains(system) && mentioned.contains(tag));
    match own {
        Some(&(tag, system, line)) => {
            let found = format!("node {tag} in the turned coordinate system {system}");
            Err(Fault::new("displacements along the global axes", found).line(line))
        }
        None => Ok(content),
    }
}

/// Reads label and type of a coordinate system and the line where they stand, passes over the name; `None` at the line that
/// ends a dataset.
fn next_system(cursor: &mut Cursor, expected: &'static str) -> Result<Option<(i64, i64, Line)>, Fault> {
    let Some(line) = cursor.entry(expected)? else {
        return Ok(None);
    };
    let &[label, kind, ..] = line.integers(expected)?.as_slice() else {
        return Err(line.fault(expected));
    };
    cursor.expect("the name of a coordinate system")?;
    Ok(Some((label, kind, line)))
}

impl Content {
    /// Reads what follows the line with a dataset's number, to the line that ends it.
    fn dataset(&mut self, cursor: &mut Cursor, head: &Line) -> Result<(), Fault> {
        match head.text.split_ascii_whitespace().next() {
            Some("2411" | "781") => self.nodes_on_two_lines(cursor),
            Some("15") => self.nodes_on_one_line(cursor),
            Some("164") => {
                let [per_metre] = read_units(cursor, "units of length in a metre, > 0")?;
                self.per_metre = Some(per_metre);
                Ok(())
            }
            Some("2420") => self.systems(cursor),
            Some("18") => self.old_systems(cursor),
            Some("55") => {
                self.modes.extend(read_mode(cursor)?);
                Ok(())
            }
            Some("58b") => read_binary(cursor, head).map(|_| ()),
            _ => skip_dataset(cursor, head),
        }
    }

    fn node(&mut self, line: &Line, numbers: &[i64], point: [f64; 3]) -> Result<(), Fault> {
        const NODE: &str = "label, two coordinate systems and colour of a node";
        let &[label, _, system, ..] = numbers else {
            return Err(line.fault(NODE));
        };
        let tag = u64::try_from(label).map_err(|_| line.fault(NODE))?;
        self.own_axes.push((tag, system, line.number));
        self.points.insert(tag, point);
        Ok(())
    }

    fn nodes_on_two_lines(&mut self, cursor: &mut Cursor) -> Result<(), Fault> {
        while let Some(line) = cursor.entry("a node or -1")? {
            let numbers = line.integers("label, two coordinate systems and colour of a node")?;
            let point = cursor.reals(3, 25, "three coordinates of a node")?;
            self.node(&line, &numbers, [point[0], point[1], point[2]])?;
        }
        Ok(())
    }

    fn nodes_on_one_line(&mut self, cursor: &mut Cursor) -> Result<(), Fault> {
        const NODE: &str = "label, two coordinate systems, colour and three coordinates of a node";
        while let Some(line) = cursor.entry("a node or -1")? {
            // 4I10, 3E13.5
            let columns = line.text.split_at_checked(40);
            let words: Vec<&str> = line.text.split_ascii_whitespace().collect();
            let (numbers, point) = match (words.as_slice(), columns) {
                ([_, _, _, _, ..], _) if words.len() == 7 => (words[..4].join(" "), words[4..].join(" ")),
                (_, Some((numbers, point))) => (numbers.to_owned(), point.to_owned()),
                _ => return Err(line.fault(NODE)),
            };
            let part = |text: String| Line { number: line.number, text };
            let numbers = part(numbers).integers(NODE)?;
            let point = part(point).reals(13, NODE)?;
            let [x, y, z] = point[..] else {
                return Err(line.fault(NODE));
            };
            self.node(&line, &numbers, [x, y, z])?;
        }
        Ok(())
    }

    /// Dataset 2420: part, name, then for each system its label, its name and four lines of a matrix, of which the first
    /// three turn the axes.
    fn systems(&mut self, cursor: &mut Cursor) -> Result<(), Fault> {
        const SYSTEM: &str = "label, type and colour of a coordinate system";
        cursor.expect_text("the part of the coordinate systems")?;
        cursor.expect("the part's name")?;
        while let Some((label, kind, _)) = next_system(cursor, SYSTEM)? {
            let mut row = || cursor.reals(3, 25, "three components of a coordinate system");
            let matrix = [row()?, row()?, row()?, row()?].concat();
            // Axes written with few digits are still the global ones.
            let unit = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
            let same = matrix.iter().zip(unit).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-5);
            if kind != 0 || !same {
                self.turned.insert(label);
            }
        }
        Ok(())
    }

    /// Dataset 18: label, type, reference, colour, method; name; six and three numbers. All count as turned unless their
    /// numbers are origin, a point on +x and a point in the xz plane of the global axes.
    fn old_systems(&mut self, cursor: &mut Cursor) -> Result<(), Fault> {
        const SYSTEM: &str = "label and type of a coordinate system";
        while let Some((label, kind, line)) = next_system(cursor, SYSTEM)? {
            let points = cursor.reals(9, 13, "nine numbers of a coordinate system")?;
            let [ox, oy, oz, ax, ay, az, _, py, _] = points[..] else {
                return Err(line.fault(SYSTEM));
            };
            let length = (ax - ox).abs().max(f64::MIN_POSITIVE);
            // Points written with few digits are still on the global axes.
            let small = |value: f64| value.abs() <= 1e-5 * length;
            let same = ax > ox && small(ay - oy) && small(az - oz) && small(py - oy);
            if kind != 0 || !same {
                self.turned.insert(label);
            }
        }
        Ok(())
    }

    /// Gives every mode the same nodes, in the order of first mention.
    fn mode_shapes(self) -> ModeShapes {
        let mut places: HashMap<u64, usize> = HashMap::new();
        let mut tags = Vec::new();
        for &(tag, _) in self.modes.iter().flat_map(|mode| &mode.displacements) {
            places.entry(tag).or_insert_with(|| {
                tags.push(tag);
                tags.len() - 1
            });
        }
        let shape = |mode: &Mode| {
            let mut shape = vec![0.0; 3 * tags.len()];
            for (tag, displacement) in &mode.displacements {
                if let Some(&place) = places.get(tag) {
                    shape[3 * place..][..3].copy_from_slice(displacement);
                }
            }
            shape
        };
        let per_metre = self.per_metre.unwrap_or(1.0);
        let point = |tag: &u64| Some(self.points.get(tag)?.map(|value| value / per_metre));
        ModeShapes {
            frequencies_hz: self.modes.iter().map(|mode| mode.frequency_hz).collect(),
            points: tags.iter().map(point).collect(),
            shapes: self.modes.iter().map(shape).collect(),
            node_tags: Some(tags),
            directions: None,
        }
    }
}

/// A mode as it stands in the file, complex shapes already made real.
#[derive(Debug)]
pub(super) struct Mode {
    pub(super) frequency_hz: f64,
    pub(super) displacements: Vec<(u64, [f64; 3])>,
}

/// Most values a node that are believed.
const MOST_VALUES: i64 = 1000;

/// Reads a dataset 55 after its number, to the line that ends it; `None` if it holds no displacements of a mode.
pub(super) fn read_mode(cursor: &mut Cursor) -> Result<Option<Mode>, Fault> {
    const DEFINITION: &str = "six whole numbers that define the data";
    for _ in 0..5 {
        cursor.expect("five identification lines")?.within("five identification lines")?;
    }
    let line = cursor.expect_text(DEFINITION)?;
    let &[_, analysis, characteristic, _, data, values, ..] = line.integers(DEFINITION)?.as_slice() else {
        return Err(line.fault(DEFINITION));
    };
    let moves = matches!(characteristic, 2 | 3) || (characteristic == 0 && matches!(values, 3 | 6));
    if !matches!(analysis, 2 | 3 | 7) || !moves {
        cursor.skip()?;
        return Ok(None);
    }
    if !(3..=MOST_VALUES).contains(&values) {
        return Err(line.fault("3 or 6 values a node (sixth number)"));
    }
    let complex = match data {
        2 | 4 => false,
        5 | 6 => true,
        _ => return Err(line.fault("data type 2 or 4 (real), 5 or 6 (complex) (fifth number)")),
    };
    let eigenvalue = specific(cursor)?;
    let step = if complex { 2 } else { 1 };
    let width = if data == 2 || data == 5 { 13 } else { 25 };
    let (mut shape, mut seen, mut tags) = (Vec::new(), HashSet::new(), Vec::new());
    while let Some(line) = cursor.entry("a node or -1")? {
        const NODE: &str = "the label of a node, once a mode";
        let label = line.integers(NODE)?.first().copied().unwrap_or(-1);
        let tag = u64::try_from(label).map_err(|_| line.fault(NODE))?;
        if !seen.insert(tag) {
            return Err(line.fault(NODE));
        }
        let numbers = cursor.reals(values as usize * step, width, "values at a node")?;
        tags.push(tag);
        shape.push([0, 1, 2].map(|axis| [numbers[axis * step], if complex { numbers[axis * step + 1] } else { 0.0 }]));
    }
    let frequency_hz = match (analysis, eigenvalue.as_slice()) {
        (2, &[frequency, ..]) => frequency,
        // one of a pair of conjugates
        (3 | 7, &[_, imaginary, ..]) if imaginary < 0.0 => return Ok(None),
        (3 | 7, &[real, imaginary, ..]) => real.hypot(imaginary) / TAU,
        _ => return Err(line.fault("a mode with its frequency or eigenvalue")),
    };
    let shape = real_part(shape.as_flattened());
    let (shape, _) = shape.as_chunks::<3>();
    Ok(Some(Mode { frequency_hz, displacements: tags.into_iter().zip(shape.iter().copied()).collect() }))
}

/// Records 7 and 8: how many whole and real numbers, the whole ones, the real ones. Returns the real ones.
fn specific(cursor: &mut Cursor) -> Result<Vec<f64>, Fault> {
    const WHOLE: &str = "the mode's whole numbers";
    const COUNTS: &str = "how many whole numbers (1 to 10) and real numbers (1 to 12) the mode has";
    let line = cursor.expect_text(COUNTS)?;
    let counts = line.integers(COUNTS)?;
    let (whole, real) = match counts[..] {
        [whole, real, ..] if (1..=10).contains(&whole) && (1..=12).contains(&real) => (whole, real),
        _ => return Err(line.fault(COUNTS)),
    };
    let mut missing = whole - (counts.len() - 2) as i64;
    while missing > 0 {
        let line = cursor.expect_text(WHOLE)?.within(WHOLE)?;
        missing -= line.integers(WHOLE)?.len() as i64;
    }
    cursor.reals(real as usize, 13, "the mode's real numbers, its frequency among them")
}
