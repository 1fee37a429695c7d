//! Where the rows of a run go, how they are read back, and who keeps its checkpoints.

use crate::app::error::ComputeError;
use crate::formats::ColumnFiles;
use crate::numerics::ode::Snapshot;
use crate::system::{Column, RecordLayout, RunRecord};
use std::ops::Range;

/// Takes the numbers of a column, piece by piece.
pub type TakePiece<'a> = &'a mut dyn FnMut(&[f64]) -> Result<(), ComputeError>;

/// Rows of a run, in memory or on disk.
pub trait Recording {
    /// What the columns are of.
    fn layout(&self) -> RecordLayout;

    /// Number of rows.
    fn rows(&self) -> usize;

    /// Appends rows of the same sensors and balls.
    ///
    /// # Errors
    /// [`ComputeError::Format`].
    fn append(&mut self, rows: &RunRecord) -> Result<(), ComputeError>;

    /// Hands the numbers of some rows of a column to `take`, piece by piece. Rows that are not there are left out.
    ///
    /// # Errors
    /// [`ComputeError::Format`] and what `take` returns.
    fn read(&self, column: Column, rows: Range<usize>, take: TakePiece<'_>) -> Result<(), ComputeError>;
}

impl Recording for RunRecord {
    fn layout(&self) -> RecordLayout {
        self.layout()
    }

    fn rows(&self) -> usize {
        self.rows()
    }

    fn append(&mut self, rows: &RunRecord) -> Result<(), ComputeError> {
        self.append(rows);
        Ok(())
    }

    fn read(&self, column: Column, rows: Range<usize>, take: TakePiece<'_>) -> Result<(), ComputeError> {
        let rows = rows.start.min(self.rows())..rows.end.min(self.rows());
        take(&self.column(column)[column.places(&rows, self.balls)])
    }
}

impl Recording for ColumnFiles {
    fn layout(&self) -> RecordLayout {
        self.layout.clone()
    }

    fn rows(&self) -> usize {
        self.rows()
    }

    fn append(&mut self, rows: &RunRecord) -> Result<(), ComputeError> {
        Ok(self.append(rows)?)
    }

    fn read(&self, column: Column, rows: Range<usize>, take: TakePiece<'_>) -> Result<(), ComputeError> {
        self.read(column, rows, take)
    }
}

/// What is asked of a run between two output intervals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunRequest {
    /// Nothing.
    GoOn,
    /// A checkpoint.
    Checkpoint,
    /// A checkpoint and an end.
    Stop,
}

/// Keeps the rows of a simulation, and its checkpoints if it keeps any.
pub trait Checkpoints {
    /// Where the rows go.
    type Record: Recording;

    /// The record to fill, and what the simulation remembered if it goes on.
    ///
    /// # Errors
    /// [`ComputeError`] if it cannot be opened.
    fn open(&mut self, layout: RecordLayout) -> Result<(Self::Record, Option<Snapshot>), ComputeError>;

    /// Called after every output interval.
    fn request(&mut self) -> RunRequest;

    /// Keeps a checkpoint of a simulation that has come to `t` (s); all rows before it are in the record.
    ///
    /// # Errors
    /// [`ComputeError`] if it cannot be written.
    fn save(&mut self, record: &Self::Record, t: f64, snapshot: &Snapshot) -> Result<(), ComputeError>;

    /// The stepping has ended.
    fn close(&mut self) {}
}

/// Keeps the rows in memory, and no checkpoint.
#[derive(Debug, Clone, Copy, Default)]
pub struct InMemory;

impl Checkpoints for InMemory {
    type Record = RunRecord;

    fn open(&mut self, layout: RecordLayout) -> Result<(RunRecord, Option<Snapshot>), ComputeError> {
        Ok((RunRecord::blank(layout), None))
    }

    fn request(&mut self) -> RunRequest {
        RunRequest::GoOn
    }

    fn save(&mut self, _: &RunRecord, _: f64, _: &Snapshot) -> Result<(), ComputeError> {
        Ok(())
    }
}
