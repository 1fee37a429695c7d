//! The points of a sweep with what became of them.
//!
//! What became of one point.
//!
//! What of a point's result goes into the table.

use super::{Plan, SweepPoint, SweptCommand};
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
    pub(super) unit: &'static str,
    pub(super) group: Option<&'static str>,
    pub(super) values: Values,
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

impl SweepResult {
    /// Reads what the points of a plan left below the folder of the sweep.
    ///
    /// # Errors
    /// [`ComputeError::Input`] for a result of other values than its point has.
    pub fn collect(plan: Plan, sweep: &Path) -> Result<Self, ComputeError> {
        let points = plan.points().map(|point| {
            let folder = plan.folder(sweep, point.number);
            let file = folder.join(format!("{}.json", plan.command.name()));
            let result = fs::read(&file).ok();
            let result: Option<Value> = result.and_then(|text| serde_json::from_slice(&text).ok());
            if let Some(result) = &result {
                plan.belongs(&point, &file, result)?;
            }
            let record = PointRecord::read(&folder);
            let state = PointRecord::state(record.as_ref(), result.is_some());
            let outputs = match &result {
                Some(result) if state.has_result() => outputs_of(plan.command, result),
                _ => Vec::new(),
            };
            let warnings = result.as_ref().and_then(|result| result["warnings"].as_array());
            let warnings = warnings.into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect();
            Ok(PointResult { point, state, record, outputs, warnings })
        });
        let points = points.collect::<Result<_, ComputeError>>()?;
        Ok(Self { plan, points })
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

    /// All columns but the points' numbers: axes, state, wall time, the points' figures in the order in which they first occur.
    pub(super) fn columns(&self) -> Vec<NamedColumn> {
        let column = |name: &str, unit, values| NamedColumn { name: name.to_owned(), unit, group: None, values };
        let mut columns = Vec::new();
        for (place, axis) in self.plan.axes.iter().enumerate() {
            let texts = self.points.iter().map(|point| point.point.values[place].clone());
            let values = if axis.numbers().is_some() {
                Values::Numbers(texts.map(|text| text.parse().unwrap_or(f64::NAN)).collect())
            } else {
                Values::Texts(texts.collect())
            };
            columns.push(column(&axis.name(), "", values));
        }
        let states = self.points.iter().map(|point| point.state.name().to_owned());
        columns.push(column("state", "", Values::Texts(states.collect())));
        let wall = |point: &PointResult| point.record.as_ref().map_or(f64::NAN, |r| r.wall_s);
        let walls = self.points.iter().map(wall).collect();
        columns.push(column("wall_s", "s", Values::Numbers(walls)));
        let mut kinds: Vec<&Output> = Vec::new();
        for output in self.points.iter().flat_map(|point| &point.outputs) {
            if !kinds.iter().any(|kind| kind.name == output.name) {
                kinds.push(output);
            }
        }
        columns.extend(kinds.into_iter().map(|kind| NamedColumn {
            name: kind.name.clone(),
            unit: kind.unit,
            group: kind.group,
            values: self.values_of(kind),
        }));
        columns
    }

    fn values_of(&self, kind: &Output) -> Values {
        let values = self.points.iter().map(|point| {
            let output = point.outputs.iter().find(|output| output.name == kind.name);
            output.map(|output| &output.value)
        });
        if kind.value.is_string() {
            Values::Texts(values.map(|value| value.and_then(Value::as_str).unwrap_or_default().to_owned()).collect())
        } else {
            Values::Numbers(values.map(|value| value.and_then(Value::as_f64).unwrap_or(f64::NAN)).collect())
        }
    }

    /// The table: a row a point.
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

/// Most frequencies of a point in the table; its own result has all of them.
const MOST_FREQUENCIES: usize = 20;

/// One figure of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Name of its column and array: letters, digits, points.
    pub name: String,
    /// Its unit, "" for none.
    pub unit: &'static str,
    /// What it belongs to in plots: outputs of one group share an axis. `None`: not plotted.
    pub group: Option<&'static str>,
    /// A number, null where the result has none, or a text.
    pub value: Value,
}

/// The figures of a result: the content of `run.json` or `modes.json`.
///
/// Of a run: for each sensor and window k (from 1) `SENSOR.k.speed_hz`, `rms`, `peak`, `kurtosis` and `named` (the parts that
/// are called damaged), the estimated error, the equilibrium's shaft position and largest force, times. Of modes: mass,
/// frequencies `frequency.k`, and `loaded.k` where contacts are linearised.
pub(crate) fn outputs_of(command: SweptCommand, result: &Value) -> Vec<Output> {
    match command {
        SweptCommand::Run => of_run(result),
        SweptCommand::Modes => of_modes(result),
    }
}

fn of_run(result: &Value) -> Vec<Output> {
    let mut outputs = Vec::new();
    let windows = result["windows"].as_array().map_or(&[][..], Vec::as_slice);
    let sensor = |window: &'_ Value| window["sensor"].as_str().unwrap_or_default().to_owned();
    for (place, window) in windows.iter().enumerate() {
        let sensor_name = sensor(window);
        let count = windows[..=place].iter().filter(|other| sensor(other) == sensor_name).count();
        let part = plain(&sensor_name, |letter| letter.is_alphanumeric() || "_-".contains(letter));
        let name = |what: &str| format!("{part}.{count}.{what}");
        outputs.push(number(name("speed_hz"), "Hz", None, &window["speed_hz"]));
        for (what, unit, group) in
            [("rms", "m/s^2", "Root mean square"), ("peak", "m/s^2", "Peak"), ("kurtosis", "", "Kurtosis")]
        {
            outputs.push(number(name(what), unit, Some(group), &window[what]));
        }
        outputs.push(Output {
            name: name("named"),
            unit: "",
            group: None,
            value: Value::String(named(&window["verdict"])),
        });
    }
    let equilibrium = &result["equilibrium"];
    let forces = equilibrium["outer_force_n"].as_array();
    let largest = forces.into_iter().flatten().filter_map(Value::as_f64);
    let largest = largest.reduce(f64::max).map_or(Value::Null, Value::from);
    let model = &result["model"];
    outputs.extend([
        number("shaft_x", "m", None, &equilibrium["shaft_m"][0]),
        number("shaft_y", "m", None, &equilibrium["shaft_m"][1]),
        number("largest_static_force", "N", None, &largest),
        number("modes", "", None, &model["modes"]),
        number("estimated_error", "", None, &result["estimated_error"]),
        number("estimate_held", "s", None, &result["estimate_held_s"]),
        number("stepping_s", "s", None, &result["stepping_s"]),
    ]);
    outputs
}

/// Parts that a verdict names, "none" if it names none, nothing where there is no verdict.
fn named(verdict: &Value) -> String {
    let Some(faults) = verdict["faults"].as_array() else {
        return String::new();
    };
    let named =
        faults.iter().filter(|fault| fault["conclusion"] == "named").filter_map(|fault| fault["fault"].as_str());
    let names: Vec<&str> = named.collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

fn of_modes(result: &Value) -> Vec<Output> {
    let mut outputs = vec![number("mass", "kg", None, &result["mass_kg"])];
    let mut frequencies = |name: &str, group, values: &mut dyn Iterator<Item = &Value>| {
        for (k, value) in (1..).zip(values.take(MOST_FREQUENCIES)) {
            outputs.push(number(format!("{name}.{k}"), "Hz", Some(group), value));
        }
    };
    let list = |value: &'_ Value| value.as_array().map_or(&[][..], Vec::as_slice).to_vec();
    let unloaded = list(&result["frequencies_hz"]);
    frequencies("frequency", "Eigenfrequencies", &mut unloaded.iter());
    let loaded = list(&result["loaded"]["modes"]);
    frequencies(
        "loaded",
        "Eigenfrequencies with contacts linearised",
        &mut loaded.iter().map(|mode| &mode["frequency_hz"]),
    );
    outputs
}

fn number(name: impl Into<String>, unit: &'static str, group: Option<&'static str>, value: &Value) -> Output {
    Output { name: name.into(), unit, group, value: value.as_f64().map_or(Value::Null, Value::from) }
}

/// A name with `_` in the place of all letters but the allowed ones.
pub(super) fn plain(name: &str, allowed: impl Fn(char) -> bool) -> String {
    name.chars().map(|letter| if allowed(letter) { letter } else { '_' }).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::app::case::Case;
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
        SweepResult::collect(plan, folder.path()).unwrap()
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
        let other = belongs(&plan.point(2).set, &digest).unwrap_err();
        assert!(other.contains("expected --set ring.nodes=36"), "{other}");
        assert!(other.contains("found --set ring.nodes=72"), "{other}");
        belongs(&point.set, &case.digest("modes").unwrap()).unwrap_err();
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

#[cfg(test)]
mod outputs_tests {
    use serde_json::json;

    use super::{SweptCommand, Value, outputs_of};

    fn found(command: SweptCommand, result: &Value) -> Vec<(String, Value)> {
        let outputs = outputs_of(command, result).into_iter();
        outputs.map(|output| (output.name, output.value)).collect()
    }

    #[test]
    fn windows_are_counted_for_each_sensor() {
        let window = |sensor: &str, rms: f64, conclusion: &str| {
            json!({
                "sensor": sensor, "speed_hz": 22.0, "rms": rms, "peak": 2.0, "kurtosis": 3.0,
                "verdict": { "faults": [{ "fault": "ball", "conclusion": conclusion },
                                        { "fault": "cage", "conclusion": conclusion }] },
            })
        };
        let result = json!({
            "windows": [window("P 1", 1.0, "named"), window("P 1", 4.0, "not seen"), window("top", 5.0, "named")],
            "equilibrium": { "shaft_m": [1e-6, -2e-6], "outer_force_n": [0.0, 3.0, 1.0] },
            "model": { "modes": 7 }, "estimated_error": null, "stepping_s": 0.5,
        });
        let found = found(SweptCommand::Run, &result);
        let value = |name: &str| {
            let found = found.iter().find(|(other, _)| other == name);
            found.map(|(_, value)| value.clone())
        };
        let text = |text: &str| Some(Value::from(text));
        assert_eq!(value("P_1.1.rms"), Some(Value::from(1.0)));
        assert_eq!(value("P_1.2.rms"), Some(Value::from(4.0)));
        assert_eq!(value("top.1.rms"), Some(Value::from(5.0)));
        assert_eq!(value("P_1.1.named"), text("ball, cage"));
        assert_eq!(value("P_1.2.named"), text("none"));
        assert_eq!(value("largest_static_force"), Some(Value::from(3.0)));
        assert_eq!(value("shaft_y"), Some(Value::from(-2e-6)));
        assert_eq!(value("estimated_error"), Some(Value::Null));
    }

    #[test]
    fn frequencies_are_numbered() {
        let result = json!({
            "mass_kg": 0.1, "frequencies_hz": (1..30).map(f64::from).collect::<Vec<_>>(),
            "loaded": { "modes": [{ "frequency_hz": 7.5 }] },
        });
        let found = found(SweptCommand::Modes, &result);
        assert_eq!(found[0], ("mass".to_owned(), Value::from(0.1)));
        assert_eq!(found[20], ("frequency.20".to_owned(), Value::from(20.0)));
        assert_eq!(found[21], ("loaded.1".to_owned(), Value::from(7.5)));
        assert_eq!(found.len(), 22);
    }
}
