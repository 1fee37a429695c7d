//! Signals in a universal file.

use std::path::Path;
use std::rc::Rc;

use super::super::uff::{TimeAxis, read_times_uff};
use super::channel::{Channel, choose};
use super::clock::Clock;
use super::{MeasuredError, SignalRequest};

pub(super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let mut found: Vec<_> = read_times_uff(path)?.into_iter().map(Some).collect();
    let names: Vec<String> = found
        .iter()
        .flatten()
        .map(|signal| signal.name.clone())
        .collect();
    let wanted = choose(path, &names, request)?;
    let mut channels = Vec::new();
    for place in wanted {
        // a channel that is asked for twice is there once
        let Some(signal) = found[place].take() else {
            continue;
        };
        let clock = match signal.axis {
            TimeAxis::Even { start_s, step_s } => Clock::Even { start_s, step_s },
            TimeAxis::Uneven(times) => Clock::Times {
                times,
                first_row: 0,
            },
        };
        channels.push(Channel {
            name: signal.name,
            unit: signal.unit,
            values: signal.values,
            clock: Rc::new(clock),
            speed_hz: None,
        });
    }
    Ok(channels)
}
