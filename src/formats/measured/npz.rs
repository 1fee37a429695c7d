//! Signals in a NumPy archive.

use std::path::Path;
use std::rc::Rc;

use super::super::NpzReader;
use super::channel::{Channel, Clock, choose};
use super::names::{one_speed, speed_unit, time_unit};
use super::{MeasuredError, SignalRequest};

/// Names of arrays of one value that are a rate in Hz.
const RATES: [&str; 4] = ["rate_hz", "fs", "sampling_rate", "sample_rate"];

pub(super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let mut archive = NpzReader::open(path)?;
    let names = archive.names();
    let mut times = names.iter().filter(|name| time_unit(name).is_some());
    let time = times.next();
    if let (Some(first), Some(second), None) = (time, times.next(), request.rate_hz) {
        return Err(MeasuredError::array(path, second, "one array of times", format!("\"{first}\" beside it")));
    }
    let rate = names.iter().find(|name| RATES.contains(&name.as_str()));
    let mut stated = None;
    if let Some(name) = rate {
        let wrong = |found: String| MeasuredError::array(path, name, "one sampling rate above 0 Hz", found);
        stated = match archive.real(name)?.values[..] {
            [rate] if rate > 0.0 && rate.is_finite() => Some((name.as_str(), rate)),
            [one] => return Err(wrong(one.to_string())),
            ref more => return Err(wrong(format!("{} values", more.len()))),
        };
    }
    let clock = match (time, stated) {
        (Some(name), _) => {
            let unit = time_unit(name).unwrap_or(1.0);
            let mut times = archive.real(name)?.values;
            times.iter_mut().for_each(|time| *time *= unit);
            Clock::Times { times, first_row: 0 }
        }
        (None, Some((_, rate))) => Clock::Even { start_s: 0.0, step_s: 1.0 / rate },
        (None, None) => Clock::Unknown,
    };
    if request.rate_hz.is_none() {
        clock.agrees(path, stated)?;
    }
    let speeds = speeds(&mut archive, &names);
    let speed_hz = one_speed(speeds.iter().map(|(_, hz)| *hz));
    let is_speed = |name: &String| speeds.iter().any(|(speed, _)| speed == name);
    let channels: Vec<String> =
        names.iter().filter(|name| Some(*name) != time && Some(*name) != rate && !is_speed(name)).cloned().collect();
    let rows = match &clock {
        Clock::Times { times, .. } => Some(times.len()),
        _ => None,
    };
    let clock = Rc::new(clock);
    let mut found = Vec::new();
    for place in choose(path, &channels, request)? {
        let name = &channels[place];
        let array = archive.real(name)?;
        let count = array.shape.iter().filter(|&&length| length != 1).count();
        if count > 1 || rows.is_some_and(|rows| rows != array.values.len()) {
            let expected = match rows {
                Some(rows) => format!("a signal of {rows} samples, as the time has"),
                None => "a signal, an array of one dimension".to_owned(),
            };
            return Err(MeasuredError::array(path, name, expected, format!("shape {:?}", array.shape)));
        }
        let (name, unit, clock) = (name.clone(), String::new(), Rc::clone(&clock));
        found.push(Channel { name, unit, values: array.values, clock, speed_hz, doubts: Vec::new() });
    }
    Ok(found)
}

/// Arrays of one number that is a shaft speed by its name, with the speed in Hz; others of such a name are signals.
fn speeds(archive: &mut NpzReader, names: &[String]) -> Vec<(String, f64)> {
    let speed = |name: &String| {
        let unit = speed_unit(name)?;
        match archive.real(name).ok()?.values[..] {
            [speed] => Some((name.clone(), unit * speed)),
            _ => None,
        }
    };
    names.iter().filter_map(speed).collect()
}
