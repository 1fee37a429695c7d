//! A shaft speed as it is typed: a number or points in time, in Hz or with a unit.

use crate::bearing::{SpeedKnot, SpeedProfile};

/// Units, in small letters, with their part of 1 Hz.
const UNITS: [(&str, f64); 3] = [("hz", 1.0), ("rpm", 1.0 / 60.0), (PER_MINUTE, 1.0 / 60.0)];
/// This unit begins with a digit, so that it needs a blank before it.
const PER_MINUTE: &str = "1/min";
/// Without a unit, a speed above this one may be meant in revolutions per minute, Hz: 30 000 rpm.
const DOUBTFUL_HZ: f64 = 500.0;
const EXPECTED: &str =
    "expected SPEED or T:SPEED,T:SPEED,... (T in s; SPEED in Hz, or 1797rpm, \"1797 1/min\", 29.95Hz)";

/// A shaft speed, and how it was typed.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenSpeed {
    /// Over time.
    pub profile: SpeedProfile,
    /// As typed.
    pub text: String,
    /// The largest speed in Hz, if none has a unit.
    unitless_hz: Option<f64>,
}

impl GivenSpeed {
    /// Reads `29.95`, `29.95Hz`, `1797rpm`, `1797 1/min`, or such speeds over time, `0:600rpm,8:3000rpm`.
    ///
    /// # Errors
    /// What was found and what was expected: no number, another unit, speeds with and without a unit, times that do not increase.
    pub fn parse(text: &str) -> Result<Self, String> {
        let alone = !text.contains([',', ':']);
        let point = |part: &str| match part.split_once(':') {
            Some((time, speed)) => Point::read(Some(time), speed),
            None if alone => Point::read(None, part),
            None => Err(format!("{EXPECTED}, found \"{part}\"")),
        };
        let points = text.split(',').map(point).collect::<Result<Vec<Point>, String>>()?;
        let unitless = points.iter().filter(|point| !point.has_unit).count();
        if unitless > 0 && unitless < points.len() {
            return Err(format!("expected a unit behind every speed or behind none, found \"{text}\""));
        }
        let knots: Vec<SpeedKnot> = points.iter().map(|point| point.knot).collect();
        let speeds = knots.iter().map(|knot| knot.frequency_hz.abs());
        Ok(Self {
            profile: SpeedProfile::new(&knots).map_err(|error| error.to_string())?,
            text: text.to_owned(),
            unitless_hz: (unitless > 0).then(|| speeds.fold(0.0, f64::max)),
        })
    }

    /// What is to be said of a number without a unit that is more likely meant in revolutions per minute.
    #[must_use]
    pub(crate) fn doubt(&self) -> Option<String> {
        let hz = self.unitless_hz.filter(|&hz| hz > DOUBTFUL_HZ)?;
        let text = self.text.trim();
        let over_time = text.contains(':');
        let read = if over_time { "speeds up to " } else { "" };
        let meant: Vec<String> = text.split(',').map(|part| format!("{part}rpm")).collect();
        Some(format!(
            "--speed {text} is read as {read}{hz} Hz ({} rpm): write {} if revolutions per minute were meant",
            thousands(60.0 * hz),
            meant.join(",")
        ))
    }
}

/// A finite number, as an argument gives it.
pub(super) fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|value: &f64| value.is_finite())
}

/// A speed at a time, as typed.
struct Point {
    knot: SpeedKnot,
    has_unit: bool,
}

impl Point {
    fn read(time: Option<&str>, speed: &str) -> Result<Self, String> {
        let found = || match time {
            Some(time) => format!("{EXPECTED}, found \"{time}:{speed}\""),
            None => format!("{EXPECTED}, found \"{speed}\""),
        };
        let time = time.map_or(Some(0.0), number).ok_or_else(found)?;
        let (amount, unit) = unit_of(speed.trim());
        let value = number(amount).ok_or_else(found)?;
        Ok(Self { knot: SpeedKnot { time, frequency_hz: value * unit.unwrap_or(1.0) }, has_unit: unit.is_some() })
    }
}

