//! `plummer condense`: a housing as a superelement, with its error and its certificate.
//!
//! A case comes in; a [`CondenseResult`] goes out, and [`superelement_record`] makes the file of it. Read `compute.rs` first. `summary.rs`
//! is `condense.json`, `report.rs` the page.

pub(crate) mod compute;
pub(crate) mod report;
pub(crate) mod summary;
pub(crate) mod superelement_record;

pub use compute::{Comparison, CondenseResult, FullComparison, ReducedInterface, compute_condense};
pub(crate) use report::{condense_report, imported_report};
pub use summary::{CondenseSummary, EstimateSummary, ImportedSummary, InterfaceSummary};
pub use superelement_record::superelement_record;
