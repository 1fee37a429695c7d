//! What a mesh contains, for reports and for a look before computing.
//!
//! Plain data: counts, groups, extent, and what is often wrong with a mesh (unused and duplicate nodes,
//! parts that hang in the air, elements in no group). Volume, mass and the shape of elements are
//! computed elsewhere, with shape functions.

mod counts;
mod parts;
#[cfg(test)]
mod tests;

pub use counts::{GroupOverlap, GroupSummary, Inventory, KindCount};
pub(crate) use parts::Sets;
pub use parts::{BoundingBox, DuplicateNodes, Part, UnusedNodes};
