//! Labelled signals of bearings that are drawn from distributions.
//!
//! A specification comes in; shards of signals with a manifest go out. A `DatasetPlan` says of each signal what it is, from the seed and the
//! signal's number alone; `DatasetPlan::write_shard` computes some of them, a task each, and writes them; `DatasetPlan::manifest` reads what
//! all shards left. Read `draw.rs` first.
//!
//! **Limitations**: one bearing of a machine is damaged, and one of its sensors recorded. A housing that every signal draws anew is condensed
//! for every signal.

mod compute;
mod distribution;
mod draw;
mod drawn;
mod hierarchy;
mod identity;
mod level;
mod manifest;
mod noise;
mod plan;
mod reading;
mod recorder;
mod shards;
mod spec;

pub(crate) use compute::{Structures, Work};
pub(crate) use hierarchy::Label;
pub(crate) use identity::DatasetIdentity;
pub use manifest::{Manifest, SignalRecord};
pub(crate) use plan::DatasetPlan;
pub(crate) use shards::RECORDS;
pub(crate) use spec::DatasetSpec;
