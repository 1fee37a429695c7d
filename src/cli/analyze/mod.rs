//! `plummer analyze`: from a signal to a verdict.

mod arguments;
mod error;
mod source;

use std::path::Path;

use serde_json::{Map, Value, json};

pub use arguments::{AnalyzeArguments, GivenOrders, GivenSpeed};
pub use error::AnalyzeError;

use self::source::Source;
use super::report_files::ReportFiles;
use super::results::{stages_s, windows_json};
use super::{CliError, Options, Outcome, OutputFolder, Progress, Verdict};
use crate::case::EnvelopeBand;
use crate::diagnosis::{Conclusion, Fault};
use crate::report::significant;
use crate::shell_word::shell_word;
use crate::stages::{WindowAnalysis, analysis_report, compute_analysis};

/// Result file and report belong to this word.
const RESULT: &str = "analysis";

/// Analyses a run's signals or measured ones and writes the report, its tables and, last, `analysis.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong or a file cannot be written.
pub fn analyze(asked: &AnalyzeArguments, options: &Options) -> Result<Outcome, CliError> {
    let started = std::time::Instant::now();
    let folder = folder(asked, options);
    let progress = Progress::new(options.visibility());
    progress.stage("read");
    let source = Source::open(asked, options)?;
    folder.claim(RESULT, options.force)?;
    let kinematics = source.kinematics();
    let windows = compute_analysis(&source.signals, &source.settings, &kinematics, &progress)?;
    progress.stage("write");
    let input = asked.input.display().to_string();
    let report = analysis_report(&input, &source.assumptions, &windows, &command(asked));
    let files = ReportFiles::without_case(&folder, RESULT, report)?;
    let first = windows.first().map(|window| crate::series::TimeWindow {
        from: window.from,
        to: window.to,
    });
    let orders = first.map(|window| kinematics.orders(window)).transpose()?;
    let order = |fault| orders.and_then(|orders| orders.order(fault));
    let mut map = Map::new();
    for (key, value) in [
        ("plummer", json!(env!("CARGO_PKG_VERSION"))),
        ("command", json!("analyze")),
        ("case", json!(source.case)),
        ("input", json!(asked.input)),
        ("wall_s", json!(started.elapsed().as_secs_f64())),
        ("stages_s", stages_s(&progress)),
        ("threads", json!(rayon::current_num_threads())),
        ("tables", json!(files.tables)),
        (
            "defect_orders",
            json!({
                "cage": order(Fault::Cage),
                "outer": order(Fault::OuterRace),
                "inner": order(Fault::InnerRace),
                "ball": order(Fault::Ball),
                "relative_error": orders.map(|orders| orders.error(Fault::OuterRace)),
            }),
        ),
        ("windows", windows_json(&windows)),
    ] {
        map.insert(key.to_owned(), value);
    }
    let json = Value::Object(map);
    let path = folder.write("analysis.json", format!("{json:#}\n").as_bytes())?;
    progress.finish();
    Ok(Outcome {
        summary: summary(&windows),
        result: json,
        written: [vec![path], files.paths].concat(),
        verdict: verdict(&windows),
    })
}

/// `--out`, else the run's own folder, else `out/` and the file's name.
fn folder(asked: &AnalyzeArguments, options: &Options) -> OutputFolder {
    if let Some(out) = &options.out {
        return OutputFolder::at(out);
    }
    if asked.input.is_dir() {
        return OutputFolder::at(&asked.input);
    }
    let name = asked.input.file_stem().unwrap_or_default();
    OutputFolder::at(&Path::new("out").join(name))
}

/// The command line that analyses this again.
fn command(asked: &AnalyzeArguments) -> String {
    let file = |path: &Path| shell_word(&path.to_string_lossy());
    let mut words = vec![format!("plummer analyze {}", file(&asked.input))];
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
        push("speed", speed.text.clone());
    }
    match asked.band {
        Some(EnvelopeBand::Between([from, to])) => push("band", format!("{from}:{to}")),
        Some(EnvelopeBand::Kurtogram) => push("band", "kurtogram".to_owned()),
        None => {}
    }
    for window in &asked.window {
        push("window", format!("{}:{}", window.from, window.to));
    }
    if asked.whiten {
        words.push("--whiten".to_owned());
    }
    words.join(" ")
}

fn judged(window: &WindowAnalysis) -> bool {
    let diagnosis = window.diagnosis.as_ref();
    diagnosis.is_ok_and(|diagnosis| {
        let mut faults = diagnosis.faults.iter();
        faults.any(|verdict| verdict.false_alarm.is_some())
    })
}

fn verdict(windows: &[WindowAnalysis]) -> Verdict {
    if windows.iter().any(judged) {
        return Verdict::Good;
    }
    let reason = windows.iter().find_map(|window| match &window.diagnosis {
        Ok(diagnosis) => Some(diagnosis.faults.first()?.why.clone()),
        Err(reason) => Some(reason.clone()),
    });
    Verdict::Bad {
        what: format!(
            "no part could be judged in any window: {}",
            reason.unwrap_or_else(|| "no orders".to_owned())
        ),
        help: Some(
            "take a longer --window, and check --speed: at least 16 events of a part are needed"
                .to_owned(),
        ),
    }
}

fn summary(windows: &[WindowAnalysis]) -> String {
    let mut lines = Vec::new();
    for window in windows {
        let place = format!(
            "{} from {} to {} s",
            window.sensor,
            significant(window.from, 5),
            significant(window.to, 5)
        );
        match &window.diagnosis {
            Err(reason) => lines.push(format!("{place}: no verdict: {reason}")),
            Ok(diagnosis) => {
                lines.push(format!(
                    "{place} (shaft {} Hz, {} turns): {}",
                    significant(diagnosis.speed_hz, 4),
                    significant(diagnosis.spectrum.turns, 3),
                    diagnosis.sentence()
                ));
                for verdict in &diagnosis.faults {
                    if verdict.conclusion != Conclusion::NotSeen {
                        lines.push(format!("  {}: {}", verdict.fault.name(), verdict.why));
                    }
                }
            }
        }
    }
    lines.join("\n")
}
