//! The points of a sweep with what became of them.
//!
//! What became of one point.

use super::outputs::{Output, PlotOf, outputs_of, plain};
use super::unit::{unit_of, words_of};
use super::{Plan, SweepPoint};
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::formats::{FormatError, NpzWriter};
use crate::report::{Cell, Column, Table};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// One point with what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct PointResult {
    /// The point.
    pub point: SweepPoint,
    /// What is there of it.
    pub state: PointState,
    /// Its record; `None` while it is not computed.
    pub record: Option<PointRecord>,
    /// Its figures; none without a result.
    pub outputs: Vec<Output>,
    /// The warnings of its result.
    pub warnings: Vec<String>,
}

/// A warning of some points of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PointWarning {
    /// What is said.
    pub text: String,
    /// Numbers of the points whose results say it.
    pub points: Vec<usize>,
}

/// A sweep with what became of its points.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepResult {
    /// What was to be computed.
    pub plan: Plan,
    /// What each key that was varied is, in words.
    pub names: Vec<String>,
    /// All points, in the order of their numbers.
    pub points: Vec<PointResult>,
}

/// A column of the table beside the points' numbers: numbers or texts, one a point.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
    /// NaN where a point has none.
    Numbers(Vec<f64>),
    /// Empty where a point has none.
    Texts(Vec<String>),
}

/// A named column.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NamedColumn {
    pub(super) name: String,
    /// What it is, in words.
    pub(super) label: String,
    pub(super) unit: &'static str,
    /// Title of its table; `None`: only the files have it.
    pub(super) table: Option<String>,
    pub(super) plot: Option<PlotOf>,
    pub(super) values: Values,
    /// Whether each point's verdict indicates what shows in it.
    pub(super) indicated: Vec<bool>,
}

impl PointWarning {
    /// In words, of a sweep with so many points.
    #[must_use]
    pub fn sentence(&self, of: usize) -> String {
        /// Numbers that are listed.
        const LISTED: usize = 8;
        let numbers = self.points.iter().take(LISTED);
        let numbers: Vec<String> = numbers.map(usize::to_string).collect();
        match self.points.len() {
            1 => format!("point {}: {}", numbers.join(", "), self.text),
            all if all == of => format!("all points: {}", self.text),
            all if all > LISTED => format!("{all} of {of} points, the first {}: {}", numbers[0], self.text),
            _ => format!("points {}: {}", numbers.join(", "), self.text),
        }
    }
}

impl PointResult {
    /// A figure by its name.
    fn output(&self, name: &str) -> Option<&Output> {
        self.outputs.iter().find(|output| output.name == name)
    }
}

