//! Where an axis gets its lines and numbers.

use super::number::{fixed, significant, superscript};

/// A line of the grid, with its number if it has one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// Where, in shown units.
    pub(super) at: f64,
    /// Number beside it; `None` for a fine line.
    pub(super) label: Option<String>,
}

/// Decimals up to which a number of a linear axis is written out; 15 digits are what its values are good for.
const MOST_DECIMALS: usize = 12;

/// Values of a linear axis below which a number is written out.
const LARGEST_PLAIN: f64 = 1e15;

/// Powers of ten between the numbers of a logarithmic axis beyond which those between get no line.
const LINED: i32 = 10;

/// Ticks of a linear axis from `low` to `high` (low < high): multiples of 1, 2 or 5 times a power of ten, about
/// `wanted` of them; none where a step is no normal number.
pub(super) fn linear(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let wanted = wanted.max(1) as f64;
    // the difference of the largest numbers is none
    let rough = high / wanted - low / wanted;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|nice| nice * power)
        .find(|step| *step >= 0.999 * rough)
        .unwrap_or(10.0 * power);
    if !step.is_normal() {
        return Vec::new();
    }
    let exponent = (step.log10() + 1e-9).floor();
    let first = (low / step - 1e-9).ceil();
    let last = (high / step + 1e-9).floor();
    let count = (last - first).clamp(-1.0, 1000.0) as i64 + 1;
    (0..count)
        .map(|k| {
            let at = (first + k as f64) * step;
            Tick { at, label: Some(linear_label(at, exponent as i32)) }
        })
        .collect()
}

/// A number of a linear axis with steps of the order `10^exponent`.
fn linear_label(at: f64, exponent: i32) -> String {
    let decimals = (-exponent).max(0) as usize;
    if decimals <= MOST_DECIMALS && at.abs() < LARGEST_PLAIN {
        return fixed(at, decimals);
    }
    if at == 0.0 {
        return "0".to_owned();
    }
    let digits = at.abs().log10().floor() as i32 - exponent + 1;
    significant(at, digits.max(1) as usize)
}

/// Ticks of a logarithmic axis from `low` to `high` (0 < low < high): decades with numbers and fine lines between; 2
/// and 5 numbered too over fewer than three decades; every second or third decade over many. Within less than a
/// decade the ticks of a linear axis.
pub(super) fn log(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let decades = high.log10() - low.log10();
    if !decades.is_finite() {
        return Vec::new();
    }
    if decades < 1.0 {
        return linear(low, high, wanted.min(5));
    }
    let first = (low.log10() - 1e-9).floor() as i32;
    let last = (high.log10() + 1e-9).floor() as i32;
    let stride = (decades / wanted.max(1) as f64).ceil().max(1.0) as i32;
    let is_numbered = |exponent: i32| exponent.rem_euclid(stride) == 0;
    (first..=last)
        .filter(|&exponent| stride <= LINED || is_numbered(exponent))
        .flat_map(|exponent| (1..10).map(move |digit| (exponent, digit)))
        .filter(|(_, digit)| stride == 1 || *digit == 1)
        .map(|(exponent, digit)| {
            let numbered = match digit {
                1 => is_numbered(exponent),
                2 | 5 => decades < 3.0,
                _ => false,
            };
            Tick { at: f64::from(digit) * 10_f64.powi(exponent), label: numbered.then(|| log_label(digit, exponent)) }
        })
        .filter(|tick| {
            let at = tick.at;
            at.is_finite() && at >= low * (1.0 - 1e-9) && at <= high * (1.0 + 1e-9)
        })
        .collect()
}

/// A number of a logarithmic axis: plain from 0.001 to 50 000, a power of ten beyond.
fn log_label(digit: i32, exponent: i32) -> String {
    match (digit, exponent) {
        (_, -3..=4) => fixed(f64::from(digit) * 10_f64.powi(exponent), (-exponent).max(0) as usize),
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
        assert_eq!(labels(&linear(2.2, 2.8, 7)), ["2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8"]);
        assert_eq!(labels(&linear(-820.0, 810.0, 4)), ["−500", "0", "500"]);
        assert_eq!(labels(&linear(0.0, 20_000.0, 4)), ["0", "5000", "10\u{202f}000", "15\u{202f}000", "20\u{202f}000"]);
        assert_eq!(labels(&linear(2.300_01, 2.300_05, 4)), ["2.30001", "2.30002", "2.30003", "2.30004", "2.30005"]);
    }

    #[test]
    fn log_ticks_are_decades() {
        assert_eq!(labels(&log(0.5, 2e6, 8)), ["1", "10", "100", "1000", "10\u{202f}000", "10⁵", "10⁶"]);
        assert_eq!(labels(&log(0.8, 60.0, 8)), ["1", "2", "5", "10", "20", "50"]);
        assert_eq!(labels(&log(1e-12, 1.0, 6)), ["10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "0.01", "1"]);
        assert_eq!(labels(&log(3.0, 8.0, 8)), ["3", "4", "5", "6", "7", "8"]);
        let fine = log(1.0, 1e4, 8);
        assert_eq!(fine.len(), 37);
    }

    /// Few ticks with short numbers at the ends of what a number can be.
    #[test]
    fn ticks_stay_few_whatever_the_range() {
        let ranges = [
            (5e-324, 1e-308),
            (1e-308, 2e-308),
            (1e-308, 1.5e-307),
            (1e-308, 1e300),
            (5e-324, f64::MAX),
            (1e300, f64::MAX),
            (1.0, 1.0 + 4e-16),
            (1e300, 1e300 * (1.0 + 1e-13)),
            (1e-300, 1e-300 * (1.0 + 1e-13)),
        ];
        for (low, high) in ranges {
            for wanted in [1, 4, 8] {
                for ticks in [log(low, high, wanted), linear(low, high, wanted)] {
                    // nine lines a decade while every decade has its number
                    assert!(ticks.len() <= 10 * wanted.max(10), "{low:e} {high:e} {}", ticks.len());
                    for tick in ticks {
                        assert!(tick.at.is_finite() && tick.at >= 0.0, "{low:e} {high:e}");
                        let label = tick.label.unwrap_or_default();
                        assert!(label.chars().count() <= 30, "{low:e} {high:e} {label}");
                    }
                }
            }
        }
        for (low, high) in [(-f64::MAX, f64::MAX), (-1e-300, 1e-300), (f64::NAN, 1.0)] {
            let ticks = linear(low, high, 8);
            assert!(ticks.len() <= 20);
            assert!(ticks.iter().all(|tick| tick.label.as_ref().unwrap().chars().count() <= 30));
        }
        assert_eq!(labels(&log(1e-300, 1e300, 4)), ["10⁻³⁰⁰", "10⁻¹⁵⁰", "1", "10¹⁵⁰", "10³⁰⁰"]);
        assert_eq!(labels(&linear(-1e-300, 1e-300, 2)), ["−1·10⁻³⁰⁰", "0", "1·10⁻³⁰⁰"]);
    }
}
