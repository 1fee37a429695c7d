//! Where an axis gets its lines and numbers.

use super::number::{fixed, superscript};

/// A line of the grid, with its number if it has one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// Where, in shown units.
    pub(super) at: f64,
    /// Number beside it; `None` for a fine line.
    pub(super) label: Option<String>,
}

/// Ticks of a linear axis from `low` to `high` (low < high): multiples of 1, 2 or 5 times a power of ten, about
/// `wanted` of them.
pub(super) fn linear(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let rough = (high - low) / wanted.max(1) as f64;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|nice| nice * power)
        .find(|step| *step >= 0.999 * rough)
        .unwrap_or(10.0 * power);
    let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
    let first = (low / step - 1e-9).ceil();
    let last = (high / step + 1e-9).floor();
    let count = (last - first).clamp(-1.0, 1000.0) as i64 + 1;
    (0..count)
        .map(|k| {
            let at = (first + k as f64) * step;
            Tick {
                at,
                label: Some(fixed(at, decimals)),
            }
        })
        .collect()
}

/// Ticks of a logarithmic axis from `low` to `high` (0 < low < high): decades with numbers and fine lines between; 2
/// and 5 numbered too over fewer than three decades; every second or third decade over many. Within less than a
/// decade the ticks of a linear axis.
pub(super) fn log(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let decades = (high / low).log10();
    if decades < 1.0 {
        return linear(low, high, wanted.min(5));
    }
    let first = (low.log10() - 1e-9).floor() as i32;
    let last = (high.log10() + 1e-9).floor() as i32;
    let stride = (decades / wanted.max(1) as f64).ceil().max(1.0) as i32;
    (first..=last)
        .flat_map(|exponent| (1..10).map(move |digit| (exponent, digit)))
        .filter(|(_, digit)| stride == 1 || *digit == 1)
        .map(|(exponent, digit)| {
            let numbered = match digit {
                1 => exponent.rem_euclid(stride) == 0,
                2 | 5 => decades < 3.0,
                _ => false,
            };
            Tick {
                at: f64::from(digit) * 10_f64.powi(exponent),
                label: numbered.then(|| log_label(digit, exponent)),
            }
        })
        .filter(|tick| tick.at >= low * (1.0 - 1e-9) && tick.at <= high * (1.0 + 1e-9))
        .collect()
}

/// A number of a logarithmic axis: plain from 0.001 to 50 000, a power of ten beyond.
fn log_label(digit: i32, exponent: i32) -> String {
    match (digit, exponent) {
        (_, -3..=4) => fixed(
            f64::from(digit) * 10_f64.powi(exponent),
            (-exponent).max(0) as usize,
        ),
        (1, _) => format!("10{}", superscript(exponent)),
        _ => format!("{digit}·10{}", superscript(exponent)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().filter_map(|t| t.label.as_deref()).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(
            labels(&linear(2.2, 2.8, 7)),
            ["2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8"]
        );
        assert_eq!(labels(&linear(-820.0, 810.0, 4)), ["−500", "0", "500"]);
        assert_eq!(
            labels(&linear(0.0, 20_000.0, 4)),
            [
                "0",
                "5000",
                "10\u{202f}000",
                "15\u{202f}000",
                "20\u{202f}000"
            ]
        );
        assert_eq!(
            labels(&linear(2.300_01, 2.300_05, 4)),
            ["2.30001", "2.30002", "2.30003", "2.30004", "2.30005"]
        );
    }

    #[test]
    fn log_ticks_are_decades() {
        assert_eq!(
            labels(&log(0.5, 2e6, 8)),
            ["1", "10", "100", "1000", "10\u{202f}000", "10⁵", "10⁶"]
        );
        assert_eq!(
            labels(&log(0.8, 60.0, 8)),
            ["1", "2", "5", "10", "20", "50"]
        );
        assert_eq!(
            labels(&log(1e-12, 1.0, 6)),
            ["10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "0.01", "1"]
        );
        assert_eq!(labels(&log(3.0, 8.0, 8)), ["3", "4", "5", "6", "7", "8"]);
        let fine = log(1.0, 1e4, 8);
        assert_eq!(fine.len(), 37);
    }
}
