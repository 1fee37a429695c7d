//! Numbers and units as an engineer reads them.

/// Space between groups of three digits: narrow and not broken over lines (ISO 80000-1, 7.3.1).
const GROUP: char = '\u{202f}';

/// The number with so many significant digits (1 to 17; others are moved there), groups of three digits from 10 000
/// on, and a power of ten outside 0.001 .. 1 000 000. A true minus sign; "–" for what is not a number.
///
/// ```
/// use plummer::report::significant;
/// assert_eq!(significant(0.012345, 3), "0.0123");
/// assert_eq!(significant(-4.2137e9, 3), "−4.21·10⁹");
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return "–".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "−∞" }.to_owned();
    }
    let digits = digits.clamp(1, 17);
    // Rounding first: 9.996 with three digits is 10.0, one decimal less than 9.99.
    let rounded = format!("{:.*e}", digits - 1, value);
    let (mantissa, exponent) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        fixed(rounded.parse().unwrap_or(value), decimals)
    } else {
        format!("{}·10{}", mantissa.replace('-', "−"), superscript(exponent))
    }
}

/// A time (s) in words: "7.3 s" below ten seconds, "45 s", "1 min 50 s", "2 h 5 min".
pub(crate) fn duration(seconds: f64) -> String {
    let whole = seconds.round();
    if seconds < 9.95 {
        format!("{} s", fixed(seconds, 1))
    } else if whole < 60.0 {
        format!("{} s", fixed(whole, 0))
    } else if whole < 3600.0 {
        let (minutes, rest) = ((whole / 60.0).floor(), whole % 60.0);
        if rest < 1.0 {
            format!("{} min", fixed(minutes, 0))
        } else {
            format!("{} min {} s", fixed(minutes, 0), fixed(rest, 0))
        }
    } else {
        let minutes = (seconds / 60.0).round();
        let (hours, rest) = ((minutes / 60.0).floor(), minutes % 60.0);
        if rest < 1.0 {
            format!("{} h", fixed(hours, 0))
        } else {
            format!("{} h {} min", fixed(hours, 0), fixed(rest, 0))
        }
    }
}

/// The number with so many decimals, in groups of three digits from 10 000 on, with a true minus sign; never "−0".
///
/// ```
/// use plummer::report::fixed;
/// assert_eq!(fixed(-1.2345, 2), "−1.23");
/// assert_eq!(fixed(-1e-9, 4), "0.0000");
/// ```
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let mut out = String::with_capacity(text.len() + 8);
    if value < 0.0 && text.bytes().any(|b| (b'1'..=b'9').contains(&b)) {
        out.push('−');
    }
    for (k, digit) in whole.chars().enumerate() {
        if k > 0 && whole.len() > 4 && (whole.len() - k).is_multiple_of(3) {
            out.push(GROUP);
        }
        out.push(digit);
    }
    if !fraction.is_empty() {
        out.push('.');
        out.push_str(fraction);
    }
    out
}

/// A number with its sign, with so many significant digits; a zero has none.
pub(crate) fn signed(value: f64, digits: usize) -> String {
    with_plus(value, significant(value, digits))
}

/// A number with its sign, with so many decimals; what rounds to zero has none.
pub(crate) fn signed_fixed(value: f64, decimals: usize) -> String {
    with_plus(value, fixed(value, decimals))
}

fn with_plus(value: f64, text: String) -> String {
    let zero = !text.bytes().any(|b| (b'1'..=b'9').contains(&b));
    if value > 0.0 && !zero { format!("+{text}") } else { text }
}

/// A value as somebody gave it: with up to five significant digits, without the zeros behind them.
pub(crate) fn given(value: f64) -> String {
    trimmed(value, 5)
}

/// A number with up to so many significant digits, without the zeros behind them.
pub(crate) fn trimmed(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (number, power) = text.split_once('·').map_or((text.as_str(), String::new()), |(n, p)| (n, format!("·{p}")));
    match number.contains('.') {
        true => format!("{}{power}", number.trim_end_matches('0').trim_end_matches('.')),
        false => text,
    }
}

