//! Is a superelement what it says it is? Checks with relative limits: a healthy model in any units passes, a broken one
//! fails by name.

mod basis;
mod condensed;
mod matrices;
mod rigid;
mod verdict;

use super::{CraigBampton, InterfaceReduction, ReductionError, Superelement};
pub(crate) use condensed::check_craig_bampton;
pub(crate) use matrices::check_matrices;
pub use rigid::RigidMotions;
pub use verdict::{Bound, Check};

#[cfg(test)]
mod tests;
