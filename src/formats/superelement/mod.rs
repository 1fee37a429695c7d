//! A condensed housing as other programs take it: a Craig-Bampton superelement with its labels, its sensors and the way
//! back to its nodes.
//!
//! | file | written | read |
//! |---|---|---|
//! | NumPy archive, everything | [`write_superelement_npz`] | [`read_superelement_npz`] |
//! | Matrix Market, one symmetric matrix | [`write_dense_matrix_market`](super::write_dense_matrix_market) | |
//! | table of its rows | [`write_dofs_csv`](super::write_dofs_csv) of [`SuperelementRecord::labels`] | |
//! | Nastran OUTPUT4 | [`write_superelement_op4`] | [`read_superelement_op4`]; others' names: [`read_op4`](super::read_op4), then [`SuperelementRecord::of_matrices`] |
//! | Nastran bulk data (DMIG) | [`write_superelement_dmig`] | |
//! | MBDyn's modal element | [`write_mbdyn_fem`] | |
//!
//! Source of the condensation: R. R. Craig, M. C. C. Bampton, "Coupling of substructures for dynamic analyses", AIAA
//! Journal 6 (1968) 1313-1319.

mod check;
mod dmig;
mod mbdyn;
mod npz_read;
#[cfg(test)]
mod npz_tests;
mod op4;
mod record;
#[cfg(test)]
#[path = "samples_tests.rs"]
pub(in crate::formats) mod samples;

pub use check::SYMMETRY_LIMIT;
pub use dmig::write_superelement_dmig;
pub use mbdyn::{MbdynReference, MbdynSummary, write_mbdyn_fem};
pub use npz_read::{read_superelement_npz, write_superelement_npz};
pub use op4::{read_superelement_op4, write_superelement_op4};
pub use record::{FieldRecovery, InterfaceRecovery, SensorRow, SuperelementRecord};