/// A given value with its unit, prefixed where that makes it short: "100 kN/m".
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    let shown = display_unit(unit, value.abs());
    format!("{} {}", given(value / shown.factor), shown.text)
}

/// A shaft's speed in both units that people use, with so many significant digits each: "29.95 Hz (1797 rpm)".
///
/// ```
/// use plummer::report::shaft_speed;
/// assert_eq!(shaft_speed(25.0, 3), "25.0 Hz (1500 rpm)");
/// ```
pub fn shaft_speed(hz: f64, digits: usize) -> String {
    format!("{} Hz ({} rpm)", significant(hz, digits), significant(60.0 * hz, digits.max(4)))
}

/// A whole number in superscript digits.
pub(super) fn superscript(n: i32) -> String {
    n.to_string().chars().map(raised).collect()
}

fn raised(c: char) -> char {
    match c {
        '-' => '⁻',
        _ => c.to_digit(10).and_then(|digit| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize)).unwrap_or(c),
    }
}

/// A unit as it is printed: "m/s^2" becomes "m/s²", "kg*m" becomes "kg·m"; powers with a decimal point stay
/// ("N/m^(3/2)").
pub(crate) fn pretty_unit(unit: &str) -> String {
    raised_powers(unit).replace('*', "·")
}

/// A name with its unit in brackets: "Frequency \[Hz\]"; the name alone without a unit.
pub(super) fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") }
}

/// Text with its powers as they are printed: "340 m/s^2" becomes "340 m/s²"; those with a decimal point stay.
pub(super) fn raised_powers(text: &str) -> String {
    let mut parts = text.split('^');
    let mut out = parts.next().unwrap_or("").to_owned();
    for part in parts {
        let end = part.find(|c: char| !(c.is_ascii_digit() || c == '-' || c == '.')).unwrap_or(part.len());
        let (power, rest) = part.split_at(end);
        if power.is_empty() || power.contains('.') {
            out.push('^');
            out.push_str(power);
        } else {
            out.extend(power.chars().map(raised));
        }
        out.push_str(rest);
    }
    out
}

/// By what an axis' values are divided, and how its unit is written then.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DisplayUnit {
    /// Shown value = value / factor.
    pub(crate) factor: f64,
    /// The unit with its prefix or power of ten.
    pub(crate) text: String,
}

