//! `plummer sweep`: many runs of one case, one table.

mod arguments;
mod points;

use std::fs;
use std::path::Path;

pub use arguments::SweepArguments;

use super::share::Share;

use super::earlier_results::{refuse_foreign, result_of};
use super::output::json;
use super::report::ReportFiles;
use super::results::{Job, warnings};
use super::{CliError, Options, Outcome, OutputFolder, Progress, failure, typed, write_atomic};
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::shell_word::shell_word;
use crate::app::studies::sweep::{
    Axis, Plan, PointState, ScriptsSummary, SweepResult, TaskSummary, slurm_scripts, sweep_report, write_sweep_npz,
};
use points::Workers;

/// Folder of the points and the plan, in that of the results.
const POINTS: &str = "sweep";
/// The plan's file in it.
const PLAN: &str = "plan.json";
/// Most tasks of a job array unless told otherwise: Slurm takes 1000 by default (`MaxArraySize`).
pub(super) const MOST_TASKS: usize = 1000;

/// Plans a sweep and computes its points, or writes job scripts for them, or does a task of such a job, or merges what is there.
///
/// # Errors
/// [`CliError`] when the input is wrong, no point is a valid case, the sweep was interrupted or a file cannot be written.
pub(super) fn sweep(asked: &SweepArguments, options: &Options) -> Result<Outcome, CliError> {
    let progress = Progress::new(options.shows_progress());
    let outcome = if let Some(share) = asked.task {
        task(&asked.from, share, options, &progress)
    } else if asked.merge {
        let folder = OutputFolder::at(&asked.from);
        let plan = read_plan(&folder)?;
        let other = |path: &Path| result_of("sweep", path).is_null().then_some("");
        folder.claim_unless(&["sweep.json"], options.force, other)?;
        let beneath = std::env::current_dir().ok();
        let beneath = beneath.and_then(|here| plan.case.strip_prefix(here).ok().map(Path::to_owned));
        let case = Case::load(beneath.unwrap_or_else(|| plan.case.clone()), &plan.set)?;
        merge(plan, &case, folder, options, &progress)
    } else {
        whole(asked, options, &progress)
    };
    progress.finish();
    outcome
}

/// Plans a sweep, or goes on with one, computes its points and merges them; or writes job scripts.
fn whole(asked: &SweepArguments, options: &Options, progress: &Progress) -> Result<Outcome, CliError> {
    let case = Case::load(&asked.from, &options.set)?;
    let axes = asked.vary.iter().map(|argument| Axis::parse(argument));
    let plan = Plan::new(&case, asked.command, axes.collect::<Result<_, _>>()?)?;
    check_points(&plan, &case)?;
    let folder = OutputFolder::of(&case, options);
    if asked.resume {
        if options.force {
            return Err(CliError::resume_anew());
        }
        folder.lock()?;
        let changes = read_plan(&folder)?.changes(&plan);
        if !changes.is_empty() {
            return Err(changed(&folder.path, &changes));
        }
    } else {
        begin(&plan, &folder, options.force)?;
    }
    if let Some(tasks) = asked.slurm {
        let tasks = tasks.map_or(MOST_TASKS, std::num::NonZeroUsize::get);
        return write_scripts(&plan, &folder, tasks.min(plan.count()), options);
    }
    compute(&plan, &folder, Share::WHOLE, options, progress)?;
    merge(plan, &case, folder, options, progress)
}

/// One share of the points, of the sweep in a folder.
fn task(from: &Path, share: Share, options: &Options, progress: &Progress) -> Result<Outcome, CliError> {
    let folder = OutputFolder::at(from);
    let plan = read_plan(&folder)?;
    let case = Case::load(&plan.case, &plan.set)?;
    let changes = plan.changes(&Plan::new(&case, plan.command, plan.axes.clone())?);
    if !changes.is_empty() {
        return Err(changed(&folder.path, &changes));
    }
    compute(&plan, &folder, share, options, progress)?;
    let points = folder.path.join(POINTS);
    let result = SweepResult::collect(plan, &case, &points)?;
    let of_share = result.points.iter().filter(|point| share.has(point.point.number));
    let lines = of_share.map(|point| {
        let message = point.record.as_ref().map_or("", |record| record.message.as_str());
        let line = format!("point {}: {} {message}", point.point.number, point.state.name());
        line.trim_end().to_owned()
    });
    let points_of = (1..=result.plan.count()).filter(|&number| share.has(number)).collect();
    Ok(Outcome {
        summary: lines.collect::<Vec<_>>().join("\n"),
        result: json(&TaskSummary { command: "sweep", task: share.number, of: share.of, points: points_of })?,
        written: vec![points],
        verdict: Ok(()),
    })
}

