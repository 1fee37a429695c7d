//! Signals among the arrays of a file.
//!
//! What a file says beside a signal: when its samples were taken, how fast the shaft turned.
//!
//! The struct that the signal is in goes first, then the structs around it, then the variables of the file.

use super::super::channel::{Channel, Clock, choose};
use super::super::names::{is_bare_rate, is_rate, one_speed, same, speed_unit, time_unit};
use super::super::{MeasuredError, MeasuredSignal, SignalRequest};
use super::array::{Array, Search, Shape};
use super::element::{COMPRESSED, Element, byte_order};
use super::variable::{open, variables};
use crate::files;
use crate::files::{Fault, bytes_of};
use crate::formats::bytes::ByteOrder;
use std::borrow::Cow;
use std::path::Path;
use std::rc::Rc;

/// A file whose arrays are known and not read.
struct MatFile<'a> {
    bytes: &'a [u8],
    path: &'a Path,
    order: ByteOrder,
    variables: Vec<Element>,
    arrays: Vec<Array>,
}

/// A signal: an array, or a column or row of it.
#[derive(Debug, Clone, Copy)]
struct Place<'a> {
    array: &'a Array,
    /// First of its numbers in the array, the step between them, how many.
    start: usize,
    step: usize,
    count: usize,
}

/// The variable that was unpacked last.
type Opened<'a> = Option<(usize, Cow<'a, [u8]>)>;

/// Reads the wanted channels of a file.
pub(in super::super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    channels(&bytes_of(path)?, path, request)
}

/// Reads signals from the content of a MATLAB file; `path` is for messages.
///
/// # Errors
/// [`MeasuredError`], as [`read_signals`](super::super::read_signals).
pub fn signals_from_mat(
    bytes: &[u8],
    path: &Path,
    request: &SignalRequest,
) -> Result<Vec<MeasuredSignal>, MeasuredError> {
    channels(bytes, path, request)?.into_iter().map(|channel| channel.signal(path, request)).collect()
}

/// Reads the wanted channels.
fn channels(bytes: &[u8], path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let file = MatFile::of(bytes, path)?;
    let (names, places) = file.signals();
    let mut opened = None;
    let mut clock: Option<(&str, Rc<Clock>)> = None;
    let mut found = Vec::new();
    for chosen in choose(path, &names, request)? {
        let place = places[chosen];
        let array = place.array;
        if array.complex {
            return Err(MeasuredError::array(path, &names[chosen], "a signal of real numbers", "complex numbers"));
        }
        let taken = taken(&file.arrays, array, place.count, path, request)?;
        let own = match (taken, &clock) {
            // signals beside each other have one time
            (Taken::Times(times, ..), Some((path, clock))) if *path == times.path => Rc::clone(clock),
            (Taken::Times(times, unit, stated), _) => {
                let instants = Place { array: times, start: 0, step: 1, count: place.count };
                let mut times = file.values(&mut opened, instants)?;
                times.iter_mut().for_each(|time| *time *= unit);
                let own = Clock::Times { times, first_row: 0 };
                own.agrees(path, stated)?;
                Rc::new(own)
            }
            (Taken::Rate(rate), _) => Rc::new(Clock::Even { start_s: 0.0, step_s: 1.0 / rate }),
            (Taken::Unknown, _) => Rc::new(Clock::Unknown),
        };
        if let Taken::Times(times, ..) = taken {
            clock = Some((&times.path, Rc::clone(&own)));
        }
        found.push(Channel {
            name: names[chosen].clone(),
            unit: String::new(),
            values: file.values(&mut opened, place)?,
            clock: own,
            speed_hz: speed_hz(&file.arrays, array),
            doubts: Vec::new(),
        });
    }
    Ok(found)
}

impl<'a> MatFile<'a> {
    /// Looks through a file, a variable at a time.
    fn of(bytes: &'a [u8], path: &'a Path) -> Result<Self, MeasuredError> {
        let order = byte_order(bytes, path)?;
        let variables = variables(bytes, order).map_err(|fault| wrong(path, None, fault))?;
        let (mut arrays, mut count) = (Vec::new(), 0);
        for (variable, own) in variables.iter().enumerate() {
            let searched = open(own, bytes, order).and_then(|(whole, part)| {
                let mut search = Search { whole: &whole, order, variable, found: &mut arrays, count: &mut count };
                search.array(part, None, 0)
            });
            searched.map_err(|fault| wrong(path, Some(own), fault))?;
        }
        Ok(Self { bytes, path, order, variables, arrays })
    }

    /// Names and places of all signals. Those of a table run along its longer side: `x(:,1)` is a column, `x(1,:)` a row.
    fn signals(&self) -> (Vec<String>, Vec<Place<'_>>) {
        let (mut names, mut places) = (Vec::new(), Vec::new());
        for array in &self.arrays {
            let mut add = |name: String, start: usize, step: usize, count: usize| {
                names.push(name);
                places.push(Place { array, start, step, count });
            };
            let path = &array.path;
            match array.shape {
                Shape::Vector(count) if is_time(array).is_none() => add(path.clone(), 0, 1, count),
                Shape::Scalar(_) | Shape::Vector(_) => {}
                Shape::Matrix { rows, columns } if columns > rows => {
                    for row in 0..rows {
                        add(format!("{path}({},:)", row + 1), row, rows, columns);
                    }
                }
                Shape::Matrix { rows, columns } => {
                    for column in 0..columns {
                        add(format!("{path}(:,{})", column + 1), rows * column, 1, rows);
                    }
                }
            }
        }
        (names, places)
    }

    /// The numbers of a signal.
    fn values(&self, opened: &mut Opened<'a>, place: Place<'_>) -> Result<Vec<f64>, MeasuredError> {
        let Place { array, start, step, count } = place;
        let variable = &self.variables[array.variable];
        if opened.as_ref().is_none_or(|(last, _)| *last != array.variable) {
            // what was unpacked before is let go first
            *opened = None;
            let (whole, _) =
                open(variable, self.bytes, self.order).map_err(|fault| wrong(self.path, Some(variable), fault))?;
            *opened = Some((array.variable, whole));
        }
        let whole = opened.as_ref().map_or(&[][..], |(_, whole)| whole);
        let width = array.numbers.width();
        let bytes = whole.get(array.data.clone()).unwrap_or_default();
        let numbers = bytes.chunks_exact(width).skip(start).step_by(step).take(count);
        let mut values = Vec::with_capacity(count);
        values.extend(numbers.map(|bytes| array.numbers.value(bytes, self.order)));
        Ok(values)
    }
}

/// A fault of a variable or of the file, with its place.
fn wrong(path: &Path, variable: Option<&Element>, fault: Fault) -> MeasuredError {
    let packed = variable.filter(|variable| variable.kind == COMPRESSED);
    let packed = packed.map(|packed| format!(" of what byte {} packs", packed.data.start)).unwrap_or_default();
    let place = match &fault.place {
        files::Place::At(place) | files::Place::In(place) => format!("{place}{packed}"),
        files::Place::Whole | files::Place::Line(_) => packed,
    };
    fault.within(place).of(path).into()
}

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
