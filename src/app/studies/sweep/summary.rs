//! What `sweep.json` says, and what is said of parts of a sweep.

use super::{Axis, PointResult, PointState, PointWarning, SweepResult};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;

/// A sweep with what became of its points.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct SweepSummary<'a> {
    /// What was computed at each point: "run" or "modes".
    pub of: &'static str,
    /// What was varied; the last axis varies fastest.
    pub axes: &'a [Axis],
    /// Number of points that are computed.
    pub done: usize,
    /// Number of points whose answer is bad.
    pub bad: usize,
    /// Number of points without a result.
    pub failed: usize,
    /// Number of points that are not computed.
    pub not_computed: usize,
    /// What the points' results warn of.
    pub warnings: Vec<PointWarning>,
    /// The points, in the order of their numbers.
    pub points: Vec<PointSummary<'a>>,
}

/// What became of a point.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct PointSummary<'a> {
    /// Its number, from 1.
    pub point: usize,
    /// The value of each axis.
    pub values: &'a [String],
    /// "done", "bad answer", "failed" or "not computed".
    pub state: &'static str,
    /// Exit code of its process; `None` if a signal ended it or it was not computed.
    pub exit_code: Option<i32>,
    /// Its error message; empty if there is none.
    pub message: Option<&'a str>,
    /// Wall time, s.
    pub wall_s: Option<f64>,
}

/// A share of the points, computed: what `--task` prints.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct TaskSummary {
    /// "sweep".
    pub command: &'static str,
    /// Number of the share, from 1.
    pub task: usize,
    /// Number of shares.
    pub of: usize,
    /// Numbers of its points.
    pub points: Vec<usize>,
}

/// Job scripts, written: what `--slurm` prints.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ScriptsSummary<'a> {
    /// "sweep".
    pub command: &'static str,
    /// Number of points.
    pub points: usize,
    /// Number of tasks.
    pub tasks: usize,
    /// The scripts.
    pub scripts: &'a [PathBuf],
}

impl SweepResult {
    /// What `sweep.json` says of it.
    pub(crate) fn summary(&self) -> SweepSummary<'_> {
        SweepSummary {
            of: self.plan.command.name(),
            axes: &self.plan.axes,
            done: self.count(PointState::Done),
            bad: self.count(PointState::Bad),
            failed: self.count(PointState::Failed),
            not_computed: self.count(PointState::Missing),
            warnings: self.warnings(),
            points: self.points.iter().map(PointSummary::of).collect(),
        }
    }
}

impl<'a> PointSummary<'a> {
    fn of(of: &'a PointResult) -> Self {
        let record = of.record.as_ref();
        Self {
            point: of.point.number,
            values: &of.point.values,
            state: of.state.name(),
            exit_code: record.and_then(|record| record.exit_code),
            message: record.map(|record| record.message.as_str()),
            wall_s: record.map(|record| record.wall_s),
        }
    }
}
