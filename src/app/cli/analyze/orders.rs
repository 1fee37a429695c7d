//! Orders of faults as they are typed.
//!
//! A shaft speed as it is typed: a number or points in time, in Hz or with a unit.

use crate::bearing::{SpeedKnot, SpeedProfile};
use crate::signal::diagnosis::FaultOrders;
use std::fmt;

/// Names of the orders, in the order of [`GivenOrders`].
const NAMES: [&str; 4] = ["outer", "inner", "ball", "cage"];
/// The other names.
const OTHER_NAMES: [&str; 4] = ["BPFO", "BPFI", "BSF", "FTF"];
/// What the number of the other name is multiplied by. BSF is the spin of a ball: a flaw on it strikes both races, twice a spin.
const FACTORS: [f64; 4] = [1.0, 1.0, 2.0, 1.0];

/// How near the sum of both races' orders must be to the number of balls, relative: printed orders are rounded.
const WHOLE: f64 = 5e-3;
/// Orders that differ by less, relative, are equal.
const SAME: f64 = 1e-6;
/// Orders that differ by less, relative, are within each other's uncertainty.
const NEAR: f64 = 0.01;
/// How near an order of the ball must be to half or twice the expected one, relative.
const SPIN_TOLERANCE: f64 = 0.03;

/// Orders of outer race, inner race, ball and cage: events per revolution of the shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenOrders(pub [Option<f64>; 4]);

impl GivenOrders {
    /// Reads `outer=3.585,inner=5.415,ball=4.713,cage=0.398` or some of them; or BPFO, BPFI, BSF (half of `ball`) and FTF.
    ///
    /// # Errors
    /// What was found and what was expected: another name, a part that is there twice, a number that is no order.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut orders = [None; 4];
        for part in text.split(',') {
            let found = part.split_once('=').and_then(|(name, order)| {
                let place = |names: [&str; 4]| names.iter().position(|known| known.eq_ignore_ascii_case(name.trim()));
                let own = place(NAMES).map(|place| (place, 1.0));
                let (place, factor) = own.or_else(|| place(OTHER_NAMES).map(|place| (place, FACTORS[place])))?;
                Some((place, factor * number(order)?))
            });
            let Some((place, order)) = found else {
                let comma = if number(part).is_some() { "; the decimal mark is a point" } else { "" };
                return Err(format!(
                    "expected outer=, inner=, ball= or cage=, or BPFO=, BPFI=, BSF= (half of ball) or FTF=, and a number, found \"{part}\"{comma}"
                ));
            };
            if orders[place].replace(order).is_some() {
                return Err(format!("{} ({}) is there twice", NAMES[place], OTHER_NAMES[place]));
            }
        }
        FaultOrders::new(orders, 0.0).map_err(|error| error.to_string())?;
        if let Some([first, second]) = nearest(&orders, SAME) {
            return Err(format!(
                "{} and {} are equal: lines of two parts at one order cannot be told apart",
                NAMES[first], NAMES[second]
            ));
        }
        Ok(Self(orders))
    }

    /// What is to be said of orders that can hardly be a bearing's: two within each other's uncertainty, races that are exchanged, a cage as fast as
    /// half the shaft, races whose sum is no whole
    /// number of balls, an order of the ball that is half or twice what the orders of the races give: the spin was taken for
    /// what strikes, or the other way round. With gamma = (inner - outer) / (inner + outer) it is (1 - gamma^2) / gamma, times the
    /// cosine of the contact angle.
    #[must_use]
    pub(crate) fn doubt(&self) -> Option<String> {
        if let Some([first, second]) = nearest(&self.0, NEAR) {
            return Some(format!(
                "the orders of {} and {} differ by less than {} %: their lines can hardly be told apart",
                NAMES[first],
                NAMES[second],
                100.0 * NEAR
            ));
        }
        let [outer, inner, ball, cage] = self.0;
        if let Some((outer, inner)) = outer.zip(inner)
            && outer > inner
        {
            return Some(format!(
                "BPFO={outer} of --orders is above BPFI={inner}: a ball passes the inner race more often, unless the outer ring turns; are the two exchanged?"
            ));
        }
        if let Some(cage) = cage.filter(|cage| *cage >= 0.5) {
            return Some(format!(
                "FTF={cage} of --orders is half a revolution of the shaft or more: a cage turns more slowly, unless the outer ring turns"
            ));
        }
        let (outer, inner) = outer.zip(inner)?;
        let balls = outer + inner;
        if (balls / balls.round() - 1.0).abs() > WHOLE {
            return Some(format!(
                "BPFO and BPFI of --orders sum up to {balls:.3}, which is no whole number of balls: is one of them wrong?"
            ));
        }
        let ball = ball?;
        let gamma = (inner - outer) / (inner + outer);
        let expected = (1.0 - gamma * gamma) / gamma;
        let is = |part: f64| (ball / (part * expected) - 1.0).abs() < SPIN_TOLERANCE;
        let words = if is(0.5) {
            format!("half of that: write BSF={ball} if the spin of a ball is meant")
        } else if is(2.0) {
            let spin = 0.5 * ball;
            format!("twice that: write ball={spin} if the number after BSF= is not the spin")
        } else {
            return None;
        };
        Some(format!(
            "by the orders of the races a flaw on a ball strikes {expected:.4} times a revolution; --orders has {ball}, {words}"
        ))
    }
}

