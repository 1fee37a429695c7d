//! `plummer chart`: its examples, parts and budget.

use clap::ValueEnum;
use std::time::Duration;

pub(super) const CHART_EXAMPLE: &str = "\
Examples: which method and step the dented bearing needs; a first look in a fraction of the time
  plummer chart examples/scenes/impact.toml
  plummer chart examples/scenes/smooth.toml --quick
  plummer chart examples/scenes/impact.toml --budget 5min
  plummer chart examples/scenes/impact.toml --only stability

Files:
  chart.json      points, front, the program's choice, omissions with their reasons, horizon, statistics of the ensemble
  chart.svg       error against wall time
  stability.json  method x step x condition: stable, resonant or unstable, with predicted and measured limits
  stability.svg   the same as a map; resonance.svg: a mode in resonance with the step
  report.html     the same to zoom into, and tables

Points are shown as they come, and are in chart.csv.partial until chart.json is there.
Wall times are measured on one thread, one run at a time: run nothing else on the machine meanwhile.";

/// A part of `plummer chart`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ChartPart {
    /// Speed against accuracy
    Accuracy,
    /// Which steps a method can take, under which conditions
    Stability,
}

/// A time with its unit: positive, at most a year.
pub(super) fn budget(text: &str) -> Result<Duration, String> {
    const UNITS: [(&str, f64); 3] = [("min", 60.0), ("h", 3600.0), ("s", 1.0)];
    let read = UNITS.iter().find_map(|(unit, seconds)| {
        let number: f64 = text.trim().strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * seconds).filter(|time| (1.0..=3.2e7).contains(time))
    });
    let read =
        read.ok_or_else(|| format!("expected a time from 1s to 8000h, such as 45s, 2min or 1h, found \"{text}\""));
    read.map(Duration::from_secs_f64)
}
