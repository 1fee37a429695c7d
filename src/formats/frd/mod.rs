//! Mode shapes of CalculiX: result files `.frd` in text, as `*FREQUENCY` with `*NODE FILE` and `U` writes them.
//!
//! The columns are those of "CalculiX CGX: result format" (K. Wittig, user's manual of cgx): nodes in a block `2C`, results in
//! blocks `100C` of which each has a value (of a mode its frequency in Hz), a kind of analysis (2: frequencies) and components.
//! The head of each block has the number of its rows.
//!
//! **Limitations**: binary files, and complex modes (`*COMPLEX FREQUENCY`, sectors of cyclic symmetry) are refused.

#[cfg(test)]
mod tests;

use super::{FormatError, ModeShapes};
use crate::files::{Fault, bytes_of};
use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;

/// Kind of analysis of a block with a mode.
const FREQUENCIES: &str = "2";

/// The last line of a file.
const END: &str = "9999";

/// Reads the mode shapes of a result file of CalculiX. `metres` is the length of its unit, m: the file does not say it.
/// Results of other kinds are passed over.
///
/// # Errors
/// [`FormatError::File`] with file and line, what was found and what was expected; without modes; for complex ones.
pub fn read_modes_frd(path: &Path, metres: f64) -> Result<ModeShapes, FormatError> {
    let bytes = bytes_of(path)?;
    // names may be in any encoding; numbers are ASCII
    let text = String::from_utf8_lossy(&bytes);
    let read = Reader::new(&text).modes(metres).and_then(|modes| modes.check().map(|()| modes));
    Ok(read.map_err(|fault| fault.of(path))?)
}

/// A mode as gathered so far.
struct Mode {
    frequency_hz: f64,
    nodes: Vec<u64>,
    shape: Vec<f64>,
}

/// A line, and its number from 1.
#[derive(Clone, Copy)]
struct Line<'a> {
    number: u64,
    text: &'a str,
}

struct Reader<'a> {
    lines: std::iter::Zip<std::ops::RangeFrom<u64>, std::str::Lines<'a>>,
}

impl<'a> Line<'a> {
    fn fault(self, expected: &'static str, found: &str) -> Fault {
        Fault::new(expected, format!("\"{found}\"")).line(self.number)
    }

    /// The columns from..to, counted from 0, without blanks around; what the line has of them.
    fn columns(self, from: usize, to: usize) -> &'a str {
        self.text.get(from..to.min(self.text.len())).unwrap_or_default().trim()
    }

    /// The key of a block or of a line in it.
    fn key(self) -> &'a str {
        self.columns(0, 6)
    }

    /// Width of node numbers, by the digit that says the block's format.
    fn width(self, column: usize) -> Result<usize, Fault> {
        match self.columns(column, column + 1) {
            "0" => Ok(5),
            "1" => Ok(10),
            found => Err(self.fault("text of format 0 or 1 (binary files are not read)", found)),
        }
    }

    /// Whether as many were there as these columns say; files of old versions leave them blank.
    fn counted(self, columns: Range<usize>, found: usize, what: &str) -> Result<(), Fault> {
        let said = self.columns(columns.start, columns.end);
        let expected = format!("{said} {what} in the block, as its head says");
        Fault::unless(said.is_empty() || said.parse() == Ok(found), expected, found)
            .map_err(|fault| fault.line(self.number))
    }

    /// Number of a node and the three numbers after it.
    fn row(self, width: usize) -> Result<(u64, [f64; 3]), Fault> {
        let node = self.columns(3, 3 + width);
        let node = node.parse().map_err(|_| self.fault("the number of a node", node))?;
        let mut values = [0.0; 3];
        for (place, value) in values.iter_mut().enumerate() {
            let from = 3 + width + 12 * place;
            let found = self.columns(from, from + 12);
            let number = found.parse::<f64>().ok().filter(|number| number.is_finite());
            *value = number.ok_or_else(|| self.fault("a number in 12 columns", found))?;
        }
        Ok((node, values))
    }
}

impl<'a> Reader<'a> {
    fn new(text: &'a str) -> Self {
        Self { lines: (1..).zip(text.lines()) }
    }

