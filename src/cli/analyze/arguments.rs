//! What `plummer analyze` takes.

use std::fmt;
use std::path::PathBuf;

use clap::Args;

use crate::bearing::{SpeedKnot, SpeedProfile};
use crate::case::EnvelopeBand;
use crate::diagnosis::FaultOrders;
use crate::series::TimeWindow;

/// A signal, a bearing, a speed, and what is to be looked at.
#[derive(Debug, Clone, Args)]
pub struct AnalyzeArguments {
    /// Folder with results of `plummer run`, or a file of signals: .npz, .csv, .txt, .wav, .uff, .unv
    #[arg(value_name = "DIR|FILE")]
    pub input: PathBuf,
    /// Signal to analyse, by name; can be repeated (default: the only one; of a folder every sensor)
    #[arg(long, value_name = "NAME")]
    pub channel: Vec<String>,
    /// Sampling rate in Hz, in the place of what the file says
    #[arg(long, value_name = "HZ", value_parser = positive)]
    pub rate: Option<f64>,
    /// Case file whose bearing it is (without --speed the shaft turns as it says), or a bearing of the catalogue: 6205 (plummer
    /// init --list-bearings); a file of that name goes first
    #[arg(long, value_name = "CASE.toml|NAME")]
    pub bearing: Option<PathBuf>,
    /// Number of balls, with --pitch-diameter and --ball-diameter
    #[arg(long, value_name = "N", requires_all = ["pitch_diameter", "ball_diameter"], conflicts_with = "bearing")]
    pub balls: Option<u32>,
    /// Diameter of the circle of the balls' centres, in the unit of --ball-diameter
    #[arg(long, value_name = "D", value_parser = positive, requires = "balls")]
    pub pitch_diameter: Option<f64>,
    /// Diameter of a ball
    #[arg(long, value_name = "D", value_parser = positive, requires = "balls")]
    pub ball_diameter: Option<f64>,
    /// Contact angle in degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0, requires = "balls")]
    pub contact_angle: f64,
    /// Events per shaft turn, as catalogues have them: outer=3.58,inner=5.42,ball=4.71,cage=0.398 or some of them; ball: both races, twice the spin
    #[arg(long, value_name = "NAME=ORDER,...", value_parser = orders, conflicts_with_all = ["bearing", "balls"])]
    pub orders: Option<GivenOrders>,
    /// Shaft speed: HZ, or T:HZ,T:HZ,... with straight lines between (s, Hz)
    #[arg(long, value_name = "HZ|T:HZ,...", value_parser = speed)]
    pub speed: Option<GivenSpeed>,
    /// Stretch of time in s; can be repeated (default: the case's windows, or the whole signal)
    #[arg(long, value_name = "FROM:TO", value_parser = window)]
    pub window: Vec<TimeWindow>,
    /// Corner of the high-pass before the envelope in Hz (default: the case's; else 5000, or an eighth of the sampling rate if
    /// that is lower)
    #[arg(long, value_name = "HZ", value_parser = positive)]
    pub high_pass: Option<f64>,
    /// Band before the envelope in Hz, in the place of --high-pass: where the housing rings; or `kurtogram`: the most impulsive
    /// band of each window, and the high-pass where noise may be as impulsive
    #[arg(long, value_name = "FROM:TO|kurtogram", value_parser = band, conflicts_with = "high_pass")]
    pub band: Option<EnvelopeBand>,
    /// Show the spectrum of the whitened signal's squared envelope; verdicts look at both anyway
    #[arg(long)]
    pub whiten: bool,
    /// Relative error of the orders, 0 to 0.1: contact angle, slip, speed (default: 0.01; of a simulated bearing 0)
    #[arg(long, value_name = "PART")]
    pub geometry_error: Option<f64>,
}

/// Orders of outer race, inner race, ball and cage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenOrders(pub [Option<f64>; 4]);

impl fmt::Display for GivenOrders {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = NAMES.iter().zip(self.0);
        let known = known.filter_map(|(name, order)| Some(format!("{name}={}", order?)));
        to.write_str(&known.collect::<Vec<_>>().join(","))
    }
}

/// A shaft speed, and how it was typed.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenSpeed {
    /// Over time.
    pub profile: SpeedProfile,
    /// As typed.
    pub text: String,
}

/// Names of the orders, in the order of [`GivenOrders`].
const NAMES: [&str; 4] = ["outer", "inner", "ball", "cage"];

fn number(text: &str) -> Option<f64> {
    text.trim()
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite())
}

fn positive(text: &str) -> Result<f64, String> {
    number(text)
        .filter(|&value| value > 0.0)
        .ok_or_else(|| format!("expected a number above 0, found \"{text}\""))
}

