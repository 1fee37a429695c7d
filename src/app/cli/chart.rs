//! `plummer chart`: speed against accuracy, and the stability map.
//!
//! The stability map of `plummer chart`: its files and its lines.

use super::output::{extend_new, json};
use super::report::ReportFiles;
use super::results::{Job, warnings};
use super::{ChartPart, CliError, Outcome, OutputFolder, Progress, typed};
use crate::app::case::AskedRun;
use crate::app::commands::result::CaseResult;
use crate::app::error::ComputeError;
use crate::app::scene::Scene;
use crate::app::studies::chart::{
    Budget, Chart, ChartResult, ChartScene, Condition, Effort, NO_TIME, News, Parameter, Plan, Point, Stability, Stage,
    chart_report, compute_chart, compute_stability, model_name, resonance_plot, stability_map, stability_report,
    stability_section, work_precision,
};
use crate::files::{self, FileError};
use crate::report::{duration, significant};
use std::collections::BTreeMap;
use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// What a quick chart may take where nothing else is said: a minute, with some of it to spare.
const QUICK: Duration = Duration::from_secs(45);

/// What is asked of a chart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    effort: Effort,
    budget: Option<Duration>,
    only: Option<ChartPart>,
}

impl Asked {
    pub(super) fn new(quick: bool, budget: Option<Duration>, only: Option<ChartPart>) -> Self {
        let effort = if quick { Effort::Quick } else { Effort::Full };
        Self { effort, budget: budget.or(quick.then_some(QUICK)), only }
    }
}

/// Computes the charts of a case and writes their pictures, the report, its tables and, last, `stability.json` and
/// `chart.json`; of one part alone what belongs to it.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn chart(job: &Job<'_>, asked: Asked) -> Result<Outcome, CliError> {
    let Job { case, progress, ref folder, .. } = *job;
    let Asked { effort, only, .. } = asked;
    let budget = Budget::new(job.started, asked.budget, only.is_none());
    if only == Some(ChartPart::Stability) {
        return alone(job, effort, budget);
    }
    let run = case.asked_run("`chart`").map_err(ComputeError::from)?;
    let so_far = SoFar::new(folder, progress);
    let result = compute_chart(&run, effort, budget, &|news| so_far.hear(news), progress)?;
    let stability = match (only, &run, &result.scene) {
        (None, AskedRun::InPlane(run), ChartScene::InPlane(scene)) => {
            let conditions = Condition::all(case, effort);
            Some(compute_stability(*run, scene, conditions, effort, budget.until(Stage::Map), progress)?)
        }
        _ => None,
    };
    progress.stage("write");
    let svg = work_precision(&result).to_svg().map_err(ComputeError::from)?;
    let mut written = vec![folder.write("chart.svg", svg.as_bytes())?];
    let mut report = chart_report(case, &result, &typed());
    if let Some(stability) = &stability {
        // after inputs and the chart itself
        report.sections.insert(2, stability_section(stability));
    }
    let files = ReportFiles::write(folder, "chart", case, report, progress)?;
    let record = job.record(&files.meshes, Some(&files.tables), result.summary(case));
    let mut shown = ChartResult { chart: record, stability: None };
    let mut lines = summary(&result);
    if let Some(stability) = &stability {
        let record = job.record(&files.meshes, None, stability);
        written.extend(write_stability(folder, stability, &record)?);
        lines = format!("{lines}\n{}", stability_lines(stability));
        shown.stability = Some(record);
    }
    let (path, _) = folder.write_json("chart.json", &shown.chart)?;
    written.push(path);
    so_far.end()?;
    Ok(Outcome {
        summary: lines,
        result: json(&shown)?,
        written: [written, files.paths].concat(),
        verdict: verdict(&result),
    })
}

/// The points so far, on the terminal and in a file that is there from the first of them until `chart.json` is: whatever ends
/// the program, they are kept.
struct SoFar<'a> {
    progress: &'a Progress,
    path: PathBuf,
    kept: Mutex<io::Result<()>>,
    /// The file has points of this chart; those of an earlier one stay until its first.
    is_begun: AtomicBool,
}

