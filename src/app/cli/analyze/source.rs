//! What is analysed, by which orders and speed.
//!
//! Signals of a file, and all that nothing says of them.

use super::AnalyzeArguments;
use super::turning_bearing::{Named, TurningBearing, in_the_plane, named_bearing};
use crate::app::case::{Case, EnvelopeBand, Purpose, ReportDetails};
use crate::app::cli::earlier_results::{Wanted, case_of_results};
use crate::app::cli::output::extend_new;
use crate::app::cli::{CliError, Options};
use crate::app::commands::analyze::{
    AnalysisSettings, AskedBand, DamageShown, OrdersSummary, WindowAnalysis, check_speed, compute_analysis,
    signal_flaws,
};
use crate::app::commands::parts;
use crate::app::error::ComputeError;
use crate::formats::{MeasuredError, MeasuredSignal, SignalRequest, read_signals};
use crate::numerics::Unwatched;
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::report::{Cell, Fact, Section, given, pretty_unit, quantity, shaft_speed};
use crate::signal::diagnosis::Kinematics;
use std::path::Path;

/// The results that a run's signals are taken from.
pub(super) const RUN: Wanted = Wanted { command: "run", arrays: "signals.npz", instead: "a file of signals" };

/// Signals with all that an analysis needs.
pub(super) struct Source {
    pub(super) signals: Vec<MeasuredSignal>,
    pub(super) settings: AnalysisSettings,
    /// The case that says something of it.
    pub(super) case: Option<Case>,
    /// Whether it is a run of that case.
    is_run: bool,
    /// What `--set` says of the report where there is no case.
    details: Option<ReportDetails>,
    /// What is taken for granted, in words.
    pub(super) assumptions: Vec<String>,
    /// Bearings that the signals do not tell apart, what was typed against the file's own words, and what is wrong with the signals.
    pub(super) doubts: Vec<String>,
    /// Named channels that are not there, with the error.
    pub(super) absent: Vec<(String, CliError)>,
    pub(super) turning: TurningBearing,
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
                Some(Named::Case(path)) => Some(in_the_plane(path, options)?),
                Some(Named::Catalogue(_)) | None => None,
            };
            (input.to_owned(), case)
        };
        let details = match &case {
            Some(_) => None,
            None => ReportDetails::of_arguments(&options.set)?,
        };
        let run = Some(input).filter(|_| is_run);
        let turning = TurningBearing::of(asked, run, case.as_ref(), options)?;
        let read = read(&file, request, unnamed).map_err(ComputeError::from)?;
        let mut missing = read.missing;
        if turning.orders.is_none() {
            missing.push(Missing::Bearing);
        }
        if turning.speed_for(read.signals.first()).is_none() {
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
        let settings = settings(asked, case.as_ref().filter(|_| is_run), &turning);
        let mut assumptions = read.left_out;
        let mut doubts = turning.alike.clone();
        for signal in &signals {
            let typed = turning.overruled(signal, asked.rate.map(|rate| (option, rate)));
            let motion = turning.motion(signal);
            let flaws = signal_flaws(
                signal,
                &settings.windows,
                settings.good_to_hz,
                motion.as_ref().map(|(kinematics, _)| kinematics),
            );
            extend_new(&mut doubts, typed.into_iter().chain(flaws).chain(signal.doubts.clone()));
            extend_new(&mut assumptions, motion.into_iter().flat_map(|(_, notes)| notes));
        }
        signals.iter().try_for_each(|signal| below_half_the_rate(asked, input, signal))?;
        Ok(Self { signals, settings, case, is_run, details, assumptions, doubts, absent: read.absent, turning })
    }

    /// The case whose run it is, if it is one.
    pub(super) fn simulated(&self) -> Option<&Case> {
        self.case.as_ref().filter(|_| self.is_run)
    }

    /// What a case, or `--set`, says of the report's head.
    pub(super) fn details(&self) -> Option<&ReportDetails> {
        self.case.as_ref().map_or(self.details.as_ref(), |case| case.report.as_ref())
    }

    /// A row of the inputs for each signal of this file: file, signal, length, rate, unit, mean speed.
    pub(super) fn input_rows(&self, input: &str) -> Vec<[Cell; 6]> {
        let row = |signal: &MeasuredSignal| {
            let (series, motion) = (&signal.series, self.turning.motion(signal));
            [
                Cell::text(input),
                Cell::text(&signal.name),
                Cell::number(series.values().len() as f64 * series.step_s(), 5),
                Cell::number(series.rate_hz(), 6),
                Cell::text(pretty_unit(series.unit())),
                Cell::number_or(motion.map(|(kinematics, _)| kinematics.mean_speed_hz(series.span())), 5, ""),
            ]
        };
        self.signals.iter().map(row).collect()
    }

    /// The signals, and what a case says of the machine, in words.
    pub(super) fn inputs(&self) -> Section {
        let signals = self.signals.iter().map(|signal| {
            let MeasuredSignal { name, series, .. } = signal;
            let unit =
                if series.unit().is_empty() { String::new() } else { format!(" in {}", pretty_unit(series.unit())) };
            let length = given(series.values().len() as f64 * series.step_s());
            let motion = self.turning.motion(signal).filter(|_| !self.is_run);
            let speed = motion.map(|(kinematics, _)| kinematics.mean_speed_hz(series.span()));
            let speed =
                speed.map_or_else(String::new, |hz| format!("; mean shaft speed {}, as given", shaft_speed(hz, 4)));
            let text = format!("{length} s at {}{unit}{speed}", quantity(series.rate_hz(), "Hz"));
            Fact::new(format!("Signal {name}"), text)
        });
        Section::new("Inputs").facts(signals.chain(self.machine_facts()))
    }

    /// What a case or the catalogue says of the machine, in words.
    pub(super) fn machine_facts(&self) -> Vec<Fact> {
        match (&self.case, self.is_run) {
            (Some(case), true) => parts::inputs(case, Purpose::Run, None),
            (Some(case), false) => {
                case.all_bearings().into_iter().map(|(_, bearing)| parts::bearing_fact(bearing)).collect()
            }
            (None, _) => self.turning.catalogue.iter().map(|words| Fact::new("Bearing", words)).collect(),
        }
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
        let motion = self.turning.motion(signal);
        let (kinematics, _) = motion.ok_or_else(|| nothing_says(input, &[Missing::Speed]))?;
        check_speed(signal, &kinematics).map_err(|error| {
            CliError::input(format!("{}, {error}", input.display()))
                .with_help("check --speed and --rate, or what the file says")
        })?;
        Ok(kinematics)
    }
}

