//! What datasets 58 and 58b have in common: units, the head, the form of the numbers.

use super::super::fortran::{columns, fields, real};
use super::cursor::{Cursor, Line};
use super::response::ResponsePoint;
use crate::files::Fault;

/// Units of a file, by dataset 164.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Units {
    /// File's units of length in a metre.
    pub(super) per_metre: f64,
    /// File's units of force in a newton.
    pub(super) per_newton: f64,
}

impl Units {
    /// Of a file that says nothing.
    pub(super) const SI: Self = Self { per_metre: 1.0, per_newton: 1.0 };
}

/// Reads the units of a dataset 164, goes past others.
pub(super) fn other_dataset(cursor: &mut Cursor, head: &Line, units: &mut Units) -> Result<(), Fault> {
    if head.text.split_ascii_whitespace().next() != Some("164") {
        return skip_dataset(cursor, head);
    }
    let [per_metre, per_newton] = read_units(cursor, "units of length in a metre and of force in a newton, > 0")?;
    *units = Units { per_metre, per_newton };
    Ok(())
}

/// Goes past a dataset that has a number.
pub(super) fn skip_dataset(cursor: &mut Cursor, head: &Line) -> Result<(), Fault> {
    match head.text.split_ascii_whitespace().next() {
        Some(number) if number.parse::<u32>().is_ok() => cursor.skip(),
        _ => Err(head.fault("the number of a dataset")),
    }
}

/// The first factors of a dataset 164, all above zero.
pub(super) fn read_units<const N: usize>(cursor: &mut Cursor, expected: &'static str) -> Result<[f64; N], Fault> {
    cursor.expect_text("the code of the units")?;
    let line = cursor.expect_text(expected)?;
    let factors = line.reals(25, expected)?.first_chunk().copied();
    let factors = factors.filter(|factors: &[f64; N]| factors.iter().all(|&factor| factor > 0.0));
    let factors = factors.ok_or_else(|| line.fault(expected))?;
    cursor.skip()?;
    Ok(factors)
}

/// What record 6 says: function type, 1 a signal over time, 4 a frequency response; where it was measured, and from where;
/// whether both are along axes, or not known.
type Identification = (i64, ResponsePoint, ResponsePoint, bool);

/// What a dataset 58 says before its values.
pub(super) struct FunctionHead {
    /// Identification lines.
    pub(super) names: Vec<String>,
    /// Function type: 1 a signal over time, 4 a frequency response.
    pub(super) function: i64,
    /// Where it was measured.
    pub(super) to: ResponsePoint,
    pub(super) from: ResponsePoint,
    /// Both along axes, or not known.
    pub(super) moves: bool,
    /// Record 7 and what it says.
    data: Line,
    pub(super) form: Form,
    /// Kind and line of abscissa, numerator, denominator and z axis.
    pub(super) axes: Vec<(i64, Line)>,
}