impl<'a> SoFar<'a> {
    fn new(folder: &OutputFolder, progress: &'a Progress) -> Self {
        let path = folder.path.join("chart.csv.partial");
        Self { progress, path, kept: Mutex::new(Ok(())), is_begun: AtomicBool::new(false) }
    }

    fn hear(&self, news: News<'_>) {
        match news {
            News::Plan(Plan { points, seconds }) => {
                self.progress.note(&format!("up to {points} points, about {}", duration(seconds)));
            }
            News::Point(point, floor) => {
                // a point that failed is counted at the end, and the file says why
                if point.error.is_ok() {
                    self.progress.note(&line(point, floor));
                }
                let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
                if kept.is_ok() {
                    *kept = self.keep(point);
                }
            }
        }
    }

    fn keep(&self, point: &Point) -> io::Result<()> {
        let mut head = "";
        if !self.is_begun.swap(true, Ordering::Relaxed) {
            files::remove(&self.path)?;
            head = COLUMNS;
        }
        let mut file = OpenOptions::new().create(true).append(true).open(&self.path)?;
        file.write_all((head.to_owned() + &row(point)).as_bytes())
    }

    /// Takes the file away.
    ///
    /// # Errors
    /// [`CliError`] if it could not be written or cannot be removed.
    fn end(self) -> Result<(), CliError> {
        let kept = self.kept.into_inner().unwrap_or_else(PoisonError::into_inner);
        kept.and_then(|()| files::remove(&self.path)).map_err(|error| FileError::write(&self.path)(error).into())
    }
}

/// First line of the file of points so far.
const COLUMNS: &str = "method,model,step_s,tolerance,error,deviation,largest_error,reason\n";

/// A point as a row of the file of points so far.
fn row(point: &Point) -> String {
    let (step, tolerance) = match Parameter::of(&point.model) {
        Parameter::StepS(step) => (step.to_string(), String::new()),
        Parameter::Tolerance(tolerance) => (String::new(), tolerance.to_string()),
    };
    let (errors, reason) = match &point.error {
        Ok(error) => (format!("{},{},{}", error.mean, error.deviation, error.largest), String::new()),
        Err(failure) => (",,".to_owned(), failure.reason.replace('"', "'")),
    };
    let (method, model) = (point.model.method.name(), model_name(&point.model));
    format!("{method},{model},{step},{tolerance},{errors},\"{reason}\"\n")
}

fn verdict(result: &Chart) -> Result<(), CliError> {
    if result.reference.agreed {
        return Ok(());
    }
    let [by, beside] = result.reference.models.map(|model| model.method.name());
    let longer = if result.reference.starts.iter().any(|start| start.cut_short) { "a longer --budget; " } else { "" };
    Err(CliError::failed(format!(
        "{by} and {beside} differ by {} over the horizon, not well below the target {}",
        significant(result.reference.disagreement, 2),
        significant(result.settings.target, 2)
    ))
    .with_help(format!(
        "errors below that say nothing; {longer}a larger accuracy.target, or a smaller transient.ensemble.perturbation where the horizon is overestimated"
    )))
}

fn summary(result: &Chart) -> String {
    let reference = &result.reference;
    let [by, beside] = reference.models.map(|model| model.method.name());
    let ms = |seconds: f64| significant(1e3 * seconds, 3);
    let mut lines = vec![
        format!(
            "{} starts over {} ms from {} s on; {by} and {beside} on all {} modes differ by {} (the floor)",
            result.starts.starts.len(),
            ms(result.starts.spread_s),
            significant(result.starts.first_s(), 4),
            result.scene.stage().modes.count(),
            significant(reference.disagreement, 2),
        ),
        format!(
            "nearby solutions stay together for {} ms (mean; least {} ms) of {} ms",
            ms(reference.mean_horizon_s()),
            ms(reference.least_horizon_s()),
            ms(result.settings.span_s),
        ),
        format!(
            "{} points, {} omitted{}",
            result.points.len(),
            result.omissions().count(),
            if result.omissions().next().is_some() { "; chart.json says why of each" } else { "" }
        ),
    ];
    lines.extend(omitted(result));
    lines.extend(warnings(result.scene.doubts()));
    lines.push("front, by wall time a simulated second:".to_owned());
    lines.extend(result.front.iter().map(|&place| line(&result.points[place], reference.disagreement)));
    let [chosen, source] = &result.over_all_starts;
    let starts = reference.starts.len();
    for (name, place, error) in
        [("the program's choice", result.chosen, chosen), ("the source's method", result.source, source)]
    {
        let struck = result.struck.map_or_else(String::new, |struck| format!(", {struck} of them with a strike"));
        lines.push(format!("{name}, error over all {starts} starts{struck}:"));
        lines.push(line(&Point { error: error.clone(), ..result.points[place].clone() }, reference.disagreement));
    }
    lines.extend(result.without().map(|text| format!("warning: {text}")));
    lines.join("\n")
}

