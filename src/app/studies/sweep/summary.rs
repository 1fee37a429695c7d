//! What `sweep.json` says, and what is said of parts of a sweep.

use super::result::{NamedColumn, Values};
use super::{Axis, PointResult, PointState, PointWarning, SweepResult};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A sweep with what became of its points.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct SweepSummary<'a> {
    /// What was computed at each point: "run" or "modes".
    pub of: &'static str,
    /// What was varied; the last axis varies fastest.
    pub axes: Vec<AxisSummary<'a>>,
    /// The figures that the points have, in the order of the columns of `sweep.csv`.
    pub columns: Vec<ColumnSummary>,
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

/// A key that was varied.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct AxisSummary<'a> {
    /// The key and its values.
    #[serde(flatten)]
    pub axis: &'a Axis,
    /// Unit of its values; "" for none, or where it depends on other keys.
    pub unit: &'static str,
}

/// A figure that points have.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ColumnSummary {
    /// Its name in `figures`, `sweep.csv` and `sweep.npz`.
    pub name: String,
    /// What it is, in words.
    pub what: String,
    /// Its unit, "" for none.
    pub unit: &'static str,
}

/// A number or a text.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FigureValue {
    /// A number; `None` where the point has none.
    Number(Option<f64>),
    /// A text; empty where the point has none.
    Text(String),
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
    /// Its figures by their names.
    pub figures: BTreeMap<String, FigureValue>,
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
        let figures = self.figures();
        let axes = self.axes();
        let units = axes.iter().map(|column| column.unit);
        let points = self.points.iter().enumerate();
        SweepSummary {
            of: self.plan.command.name(),
            axes: self.plan.axes.iter().zip(units).map(|(axis, unit)| AxisSummary { axis, unit }).collect(),
            columns: figures.iter().map(ColumnSummary::of).collect(),
            done: self.count(PointState::Done),
            bad: self.count(PointState::Bad),
            failed: self.count(PointState::Failed),
            not_computed: self.count(PointState::Missing),
            warnings: self.warnings(),
            points: points.map(|(row, point)| PointSummary::of(point, row, &figures)).collect(),
        }
    }
}

impl ColumnSummary {
    fn of(column: &NamedColumn) -> Self {
        Self { name: column.name.clone(), what: column.label.clone(), unit: column.unit }
    }
}

impl FigureValue {
    fn of(column: &NamedColumn, row: usize) -> Self {
        match &column.values {
            Values::Numbers(numbers) => Self::Number(Some(numbers[row]).filter(|number| number.is_finite())),
            Values::Texts(texts) => Self::Text(texts[row].clone()),
        }
    }
}

impl<'a> PointSummary<'a> {
    fn of(of: &'a PointResult, row: usize, figures: &[NamedColumn]) -> Self {
        let record = of.record.as_ref();
        Self {
            point: of.point.number,
            values: &of.point.values,
            state: of.state.name(),
            exit_code: record.and_then(|record| record.exit_code),
            message: record.map(|record| record.message.as_str()),
            wall_s: record.map(|record| record.wall_s),
            figures: figures.iter().map(|column| (column.name.clone(), FigureValue::of(column, row))).collect(),
        }
    }
}