fn pair(text: &str) -> Option<[f64; 2]> {
    let (first, second) = text.split_once(':')?;
    Some([number(first)?, number(second)?])
}

fn window(text: &str) -> Result<TimeWindow, String> {
    match pair(text) {
        Some([from, to]) if from < to => Ok(TimeWindow { from, to }),
        _ => Err(format!(
            "expected FROM:TO in s, FROM below TO, found \"{text}\""
        )),
    }
}

fn band(text: &str) -> Result<EnvelopeBand, String> {
    match pair(text) {
        Some([from, to]) if 0.0 < from && from < to => Ok(EnvelopeBand::Between([from, to])),
        None if text.trim() == "kurtogram" => Ok(EnvelopeBand::Kurtogram),
        _ => Err(format!(
            "expected FROM:TO in Hz, 0 < FROM < TO, or kurtogram, found \"{text}\""
        )),
    }
}

fn speed(text: &str) -> Result<GivenSpeed, String> {
    let given = |profile: SpeedProfile| GivenSpeed {
        profile,
        text: text.to_owned(),
    };
    if let Some(hz) = number(text) {
        let constant = SpeedProfile::constant(hz);
        return constant.map(given).map_err(|error| error.to_string());
    }
    let knot = |part: &str| {
        let [time, frequency_hz] = pair(part)
            .ok_or_else(|| format!("expected HZ or T:HZ,T:HZ,... (s, Hz), found \"{part}\""))?;
        Ok(SpeedKnot { time, frequency_hz })
    };
    let knots: Result<Vec<SpeedKnot>, String> = text.split(',').map(knot).collect();
    let profile = SpeedProfile::new(&knots?);
    profile.map(given).map_err(|error| error.to_string())
}

fn orders(text: &str) -> Result<GivenOrders, String> {
    let mut orders = [None; 4];
    for part in text.split(',') {
        let found = part.split_once('=').and_then(|(name, order)| {
            let place = NAMES.iter().position(|known| *known == name.trim())?;
            Some((place, number(order)?))
        });
        let Some((place, order)) = found else {
            return Err(format!(
                "expected outer=, inner=, ball= or cage= and a number, found \"{part}\""
            ));
        };
        if orders[place].replace(order).is_some() {
            return Err(format!("{} is there twice", NAMES[place]));
        }
    }
    FaultOrders::new(orders, 0.0).map_err(|error| error.to_string())?;
    Ok(GivenOrders(orders))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[allow(clippy::float_cmp)] // numbers as typed
    #[test]
    fn pairs_orders_and_speeds_are_read() {
        let read = window("2.2:2.8").unwrap();
        assert_eq!([read.from, read.to], [2.2, 2.8]);
        let between = EnvelopeBand::Between([500.0, 2e4]);
        assert_eq!(band("500:2e4").unwrap(), between);
        assert_eq!(band("kurtogram").unwrap(), EnvelopeBand::Kurtogram);
        assert_eq!(
            orders("inner=5.4,outer=3.6").unwrap().0,
            [Some(3.6), Some(5.4), None, None]
        );
        let run_up = speed("0:10,2:30").unwrap();
        let turns = run_up.profile.angle(2.0) / std::f64::consts::TAU;
        assert!((turns - 40.0).abs() < 1e-9, "{turns}");
        assert_eq!(run_up.text, "0:10,2:30");
        assert_eq!(
            orders("inner=5.4,outer=3.6").unwrap().to_string(),
            "outer=3.6,inner=5.4"
        );
        assert!(speed("25").is_ok());
        for (message, expected) in [
            (
                window("2.8:2.2").unwrap_err(),
                "expected FROM:TO in s, FROM below TO, found \"2.8:2.2\"",
            ),
            (
                band("0:5").unwrap_err(),
                "expected FROM:TO in Hz, 0 < FROM < TO, or kurtogram, found \"0:5\"",
            ),
            (
                orders("outer=3.6,top=1").unwrap_err(),
                "expected outer=, inner=, ball= or cage= and a number, found \"top=1\"",
            ),
            (
                orders("outer=3.6,outer=1").unwrap_err(),
                "outer is there twice",
            ),
            (
                orders("outer=-1").unwrap_err(),
                "order of the outer race: expected a number above 0 and at most 200, found -1",
            ),
            (
                speed("0:10,x").unwrap_err(),
                "expected HZ or T:HZ,T:HZ,... (s, Hz), found \"x\"",
            ),
            (
                speed("2:10,1:5").unwrap_err(),
                "speed profile row 1: time 1 s must be later than 2 s in the row before",
            ),
            (
                positive("nan").unwrap_err(),
                "expected a number above 0, found \"nan\"",
            ),
        ] {
            assert_eq!(message, expected);
        }
    }
}
