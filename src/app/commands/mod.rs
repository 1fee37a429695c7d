//! What each command computes, as a value, and its report; nothing here prints.

pub mod analyze;
pub mod bearing;
pub mod computed;
pub mod condense;
pub mod frf;
pub mod init;
pub mod inspect;
pub mod modes;
pub mod parts;
pub mod result;
pub mod run;

pub use inspect::{ElementShape, GroupSize, InspectResult, Inspection, SurfaceKind, SurfaceSummary};
