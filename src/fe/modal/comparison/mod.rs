//! Two sets of modes of one structure, computed or measured: which belong together, and how well.
//!
//! [`ModalComparison`] matches the points ([`ModeSet`]), forms the modal assurance criterion, gathers repeated and
//! close modes into clusters, compares clusters by the angles between the spaces that they span, and pairs them so
//! that the agreement of all pairs together is largest.

mod pairing;
mod points;

pub use pairing::{ComparisonOptions, ModalComparison, ModePair};
pub use points::{MatchedBy, ModeSet, PointMatch};

#[cfg(test)]
mod tests;
