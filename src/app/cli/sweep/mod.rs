//! `plummer sweep`: many runs of one case, one table.

mod arguments;
mod points;

use std::fs;
use std::path::Path;

pub use arguments::{Share, SweepArguments};

use super::earlier_results::result_of;
use super::output::json;
use super::report::ReportFiles;
use super::results::{Job, warnings};
use super::{CliError, Options, Outcome, OutputFolder, Progress, command_line, failure, resuming, write_atomic};
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::shell_word::shell_word;
use crate::app::studies::sweep::{
    Axis, Plan, PointState, ScriptsSummary, SweepResult, SweptCommand, TaskSummary, slurm_scripts, sweep_report,
    write_sweep_npz,
};
use points::Workers;

/// Folder of the points and the plan, in that of the results.
const POINTS: &str = "sweep";
/// The plan's file in it.
const PLAN: &str = "plan.json";
/// Most tasks of a job array unless told otherwise: Slurm takes 1000 by default (`MaxArraySize`).
const MOST_TASKS: usize = 1000;

/// What an interrupted sweep leaves.
const POINTS_KEPT: &str = "the points so far and checkpoints of the others are";

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
    let points = folder.path.join(POINTS);
    if asked.resume {
        if options.force {
            return Err(CliError::resume_anew());
        }
        folder.lock()?;
        let changes = read_plan(&folder)?.changes(&plan);
        if !changes.is_empty() {
            return Err(changed(&folder.path, &changes).into());
        }
    } else {
        begin(&plan, &folder, options.force)?;
    }
    if let Some(tasks) = asked.slurm {
        let tasks = tasks.map_or(MOST_TASKS, std::num::NonZeroUsize::get);
        return write_scripts(&plan, &folder, tasks.min(plan.count()), options);
    }
    progress.stage("points");
    let stop = failure::stop_request()?;
    let workers = Workers::new(options, &folder.path, plan.count(), stop)?;
    let stopped = workers.compute(&plan, &points, Share::WHOLE, &|done| progress.set(done))?;
    if let Some(done) = stopped {
        let what = format!("interrupted at {done} of {} points", plan.count());
        let line = sweep_line(&case, asked.vary.iter().cloned(), asked.command);
        return Err(CliError::interrupted(&what, POINTS_KEPT, &points, &resuming(&line, options)));
    }
    merge(plan, &case, folder, options, progress)
}

/// One share of the points, of the sweep in a folder.
fn task(from: &Path, share: Share, options: &Options, progress: &Progress) -> Result<Outcome, CliError> {
    let folder = OutputFolder::at(from);
    let plan = read_plan(&folder)?;
    let case = Case::load(&plan.case, &plan.set)?;
    let changes = plan.changes(&Plan::new(&case, plan.command, plan.axes.clone())?);
    if !changes.is_empty() {
        return Err(changed(&folder.path, &changes).into());
    }
    let points = folder.path.join(POINTS);
    progress.stage("points");
    let stop = failure::stop_request()?;
    let numbers: Vec<usize> = (1..=plan.count()).filter(|&number| share.has(number)).collect();
    let workers = Workers::new(options, &folder.path, numbers.len(), stop)?;
    let stopped = workers.compute(&plan, &points, share, &|done| progress.set(done))?;
    if let Some(done) = stopped {
        let what = format!("interrupted at {done} of {} points", numbers.len());
        let from = shell_word(&from.to_string_lossy());
        let again = format!("plummer sweep --task {}/{} {from}", share.number, share.of);
        return Err(CliError::interrupted(&what, POINTS_KEPT, &points, &again));
    }
    let result = SweepResult::collect(plan, &case, &points)?;
    let of_share = result.points.iter().filter(|point| share.has(point.point.number));
    let lines = of_share.map(|point| {
        let message = point.record.as_ref().map_or("", |record| record.message.as_str());
        let line = format!("point {}: {} {message}", point.point.number, point.state.name());
        line.trim_end().to_owned()
    });
    Ok(Outcome {
        summary: lines.collect::<Vec<_>>().join("\n"),
        result: json(&TaskSummary { command: "sweep", task: share.number, of: share.of, points: numbers })?,
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
        return Err(in_the_way(&folder.path).into());
    }
    folder.claim("sweep", force)?;
    if file.exists() {
        // a folder that has a plan is a sweep's own
        fs::remove_dir_all(&points).map_err(|error| CliError::folder(&points, &error))?;
    }
    folder.make_below(Path::new(POINTS))?;
    let text = serde_json::to_string_pretty(plan).unwrap_or_default();
    write_atomic(&file, format!("{text}\n").as_bytes())
}

fn read_plan(folder: &OutputFolder) -> Result<Plan, ComputeError> {
    let plan = folder.path.join(POINTS).join(PLAN);
    let text = fs::read(&plan).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => no_plan(&folder.path, &plan),
        _ => ComputeError::io(&plan)(error),
    })?;
    serde_json::from_slice(&text)
        .map_err(|error| ComputeError::wrong(format!("{} is no plan of a sweep: {error}", plan.display())))
}

