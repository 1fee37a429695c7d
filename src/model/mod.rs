//! Mesh and properties with degrees of freedom: the ring, the housing, their supports, and the tie
//! between them.

mod error;
mod housing;
mod partition;
mod ring;
mod spread;
mod support;
mod tie;

pub use error::ModelError;
pub use housing::{HousingModel, PartProperties, PlaneElement};
pub use partition::HousingPartition;
pub use ring::{Ring, RingError, RingRows, RingSupport, SpringShare};
pub use support::{Constraint, HousingSupport, PointMass, SupportShare};
pub use tie::{Fit, RingTie};
