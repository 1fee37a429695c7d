//! A channel of a file, and the signal that it becomes.
//!
//! When samples were taken, and whether at equal steps.

use super::MeasuredError;
use crate::files::Fault;
use crate::numerics::series::TimeSeries;
use std::path::Path;
use std::rc::Rc;

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
    /// What was read in one of two ways that the file allows, in words.
    pub doubts: Vec<String>,
}

impl MeasuredSignal {
    /// A signal in memory.
    ///
    /// # Errors
    /// [`MeasuredError`] for magnitudes whose fourth powers no number holds.
    pub fn in_memory(name: String, series: TimeSeries) -> Result<Self, MeasuredError> {
        check_magnitude(&name, &series).map_err(|fault| MeasuredError::refused(fault.to_string()))?;
        Ok(Self { name, own_rate_hz: Some(series.rate_hz()), series, speed_hz: None, doubts: Vec::new() })
    }
}

fn check_magnitude(name: &str, series: &TimeSeries) -> Result<(), Fault> {
    let (peak, [least, most]) = (series.peak(), MAGNITUDES);
    let fits = peak == 0.0 || (least..=most).contains(&peak);
    let expected = format!("a largest magnitude from {least:e} to {most:e}");
    Fault::unless(fits, expected, format_args!("{peak:e}")).map_err(|fault| fault.within(format!("channel \"{name}\"")))
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
    /// As of [`MeasuredSignal::doubts`].
    pub(super) doubts: Vec<String>,
}

impl Channel {
    pub(super) fn signal(self, path: &Path, request: &SignalRequest) -> Result<MeasuredSignal, MeasuredError> {
        let (start_s, step_s) = self.clock.grid(path, request.rate_hz)?;
        let series = TimeSeries::new(start_s, step_s, self.unit, self.values).map_err(|error| {
            MeasuredError::refused(format!("{}: channel \"{}\": {error}", path.display(), self.name))
        })?;
        check_magnitude(&self.name, &series).map_err(|fault| fault.of(path))?;
        let own_rate_hz = self.clock.rate_hz();
        Ok(MeasuredSignal { name: self.name, series, speed_hz: self.speed_hz, own_rate_hz, doubts: self.doubts })
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

/// How far one step may be from the median step, relative: what six digits leave of 48 kHz, and far from a lost sample.
const STEP_TOLERANCE: f64 = 0.1;

/// How far an instant may be from that of equal steps, in steps: half a sample.
const DRIFT_TOLERANCE: f64 = 0.5;

/// How far a stated rate may be from that of the instants, relative: what rounded instants leave of it.
const SAME_RATE: f64 = 1e-3;

/// What a file says of time.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Clock {
    /// An instant a sample, s, and what its places are called: "row", counted from the first.
    Times { times: Vec<f64>, first_row: u64 },
    /// First instant and step, s.
    Even { start_s: f64, step_s: f64 },
    /// Nothing.
    Unknown,
}

impl Clock {
    /// First instant and step, s.
    pub(super) fn grid(&self, path: &Path, rate_hz: Option<f64>) -> Result<(f64, f64), MeasuredError> {
        match (self, rate_hz) {
            (Self::Times { times, .. }, Some(rate)) => Ok((times.first().copied().unwrap_or(0.0), 1.0 / rate)),
            (Self::Even { start_s, .. }, Some(rate)) => Ok((*start_s, 1.0 / rate)),
            (Self::Unknown, Some(rate)) => Ok((0.0, 1.0 / rate)),
            (Self::Even { start_s, step_s }, None) => Ok((*start_s, *step_s)),
            (Self::Times { times, first_row }, None) => even(path, times, *first_row),
            (Self::Unknown, None) => Err(MeasuredError::NoTime { path: path.to_owned() }),
        }
    }

    /// The sampling rate that a file's own words amount to, Hz.
    pub(super) fn rate_hz(&self) -> Option<f64> {
        let step_s = match self {
            Self::Even { step_s, .. } => *step_s,
            Self::Times { times, .. } => (times.last()? - times.first()?) / (times.len() - 1) as f64,
            Self::Unknown => return None,
        };
        (step_s > 0.0).then(|| 1.0 / step_s)
    }

    /// Refuses a rate, an array's name and its value in Hz, that instants contradict.
    pub(super) fn agrees(&self, path: &Path, stated: Option<(&str, f64)>) -> Result<(), MeasuredError> {
        match (self.rate_hz(), stated) {
            (Some(found_hz), Some((name, rate_hz))) if (found_hz / rate_hz - 1.0).abs() > SAME_RATE => {
                let message = format!(
                    "{}: expected one sampling rate, found {rate_hz} Hz in \"{name}\" and {found_hz} Hz by the time",
                    path.display()
                );
                let help = "--rate HZ takes the place of both; or leave the wrong one out of the file";
                Err(MeasuredError::refused_with(message, help))
            }
            _ => Ok(()),
        }
    }
}

/// Checks that steps are equal. The step is that of the whole, (last - first) / (n - 1).
fn even(path: &Path, times: &[f64], first_row: u64) -> Result<(f64, f64), MeasuredError> {
    let &[first, .., last] = times else {
        return Err(MeasuredError::NoTime { path: path.to_owned() });
    };
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = steps.len() / 2;
    let median = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    let uneven = |place: usize, expected: String, found: String| {
        let (path, row) = (path.display(), first_row + place as u64);
        Err(MeasuredError::refused_with(
            format!("{path}: row {row}: expected equal time steps{expected}, found {found} s"),
            "resample the signal at equal steps; if only the time column is coarse, or the first of columns without names is no time, --rate HZ takes its place",
        ))
    };
    let mut pairs = times.windows(2).enumerate();
    // a median of nothing, or of times that fall, is no step to expect
    let expected = match median > 0.0 {
        true => format!(" of {median} s (the median, within {} %)", 100.0 * STEP_TOLERANCE),
        false => " above 0 s".to_owned(),
    };
    let wrong = pairs.find(|(_, pair)| {
        let step = pair[1] - pair[0];
        // a step that is none (NaN) is wrong too
        !(step > 0.0 && (median <= 0.0 || (step / median - 1.0).abs() <= STEP_TOLERANCE))
    });
    if let Some((place, pair)) = wrong {
        return uneven(place + 1, expected, format!("a step of {}", pair[1] - pair[0]));
    }
    let step = (last - first) / (times.len() - 1) as f64;
    let drift = |(place, time): (usize, &f64)| (time - first - place as f64 * step).abs() > DRIFT_TOLERANCE * step;
    if let Some(place) = times.iter().enumerate().position(drift) {
        let expected = format!(", so that t = {} s here within half a step", first + place as f64 * step);
        return uneven(place, expected, times[place].to_string());
    }
    Ok((first, step))
}
