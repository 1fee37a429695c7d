//! Why a check could not be carried out: nothing that a user could set right.

use crate::bearing::StiffnessError;
use crate::case::CaseError;
use crate::closed_form::hertz::HertzError;
use crate::closed_form::impact::ImpactError;
use crate::closed_form::race::RaceError;
use crate::material::{MaterialError, SectionError};
use crate::model::RingError;
use crate::report::ReportError;
use crate::stages::StageError;
use crate::system::SystemError;
use thiserror::Error;

/// Why a check could not be carried out.
#[derive(Debug, Error)]
pub enum VerificationError {
    /// A built-in case is not valid.
    #[error(transparent)]
    Case(Box<CaseError>),
    /// A stage of a built-in case failed.
    #[error(transparent)]
    Stage(Box<StageError>),
    /// A built-in case has no bearing.
    #[error("the built-in case has no bearing")]
    NoBearing,
    /// A material out of range.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A ring section out of range.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// A ring that cannot be built.
    #[error(transparent)]
    Ring(#[from] RingError),
    /// A contact stiffness that cannot be given.
    #[error(transparent)]
    Stiffness(#[from] StiffnessError),
    /// Hertz theory refuses its input.
    #[error(transparent)]
    Hertz(#[from] HertzError),
    /// An impact that cannot be computed.
    #[error(transparent)]
    Impact(#[from] ImpactError),
    /// Kinematics that cannot be formed.
    #[error(transparent)]
    Race(#[from] RaceError),
    /// Equilibrium or linearisation failed.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A report's contents do not fit together.
    #[error(transparent)]
    Report(#[from] ReportError),
}

impl From<CaseError> for VerificationError {
    fn from(error: CaseError) -> Self {
        Self::Case(Box::new(error))
    }
}

impl From<StageError> for VerificationError {
    fn from(error: StageError) -> Self {
        Self::Stage(Box::new(error))
    }
}
