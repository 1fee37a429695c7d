//! Signals of a file, and all that nothing says of them.

use std::path::Path;

use super::Missing;
use crate::formats::{MeasuredError, MeasuredSignal, SignalRequest, read_signals};

/// Which channels are read where none is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unnamed {
    /// The only one.
    Only,
    /// Every one.
    Every,
}

/// What was read.
#[derive(Debug, Default)]
pub(super) struct Read {
    /// The signals, if nothing is missing; else perhaps one, which the file's own statements can be asked of.
    pub(super) signals: Vec<MeasuredSignal>,
    /// What nothing says, in the order of [`Missing`].
    pub(super) missing: Vec<Missing>,
    /// The reader's own word on what is missing.
    pub(super) first: Option<MeasuredError>,
    /// Arrays that were left out as they are no signals, in words.
    pub(super) left_out: Vec<String>,
}

/// Reads signals; what is missing is gathered, with a stand-in in its place, so that all of it can be said at once.
///
/// # Errors
/// [`MeasuredError`] of a file that cannot be read.
pub(super) fn read(path: &Path, mut request: SignalRequest, unnamed: Unnamed) -> Result<Read, MeasuredError> {
    let mut read = Read::default();
    let mut every = false;
    loop {
        match read_signals(path, &request) {
            Ok(signals) => {
                read.signals = signals;
                break;
            }
            Err(error @ MeasuredError::NoTime { .. }) if request.rate_hz.is_none() => {
                read.missing.push(Missing::Rate);
                read.first.get_or_insert(error);
                request.rate_hz = Some(1.0);
            }
            Err(MeasuredError::Choose { known, .. }) if unnamed == Unnamed::Every && !known.is_empty() => {
                every = true;
                for name in known {
                    if request.channels.contains(&name) {
                        let words = format!("{}: a second channel \"{name}\" is left out.", path.display());
                        read.left_out.push(words);
                    } else {
                        request.channels.push(name);
                    }
                }
            }
            Err(MeasuredError::Choose { path, known }) if !known.is_empty() => {
                request.channels.push(known[0].clone());
                read.missing.insert(0, Missing::Channel { known: known.clone() });
                read.first.get_or_insert(MeasuredError::Choose { path, known });
            }
            Err(MeasuredError::Array { name, found, .. }) if every && request.channels.len() > 1 => {
                request.channels.retain(|channel| *channel != name);
                let words = format!("{}: array \"{name}\" is left out: it is no signal ({found}).", path.display());
                read.left_out.push(words);
            }
            // the stand-in's fault
            Err(_) if !read.missing.is_empty() => break,
            Err(error) => return Err(error),
        }
    }
    Ok(read)
}
