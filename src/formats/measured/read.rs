//! Reads signals from a file of any format.

use std::path::Path;

use super::{MeasuredError, MeasuredSignal, SignalRequest};
use super::{csv, mat, npz, uff, wav};

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
