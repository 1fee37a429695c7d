//! `plummer run`: equilibrium, transient, signals, analysis.
//!
//! A case comes in; a [`RunResult`] goes out, whose signals are in memory or, as a run that can stop and go on has them, on disk.
//! Read `compute.rs` first: it takes the scene, has `choice` choose the model, steps it by `simulation.rs` and analyses the signals.
//! `machine.rs` is what was simulated: one bearing in its plane, or a shaft in several. `machine_verdict.rs` sums
//! up what its signals say.
//! `recording.rs` has what keeps rows and checkpoints, `unfinished` the files of a run that has not ended. `summary.rs` is `run.json`,
//! `report.rs` the page.

pub mod choice;
pub(crate) mod compute;
mod machine;
mod machine_verdict;
pub(crate) mod recording;
pub(crate) mod report;
pub(crate) mod scalogram;
pub(crate) mod simulation;
#[cfg(test)]
mod simulation_tests;
pub(crate) mod summary;
pub mod unfinished;

pub use compute::{RunResult, compute_kept_run, compute_run};
pub(crate) use compute::{explain_run, step_run};
pub(crate) use machine::alike;
pub use machine::{BearingModel, Machine, PlaneMachine, SpatialMachine};
pub use recording::{Checkpoints, InMemory, Recording, RunRequest, TakePiece};
pub(crate) use report::{bearing_part, cost, run_report};
pub use scalogram::SensorScalogram;
pub use simulation::{RunEnd, Simulation, Span};
pub use summary::{
    EnergySummary, EquilibriumSummary, ExplainSummary, ModelSummary, OtherEquilibrium, RunBearingSummary, RunSummary,
    ShaftSummary,
};
