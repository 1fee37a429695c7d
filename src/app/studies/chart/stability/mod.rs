//! The stability map: how long a step each method can take, and under which conditions.
//!
//! [`compute_stability`] varies the scene one [`Condition`] at a time. In each, and for each method with equal steps, it asks two
//! questions of every step on a grid: whether a small motion about the equilibrium grows, by the method's own amplification
//! ([`growth`](crate::numerics::ode::growth)), and whether short runs of the whole model do anything that fine ones do
//! not. Both are bisected to a limit. What chooses its steps has the step that it took.
//!
//! **Limitations.** Predictions are those of the equilibrium: an impact makes contacts stiffer than they are there, and shortens
//! the limit that is measured. Runs are short: what grows by less than some 1e-3 a step is not seen in them.

mod cell;
mod compute;
mod condition;
mod section;

pub use cell::{MethodStability, StepRecord, Window};
pub use compute::{ConditionSummary, Stability, StabilityModel};
pub(crate) use compute::{NO_TIME, compute_stability};
pub use condition::Condition;
pub(crate) use section::{resonance_plot, stability_map, stability_report, stability_section};
