//! Many files and folders, analysed into one table.
//!
//! What could not be analysed among many files.

use super::baseline::{Baseline, analyse};
use super::single::no_part_judged;
use super::source::{Source, Unnamed};
use super::{AnalyzeArguments, claim, warn, write_results};
use crate::app::case::ReportDetails;
use crate::app::cli::output::extend_new;
use crate::app::cli::{CliError, Options, Outcome, OutputFolder, Progress, typed};
use crate::app::commands::analyze::{
    AnalysisRow, FailureSummary, InputSummary, SHOWN_WINDOWS, SurveyResult, WindowAnalysis, WindowOfInput,
    input_section, survey_report, survey_section, verdicts_table,
};
use crate::app::commands::parts::with_entries;
use crate::report::{Cell, Fact, Section};
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What is kept of an input: what the table, the result and the report have of it.
#[derive(Debug, Default)]
struct Analysed {
    /// What `analysis.json` says of the input; nothing of one that could not be read.
    input: Option<InputSummary>,
    /// What the page says of it.
    said: Option<Said>,
    assumptions: Vec<String>,
    rows: Vec<AnalysisRow>,
    sections: Vec<Section>,
    warnings: Vec<String>,
    failures: Vec<Failure>,
}

/// What the page of all inputs says of one that could be read.
#[derive(Debug)]
struct Said {
    details: Option<ReportDetails>,
    machine: Vec<Fact>,
    rows: Vec<[Cell; 6]>,
}

/// The value, if all are the same.
fn same<T: PartialEq>(values: &[T]) -> Option<&T> {
    values.first().filter(|first| values.iter().all(|value| value == *first))
}

