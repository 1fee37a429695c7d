//! Why there is no chart.

use crate::app::error::ComputeError;
use crate::numerics::series::SeriesError;
use crate::signal::SignalError;
use crate::system::SystemError;
use thiserror::Error;

/// Why a chart could not be made.
#[derive(Debug, Error)]
pub enum ChartError {
    /// The scene cannot be built.
    #[error(transparent)]
    Stage(Box<ComputeError>),
    /// There is nothing to compare with.
    #[error("the reference by {method} failed at the start at {start_s} s: {reason}")]
    NoReference {
        /// The method.
        method: &'static str,
        /// Where it began, s.
        start_s: f64,
        /// What happened.
        reason: String,
    },
    /// Too few starts are in equilibrium.
    #[error("{found} of {wanted} starts over a ball pass have an equilibrium, at least 2 are needed: {source}")]
    NoStarts {
        /// Found.
        found: usize,
        /// Wanted.
        wanted: usize,
        /// Why the first of the others has none.
        source: SystemError,
    },
    /// What is simulated is too short for the band.
    #[error(
        "transient.end - transient.start is {found} s: a chart in the band up to {band_hz} Hz needs at least {needed} s"
    )]
    TooShort {
        /// Simulated time, s.
        found: f64,
        /// Highest frequency of interest, Hz.
        band_hz: f64,
        /// Time that is needed, s.
        needed: f64,
    },
}

impl From<ComputeError> for ChartError {
    fn from(error: ComputeError) -> Self {
        Self::Stage(Box::new(error))
    }
}

impl From<SystemError> for ChartError {
    fn from(error: SystemError) -> Self {
        ComputeError::from(error).into()
    }
}

impl From<SignalError> for ChartError {
    fn from(error: SignalError) -> Self {
        ComputeError::from(error).into()
    }
}

impl From<SeriesError> for ChartError {
    fn from(error: SeriesError) -> Self {
        ComputeError::from(error).into()
    }
}

impl ChartError {
    /// Whether the input is to blame.
    pub(crate) fn is_input(&self) -> bool {
        match self {
            Self::Stage(error) => error.is_input(),
            Self::TooShort { .. } => true,
            Self::NoReference { .. } | Self::NoStarts { .. } => false,
        }
    }

    /// What to do about it.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Stage(error) => error.help(),
            Self::TooShort { needed, .. } => Some(format!(
                "a later transient.end, by at least {needed} s after transient.start"
            )),
            Self::NoReference { .. } => Some(
                "`plummer run` with transient.modes = \"all\" shows what happens there; another transient.start begins elsewhere"
                    .to_owned(),
            ),
            Self::NoStarts { .. } => Some("another transient.start begins elsewhere".to_owned()),
        }
    }
}
