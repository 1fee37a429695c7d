//! What is analysed, by which orders and speed.

use std::path::{Path, PathBuf};

use super::AnalyzeArguments;
use super::bearing::{Named, named_bearing};
use super::machine::Machine;
use super::read::{Missing, Unnamed, nothing_says, read};
use crate::app::case::Case;
use crate::app::cli::earlier_results::{Wanted, case_of_results};
use crate::app::cli::output::extend_new;
use crate::app::cli::{CliError, Options};
use crate::app::commands::analyze::{AnalysisSettings, AskedBand, OrdersSummary, WindowAnalysis, compute_analysis};
use crate::app::error::ComputeError;
use crate::formats::{MeasuredSignal, SignalRequest};
use crate::numerics::Unwatched;
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::report::significant;
use crate::signal::diagnosis::Kinematics;

/// The results that a run's signals are taken from.
const RUN: Wanted = Wanted { command: "run", arrays: "signals.npz", instead: "a file of signals" };

/// Signals with all that an analysis needs.
pub(super) struct Source {
    pub(super) signals: Vec<MeasuredSignal>,
    pub(super) settings: AnalysisSettings,
    /// The case that says something of it.
    pub(super) case: Option<PathBuf>,
    /// What is taken for granted, in words.
    pub(super) assumptions: Vec<String>,
    /// What was typed against the file's own words, and what is wrong with the signals.
    pub(super) doubts: Vec<String>,
    pub(super) machine: Machine,
}

impl Source {
    /// Reads what is asked for of a file or of a run's folder.
    ///
    /// # Errors
    /// [`CliError`]: a file that cannot be read; all that nothing says, at once.
    pub(super) fn open(
        asked: &AnalyzeArguments,
        input: &Path,
        unnamed: Unnamed,
        options: &Options,
    ) -> Result<Self, CliError> {
        let is_run = input.is_dir();
        let mut request = SignalRequest { channels: Vec::new(), rate_hz: asked.rate };
        extend_new(&mut request.channels, asked.channel.iter().cloned());
        let (file, case) = if is_run {
            let case = case_of_results(input, RUN, &options.set)?;
            if request.channels.is_empty() {
                let sensors = case.sensors.iter();
                request.channels = sensors.map(|sensor| sensor.name.clone()).collect();
            }
            (input.join(RUN.arrays), Some(case))
        } else {
            let case = match named_bearing(asked)? {
                Some(Named::Case(path)) => Some(Case::load(path, &options.set)?),
                Some(Named::Catalogue(_)) | None => None,
            };
            (input.to_owned(), case)
        };
        let machine = Machine::of(asked, is_run, case.as_ref(), options)?;
        let read = read(&file, request, unnamed).map_err(ComputeError::from)?;
        let mut missing = read.missing;
        if machine.orders.is_none() {
            missing.push(Missing::Bearing);
        }
        if machine.speed_for(read.signals.first()).is_none() {
            missing.push(Missing::Speed);
        }
        match (read.first, missing.as_slice()) {
            (_, []) => {}
            (Some(alone), [_]) => return Err(ComputeError::from(alone).into()),
            _ => return Err(nothing_says(input, &missing)),
        }
        let mut signals = read.signals;
        if let Some(case) = case.as_ref().filter(|_| is_run) {
            for signal in &mut signals {
                if case.sensors.iter().any(|sensor| sensor.name == signal.name) {
                    in_acceleration(signal)?;
                }
            }
        }
        let of_baseline = asked.baseline_rate.is_some() && asked.baseline.as_deref() == Some(input);
        let option = if of_baseline { "--baseline-rate" } else { "--rate" };
        let settings = settings(asked, case.as_ref().filter(|_| is_run));
        let mut assumptions = read.left_out;
        let mut doubts = Vec::new();
        for signal in &signals {
            let typed = machine.overruled(signal, asked.rate.map(|rate| (option, rate)));
            extend_new(&mut doubts, typed.into_iter().chain(flaws(signal, &settings.windows)));
            extend_new(&mut assumptions, machine.motion(signal).into_iter().flat_map(|(_, notes)| notes));
        }
        Ok(Self { signals, settings, case: case.map(|case| case.source.path), assumptions, doubts, machine })
    }

