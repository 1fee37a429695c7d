//! Reads dataset 58, functions at nodal degrees of freedom.

use std::path::Path;

use super::super::FormatError;
use super::binary::read_binary;
use super::cursor::{Cursor, Line};
use super::function::{FunctionHead, Units, axis_unit, named, other_dataset};
use super::response::{FrequencyResponse, REFERENCE, RESPONSE, ResponseKind, ResponsePoint};
use crate::files::{Fault, bytes_of};

/// Reads the frequency responses of a universal file: datasets 58 of function type 4 whose abscissa is a frequency, whose
/// numerator is a displacement, velocity or acceleration along an axis and whose denominator is a force. Others, and all
/// datasets of other numbers, are passed over.
///
/// Values are in SI: lengths and forces are divided by the factors of dataset 164 where the file has it. A name of a point
/// comes from the identification lines that [`write_responses_uff`](super::write_responses_uff) writes, else from the
/// entity name; node 0 is none, direction 0 not known.
///
/// # Errors
/// [`FormatError`] with file and line, what was found and what was expected; without frequency responses; for binary ones
/// (dataset 58b); for accelerations in g.
pub fn read_responses_uff(path: &Path) -> Result<Vec<FrequencyResponse>, FormatError> {
    responses_from_bytes(&bytes_of(path)?, path)
}

/// As [`read_responses_uff`], of a file that is in memory; `path` is for messages.
///
/// # Errors
/// As [`read_responses_uff`].
pub fn responses_from_bytes(bytes: &[u8], path: &Path) -> Result<Vec<FrequencyResponse>, FormatError> {
    let (mut list, units) = read(bytes).map_err(|fault| fault.of(path))?;
    if list.is_empty() {
        let expected =
            "frequency responses (dataset 58, function type 4, of displacement, velocity or acceleration by force)";
        return Err(Fault::new(expected, "none").of(path).into());
    }
    let scale = units.per_newton / units.per_metre;
    for (index, response) in list.iter_mut().enumerate() {
        response.value.as_flattened_mut().iter_mut().for_each(|part| *part *= scale);
        response.check_as(index)?;
    }
    Ok(list)
}

fn read(bytes: &[u8]) -> Result<(Vec<FrequencyResponse>, Units), Fault> {
    let mut cursor = Cursor::new(bytes);
    let (mut list, mut units) = (Vec::new(), Units::SI);
    while let Some(head) = cursor.next_dataset() {
        match head.text.split_ascii_whitespace().next() {
            Some("58") => list.extend(response(&mut cursor)?),
            Some("58b") => {
                let is_response = |line: &Line| line.text.split_ascii_whitespace().next() == Some("4");
                if read_binary(&mut cursor, &head)?.lines.get(5).is_some_and(is_response) {
                    return Err(head.fault("frequency responses as text (dataset 58)"));
                }
            }
            _ => other_dataset(&mut cursor, &head, &mut units)?,
        }
    }
    Ok((list, units))
}

/// Reads a dataset after its number, to the line that ends it; `None` if it is no frequency response.
fn response(cursor: &mut Cursor) -> Result<Option<FrequencyResponse>, Fault> {
    let head = FunctionHead::read(|expected| cursor.expect(expected))?;
    let [(abscissa, _), (numerator, line), (denominator, _), _] = head.axes.as_slice() else {
        return Err(head.data_fault("four axes"));
    };
    const FUNCTION: i64 = 4;
    let kind = ResponseKind::of_numerator(*numerator);
    let force = matches!(denominator, 9 | 13);
    let (Some(kind), 18, true, FUNCTION, true) = (kind, *abscissa, force, head.function, head.moves) else {
        cursor.skip()?;
        return Ok(None);
    };
    if axis_unit(line).eq_ignore_ascii_case("g") {
        return Err(line.fault("an acceleration in units of length, not in g"));
    }
    if !head.form.complex {
        return Err(head.data_fault("complex values of a frequency response"));
    }
    let (mut from, mut to) = (head.from, head.to);
    let name_of = |line: &str, begin: &str, point: &mut ResponsePoint| {
        if let Some(name) = line.strip_prefix(begin) {
            point.name = named(name);
        }
    };
    name_of(&head.names[3], REFERENCE, &mut from);
    name_of(&head.names[4], RESPONSE, &mut to);
    let (frequency_hz, value) = head.form.values(cursor)?;
    Ok(Some(FrequencyResponse { name: named(&head.names[0]), frequency_hz, value, kind, from, to }))
}
