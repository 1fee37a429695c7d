//! Who keeps the rows of a simulation and what it remembers, while it goes on.

use super::recording::Recording;
use crate::app::error::ComputeError;
use crate::numerics::ode::{SecondOrderSystem, Snapshot, State};
use crate::system::{CoupledSystem, RunRecord};
use sha2::{Digest, Sha256};

/// What a keeper wants between two output intervals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wish {
    /// Nothing.
    GoOn,
    /// A checkpoint.
    Checkpoint,
    /// A checkpoint and an end.
    Stop,
}

/// Keeps the rows of a simulation and its checkpoints.
pub trait Keeper {
    /// Where the rows go.
    type Record: Recording;

    /// The record to fill, and what the simulation remembered if it goes on.
    ///
    /// # Errors
    /// [`ComputeError`] if it cannot be opened.
    fn open(&mut self, sensors: Vec<String>, balls: usize) -> Result<(Self::Record, Option<Snapshot>), ComputeError>;

    /// Asked after every output interval.
    fn wish(&mut self) -> Wish;

    /// Keeps a checkpoint of a simulation that has come to `t` (s); all rows before it are in the record.
    ///
    /// # Errors
    /// [`ComputeError`] if it cannot be written.
    fn keep(&mut self, record: &Self::Record, t: f64, snapshot: &Snapshot) -> Result<(), ComputeError>;

    /// The stepping has ended.
    fn close(&mut self);
}

/// Keeps the rows in memory, and no checkpoint.
#[derive(Debug, Clone, Copy, Default)]
pub struct InMemory;

impl Keeper for InMemory {
    type Record = RunRecord;

    fn open(&mut self, sensors: Vec<String>, balls: usize) -> Result<(RunRecord, Option<Snapshot>), ComputeError> {
        Ok((RunRecord::blank(sensors, balls), None))
    }

    fn wish(&mut self) -> Wish {
        Wish::GoOn
    }

    fn keep(&mut self, _: &RunRecord, _: f64, _: &Snapshot) -> Result<(), ComputeError> {
        Ok(())
    }

    fn close(&mut self) {}
}

/// Tells models apart: SHA-256 of the linear part and of the force at the start, to the last bit.
pub(crate) fn fingerprint(system: &mut CoupledSystem, start: &State) -> [u64; 4] {
    let mut force = vec![0.0; start.y.len()];
    system.force_into(start.t, &start.y, &start.v, &mut force);
    let linear = system.linear().iter();
    let linear = linear.flat_map(|linear| [linear.squared_frequency, linear.damping]);
    let mut hasher = Sha256::new();
    for value in linear.chain(start.y.iter().copied()).chain(force) {
        hasher.update(value.to_bits().to_le_bytes());
    }
    let mut words = [0; 4];
    for (word, bytes) in words.iter_mut().zip(hasher.finalize().chunks_exact(8)) {
        *word = bytes.iter().fold(0, |word, &byte| word << 8 | u64::from(byte));
    }
    words
}