/// What stands before a unit, and the unit in Hz.
fn unit_of(text: &str) -> (&str, Option<f64>) {
    let ends_with = |unit: &str| {
        let start = text.len().checked_sub(unit.len())?;
        let end = text.get(start..)?;
        let amount = &text[..start];
        let apart = unit != PER_MINUTE || amount.ends_with(char::is_whitespace);
        (apart && end.eq_ignore_ascii_case(unit)).then_some(amount)
    };
    UNITS.iter().find_map(|&(unit, hz)| Some((ends_with(unit)?, Some(hz)))).unwrap_or((text, None))
}

/// A whole number in groups of three digits.
fn thousands(value: f64) -> String {
    let digits = format!("{value:.0}");
    let mut grouped = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place) % 3 == 0 {
            grouped.push(' ');
        }
        grouped.push(digit);
    }
    grouped
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speed at a time, Hz.
    fn hz(text: &str, time: f64) -> f64 {
        GivenSpeed::parse(text).unwrap().profile.speed(time) / std::f64::consts::TAU
    }

    #[test]
    fn a_unit_is_taken_in_any_case_with_or_without_a_blank() {
        for text in ["29.95", "29.95Hz", " 29.95 hz ", "1797rpm", "1797 rpm", "1797RPM", "1797 1/min", "1.797e3 1/MIN"]
        {
            assert!((hz(text, 0.0) - 29.95).abs() < 1e-12, "{text}");
        }
        for text in ["0:600rpm,8:3000rpm", "0: 10Hz , 8:3000 1/min", "0:10,8:50"] {
            for (time, expected) in [(0.0, 10.0), (4.0, 30.0), (9.0, 50.0)] {
                assert!((hz(text, time) - expected).abs() < 1e-12, "{text}");
            }
        }
        assert_eq!(GivenSpeed::parse("1797 rpm").unwrap().text, "1797 rpm");
        // a shaft at rest, or that turns the other way, is for the analysis to judge
        assert!(hz("0", 0.0).abs() < 1e-12);
        assert!((hz("-600rpm", 0.0) + 10.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_speed_is_said() {
        for text in [
            "fast",
            "",
            "nan",
            "NaNrpm",
            "inf Hz",
            "1797 rps",
            "1797 rpm rpm",
            "rpm",
            "29.95 kHz",
            // 1797 or 17971?
            "17971/min",
            "ä",
            "0:10,x",
            "0:10,8",
            "x:10",
            "0:",
            "0:10,",
        ] {
            let message = GivenSpeed::parse(text).unwrap_err();
            assert!(message.starts_with(EXPECTED), "{text}: {message}");
        }
        for (text, message) in [
            ("2:10,1:5", "speed profile row 1: time 1 s must be later than 2 s in the row before"),
            ("0:600rpm,8:3000", "expected a unit behind every speed or behind none, found \"0:600rpm,8:3000\""),
        ] {
            assert_eq!(GivenSpeed::parse(text).unwrap_err(), message);
        }
    }

    #[test]
    fn a_large_number_without_a_unit_is_doubted() {
        let doubt = |text: &str| GivenSpeed::parse(text).unwrap().doubt();
        assert_eq!(
            doubt("1797").unwrap(),
            "--speed 1797 is read as 1797 Hz (107 820 rpm): write 1797rpm if revolutions per minute were meant"
        );
        assert_eq!(
            doubt("0:600,8:3000").unwrap(),
            "--speed 0:600,8:3000 is read as speeds up to 3000 Hz (180 000 rpm): write 0:600rpm,8:3000rpm if revolutions per minute were meant"
        );
        for text in ["500", "1797rpm", "1797Hz", "40000rpm", "0:10,8:50"] {
            assert_eq!(doubt(text), None, "{text}");
        }
        assert!(doubt("-1797").is_some());
    }
}
