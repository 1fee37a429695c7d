//! What a file says beside a signal: when its samples were taken, how fast the shaft turned.
//!
//! The struct that the signal is in goes first, then the structs around it, then the variables of the file.

use std::path::Path;

use super::super::names::{is_bare_rate, is_rate, one_speed, same, speed_unit, time_unit};
use super::super::{MeasuredError, SignalRequest};
use super::array::{Array, Shape};

/// When samples were taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Taken<'a> {
    /// At instants of this array, which has its unit's seconds.
    ///
    /// Last, a sampling rate of the same struct, with its name and in Hz.
    Times(&'a Array, f64, Option<(&'a str, f64)>),
    /// So often, Hz.
    Rate(f64),
    /// Nothing says.
    Unknown,
}

/// Seconds in the unit of an array that is a time by its name and a vector.
pub(super) fn is_time(array: &Array) -> Option<f64> {
    let (_, name) = array.scope_and_name();
    let vector = matches!(array.shape, Shape::Vector(_)) && !array.complex;
    time_unit(name).filter(|_| vector)
}

/// The struct of an array, then those around it, then the file.
fn scopes(array: &Array) -> impl Iterator<Item = &str> {
    fn outer<'a>(scope: &&'a str) -> Option<&'a str> {
        let inner = Some(*scope).filter(|scope| !scope.is_empty())?;
        Some(inner.rsplit_once('.').map_or("", |(outer, _)| outer))
    }
    std::iter::successors(Some(array.scope_and_name().0), outer)
}

/// The numbers of a struct, with their names.
fn numbers<'a>(arrays: &'a [Array], scope: &'a str) -> impl Iterator<Item = (&'a Array, f64)> {
    arrays.iter().filter_map(move |array| match array.shape {
        Shape::Scalar(value) if array.scope_and_name().0 == scope => Some((array, value)),
        _ => None,
    })
}

/// When the samples of a signal in `array` were taken, `count` of them. A rate that is asked for takes the place of one in the file.
pub(super) fn taken<'a>(
    arrays: &'a [Array],
    array: &'a Array,
    count: usize,
    path: &Path,
    request: &SignalRequest,
) -> Result<Taken<'a>, MeasuredError> {
    let mut other_length = None;
    for scope in scopes(array) {
        for time in arrays.iter().filter(|time| time.scope_and_name().0 == scope) {
            match (is_time(time), time.shape) {
                (Some(unit), Shape::Vector(length)) if length == count => {
                    let stated = match request.rate_hz {
                        Some(_) => None,
                        None => rate(arrays, scope, path)?,
                    };
                    return Ok(Taken::Times(time, unit, stated));
                }
                (Some(_), Shape::Vector(length)) => {
                    other_length.get_or_insert(length);
                }
                _ => {}
            }
        }
        if request.rate_hz.is_none()
            && let Some((_, rate)) = rate(arrays, scope, path)?
        {
            return Ok(Taken::Rate(rate));
        }
    }
    match other_length {
        Some(length) if request.rate_hz.is_none() => {
            let expected = format!("a signal of {length} samples, as the time has");
            Err(MeasuredError::array(path, &array.path, expected, format!("{count} samples")))
        }
        _ => Ok(Taken::Unknown),
    }
}

/// The sampling rate among the numbers of a struct, with its name and in Hz.
fn rate<'a>(arrays: &'a [Array], scope: &'a str, path: &Path) -> Result<Option<(&'a str, f64)>, MeasuredError> {
    let mut rates = numbers(arrays, scope).filter(|(array, _)| is_rate(array.scope_and_name().1));
    let Some((array, rate)) = rates.next() else {
        return Ok(None);
    };
    let wrong = |expected: &str, found: String| MeasuredError::array(path, &array.path, expected, found);
    if !(rate > 0.0 && rate.is_finite()) {
        return Err(wrong("one sampling rate above 0 Hz", rate.to_string()));
    }
    match rates.find(|(_, other)| !same(rate, *other)) {
        Some((other, value)) => Err(wrong("one sampling rate", format!("{rate} and, in \"{}\", {value}", other.path))),
        None => Ok(Some((&array.path, rate))),
    }
}

/// The shaft speed that holds for a signal in `array`, Hz.
pub(super) fn speed_hz(arrays: &[Array], array: &Array) -> Option<f64> {
    scopes(array).find_map(|scope| {
        let named = |(array, value): (&Array, f64)| {
            let unit = speed_unit(array.scope_and_name().1)?;
            Some(unit * value)
        };
        let mut speeds = numbers(arrays, scope).filter_map(named).peekable();
        if speeds.peek().is_some() {
            return Some(one_speed(speeds));
        }
        // among the variables of a file "rate" may be of anything
        let is_struct = !scope.is_empty();
        let has_rate = numbers(arrays, scope).any(|(array, _)| is_rate(array.scope_and_name().1));
        let bare =
            numbers(arrays, scope).filter(|(array, _)| is_struct && has_rate && is_bare_rate(array.scope_and_name().1));
        let bare: Vec<f64> = bare.map(|(_, value)| value).collect();
        (!bare.is_empty()).then(|| one_speed(bare))
    })?
}
