//! `plummer dataset`: labelled signals of bearings drawn from distributions.

mod arguments;

pub use arguments::DatasetArguments;

use super::analyze::warn;
use super::earlier_results::{refuse_foreign, result_of};
use super::output::json;
use super::share::Share;
use super::sweep::{MOST_TASKS, job_scripts};
use super::{CliError, Options, Outcome, OutputFolder, Progress, failure, typed, write_atomic};
use crate::app::error::ComputeError;
use crate::app::studies::dataset::{DatasetIdentity, DatasetPlan, Label, Manifest, RECORDS, Structures, Work};
use crate::app::studies::sweep::TaskSummary;
use crate::formats::write_parquet;
use crate::report::{Cell, Column, Table, significant};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// The plan's file among the records.
const PLAN: &str = "plan.json";

/// What a data set was begun with.
#[derive(Debug, Serialize, Deserialize)]
struct Begun {
    /// The specification, an absolute path.
    spec: PathBuf,
    count: usize,
    identity: DatasetIdentity,
}

/// What was computed by this process.
struct Pace {
    signals: usize,
    wall_s: f64,
}

/// Plans a data set and computes its shards, or writes job scripts for them, or does a task of such a job, or merges what is there.
///
/// # Errors
/// [`CliError`] when the input is wrong, a signal could not be computed, the command was interrupted or a file cannot be written.
pub(super) fn dataset(asked: &DatasetArguments, options: &Options) -> Result<Outcome, CliError> {
    let progress = Progress::new(options.shows_progress());
    let outcome = match asked {
        DatasetArguments { task: Some(share), .. } => task(&asked.from, *share, options, &progress),
        DatasetArguments { merge: true, .. } => {
            let folder = OutputFolder::at(&asked.from);
            let plan = begun_in(&folder)?;
            let other = |path: &Path| result_of("dataset", path).is_null().then_some("");
            folder.claim_unless(&["manifest.json"], options.force, other)?;
            merge(&plan, &folder, None, options)
        }
        _ => whole(asked, options, &progress),
    };
    progress.finish();
    outcome
}

fn whole(asked: &DatasetArguments, options: &Options, progress: &Progress) -> Result<Outcome, CliError> {
    progress.stage("plan");
    let plan = DatasetPlan::load(&asked.from, &options.set, asked.count.map(Into::into))?;
    let name = asked.from.file_stem().unwrap_or_default();
    let folder = OutputFolder::at(&options.out.clone().unwrap_or_else(|| Path::new("out").join(name)));
    if asked.resume {
        if options.force {
            return Err(CliError::resume_anew());
        }
        folder.lock()?;
        let begun = read_begun(&folder)?;
        refuse_changes(&folder, &begun, &plan)?;
        if plan.count < begun.count {
            let what = format!("the data set in {} was begun with {} signals", folder.path.display(), begun.count);
            return Err(CliError::input(format!("{what}: expected as many or more, found {}", plan.count))
                .with_help("go on with as many, or begin anew with --force"));
        }
    } else {
        begin(&folder, options.force)?;
    }
    folder.make_below(Path::new(RECORDS))?;
    write_begun(&folder, &plan)?;
    if let Some(tasks) = asked.slurm {
        let tasks = tasks.map_or(MOST_TASKS, Into::into).min(plan.shards());
        return job_scripts(RECORDS, (plan.shards(), "files"), &folder, tasks, options);
    }
    let pace = compute(&plan, &folder, Share::WHOLE, options, progress)?;
    merge(&plan, &folder, Some(pace), options)
}

fn task(from: &Path, share: Share, options: &Options, progress: &Progress) -> Result<Outcome, CliError> {
    let folder = OutputFolder::at(from);
    let plan = begun_in(&folder)?;
    let pace = compute(&plan, &folder, share, options, progress)?;
    let files: Vec<usize> = (0..plan.shards()).filter(|shard| share.has(shard + 1)).collect();
    Ok(Outcome {
        summary: format!("{} signals in {} s", pace.signals, significant(pace.wall_s, 3)),
        written: files.iter().map(|shard| folder.path.join(DatasetPlan::file_name(*shard))).collect(),
        result: json(&TaskSummary { command: RECORDS, task: share.number, of: share.of, points: files })?,
        verdict: Ok(()),
    })
}

