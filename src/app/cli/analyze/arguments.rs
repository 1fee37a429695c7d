//! What `plummer analyze` takes.

use super::orders::number;
use std::path::PathBuf;

use clap::Args;

use super::{GivenOrders, GivenSpeed};
use crate::app::case::EnvelopeBand;
use crate::numerics::series::TimeWindow;

/// A signal, a bearing, a speed, and what is to be looked at.
#[derive(Debug, Clone, Args)]
pub struct AnalyzeArguments {
    /// Folders with results of `plummer run`, or files of signals: .npz, .mat, .csv, .txt, .tsv, .asc, .lvm, .wav, .uff, .unv
    #[arg(value_name = "DIR|FILE", required = true)]
    pub inputs: Vec<PathBuf>,
    /// Signal to analyse, by name; can be repeated (default: the only one, a folder's sensors, or all channels of several files)
    #[arg(long, value_name = "NAME")]
    pub channel: Vec<String>,
    /// Sampling rate in Hz, instead of the file's
    #[arg(long, allow_hyphen_values = true, value_name = "HZ", value_parser = positive)]
    pub rate: Option<f64>,
    /// Case file with bearing and shaft speed (--speed replaces that speed), or a bearing of the catalogue, as 6205: plummer init
    /// --list-bearings. A file of that name comes first. Of a run with several bearings, the label of one
    #[arg(long, value_name = "CASE.toml|NAME")]
    pub bearing: Option<PathBuf>,
    /// Number of balls, with --pitch-diameter and --ball-diameter
    #[arg(long, allow_hyphen_values = true, value_name = "N", requires_all = ["pitch_diameter", "ball_diameter"], conflicts_with = "bearing")]
    pub balls: Option<u32>,
    /// Diameter of the circle of the balls' centres, in the unit of --ball-diameter
    #[arg(long, allow_hyphen_values = true, value_name = "D", value_parser = positive, requires = "balls")]
    pub pitch_diameter: Option<f64>,
    /// Diameter of a ball
    #[arg(long, allow_hyphen_values = true, value_name = "D", value_parser = positive, requires = "balls")]
    pub ball_diameter: Option<f64>,
    /// Contact angle in degrees, 0 to below 90, of --balls or of a bearing of the catalogue (default: 0). A case has its own
    #[arg(long, allow_hyphen_values = true, value_name = "DEG", value_parser = contact_angle, conflicts_with = "orders")]
    pub contact_angle: Option<f64>,
    /// Events per revolution of the shaft: some of outer=3.58,inner=5.42,ball=4.71,cage=0.398, or of BPFO, BPFI, BSF and FTF.
    /// BSF is the spin of a ball. A flaw on the ball strikes twice a spin: ball = 2 x BSF
    #[arg(long, allow_hyphen_values = true, value_name = "NAME=ORDER,...", value_parser = GivenOrders::parse, conflicts_with_all = ["bearing", "balls"])]
    pub orders: Option<GivenOrders>,
    /// Shaft speed: 29.95Hz, 1797rpm, "1797 1/min" or 29.95 in Hz; over time 0:600rpm,8:3000rpm, T in s, with straight lines between
    #[arg(long, allow_hyphen_values = true, value_name = "SPEED|T:SPEED,...", value_parser = GivenSpeed::parse)]
    pub speed: Option<GivenSpeed>,
    /// Window of time in s; can be repeated (default: the case's windows, or the whole signal)
    #[arg(long, allow_hyphen_values = true, value_name = "FROM:TO", value_parser = window)]
    pub window: Vec<TimeWindow>,
    /// Corner of the high-pass before the envelope in Hz (default: the case's; else 5000, but at most an eighth of the
    /// sampling rate)
    #[arg(long, allow_hyphen_values = true, value_name = "HZ", value_parser = positive)]
    pub high_pass: Option<f64>,
    /// Band before the envelope in Hz, where the housing rings, instead of --high-pass. `kurtogram` takes the most impulsive band
    /// of each window; where noise may be as impulsive, it takes the high-pass
    #[arg(long, allow_hyphen_values = true, value_name = "FROM:TO|kurtogram", value_parser = band, conflicts_with = "high_pass")]
    pub band: Option<EnvelopeBand>,
    /// Show the spectrum of the whitened signal's squared envelope; verdicts look at both anyway
    #[arg(long)]
    pub whiten: bool,
    /// How far orders may be off by contact angle, slip and speed, relative, 0 to 0.1 (default: 0.01; of a simulated bearing 0)
    #[arg(long, allow_hyphen_values = true, value_name = "PART")]
    pub geometry_error: Option<f64>,
    /// Earlier signal of the same machine, sensor, place and gain, with which the signal is compared
    #[arg(long, value_name = "DIR|FILE")]
    pub baseline: Option<PathBuf>,
    /// Shaft speed in the baseline, as --speed (default: what its file or its run says; else --speed)
    #[arg(long, allow_hyphen_values = true, value_name = "SPEED|T:SPEED,...", value_parser = GivenSpeed::parse, requires = "baseline")]
    pub baseline_speed: Option<GivenSpeed>,
    /// Channel of the baseline (default: the one of the same name, else the only one)
    #[arg(long, value_name = "NAME", requires = "baseline")]
    pub baseline_channel: Option<String>,
    /// Sampling rate of the baseline in Hz (default: what its file says, else --rate)
    #[arg(long, allow_hyphen_values = true, value_name = "HZ", value_parser = positive, requires = "baseline")]
    pub baseline_rate: Option<f64>,
    /// Window of the baseline in s (default: the input's window if one is given and the baseline holds it; else all of it)
    #[arg(long, allow_hyphen_values = true, value_name = "FROM:TO", value_parser = window, requires = "baseline")]
    pub baseline_window: Option<TimeWindow>,
}