/// A line for each method that has points without an error.
fn omitted(result: &Chart) -> impl Iterator<Item = String> {
    let mut methods: BTreeMap<&str, (usize, Vec<&str>)> = BTreeMap::new();
    for (place, failure) in result.omissions() {
        let (count, kinds) = methods.entry(result.points[place].model.method.name()).or_default();
        *count += 1;
        extend_new(kinds, [failure.kind.name()]);
    }
    methods.into_iter().map(|(method, (count, kinds))| format!("  {method}: {count} omitted ({})", kinds.join(", ")))
}

/// A point's line; an error below `floor` is not the point's own.
fn line(point: &Point, floor: f64) -> String {
    let parameter = match Parameter::of(&point.model) {
        Parameter::StepS(step) => format!("step {} µs", significant(1e6 * step, 3)),
        Parameter::Tolerance(tolerance) => format!("tolerance {}", significant(tolerance, 3)),
    };
    let error = match &point.error {
        Ok(error) => {
            let below = if error.mean < floor { ", below what the reference can tell" } else { "" };
            format!("error {} (± {}){below}", significant(error.mean, 2), significant(error.deviation, 2))
        }
        Err(failure) => failure.reason.clone(),
    };
    let wall = point.wall_s.map_or_else(String::new, |wall| format!("{} s/s  ", significant(wall, 3)));
    format!("  {wall}{}, {}, {parameter}: {error}", point.model.method.name(), model_name(&point.model))
}

/// Computes the map alone and writes `stability.svg`, `resonance.svg`, the report, its tables and, last, `stability.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn alone(job: &Job<'_>, effort: Effort, budget: Budget) -> Result<Outcome, CliError> {
    let Job { case, progress, ref folder, .. } = *job;
    let run = case.for_stability().map_err(ComputeError::from)?;
    let scene = Scene::with_all_modes(run, progress)?;
    let until = budget.after_scene()?.until(Stage::Map);
    let conditions = Condition::all(case, effort);
    let stability = compute_stability(run, &scene, conditions, effort, until, progress)?;
    progress.stage("write");
    let report = stability_report(case, &stability, &typed());
    let files = ReportFiles::write(folder, "stability", case, report, progress)?;
    let record = job.record(&files.meshes, Some(&files.tables), &stability);
    let written = write_stability(folder, &stability, &record)?;
    Ok(Outcome {
        summary: stability_lines(&stability),
        result: json(&record)?,
        written: [written, files.paths].concat(),
        verdict: Ok(()),
    })
}

/// Writes the pictures and `stability.json`; gives the files.
///
/// # Errors
/// [`CliError`] when a file cannot be written.
pub(super) fn write_stability(
    folder: &OutputFolder,
    stability: &Stability,
    record: &CaseResult<'_, &Stability>,
) -> Result<Vec<PathBuf>, CliError> {
    let map = stability_map(stability).map(|map| map.to_svg().map_err(ComputeError::from)).transpose()?;
    let map = map.map(|map| folder.write("stability.svg", map.as_bytes())).transpose()?;
    let resonance = resonance_plot().to_svg().map_err(ComputeError::from)?;
    let resonance = folder.write("resonance.svg", resonance.as_bytes())?;
    let (path, _) = folder.write_json("stability.json", record)?;
    Ok([Some(path), map, Some(resonance)].into_iter().flatten().collect())
}