/// Refuses a typed band or high-pass that no signal of that sampling rate has.
fn below_half_the_rate(asked: &AnalyzeArguments, input: &Path, signal: &MeasuredSignal) -> Result<(), CliError> {
    let band = asked.band.and_then(|band| match band {
        EnvelopeBand::Between([from, to]) => Some(("--band", format!("{from}:{to}"), to)),
        EnvelopeBand::Kurtogram => None,
    });
    let typed = band.or(asked.high_pass.map(|corner| ("--high-pass", corner.to_string(), corner)));
    let half_hz = 0.5 * signal.series.rate_hz();
    match typed.filter(|(.., highest_hz)| *highest_hz >= half_hz) {
        None => Ok(()),
        Some((option, text, highest_hz)) => Err(CliError::input(format!(
            "{option} {text}: expected frequencies below half the sampling rate of {}, channel \"{}\", which is {half_hz} Hz, found {highest_hz} Hz",
            input.display(),
            signal.name
        ))
        .with_help(format!("lower {option}; is the sampling rate right (--rate)?"))),
    }
}

/// Gives a sensor of a run its unit, which its file does not have.
fn in_acceleration(signal: &mut MeasuredSignal) -> Result<(), ComputeError> {
    let series = &signal.series;
    let values = series.values().to_vec();
    signal.series = TimeSeries::new(series.start_s(), series.step_s(), "m/s^2", values)?;
    Ok(())
}

/// Filter and windows: what was typed, else what the run's case says.
fn settings(asked: &AnalyzeArguments, case: Option<&Case>, turning: &TurningBearing) -> AnalysisSettings {
    let of_case = |case: &Case| match &turning.of_run {
        None => AnalysisSettings::of(case, case.bearing.as_ref(), DamageShown::InPlane),
        Some((label, damage)) => {
            let own = case.seats().into_iter().find(|seat| seat.label == *label);
            AnalysisSettings::of(case, own.and_then(|seat| seat.bearing), *damage)
        }
    };
    let mut settings = case.map(of_case).unwrap_or_default();
    if !asked.window.is_empty() {
        settings.windows = asked.window.clone();
    }
    let typed = asked.high_pass.map(AskedBand::HighPass).or(asked.band.map(AskedBand::from));
    settings.band = typed.or(settings.band);
    settings.whiten |= asked.whiten;
    settings
}

/// Which channels are read where none is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unnamed {
    /// The only one.
    Only,
    /// Every one.
    Every,
}

/// What was read.
#[derive(Debug, Default)]
pub(super) struct Read {
    /// The signals, if nothing is missing; else perhaps one, which the file's own statements can be asked of.
    pub(super) signals: Vec<MeasuredSignal>,
    /// What nothing says, in the order of [`Missing`].
    pub(super) missing: Vec<Missing>,
    /// The reader's own word on what is missing.
    pub(super) first: Option<MeasuredError>,
    /// Arrays that were left out as they are no signals, in words.
    pub(super) left_out: Vec<String>,
    /// Named channels that are not there, with the error; others are.
    absent: Vec<(String, CliError)>,
}

