//! An earlier signal of the same machine that inputs are compared with.

use std::path::{Path, PathBuf};

use super::AnalyzeArguments;
use super::source::{Missing, Source, Unnamed, first_channels, read};
use crate::app::cli::{CliError, Options};
use crate::app::commands::analyze::{EarlierSignal, WindowAnalysis, compare_windows};
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
        let kinematics = source.kinematics(input, signal)?;
        let before = self.source.kinematics(&self.path, earlier)?;
        let name = self.path.display().to_string();
        let earlier = EarlierSignal {
            name: &name,
            signal: earlier,
            window: self.window,
            kinematics: &before,
            settings: &self.source.settings,
        };
        compare_windows(windows, &source.settings, signal, &kinematics, &earlier).map_err(|error| {
            let help = error.help();
            let help = help.unwrap_or_else(|| {
                "see --baseline-window and --baseline-speed for the part of it that counts".to_owned()
            });
            CliError::input(format!("--baseline {name}, channel \"{}\": {error}", earlier.signal.name)).with_help(help)
        })
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
