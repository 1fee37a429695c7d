//! `--vary KEY=VALUES`: which values a key of the case takes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::app::case::split_argument;
use crate::app::error::ComputeError;

/// Most values of one key.
const MOST_VALUES: usize = 100_000;

/// A key of the case and its values.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Axis {
    /// Path of the key, as `--set` has it.
    pub key: String,
    /// Its values, each as `--set` has it: TOML, or a bare word; at least one.
    pub values: Vec<String>,
}

/// What to write after `--vary`.
pub(super) const EXAMPLES: &str = "for example: --vary bearing.radial_play=1e-6,2e-6, --vary 'bearing.defects[0].depth=5e-6:20e-6:4' or --vary ring.supports.0.spring.y=1e4:1e7:4:log";

impl Axis {
    /// Reads `KEY=A,B,C`; each item is a value, or a range `FROM:TO:COUNT` (equal differences) or `FROM:TO:COUNT:log`
    /// (equal ratios), both ends included. Commas inside brackets, braces and quotes belong to the value.
    ///
    /// Values of a range are whole numbers where its ends are written as such and all of them are whole; otherwise they are
    /// given with 15 digits at most, so that 0.1:0.3:3 has 0.2 and not 0.20000000000000001.
    ///
    /// ```
    /// use plummer::app::studies::sweep::Axis;
    /// let axis = Axis::parse("bearing.radial_play=0,1e-6:4e-6:3")?;
    /// assert_eq!(axis.values, ["0", "1e-6", "2.5e-6", "4e-6"]);
    /// # Ok::<(), plummer::app::error::ComputeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ComputeError::Input`] for an argument that says nothing.
    pub fn parse(argument: &str) -> Result<Self, ComputeError> {
        Self::read(argument).map_err(|problem| ComputeError::input(format!("--vary {argument}: {problem}"), EXAMPLES))
    }

    /// As [`parse`](Self::parse), with what is wrong as the error.
    fn read(argument: &str) -> Result<Self, String> {
        let no_key = "expected KEY=VALUES, found no `=` with a key before it";
        let (key, text) = split_argument(argument).filter(|(key, _)| !key.is_empty()).ok_or(no_key)?;
        let mut values = Vec::new();
        for (place, item) in (1..).zip(items(text)?) {
            if item.is_empty() {
                return Err(format!("value {place} is empty"));
            }
            match range(item)? {
                Some(range) => values.extend(range),
                None => values.push(item.to_owned()),
            }
        }
        Ok(Self { key: key.to_owned(), values })
    }

    /// The key as a name for columns and arrays: `[0]` as `.0`, quotes left out.
    pub(crate) fn name(&self) -> String {
        plain_name(&self.key)
    }

    /// Whether this axis sets a key, or something that holds it.
    pub(super) fn sets(&self, key: &str) -> bool {
        let key = plain_name(key.trim());
        let below = key.strip_prefix(&self.name());
        below.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    }

    /// The values as numbers; `None` unless all of them are finite ones.
    pub(crate) fn numbers(&self) -> Option<Vec<f64>> {
        let number = |value: &String| value.parse().ok().filter(|number: &f64| number.is_finite());
        self.values.iter().map(number).collect()
    }
}

