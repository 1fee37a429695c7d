//! `plummer analyze`: from signals to verdicts.

mod arguments;
mod baseline;
mod orders;
mod single;
mod source;
mod survey;
mod turning_bearing;

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub use arguments::AnalyzeArguments;
pub use orders::{GivenOrders, GivenSpeed};
pub(super) use turning_bearing::catalogue_orders;

use super::earlier_results::{left_in, result_of};
use super::report::ReportFiles;
use super::results::result_head;
use super::{CliError, Options, Outcome, OutputFolder, Progress, emit, failure};
use crate::app::commands::analyze::{AnalysisRow, analysis_table};
use crate::app::commands::result::ResultHead;
use crate::files::{self, FileDigest};
use crate::report::Report;
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest, Sha256};

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

/// Takes the folder for these inputs; an analysis in it of others, or by other values, is lost only by `force`. Gives the digest of
/// what is asked for.
fn claim(folder: &OutputFolder, asked: &AnalyzeArguments, options: &Options) -> Result<String, CliError> {
    let digest = digest(asked, options);
    folder.claim_unless(&[format!("{RESULT}.json")], options.force, |path| {
        let earlier = result_of("analyze", path);
        let several = earlier["inputs"].as_array().map(|all| all.iter().map(|one| &one["input"]).collect());
        let analysed: Vec<&Value> = several.unwrap_or_else(|| vec![&earlier["input"]]);
        let inputs = asked.inputs.iter().map(|input| Some(&**input));
        let same = analysed.iter().map(|input| input.as_str().map(Path::new)).eq(inputs);
        match (earlier.is_null(), same) {
            (true, _) => Some(""),
            (_, false) => Some(" of another signal"),
            _ => (earlier["asked_digest"] != *digest).then_some(" of other values"),
        }
    })?;
    failure::on_interrupt(left_in(&folder.path, RESULT, options.force));
    Ok(digest)
}

/// SHA-256 of the options, without the head of the report, and of the content of all files.
fn digest(asked: &AnalyzeArguments, given: &Options) -> String {
    let head = |set: &str| ["title", "report"].iter().any(|table| set.trim_start().starts_with(table));
    let set: Vec<&String> = given.set.iter().filter(|set| !head(set)).collect();
    let mut text = format!("{asked:?} {set:?}");
    for path in asked.inputs.iter().chain(&asked.bearing).chain(&asked.baseline) {
        let file = if path.is_dir() { path.join(source::RUN.arrays) } else { path.clone() };
        // one that cannot be read is named where it is needed, and the catalogue's bearings are no files
        text.extend(FileDigest::of_file(&file).map(|file| file.sha256));
    }
    files::hex(Sha256::new_with_prefix(text))
}
