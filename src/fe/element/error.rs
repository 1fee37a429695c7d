//! What can be wrong with one element.

use thiserror::Error;

/// An element whose matrices cannot be computed: its kind, where it is wrong, and what to do about it. The caller knows its
/// tag and adds it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct ElementError(pub(super) String);