/// Checks that at least one point is a valid case: a misspelled key is an error before anything is computed.
fn check_points(plan: &Plan, case: &Case) -> Result<(), CliError> {
    let mut errors = plan.points().map(|point| (point.number, plan.case_at(&point, &case.source.text).err()));
    let Some((number, Some(error))) = errors.next() else {
        return Ok(());
    };
    if errors.any(|(_, error)| error.is_none()) {
        return Ok(());
    }
    let what = format!("no point of the sweep is a valid case; point {number}: {error}");
    Err(CliError { help: error.help(), ..CliError::input(what) })
}

/// Writes the plan into an empty folder of points.
fn begin(plan: &Plan, folder: &OutputFolder, force: bool) -> Result<(), CliError> {
    let points = folder.path.join(POINTS);
    let file = points.join(PLAN);
    if file.exists() && !force {
        return Err(CliError::input(format!("{} holds a sweep", folder.path.display()))
            .with_help("go on with --resume, replace it with --force, or choose another folder with --out"));
    }
    folder.claim("sweep", force)?;
    if !force && points.exists() {
        let names = fs::read_dir(&points).into_iter().flatten().flatten();
        let names = names.filter_map(|entry| Some(format!("{POINTS}/{}", entry.file_name().to_str()?)));
        // of a plan that was not written to its end
        refuse_foreign(&folder.path, names.filter(|name| !name.ends_with(".partial")).collect())?;
    }
    if file.exists() {
        // a folder that has a plan is a sweep's own
        fs::remove_dir_all(&points).map_err(|error| CliError::folder(&points, &error))?;
    }
    folder.make_below(Path::new(POINTS))?;
    let text = serde_json::to_string_pretty(plan).unwrap_or_default();
    write_atomic(&file, format!("{text}\n").as_bytes())
}

/// Computes a share of the points; what a sweep leaves that is interrupted goes on by the same command.
fn compute(
    plan: &Plan,
    folder: &OutputFolder,
    share: Share,
    options: &Options,
    progress: &Progress,
) -> Result<(), CliError> {
    let points = folder.path.join(POINTS);
    let again = typed() + if share == Share::WHOLE { " --resume" } else { "" };
    let kept = "the points so far and checkpoints of the others are";
    let at = points.clone();
    let interrupted = move |what: &str| CliError::interrupted(what, kept, &at, &again);
    let left = interrupted.clone();
    failure::on_interrupt(move || left("interrupted"));
    progress.stage("points");
    let count = plan.points().filter(|point| share.has(point.number)).count();
    let workers = Workers::new(options, &folder.path, count, failure::stop_request())?;
    match workers.compute(plan, &points, share, &|done| progress.set(done))? {
        Some(done) => Err(interrupted(&format!("interrupted at {done} of {count} points"))),
        None => Ok(()),
    }
}

fn read_plan(folder: &OutputFolder) -> Result<Plan, ComputeError> {
    let plan = folder.path.join(POINTS).join(PLAN);
    let text = fs::read(&plan).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound | std::io::ErrorKind::NotADirectory => ComputeError::input(
            format!("{} holds no sweep: there is no plan {}", folder.path.display(), plan.display()),
            "name the folder that `plummer sweep CASE.toml --vary ...` wrote",
        ),
        _ => ComputeError::io(&plan)(error),
    })?;
    serde_json::from_slice(&text)
        .map_err(|error| ComputeError::wrong(format!("{} is no plan of a sweep: {error}", plan.display())))
}

/// The error of a folder whose sweep is another one.
fn changed(folder: &Path, changes: &[String]) -> CliError {
    let changes = changes.join("; ");
    CliError::input(format!("the sweep in {} was begun with something else: {changes}", folder.display()))
        .with_help("go on with what it was begun with, or begin anew with --force")
}

