//! What can go wrong on the way from a case to a result: what failed, whose fault it is and what to do.

use crate::app::case::CaseError;
use crate::bearing::BearingError;
use crate::fe::element::ElementError;
use crate::fe::material::MaterialError;
use crate::fe::mesh::MeshError;
use crate::fe::modal::ModalError;
use crate::fe::model::{HousingModel, ModelError, NodeInterface, RingError};
use crate::fe::reduction::ReductionError;
use crate::fe::reduction::frf::FrfError;
use crate::files::{Fault, FileError, Place};
use crate::formats::{FormatError, MeasuredError};
use crate::numerics::linalg::HarmonicError;
use crate::numerics::linalg::LinalgError;
use crate::numerics::ode::TransientError;
use crate::numerics::series::SeriesError;
use crate::report::ReportError;
use crate::signal::SignalError;
use crate::signal::diagnosis::DiagnosisError;
use crate::system::SystemError;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Failure of a stage.
#[derive(Debug, Error)]
pub enum ComputeError {
    /// Input that nothing can be computed with.
    #[error("{what}")]
    Input {
        /// What is wrong, and where.
        what: String,
        /// What to do about it.
        help: Option<String>,
    },
    /// The case file.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A file of signals.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// A signal that cannot be judged.
    #[error(transparent)]
    Diagnosis(#[from] DiagnosisError),
    /// The mesh file.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Mesh and case do not fit.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Plane properties out of range.
    #[error("housing.plane: {0}")]
    Plane(#[from] ElementError),
    /// A ring section out of range.
    #[error("ring.sections: {0}")]
    Section(#[from] MaterialError),
    /// Modes that cannot be analysed.
    #[error(transparent)]
    Modal(ModalError),
    /// A file of mode shapes that cannot be read.
    #[error(transparent)]
    ModeShapes(FormatError),
    /// Another mesh of the case that fails.
    #[error("modes.convergence.meshes[{index}] ({}): {source}", path.display())]
    OtherMesh {
        /// Which one, from 0.
        index: usize,
        /// Its file.
        path: PathBuf,
        /// What is wrong with it.
        source: Box<ComputeError>,
    },
    /// Meshes that make no sequence.
    #[error("modes.convergence: {0}")]
    Sequence(ModalError),
    /// The ring.
    #[error("ring: {0}")]
    Ring(#[from] RingError),
    /// A case without an interface.
    #[error("nothing to condense the housing on: expected ring.tie, or condense.interface = {{ group = \"NAME\" }}")]
    NothingToCondense,
    /// An interface that the ring is not attached by.
    #[error(
        "condense.interface: a ring is attached by itself; `group` and `nodes` are for `condense` and `frf` of the housing alone"
    )]
    InterfaceOfRing,
    /// Craig-Bampton.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    /// Frequency responses.
    #[error("frf: {0}")]
    Frf(#[from] FrfError),
    /// Harmonic response of the full model.
    #[error("frf: {0}")]
    Harmonic(#[from] HarmonicError),
    /// Coupling, equilibrium, linearisation.
    #[error(transparent)]
    System(#[from] SystemError),
    /// Linear algebra.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// Time integration.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// A file of a run that cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A run that was asked to stop; it can go on.
    #[error("interrupted at t = {at_s:.6} s of {end_s} s")]
    Interrupted {
        /// How far it came, s.
        at_s: f64,
        /// How far it was to go, s.
        end_s: f64,
    },
    /// Records.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// Signal analysis.
    #[error("analysis: {0}")]
    Signal(#[from] SignalError),
    /// Results that cannot be written.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The report.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A study, or one of its files, that failed.
    #[error("{what}")]
    Failed {
        /// What happened, and where.
        what: String,
        /// What to do about it.
        help: Option<String>,
    },
}

impl From<ModalError> for ComputeError {
    fn from(error: ModalError) -> Self {
        match error {
            ModalError::Linalg(error) => Self::Linalg(error),
            ModalError::Model(error) => Self::Model(error),
            error => Self::Modal(error),
        }
    }
}

impl ComputeError {
    /// Wrong input, of which the message says what to do.
    pub(crate) fn wrong(what: impl Into<String>) -> Self {
        Self::Input { what: what.into(), help: None }
    }

    /// Wrong input, and what to do about it.
    pub(crate) fn input(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Input { what: what.into(), help: Some(help.into()) }
    }

    /// What to do with a run that cannot go on.
    pub(crate) const ANEW: &'static str = "begin anew with --force";

    /// A study that failed, and what to do about it.
    pub(crate) fn failed(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Failed { what: what.into(), help: Some(help.into()) }
    }

    /// A file or folder that the system does not let read or write.
    pub(crate) fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Failed { what: format!("{}: {source}", path.display()), help: None }
    }

    /// The error of what stands at a `place` of the case, which ends with a colon and a blank.
    pub(crate) fn bearing(place: impl Display) -> impl FnOnce(BearingError) -> Self {
        move |source| Self::wrong(format!("{place}{source}"))
    }

    /// The same wrong input with the key that it is about.
    pub(crate) fn of_key(self, key: &str) -> Self {
        match self.is_input() {
            true => Self::Input { what: format!("{key}: {self}"), help: self.help() },
            false => self,
        }
    }

    /// The error of an interface without a free displacement.
    pub(crate) fn interface_held(nodes: &NodeInterface, model: &HousingModel) -> Self {
        Self::input(
            format!(
                "condense.interface: all {} displacements of its nodes are held by {}: expected at least one that is free",
                nodes.held.len(),
                nodes.holders(model)
            ),
            "name other nodes in condense.interface, or take the support off them",
        )
    }

    /// What to do about it, where the message does not say it already.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Input { help, .. } | Self::Failed { help, .. } => help.clone(),
            Self::Case(error) => error.help(),
            Self::Measured(error) => error.help(),
            Self::OtherMesh { source, .. } => source.help(),
            Self::Format(FormatError::CutColumn { .. }) => Some(Self::ANEW.to_owned()),
            Self::Modal(ModalError::NoModes { .. }) => {
                Some("another band, or `modes.count = 1`, which finds the lowest wherever it is".to_owned())
            }
            Self::ModeShapes(FormatError::File(FileError::Content {
                path,
                fault: Fault { place: Place::Line(_), .. },
            })) if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) => {
                Some("frequencies without shapes are checked by `modes.expected` in the case file".to_owned())
            }
            _ => None,
        }
    }

    /// Whether a file could not be written.
    pub(crate) fn is_of_writing(&self) -> bool {
        matches!(self, Self::File(FileError::Write { .. }) | Self::Format(FormatError::File(FileError::Write { .. })))
    }

    /// Whether the input is wrong, rather than the computation failed.
    pub(crate) fn is_input(&self) -> bool {
        match self {
            Self::Reduction(error) => !matches!(error, ReductionError::Linalg(_)),
            Self::System(error) => {
                matches!(error, SystemError::Refused(_) | SystemError::Damping(_) | SystemError::NoModesKept { .. })
            }
            Self::Transient(error) => !matches!(error, TransientError::BlewUp(_)),
            Self::Linalg(error) => matches!(error, LinalgError::TooManyModes { .. } | LinalgError::NoFrequency { .. }),
            Self::Modal(error) => !matches!(error, ModalError::Linalg(_)),
            Self::OtherMesh { source, .. } => source.is_input(),
            Self::Signal(_) => true,
            Self::Format(error) => matches!(error, FormatError::CutColumn { .. }),
            Self::Failed { .. } | Self::Interrupted { .. } | Self::File(_) | Self::Series(_) | Self::Report(_) => false,
            _ => true,
        }
    }
}
