//! `plummer frf`: transfer paths from forces to sensors, reduced against full.
//!
//! A case comes in; an [`FrfResult`] goes out: responses of the reduced model (`reduced.rs`) with their estimated errors, beside those of
//! the full model (`full.rs`). Read `compute.rs` first. `summary.rs` is `frf.json`, `report.rs` the page,
//! `universal.rs` a file for other programs.

pub(crate) mod compute;
pub(crate) mod full;
pub(crate) mod reduced;
pub(crate) mod report;
pub(crate) mod summary;
#[cfg(test)]
mod tests;
mod universal;

pub use compute::{FrfResult, RankedPath, compute_frf};
pub use full::{ComparedResponse, FullDamping};
pub use reduced::{CarriedPart, FrfHousing, TransferPath};
pub(crate) use report::frf_report;
pub use summary::{FrfSummary, PathSummary};
