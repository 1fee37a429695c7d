//! Signals in a NumPy archive.

use std::path::Path;
use std::rc::Rc;

use super::super::NpzReader;
use super::channel::{Channel, choose};
use super::clock::Clock;
use super::names::{one_speed, speed_unit, time_unit};
use super::{MeasuredError, SignalRequest};

/// Names of arrays of one value that are a rate in Hz.
const RATES: [&str; 4] = ["rate_hz", "fs", "sampling_rate", "sample_rate"];

pub(super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let mut archive = NpzReader::open(path)?;
    let names = archive.names();
    let time = names.iter().find(|name| time_unit(name).is_some());
    let rate = names.iter().find(|name| RATES.contains(&name.as_str()));
    let stated = match rate {
        Some(name) => {
            let values = archive.real(name)?.values;
            match values.as_slice() {
                &[rate] if rate > 0.0 && rate.is_finite() => Some((name.as_str(), rate)),
                found => {
                    let found = match found {
                        [one] => one.to_string(),
                        more => format!("{} values", more.len()),
                    };
                    return Err(MeasuredError::array(path, name, "one sampling rate above 0 Hz", found));
                }
            }
        }
        None => None,
    };
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
        found.push(Channel {
            name: name.clone(),
            unit: String::new(),
            values: array.values,
            clock: Rc::clone(&clock),
            speed_hz,
        });
    }
    Ok(found)
}

/// Arrays of one number that is a shaft speed by its name, with the speed in Hz; others of such a name are signals.
fn speeds(archive: &mut NpzReader, names: &[String]) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    for name in names {
        if let Some(unit) = speed_unit(name)
            && let Ok(array) = archive.real(name)
            && let &[speed] = array.values.as_slice()
        {
            found.push((name.clone(), unit * speed));
        }
    }
    found
}
