//! An earlier signal of the same machine that inputs are compared with.

use std::fs;
use std::path::{Path, PathBuf};

use super::AnalyzeArguments;
use super::source::{Missing, Source, Unnamed, first_channels, read};
use crate::app::cli::{CliError, Options};
use crate::app::commands::analyze::{EarlierSignal, WindowAnalysis, compare_window};
use crate::app::error::ComputeError;
use crate::formats::{MeasuredSignal, SignalRequest};
use crate::numerics::series::TimeWindow;

/// The signals of `--baseline`, read once for all inputs.
pub(super) struct Baseline {
    path: PathBuf,
    source: Source,
    window: Option<TimeWindow>,
}

impl Baseline {
    /// Reads every channel of the baseline; `None` where none is named. The bearing is that of the inputs.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub(super) fn open(asked: &AnalyzeArguments, options: &Options) -> Result<Option<Self>, CliError> {
        let Some(path) = asked.baseline.clone() else {
            return Ok(None);
        };
        let mut rate = asked.baseline_rate;
        if rate.is_none() && asked.rate.is_some() && !path.is_dir() {
            // what its file says goes before --rate
            let found = read(&path, SignalRequest::default(), Unnamed::Every).map_err(ComputeError::from)?;
            rate = asked.rate.filter(|_| found.missing.contains(&Missing::Rate));
        }
        // a run knows its speed itself
        let of_inputs = asked.speed.clone().filter(|_| !path.is_dir());
        let own = AnalyzeArguments {
            channel: asked.baseline_channel.iter().cloned().collect(),
            window: Vec::new(),
            rate,
            speed: asked.baseline_speed.clone().or(of_inputs),
            ..asked.clone()
        };
        let mut source = Source::open(&own, &path, Unnamed::Every, options)?;
        if asked.baseline_speed.is_none() {
            source.turning.own_first = true;
        }
        Ok(Some(Self { path, source, window: asked.baseline_window }))
    }

    /// What is to be said of its signals, as of those of an input.
    pub(super) fn doubts(&self) -> Vec<String> {
        let name = self.path.display();
        self.source.doubts.iter().map(|text| format!("--baseline {name}: {text}")).collect()
    }

    /// Compares the analysed windows of a signal of an input with the baseline.
    ///
    /// # Errors
    /// [`CliError`]: no such channel in the baseline, another unit, a window outside it.
    pub(super) fn compare(
        &self,
        input: &Path,
        source: &Source,
        signal: &MeasuredSignal,
        windows: &mut [WindowAnalysis],
    ) -> Result<(), CliError> {
        let earlier = self.signal(signal)?;
        let [expected, found] = [signal, earlier].map(|signal| signal.series.unit());
        if !expected.is_empty() && !found.is_empty() && expected != found {
            return Err(CliError::input(format!(
                "--baseline {}, channel \"{}\": expected {expected} as in {}, found {found}",
                self.path.display(),
                earlier.name,
                input.display()
            ))
            .with_help("scale one of the two files to the unit of the other"));
        }
        let kinematics = source.kinematics(input, signal)?;
        let before = self.source.kinematics(&self.path, earlier)?;
        let name = self.path.display().to_string();
        for window in windows {
            let earlier = EarlierSignal {
                name: &name,
                signal: earlier,
                window: self.window(source, earlier, window),
                kinematics: &before,
                settings: &self.source.settings,
            };
            let compared = compare_window(window, &source.settings, signal, &kinematics, &earlier);
            compared.map_err(|error| {
                CliError::input(format!("--baseline {name}, channel \"{}\": {error}", earlier.signal.name))
                    .with_help("see --baseline-window and --baseline-speed for the part of it that counts")
            })?;
            let Some(change) = window.change.as_mut() else {
                continue;
            };
            if expected != found {
                let (of, unit) =
                    if found.is_empty() { (&name, expected) } else { (&input.display().to_string(), found) };
                change.warnings.push(format!(
                    "{of} states no unit and is compared as if it were in {unit}: in g or m/s^2, levels would be 19.8 dB apart."
                ));
            }
            let apart = change.to <= window.from || window.to <= change.from;
            let is_same = self.is(input) && earlier.signal.name == signal.name;
            if is_same && !apart {
                change.warnings.push(format!(
                    "The baseline is the input itself, {name}, and the windows overlap: nothing can have grown since."
                ));
            } else if signal.series.values() == earlier.signal.series.values() {
                change.warnings.push(format!("The baseline {name} has the input's own samples: it is a copy of it."));
            }
        }
        Ok(())
    }

    /// The signal of the same name, else the only one.
    fn signal(&self, signal: &MeasuredSignal) -> Result<&MeasuredSignal, CliError> {
        let signals = &self.source.signals;
        let mut same = signals.iter().filter(|other| other.name == signal.name);
        match (same.next(), signals.as_slice()) {
            (Some(same), _) => Ok(same),
            (None, [only]) => Ok(only),
            (None, others) => {
                let known: Vec<String> = others.iter().map(|other| other.name.clone()).collect();
                Err(CliError::input(format!(
                    "--baseline {}: expected a channel \"{}\", or one channel alone; found {} others",
                    self.path.display(),
                    signal.name,
                    known.len()
                ))
                .with_help(format!("--baseline-channel NAME; the baseline has {}", first_channels(&known))))
            }
        }
    }

    /// `--baseline-window`; else the input's own window, if windows are given and the baseline holds it; else all of it.
    fn window(&self, source: &Source, earlier: &MeasuredSignal, window: &WindowAnalysis) -> TimeWindow {
        let series = &earlier.series;
        let same = TimeWindow { from: window.from, to: window.to };
        let inside = same.check_inside(series.start_s(), series.step_s(), series.values().len()).is_ok();
        let same = Some(same).filter(|_| inside && !source.settings.windows.is_empty());
        self.window.or(same).unwrap_or_else(|| series.span())
    }

    /// Whether an input is the baseline.
    fn is(&self, input: &Path) -> bool {
        fs::canonicalize(input).is_ok_and(|input| fs::canonicalize(&self.path).is_ok_and(|own| input == own))
    }
}

/// Analyses a signal of an input in every window, and compares these with the baseline, if there is one.
///
/// # Errors
/// As [`Source::analyse`] and [`Baseline::compare`].
pub(super) fn analyse(
    baseline: Option<&Baseline>,
    input: &Path,
    source: &Source,
    signal: &MeasuredSignal,
) -> Result<Vec<WindowAnalysis>, CliError> {
    let mut windows = source.analyse(input, signal)?;
    baseline.map_or(Ok(()), |baseline| baseline.compare(input, source, signal, &mut windows))?;
    Ok(windows)
}
