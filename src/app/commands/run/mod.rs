//! `plummer run`: equilibrium, transient, signals, analysis.

pub mod choice;
pub(crate) mod compute;
pub(crate) mod keeper;
pub(crate) mod recording;
pub(crate) mod report;
pub(crate) mod scalogram;
pub(crate) mod simulation;
#[cfg(test)]
mod simulation_tests;
pub(crate) mod summary;
pub mod unfinished;

pub use compute::{RunResult, compute_run};
pub(crate) use compute::{compute_kept_run, explain_run};
pub use keeper::{InMemory, Keeper, Wish};
pub use recording::Recording;
pub(crate) use report::run_report;
pub use scalogram::SensorScalogram;
pub use simulation::{RunEnd, Simulation, Span};
pub use summary::{
    DefectOrdersSummary, EnergySummary, EquilibriumSummary, ExplainSummary, ModelSummary, OtherEquilibrium, RunSummary,
};
