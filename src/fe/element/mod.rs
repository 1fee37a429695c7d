//! Element matrices from coordinates: plane and solid continua, and curved beams.

pub mod continuum;
pub mod curved_beam;
mod error;

pub use error::ElementError;
