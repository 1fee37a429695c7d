//! What can be wrong with a file of measured signals.

use std::path::PathBuf;

use thiserror::Error;

use super::super::FormatError;
use crate::files::FileError;
use crate::numerics::series::SeriesError;

/// Why a signal cannot be read.
#[derive(Debug, Error)]
pub enum MeasuredError {
    /// The file cannot be read, or something in it is not what should stand there.
    #[error(transparent)]
    File(#[from] FileError),
    /// An ending that says of no format.
    #[error("{}: expected a file .npz, .mat, .csv, .txt, .wav, .uff or .unv, or a folder with results of `plummer run`", path.display())]
    Ending {
        /// The file.
        path: PathBuf,
    },
    /// An archive or a universal file that cannot be read, or has no signals.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// A sound file that is damaged.
    #[error("{}: expected a sound file (RIFF WAVE, PCM of 8 to 32 bits, float of 32 or 64), found: {found}", path.display())]
    Wav {
        /// The file.
        path: PathBuf,
        /// What the library found.
        found: String,
    },
    /// A MATLAB file of a version that is not read.
    #[error("{}: expected a MATLAB file of version 5 to 7, found version {found}", path.display())]
    MatVersion {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: &'static str,
    },
    /// Numbers with a comma.
    #[error("{}:{line}: expected numbers with a decimal point, found \"{found}\"", path.display())]
    DecimalComma {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: u64,
        /// What stands there.
        found: String,
    },
    /// Arrays that do not fit together.
    #[error("{}: array \"{name}\": expected {expected}, found {found}", path.display())]
    Array {
        /// The file.
        path: PathBuf,
        /// The array.
        name: String,
        /// What was expected.
        expected: String,
        /// What the array has.
        found: String,
    },
    /// Nothing says when the samples were taken.
    #[error("{}: expected a time or a sampling rate, found neither", path.display())]
    NoTime {
        /// The file.
        path: PathBuf,
    },
    /// Instants and a sampling rate that contradict each other.
    #[error("{}: expected one sampling rate, found {rate_hz} Hz in \"{name}\" and {found_hz} Hz by the time", path.display())]
    TwoRates {
        /// The file.
        path: PathBuf,
        /// The array that has the rate.
        name: String,
        /// That rate, Hz.
        rate_hz: f64,
        /// The rate of the instants, Hz.
        found_hz: f64,
    },
    /// Steps that are not equal.
    #[error("{}: row {row}: expected equal time steps of {expected_s} s (the median, within {} %), found a step of {found_s} s", path.display(), 100.0 * STEP_TOLERANCE)]
    Uneven {
        /// The file.
        path: PathBuf,
        /// Row of the later instant: a line of a table, a place counted from 0 in an array.
        row: u64,
        /// Step found, s.
        found_s: f64,
        /// Median step, s.
        expected_s: f64,
    },
    /// Instants that leave equal steps little by little.
    #[error("{}: row {row}: expected equal time steps, so that t = {expected_s} s here within half a step, found {found_s} s", path.display())]
    Drift {
        /// The file.
        path: PathBuf,
        /// Row: a line of a table, a place counted from 0 in an array.
        row: u64,
        /// Instant found, s.
        found_s: f64,
        /// Instant of equal steps, s.
        expected_s: f64,
    },
    /// Several channels, and none was named.
    #[error("{}: expected one signal or the name of one, found {}", path.display(), quoted(known))]
    Choose {
        /// The file.
        path: PathBuf,
        /// Channels of the file.
        known: Vec<String>,
    },
    /// No channel of this name.
    #[error("{}: expected a channel \"{wanted}\", found {}", path.display(), quoted(known))]
    NoChannel {
        /// The file.
        path: PathBuf,
        /// Name asked for.
        wanted: String,
        /// Channels of the file.
        known: Vec<String>,
    },
    /// Samples that are none, or no samples.
    #[error("{}: channel \"{channel}\": {source}", path.display())]
    Series {
        /// The file.
        path: PathBuf,
        /// The channel.
        channel: String,
        /// What is wrong.
        source: SeriesError,
    },
}

/// How far one step may be from the median step, relative: what six digits leave of 48 kHz, and far from a lost sample.
pub(super) const STEP_TOLERANCE: f64 = 0.1;

/// Most names that are listed.
const LISTED: usize = 20;

fn quoted(names: &[String]) -> String {
    if names.is_empty() {
        return "no signals".to_owned();
    }
    let listed: Vec<String> = names.iter().take(LISTED).map(|n| format!("\"{n}\"")).collect();
    let more = match names.len().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("{}{more}", listed.join(", "))
}

impl MeasuredError {
    /// What to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::NoTime { .. } => Some("give the sampling rate with --rate HZ".to_owned()),
            Self::TwoRates { .. } => {
                Some("--rate HZ takes the place of both; or leave the wrong one out of the file".to_owned())
            }
            Self::Choose { .. } => Some("name it with --channel NAME (repeatable)".to_owned()),
            Self::NoChannel { wanted, known, .. } => {
                let nearest = known.iter().map(|name| (strsim::damerau_levenshtein(wanted, name), name)).min();
                nearest.map(|(_, name)| format!("did you mean --channel '{name}'?"))
            }
            Self::Uneven { .. } | Self::Drift { .. } => Some(
                "resample the signal at equal steps; if only the time column is coarse, --rate HZ takes its place"
                    .to_owned(),
            ),
            Self::MatVersion { path, .. } => {
                let name = path.file_stem().unwrap_or_default().to_string_lossy();
                Some(format!(
                    "write it again as version 7: in MATLAB m = load('{name}.mat'); save('{name}-v7.mat', '-struct', 'm', '-v7'), \
                     or in Python scipy.io.savemat('{name}-v7.mat', {{'x': x}})"
                ))
            }
            Self::DecimalComma { .. } => {
                Some("write the table with decimal points; the separator may stay a semicolon".to_owned())
            }
            _ => None,
        }
    }
}
