//! `plummer analyze`: from signals to verdicts.

mod arguments;
mod baseline;
mod bearing;
mod failures;
mod machine;
mod orders;
mod read;
mod single;
mod source;
mod speed;
mod survey;
mod terminal;

use std::io;
use std::path::{Path, PathBuf};

pub use arguments::AnalyzeArguments;
pub(super) use bearing::{bearing_names, catalogue_orders};
pub use orders::GivenOrders;
pub use speed::GivenSpeed;

use super::{CliError, Options, Outcome, OutputFolder, emit};
use crate::app::case::EnvelopeBand;
use crate::app::commands::analyze::{AnalysisRow, analysis_table};
use crate::app::shell_word::shell_word;

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
fn warn(texts: &[String], options: &Options) {
    for text in texts.iter().filter(|_| !options.quiet) {
        // nothing can be done about a closed standard error
        let _ = emit(&mut io::stderr().lock(), &format!("warning: {text}"));
    }
}

/// Writes `analysis.csv`.
fn write_table(folder: &OutputFolder, rows: &[AnalysisRow]) -> Result<PathBuf, CliError> {
    folder.write("analysis.csv", analysis_table(rows).to_csv().as_bytes())
}

/// `--out`, else the run's own folder, else `out/` and the file's name; of several inputs `out/analysis`.
fn folder(asked: &AnalyzeArguments, options: &Options) -> OutputFolder {
    if let Some(out) = &options.out {
        return OutputFolder::at(out);
    }
    match asked.inputs.as_slice() {
        [folder] if folder.is_dir() => OutputFolder::at(folder),
        [file] => OutputFolder::at(&Path::new("out").join(file.file_stem().unwrap_or_default())),
        _ => OutputFolder::at(Path::new("out/analysis")),
    }
}

/// The command line that analyses this again.
fn command(asked: &AnalyzeArguments) -> String {
    let file = |path: &Path| shell_word(&path.to_string_lossy());
    let mut words = vec!["plummer analyze".to_owned()];
    words.extend(asked.inputs.iter().map(|input| file(input)));
    let mut push = |key: &str, value: String| words.push(format!("--{key} {value}"));
    for channel in &asked.channel {
        push("channel", shell_word(channel));
    }
    let mut number = |key: &str, value: Option<f64>| {
        if let Some(value) = value {
            push(key, value.to_string());
        }
    };
    number("rate", asked.rate);
    number("balls", asked.balls.map(f64::from));
    number("pitch-diameter", asked.pitch_diameter);
    number("ball-diameter", asked.ball_diameter);
    number("contact-angle", asked.balls.map(|_| asked.contact_angle));
    number("high-pass", asked.high_pass);
    number("geometry-error", asked.geometry_error);
    if let Some(path) = &asked.bearing {
        push("bearing", file(path));
    }
    if let Some(given) = &asked.orders {
        push("orders", given.to_string());
    }
    if let Some(speed) = &asked.speed {
        push("speed", shell_word(&speed.text));
    }
    match asked.band {
        Some(EnvelopeBand::Between([from, to])) => push("band", format!("{from}:{to}")),
        Some(EnvelopeBand::Kurtogram) => push("band", "kurtogram".to_owned()),
        None => {}
    }
    for window in &asked.window {
        push("window", format!("{}:{}", window.from, window.to));
    }
    if let Some(path) = &asked.baseline {
        words.push(format!("--baseline {}", file(path)));
    }
    if let Some(speed) = &asked.baseline_speed {
        words.push(format!("--baseline-speed {}", shell_word(&speed.text)));
    }
    if let Some(channel) = &asked.baseline_channel {
        words.push(format!("--baseline-channel {}", shell_word(channel)));
    }
    if let Some(rate) = asked.baseline_rate {
        words.push(format!("--baseline-rate {rate}"));
    }
    if let Some(window) = asked.baseline_window {
        words.push(format!("--baseline-window {}:{}", window.from, window.to));
    }
    if asked.whiten {
        words.push("--whiten".to_owned());
    }
    words.join(" ")
}