/// Relative error of orders from which on lines of parts cover each other: of CWRU record 130 (6205, outer race) a tenth names the ball, 0.01 the race.
const WIDE: f64 = 0.03;

impl AnalyzeArguments {
    /// What is read as it was typed, and more likely meant in another way.
    pub(super) fn doubts(&self) -> Vec<String> {
        let speeds = [self.speed.as_ref(), self.baseline_speed.as_ref()];
        let speed = speeds.into_iter().flatten().filter_map(GivenSpeed::doubt);
        let orders = self.orders.as_ref().and_then(GivenOrders::doubt);
        // more than a tenth is refused
        let wide = self.geometry_error.filter(|error| (WIDE..=0.1).contains(error));
        let wide = wide.map(|error| {
            format!(
                "--geometry-error {error}: lines of different parts lie within {} % of each other, and a sound part may be named by the damaged one's. Give the bearing's own geometry.",
                100.0 * error
            )
        });
        speed.chain(orders).chain(wide).collect()
    }
}

fn positive(text: &str) -> Result<f64, String> {
    number(text).filter(|&value| value > 0.0).ok_or_else(|| format!("expected a number above 0, found \"{text}\""))
}

fn contact_angle(text: &str) -> Result<f64, String> {
    let degrees = number(text).filter(|value| (0.0..90.0).contains(value));
    degrees.ok_or_else(|| format!("expected a number of degrees from 0 to below 90, found \"{text}\""))
}

fn pair(text: &str) -> Option<[f64; 2]> {
    let (first, second) = text.split_once(':')?;
    Some([number(first)?, number(second)?])
}

fn window(text: &str) -> Result<TimeWindow, String> {
    match pair(text) {
        Some([from, to]) if from < to => Ok(TimeWindow { from, to }),
        _ => Err(format!("expected FROM:TO in s, FROM below TO, found \"{text}\"")),
    }
}

fn band(text: &str) -> Result<EnvelopeBand, String> {
    match pair(text) {
        Some([from, to]) if 0.0 < from && from < to => Ok(EnvelopeBand::Between([from, to])),
        None if text.trim() == "kurtogram" => Ok(EnvelopeBand::Kurtogram),
        _ => Err(format!("expected FROM:TO in Hz, 0 < FROM < TO, or kurtogram, found \"{text}\"")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[allow(clippy::float_cmp)] // numbers as typed
    #[test]
    fn pairs_of_numbers_are_read() {
        let read = window("2.2:2.8").unwrap();
        assert_eq!([read.from, read.to], [2.2, 2.8]);
        let between = EnvelopeBand::Between([500.0, 2e4]);
        assert_eq!(band("500:2e4").unwrap(), between);
        assert_eq!(band("kurtogram").unwrap(), EnvelopeBand::Kurtogram);
        for (message, expected) in [
            (window("2.8:2.2").unwrap_err(), "expected FROM:TO in s, FROM below TO, found \"2.8:2.2\""),
            (band("0:5").unwrap_err(), "expected FROM:TO in Hz, 0 < FROM < TO, or kurtogram, found \"0:5\""),
            (positive("nan").unwrap_err(), "expected a number above 0, found \"nan\""),
            (contact_angle("90").unwrap_err(), "expected a number of degrees from 0 to below 90, found \"90\""),
            (contact_angle("-1").unwrap_err(), "expected a number of degrees from 0 to below 90, found \"-1\""),
        ] {
            assert_eq!(message, expected);
        }
    }
}
