//! `plummer run`: the simulation in time.

use super::earlier_results::{PARTIAL, left_in};
use super::output::json;
use super::report::ReportFiles;
use super::results::{Job, warnings, write_scalograms, write_signals};
use super::{CliError, Outcome, OutputFolder, failure, typed};
use crate::app::case::{Case, Method, Transient};
use crate::app::commands::analyze::{SHOWN_WINDOWS, verdict_lines};
use crate::app::commands::parts::not_shown;
use crate::app::commands::run::unfinished::{RunIdentity, UnfinishedRun};
use crate::app::commands::run::{
    Recording, RunEnd, RunResult, bearing_part, compute_kept_run, cost, explain_run, run_report,
};
use crate::app::error::ComputeError;
use crate::numerics::ode::{BlowUp, MOST_STEPS_PER_INTERVAL, StepLimit};
use crate::report::{quantity, significant, wrapped};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Checks that there is an unfinished run to go on with.
///
/// # Errors
/// [`CliError`]: another process has the folder, `--force` is there too, or the run has ended.
pub(super) fn claim_unfinished(folder: &OutputFolder, force: bool) -> Result<(), CliError> {
    folder.lock()?;
    let (partial, finished) = (folder.path.join(PARTIAL), folder.path.join("run.json"));
    if force {
        Err(CliError::resume_anew())
    } else if !UnfinishedRun::is_in(&partial) && finished.exists() {
        Err(CliError::input(format!(
            "{} is the result of a finished run: there is nothing to go on with",
            finished.display()
        ))
        .with_help("leave --resume out to compute it anew"))
    } else {
        Ok(())
    }
}

/// Characters of a line of what explains a model.
const COLUMNS: usize = 100;

/// Says which model the run of a case would take; writes nothing.
///
/// # Errors
/// [`CliError`] when the input is wrong or there is nothing to start from.
pub(super) fn explain(job: &Job<'_>) -> Result<Outcome, CliError> {
    let (choice, doubts) = explain_run(job.case, job.progress)?;
    let doubts_told = warnings(&doubts).map(|line| wrapped(&line, COLUMNS - 2).join("\n  "));
    let lines = std::iter::once(choice.table().plain_within(COLUMNS)).chain(doubts_told);
    Ok(Outcome {
        summary: lines.collect::<Vec<_>>().join("\n"),
        result: json(&choice.summary(&doubts))?,
        written: Vec::new(),
        verdict: Ok(()),
    })
}

/// Computes the run of a case and writes `signals.npz`, `report.html`, its tables and, last, `run.json`. Until then its rows
/// and checkpoints are in a folder that is removed at the end.
///
/// With `resume` it goes on with the unfinished run; checkpoints are `pause` of wall time apart.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or is interrupted, or a file cannot be written.
pub(super) fn run(job: &Job<'_>, resume: bool, pause: Duration) -> Result<Outcome, CliError> {
    let Job { case, progress, ref folder, .. } = *job;
    let partial = folder.path.join(PARTIAL);
    if !resume && !job.options.force && UnfinishedRun::is_in(&partial) {
        return Err(CliError::input(format!("{} holds an unfinished run", partial.display()))
            .with_help("go on with --resume, or give it up and begin anew with --force"));
    }
    let identity = RunIdentity::of(case, "run")?;
    let nothing = left_in(&folder.path, job.command, job.options.force);
    let (at, of) = (partial.clone(), identity.clone());
    failure::on_interrupt(move || match UnfinishedRun::resume(&at, of.clone()) {
        Ok(_) => interrupted("interrupted", "the signals up to the last checkpoint are", &at),
        Err(_) => nothing(),
    });
    let mut unfinished = match resume {
        true => UnfinishedRun::resume(&partial, identity)?,
        false => UnfinishedRun::begin(&partial, identity),
    };
    (unfinished.every, unfinished.stop) = (pause, failure::stop_request());
    let result = compute_kept_run(case, progress, &mut unfinished);
    let result = result.map_err(|error| match error {
        ComputeError::Interrupted { .. } => {
            interrupted(&error.to_string(), "the signals so far and a checkpoint are", &unfinished.folder)
        }
        error if error.is_of_writing() => kept(error.into(), &unfinished.folder),
        error => error.into(),
    })?;
    let (written, json) = write(job, &result).map_err(|error| kept(error, &unfinished.folder))?;
    unfinished.remove()?;
    Ok(Outcome {
        summary: summary(case, &result, job.started.elapsed().as_secs_f64()),
        result: json,
        written,
        verdict: verdict(&result, case.transient.as_ref()),
    })
}

/// Writes the signals, the report and, last, `run.json`: the files, and what the last one says.
fn write<R: Recording>(job: &Job<'_>, result: &RunResult<R>) -> Result<(Vec<PathBuf>, Value), CliError> {
    let Job { case, progress, ref folder, .. } = *job;
    progress.stage("write");
    let mut arrays = vec![write_signals(folder, result)?];
    arrays.extend(write_scalograms(folder, &result.scalograms)?);
    let report = run_report(case, result, &typed())?;
    let files = ReportFiles::write(folder, "run", case, report, progress)?;
    let (path, json) = job.write_result(&files, &arrays, result.summary())?;
    Ok(([arrays, vec![path], files.paths].concat(), json))
}

/// A failure to write, with the way on from the last checkpoint if there is one.
fn kept(error: CliError, partial: &Path) -> CliError {
    match UnfinishedRun::is_in(partial) {
        true => error.with_help(format!("make room, then go on from the last checkpoint with: {} --resume", typed())),
        false => error,
    }
}