impl FunctionHead {
    /// Reads the head from where `next` gives line by line what is expected.
    pub(super) fn read(mut next: impl FnMut(&'static str) -> Result<Line, Fault>) -> Result<Self, Fault> {
        const LINES: &str = "five identification lines";
        let mut names = Vec::new();
        for _ in 0..5 {
            names.push(next(LINES)?.within(LINES)?.text.trim().to_owned());
        }
        let line = next(POINTS)?;
        let words: Vec<&str> = line.text.split_ascii_whitespace().collect();
        let points = point_fields(&fields(&line.text, &WIDTHS)).or_else(|| point_fields(&words));
        let (function, to, from, moves) = points.ok_or_else(|| line.fault(POINTS))?;
        const FORM: &str = "type, number, spacing, first abscissa and step of the data";
        let data = next(FORM)?;
        let form = Form::read(&data).ok_or_else(|| data.fault(FORM))?;
        let mut axes = Vec::new();
        for _ in 0..4 {
            const AXIS: &str = "type, three exponents, label and unit of an axis";
            let line = next(AXIS)?;
            let kind = line.text.split_ascii_whitespace().next();
            let kind: Option<i64> = kind.and_then(|word| word.parse().ok());
            axes.push((kind.ok_or_else(|| line.fault(AXIS))?, line));
        }
        Ok(Self { names, function, to, from, moves, data, form, axes })
    }

    /// What is wrong with record 7.
    pub(super) fn data_fault(&self, expected: &'static str) -> Fault {
        self.data.fault(expected)
    }
}

/// Unit of an axis.
pub(super) fn axis_unit(line: &Line) -> &str {
    line.text.get(47..).unwrap_or_default().trim()
}

const POINTS: &str =
    "function, its number, version, load case, then name, node and direction of response and reference";

/// Columns of record 6; some programs have words there.
const WIDTHS: [usize; 10] = [5, 10, 5, 10, 11, 10, 4, 11, 10, 4];

fn point_fields(fields: &[&str]) -> Option<Identification> {
    let &[function, _, _, _, to, to_node, to_axis, from, from_node, from_axis] = fields else {
        return None;
    };
    let (to_axis, from_axis) = (to_axis.parse().ok()?, from_axis.parse().ok()?);
    let point = |name: &str, node: &str, axis: i64| {
        Some(ResponsePoint {
            name: named(name),
            node: Some(node.parse().ok()?).filter(|&node| node != 0),
            direction: ResponsePoint::direction_of(axis),
        })
    };
    let moves = (-3..=3).contains(&to_axis) && (-3..=3).contains(&from_axis);
    let (to, from) = (point(to, to_node, to_axis)?, point(from, from_node, from_axis)?);
    Some((function.parse().ok()?, to, from, moves))
}

/// A name, where there is one.
pub(super) fn named(text: &str) -> String {
    match text.trim() {
        "NONE" => String::new(),
        name => name.to_owned(),
    }
}

/// What record 7 says of the data.
pub(super) struct Form {
    pub(super) complex: bool,
    pub(super) single: bool,
    pub(super) count: usize,
    /// First abscissa and step.
    pub(super) even: Option<(f64, f64)>,
}

impl Form {
    pub(super) fn read(line: &Line) -> Option<Self> {
        let words: Vec<&str> = line.text.split_ascii_whitespace().collect();
        let words = match words.as_slice() {
            [_, _, _, _, _, ..] if words.iter().all(|word| word.len() < 20) => words,
            // numbers that run together
            _ => {
                let (whole, reals) = line.text.split_at_checked(30)?;
                [columns(whole, 10), columns(reals, 13)].concat()
            }
        };
        let &[kind, count, spacing, first, step, ..] = words.as_slice() else {
            return None;
        };
        let (complex, single) = match kind {
            "2" => (false, true),
            "4" => (false, false),
            "5" => (true, true),
            "6" => (true, false),
            _ => return None,
        };
        let even = match spacing {
            "0" => None,
            "1" => Some((real(first)?, real(step)?)),
            _ => return None,
        };
        Some(Self { complex, single, count: count.parse().ok()?, even })
    }

    /// Frequencies and complex values, and the line that ends the dataset. They are taken as they come, whatever the file
    /// says of their number.
    pub(super) fn values(&self, cursor: &mut Cursor) -> Result<(Vec<f64>, Vec<[f64; 2]>), Fault> {
        const VALUES: &str = "as many values as the data has";
        let (mut frequencies, mut values, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        loop {
            let line = cursor.expect_text("a value or -1")?;
            if line.is_delimiter() {
                let all = values.len() == self.count && numbers.is_empty();
                Fault::unless(all, VALUES, format_args!("{} of {}", values.len(), self.count))
                    .map_err(|fault| fault.line(line.number))?;
                return Ok((frequencies, values));
            }
            numbers.extend(self.numbers(&line)?);
            let size = if self.even.is_some() { 2 } else { 3 };
            let whole = numbers.len() / size * size;
            for entry in numbers[..whole].chunks_exact(size) {
                frequencies.push(self.even.map_or(entry[0], |(first, step)| first + step * values.len() as f64));
                values.push([entry[size - 2], entry[size - 1]]);
            }
            numbers.drain(..whole);
            if values.len() > self.count {
                return Err(line.fault(VALUES));
            }
        }
    }

    /// The numbers of a line: words, or columns where they run together.
    pub(super) fn numbers(&self, line: &Line) -> Result<Vec<f64>, Fault> {
        const NUMBERS: &str = "real numbers of a function";
        if self.single || self.even.is_some() {
            return line.reals(if self.single { 13 } else { 20 }, NUMBERS);
        }
        let words: Option<Vec<f64>> = line.text.split_ascii_whitespace().map(real).collect();
        if let Some(words) = words {
            return Ok(words);
        }
        // a frequency in single precision, its value in double precision
        let own = line.text.split_at_checked(13).and_then(|(first, rest)| {
            let rest = columns(rest, 20).into_iter().map(real);
            std::iter::once(real(first)).chain(rest).collect()
        });
        own.ok_or_else(|| line.fault(NUMBERS))
    }
}
