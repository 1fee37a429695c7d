//! Where the rows of a run go, and how they are read back.

use crate::app::error::ComputeError;
use crate::formats::ColumnFiles;
use crate::system::{Column, RunRecord};
use std::ops::Range;

/// Rows of a run, in memory or on disk.
pub trait Recording {
    /// Names of the sensors.
    fn sensors(&self) -> Vec<String>;

    /// Number of balls.
    fn balls(&self) -> usize;

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
    fn read(
        &self,
        column: Column,
        rows: Range<usize>,
        take: &mut dyn FnMut(&[f64]) -> Result<(), ComputeError>,
    ) -> Result<(), ComputeError>;
}

impl Recording for RunRecord {
    fn sensors(&self) -> Vec<String> {
        self.sensors.iter().map(|(name, _)| name.clone()).collect()
    }

    fn balls(&self) -> usize {
        self.balls
    }

    fn rows(&self) -> usize {
        self.rows()
    }

    fn append(&mut self, rows: &RunRecord) -> Result<(), ComputeError> {
        self.append(rows);
        Ok(())
    }

    fn read(
        &self,
        column: Column,
        rows: Range<usize>,
        take: &mut dyn FnMut(&[f64]) -> Result<(), ComputeError>,
    ) -> Result<(), ComputeError> {
        let rows = rows.start.min(self.rows())..rows.end.min(self.rows());
        take(&self.column(column)[column.places(&rows, self.balls)])
    }
}

impl Recording for ColumnFiles {
    fn sensors(&self) -> Vec<String> {
        self.sensors().to_vec()
    }

    fn balls(&self) -> usize {
        self.balls()
    }

    fn rows(&self) -> usize {
        self.rows()
    }

    fn append(&mut self, rows: &RunRecord) -> Result<(), ComputeError> {
        Ok(self.append(rows)?)
    }

    fn read(
        &self,
        column: Column,
        rows: Range<usize>,
        take: &mut dyn FnMut(&[f64]) -> Result<(), ComputeError>,
    ) -> Result<(), ComputeError> {
        self.read(column, rows, take)
    }
}
