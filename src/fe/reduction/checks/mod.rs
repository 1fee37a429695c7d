//! Is a superelement what it says it is? Checks with relative limits: a healthy model in any units passes, a broken one
//! fails by name.

mod basis;
mod matrices;
mod rigid;

use super::{CraigBampton, InterfaceReduction, ReductionError, Superelement};
pub(crate) use basis::check_craig_bampton;
pub(crate) use matrices::check_matrices;
pub use matrices::{Bound, Check};
pub use rigid::RigidMotions;

#[cfg(test)]
mod tests;