/// The limits of the case as it is, and the range of the measured ones over all conditions.
pub(super) fn stability_lines(stability: &Stability) -> String {
    let mut lines = vec![format!("largest stable steps as given, and over {} conditions:", stability.conditions.len())];
    let micro =
        |step: Option<f64>| step.map_or_else(|| "–".to_owned(), |step| format!("{} µs", significant(1e6 * step, 3)));
    let given = stability.conditions.first();
    let methods = given.and_then(|of| of.methods.as_ref());
    for of in methods.into_iter().flatten().filter(|of| !of.steps.is_empty()) {
        let conditions = stability.conditions.iter();
        let measured = conditions.filter_map(|condition| {
            let all = condition.methods.as_ref()?;
            all.iter().find(|other| other.method == of.method)?.measured_limit_s
        });
        let (low, high) =
            measured.fold((f64::INFINITY, 0.0_f64), |(low, high), limit| (low.min(limit), high.max(limit)));
        let range = if high > 0.0 {
            format!("{} to {}", micro(Some(low)), micro(Some(high)))
        } else {
            of.note.clone().unwrap_or_default()
        };
        lines.push(format!(
            "  {}: predicted {}, measured {}; {range}",
            of.method.name(),
            micro(of.predicted_limit_s),
            micro(of.measured_limit_s)
        ));
    }
    let cut = stability.conditions.iter().filter(|of| of.reason.as_deref() == Some(NO_TIME)).count();
    if cut > 0 {
        lines.push(format!("warning: the budget left {cut} of {} conditions out", stability.conditions.len()));
    }
    lines.join("\n")
}

#[cfg(test)]
#[path = "stability_tests.rs"]
mod stability_tests;

#[cfg(test)]
mod tests {
    use std::fs;

    use serde_json::Value;

    use super::{Asked, COLUMNS, ChartPart, Duration, Effort, Job, News, OutputFolder, Point, QUICK, SoFar, chart};
    use crate::app::case::Case;
    use crate::app::cli::{Options, Progress};
    use crate::app::scene::RunModel;
    use crate::app::studies::chart::{Failure, FailureKind, GROWTHS, GrowthError, PointError};
    use crate::numerics::ode::Method;
    use crate::system::{BallsInertia, ModeSelection};

    /// The smooth scene made small: a ring of 12 nodes, and a wide band, whose periods are short.
    fn small() -> Case {
        let set =
            ["ring.nodes=12", "accuracy.band_hz=[0,160000]", "transient.end=0.13e-3", "transient.ensemble.runs=2"];
        Case::example("scenes/smooth", &set)
    }