/// Analyses every input into one folder.
///
/// # Errors
/// [`CliError`]: an earlier result, a file that cannot be written, no input that can be analysed.
pub(super) fn survey(
    inputs: &[PathBuf],
    asked: &AnalyzeArguments,
    options: &Options,
    folder: &OutputFolder,
) -> Result<Outcome, CliError> {
    let started = std::time::Instant::now();
    let baseline = Baseline::open(asked, options)?;
    let asked_digest = claim(folder, asked, options)?;
    let progress = Progress::new(options.shows_progress());
    progress.stage("analyse");
    let (shown, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    progress.count(0, inputs.len());
    let analysed = each(inputs, |input| {
        let analysed = Analysed::of(input, asked, options, baseline.as_ref(), &shown);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.count(done, inputs.len());
        analysed
    });
    progress.stage("write");
    // what is said of one machine, as each run's case does, is not said of the others
    let read = || analysed.iter().filter_map(|one| one.said.as_ref());
    let details: Vec<_> = read().map(|said| said.details.clone()).collect();
    let machines: Vec<_> = read().map(|said| said.machine.clone()).collect();
    let input_section = input_section(read().flat_map(|said| said.rows.clone()), same(&machines));
    let mut all = Analysed::default();
    let mut of_inputs = Vec::new();
    let mut failed = 0;
    for one in analysed {
        failed += usize::from(!one.failures.is_empty());
        of_inputs.extend(one.input);
        all.rows.extend(one.rows);
        all.sections.extend(one.sections);
        all.warnings.extend(one.warnings);
        all.failures.extend(one.failures);
        extend_new(&mut all.assumptions, one.assumptions);
    }
    if all.rows.iter().all(|row| row.found.is_err()) {
        progress.finish();
        return Err(failure(&all.failures, failed, inputs.len()));
    }
    let mut report = survey_report(inputs.len(), &all.rows, input_section, all.sections, &all.assumptions, &typed());
    report = with_entries(report, same(&details).and_then(Option::as_ref));
    report.warnings.extend(asked.doubts());
    all.warnings.extend(baseline.iter().flat_map(Baseline::doubts));
    warn(&all.warnings, options);
    report.warnings.extend(all.warnings);
    let windows = all.rows.iter().filter_map(|AnalysisRow { input, found, .. }| {
        let window = found.as_ref().ok()?;
        Some(WindowOfInput { input, window })
    });
    let (result, written) = write_results(folder, &progress, started, report, &all.rows, |head| SurveyResult {
        head,
        inputs: of_inputs,
        asked_digest,
        failures: all.failures.iter().map(Failure::summary).collect(),
        windows: windows.collect(),
    })?;
    let verdict = match failed {
        0 => verdict(&all.rows),
        failed => Err(failure(&all.failures, failed, inputs.len())),
    };
    Ok(Outcome { summary: verdicts_table(&all.rows).plain(), result, written, verdict })
}

impl Analysed {
    /// Reads and analyses an input. `shown` counts the windows of all inputs: a report shows few.
    fn of(
        input: &Path,
        asked: &AnalyzeArguments,
        options: &Options,
        baseline: Option<&Baseline>,
        shown: &AtomicUsize,
    ) -> Self {
        let mut analysed = Self::default();
        let name = input.display().to_string();
        let mut source = match Source::open(asked, input, Unnamed::Every, options) {
            Ok(source) => source,
            Err(error) => {
                analysed.fail(&name, "", error);
                return analysed;
            }
        };
        source.absent.drain(..).for_each(|(channel, error)| analysed.fail(&name, &channel, error));
        analysed.said = Some(Said {
            details: source.details().cloned(),
            machine: source.machine_facts(),
            rows: source.input_rows(&name),
        });
        let named = |text: &String| format!("{name}: {text}");
        analysed.warnings.extend(source.doubts.iter().map(named));
        let mut orders = None;
        for signal in &source.signals {
            let windows = match analyse(baseline, input, &source, signal) {
                Ok(windows) => windows,
                Err(error) => {
                    analysed.fail(&name, &signal.name, error);
                    continue;
                }
            };
            if orders.is_none() {
                orders = source.defect_orders(input, windows.first()).ok();
            }
            for window in windows {
                for text in window.change.iter().flat_map(|change| &change.warnings) {
                    analysed.warnings.push(format!("{name}: {text}"));
                }
                if shown.fetch_add(1, Ordering::Relaxed) < SHOWN_WINDOWS {
                    analysed.sections.push(survey_section(&name, &window));
                }
                analysed.rows.push(AnalysisRow::of(&name, window));
            }
        }
        analysed.input = Some(InputSummary {
            input: name,
            case: source.case.map(|case| case.source.path.display().to_string()),
            defect_orders: orders,
        });
        analysed.assumptions = source.assumptions;
        analysed
    }

    fn fail(&mut self, input: &str, channel: &str, error: CliError) {
        let (input, channel) = (input.to_owned(), channel.to_owned());
        self.rows.push(AnalysisRow { input: input.clone(), channel: channel.clone(), found: Err(error.to_string()) });
        self.failures.push(Failure { input, channel, error });
    }
}

/// Good where a part was judged in any window.
fn verdict(rows: &[AnalysisRow]) -> Result<(), CliError> {
    let judged = |row: &AnalysisRow| row.found.as_ref().is_ok_and(WindowAnalysis::is_judged);
    match rows.iter().any(judged) {
        true => Ok(()),
        false => Err(no_part_judged(&rows.first().map_or_else(|| "no windows".to_owned(), AnalysisRow::reason))),
    }
}

/// Does `work` on each item, as many at a time as there are threads to compute with, and returns what it gives in the order of the
/// items.
///
/// The threads are not those of rayon: one of those would begin another item while it waits for a part of its own, so that there
/// would be more items in memory than threads.
fn each<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let in_turn = || {
        let places = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        places.map_while(|place| Some((place, work(items.get(place)?)))).collect::<Vec<_>>()
    };
    let mut done = thread::scope(|scope| {
        let threads = 0..rayon::current_num_threads().min(items.len());
        let threads: Vec<_> = threads.map(|_| scope.spawn(in_turn)).collect();
        let results = threads.into_iter().map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
        results.flatten().collect::<Vec<_>>()
    });
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Most files that a message names.
const LISTED: usize = 20;

/// Why an input, or a channel of it, was not analysed.
#[derive(Debug)]
pub(super) struct Failure {
    pub(super) input: String,
    /// Empty: the whole input.
    pub(super) channel: String,
    pub(super) error: CliError,
}

impl Failure {
    /// What a result says of it.
    pub(super) fn summary(&self) -> FailureSummary {
        FailureSummary { input: self.input.clone(), channel: self.channel.clone(), error: self.error.to_string() }
    }

    /// The message, with the file in front if it does not say it.
    fn line(&self) -> String {
        let Self { input, channel, error } = self;
        let message = error.to_string();
        let named = message.starts_with(input) || message.contains(&format!(" {input}:"));
        match channel.as_str() {
            _ if named && message.contains(channel.as_str()) => message,
            "" => format!("{input}: {message}"),
            channel => format!("{input}, channel \"{channel}\": {message}"),
        }
    }
}

/// All of them as one error, which names `failed` files of `inputs`; the input is to blame if it is for any of them.
pub(super) fn failure(failures: &[Failure], failed: usize, inputs: usize) -> CliError {
    let mut lines = vec![format!("{failed} of {inputs} inputs could not be analysed in full:")];
    lines.extend(failures.iter().take(LISTED).map(|failure| format!("  {}", failure.line())));
    if failures.len() > LISTED {
        lines.push(format!("  and {} more", failures.len() - LISTED));
    }
    let what = lines.join("\n");
    let mut helps: Vec<&str> = Vec::new();
    extend_new(&mut helps, failures.iter().filter_map(|failure| failure.error.help.as_deref()).flat_map(str::lines));
    helps.truncate(LISTED);
    let is_input = failures.iter().any(|failure| failure.error.is_input);
    CliError { is_input, what, help: Some(helps.join("\n")).filter(|help| !help.is_empty()) }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_items_and_few_at_a_time() {
        let (now, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let items: Vec<u64> = (0..40).collect();
        let results = each(&items, |&item| {
            most.fetch_max(now.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
            thread::sleep(Duration::from_micros(100 * (40 - item)));
            now.fetch_sub(1, Ordering::SeqCst);
            10 * item
        });
        assert_eq!(results, (0..40).map(|item| 10 * item).collect::<Vec<_>>());
        assert!(most.into_inner() <= rayon::current_num_threads());
        assert_eq!(each(&[0; 0], |&item: &i32| item), Vec::<i32>::new());
    }
}

#[cfg(test)]
mod terminal_tests {
    use super::*;
    use crate::app::commands::analyze::UsedBand;
    use crate::numerics::series::TimeWindow;
    use crate::report::{Abscissa, Curve};
    use crate::signal::diagnosis::{
        Conclusion, Diagnosis, EnvelopeOrderSpectrum, Fault, FaultVerdict, SpeedSource, UnexplainedImpacts,
    };
    use crate::signal::{AmplitudeSpectrum, EnvelopeSpectrum, WindowFunction};

    fn diagnosis(faults: Vec<FaultVerdict>) -> Diagnosis {
        let impacts = UnexplainedImpacts {
            order: 2.945,
            frequency_hz: 88.2,
            false_alarm: 1e-9,
            harmonics_seen: 4,
            strength_db: None,
            band_hz: [0.0, 1e3],
        };
        let unit = String::new();
        let spectrum =
            EnvelopeOrderSpectrum { order: vec![], amplitude: vec![], unit, turns: 300.0, mean: 0.0, highest: 0.0 };
        Diagnosis {
            envelope: String::new(),
            envelopes: 1,
            spectrum,
            speed_hz: 29.953,
            given_speed_hz: 29.953,
            speed_error: 0.0,
            speed_source: SpeedSource::Exact,
            faults,
            unexplained: vec![impacts],
            by_signal_alone: Vec::new(),
            grew: Vec::new(),
        }
    }

    fn window(diagnosis: Result<Diagnosis, String>) -> WindowAnalysis {
        let spectrum = AmplitudeSpectrum {
            frequency_hz: Vec::new(),
            amplitude: Vec::new(),
            unit: "g".to_owned(),
            window: TimeWindow { from: 0.0, to: 10.0 },
            window_function: WindowFunction::Hann,
            zero_padding: 4.0,
            bin_hz: 0.1,
            resolution_hz: 0.4,
        };
        WindowAnalysis {
            sensor: "P1".to_owned(),
            bearing: None,
            unit: "g".to_owned(),
            whitened: false,
            from: 0.0,
            to: 10.0,
            speed_hz: 29.953,
            rms: 0.123_45,
            peak: 1.0,
            rms_in_band: None,
            kurtosis: Some(3.0),
            band: UsedBand::default(),
            fault_lines: Vec::new(),
            smeared_above: None,
            peaks: Vec::new(),
            diagnosis,
            change: None,
            shown: ["P1", "envelope"].map(|name| Curve::new(name, Abscissa::Points(Vec::new()), Vec::new())),
            spectrum: EnvelopeSpectrum { spectrum, high_pass_hz: None },
            lines: Vec::new(),
        }
    }

    #[test]
    fn columns_are_aligned_and_a_row_is_a_line() {
        let part = |fault, conclusion, false_alarm: Option<f64>| FaultVerdict {
            conclusion,
            false_alarm,
            strength_db: false_alarm.map(|_| 21.6),
            expected_order: 3.0,
            fault,
            ..FaultVerdict::default()
        };
        let row = |input: &str, parts: Result<Vec<FaultVerdict>, String>| {
            AnalysisRow::of(input, window(parts.map(diagnosis)))
        };
        let rows = [
            row(
                "a.csv",
                Ok(vec![
                    part(Fault::OuterRace, Conclusion::Named, Some(1e-9)),
                    part(Fault::Ball, Conclusion::NotEnough, Some(1e-2)),
                ]),
            ),
            row("longer.csv", Ok(vec![part(Fault::Cage, Conclusion::NotEnough, None)])),
            row("c.csv", Err("two\nlines".to_owned())),
            AnalysisRow {
                input: "d\u{1b}.csv".to_owned(),
                channel: String::new(),
                found: Err("no such file".to_owned()),
            },
        ];
        let expected = "\
Verdicts
  File        Channel  Window     Speed [Hz]      RMS  Kurtosis  Verdict                                Reason
  a.csv       P1       0 to 10 s       29.95  0.123 g      3.00  fault indicated: outer race
  longer.csv  P1       0 to 10 s       29.95  0.123 g      3.00  impacts at 88.20 Hz belong to no part  Check bearing and speed, and what else turns.
  c.csv       P1       0 to 10 s       29.95  0.123 g      3.00  no verdict                             two lines
  d .csv                                                         not analysed                           no such file";
        assert_eq!(verdicts_table(&rows).plain(), expected);
    }
}
