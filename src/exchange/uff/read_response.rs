//! Reads dataset 58, functions at nodal degrees of freedom.

use std::fs;
use std::path::Path;

use super::super::fortran::{columns, real};
use super::UffError;
use super::binary::skip_binary;
use super::cursor::{Cursor, Fault, Line};
use super::read::skip;
use super::response::{FrequencyResponse, ResponseKind, ResponsePoint};
use super::write_response::{REFERENCE, RESPONSE};

/// Reads the frequency responses of a universal file: datasets 58 of function type 4 whose abscissa is a frequency, whose
/// numerator is a displacement, velocity or acceleration along an axis and whose denominator is a force. Others, and all
/// datasets of other numbers, are passed over.
///
/// Values are in SI: lengths and forces are divided by the factors of dataset 164 where the file has it. A name of a point
/// comes from the identification lines that [`write_responses_uff`](super::write_responses_uff) writes, else from the
/// entity name; node 0 is none, direction 0 not known.
///
/// # Errors
/// [`UffError`] with file and line, what was found and what was expected; without frequency responses; for binary ones
/// (dataset 58b); for accelerations in g.
pub fn read_responses_uff(path: &Path) -> Result<Vec<FrequencyResponse>, UffError> {
    let bytes = fs::read(path).map_err(|source| UffError::Read {
        path: path.to_owned(),
        source,
    })?;
    responses_from_bytes(&bytes, path)
}

/// As [`read_responses_uff`], of a file that is in memory; `path` is for messages.
///
/// # Errors
/// As [`read_responses_uff`].
pub fn responses_from_bytes(bytes: &[u8], path: &Path) -> Result<Vec<FrequencyResponse>, UffError> {
    let content = |fault: Fault| UffError::Content {
        path: path.to_owned(),
        line: fault.line,
        expected: fault.expected,
        found: fault.found,
    };
    let mut responses = read(bytes).map_err(content)?;
    if responses.list.is_empty() {
        return Err(UffError::NoResponses {
            path: path.to_owned(),
        });
    }
    let scale = responses.per_newton / responses.per_metre;
    for (index, response) in responses.list.iter_mut().enumerate() {
        for part in response.value.as_flattened_mut() {
            *part *= scale;
        }
        response
            .check()
            .map_err(|fault| UffError::Response { index, fault })?;
    }
    Ok(responses.list)
}

/// What a file has gathered so far.
struct Content {
    list: Vec<FrequencyResponse>,
    /// File's units of length in a metre, of force in a newton.
    per_metre: f64,
    per_newton: f64,
}

fn read(bytes: &[u8]) -> Result<Content, Fault> {
    let mut cursor = Cursor::new(bytes);
    let mut content = Content {
        list: Vec::new(),
        per_metre: 1.0,
        per_newton: 1.0,
    };
    while let Some(line) = cursor.next() {
        if !line.is_delimiter() {
            continue;
        }
        let mut head = cursor.next();
        while head
            .as_ref()
            .is_some_and(|line| line.text.trim().is_empty())
        {
            head = cursor.next();
        }
        let Some(head) = head else {
            break;
        };
        match head.text.split_ascii_whitespace().next() {
            Some("58") => content.list.extend(response(&mut cursor)?),
            Some("58b") => {
                if binary_is_response(&mut cursor, &head)? {
                    return Err(head.fault("frequency responses as text (dataset 58)"));
                }
            }
            Some("164") => units(&mut cursor, &mut content)?,
            Some(number) if number.parse::<u32>().is_ok() => skip(&mut cursor)?,
            _ => return Err(head.fault("the number of a dataset")),
        }
    }
    Ok(content)
}

/// Goes past a binary dataset and says whether it is a frequency response.
fn binary_is_response(cursor: &mut Cursor, head: &Line) -> Result<bool, Fault> {
    let lines = skip_binary(cursor, head)?;
    let function = |line: &Line| line.text.split_ascii_whitespace().next() == Some("4");
    Ok(lines.get(5).is_some_and(function))
}

fn units(cursor: &mut Cursor, content: &mut Content) -> Result<(), Fault> {
    const FACTORS: &str = "units of length in a metre and of force in a newton, > 0";
    cursor.expect_text("the code of the units")?;
    let line = cursor.expect_text(FACTORS)?;
    match *line.reals(25, FACTORS)?.as_slice() {
        [length, force, ..] if length > 0.0 && force > 0.0 => {
            (content.per_metre, content.per_newton) = (length, force);
            skip(cursor)
        }
        _ => Err(line.fault(FACTORS)),
    }
}

/// What record 6 says.
struct Identification {
    function: i64,
    to: ResponsePoint,
    from: ResponsePoint,
    /// Both along axes, or not known.
    moves: bool,
}

