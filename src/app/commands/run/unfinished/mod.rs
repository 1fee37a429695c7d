//! Runs that stop and go on: checkpoints, and what identifies a run.

pub(crate) mod checkpoint;
pub(crate) mod kept_run;

pub use checkpoint::RunIdentity;
pub use kept_run::{CHECKPOINT_S, StopRequest, UnfinishedRun};
