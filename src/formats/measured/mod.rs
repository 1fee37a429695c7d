//! Measured signals, from the files of recorders and of this program.
//!
//! | ending | time | channels |
//! |---|---|---|
//! | `.npz` | array `time_s`, `time` or `t`, or a rate `rate_hz`, `fs` or `sampling_rate` (Hz) | arrays as long as the time; without one, every array of one dimension |
//! | `.mat` (MATLAB 5 to 7) | the same beside the signal, in its struct or in the file; more names of rates | vectors; columns of tables `x(:,1)`; fields of structs `bearing.gs` |
//! | `.csv`, `.txt` | a column `time`, `time_s`, `t`, with a unit `(ms)` or `[us]` if it is not s; without a header the first column | the others; names and units from the header, `P1 (m/s^2)` |
//! | `.wav` | the file's rate | one a channel, full scale 1 (`channel 1`, `channel 2`) |
//! | `.uff`, `.unv` | of the data set | data sets 58 and 58b of function type 1 over time |
//!
//! Archives and MATLAB files may state the shaft's speed too, by a number called `speed_hz`, `shaft_speed_hz` or `...rpm`; MATLAB
//! files also by `rate` beside a sampling rate in one struct.
//!
//! A rate that is asked for goes before what the file says of time; the first instant stays the file's. A time that is not
//! uniform is refused ([`MeasuredError::Uneven`]): a spectrum of such samples has lines that the signal does not have.
//!
//! This is a part of `exchange` and no row of its own: it reads files of other programs, and what it hands on is a
//! [`TimeSeries`]. Memory stays below ten times the file's size (npz arrays: what [`NpzReader`](super::NpzReader) says;
//! MATLAB files: 20 times, or 20 000 times where variables are packed): sizes that a file only promises are not believed.

mod clock;
mod csv;
mod error;
mod header;
mod mat;
mod npz;
mod stated;
#[cfg(test)]
mod tests;
mod uff;
mod wav;

use std::path::Path;

pub use error::MeasuredError;
pub use mat::signals_from_mat;

use crate::numerics::series::TimeSeries;
use clock::Clock;
use error::MAGNITUDES;

/// A signal with the name of its channel; the series has its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSignal {
    /// Name of the channel.
    pub name: String,
    /// The samples; the unit is empty where the file does not say it.
    pub series: TimeSeries,
    /// Shaft speed that the file itself states, Hz, > 0.
    pub speed_hz: Option<f64>,
    /// Sampling rate by what the file itself says of time, Hz, whatever rate was asked for.
    pub own_rate_hz: Option<f64>,
}

/// What is wanted of a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SignalRequest {
    /// Names of channels, in this order; none: the only one that there is.
    pub channels: Vec<String>,
    /// Sampling rate, Hz, > 0; none: what the file says.
    pub rate_hz: Option<f64>,
}

/// Reads signals from a file; its ending says what it is.
///
/// # Errors
/// [`MeasuredError`]: file and line or array, what was found, what was expected.
pub fn read_signals(
    path: &Path,
    request: &SignalRequest,
) -> Result<Vec<MeasuredSignal>, MeasuredError> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let channels = match ending.to_ascii_lowercase().as_str() {
        "npz" => npz::read(path, request),
        "mat" => mat::read(path, request),
        "csv" | "txt" => csv::read(path, request),
        "wav" => wav::read(path, request),
        "uff" | "unv" => uff::read(path, request),
        _ => Err(MeasuredError::Ending {
            path: path.to_owned(),
        }),
    }?;
    let made = channels
        .into_iter()
        .map(|channel| channel.signal(path, request));
    made.collect()
}

/// A channel as a file has it.
struct Channel {
    name: String,
    unit: String,
    values: Vec<f64>,
    clock: std::rc::Rc<Clock>,
    /// Shaft speed that the file states, Hz, > 0.
    speed_hz: Option<f64>,
}

impl Channel {
    fn signal(self, path: &Path, request: &SignalRequest) -> Result<MeasuredSignal, MeasuredError> {
        let (start_s, step_s) = self.clock.grid(path, request.rate_hz)?;
        let series =
            TimeSeries::new(start_s, step_s, self.unit, self.values).map_err(|source| {
                MeasuredError::Series {
                    path: path.to_owned(),
                    channel: self.name.clone(),
                    source,
                }
            })?;
        let peak = series.peak();
        if peak > 0.0 && !(MAGNITUDES[0]..=MAGNITUDES[1]).contains(&peak) {
            return Err(MeasuredError::Magnitude {
                path: path.to_owned(),
                channel: self.name,
                peak,
            });
        }
        Ok(MeasuredSignal {
            name: self.name,
            series,
            speed_hz: self.speed_hz,
            own_rate_hz: self.clock.rate_hz(),
        })
    }
}

/// Places of the wanted channels among those that a file has.
fn choose(
    path: &Path,
    names: &[String],
    request: &SignalRequest,
) -> Result<Vec<usize>, MeasuredError> {
    if request.channels.is_empty() {
        return match names.len() {
            1 => Ok(vec![0]),
            _ => Err(MeasuredError::Choose {
                path: path.to_owned(),
                known: names.to_vec(),
            }),
        };
    }
    let place = |wanted: &String| {
        let count = names.iter().filter(|name| *name == wanted).count();
        if count > 1 {
            return Err(MeasuredError::Array {
                path: path.to_owned(),
                name: wanted.clone(),
                expected: "one channel of this name".to_owned(),
                found: count.to_string(),
            });
        }
        let place = names.iter().position(|name| name == wanted);
        place.ok_or_else(|| MeasuredError::NoChannel {
            path: path.to_owned(),
            wanted: wanted.clone(),
            known: names.to_vec(),
        })
    };
    request.channels.iter().map(place).collect()
}