/// Takes a folder that no data set is in, or empties that of one.
fn begin(folder: &OutputFolder, force: bool) -> Result<(), CliError> {
    let records = folder.path.join(RECORDS);
    let there = records.join(PLAN).exists();
    if there && !force {
        return Err(CliError::input(format!("{} holds a data set", folder.path.display()))
            .with_help("go on with --resume, replace it with --force, or choose another folder with --out"));
    }
    folder.claim("manifest", force)?;
    let names_in = |folder: &Path| {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        entries.filter_map(|entry| entry.file_name().into_string().ok()).collect::<Vec<_>>()
    };
    let of_signals = |name: &String| {
        name.starts_with("signals-") && [".npz", ".parquet", ".partial"].iter().any(|ending| name.ends_with(ending))
    };
    let mut names: Vec<String> = names_in(&folder.path).into_iter().filter(of_signals).collect();
    if !there && !force {
        // what is left of a plan that was not written to its end is nobody's
        names.extend(names_in(&records).into_iter().map(|name| format!("{RECORDS}/{name}")));
        refuse_foreign(&folder.path, names.into_iter().filter(|name| !name.ends_with(".partial")).collect())?;
    } else if there {
        // a folder that has a plan is a data set's own
        for name in names {
            let path = folder.path.join(name);
            fs::remove_file(&path).map_err(ComputeError::io(&path))?;
        }
        fs::remove_dir_all(&records).map_err(|error| CliError::folder(&records, &error))?;
    }
    Ok(())
}

fn plan_file(folder: &OutputFolder) -> PathBuf {
    folder.path.join(RECORDS).join(PLAN)
}

fn write_begun(folder: &OutputFolder, plan: &DatasetPlan) -> Result<(), CliError> {
    let spec = &plan.source.path;
    let begun = Begun {
        spec: std::path::absolute(spec).map_err(ComputeError::io(spec))?,
        count: plan.count,
        identity: plan.identity.clone(),
    };
    let text = serde_json::to_string_pretty(&begun).unwrap_or_default();
    write_atomic(&plan_file(folder), format!("{text}\n").as_bytes())
}

fn read_begun(folder: &OutputFolder) -> Result<Begun, ComputeError> {
    let path = plan_file(folder);
    let text = fs::read(&path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound | std::io::ErrorKind::NotADirectory => ComputeError::input(
            format!("{} holds no data set: there is no plan {}", folder.path.display(), path.display()),
            "name the folder that `plummer dataset SPEC.toml` wrote",
        ),
        _ => ComputeError::io(&path)(error),
    })?;
    serde_json::from_slice(&text)
        .map_err(|error| ComputeError::wrong(format!("{} is no plan of a data set: {error}", path.display())))
}

/// The plan of the data set in a folder, as it would be begun now.
fn begun_in(folder: &OutputFolder) -> Result<DatasetPlan, CliError> {
    let begun = read_begun(folder)?;
    let plan = DatasetPlan::load(&begun.spec, &begun.identity.set, Some(begun.count))?;
    refuse_changes(folder, &begun, &plan)?;
    Ok(plan)
}

fn refuse_changes(folder: &OutputFolder, begun: &Begun, plan: &DatasetPlan) -> Result<(), CliError> {
    let changes = begun.identity.changes(&plan.identity);
    if changes.is_empty() {
        return Ok(());
    }
    let what = format!("the data set in {} was begun with something else: ", folder.path.display());
    Err(CliError::input(what + &changes.join("; "))
        .with_help("go on with what it was begun with, or begin anew with --force"))
}

/// Computes the shards of a share that are not there.
fn compute(
    plan: &DatasetPlan,
    folder: &OutputFolder,
    share: Share,
    options: &Options,
    progress: &Progress,
) -> Result<Pace, CliError> {
    let again = typed() + if share == Share::WHOLE { " --resume" } else { "" };
    let at = folder.path.clone();
    let interrupted = move |what: &str| CliError::interrupted(what, "the files so far are", &at, &again);
    let left = interrupted.clone();
    failure::on_interrupt(move || left("interrupted"));
    let begun = Instant::now();
    progress.stage("look for files that are there");
    let missing: Vec<usize> =
        (0..plan.shards()).filter(|shard| share.has(shard + 1) && plan.shard(&folder.path, *shard).is_none()).collect();
    let count: usize = missing.iter().map(|shard| plan.of_shard(*shard).len()).sum();
    progress.stage("signals");
    let done = AtomicUsize::new(0);
    let tell = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.set(done as f64 / count as f64);
    };
    let stop = failure::stop_request();
    // what other commands condensed there on several threads differs by round-off
    let cache = options.cache_in(&folder.path).map(|cache| cache.join(RECORDS));
    let work = Work { done: &tell, stop: &stop.asked, cache: cache.as_deref() };
    let mut structures = Structures::default();
    stop.deaf.store(false, Ordering::SeqCst);
    let mut kept = 0;
    let written = missing.iter().try_for_each(|shard| {
        if stop.asked.load(Ordering::SeqCst) {
            return Err(ComputeError::Interrupted { at_s: 0.0, end_s: 0.0 });
        }
        plan.write_shard(&folder.path, *shard, &mut structures, work)?;
        kept += plan.of_shard(*shard).len();
        Ok(())
    });
    stop.deaf.store(true, Ordering::SeqCst);
    match written {
        Ok(()) => Ok(Pace { signals: count, wall_s: begun.elapsed().as_secs_f64() }),
        Err(ComputeError::Interrupted { .. }) => {
            let done = done.load(Ordering::Relaxed);
            Err(interrupted(&format!(
                "interrupted after {done} of {count} signals, of which {kept} are in whole files"
            )))
        }
        Err(error) => Err(error.into()),
    }
}