fn interrupted(what: &str, kept: &str, at: &Path) -> CliError {
    CliError::interrupted(what, kept, at, &format!("{} --resume", typed()))
}

fn verdict<R: Recording>(result: &RunResult<R>, asked: Option<&Transient>) -> Result<(), CliError> {
    match &result.simulation.end {
        RunEnd::Complete => match result.distrust() {
            None => Ok(()),
            Some(why) => Err(CliError::failed(format!("the signals cannot be trusted: {why}")).with_help(
                "the warnings of run.json and of the report say by how much, and what helps; signals.npz has the signals all the same",
            )),
        },
        RunEnd::BlewUp(blow_up) => Err(CliError::failed(blow_up.to_string()).with_help(format!(
            "{}; {} instants computed until then are in signals.npz",
            smaller_steps(blow_up, asked),
            result.simulation.record.rows()
        ))),
    }
}

/// What to try after a blow-up.
fn smaller_steps(blow_up: &BlowUp, asked: Option<&Transient>) -> String {
    let no_step = |limit: StepLimit| {
        asked.is_some_and(|asked| limit.step_s < 2.0 / (f64::from(MOST_STEPS_PER_INTERVAL) * asked.output_hz))
    };
    if let Some(limit) = blow_up.limit.filter(|limit| no_step(*limit)) {
        return format!(
            "contacts that vibrate at {:.1e} Hz need shorter steps than a run takes, a millionth of an output interval: check the mass of a ball (bearing.ball_mass, bearing.density) and bearing.stiffness, or leave the balls' inertia out (bearing.balls_inertia = \"quasi-static\", which takes no bearing.contact_damping)",
            limit.highest_hz
        );
    }
    let asked = asked.map(|asked| asked.method);
    if blow_up.method.chooses_its_steps() {
        // a method that the program chose has a tolerance of its own
        let method = match asked {
            Some(Method::Auto) => format!("--set transient.method={} and ", blow_up.method.name()),
            _ => String::new(),
        };
        return format!(
            "{method}a smaller --set transient.tolerance, 1e-6 or below, says whether the steps are the cause"
        );
    }
    let half = 0.5 * blow_up.step_s;
    let (why, step_s) = match (blow_up.resonance, blow_up.limit, blow_up.beyond_the_limit()) {
        (Some(resonance), ..) => {
            ("the step is in resonance with a mode: stay below half its period with", 0.4 / resonance.mode_hz)
        }
        (_, Some(limit), Some(true)) => {
            ("the step is beyond the method's limit: stay well below it with", 0.5 * limit.step_s)
        }
        (_, Some(_), _) => (
            "the step was below the method's limit just before: see whether the steps are the cause with half of it,",
            half,
        ),
        _ => ("see whether the step is the cause with half of it,", half),
    };
    format!("{why} --set transient.step={step_s:.1e}, or leave it to the program with --set transient.step=auto")
}

fn summary<R: Recording>(case: &Case, result: &RunResult<R>, wall_s: f64) -> String {
    let simulation = &result.simulation;
    let mut lines = vec![bearing_part(&result.machine).plain()];
    lines.push(format!(
        "{} s simulated in {} s, with model, choice and report {} s: {} steps of {} ({}), {}, {} s of computing per simulated second",
        significant(simulation.simulated_s, 4),
        significant(simulation.stepping_s, 3),
        significant(simulation.before_s + wall_s, 3),
        simulation.statistics.steps,
        quantity(simulation.step_s(), "s"),
        simulation.method.name(),
        result.kept_words(),
        cost(simulation.realtime_factor()),
    ));
    lines.push(result.estimate_sentence());
    if result.machine.in_space().is_some() && !result.windows.is_empty() {
        lines.push(format!("verdict on the machine: {}", result.verdict_on_machine()));
    }
    for window in result.windows.iter().take(SHOWN_WINDOWS) {
        let [rms, peak] = [window.rms, window.peak].map(|value| significant(value, 3));
        let mut said = verdict_lines(window, |window| not_shown(case, window));
        said.insert(1, format!("  rms {rms} m/s², peak {peak} m/s²"));
        let in_band = window.rms_in_band.and_then(|level| level.beside(window.rms, "m/s²"));
        said.splice(2..2, in_band.map(|text| format!("  rms: {text}")));
        lines.extend(said);
    }
    if let Some(more) = result.windows.len().checked_sub(SHOWN_WINDOWS + 1) {
        lines.push(format!("{} windows more: run.json and the report have them", more + 1));
    }
    if let Some(imported) = &result.machine.stage().bodies.imported {
        lines.extend(imported.notes.iter().cloned());
    }
    lines.extend(warnings(&result.warnings));
    lines.extend(result.not_analysed.iter().map(|text| format!("warning: not analysed: {text}")));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::summary;
    use crate::app::case::Case;
    use crate::app::commands::run::compute_run;
    use crate::numerics::Unwatched;

    #[test]
    fn the_time_before_a_run_was_resumed_counts() {
        let case = Case::example("scenes/smooth", &["transient.end=1e-3", "transient.modes=7"]);
        let mut result = compute_run(&case, &Unwatched).unwrap();
        (result.simulation.before_s, result.simulation.stepping_s) = (200.0, 210.0);
        let text = summary(&case, &result, 50.0);
        assert!(text.contains(" s simulated in 210 s, with model, choice and report 250 s: "), "{text}");
    }
}
