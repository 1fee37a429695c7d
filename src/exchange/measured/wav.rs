//! Signals in a sound file.

use std::path::Path;
use std::rc::Rc;

use hound::{SampleFormat, WavReader};

use super::clock::Clock;
use super::{Channel, MeasuredError, SignalRequest, choose};

pub(super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let fault = |error: hound::Error| match error {
        // what the system says has a number; the library's own complaint about a short file has none
        hound::Error::IoError(source) if source.raw_os_error().is_some() => MeasuredError::Read {
            path: path.to_owned(),
            source,
        },
        other => MeasuredError::Wav {
            path: path.to_owned(),
            found: other.to_string(),
        },
    };
    let mut reader = WavReader::open(path).map_err(fault)?;
    let spec = reader.spec();
    if spec.sample_rate == 0 || spec.channels == 0 {
        return Err(MeasuredError::Wav {
            path: path.to_owned(),
            found: format!("{} Hz and {} channels", spec.sample_rate, spec.channels),
        });
    }
    let channels = usize::from(spec.channels);
    let names: Vec<String> = (1..=channels).map(|n| format!("channel {n}")).collect();
    let wanted = choose(path, &names, request)?;
    let mut values = vec![Vec::new(); wanted.len()];
    let mut take = |place: usize, value: f64| {
        for (wanted, values) in wanted.iter().zip(&mut values) {
            if place % channels == *wanted {
                values.push(value);
            }
        }
    };
    // samples as they come: the head's number of them is not believed
    match spec.sample_format {
        SampleFormat::Float => {
            for (place, sample) in reader.samples::<f32>().enumerate() {
                take(place, f64::from(sample.map_err(fault)?));
            }
        }
        SampleFormat::Int => {
            let full = f64::from(spec.bits_per_sample.clamp(1, 32) - 1).exp2();
            for (place, sample) in reader.samples::<i32>().enumerate() {
                take(place, f64::from(sample.map_err(fault)?) / full);
            }
        }
    }
    let clock = Rc::new(Clock::Even {
        start_s: 0.0,
        step_s: 1.0 / f64::from(spec.sample_rate),
    });
    let pairs = wanted.iter().zip(values);
    let made = pairs.map(|(&place, values)| Channel {
        name: names[place].clone(),
        unit: "full scale".to_owned(),
        values,
        clock: Rc::clone(&clock),
    });
    Ok(made.collect())
}
