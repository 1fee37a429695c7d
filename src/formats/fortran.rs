//! Numbers as Fortran writes and reads them: universal files, OUTPUT4.

/// `E` format: `width` columns, `digits` after the point, exponent of two digits or three (`1.50000E+03`). Magnitudes below
/// 1e-99 become 0, as the exponent would take the column of the sign.
pub(super) fn exponential(value: f64, width: usize, digits: usize, letter: char) -> String {
    let value = if value.abs() < 1e-99 { 0.0 } else { value };
    let text = format!("{value:.digits$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if exponent < 0 { '-' } else { '+' };
    let magnitude = exponent.unsigned_abs();
    format!("{:>width$}", format!("{mantissa}{letter}{sign}{magnitude:02}"))
}

/// Reads a real number with exponent E, D, Q or without its letter (`1.5+100`).
pub(super) fn real(text: &str) -> Option<f64> {
    let text = text.trim();
    let plain = |text: &str| text.parse::<f64>().ok().filter(|value| value.is_finite());
    // `parse` takes "inf" and "nan", whose letters are none of a number's.
    if !text.bytes().all(|byte| b"+-.0123456789eEdDqQ".contains(&byte)) {
        return None;
    }
    if let Some(value) = plain(&text.replace(['d', 'D', 'q', 'Q'], "e")) {
        return Some(value);
    }
    let place = text.rfind(['+', '-']).filter(|&place| place > 0)?;
    let (mantissa, exponent) = text.split_at_checked(place)?;
    plain(&format!("{mantissa}e{exponent}"))
}

/// Splits a line into columns of a fixed width, for numbers that run together; blank columns are left out.
pub(super) fn columns(line: &str, width: usize) -> Vec<&str> {
    let line = line.trim_end();
    (0..line.len())
        .step_by(width.max(1))
        .filter_map(|begin| line.get(begin..(begin + width).min(line.len())))
        .map(str::trim)
        .filter(|word| !word.is_empty())
        .collect()
}

/// Columns of a line by their widths, without the blanks around; those beyond its end are left out.
pub(super) fn fields<'a>(line: &'a str, widths: &[usize]) -> Vec<&'a str> {
    let mut end = 0;
    let column = |width: &usize| {
        let begin = end;
        end += width;
        Some(line.get(begin..line.len().min(end))?.trim())
    };
    widths.iter().filter_map(column).collect()
}

/// Takes the next line of a file, without its end; the last may lack it. `None` at the end of the file.
pub(super) fn take_line<'a>(rest: &mut &'a [u8]) -> Option<&'a [u8]> {
    if rest.is_empty() {
        return None;
    }
    let end = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
    let line = &rest[..end];
    *rest = rest.get(end + 1..).unwrap_or_default();
    Some(line)
}

/// The first 60 characters of a line in quotation marks, for messages.
pub(super) fn quoted(line: &str) -> String {
    let text = line.trim();
    let mut found: String = text.chars().take(60).collect();
    if found.len() < text.len() {
        found.push_str("...");
    }
    format!("\"{found}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_by_fortran() {
        assert_eq!(exponential(1234.567, 13, 5, 'E'), "  1.23457E+03");
        assert_eq!(exponential(-1.0, 13, 5, 'E'), " -1.00000E+00");
        assert_eq!(exponential(1e-120, 13, 5, 'E'), "  0.00000E+00");
        assert_eq!(exponential(0.25, 25, 16, 'D'), "   2.5000000000000000D-01");
        assert_eq!(exponential(-1e123, 13, 5, 'E'), "-1.00000E+123");
    }

    #[test]
    #[allow(clippy::float_cmp)] // parsed decimals are exact
    fn numbers_are_read_in_every_spelling() {
        for (text, value) in [
            ("1.5D+03", 1500.0),
            ("-2.5d-1", -0.25),
            ("1.5E3", 1500.0),
            ("7", 7.0),
            ("1.5+100", 1.5e100),
            ("-1.5-2", -0.015),
        ] {
            assert_eq!(real(text), Some(value), "{text}");
        }
        for text in ["", "nan", "inf", "1e999", "x", "1.0.0", "+", "e5", "é"] {
            assert_eq!(real(text), None, "{text}");
        }
    }

    #[test]
    fn columns_that_run_together_are_told_apart() {
        let line = "-1.00000E+100-2.00000E+100  1.00000E+00";
        let expected = ["-1.00000E+100", "-2.00000E+100", "1.00000E+00"];
        assert_eq!(columns(line, 13), expected);
        let labels = "12345678901234567890         3";
        assert_eq!(columns(labels, 10), ["1234567890", "1234567890", "3"]);
    }
}