impl SweepResult {
    /// Reads what the points of a plan left below the folder of the sweep. `case` is the plan's: messages and warnings name
    /// files as it was named.
    ///
    /// # Errors
    /// [`ComputeError::Input`] for a result of other values than its point has.
    pub fn collect(plan: Plan, case: &Case, sweep: &Path) -> Result<Self, ComputeError> {
        let [absolute, named] = [&plan.case, &case.source.path].map(|path| match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => format!("{}/", parent.display()),
            _ => String::new(),
        });
        let as_named = |text: &str| match absolute.is_empty() {
            true => text.to_owned(),
            false => text.replace(&absolute, &named),
        };
        let points = plan.points().map(|point| {
            let folder = plan.folder(sweep, point.number);
            let file = folder.join(format!("{}.json", plan.command.name()));
            let result = fs::read(&file).ok();
            let result: Option<Value> = result.and_then(|text| serde_json::from_slice(&text).ok());
            if let Some(result) = &result {
                plan.belongs(&point, &file, result)?;
            }
            let mut record = PointRecord::read(&folder);
            if let Some(record) = &mut record {
                record.message = as_named(&record.message);
            }
            let state = PointRecord::state(record.as_ref(), result.is_some());
            let outputs = match &result {
                Some(result) if state.has_result() => outputs_of(&plan, result),
                _ => Vec::new(),
            };
            let warnings = result.as_ref().and_then(|result| result["warnings"].as_array());
            let warnings = warnings.into_iter().flatten().filter_map(Value::as_str).map(as_named).collect();
            Ok(PointResult { point, state, record, outputs, warnings })
        });
        let points = points.collect::<Result<_, ComputeError>>()?;
        let names = plan.axes.iter().map(|axis| words_of(&axis.key, case)).collect();
        Ok(Self { plan, names, points })
    }

    /// Number of points in a state.
    pub(crate) fn count(&self, state: PointState) -> usize {
        let points = self.points.iter();
        points.filter(|point| point.state == state).count()
    }

    /// Points whose answer is bad, that failed or are not there.
    pub(crate) fn not_done(&self) -> impl Iterator<Item = &PointResult> {
        let points = self.points.iter();
        points.filter(|point| point.state != PointState::Done)
    }

    /// What the points' results warn of, in the order in which it first occurs.
    pub(crate) fn warnings(&self) -> Vec<PointWarning> {
        let mut all: Vec<PointWarning> = Vec::new();
        for point in &self.points {
            for text in &point.warnings {
                let number = point.point.number;
                match all.iter_mut().find(|warning| warning.text == *text) {
                    Some(warning) => warning.points.push(number),
                    None => all.push(PointWarning { text: text.clone(), points: vec![number] }),
                }
            }
        }
        all
    }

    /// The columns of what was varied, one an axis.
    pub(super) fn axes(&self) -> Vec<NamedColumn> {
        let axes = self.plan.axes.iter().enumerate();
        let columns = axes.zip(&self.names).map(|((place, axis), words)| {
            let texts = self.points.iter().map(|point| point.point.values[place].clone());
            let (unit, values) = if axis.numbers().is_some() {
                let numbers = texts.map(|text| text.parse().unwrap_or(f64::NAN));
                (unit_of(&axis.key), Values::Numbers(numbers.collect()))
            } else {
                ("", Values::Texts(texts.collect()))
            };
            self.column(&axis.name(), words, unit, values)
        });
        columns.collect()
    }

    /// The points' states.
    pub(super) fn states(&self) -> NamedColumn {
        let states = self.points.iter().map(|point| point.state.name().to_owned());
        self.column("state", "state", "", Values::Texts(states.collect()))
    }

    /// Their wall times.
    fn wall(&self) -> NamedColumn {
        let wall = |point: &PointResult| point.record.as_ref().map_or(f64::NAN, |r| r.wall_s);
        self.column("wall_s", "wall time", "s", Values::Numbers(self.points.iter().map(wall).collect()))
    }

    fn column(&self, name: &str, label: &str, unit: &'static str, values: Values) -> NamedColumn {
        let indicated = vec![false; self.points.len()];
        let (name, label) = (name.to_owned(), label.to_owned());
        NamedColumn { name, label, unit, table: None, plot: None, values, indicated }
    }

    /// The points' figures, in the order in which they first occur.
    pub(super) fn figures(&self) -> Vec<NamedColumn> {
        let mut kinds: Vec<&Output> = Vec::new();
        for output in self.points.iter().flat_map(|point| &point.outputs) {
            if !kinds.iter().any(|kind| kind.name == output.name) {
                kinds.push(output);
            }
        }
        let figures = kinds.into_iter().map(|kind| {
            let outputs = self.points.iter().map(|point| point.output(&kind.name));
            let value = |output: Option<&'_ Output>| output.map(|output| output.value.clone());
            let values = outputs.clone().map(value);
            let values = if kind.value.is_string() {
                let text = |value: Option<Value>| value.as_ref().and_then(Value::as_str).unwrap_or_default().to_owned();
                Values::Texts(values.map(text).collect())
            } else {
                Values::Numbers(values.map(|value| value.and_then(|v| v.as_f64()).unwrap_or(f64::NAN)).collect())
            };
            NamedColumn {
                table: kind.table.clone(),
                plot: kind.plot.clone(),
                indicated: outputs.map(|output| output.is_some_and(|output| output.indicated)).collect(),
                ..self.column(&kind.name, &kind.label, kind.unit, values)
            }
        });
        figures.collect()
    }

    /// All columns of the files but the points' numbers: axes, state, wall time, figures.
    pub(super) fn columns(&self) -> Vec<NamedColumn> {
        [self.axes(), vec![self.states(), self.wall()], self.figures()].concat()
    }

    /// The table of the files: a row a point.
    pub(crate) fn table(&self) -> Table {
        let columns = self.columns();
        let mut heads = vec![Column::number("point", "")];
        heads.extend(columns.iter().map(|column| match column.values {
            Values::Numbers(_) => Column::number(column.name.clone(), column.unit),
            Values::Texts(_) => Column::text(column.name.clone()),
        }));
        Table::new("Points", heads).rows(self.points.iter().enumerate().map(|(row, point)| {
            let number = point.point.number;
            let cells = columns.iter().map(move |column| match &column.values {
                Values::Numbers(numbers) => Cell::number_or(Some(numbers[row]).filter(|x| x.is_finite()), 5, "–"),
                Values::Texts(texts) => Cell::text(texts[row].clone()),
            });
            std::iter::once(Cell::text(number.to_string()).value(number as f64)).chain(cells)
        }))
    }
}