/// Reads signals; what is missing is gathered, with a stand-in in its place, so that all of it can be said at once.
///
/// # Errors
/// [`MeasuredError`] of a file that cannot be read.
pub(super) fn read(path: &Path, mut request: SignalRequest, unnamed: Unnamed) -> Result<Read, MeasuredError> {
    let mut read = Read::default();
    let mut every = false;
    loop {
        match read_signals(path, &request) {
            Ok(signals) => {
                read.signals = signals;
                break;
            }
            Err(error @ MeasuredError::NoTime { .. }) if request.rate_hz.is_none() => {
                read.missing.push(Missing::Rate);
                read.first.get_or_insert(error);
                request.rate_hz = Some(1.0);
            }
            Err(MeasuredError::Choose { known, .. }) if unnamed == Unnamed::Every && !known.is_empty() => {
                every = true;
                for name in known {
                    if request.channels.contains(&name) {
                        let words = format!("{}: a second channel \"{name}\" is left out.", path.display());
                        read.left_out.push(words);
                    } else {
                        request.channels.push(name);
                    }
                }
            }
            Err(MeasuredError::Choose { path, known }) if !known.is_empty() => {
                request.channels.push(known[0].clone());
                read.missing.insert(0, Missing::Channel { known: known.clone() });
                read.first.get_or_insert(MeasuredError::Choose { path, known });
            }
            Err(MeasuredError::Array { name, found, .. }) if every && request.channels.len() > 1 => {
                request.channels.retain(|channel| *channel != name);
                let words = format!("{}: array \"{name}\" is left out: it is no signal ({found}).", path.display());
                read.left_out.push(words);
            }
            // of several files each may have some of the named channels
            Err(MeasuredError::NoChannel { path, wanted, known })
                if unnamed == Unnamed::Every && request.channels.len() > 1 =>
            {
                request.channels.retain(|channel| *channel != wanted);
                let error = ComputeError::from(MeasuredError::NoChannel { path, wanted: wanted.clone(), known });
                read.absent.push((wanted, error.into()));
            }
            // the stand-in's fault
            Err(_) if !read.missing.is_empty() => break,
            Err(error) => return Err(error),
        }
    }
    Ok(read)
}

/// Most channels that are listed.
const LISTED: usize = 20;

/// What an analysis needs and nothing says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Missing {
    /// Which of these channels is meant.
    Channel {
        /// Channels of the file.
        known: Vec<String>,
    },
    /// How fast the signal was sampled.
    Rate,
    /// How often parts strike.
    Bearing,
    /// How fast the shaft turns.
    Speed,
}

impl Missing {
    /// What it is, and what to type.
    fn what_and_help(&self) -> (&'static str, String) {
        let (what, help) = match self {
            Self::Channel { known } => {
                let more = if known.len() > LISTED { ", ..." } else { "" };
                let help = format!("--channel NAME (repeatable), of {}{more}", first_channels(known));
                return ("which channel is meant", help);
            }
            Self::Rate => ("how fast it was sampled", "--rate HZ, the sampling rate"),
            Self::Bearing => (
                "which bearing it is",
                "--bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)",
            ),
            Self::Speed => {
                ("how fast the shaft turns", "--speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...")
            }
        };
        (what, help.to_owned())
    }
}

/// The error of an input of which something is missing, with what to type for each.
pub(super) fn nothing_says(input: &Path, missing: &[Missing]) -> CliError {
    let (words, help): (Vec<&str>, Vec<String>) = missing.iter().map(Missing::what_and_help).unzip();
    let listed = match words.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    };
    CliError::input(format!("{}: nothing says {listed}", input.display())).with_help(help.join("\n"))
}

/// The first channels by name, in quotation marks.
pub(super) fn first_channels(known: &[String]) -> String {
    let quoted: Vec<String> = known.iter().take(LISTED).map(|name| format!("\"{name}\"")).collect();
    quoted.join(", ")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{Missing, nothing_says};

    fn lines(missing: &[Missing]) -> String {
        let error = nothing_says(Path::new("out/a"), missing);
        assert_eq!(error.exit_code(), 2);
        let mut lines = Vec::new();
        error.report(&mut lines);
        String::from_utf8(lines).unwrap()
    }

    #[test]
    fn all_that_is_missing_is_said_at_once() {
        let channel = Missing::Channel { known: vec!["P1".to_owned(), "P2".to_owned()] };
        assert_eq!(
            lines(&[channel, Missing::Rate, Missing::Speed]),
            "error: out/a: nothing says which channel is meant, how fast it was sampled and how fast the shaft turns\n\
             help: --channel NAME (repeatable), of \"P1\", \"P2\"\n\
             help: --rate HZ, the sampling rate\n\
             help: --speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...\n",
        );
        assert_eq!(
            lines(&[Missing::Bearing]),
            "error: out/a: nothing says which bearing it is\n\
             help: --bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)\n",
        );
    }
}