impl fmt::Display for GivenOrders {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = NAMES.iter().zip(self.0);
        let known = known.filter_map(|(name, order)| Some(format!("{name}={}", order?)));
        to.write_str(&known.collect::<Vec<_>>().join(","))
    }
}

/// The first two orders that differ by less than a part of the larger one.
fn nearest(orders: &[Option<f64>; 4], part: f64) -> Option<[usize; 2]> {
    let pairs = (0..4).flat_map(|first| (first + 1..4).map(move |second| [first, second]));
    pairs.into_iter().find(|&[first, second]| {
        orders[first].zip(orders[second]).is_some_and(|(a, b)| (a - b).abs() <= part * a.max(b))
    })
}

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
        let pointed = text.replacen(',', ".", 1);
        if !text.contains(':') && !alone && Point::read(None, &pointed).is_ok() {
            return Err(format!("{EXPECTED}, found \"{text}\"; the decimal mark is a point: {pointed}"));
        }
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

    #[allow(clippy::float_cmp)] // numbers as typed
    #[test]
    fn both_families_of_names_are_read_and_written_alike() {
        let read = |text: &str| GivenOrders::parse(text).unwrap();
        let all = [Some(3.585), Some(5.415), Some(4.714), Some(0.398)];
        assert_eq!(read("outer=3.585,inner=5.415,ball=4.714,cage=0.398").0, all);
        // the spin is half of what strikes
        let other = read("BPFO=3.585, bpfi=5.415,Bsf = 2.357,FTF=0.398");
        assert_eq!(other.0, all);
        let text = other.to_string();
        assert_eq!(text, "outer=3.585,inner=5.415,ball=4.714,cage=0.398");
        assert_eq!(read(&text), other);
        let some = read("Inner=5.4,OUTER=3.6");
        assert_eq!(some.0, [Some(3.6), Some(5.4), None, None]);
        assert_eq!(some.to_string(), "outer=3.6,inner=5.4");
    }

    #[test]
    fn exchanged_races_and_a_fast_cage_are_doubted() {
        let doubt = |text: &str| GivenOrders::parse(text).unwrap().doubt();
        let exchanged = doubt("BPFO=5.415,BPFI=3.585,FTF=0.398").unwrap();
        assert!(exchanged.contains("are the two exchanged?"), "{exchanged}");
        let fast = doubt("BPFO=3.585,BPFI=5.415,FTF=0.6").unwrap();
        assert!(fast.contains("FTF=0.6 of --orders"), "{fast}");
        assert_eq!(doubt("BPFO=3.585,BPFI=5.415,FTF=0.398"), None);
    }

    #[test]
    fn a_spin_in_the_place_of_what_strikes_is_doubted() {
        let doubt = |text: &str| GivenOrders::parse(text).unwrap().doubt();
        let races = "outer=3.5848,inner=5.4152";
        assert_eq!(
            doubt(&format!("{races},ball=2.357")).unwrap(),
            "by the orders of the races a flaw on a ball strikes 4.7136 times a revolution; --orders has 2.357, half of that: write BSF=2.357 if the spin of a ball is meant"
        );
        assert_eq!(
            doubt(&format!("{races},BSF=4.714")).unwrap(),
            "by the orders of the races a flaw on a ball strikes 4.7136 times a revolution; --orders has 9.428, twice that: write ball=4.714 if the number after BSF= is not the spin"
        );
        for right in ["ball=4.7135", "bsf=2.357", "ball=3.8", "cage=0.4"] {
            assert_eq!(doubt(&format!("{races},{right}")), None, "{right}");
        }
        assert_eq!(doubt("outer=3,inner=4,ball=4.5"), None);
        assert_eq!(
            doubt("outer=3.585,inner=5.145").unwrap(),
            "BPFO and BPFI of --orders sum up to 8.730, which is no whole number of balls: is one of them wrong?"
        );
        assert_eq!(
            doubt("outer=3.585,inner=3.6,ball=4").unwrap(),
            "the orders of outer and inner differ by less than 1 %: their lines can hardly be told apart"
        );
        assert_eq!(doubt("ball=2.357"), None);
    }

    #[test]
    fn what_is_no_order_is_said() {
        let expected = "expected outer=, inner=, ball= or cage=, or BPFO=, BPFI=, BSF= (half of ball) or FTF=, and a number, found";
        for (text, message) in [
            ("outer=3.6,top=1", format!("{expected} \"top=1\"")),
            ("bpfo", format!("{expected} \"bpfo\"")),
            ("bpfo=3,585", format!("{expected} \"585\"; the decimal mark is a point")),
            ("", format!("{expected} \"\"")),
            ("bsf=x", format!("{expected} \"bsf=x\"")),
            ("outer=3.6,BPFO=1", "outer (BPFO) is there twice".to_owned()),
            ("ball=4.714,bsf=2.357", "ball (BSF) is there twice".to_owned()),
            (
                "bpfo=3.585,cage=0.4,inner=3.585",
                "outer and inner are equal: lines of two parts at one order cannot be told apart".to_owned(),
            ),
            ("outer=-1", "order of the outer race: expected a number above 0 and at most 200, found -1".to_owned()),
        ] {
            assert_eq!(GivenOrders::parse(text).unwrap_err(), message);
        }
    }
}

#[cfg(test)]
mod speed_tests {
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
            (
                "29,95Hz",
                "expected SPEED or T:SPEED,T:SPEED,... (T in s; SPEED in Hz, or 1797rpm, \"1797 1/min\", 29.95Hz), found \"29,95Hz\"; the decimal mark is a point: 29.95Hz",
            ),
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
