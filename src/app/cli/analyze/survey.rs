//! Many files and folders, analysed into one table.

use super::baseline::{Baseline, analyse};
use super::failures::{Failure, failure};
use super::read::Unnamed;
use super::single::no_part_judged;
use super::source::Source;
use super::terminal;
use super::{AnalyzeArguments, RESULT, command, warn, write_results};
use crate::app::cli::output::extend_new;
use crate::app::cli::{CliError, Options, Outcome, OutputFolder, Progress};
use crate::app::commands::analyze::{
    AnalysisRow, InputSummary, SHOWN_WINDOWS, SurveyResult, WindowAnalysis, WindowOfInput, survey_report,
    survey_section,
};
use crate::report::Section;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What is kept of an input: what the table, the result and the report have of it.
#[derive(Debug, Default)]
struct Analysed {
    /// What `analysis.json` says of the input; nothing of one that could not be read.
    input: Option<InputSummary>,
    assumptions: Vec<String>,
    rows: Vec<AnalysisRow>,
    sections: Vec<Section>,
    warnings: Vec<String>,
    failures: Vec<Failure>,
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
    folder.claim(RESULT, options.force)?;
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
    let mut report = survey_report(inputs.len(), &all.rows, all.sections, &all.assumptions, &command(asked));
    report.warnings.extend(asked.doubts());
    all.warnings.extend(baseline.iter().flat_map(Baseline::doubts));
    warn(&all.warnings, options);
    report.warnings.extend(all.warnings);
    let (result, written) = write_results(folder, &progress, started, report, &all.rows, |head| SurveyResult {
        head,
        inputs: of_inputs,
        failures: all.failures.iter().map(Failure::summary).collect(),
        windows: all.rows.iter().filter_map(window_of_input).collect(),
    })?;
    let verdict = match failed {
        0 => verdict(&all.rows),
        failed => Err(failure(&all.failures, failed, inputs.len())),
    };
    Ok(Outcome { summary: terminal::table(&all.rows), result, written, verdict })
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
        let source = match Source::open(asked, input, Unnamed::Every, options) {
            Ok(source) => source,
            Err(error) => {
                analysed.fail(&name, "", error);
                return analysed;
            }
        };
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
            case: source.case.map(|path| path.display().to_string()),
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
        false => Err(no_part_judged(&rows.first().map_or_else(|| "no windows".to_owned(), AnalysisRow::remark))),
    }
}

fn window_of_input(row: &AnalysisRow) -> Option<WindowOfInput<'_>> {
    let window = row.found.as_ref().ok()?;
    Some(WindowOfInput { input: &row.input, window })
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
