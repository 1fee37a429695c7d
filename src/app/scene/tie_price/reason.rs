//! Why the price of a tie was not computed.

use crate::app::error::ComputeError;
use schemars::JsonSchema;
use serde::Serialize;
use thiserror::Error;

/// Why the price of a tie was not computed.
#[derive(Debug, Clone, PartialEq, Error, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NoTiePrice {
    /// Nothing is tied.
    #[error("the case has no ring that is tied to a housing")]
    NoTie,
    /// Rings fitted into each other.
    #[error(
        "the ring has {count} sections: there is no one body that bends as rings that slip on each other or are bonded at unknown radii"
    )]
    SeveralSections {
        /// How many.
        count: usize,
    },
    /// A ring of unknown outer radius.
    #[error("the case does not give `ring.outer_radius`, the radius of the bore")]
    NoOuterRadius,
    /// A rectangle that does not go into the bore.
    #[error(
        "the rectangle of the section's area and second moment is {height_m:.4e} m high, so that its outer face lies at a radius of {outside_m:.4e} m, and the bore at {bore_m:.4e} m: too far apart for one to stand in the other"
    )]
    Rectangle {
        /// Height of the rectangle, m.
        height_m: f64,
        /// Radius of its outer face, m.
        outside_m: f64,
        /// Radius of the bore, m.
        bore_m: f64,
    },
    /// A ring that cannot be joined to the bore.
    #[error("the solid ring cannot be joined to the bore: {message}")]
    Joint {
        /// What the joint says.
        message: String,
    },
    /// A model that is too large.
    #[error("with a solid ring the model has {free_dof} degrees of freedom, more than {limit}")]
    TooLarge {
        /// Free degrees of freedom.
        free_dof: usize,
        /// How many are computed at most.
        limit: usize,
    },
}

/// Why a computation ended before its result.
#[derive(Debug)]
pub(crate) enum Stop {
    Reason(NoTiePrice),
    Failed(Box<ComputeError>),
}

impl From<NoTiePrice> for Stop {
    fn from(reason: NoTiePrice) -> Self {
        Self::Reason(reason)
    }
}

impl<E: Into<ComputeError>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Failed(Box::new(error.into()))
    }
}
