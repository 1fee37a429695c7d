//! `plummer bearing`: bearings in space on a rigid shaft, at rest.
//!
//! A case comes in; a [`BearingResult`] goes out: the equilibrium under the case's load, and how displacement and stiffness change with load,
//! speed and preload. Read `compute.rs` first. `summary.rs` is `bearing.json`, `report.rs` the page.

pub(crate) mod compute;
mod doubts;
pub(crate) mod report;
pub(crate) mod summary;
#[cfg(test)]
mod tests;

pub use compute::{BearingResult, compute_bearing};
pub(crate) use report::bearing_report;
pub use summary::BearingSummary;
