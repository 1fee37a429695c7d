//! Reads a table of mode shapes.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;

use ::csv::{Position, Reader, ReaderBuilder, StringRecord, Trim};

use super::super::mode_shapes::real_part;
use super::super::{FormatError, ModeShapes};
use crate::files::{Fault, bytes_of};

/// The header of a table by points.
pub(super) const BY_POINT: [&str; 8] = ["mode", "frequency_hz", "x", "y", "z", "ux", "uy", "uz"];
/// The header of a table by labels.
pub(super) const BY_NODE: [&str; 6] = ["mode", "frequency_hz", "node", "ux", "uy", "uz"];

/// The headers of tables with one direction a place; `imaginary` may follow.
pub(super) const POINT_AXIS: [&str; 7] = ["mode", "frequency_hz", "x", "y", "z", "direction", "value"];
pub(super) const NODE_AXIS: [&str; 5] = ["mode", "frequency_hz", "node", "direction", "value"];
const IMAGINARY: &str = "imaginary";

/// Line of a record: the library tells where it began to look, which may be comments and blank lines before.
pub(in crate::formats) fn line_of(text: &str, record: &StringRecord) -> u64 {
    let Some(place) = record.position() else {
        return 0;
    };
    let rest = text.get(place.byte() as usize..).unwrap_or_default();
    let passed = rest.lines().take_while(|line| line.is_empty() || line.starts_with('#'));
    place.line() + passed.count() as u64
}

/// A table without header: comments begin with `#`, cells are trimmed, rows may differ in length.
pub(in crate::formats) fn table_of(text: &str, separator: u8) -> Reader<&[u8]> {
    let mut builder = ReaderBuilder::new();
    builder.delimiter(separator).comment(Some(b'#')).trim(Trim::All).flexible(true).has_headers(false);
    builder.from_reader(text.as_bytes())
}

/// The first line that is neither blank nor a comment.
pub(in crate::formats) fn first_line(text: &str) -> &str {
    text.lines().find(|line| !line.starts_with('#') && !line.trim().is_empty()).unwrap_or_default()
}

/// Where a displacement is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Node(u64),
    Point([f64; 3]),
}

/// Where a displacement is, and along what; `None`: in space.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Spot {
    place: Place,
    direction: Option<[f64; 3]>,
}

/// A mode as gathered so far.
struct Mode {
    number: u64,
    frequency_hz: f64,
    /// Line of its first row.
    line: u64,
    /// Real and imaginary parts, three a row.
    shape: Vec<[f64; 2]>,
}

/// Reads the mode shapes of a table; the format is that of [the module](super).
///
/// # Errors
/// [`FormatError::File`] with file and line, what was found and what was expected.
pub fn read_modes_csv(path: &Path) -> Result<ModeShapes, FormatError> {
    modes_from_bytes(&bytes_of(path)?, path)
}

/// As [`read_modes_csv`], of a file that is in memory; `path` is for messages.
pub(super) fn modes_from_bytes(bytes: &[u8], path: &Path) -> Result<ModeShapes, FormatError> {
    // Comments may be in any encoding; numbers and header are ASCII.
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let read = read(text).and_then(|modes| modes.check().map(|()| modes));
    Ok(read.map_err(|fault| fault.of(path))?)
}

/// A line of the table with the text of its numbers.
struct Row<'a> {
    line: u64,
    record: &'a StringRecord,
    decimal_comma: bool,
}

impl Row<'_> {
    fn fault(&self, expected: impl Into<Cow<'static, str>>, found: impl std::fmt::Display) -> Fault {
        Fault::new(expected, format!("\"{found}\"")).line(self.line)
    }

    fn text(&self, column: usize) -> &str {
        self.record.get(column).unwrap_or_default()
    }

    fn whole(&self, column: usize, what: &str) -> Result<u64, Fault> {
        let text = self.text(column);
        let fault = |_| self.fault(format!("a whole number for {what}"), text);
        text.parse().map_err(fault)
    }

    fn real(&self, column: usize, what: &str) -> Result<f64, Fault> {
        let text = self.text(column);
        self.number(text).ok_or_else(|| self.fault(format!("a number for {what}"), text))
    }

    fn number(&self, text: &str) -> Option<f64> {
        let value = if self.decimal_comma { text.replace(',', ".").parse::<f64>() } else { text.parse() };
        value.ok().filter(|value| value.is_finite())
    }

    fn reals(&self, columns: [usize; 3], what: [&str; 3]) -> Result<[f64; 3], Fault> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.real(columns[axis], what[axis]));
        Ok([x?, y?, z?])
    }
}

fn read(text: &str) -> Result<ModeShapes, Fault> {
    let semicolon = first_line(text).contains(';');
    let mut table = table_of(text, if semicolon { b';' } else { b',' });
    let mut columns: Option<Vec<String>> = None;
    let (mut modes, mut places) = (Vec::<Mode>::new(), Vec::new());
    let mut index_of = HashMap::new();
    for record in table.records() {
        let record = record.map_err(|error| {
            let line = error.position().map_or(0, Position::line);
            Fault::new("a line of the table", error).line(line)
        })?;
        // programs that keep the separators of empty cells
        if record.iter().all(str::is_empty) {
            continue;
        }
        let row = Row { line: line_of(text, &record), record: &record, decimal_comma: semicolon };
        let Some(columns) = &columns else {
            columns = Some(header_of(&row)?);
            continue;
        };
        Fault::unless(record.len() == columns.len(), format!("{} columns", columns.len()), record.len())
            .map_err(|fault| fault.line(row.line))?;
        let (mode, place, displacement) = values(&row, columns)?;
        let frequency_hz = mode.frequency_hz;
        let index = *index_of.entry(mode.number).or_insert_with(|| {
            modes.push(mode);
            modes.len() - 1
        });
        let own = &mut modes[index];
        if own.frequency_hz.to_bits() != frequency_hz.to_bits() {
            let expected = format!("{} Hz as in line {}", own.frequency_hz, own.line);
            return Err(row.fault(expected, frequency_hz));
        }
        let row_of_mode = own.shape.len() / 3;
        own.shape.extend(displacement);
        if index == 0 {
            places.push(place);
        } else if places.get(row_of_mode) != Some(&place) {
            let expected = match places.get(row_of_mode) {
                Some(first) => format!("{} as in the first mode", spot_text(*first)),
                None => format!("{} points as in the first mode", places.len()),
            };
            return Err(Fault::new(expected, spot_text(place)).line(row.line));
        }
    }
    complete(modes, places)
}

