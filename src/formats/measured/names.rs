//! What names say in a file: units, times, how often samples were taken and how fast the shaft turned.

/// Units that stand without brackets behind a name.
const UNITS: &str = "s ms us \u{b5}s \u{3bc}s ns g mg m/s^2 m/s2 m/s\u{b2} mm/s^2 mm/s2 mm/s\u{b2} m/s mm/s m mm um \u{b5}m \u{3bc}m V mV N kN Pa Hz rpm";

/// Name and unit of `P1 (m/s^2)`, `P1 [m/s^2]`, `P1 / (m/s^2)`, `P1 / g` or `P1 in g`; the unit is empty without one.
pub(super) fn name_and_unit(text: &str) -> (String, String) {
    let text = text.trim();
    let pair = |name: &str, unit: &str| (name.trim().to_owned(), unit.trim().to_owned());
    for (open, close) in [('(', ')'), ('[', ']')] {
        let inside = text.strip_suffix(close).and_then(|text| text.rsplit_once(open));
        if let Some((name, unit)) = inside
            && !name.trim().is_empty()
        {
            return pair(name.trim_end().trim_end_matches('/'), unit);
        }
    }
    let parts = [" / ", " in "].into_iter().filter_map(|between| text.rsplit_once(between));
    let mut known = parts.filter(|(_, unit)| is_unit(unit));
    known.next().map_or_else(|| pair(text, ""), |(name, unit)| pair(name, unit))
}

/// A text without the brackets about it.
pub(super) fn bracketless(text: &str) -> &str {
    text.trim().trim_matches(['(', ')', '[', ']']).trim()
}

/// Whether a text is a unit, with or without brackets.
pub(super) fn is_unit(text: &str) -> bool {
    let unit = bracketless(text);
    UNITS.split(' ').any(|known| known == unit)
}

/// Seconds in the unit of a column or array that is a time; `None` if it is none. Besides what says so: the abscissa of LabVIEW and of
/// oscilloscopes, the times of catman, `Zeit  1 - Standardmessrate [s]`, and a unit alone, `[s]` or `in s`.
pub(super) fn time_unit(text: &str) -> Option<f64> {
    time_of(text).map(|(seconds, _)| seconds)
}

/// Whether a time has its unit beside its name.
pub(super) fn is_stated(text: &str) -> bool {
    time_of(text).is_some_and(|(_, stated)| stated)
}

fn time_of(text: &str) -> Option<(f64, bool)> {
    let alone = bracketless(text);
    let siglent = text.eq_ignore_ascii_case("second").then_some(text);
    let alone =
        siglent.or(text.trim().strip_prefix("in ")).or_else(|| (alone.len() < text.trim().len()).then_some(alone));
    if let Some(seconds) = alone.and_then(seconds) {
        return Some((seconds, true));
    }
    let (name, unit) = name_and_unit(text);
    let name = name.to_lowercase();
    // LabVIEW's are seconds
    let (stem, suffix) = match name.rsplit_once('_') {
        Some(("x", "value")) => (name.as_str(), "s"),
        Some((stem, suffix)) => (stem, suffix),
        None => (name.as_str(), ""),
    };
    // a number and the rate behind it
    let stem =
        stem.split_once(" - ").map_or(stem, |(time, _)| time.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end());
    let unit = if unit.is_empty() { suffix } else { &unit };
    let known = matches!(stem, "t" | "time" | "zeit" | "temps" | "x_value" | "x-axis");
    known.then_some(())?;
    if unit.is_empty() { Some((1.0, false)) } else { seconds(unit).map(|seconds| (seconds, true)) }
}

/// Seconds in a unit of time.
pub(super) fn seconds(unit: &str) -> Option<f64> {
    match unit.trim().to_lowercase().as_str() {
        "s" | "sec" | "second" | "seconds" => Some(1.0),
        "ms" | "msec" => Some(1e-3),
        "us" | "\u{b5}s" | "\u{3bc}s" => Some(1e-6),
        "ns" => Some(1e-9),
        _ => None,
    }
}

/// Revolutions per minute in one Hz.
const RPM: f64 = 60.0;

/// Lower case, without underscores.
fn bare(name: &str) -> String {
    name.to_lowercase().replace('_', "")
}