/// Reads a dataset after its number, to the line that ends it; `None` if it is no frequency response.
fn response(cursor: &mut Cursor) -> Result<Option<FrequencyResponse>, Fault> {
    const LINES: &str = "five identification lines";
    let mut lines = Vec::new();
    for _ in 0..5 {
        let line = cursor.expect(LINES)?;
        if line.is_delimiter() {
            return Err(line.fault(LINES));
        }
        lines.push(line.text.trim().to_owned());
    }
    let line = cursor.expect(POINTS)?;
    let mut own = identification(&line)?;
    const FORM: &str = "type, number, spacing, first abscissa and step of the data";
    let data = cursor.expect(FORM)?;
    let form = Form::read(&data).ok_or_else(|| data.fault(FORM))?;
    let mut axes = Vec::new();
    for _ in 0..4 {
        const AXIS: &str = "type, three exponents, label and unit of an axis";
        let line = cursor.expect(AXIS)?;
        let kind = line.text.split_ascii_whitespace().next();
        let kind: Option<i64> = kind.and_then(|word| word.parse().ok());
        axes.push((kind.ok_or_else(|| line.fault(AXIS))?, line));
    }
    let [(abscissa, _), (numerator, line), (denominator, _), _] = axes.as_slice() else {
        return Err(data.fault("four axes"));
    };
    const FUNCTION: i64 = 4;
    let kind = ResponseKind::of_numerator(*numerator);
    let force = matches!(denominator, 9 | 13);
    let (Some(kind), 18, true, FUNCTION, true) = (kind, *abscissa, force, own.function, own.moves)
    else {
        skip(cursor)?;
        return Ok(None);
    };
    let unit = line.text.get(47..).unwrap_or_default().trim();
    if unit.eq_ignore_ascii_case("g") {
        return Err(line.fault("an acceleration in units of length, not in g"));
    }
    if !form.complex {
        return Err(data.fault("complex values of a frequency response"));
    }
    let name_of = |line: &str, begin: &str, point: &mut ResponsePoint| {
        if let Some(name) = line.strip_prefix(begin) {
            point.name = named(name);
        }
    };
    name_of(&lines[3], REFERENCE, &mut own.from);
    name_of(&lines[4], RESPONSE, &mut own.to);
    let (frequency_hz, value) = form.values(cursor)?;
    Ok(Some(FrequencyResponse {
        name: named(&lines[0]),
        frequency_hz,
        value,
        kind,
        from: own.from,
        to: own.to,
    }))
}

const POINTS: &str = "function, its number, version, load case, then name, node and direction of response and reference";

/// Record 6, in its columns, else as words.
fn identification(line: &Line) -> Result<Identification, Fault> {
    const WIDTHS: [usize; 10] = [5, 10, 5, 10, 11, 10, 4, 11, 10, 4];
    let mut begin = 0;
    let mut fields = Vec::new();
    for width in WIDTHS {
        fields.push(line.text.get(begin..line.text.len().min(begin + width)));
        begin += width;
    }
    let fields: Vec<&str> = fields.into_iter().flatten().map(str::trim).collect();
    let words: Vec<&str> = line.text.split_ascii_whitespace().collect();
    let own = point_fields(&fields).or_else(|| point_fields(&words));
    own.ok_or_else(|| line.fault(POINTS))
}

fn point_fields(fields: &[&str]) -> Option<Identification> {
    let &[
        function,
        _,
        _,
        _,
        to,
        to_node,
        to_axis,
        from,
        from_node,
        from_axis,
    ] = fields
    else {
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
    Some(Identification {
        function: function.parse().ok()?,
        to: point(to, to_node, to_axis)?,
        from: point(from, from_node, from_axis)?,
        moves: (-3..=3).contains(&to_axis) && (-3..=3).contains(&from_axis),
    })
}

/// A name, where there is one.
fn named(text: &str) -> String {
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
        Some(Self {
            complex,
            single,
            count: count.parse().ok()?,
            even,
        })
    }

    /// Frequencies and complex values, and the line that ends the dataset. They are taken as they come, whatever the file
    /// says of their number.
    fn values(&self, cursor: &mut Cursor) -> Result<(Vec<f64>, Vec<[f64; 2]>), Fault> {
        const VALUES: &str = "as many values as the data has";
        let mut frequencies = Vec::new();
        let mut values = Vec::new();
        let mut numbers = Vec::new();
        loop {
            let line = cursor.expect_text("a value or -1")?;
            if line.is_delimiter() {
                if values.len() == self.count && numbers.is_empty() {
                    return Ok((frequencies, values));
                }
                return Err(Fault {
                    line: line.number,
                    expected: VALUES,
                    found: format!("{} of {}", values.len(), self.count),
                });
            }
            numbers.extend(self.numbers(&line)?);
            let size = if self.even.is_some() { 2 } else { 3 };
            let whole = numbers.len() / size * size;
            for entry in numbers[..whole].chunks_exact(size) {
                let frequency = match (self.even, entry) {
                    (Some((first, step)), _) => first + step * values.len() as f64,
                    (None, entry) => entry[0],
                };
                frequencies.push(frequency);
                values.push([entry[size - 2], entry[size - 1]]);
            }
            numbers.drain(..whole);
            if values.len() > self.count {
                return Err(line.fault(VALUES));
            }
        }
    }

    /// The numbers of a line: words, or columns where they run together.
    fn numbers(&self, line: &Line) -> Result<Vec<f64>, Fault> {
        const NUMBERS: &str = "real numbers of a frequency response";
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
