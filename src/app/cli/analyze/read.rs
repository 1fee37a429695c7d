//! Signals of a file, and all that nothing says of them.

use std::path::Path;

use crate::app::cli::CliError;
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

/// Most channels that are listed.
const LISTED: usize = 20;

/// What an analysis needs and nothing says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Missing {
    /// Which of these channels is meant.
    Channel {
        /// Channels of the file.
        known: Vec<String>,
    },
    /// How fast the signal was sampled.
    Rate,
    /// How often parts strike.
    Bearing,
    /// How fast the shaft turns.
    Speed,
}

impl Missing {
    /// What it is, and what to type.
    fn what_and_help(&self) -> (&'static str, String) {
        let (what, help) = match self {
            Self::Channel { known } => {
                let more = if known.len() > LISTED { ", ..." } else { "" };
                let help = format!("--channel NAME (repeatable), of {}{more}", first_channels(known));
                return ("which channel is meant", help);
            }
            Self::Rate => ("how fast it was sampled", "--rate HZ, the sampling rate"),
            Self::Bearing => (
                "which bearing it is",
                "--bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)",
            ),
            Self::Speed => {
                ("how fast the shaft turns", "--speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...")
            }
        };
        (what, help.to_owned())
    }
}

/// The error of an input of which something is missing, with what to type for each.
pub(super) fn nothing_says(input: &Path, missing: &[Missing]) -> CliError {
    let (words, help): (Vec<&str>, Vec<String>) = missing.iter().map(Missing::what_and_help).unzip();
    let listed = match words.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    };
    CliError::input(format!("{}: nothing says {listed}", input.display())).with_help(help.join("\n"))
}

/// The first channels by name, in quotation marks.
pub(super) fn first_channels(known: &[String]) -> String {
    let quoted: Vec<String> = known.iter().take(LISTED).map(|name| format!("\"{name}\"")).collect();
    quoted.join(", ")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{Missing, nothing_says};

    fn lines(missing: &[Missing]) -> String {
        let error = nothing_says(Path::new("out/a"), missing);
        assert_eq!(error.exit_code(), 2);
        let mut lines = Vec::new();
        error.report(&mut lines);
        String::from_utf8(lines).unwrap()
    }

    #[test]
    fn all_that_is_missing_is_said_at_once() {
        let channel = Missing::Channel { known: vec!["P1".to_owned(), "P2".to_owned()] };
        assert_eq!(
            lines(&[channel, Missing::Rate, Missing::Speed]),
            "error: out/a: nothing says which channel is meant, how fast it was sampled and how fast the shaft turns\n\
             help: --channel NAME (repeatable), of \"P1\", \"P2\"\n\
             help: --rate HZ, the sampling rate\n\
             help: --speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...\n",
        );
        assert_eq!(
            lines(&[Missing::Bearing]),
            "error: out/a: nothing says which bearing it is\n\
             help: --bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)\n",
        );
    }
}
