//! Reads signals from a file of any format.

use std::path::Path;
use std::rc::Rc;

use super::super::uff::{TimeAxis, TimeResponse, read_times_uff};
use super::channel::{Channel, Clock, choose};
use super::{MeasuredError, MeasuredSignal, SignalRequest, csv, mat, npz, wav};

/// Reads signals from a file; its ending says what it is.
///
/// # Errors
/// [`MeasuredError`]: file and line or array, what was found, what was expected.
pub fn read_signals(path: &Path, request: &SignalRequest) -> Result<Vec<MeasuredSignal>, MeasuredError> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let channels = match ending.to_ascii_lowercase().as_str() {
        "npz" => npz::read(path, request),
        "mat" => mat::read(path, request),
        "csv" | "txt" | "tsv" | "asc" | "lvm" => csv::read(path, request),
        "wav" => wav::read(path, request),
        "uff" | "unv" => universal(path, request),
        _ => {
            const EXPECTED: &str = "a file .npz, .mat, .csv, .txt, .tsv, .asc, .lvm, .wav, .uff or .unv, or a folder with results of `plummer run`";
            Err(MeasuredError::refused(format!("{}: expected {EXPECTED}", path.display())))
        }
    }?;
    channels.into_iter().map(|channel| channel.signal(path, request)).collect()
}

/// Reads the wanted channels of a universal file.
fn universal(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let mut found: Vec<_> = read_times_uff(path)?.into_iter().map(Some).collect();
    let names: Vec<String> = found.iter().flatten().map(|signal| signal.name.clone()).collect();
    let wanted = choose(path, &names, request)?;
    let mut channels = Vec::new();
    for place in wanted {
        // a channel that is asked for twice is there once
        let Some(signal) = found[place].take() else {
            continue;
        };
        let clock = match signal.axis {
            TimeAxis::Even { start_s, step_s } => Clock::Even { start_s, step_s },
            TimeAxis::Uneven(times) => Clock::Times { times, first_row: 0 },
        };
        let TimeResponse { name, unit, values, .. } = signal;
        channels.push(Channel { name, unit, values, clock: Rc::new(clock), speed_hz: None, doubts: Vec::new() });
    }
    Ok(channels)
}
