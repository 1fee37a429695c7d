//! A channel of a file, and the signal that it becomes.

use std::path::Path;
use std::rc::Rc;

use super::MeasuredError;
use super::clock::Clock;
use crate::files::Fault;
use crate::numerics::series::TimeSeries;

/// Magnitudes whose fourth powers, which kurtosis takes, a number can hold.
const MAGNITUDES: [f64; 2] = [1e-60, 1e60];

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

/// A channel as a file has it.
pub(super) struct Channel {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) values: Vec<f64>,
    pub(super) clock: Rc<Clock>,
    /// Shaft speed that the file states, Hz, > 0.
    pub(super) speed_hz: Option<f64>,
}

impl Channel {
    pub(super) fn signal(self, path: &Path, request: &SignalRequest) -> Result<MeasuredSignal, MeasuredError> {
        let (start_s, step_s) = self.clock.grid(path, request.rate_hz)?;
        let series = TimeSeries::new(start_s, step_s, self.unit, self.values).map_err(|error| {
            MeasuredError::refused(format!("{}: channel \"{}\": {error}", path.display(), self.name))
        })?;
        let (peak, [least, most]) = (series.peak(), MAGNITUDES);
        let fits = peak == 0.0 || (least..=most).contains(&peak);
        let expected = format!("a largest magnitude from {least:e} to {most:e}");
        Fault::unless(fits, expected, format_args!("{peak:e}"))
            .map_err(|fault| fault.within(format!("channel \"{}\"", self.name)).of(path))?;
        Ok(MeasuredSignal { name: self.name, series, speed_hz: self.speed_hz, own_rate_hz: self.clock.rate_hz() })
    }
}

/// Places of the wanted channels among those that a file has.
pub(super) fn choose(path: &Path, names: &[String], request: &SignalRequest) -> Result<Vec<usize>, MeasuredError> {
    if request.channels.is_empty() {
        return match names.len() {
            1 => Ok(vec![0]),
            _ => Err(MeasuredError::Choose { path: path.to_owned(), known: names.to_vec() }),
        };
    }
    let place = |wanted: &String| {
        let places: Vec<usize> = (0..names.len()).filter(|&place| names[place] == *wanted).collect();
        match places[..] {
            [place] => Ok(place),
            [] => {
                let (path, wanted, known) = (path.to_owned(), wanted.clone(), names.to_vec());
                Err(MeasuredError::NoChannel { path, wanted, known })
            }
            _ => Err(MeasuredError::array(path, wanted, "one channel of this name", places.len().to_string())),
        }
    };
    request.channels.iter().map(place).collect()
}