    fn next(&mut self) -> Option<Line<'a>> {
        self.lines.next().map(|(number, text)| Line { number, text })
    }

    fn modes(mut self, metres: f64) -> Result<ModeShapes, Fault> {
        let mut places: HashMap<u64, [f64; 3]> = HashMap::new();
        let mut modes: Vec<Mode> = Vec::new();
        let mut ended = false;
        while let Some(line) = self.next() {
            match line.key() {
                "2C" => {
                    let width = line.width(73)?;
                    self.rows(line, |row| {
                        let (node, place) = row.row(width)?;
                        places.insert(node, place.map(|x| metres * x));
                        Ok(())
                    })?;
                }
                "3C" if line.width(73).is_ok() => self.rows(line, |_| Ok(()))?,
                "100C" => modes.extend(self.results(line)?),
                END => ended = true,
                _ => {}
            }
        }
        let Some(first) = modes.first() else {
            let expected = "displacements of modes (*FREQUENCY with *NODE FILE and U)";
            return Err(Fault::new(expected, "none"));
        };
        if !ended {
            return Err(Fault::new("the line 9999 at the end of the file", "none: the file is cut off"));
        }
        let tags = first.nodes.clone();
        if let Some(place) = modes.iter().position(|mode| mode.nodes != tags) {
            return Err(Fault::new("the same nodes in every mode", format!("others in mode {}", place + 1)));
        }
        let points = tags.iter().map(|tag| {
            let found = || Fault::new("coordinates of every node", format!("none of node {tag}"));
            places.get(tag).copied().ok_or_else(found)
        });
        Ok(ModeShapes {
            points: Some(points.collect::<Result<_, Fault>>()?),
            node_tags: Some(tags),
            frequencies_hz: modes.iter().map(|mode| mode.frequency_hz).collect(),
            shapes: modes.into_iter().map(|mode| mode.shape).collect(),
            directions: None,
        })
    }

    /// The mode of a block of results; `None` if it holds something else than displacements, or is of another analysis.
    fn results(&mut self, head: Line<'a>) -> Result<Option<Mode>, Fault> {
        if head.columns(56, 58) != FREQUENCIES {
            // lines of a binary block are no lines
            return head.width(74).map_or(Ok(()), |_| self.rows(head, |_| Ok(()))).map(|()| None);
        }
        let found = head.columns(12, 24);
        let frequency = found.parse::<f64>().ok().filter(|hz| hz.is_finite());
        let frequency_hz = frequency.ok_or_else(|| head.fault("the frequency of a mode", found))?;
        let width = head.width(74)?;
        let Some(kind) = self.next() else {
            return Err(head.fault("the components of the block", "the end of the file"));
        };
        let name = kind.columns(5, 13);
        if matches!(name, "DISPI" | "PDISP") {
            return Err(kind.fault("real displacements (DISP)", name));
        }
        let mut components = 0;
        while self.lines.clone().next().is_some_and(|(_, text)| text.trim_start().starts_with("-5")) {
            components += 1;
            self.next();
        }
        kind.counted(13..18, components, "components -5")?;
        let mut mode = Mode { frequency_hz, nodes: Vec::new(), shape: Vec::new() };
        self.rows(head, |line| {
            if name == "DISP" {
                let (node, displacement) = line.row(width)?;
                mode.nodes.push(node);
                mode.shape.extend(displacement);
            }
            Ok(())
        })?;
        Ok((name == "DISP").then_some(mode))
    }

    /// Takes the rows of a block up to its end, as many as its head says.
    fn rows(&mut self, head: Line<'a>, mut take: impl FnMut(Line<'a>) -> Result<(), Fault>) -> Result<(), Fault> {
        let (mut last, mut rows) = (head.number, 0);
        while let Some(line) = self.next() {
            last = line.number;
            match line.key().get(..2) {
                Some("-1") => {
                    take(line)?;
                    rows += 1;
                }
                Some("-3") => return head.counted(24..36, rows, "rows -1"),
                Some("-2" | "-4" | "-5" | "-6") => {}
                _ => return Err(line.fault("a row -1 or the end -3 of the block", line.key())),
            }
        }
        Err(Fault::new("the end -3 of the block", "the end of the file").line(last))
    }
}
