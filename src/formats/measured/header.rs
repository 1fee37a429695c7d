//! Names and units in headers.

/// Name and unit of `P1 (m/s^2)` or `P1 [m/s^2]`; the unit is empty without brackets.
pub(super) fn name_and_unit(text: &str) -> (String, String) {
    let text = text.trim();
    for (open, close) in [('(', ')'), ('[', ']')] {
        let inside = text.strip_suffix(close).and_then(|text| text.rsplit_once(open));
        if let Some((name, unit)) = inside
            && !name.trim().is_empty()
        {
            return (name.trim().to_owned(), unit.trim().to_owned());
        }
    }
    (text.to_owned(), String::new())
}

/// Seconds in the unit of a column or array that is a time; `None` if it is none.
pub(super) fn time_unit(text: &str) -> Option<f64> {
    let (name, unit) = name_and_unit(text);
    let name = name.to_lowercase();
    let (name, suffix) = match name.rsplit_once('_') {
        Some((name, suffix)) => (name, suffix),
        None => (name.as_str(), ""),
    };
    let unit = if unit.is_empty() { suffix } else { &unit };
    if !matches!(name, "t" | "time" | "zeit" | "temps") {
        return None;
    }
    match unit.to_lowercase().as_str() {
        "" | "s" | "sec" | "seconds" => Some(1.0),
        "ms" => Some(1e-3),
        "us" | "\u{b5}s" | "\u{3bc}s" => Some(1e-6),
        _ => None,
    }
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
        assert_eq!(name_and_unit("(g)"), pair("(g)", ""));
        for (text, expected) in [
            ("time_s", Some(1.0)),
            ("Time", Some(1.0)),
            ("t [ms]", Some(1e-3)),
            ("time_us", Some(1e-6)),
            ("time (min)", None),
            ("temperature", None),
            ("top", None),
        ] {
            assert_eq!(time_unit(text), expected, "{text}");
        }
    }
}
