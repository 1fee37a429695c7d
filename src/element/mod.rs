//! Element matrices from coordinates: plane solids and curved beams.

pub mod curved_beam;
mod error;
pub mod plane;

pub use error::ElementError;