/// Writes table, archive, report and, last, `sweep.json` from what is there of the points.
fn merge(
    plan: Plan,
    case: &Case,
    folder: OutputFolder,
    options: &Options,
    progress: &Progress,
) -> Result<Outcome, CliError> {
    progress.stage("write");
    let job = Job { folder, ..Job::new("sweep", case, options, progress) };
    let folder = &job.folder;
    let result = SweepResult::collect(plan, case, &folder.path.join(POINTS))?;
    let csv = folder.write("sweep.csv", result.table().to_csv().as_bytes())?;
    let npz = folder.path.join("sweep.npz");
    write_sweep_npz(&npz, &result).map_err(ComputeError::from)?;
    let report = sweep_report(case, &result, &typed());
    let files = ReportFiles::write(folder, "sweep", case, report, progress)?;
    let (path, json) = job.write_result(&files, &[], result.summary())?;
    Ok(Outcome {
        summary: summary(&result),
        result: json,
        written: [vec![csv, npz, path], files.paths].concat(),
        verdict: verdict(&result),
    })
}

/// Points that are not done, and how many are.
fn summary(result: &SweepResult) -> String {
    /// Points and warnings that are listed here; the report has all.
    const LISTED: usize = 10;
    /// Most rows of a table here.
    const ROWS: usize = 30;
    let done = result.count(PointState::Done);
    let all = result.points.len();
    let told = result.warnings();
    let sentences: Vec<String> = told.iter().map(|one| one.sentence(all)).collect();
    let mut lines: Vec<String> = warnings(&sentences).take(LISTED).collect();
    if told.len() > LISTED {
        let more = told.len() - LISTED;
        lines.push(format!("and {more} more warnings, see the report"));
    }
    if done > 0 && all <= ROWS {
        lines.extend(result.results_table().map(|table| table.plain()));
    }
    lines.push(format!("{done} of {all} points done"));
    for point in result.not_done().take(LISTED) {
        let values = point.point.values.join(", ");
        let message = point.record.as_ref().map_or("", |record| record.message.as_str());
        let first = message.lines().next().unwrap_or_default();
        let state = point.state.name();
        lines.push(format!("  point {} ({values}): {state} {first}", point.point.number));
    }
    let more = result.not_done().count().saturating_sub(LISTED);
    if more > 0 {
        lines.push(format!("  and {more} more, see the report"));
    }
    lines.join("\n")
}

/// Single points that fail are listed; a sweep without any answer, or one that is not complete, is bad.
fn verdict(result: &SweepResult) -> Result<(), CliError> {
    let missing = result.count(PointState::Missing);
    let all = result.points.len();
    if missing > 0 {
        return Err(CliError::failed(format!("{missing} of {all} points are not computed"))
            .with_help("submit the job array again, or go on with --resume"));
    }
    if result.points.iter().any(|point| point.state.has_result()) {
        return Ok(());
    }
    Err(CliError::failed(format!("none of {all} points has a result"))
        .with_help("their messages are in the report and in sweep.json"))
}

fn write_scripts(plan: &Plan, folder: &OutputFolder, tasks: usize, options: &Options) -> Result<Outcome, CliError> {
    job_scripts("sweep", (plan.count(), "points"), folder, tasks, options)
}

/// Writes the job scripts of a study, by its command's word, which is also the name of its folder in that of the results.
pub(super) fn job_scripts(
    command: &'static str,
    (count, what): (usize, &str),
    folder: &OutputFolder,
    tasks: usize,
    options: &Options,
) -> Result<Outcome, CliError> {
    let absolute = |path: &Path| std::path::absolute(path).map_err(ComputeError::io(path));
    let program = points::program()?;
    let threads = options.threads.map_or(1, std::num::NonZeroUsize::get);
    let scripts = slurm_scripts(command, &program.call, &absolute(&folder.path)?, tasks, threads);
    folder.make_below(Path::new(command))?;
    let write = |name: &str, text: &str| folder.write(&format!("{command}/{name}"), text.as_bytes());
    let written = vec![
        write("array.sbatch", &scripts.array)?,
        write("merge.sbatch", &scripts.merge)?,
        write("submit.sh", &scripts.submit)?,
    ];
    let submit = folder.path.join(command).join("submit.sh");
    Ok(Outcome {
        summary: format!(
            "{count} {what} in {tasks} tasks; submit them by: sh {}",
            shell_word(&submit.to_string_lossy())
        ),
        result: json(&ScriptsSummary { command, points: count, tasks, scripts: &written })?,
        written,
        verdict: Ok(()),
    })
}
