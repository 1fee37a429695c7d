//! How much of a scene a run models, and in which steps.

pub(crate) mod growth;
pub(crate) mod horizon;
pub(crate) mod in_space;
pub(crate) mod loaded_errors;
pub(crate) mod model_choice;
pub(crate) mod modes;
pub(crate) mod perturbation;
pub(crate) mod pilot;
pub(crate) mod plan;
pub(crate) mod quantities;
pub(crate) mod stepping;
#[cfg(test)]
mod tests;

pub use horizon::{Covered, Horizon};
pub use model_choice::{ChosenPart, Measured, ModelChoice};