    #[test]
    fn a_chart_has_its_files_and_fields() {
        let case = small();
        let out = std::env::temp_dir().join(format!("plummer-{}-chart", std::process::id()));
        fs::create_dir_all(&out).unwrap();
        let options = Options { out: Some(out.clone()), ..Options::default() };
        let progress = Progress::new(false);
        let job = Job::new("chart", &case, &options, &progress);
        let only = Some(ChartPart::Accuracy);
        let endless = Asked { effort: Effort::Quick, budget: None, only };
        let outcome = chart(&job, endless).unwrap();
        let json = outcome.result;
        assert_eq!(json["scene"], "Preloaded bearing at constant speed");
        // nothing grows where all balls stay in contact: the span, in whole windows of ten periods
        assert!((json["horizon_s"].as_f64().unwrap() - 0.125e-3).abs() < 1e-9);
        let floor = json["reference"]["disagreement"].as_f64().unwrap();
        // below a tenth of the target, or the chart says so
        assert!(floor > 0.0 && floor < 1e-3, "{floor:e}");
        assert_eq!(json["reference"]["agreed"], true);
        assert_eq!(json["reference"]["methods"][0]["method"], "dop853");
        let points = json["points"].as_array().unwrap();
        for point in points {
            let ok = point["ok"] == true;
            for key in ["wall_s", "error", "deviation", "largest_error"] {
                assert_eq!(point[key].as_f64().is_some(), ok, "{point}");
            }
            assert_eq!(point["reason"].is_null(), ok, "{point}");
            for part in point["by_growth"].as_array().into_iter().flatten() {
                // nothing grows: all of them are the error over the span
                assert_eq!(part["error"], point["error"], "{point}");
                assert_eq!(part["span_s"], json["horizon_s"], "{point}");
            }
        }
        let at = |place: &Value| &points[place.as_u64().unwrap() as usize];
        assert_eq!(at(&json["chosen"])["method"], "exponential-adams");
        // two starts: points take all of them
        let all = &json["over_all_starts"]["chosen"]["error"];
        assert_eq!(all, &at(&json["chosen"])["error"]);
        assert_eq!(at(&json["source"])["method"], "newmark-explicit");
        assert_eq!(at(&json["source"])["model"], "all modes");
        let front = json["front"].as_array().unwrap();
        assert!(!front.is_empty());
        for pair in front.windows(2) {
            let [first, next] = [&pair[0], &pair[1]].map(at);
            assert!(first["wall_s"].as_f64() < next["wall_s"].as_f64());
            assert!(first["error"].as_f64() > next["error"].as_f64());
            assert_eq!(next["below_floor"], false);
        }
        for omitted in json["omissions"].as_array().unwrap() {
            assert_eq!(at(&omitted["point"])["reason"], omitted["reason"]);
            // a line for each method, and the reasons here alone
            let line = format!("\n  {}: ", omitted["method"].as_str().unwrap());
            assert_eq!(outcome.summary.matches(&line).count(), 1, "{}", outcome.summary);
            assert!(!outcome.summary.contains(omitted["reason"].as_str().unwrap()), "{}", outcome.summary);
        }
        let figures = &json["statistics"]["models"][0]["figures"];
        assert_eq!(figures[0]["name"], "root mean square");
        assert!(figures[0]["reference"]["mean"].as_f64().unwrap() > 0.0);
        let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
        // the points so far go with the last file
        assert!(!out.join("chart.csv.partial").exists());
        assert_eq!((&json["budget_s"], &json["left_out"]), (&Value::Null, &serde_json::json!([])));
        assert!(read("chart.svg").starts_with("<svg "));
        assert!(read("report.html").contains("Points that none beats"));
        let written: Value = serde_json::from_str(&read("chart.json")).unwrap();
        for key in ["front", "chosen", "omissions", "scene"] {
            assert_eq!(written[key], json[key], "{key}");
        }
        fs::remove_dir_all(out).unwrap();
    }

    #[test]
    fn points_are_on_disk_as_they_come() {
        let folder = tempfile::tempdir().unwrap();
        let progress = Progress::new(false);
        let so_far = SoFar::new(&OutputFolder::at(folder.path()), &progress);
        let model = RunModel {
            modes: ModeSelection::All,
            residual: false,
            balls_inertia: BallsInertia::Dynamic,
            method: Method::Exponential,
            step: 2.5e-7,
        };
        let by_growth = GROWTHS.map(|growth| GrowthError { growth, ..GrowthError::default() });
        let error = PointError { mean: 0.01, deviation: 0.002, largest: 0.03, by_growth };
        let path = folder.path().join("chart.csv.partial");
        let kind = FailureKind::BlewUp;
        let failure = Failure { kind, reason: "the solution blew up, \"far\"".to_owned(), error: None };
        let rows = [
            (Ok(error), "exponential,all modes,0.00000025,,0.01,0.002,0.03,\"\"\n"),
            (Err(failure), "exponential,all modes,0.00000025,,,,,\"the solution blew up, 'far'\"\n"),
        ];
        let mut expected = COLUMNS.to_owned();
        for (error, row) in rows {
            assert_eq!(path.exists(), expected.len() > COLUMNS.len());
            so_far.hear(News::Point(&Point { model, wall_s: None, error }, 0.0));
            expected.push_str(row);
            assert_eq!(fs::read_to_string(&path).unwrap(), expected);
        }
        so_far.end().unwrap();
        assert!(!path.exists());
    }

    #[test]
    fn a_quick_chart_has_a_budget() {
        let asked = |quick, seconds: Option<u64>| Asked::new(quick, seconds.map(Duration::from_secs), None).budget;
        assert_eq!(asked(true, None), Some(QUICK));
        assert_eq!(asked(true, Some(120)), Some(Duration::from_secs(120)));
        assert_eq!(asked(false, None), None);
    }
}