/// Whether a number of this name is a sampling rate in Hz.
pub(super) fn is_rate(name: &str) -> bool {
    let name = bare(name);
    // without its unit, "rate" alone may be of anything
    if name == "ratehz" {
        return true;
    }
    const RATES: &str = "fs sr fsamp samplerate samplingrate samplefrequency samplingfrequency samplefreq samplingfreq";
    let name = name.strip_suffix("hz").unwrap_or(&name);
    RATES.split(' ').any(|known| known == name)
}

/// Whether a number is called a rate and nothing more: beside a sampling rate it is the shaft's, in Hz.
pub(super) fn is_bare_rate(name: &str) -> bool {
    name.eq_ignore_ascii_case("rate")
}

/// Hz in the unit of a number that is a shaft speed by its name; `None` if it is none.
pub(super) fn speed_unit(name: &str) -> Option<f64> {
    let name = bare(name);
    if name.ends_with("rpm") {
        return Some(1.0 / RPM);
    }
    matches!(name.as_str(), "speedhz" | "shaftspeedhz").then_some(1.0)
}

/// The one speed that all numbers state, Hz, above 0; `None` if they differ or there is none.
pub(super) fn one_speed(speeds: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut usable = speeds.into_iter().filter(|hz| *hz > 0.0 && hz.is_finite());
    let first = usable.next()?;
    usable.all(|other| same(first, other)).then_some(first)
}

/// Whether two numbers are the same but for rounding.
pub(super) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_hold_units_and_times_are_known() {
        let pair = |name: &str, unit: &str| (name.to_owned(), unit.to_owned());
        assert_eq!(name_and_unit(" P1 (m/s^2) "), pair("P1", "m/s^2"));
        assert_eq!(name_and_unit("top [g]"), pair("top", "g"));
        assert_eq!(name_and_unit("plain"), pair("plain", ""));
        assert_eq!(name_and_unit("Beschleunigung / (m/s²)"), pair("Beschleunigung", "m/s²"));
        assert_eq!(name_and_unit("a / g"), pair("a", "g"));
        assert_eq!(name_and_unit("sensor in hall"), pair("sensor in hall", ""));
        assert_eq!(name_and_unit("(g)"), pair("(g)", ""));
        for (text, expected) in [
            ("time_s", Some(1.0)),
            ("Time", Some(1.0)),
            ("t [ms]", Some(1e-3)),
            ("Zeit in s", Some(1.0)),
            ("Time / ms", Some(1e-3)),
            ("Time (ns)", Some(1e-9)),
            ("X_Value", Some(1.0)),
            ("Zeit  1 - Standardmessrate [s]", Some(1.0)),
            ("time_us", Some(1e-6)),
            ("time (min)", None),
            ("temperature", None),
            ("top", None),
        ] {
            assert_eq!(time_unit(text), expected, "{text}");
        }
    }

    #[test]
    fn names_say_rates_and_speeds() {
        for name in ["fs", "Fs", "FS", "sr", "rate_hz", "sample_rate", "SamplingRate", "sampling_frequency", "fs_Hz"] {
            assert!(is_rate(name), "{name}");
        }
        for name in ["rate", "f", "fs_khz", "offs", "hz", "", "strain_rate"] {
            assert!(!is_rate(name), "{name}");
        }
        for (name, unit) in [
            ("rpm", Some(1.0 / 60.0)),
            ("X105RPM", Some(1.0 / 60.0)),
            ("shaft_rpm", Some(1.0 / 60.0)),
            ("speed_hz", Some(1.0)),
            ("Shaft_Speed_Hz", Some(1.0)),
            ("speed", None),
            ("rate", None),
            ("rpms", None),
        ] {
            assert_eq!(speed_unit(name), unit, "{name}");
        }
    }

    #[test]
    fn speeds_that_differ_are_none() {
        assert_eq!(one_speed([25.0, 25.0]), Some(25.0));
        assert_eq!(one_speed([0.0, 25.0, f64::NAN]), Some(25.0));
        assert_eq!(one_speed([25.0, 24.8]), None);
        assert_eq!(one_speed([-25.0, f64::INFINITY]), None);
        assert_eq!(one_speed([]), None);
    }
}