/// Splits at commas outside brackets, braces and quotes.
fn items(text: &str) -> Result<Vec<&str>, String> {
    let open = || format!("found `{text}`, expected its brackets and quotes to close");
    let (mut depth, mut quote, mut start) = (0_usize, None, 0);
    let mut items = Vec::new();
    for (at, letter) in text.char_indices() {
        match (quote, letter) {
            (Some(open), _) if open == letter => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(letter),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => {
                depth = depth.checked_sub(1).ok_or_else(open)?;
            }
            (None, ',') if depth == 0 => {
                items.push(text[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    if depth > 0 || quote.is_some() {
        return Err(open());
    }
    items.push(text[start..].trim());
    Ok(items)
}

/// Values between two ends, both included; `None` for what does not begin with two numbers with a colon between.
fn range(item: &str) -> Result<Option<Vec<String>>, String> {
    let wrong = |reason: &str| format!("found the range `{item}`: {reason}");
    let parts: Vec<&str> = item.split(':').map(str::trim).collect();
    let &[first, second, ref rest @ ..] = parts.as_slice() else {
        return Ok(None);
    };
    let (Ok(from), Ok(to)) = (first.parse::<f64>(), second.parse::<f64>()) else {
        return Ok(None);
    };
    let (count, ratios) = match *rest {
        [count] => (count, false),
        [count, "log"] => (count, true),
        _ => return Err(wrong("expected FROM:TO:COUNT or FROM:TO:COUNT:log")),
    };
    if !(from.is_finite() && to.is_finite()) {
        return Err(wrong("expected finite ends"));
    }
    let last = match count.parse::<usize>() {
        Ok(count) if (2..=MOST_VALUES).contains(&count) => count - 1,
        _ => return Err(wrong("expected a COUNT from 2 to 100000")),
    };
    if ratios && !(from > 0.0 && to > 0.0) {
        return Err(wrong("equal ratios need ends above 0"));
    }
    let at = |k: usize| {
        let part = k as f64 / last as f64;
        let value = match (k, ratios) {
            (0, _) => from,
            (k, _) if k == last => to,
            (_, false) => from + (to - from) * part,
            (_, true) => from * (to / from).powf(part),
        };
        // a difference of nearly equal numbers is 0 where it should be
        let scale = from.abs().max(to.abs());
        if value.abs() < 1e-15 * scale { 0.0 } else { rounded(value) }
    };
    let values: Vec<f64> = (0..=last).map(at).collect();
    let whole_ends = first.parse::<i64>().is_ok() && second.parse::<i64>().is_ok();
    let whole = whole_ends && values.iter().all(|value| value.fract().abs() < f64::MIN_POSITIVE);
    Ok(Some(values.into_iter().map(|value| text(value, whole)).collect()))
}

/// With 15 significant digits, as many as any decimal number keeps.
fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// As TOML: a number with a point or an exponent unless it is to be whole.
fn text(value: f64, whole: bool) -> String {
    if whole && value.abs() < 1e15 {
        return format!("{value:.0}");
    }
    if value.abs() > 0.0 && !(1e-3..1e6).contains(&value.abs()) { format!("{value:e}") } else { format!("{value:?}") }
}

fn plain_name(key: &str) -> String {
    let dotted = key.replace('[', ".");
    dotted.replace([']', '"', '\''], "")
}

#[cfg(test)]
mod tests {
    use super::{Axis, EXAMPLES};

    fn values(text: &str) -> Vec<String> {
        Axis::parse(&format!("a.b={text}")).unwrap().values
    }

    fn problem(argument: &str) -> String {
        let error = Axis::parse(argument).unwrap_err();
        assert!(error.is_input() && error.help().as_deref() == Some(EXAMPLES));
        let message = error.to_string();
        message.strip_prefix(&format!("--vary {argument}: ")).unwrap().to_owned()
    }

    #[test]
    fn lists_keep_what_belongs_to_a_value() {
        assert_eq!(values("1, 2 ,3"), ["1", "2", "3"]);
        assert_eq!(values("[0,-1],[0,-2]"), ["[0,-1]", "[0,-2]"], "commas in brackets");
        assert_eq!(values("{ x = 1, y = 2 },none"), ["{ x = 1, y = 2 }", "none"]);
        assert_eq!(values("\"a, b\",'c]'"), ["\"a, b\"", "'c]'"]);
        assert_eq!(values("newmark,exponential"), ["newmark", "exponential"]);
        let quoted = Axis::parse("materials.\"a=b\".young=1").unwrap();
        assert_eq!(quoted.key, "materials.\"a=b\".young");
    }

    #[test]
    fn ranges_have_both_ends_and_short_numbers() {
        assert_eq!(values("0.1:0.5:5"), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(values("7:9:3"), ["7", "8", "9"]);
        assert_eq!(values("7:8:3"), ["7.0", "7.5", "8.0"]);
        assert_eq!(values("3:1:3"), ["3", "2", "1"]);
        assert_eq!(values("-0.3:0.3:3"), ["-0.3", "0.0", "0.3"]);
        assert_eq!(values("-0.3:0.6:4"), ["-0.3", "0.0", "0.3", "0.6"]);
        assert_eq!(values("1e5:1e8:4:log"), ["100000.0", "1e6", "1e7", "1e8"]);
        assert_eq!(values("1e-6:4e-6:2,7"), ["1e-6", "4e-6", "7"]);
        // a colon alone makes no range
        assert_eq!(values("a:b"), ["a:b"]);
    }

    #[test]
    fn what_says_nothing_is_named() {
        assert_eq!(problem("a.b"), "expected KEY=VALUES, found no `=` with a key before it");
        assert_eq!(problem("=1"), problem("a.b"));
        assert_eq!(problem("a=1,,2"), "value 2 is empty");
        assert_eq!(problem("a="), "value 1 is empty");
        for open in ["a=[1", "a=1]", "a='x", "a={b=1"] {
            let found = &open[2..];
            assert_eq!(problem(open), format!("found `{found}`, expected its brackets and quotes to close"));
        }
        for (range, reason) in [
            ("1:2", "expected FROM:TO:COUNT or FROM:TO:COUNT:log"),
            ("1:2:3:lin", "expected FROM:TO:COUNT or FROM:TO:COUNT:log"),
            ("1:2:1", "expected a COUNT from 2 to 100000"),
            ("1:2:100001", "expected a COUNT from 2 to 100000"),
            ("1:2:x", "expected a COUNT from 2 to 100000"),
            ("1:inf:3", "expected finite ends"),
            ("0:2:3:log", "equal ratios need ends above 0"),
        ] {
            assert_eq!(problem(&format!("a={range}")), format!("found the range `{range}`: {reason}"));
        }
    }

    #[test]
    fn names_and_numbers() {
        let axis = Axis::parse("bearing.defects[0].depth=1e-6,2e-6").unwrap();
        assert_eq!(axis.name(), "bearing.defects.0.depth");
        assert_eq!(axis.numbers().unwrap(), [1e-6, 2e-6]);
        for text in ["a=1,x", "a=1,inf", "a=1,[2]"] {
            assert_eq!(Axis::parse(text).unwrap().numbers(), None);
        }
    }
}
