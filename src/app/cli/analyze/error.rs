//! What an analysis lacks.

use std::path::PathBuf;

use thiserror::Error;

use crate::app::cli::init::bearing_names;

/// Why there is nothing to analyse, or nothing to analyse it by.
#[derive(Debug, Error)]
pub enum AnalyzeError {
    /// A case without a bearing.
    #[error("{}: expected a case with [bearing], found none", path.display())]
    CaseWithoutBearing {
        /// The case file.
        path: PathBuf,
    },
    /// A name that is neither a file's nor a bearing's.
    #[error("--bearing: found \"{found}\", expected a case file or a bearing of the catalogue")]
    UnknownBearing {
        /// As typed.
        found: String,
    },
    /// A baseline without the channel that is analysed.
    #[error("--baseline {}: expected a channel \"{channel}\", or one channel alone; found {} others", baseline.display(), known.len())]
    BaselineChannel {
        /// The baseline.
        baseline: PathBuf,
        /// Channel that is analysed.
        channel: String,
        /// Channels of the baseline.
        known: Vec<String>,
    },
    /// A baseline in another unit.
    #[error("--baseline {}, channel \"{channel}\": expected {expected} as in {}, found {found}", baseline.display(), input.display())]
    BaselineUnit {
        /// The baseline.
        baseline: PathBuf,
        /// Its channel.
        channel: String,
        /// The file that is analysed.
        input: PathBuf,
        /// Unit of that.
        expected: String,
        /// Unit of the baseline.
        found: String,
    },
    /// A baseline that cannot be compared with.
    #[error("--baseline {}, channel \"{channel}\": {why}", baseline.display())]
    Baseline {
        /// The baseline.
        baseline: PathBuf,
        /// Its channel.
        channel: String,
        /// What is wrong with it.
        why: String,
    },
    /// A shaft that turns more than once in two samples.
    #[error("{}, channel \"{channel}\": expected a shaft speed below half of the sampling rate, {rate_hz:e} Hz, found {speed_hz:e} Hz", input.display())]
    TooFast {
        /// The file or folder.
        input: PathBuf,
        /// Its channel.
        channel: String,
        /// Sampling rate, Hz.
        rate_hz: f64,
        /// Mean shaft speed, Hz.
        speed_hz: f64,
    },
    /// Things that nothing says.
    #[error("{}: nothing says {}", input.display(), listed(missing))]
    Missing {
        /// The file or folder.
        input: PathBuf,
        /// What is missing.
        missing: Vec<Missing>,
    },
}

impl AnalyzeError {
    /// What to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Missing { missing, .. } => {
                let lines: Vec<String> = missing.iter().map(Missing::help).collect();
                Some(lines.join("\n"))
            }
            Self::UnknownBearing { .. } => Some(format!("bearings: {}", bearing_names())),
            Self::BaselineChannel { known, .. } => {
                let known: Vec<String> = known.iter().take(LISTED).map(|name| format!("\"{name}\"")).collect();
                Some(format!("--baseline-channel NAME; the baseline has {}", known.join(", ")))
            }
            Self::TooFast { .. } => Some("check --speed and --rate, or what the file says".to_owned()),
            Self::BaselineUnit { .. } => Some("scale one of the two files to the unit of the other".to_owned()),
            Self::Baseline { .. } => {
                Some("see --baseline-window and --baseline-speed for the part of it that counts".to_owned())
            }
            Self::CaseWithoutBearing { .. } => None,
        }
    }
}

/// Most channels that are listed.
const LISTED: usize = 20;

/// What an analysis needs and nothing says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Missing {
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
    fn what(&self) -> &'static str {
        match self {
            Self::Channel { .. } => "which channel is meant",
            Self::Rate => "how fast it was sampled",
            Self::Bearing => "which bearing it is",
            Self::Speed => "how fast the shaft turns",
        }
    }

    /// What to type.
    fn help(&self) -> String {
        match self {
            Self::Channel { known } => {
                let first = known.iter().take(LISTED).map(|name| format!("\"{name}\""));
                let more = if known.len() > LISTED { ", ..." } else { "" };
                let names = first.collect::<Vec<_>>().join(", ");
                format!("--channel NAME (repeatable), of {names}{more}")
            }
            Self::Rate => "--rate HZ, the sampling rate".to_owned(),
            Self::Bearing => "--bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)".to_owned(),
            Self::Speed => "--speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...".to_owned(),
        }
    }
}

/// Everything that is missing, in words.
fn listed(missing: &[Missing]) -> String {
    let words: Vec<&str> = missing.iter().map(Missing::what).collect();
    match words.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}
