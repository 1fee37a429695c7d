//! Reads signals over time: datasets 58 and 58b of function type 1.

use std::path::Path;

use super::super::FormatError;
use super::binary::read_binary;
use super::cursor::{Cursor, Line};
use super::function::{FunctionHead, Units, axis_unit, named, other_dataset};
use crate::files::{Fault, bytes_of};

/// Instants of a signal.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeAxis {
    /// First instant and step, s.
    Even {
        /// First instant, s.
        start_s: f64,
        /// Step, s; as the file has it, not checked.
        step_s: f64,
    },
    /// Each instant, s.
    Uneven(Vec<f64>),
}

/// A signal over time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeResponse {
    /// Its name: first identification line, else name or node and direction of the point; each name once in a file.
    pub name: String,
    /// Unit of the values: SI for displacements, velocities, accelerations and forces, else as the file has it; `g` stays.
    pub unit: String,
    /// Its instants.
    pub axis: TimeAxis,
    /// Its values, one an instant.
    pub values: Vec<f64>,
}

/// Reads the signals over time of a universal file, in text or binary: datasets 58 and 58b of function type 1, or 0, over
/// the time. Others, and all datasets of other numbers, are passed over.
///
/// Values are in SI: lengths and forces are divided by the factors of dataset 164 where the file has it; accelerations in g stay.
///
/// # Errors
/// [`FormatError`] with file and line, what was found and what was expected; without signals; for complex values; for binary
/// numbers that are not of IEEE 754.
pub fn read_times_uff(path: &Path) -> Result<Vec<TimeResponse>, FormatError> {
    times_from_bytes(&bytes_of(path)?, path)
}

/// As [`read_times_uff`], of a file that is in memory; `path` is for messages.
///
/// # Errors
/// As [`read_times_uff`].
pub fn times_from_bytes(bytes: &[u8], path: &Path) -> Result<Vec<TimeResponse>, FormatError> {
    let (found, units) = read(bytes).map_err(|fault| fault.of(path))?;
    if found.is_empty() {
        let expected = "signals over time (dataset 58 or 58b, function type 1, abscissa 17)";
        return Err(Fault::new(expected, "none").of(path).into());
    }
    let mut list: Vec<TimeResponse> = Vec::with_capacity(found.len());
    for (scale, mut response) in found {
        let scale = scale(&units);
        response.values.iter_mut().for_each(|value| *value *= scale);
        let others = list.iter().filter(|other| {
            let rest = other.name.strip_prefix(response.name.as_str());
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(" ("))
        });
        match others.count() {
            0 => {}
            before => response.name = format!("{} ({})", response.name, before + 1),
        }
        list.push(response);
    }
    Ok(list)
}

/// A signal with what makes it one in SI, which depends on the file's units.
type InUnits = (fn(&Units) -> f64, TimeResponse);

fn read(bytes: &[u8]) -> Result<(Vec<InUnits>, Units), Fault> {
    let mut cursor = Cursor::new(bytes);
    let (mut list, mut units) = (Vec::new(), Units::SI);
    while let Some(head) = cursor.next_dataset() {
        match head.text.split_ascii_whitespace().next() {
            Some("58") => list.extend(text(&mut cursor)?),
            Some("58b") => list.extend(binary(&mut cursor, &head)?),
            _ => other_dataset(&mut cursor, &head, &mut units)?,
        }
    }
    Ok((list, units))
}

/// Whether a function is a signal over time.
fn is_time(head: &FunctionHead) -> bool {
    const TIME: i64 = 17;
    matches!(head.function, 0 | 1) && head.axes.first().is_some_and(|axis| axis.0 == TIME)
}

fn text(cursor: &mut Cursor) -> Result<Option<InUnits>, Fault> {
    let head = FunctionHead::read(|expected| cursor.expect(expected))?;
    if !is_time(&head) {
        cursor.skip()?;
        return Ok(None);
    }
    let mut numbers = Vec::new();
    loop {
        let line = cursor.expect_text("a value or -1")?;
        if line.is_delimiter() {
            return signal(&head, numbers, &line).map(Some);
        }
        numbers.extend(head.form.numbers(&line)?);
    }
}

fn binary(cursor: &mut Cursor, first: &Line) -> Result<Option<InUnits>, Fault> {
    let found = read_binary(cursor, first)?;
    let mut lines = found.lines.iter().cloned();
    let head = FunctionHead::read(|expected| lines.next().ok_or_else(|| first.fault(expected)))?;
    if !is_time(&head) {
        return Ok(None);
    }
    if !found.ieee {
        return Err(first.fault("numbers of IEEE 754 (number format 2)"));
    }
    let numbers = if head.form.even.is_none() && !head.form.single {
        // an uneven abscissa has single precision, or that of the values
        match found.bytes.len().checked_div(head.form.count) {
            Some(12) => return Err(first.fault("instants in the precision of the values")),
            _ => found.numbers(false),
        }
    } else {
        found.numbers(head.form.single)
    };
    signal(&head, numbers, first).map(Some)
}

/// The signal of these numbers; `end` is the line to name where they are too few or too many.
fn signal(head: &FunctionHead, numbers: Vec<f64>, end: &Line) -> Result<InUnits, Fault> {
    if head.form.complex {
        return Err(head.data_fault("real values of a signal over time"));
    }
    let size = if head.form.even.is_some() { 1 } else { 2 };
    let found = format_args!("{} of {}", numbers.len() / size, head.form.count);
    let all = head.form.count.checked_mul(size) == Some(numbers.len());
    Fault::unless(all, "as many values as the data has", found).map_err(|fault| fault.line(end.number))?;
    let (axis, values) = match head.form.even {
        Some((start_s, step_s)) => (TimeAxis::Even { start_s, step_s }, numbers),
        None => {
            let (times, values) = numbers.chunks_exact(2).map(|pair| (pair[0], pair[1])).unzip();
            (TimeAxis::Uneven(times), values)
        }
    };
    let (kind, unit) = head.axes.get(1).map_or((0, ""), |(kind, line)| (*kind, axis_unit(line)));
    let unit = match kind {
        12 if unit.eq_ignore_ascii_case("g") => "g".to_owned(),
        8 => "m".to_owned(),
        11 => "m/s".to_owned(),
        12 => "m/s^2".to_owned(),
        9 | 13 => "N".to_owned(),
        _ => named(unit),
    };
    let scale: fn(&Units) -> f64 = match kind {
        8 | 11 | 12 if unit != "g" => |units| 1.0 / units.per_metre,
        9 | 13 => |units| 1.0 / units.per_newton,
        _ => |_| 1.0,
    };
    Ok((scale, TimeResponse { name: name(head), unit, axis, values }))
}

fn name(head: &FunctionHead) -> String {
    let point = &head.to;
    let own = head.names.first().map(|line| named(line)).unwrap_or_default();
    match (own.is_empty(), point.name.is_empty()) {
        (false, _) => own,
        (true, false) => point.name.clone(),
        (true, true) => {
            let axis = [" -z", " -y", " -x", "", " +x", " +y", " +z"][(point.signed_axis() + 3) as usize];
            format!("node {}{axis}", point.node.unwrap_or(0))
        }
    }
}
