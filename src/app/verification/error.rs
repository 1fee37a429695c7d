//! Why a check could not be carried out: nothing that a user could set right.

use crate::app::case::CaseError;
use crate::app::error::ComputeError;
use crate::app::verification::ring::RingError as RingFormulaError;
use crate::bearing::StiffnessError;
use crate::bearing::hertz::HertzError;
use crate::bearing::impact::ImpactError;
use crate::bearing::kinematics::RaceError;
use crate::fe::material::{MaterialError, SectionError};
use crate::fe::mesh::MeshError;
use crate::fe::model::{ModelError, RingError};
use crate::fe::reduction::ReductionError;
use crate::numerics::linalg::LinalgError;
use crate::numerics::ode::TransientError;
use crate::numerics::series::SeriesError;
use crate::report::ReportError;
use crate::signal::SignalError;
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
    Stage(Box<ComputeError>),
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
    /// A ring in closed form that cannot be computed.
    #[error(transparent)]
    RingFormula(#[from] RingFormulaError),
    /// A built-in mesh that cannot be read.
    #[error(transparent)]
    Mesh(Box<MeshError>),
    /// A built-in model that cannot be built.
    #[error(transparent)]
    Model(Box<ModelError>),
    /// Eigenvalues or a factorisation that failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// A condensation that failed.
    #[error(transparent)]
    Reduction(Box<ReductionError>),
    /// A simulation that failed.
    #[error(transparent)]
    Transient(Box<TransientError>),
    /// A signal that cannot be formed.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// A signal that cannot be analysed.
    #[error(transparent)]
    Signal(#[from] SignalError),
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

impl From<MeshError> for VerificationError {
    fn from(error: MeshError) -> Self {
        Self::Mesh(Box::new(error))
    }
}

impl From<ModelError> for VerificationError {
    fn from(error: ModelError) -> Self {
        Self::Model(Box::new(error))
    }
}

impl From<ReductionError> for VerificationError {
    fn from(error: ReductionError) -> Self {
        Self::Reduction(Box::new(error))
    }
}

impl From<TransientError> for VerificationError {
    fn from(error: TransientError) -> Self {
        Self::Transient(Box::new(error))
    }
}

impl From<ComputeError> for VerificationError {
    fn from(error: ComputeError) -> Self {
        Self::Stage(Box::new(error))
    }
}
