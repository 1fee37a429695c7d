//! `plummer frf`: transfer paths from forces to sensors, reduced against full.

pub(crate) mod compared;
pub(crate) mod compute;
pub(crate) mod housing;
pub(crate) mod path;
pub(crate) mod ranking;
pub(crate) mod reduced;
pub(crate) mod report;
pub(crate) mod summary;
#[cfg(test)]
mod tests;

pub use compared::ComparedResponse;
pub use compute::{FrfResult, compute_frf};
pub use housing::FrfHousing;
pub use path::{CarriedPart, TransferPath};
pub use ranking::RankedPath;
pub(crate) use report::frf_report;
pub use summary::{FrfSummary, PathSummary};