/// Writes `sweep.npz`: an array a column of the table, one entry a point, by the column's name (numbers as f64, NaN where there
/// is none; texts as `<U`), `point` (the numbers, i64), and `shape`, the lengths of the axes: `a[name].reshape(a["shape"])` has
/// an index an axis.
///
/// # Errors
/// [`FormatError`] when the file cannot be written; an earlier one is then as it was.
pub(crate) fn write_sweep_npz(path: &Path, result: &SweepResult) -> Result<(), FormatError> {
    let mut archive = NpzWriter::create(path)?;
    let whole = |number: usize| i64::try_from(number).unwrap_or(i64::MAX);
    let axes = result.plan.axes.iter();
    let shape: Vec<i64> = axes.map(|axis| whole(axis.values.len())).collect();
    archive.array("shape", &shape)?;
    let points = result.points.iter();
    let numbers: Vec<i64> = points.map(|point| whole(point.point.number)).collect();
    archive.array("point", &numbers)?;
    for column in result.columns() {
        // without what the name of an array cannot have
        let name = plain(&column.name, |letter| letter.is_alphanumeric() || "_-. ".contains(letter));
        match &column.values {
            Values::Numbers(numbers) => archive.array(&name, numbers)?,
            Values::Texts(texts) => {
                let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
                archive.texts(&name, &texts)?;
            }
        }
    }
    archive.finish()
}

/// What became of one point: `point.json`, written when its process has ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointRecord {
    /// The process's exit code; `None` if a signal ended it.
    pub exit_code: Option<i32>,
    /// Its error message; empty if there is none.
    pub message: String,
    /// Wall time, s.
    pub wall_s: f64,
}

/// What is there of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointState {
    /// Computed.
    Done,
    /// Computed, and the answer is bad: exit code 1 with a result.
    Bad,
    /// Ended without a result.
    Failed,
    /// Not computed yet, or not to the end.
    Missing,
}

impl PointState {
    /// Its name in tables.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Bad => "bad answer",
            Self::Failed => "failed",
            Self::Missing => "not computed",
        }
    }

    /// Whether there are results.
    pub(crate) fn has_result(self) -> bool {
        matches!(self, Self::Done | Self::Bad)
    }
}

impl PointRecord {
    /// The record's file in a point's folder.
    pub(crate) fn file(folder: &Path) -> PathBuf {
        folder.join("point.json")
    }

    /// Reads a point's record; `None` while there is none that can be read.
    pub(crate) fn read(folder: &Path) -> Option<Self> {
        let text = std::fs::read(Self::file(folder)).ok()?;
        serde_json::from_slice(&text).ok()
    }