/// Writes the manifest of the shards, last as JSON.
fn merge(
    plan: &DatasetPlan,
    folder: &OutputFolder,
    pace: Option<Pace>,
    options: &Options,
) -> Result<Outcome, CliError> {
    let manifest = plan.manifest(&folder.path).map_err(|missing| {
        let names: Vec<String> = missing.iter().take(5).map(|shard| DatasetPlan::file_name(*shard)).collect();
        let more = if missing.len() > names.len() { " and others" } else { "" };
        let names = names.join(", ");
        let what = format!("{} of {} files are not there or were changed: {names}{more}", missing.len(), plan.shards());
        CliError::failed(what).with_help("submit the job array again, or go on with --resume")
    })?;
    let table = manifest.table()?;
    let csv = folder.write("manifest.csv", table.to_csv()?.as_bytes())?;
    let parquet = folder.path.join("manifest.parquet");
    write_parquet(&parquet, &table.to_parquet())?;
    let (path, result) = folder.write_json("manifest.json", &manifest)?;
    warn(DatasetPlan::untrusted(&manifest).as_slice(), options);
    warn(plan.inaccurate(&manifest).as_slice(), options);
    let files = manifest.files.iter().map(|file| folder.path.join(&file.path));
    Ok(Outcome {
        summary: summary(&manifest, plan, pace),
        verdict: verdict(&manifest),
        result,
        written: files.chain([csv, parquet, path]).collect(),
    })
}

/// How many signals there are of each label and part, how fast they came, and what could not be computed.
fn summary(manifest: &Manifest<'_>, plan: &DatasetPlan, pace: Option<Pace>) -> String {
    /// Reasons that are listed.
    const LISTED: usize = 5;
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for signal in manifest.signals.iter().filter(|signal| signal.file.is_some()) {
        *counts.entry((&signal.label, &signal.split)).or_default() += 1;
    }
    let parts = ["train", "validation", "test"];
    let columns = std::iter::once(Column::text("Label")).chain(parts.map(|part| Column::number(part, "")));
    let labels = Label::ALL.map(Label::name);
    let there = labels.into_iter().filter(|label| counts.keys().any(|(of, _)| of == label));
    let row = |label: &'static str| {
        let count = |part: &str| counts.get(&(label, part)).copied().unwrap_or(0);
        std::iter::once(Cell::text(label))
            .chain(parts.map(|part| Cell::text(count(part).to_string())))
            .collect::<Vec<_>>()
    };
    let table = Table::new("Signals", columns).rows(there.map(row));
    let mut lines = vec![table.plain()];
    if plan.inaccurate(manifest).is_none() {
        let worst = manifest.signals.iter().filter_map(|signal| signal.estimated_error).fold(0.0, f64::max);
        let what = "largest estimated error of a signal, while nearby solutions stay together";
        lines.push(format!("{what}: {}", significant(worst, 2)));
    }
    if let Some(Pace { signals, wall_s }) = pace.filter(|pace| pace.signals > 0) {
        let simulated = signals as f64 * (manifest.samples as f64 / manifest.rate_hz + plan.spec.recorder.settle_s);
        lines.push(format!(
            "{signals} signals in {} s: {} simulated seconds a second",
            significant(wall_s, 3),
            significant(simulated / wall_s, 3)
        ));
    }
    let failed = manifest.signals.iter().filter_map(|signal| Some((signal.signal, signal.reason.as_ref()?)));
    let mut failed: Vec<String> = failed.map(|(number, reason)| format!("  signal {number}: {reason}")).collect();
    let more = failed.len().saturating_sub(LISTED);
    failed.truncate(LISTED);
    lines.extend(failed);
    lines.extend((more > 0).then(|| format!("  and {more} more, see manifest.csv")));
    lines.join("\n")
}

fn verdict(manifest: &Manifest<'_>) -> Result<(), CliError> {
    match manifest.signals.iter().filter(|signal| signal.file.is_none()).count() {
        0 => Ok(()),
        failed => Err(CliError::failed(format!("{failed} of {} signals are not there", manifest.count))
            .with_help("manifest.csv has the reason of each; the others are as if these did not exist")),
    }
}