    /// Analyses one of the signals in every window.
    ///
    /// # Errors
    /// [`CliError`]: a signal of this file without a speed, where another states one; as [`compute_analysis`].
    pub(super) fn analyse(&self, input: &Path, signal: &MeasuredSignal) -> Result<Vec<WindowAnalysis>, CliError> {
        let kinematics = self.kinematics(input, signal)?;
        Ok(compute_analysis(std::slice::from_ref(signal), &self.settings, &kinematics, &Unwatched)?)
    }

    /// Orders in a window of the first signal, as results have them.
    ///
    /// # Errors
    /// As [`analyse`](Self::analyse).
    pub(super) fn defect_orders(
        &self,
        input: &Path,
        window: Option<&WindowAnalysis>,
    ) -> Result<OrdersSummary, CliError> {
        let Some((signal, &WindowAnalysis { from, to, .. })) = self.signals.first().zip(window) else {
            return Ok(OrdersSummary::of(None));
        };
        let orders = self.kinematics(input, signal)?.orders(TimeWindow { from, to });
        Ok(OrdersSummary::of(Some(orders.map_err(ComputeError::from)?)))
    }

    /// How the machine of a signal of this file moves.
    ///
    /// # Errors
    /// [`CliError`]: a signal without a speed, where another states one; a shaft that turns more than once in two samples.
    pub(super) fn kinematics(&self, input: &Path, signal: &MeasuredSignal) -> Result<Kinematics<'_>, CliError> {
        let motion = self.machine.motion(signal);
        let (kinematics, _) = motion.ok_or_else(|| nothing_says(input, &[Missing::Speed]))?;
        let (series, speed_hz) = (&signal.series, kinematics.mean_speed_hz(signal.series.span()));
        if speed_hz.is_nan() || speed_hz >= 0.5 * series.rate_hz() {
            return Err(CliError::input(format!(
                "{}, channel \"{}\": expected a shaft speed below half of the sampling rate, {:e} Hz, found {speed_hz:e} Hz",
                input.display(),
                signal.name,
                series.rate_hz()
            ))
            .with_help("check --speed and --rate, or what the file says"));
        }
        Ok(kinematics)
    }
}

/// Gives a sensor of a run its unit, which its file does not have.
fn in_acceleration(signal: &mut MeasuredSignal) -> Result<(), ComputeError> {
    let series = &signal.series;
    let values = series.values().to_vec();
    signal.series = TimeSeries::new(series.start_s(), series.step_s(), "m/s^2", values)?;
    Ok(())
}

/// Share of clipped samples that is said: fewer are a spike or two.
const CLIPPED: f64 = 1e-3;
/// Share of a signal that may stand still, and fewest equal samples in a row that are said.
const STILL: f64 = 0.01;
const STILL_SAMPLES: f64 = 100.0;

/// What a sensor or a converter did to a signal that is not constant.
fn flaws(signal: &MeasuredSignal, windows: &[TimeWindow]) -> Vec<String> {
    let all = [signal.series.span()];
    let windows = if windows.is_empty() { &all } else { windows };
    // a window outside the signal is named where it is analysed
    let parts = windows.iter().filter_map(|window| signal.series.window(window.from, window.to).ok());
    parts.flat_map(|part| flaws_of(&signal.name, &part)).collect()
}

fn flaws_of(name: &str, series: &TimeSeries) -> Vec<String> {
    let samples = series.values().len() as f64;
    let mut said = Vec::new();
    let clipped = series.clipped_share();
    if clipped >= CLIPPED {
        said.push(format!(
            "{name}: {} % of the samples stand at the end of a range: clipping makes lines and hides others",
            significant(100.0 * clipped, 2)
        ));
    }
    let still = series.longest_still();
    let count = ((still.to - still.from) / series.step_s()).round();
    if count >= STILL_SAMPLES.max(STILL * samples) && count < samples {
        said.push(format!(
            "{name}: nothing changes from {} to {} s: analyse the rest with --window",
            significant(still.from, 5),
            significant(still.to, 5)
        ));
    }
    said
}

/// Filter and windows: what was typed, else what the run's case says.
fn settings(asked: &AnalyzeArguments, case: Option<&Case>) -> AnalysisSettings {
    let mut settings = case.map(AnalysisSettings::of).unwrap_or_default();
    if !asked.window.is_empty() {
        settings.windows = asked.window.clone();
    }
    let typed = asked.high_pass.map(AskedBand::HighPass).or(asked.band.map(AskedBand::from));
    settings.band = typed.or(settings.band);
    settings.whiten |= asked.whiten;
    settings
}