/// The error of a folder that holds a sweep already.
fn in_the_way(folder: &Path) -> ComputeError {
    ComputeError::input(
        format!("{} holds a sweep", folder.display()),
        "go on with --resume, replace it with --force, or choose another folder with --out",
    )
}

/// The error of a folder whose sweep is another one.
fn changed(folder: &Path, changes: &[String]) -> ComputeError {
    let changes = changes.join("; ");
    ComputeError::input(
        format!("the sweep in {} was begun with something else: {changes}", folder.display()),
        "go on with what it was begun with, or begin anew with --force",
    )
}

/// The error of a folder without a plan.
fn no_plan(folder: &Path, plan: &Path) -> ComputeError {
    ComputeError::input(
        format!("{} holds no sweep: there is no plan {}", folder.display(), plan.display()),
        "name the folder that `plummer sweep CASE.toml --vary ...` wrote",
    )
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
    let axes = result.plan.axes.iter().map(|axis| format!("{}={}", axis.key, axis.values.join(",")));
    let report = sweep_report(case, &result, &sweep_line(case, axes, result.plan.command));
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
    let absolute = |path: &Path| std::path::absolute(path).map_err(ComputeError::io(path));
    let program = points::program()?;
    let threads = options.threads.map_or(1, std::num::NonZeroUsize::get);
    let scripts = slurm_scripts(&program, &absolute(&folder.path)?, tasks, threads);
    folder.make_below(Path::new(POINTS))?;
    let write = |name: &str, text: &str| folder.write(&format!("{POINTS}/{name}"), text.as_bytes());
    let written = vec![
        write("array.sbatch", &scripts.array)?,
        write("merge.sbatch", &scripts.merge)?,
        write("submit.sh", &scripts.submit)?,
    ];
    let submit = folder.path.join(POINTS).join("submit.sh");
    Ok(Outcome {
        summary: format!(
            "{} points in {tasks} tasks; submit them by: sh {}",
            plan.count(),
            shell_word(&submit.to_string_lossy())
        ),
        result: json(&ScriptsSummary { command: "sweep", points: plan.count(), tasks, scripts: &written })?,
        written,
        verdict: Ok(()),
    })
}

/// The command line of a sweep over these keys and values.
fn sweep_line(case: &Case, vary: impl IntoIterator<Item = String>, command: SweptCommand) -> String {
    let mut line = command_line("sweep", case);
    for vary in vary {
        line.push_str(&format!(" --vary {}", shell_word(&vary)));
    }
    if command != SweptCommand::default() {
        line.push_str(&format!(" --command {}", command.name()));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::{CliError, ComputeError, Path, changed, in_the_way, no_plan};

    #[test]
    fn each_error_has_its_exit_code_and_its_lines() {
        let folder = Path::new("out/a");
        for (error, code, lines) in [
            (
                in_the_way(folder),
                2,
                "error: out/a holds a sweep\n\
                 help: go on with --resume, replace it with --force, or choose another folder with --out\n",
            ),
            (
                changed(folder, &["other values in the case file".to_owned()]),
                2,
                "error: the sweep in out/a was begun with something else: other values in the case file\n\
                 help: go on with what it was begun with, or begin anew with --force\n",
            ),
            (
                no_plan(folder, Path::new("out/a/sweep/plan.json")),
                2,
                "error: out/a holds no sweep: there is no plan out/a/sweep/plan.json\n\
                 help: name the folder that `plummer sweep CASE.toml --vary ...` wrote\n",
            ),
            (ComputeError::io(folder)(std::io::Error::other("full")), 1, "error: out/a: full\n"),
        ] {
            let error = CliError::from(error);
            assert_eq!(error.exit_code(), code, "{error}");
            let mut written = Vec::new();
            error.report(&mut written);
            assert_eq!(String::from_utf8(written).unwrap(), lines);
        }
    }
}