fn spot_text(spot: Spot) -> String {
    let place = match spot.place {
        Place::Node(tag) => format!("node {tag}"),
        Place::Point([x, y, z]) => format!("point ({x}, {y}, {z})"),
    };
    match spot.direction {
        Some([x, y, z]) => format!("{place} along ({x}, {y}, {z})"),
        None => place,
    }
}

/// Checks the header and returns it.
fn header_of(row: &Row) -> Result<Vec<String>, Fault> {
    let names: Vec<String> = row.record.iter().map(str::to_lowercase).collect();
    let in_space: [&[&str]; 2] = [&BY_POINT, &BY_NODE];
    let along: [&[&str]; 2] = [&POINT_AXIS, &NODE_AXIS];
    let without = match names.split_last() {
        Some((last, rest)) if last == IMAGINARY => rest,
        _ => &names,
    };
    if in_space.into_iter().any(|header| names == *header) || along.into_iter().any(|header| without == header) {
        return Ok(names);
    }
    let expected = if names.iter().any(|name| name == "direction") {
        format!("the header {} or {}, and {IMAGINARY} after it or not", POINT_AXIS.join(","), NODE_AXIS.join(","))
    } else {
        format!("the header {} or {}", BY_POINT.join(","), BY_NODE.join(","))
    };
    Err(row.fault(expected, names.join(",")))
}

/// Mode, spot and displacement of a line, real and imaginary.
fn values(row: &Row, columns: &[String]) -> Result<(Mode, Spot, [[f64; 2]; 3]), Fault> {
    let (number, frequency_hz) = (row.whole(0, "mode")?, row.real(1, "frequency_hz")?);
    let mode = Mode { number, frequency_hz, line: row.line, shape: Vec::new() };
    let (place, next) = if columns[2] == BY_NODE[2] {
        (Place::Node(row.whole(2, "node")?), 3)
    } else {
        (Place::Point(row.reals([2, 3, 4], ["x", "y", "z"])?), 5)
    };
    if columns[next] != POINT_AXIS[5] {
        let displacement = row.reals([next, next + 1, next + 2], ["ux", "uy", "uz"])?;
        return Ok((mode, Spot { place, direction: None }, displacement.map(|real| [real, 0.0])));
    }
    let direction = direction(row, next)?;
    let real = row.real(next + 1, "value")?;
    let imaginary = if columns.len() > next + 2 { row.real(next + 2, IMAGINARY)? } else { 0.0 };
    Ok((mode, Spot { place, direction: Some(direction) }, direction.map(|part| [part * real, part * imaginary])))
}

/// A direction of length 1: an axis with its sign, or three numbers with blanks between.
fn direction(row: &Row, column: usize) -> Result<[f64; 3], Fault> {
    const EXPECTED: &str = "a direction such as x, -y, +z or 0.6 0.8 0";
    let text = row.text(column);
    let (sign, axis) = match text.strip_prefix('-') {
        Some(axis) => (-1.0, axis),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    if let Some(place) = ["x", "y", "z"].iter().position(|name| axis.eq_ignore_ascii_case(name)) {
        let mut direction = [0.0; 3];
        direction[place] = sign;
        return Ok(direction);
    }
    let numbers = text.split_whitespace().map(|part| row.number(part)).collect::<Option<Vec<f64>>>();
    let vector = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
    let length = vector.map(|[x, y, z]| x.hypot(y).hypot(z)).filter(|length| length.is_normal());
    match vector.zip(length) {
        Some((vector, length)) => Ok(vector.map(|part| part / length)),
        None => Err(row.fault(EXPECTED, text)),
    }
}

fn complete(modes: Vec<Mode>, places: Vec<Spot>) -> Result<ModeShapes, Fault> {
    if let Some(mode) = modes.iter().find(|mode| mode.shape.len() != 3 * places.len()) {
        let expected = format!("{} points in every mode", places.len());
        let found = format!("{} in mode {}", mode.shape.len() / 3, mode.number);
        return Err(Fault::new(expected, found).line(mode.line));
    }
    let tag = |spot: &Spot| match spot.place {
        Place::Node(tag) => Some(tag),
        Place::Point(_) => None,
    };
    let point = |spot: &Spot| match spot.place {
        Place::Node(_) => None,
        Place::Point(point) => Some(point),
    };
    Ok(ModeShapes {
        frequencies_hz: modes.iter().map(|mode| mode.frequency_hz).collect(),
        node_tags: places.iter().map(tag).collect(),
        points: places.iter().map(point).collect(),
        shapes: modes.iter().map(|mode| real_part(&mode.shape)).collect(),
        directions: places.iter().map(|spot| spot.direction).collect(),
    })
}