    /// What is there of a point, by its record and whether its folder has a result.
    pub(crate) fn state(record: Option<&Self>, has_result: bool) -> PointState {
        match record.map(|record| (record.exit_code, has_result)) {
            Some((Some(0), true)) => PointState::Done,
            Some((Some(1), true)) => PointState::Bad,
            Some(_) => PointState::Failed,
            None => PointState::Missing,
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::app::studies::sweep::{Axis, SweptCommand};
    use crate::formats::NpzReader;

    /// Four points of modes: done, done with a bad answer, failed, not computed.
    pub(in crate::app::studies::sweep) fn four() -> SweepResult {
        let case = Case::example("tadina2011/beam", &[]);
        let axes = ["ring.nodes=36,72", "ring.element=exact-arc,raveendranath"];
        let axes = axes.map(|axis| Axis::parse(axis).unwrap()).to_vec();
        let plan = Plan::new(&case, SweptCommand::Modes, axes).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let write = |number: usize, exit_code: i32, result: Option<&str>, message: &str| {
            let point = plan.folder(folder.path(), number);
            fs::create_dir_all(&point).unwrap();
            if let Some(result) = result {
                fs::write(point.join("modes.json"), result).unwrap();
            }
            let record = PointRecord { exit_code: Some(exit_code), message: message.to_owned(), wall_s: 0.25 };
            let text = serde_json::to_vec(&record).unwrap();
            fs::write(PointRecord::file(&point), text).unwrap();
        };
        write(1, 0, Some(r#"{"mass_kg": 0.1, "frequencies_hz": [8200.5, 36000], "warnings": ["flat", "seat"]}"#), "");
        write(
            2,
            1,
            Some(r#"{"mass_kg": null, "frequencies_hz": [8100, 35000, 41000], "warnings": ["flat"]}"#),
            "missed",
        );
        write(3, 2, None, "<script>alert(1)</script>");
        SweepResult::collect(plan, &case, folder.path()).unwrap()
    }

    /// Two runs with dents of 5 and 15 um, whose verdict names the race at the deeper one.
    pub(in crate::app::studies::sweep) fn dents() -> SweepResult {
        let case = Case::example("tadina2011/outer-dent", &[]);
        let axes = vec![Axis::parse("bearing.defects[0].depth=5e-6,15e-6").unwrap()];
        let plan = Plan::new(&case, SweptCommand::Run, axes).unwrap();
        let points = plan.points().map(|point| {
            let deep = point.number == 2;
            let line = |fault: &str, line: &str, amplitude: f64| {
                serde_json::json!({ "fault": fault, "line": line, "harmonic": 1, "amplitude": amplitude })
            };
            let conclusion = if deep { "named" } else { "not seen" };
            let headline = if deep { "fault indicated: outer race" } else { "no fault indicated" };
            let verdict = serde_json::json!({ "headline": headline, "reason": "", "faults": [
                { "fault": "outer race", "conclusion": conclusion, "false_alarm": 1e-4 },
                { "fault": "inner race", "conclusion": "not seen", "false_alarm": 0.5 },
            ] });
            let outer = if deep { 20.0 } else { 2.0 };
            let result = serde_json::json!({ "estimated_error": if deep { 0.02 } else { 0.013 }, "windows": [{
                "sensor": "P1", "from": 2.3, "to": 2.4, "rms": 30.0, "verdict": verdict,
                "fault_lines": [line("outer race", "BPFO", outer), line("inner race", "BPFI", 1.0)],
            }] });
            let outputs = outputs_of(&plan, &result);
            PointResult { point, state: PointState::Done, record: None, outputs, warnings: Vec::new() }
        });
        let points = points.collect();
        SweepResult { names: vec!["depth of the dent".to_owned()], plan, points }
    }

    #[test]
    fn json_and_table_have_the_same_figures() {
        let result = dents();
        let summary = serde_json::to_value(result.summary()).unwrap();
        assert_eq!(summary["axes"][0]["unit"], "m");
        assert_eq!(summary["points"][1]["figures"]["P1.1.BPFO.1"], 20.0);
        assert_eq!(summary["points"][1]["figures"]["P1.1.verdict"], "fault indicated: outer race");
        let names = summary["columns"].as_array().unwrap().iter().map(|column| column["name"].as_str().unwrap());
        let table = result.table();
        let heads: Vec<&str> = table.columns.iter().map(|column| column.title.as_str()).collect();
        assert_eq!(heads[..4], ["point", "bearing.defects.0.depth", "state", "wall_s"]);
        assert_eq!(names.collect::<Vec<_>>(), heads[4..]);
    }

    #[test]
    fn the_result_of_another_point_is_refused() {
        let case = Case::example("tadina2011/beam", &[]);
        let axes = vec![Axis::parse("ring.nodes=36,72").unwrap()];
        let plan = Plan::new(&case, SweptCommand::Modes, axes).unwrap();
        let point = plan.point(1);
        let belongs = |set: &[String], digest: &str| {
            let result = serde_json::json!({ "set": set, "case_digest": digest });
            plan.belongs(&point, Path::new("1/modes.json"), &result).map_err(|error| error.to_string())
        };
        let digest = plan.case_at(&point, &case.source.text).unwrap().digest("modes").unwrap();
        belongs(&point.set, &digest).unwrap();
        // of a point with other values, and of another case with the same arguments
        let second = plan.case_at(&plan.point(2), &case.source.text).unwrap().digest("modes").unwrap();
        let other = belongs(&plan.point(2).set, &second).unwrap_err();
        assert!(other.contains("expected --set ring.nodes=36"), "{other}");
        assert!(other.contains("found --set ring.nodes=72"), "{other}");
        belongs(&point.set, &case.digest("modes").unwrap()).unwrap_err();
        // the same value in other words
        belongs(&["ring.nodes = 36".to_owned()], &digest).unwrap();
    }

    #[test]
    fn states_and_figures_are_collected() {
        let result = four();
        let states: Vec<_> = result.points.iter().map(|point| point.state).collect();
        use PointState::{Bad, Done, Failed, Missing};
        assert_eq!(states, [Done, Bad, Failed, Missing]);
        assert_eq!(result.count(Bad), 1);
        assert_eq!(result.not_done().count(), 3);
        let warnings = result.warnings();
        let told: Vec<String> = warnings.iter().map(|one| one.sentence(4)).collect();
        assert_eq!(told, ["points 1, 2: flat", "point 1: seat"]);
        assert_eq!(
            result.table().to_csv(),
            "point,ring.nodes,ring.element,state,wall_s [s],mass [kg],frequency.1 [Hz],frequency.2 [Hz],frequency.3 [Hz]\r\n\
             1,36,exact-arc,done,0.25,0.1,8200.5,36000,\r\n\
             2,36,raveendranath,bad answer,0.25,,8100,35000,41000\r\n\
             3,72,exact-arc,failed,0.25,,,,\r\n\
             4,72,raveendranath,not computed,,,,,\r\n"
        );
    }

    #[test]
    fn every_column_is_an_array() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sweep.npz");
        write_sweep_npz(&path, &four()).unwrap();
        let mut read = NpzReader::open(&path).unwrap();
        assert_eq!(read.i64("shape").unwrap().values, [2, 2]);
        assert_eq!(read.i64("point").unwrap().values, [1, 2, 3, 4]);
        assert_eq!(read.f64("ring.nodes").unwrap().values, [36.0, 36.0, 72.0, 72.0]);
        let first = read.f64("frequency.1").unwrap().values;
        assert_eq!(first[..2], [8200.5, 8100.0]);
        assert!(first[2].is_nan() && first[3].is_nan());
        assert_eq!(read.texts("state").unwrap().values, ["done", "bad answer", "failed", "not computed"]);
        let element = read.texts("ring.element").unwrap().values;
        assert_eq!(element[1], "raveendranath");
    }
}

#[cfg(test)]
mod record_tests {
    use super::{PointRecord, PointState};

    #[test]
    fn states_follow_from_exit_code_and_result() {
        let state = |exit_code, has_result| {
            let record = PointRecord { exit_code, message: String::new(), wall_s: 1.0 };
            PointRecord::state(Some(&record), has_result)
        };
        assert_eq!(state(Some(0), true), PointState::Done);
        assert_eq!(state(Some(1), true), PointState::Bad);
        for (code, result) in [(Some(0), false), (Some(1), false), (Some(2), true), (None, true)] {
            assert_eq!(state(code, result), PointState::Failed, "{code:?} {result}");
        }
        assert_eq!(PointRecord::state(None, true), PointState::Missing);
    }
}
