//! `plummer analyze`: from signals to verdicts.

mod arguments;
mod baseline;
mod machine;
mod orders;
mod single;
mod source;
mod survey;

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub use arguments::AnalyzeArguments;
pub(super) use machine::catalogue_orders;
pub use orders::{GivenOrders, GivenSpeed};

use super::earlier_results::result_of;
use super::report::ReportFiles;
use super::results::result_head;
use super::{CliError, Options, Outcome, OutputFolder, Progress, emit};
use crate::app::case::EnvelopeBand;
use crate::app::commands::analyze::{AnalysisRow, analysis_table};
use crate::app::commands::result::ResultHead;
use crate::app::shell_word::shell_word;
use crate::numerics::series::TimeWindow;
use crate::report::Report;
use serde::Serialize;
use serde_json::Value;

/// Result file and report belong to this word.
const RESULT: &str = "analysis";

/// Analyses a run's signals or measured ones and writes the report, its tables, `analysis.csv` and, last, `analysis.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong or a file cannot be written.
pub(crate) fn analyze(asked: &AnalyzeArguments, options: &Options) -> Result<Outcome, CliError> {
    warn(&asked.doubts(), options);
    let folder = folder(asked, options);
    match asked.inputs.as_slice() {
        [input] => single::single(input, asked, options, &folder),
        inputs => survey::survey(inputs, asked, options, &folder),
    }
}

/// Says warnings on standard error; reports have them too.
pub(super) fn warn(texts: &[String], options: &Options) {
    for text in texts.iter().filter(|_| !options.quiet) {
        // nothing can be done about a closed standard error
        let _ = emit(&mut io::stderr().lock(), &format!("warning: {text}"));
    }
}

/// Writes the report, its tables, `analysis.csv` and, last, `analysis.json`; gives what this says, and the files.
fn write_results<R: Serialize>(
    folder: &OutputFolder,
    progress: &Progress,
    started: Instant,
    report: Report,
    rows: &[AnalysisRow],
    result: impl FnOnce(ResultHead) -> R,
) -> Result<(Value, Vec<PathBuf>), CliError> {
    let files = ReportFiles::without_case(folder, RESULT, report)?;
    let table = folder.write("analysis.csv", analysis_table(rows).to_csv().as_bytes())?;
    let result = result(result_head("analyze", progress, started.elapsed().as_secs_f64(), Some(&files.tables)));
    let (path, json) = folder.write_json("analysis.json", &result)?;
    progress.finish();
    Ok((json, [vec![path, table], files.paths].concat()))
}

/// `--out`, else the run's own folder, else `out/` and the file's name; of several inputs `out/analysis`.
fn folder(asked: &AnalyzeArguments, options: &Options) -> OutputFolder {
    match (&options.out, asked.inputs.as_slice()) {
        (Some(out), _) => OutputFolder::at(out),
        (None, [folder]) if folder.is_dir() => OutputFolder::at(folder),
        (None, [file]) => OutputFolder::at(&Path::new("out").join(file.file_stem().unwrap_or_default())),
        (None, _) => OutputFolder::at(Path::new("out/analysis")),
    }
}

/// Takes the folder for these inputs; an analysis of others in it is lost only by `force`.
fn claim(folder: &OutputFolder, inputs: &[PathBuf], force: bool) -> Result<(), CliError> {
    folder.claim_unless(&[format!("{RESULT}.json")], force, |path| {
        let earlier = result_of("analyze", path);
        let several = earlier["inputs"].as_array().map(|all| all.iter().map(|one| &one["input"]).collect());
        let analysed: Vec<&Value> = several.unwrap_or_else(|| vec![&earlier["input"]]);
        let same =
            analysed.iter().map(|input| input.as_str().map(Path::new)).eq(inputs.iter().map(|input| Some(&**input)));
        (!same).then_some(if earlier.is_null() { "" } else { " of another signal" })
    })
}

/// The command line that analyses this again.
fn command(asked: &AnalyzeArguments, given: &Options) -> String {
    let file = |path: &PathBuf| shell_word(&path.to_string_lossy());
    let number = |value: Option<f64>| value.map(|value| value.to_string());
    let speed = |speed: &Option<GivenSpeed>| speed.as_ref().map(|speed| shell_word(&speed.text));
    let window = |window: &TimeWindow| format!("{}:{}", window.from, window.to);
    let band = asked.band.map(|band| match band {
        EnvelopeBand::Between([from, to]) => format!("{from}:{to}"),
        EnvelopeBand::Kurtogram => "kurtogram".to_owned(),
    });
    let channels = asked.channel.iter().map(|channel| ("channel", Some(shell_word(channel))));
    let of_input = [
        ("rate", number(asked.rate)),
        ("balls", number(asked.balls.map(f64::from))),
        ("pitch-diameter", number(asked.pitch_diameter)),
        ("ball-diameter", number(asked.ball_diameter)),
        ("contact-angle", number(asked.balls.map(|_| asked.contact_angle))),
        ("high-pass", number(asked.high_pass)),
        ("geometry-error", number(asked.geometry_error)),
        ("bearing", asked.bearing.as_ref().map(file)),
        ("orders", asked.orders.map(|given| given.to_string())),
        ("speed", speed(&asked.speed)),
        ("band", band),
    ];
    let windows = asked.window.iter().map(|asked| ("window", Some(window(asked))));
    let of_baseline = [
        ("baseline", asked.baseline.as_ref().map(file)),
        ("baseline-speed", speed(&asked.baseline_speed)),
        ("baseline-channel", asked.baseline_channel.as_deref().map(shell_word)),
        ("baseline-rate", number(asked.baseline_rate)),
        ("baseline-window", asked.baseline_window.as_ref().map(window)),
    ];
    let set = given.set.iter().map(|set| ("set", Some(shell_word(set))));
    let options = channels.chain(of_input).chain(windows).chain(of_baseline).chain(set);
    let options = options.filter_map(|(key, value)| Some(format!("--{key} {}", value?)));
    let whiten = asked.whiten.then(|| "--whiten".to_owned());
    let words = std::iter::once("plummer analyze".to_owned()).chain(asked.inputs.iter().map(file));
    words.chain(options).chain(whiten).collect::<Vec<_>>().join(" ")
}
