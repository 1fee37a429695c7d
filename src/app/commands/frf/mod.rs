//! `plummer frf`: transfer paths from forces to sensors, reduced against full.

pub(crate) mod compared;
pub(crate) mod compute;
pub(crate) mod reduced;
pub(crate) mod report;
pub(crate) mod summary;
#[cfg(test)]
mod tests;

pub use compared::ComparedResponse;
pub use compute::{FrfResult, RankedPath, compute_frf};
pub use reduced::{CarriedPart, FrfHousing, TransferPath};
pub(crate) use report::frf_report;
pub use summary::{FrfSummary, PathSummary};