/// Chooses a prefix such that a largest absolute value reads from 0.1 to below 10 000; for units that take no prefix a
/// power of ten outside 0.001 .. 1 000 000.
pub(crate) fn display_unit(unit: &str, largest: f64) -> DisplayUnit {
    const PREFIXES: [(i32, &str); 8] =
        [(-12, "p"), (-9, "n"), (-6, "µ"), (-3, "m"), (3, "k"), (6, "M"), (9, "G"), (12, "T")];
    let takes_prefix = matches!(unit, "Hz" | "s" | "m" | "N" | "Pa" | "W" | "J" | "V" | "N/m");
    let plain = DisplayUnit { factor: 1.0, text: pretty_unit(unit) };
    if !(largest.is_finite() && largest > 0.0) {
        return plain;
    }
    // beyond, a power of ten is no normal number
    let exponent = (3 * (largest.log10() / 3.0 + 1e-9).floor() as i32).clamp(-306, 306);
    let powers = [("m^2", "mm²", 1e-6), ("m^3", "mm³", 1e-9), ("m^4", "mm⁴", 1e-12), ("kg*m", "g·mm", 1e-6)];
    if let (Some((_, text, factor)), true) = (powers.iter().find(|(of, ..)| *of == unit), largest < 1e-3) {
        return DisplayUnit { factor: *factor, text: (*text).to_owned() };
    }
    if takes_prefix {
        let wanted = !(0.1..1e4).contains(&largest) && (unit != "s" || exponent < 0);
        let prefix = PREFIXES.iter().find(|(e, _)| *e == exponent);
        if let (true, Some((e, prefix))) = (wanted, prefix) {
            return DisplayUnit { factor: 10_f64.powi(*e), text: format!("{prefix}{unit}") };
        }
    } else if !(1e-3..1e6).contains(&largest) {
        let power = format!("10{}", superscript(exponent));
        let unit = pretty_unit(unit);
        let text = format!("{power} {unit}").trim_end().to_owned();
        return DisplayUnit { factor: 10_f64.powi(exponent), text };
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_read_as_one_says_them() {
        for (seconds, words) in [
            (0.04, "0.0 s"),
            (7.26, "7.3 s"),
            (44.6, "45 s"),
            (59.7, "1 min"),
            (110.0, "1 min 50 s"),
            (3599.8, "1 h"),
            (7500.0, "2 h 5 min"),
        ] {
            assert_eq!(super::duration(seconds), words);
        }
    }

    #[test]
    fn significant_digits() {
        for (value, digits, text) in [
            (9.996, 3, "10.0"),
            (0.0, 3, "0.00"),
            (55.02, 4, "55.02"),
            (-0.001_234, 2, "−0.0012"),
            (8159.6, 4, "8160"),
            (12_345.0, 5, "12\u{202f}345"),
            (999_999.6, 6, "1.00000·10⁶"),
            (123_456.7, 2, "120\u{202f}000"),
            (3.828e9, 4, "3.828·10⁹"),
            (-1.0e-7, 2, "−1.0·10⁻⁷"),
            (f64::NAN, 2, "–"),
            (f64::NEG_INFINITY, 2, "−∞"),
        ] {
            assert_eq!(significant(value, digits), text);
        }
    }

    #[test]
    fn fixed_decimals_never_show_minus_zero() {
        assert_eq!(fixed(-0.001, 2), "0.00");
        assert_eq!(fixed(-1_234_567.0, 1), "−1\u{202f}234\u{202f}567.0");
        assert_eq!(fixed(1234.0, 0), "1234");
        assert_eq!([0.5, -0.001, 0.001].map(|value| signed_fixed(value, 2)), ["+0.50", "0.00", "0.00"]);
        assert_eq!([0.5, -0.001].map(|value| signed(value, 2)), ["+0.50", "−0.0010"]);
    }

    #[test]
    fn given_values_have_no_zeros_behind_them() {
        for (value, text) in
            [(0.0, "0"), (20.0, "20"), (25_600.0, "25\u{202f}600"), (0.75, "0.75"), (-9.81, "−9.81"), (1e-7, "1·10⁻⁷")]
        {
            assert_eq!(given(value), text);
        }
        assert_eq!(quantity(1e5, "N/m"), "100 kN/m");
        assert_eq!(quantity(25_599.999_839_999_375, "Hz"), "25.6 kHz");
    }

    #[test]
    fn units_are_raised_and_prefixed() {
        assert_eq!(pretty_unit("m/s^2"), "m/s²");
        assert_eq!(pretty_unit("kg*m^-2 x"), "kg·m⁻² x");
        assert_eq!(pretty_unit("N/m^(3/2)"), "N/m^(3/2)");
        let shown = |unit, largest| {
            let d = display_unit(unit, largest);
            format!("{} {:e}", d.text, d.factor)
        };
        assert_eq!(shown("Hz", 40e3), "kHz 1e3");
        assert_eq!(shown("Hz", 300.0), "Hz 1e0");
        assert_eq!(shown("m", 2.5e-6), "µm 1e-6");
        assert_eq!(shown("s", 2e4), "s 1e0");
        assert_eq!(shown("m/s^2", 1500.0), "m/s² 1e0");
        assert_eq!(shown("m/s^2", 3e-6), "10⁻⁶ m/s² 1e-6");
        assert_eq!(shown("m^4", 9e-12), "mm⁴ 1e-12");
        assert_eq!(shown("", 1e9), "10⁹ 1e9");
        assert_eq!(shown("Hz", 0.0), "Hz 1e0");
    }
}
