//! `plummer modes`: eigenfrequencies of housing, ring, or both, unloaded and loaded.
//!
//! A case comes in; a [`ModesResult`] goes out: modes with the proof that none is missing, beside expected frequencies, beside modes of
//! files (`comparison.rs`) and beside other meshes (`convergence.rs`). Read `compute.rs` first. `summary.rs` is `modes.json`, `report.rs`
//! the page with tables of `tables.rs` and `checks_report.rs`.

pub(crate) mod checks_report;
pub(crate) mod comparison;
pub(crate) mod compute;
pub(crate) mod convergence;
pub(crate) mod kinds;
pub(crate) mod report;
pub(crate) mod shape_view;
pub(crate) mod summary;
pub(crate) mod tables;

pub(crate) use checks_report::{error_text, misses_text, mode_numbers, plain};
pub use comparison::{ComparedPair, ComparedPoints, FileComparison, LoneMode, Miss};
pub(crate) use compute::compute_mode_shapes;
pub use compute::{ModesResult, Reading, compute_modes};
pub use convergence::{MeshConvergence, ModeOnMeshes, SequenceMesh};
pub(crate) use report::{completeness, modes_report};
pub use summary::ModesSummary;
pub(crate) use tables::free_motions;
