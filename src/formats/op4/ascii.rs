//! ASCII files: whole numbers in columns of 8, reals as the header says.

use super::super::fortran::{columns, fields, quoted, real, take_line};
use super::Op4Matrix;
use super::matrix::{Builder, Column};
use crate::files::Fault;

/// Reals a line and their width, where a header does not say.
const DEFAULT: RealFormat = RealFormat { per_line: 5, width: 16 };
/// Longest line of reals that is believed.
const LONGEST: usize = 1000;
/// Narrowest column of a real that is believed.
const NARROWEST: usize = 8;

/// How reals stand in their lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct RealFormat {
    per_line: usize,
    width: usize,
}

/// Where reading is.
struct Lines<'a> {
    rest: &'a [u8],
    line: usize,
}

pub(super) fn read_ascii(bytes: &[u8]) -> Result<Vec<Op4Matrix>, Fault> {
    let mut lines = Lines { rest: bytes, line: 0 };
    let mut matrices = Vec::new();
    while !lines.rest.trim_ascii().is_empty() {
        matrices.push(matrix(&mut lines)?);
    }
    Ok(matrices)
}

fn matrix(lines: &mut Lines) -> Result<Op4Matrix, Fault> {
    const HEADER: &str = "columns, rows, form, type and name of a matrix";
    let line = lines.next(HEADER)?;
    let fault = |lines: &Lines, expected| lines.fault(expected, &line);
    // large matrices have wider columns in the header
    let (text, wide) = match line.strip_suffix("|I16") {
        Some(text) => (text, 16),
        None => (line.as_str(), 8),
    };
    let header = integers(text, [wide, wide, 8, 8]).ok_or_else(|| fault(lines, HEADER))?;
    let rest = text.get(2 * wide + 16..).unwrap_or_default();
    let (name, format) = rest.split_at_checked(8).unwrap_or((rest, ""));
    let mut builder = Builder::new(header, name).map_err(|expected| fault(lines, expected))?;
    let format = RealFormat::parse(format).ok_or_else(|| fault(lines, "a format of reals such as 1P,3E24.16"))?;
    const COLUMN: &str = "column, first row and length of a column";
    loop {
        let line = lines.next(COLUMN)?;
        let [column, row, length] = integers(&line, [8; 3]).ok_or_else(|| lines.fault(COLUMN, &line))?;
        let begun = builder.column(column, row);
        match begun.map_err(|expected| lines.fault(expected, &line))? {
            Column::End => {
                // one number, of no meaning
                lines.next("a last number")?;
                return Ok(builder.matrix);
            }
            Column::Dense(row) => lines.run(&mut builder, format, row, length)?,
            Column::Sparse => sparse(lines, &mut builder, format, length)?,
        }
    }
}

/// The runs of a sparse column of so many words.
fn sparse(lines: &mut Lines, builder: &mut Builder, format: RealFormat, mut words: i64) -> Result<(), Fault> {
    const RUN: &str = "length and first row of a run of numbers";
    let words_of_real = if builder.is_single() { 1 } else { 2 };
    while words > 0 {
        let line = lines.next(RUN)?;
        let key = match builder.big {
            true => integers(&line, [8; 2]),
            false => line.trim().parse::<i64>().ok().map(|key| [key >> 16, key & 0xffff]),
        };
        let [length, row] = key.ok_or_else(|| lines.fault(RUN, &line))?;
        if length < 2 || (length - 1) % words_of_real != 0 {
            return Err(lines.fault(RUN, &line));
        }
        words -= if builder.big { length + 1 } else { length };
        lines.run(builder, format, row, (length - 1) / words_of_real)?;
    }
    Ok(())
}

impl RealFormat {
    /// Reads `1P,3E24.16`; nothing gives the default.
    fn parse(text: &str) -> Option<Self> {
        let text = text.trim().to_ascii_uppercase();
        let text = text.strip_prefix("1P").unwrap_or(&text);
        let text = text.trim_start_matches([',', ' ']);
        if text.is_empty() {
            return Some(DEFAULT);
        }
        let (per_line, rest) = text.split_once(['E', 'D'])?;
        let (width, _) = rest.split_once('.')?;
        let per_line: usize = per_line.trim().parse().ok()?;
        let width: usize = width.trim().parse().ok()?;
        let fits = per_line > 0 && width >= NARROWEST && per_line.checked_mul(width)? <= LONGEST;
        fits.then_some(Self { per_line, width })
    }
}

/// Whole numbers in columns of these widths.
fn integers<const N: usize>(line: &str, widths: [usize; N]) -> Option<[i64; N]> {
    let numbers: Option<Vec<i64>> = fields(line, &widths).into_iter().map(|field| field.parse().ok()).collect();
    numbers?.try_into().ok()
}

impl Lines<'_> {
    fn next(&mut self, expected: &'static str) -> Result<String, Fault> {
        self.line += 1;
        let Some(line) = take_line(&mut self.rest) else {
            return Err(Fault::new(expected, "the end of the file").at(format_args!("line {}", self.line)));
        };
        Ok(String::from_utf8_lossy(line).trim_end().to_owned())
    }

    /// Tells of the line that was read last.
    fn fault(&self, expected: &'static str, line: &str) -> Fault {
        Fault::new(expected, quoted(line)).at(format_args!("line {}", self.line))
    }

    /// So many numbers, from a row on.
    fn run(&mut self, builder: &mut Builder, format: RealFormat, row: i64, count: i64) -> Result<(), Fault> {
        const NUMBERS: &str = "the real numbers of a column";
        let count = usize::try_from(count).unwrap_or(0);
        let begin = self.line;
        // taken line by line, whatever the file says of their number
        let mut values = Vec::new();
        while values.len() < count {
            let line = self.next(NUMBERS)?;
            let own = format.per_line.min(count - values.len());
            let words = columns(&line, format.width);
            let numbers: Option<Vec<f64>> = words.into_iter().take(own).map(real).collect();
            let numbers = numbers.filter(|numbers| numbers.len() == own);
            values.extend(numbers.ok_or_else(|| self.fault(NUMBERS, &line))?);
        }
        builder.run(row, count, values).map_err(|expected| {
            Fault::new(expected, format_args!("{count} from row {row}")).at(format_args!("line {begin}"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_of_reals_in_every_spelling() {
        let format = |per_line, width| Some(RealFormat { per_line, width });
        assert_eq!(RealFormat::parse("1P,3E24.16"), format(3, 24));
        assert_eq!(RealFormat::parse("1P5E16.9 "), format(5, 16));
        assert_eq!(RealFormat::parse("3d23.16"), format(3, 23));
        assert_eq!(RealFormat::parse("  "), Some(DEFAULT));
        for other in ["3F8.2", "0E24.16", "9E7.1", "1P,3E", "999E24.16", "x"] {
            assert_eq!(RealFormat::parse(other), None, "{other}");
        }
    }
}
