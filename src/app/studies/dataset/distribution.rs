//! What a key of a specification is drawn from: a plain value, or a table that names a distribution, also inside arrays and tables.

use crate::numerics::random::Stream;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Unexpected};
use serde_json::{Map, Value};
use std::borrow::Cow;

/// Draws that are tried before an interval is taken for so narrow that the normal distribution is even there.
const MOST_TRIES: usize = 1000;
/// Most items of one `repeat`, and most values of a key.
const MOST_ITEMS: u64 = 10_000;
const MOST_VALUES: usize = 100_000;

/// What a value is drawn from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Distribution {
    /// Always this.
    Fixed(Value),
    /// Each item by itself.
    Array(Vec<Self>),
    /// Each entry by itself.
    Table(Vec<(String, Self)>),
    /// Evenly between two numbers.
    Uniform([f64; 2]),
    /// Evenly in the logarithm between two numbers of one sign.
    LogUniform([f64; 2]),
    /// Normal of mean and standard deviation, drawn again until it is within an interval.
    Normal { mean: f64, deviation: f64, within: Option<[f64; 2]> },
    /// One of these by their weights.
    Choice(Vec<(f64, Self)>),
    /// So many of one kind; one key has at most 100000 values.
    Repeat(usize, Box<Self>),
}

/// A distribution of numbers alone.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Amount(Distribution);

/// What was found, and what was expected.
type Refused = (String, &'static str);

const FORMS: &str = "one of { uniform = [LOW, HIGH] }, { log_uniform = [LOW, HIGH] }, { normal = [MEAN, DEVIATION] } with within = [LOW, HIGH], { choice = [...] } with weights = [...], { repeat = COUNT, of = ... }";
const NAMES: [&str; 5] = ["uniform", "log_uniform", "normal", "choice", "repeat"];

impl Distribution {
    /// One of these, each as likely.
    pub(super) fn any_of(values: impl IntoIterator<Item = Value>) -> Self {
        Self::Choice(values.into_iter().map(|value| (1.0, Self::Fixed(value))).collect())
    }

    fn read(value: Value) -> Result<Self, Refused> {
        match value {
            Value::Array(items) => {
                let items = items.into_iter().map(Self::read).collect::<Result<Vec<_>, _>>()?;
                Ok(Self::Array(items))
            }
            Value::Object(table) if NAMES.iter().any(|name| table.contains_key(*name)) => Self::named(table),
            Value::Object(table) => {
                let entries = table.into_iter().map(|(key, value)| Ok((key, Self::read(value)?)));
                Ok(Self::Table(entries.collect::<Result<_, _>>()?))
            }
            plain => Ok(Self::Fixed(plain)),
        }
    }

    /// A table that has the name of a distribution.
    fn named(mut table: Map<String, Value>) -> Result<Self, Refused> {
        let found = Value::Object(table.clone()).to_string();
        let refuse = |expected| Err((found.clone(), expected));
        let mut pair = |key: &str| table.remove(key).map(|value| pair_of(&value));
        let (uniform, log_uniform, normal, within) =
            (pair("uniform"), pair("log_uniform"), pair("normal"), pair("within"));
        let [choice, weights, repeat, of] = ["choice", "weights", "repeat", "of"].map(|key| table.remove(key));
        if !table.is_empty() {
            return refuse(FORMS);
        }
        match (uniform, log_uniform, normal, within, choice, weights, repeat, of) {
            (Some(ends), None, None, None, None, None, None, None) => match ends {
                Some([low, high]) if low <= high => Ok(Self::Uniform([low, high])),
                _ => refuse("two numbers, the lower one first"),
            },
            (None, Some(ends), None, None, None, None, None, None) => match ends {
                Some([low, high]) if low <= high && low * high > 0.0 => Ok(Self::LogUniform([low, high])),
                _ => refuse("two numbers of one sign and not 0, the lower one first"),
            },
            (None, None, Some(normal), within, None, None, None, None) => match (normal, within) {
                (Some([mean, deviation]), None) if deviation >= 0.0 => {
                    Ok(Self::Normal { mean, deviation, within: None })
                }
                (Some([mean, deviation]), Some(Some([low, high])))
                    if deviation >= 0.0 && low <= mean && mean <= high && low < high =>
                {
                    Ok(Self::Normal { mean, deviation, within: Some([low, high]) })
                }
                _ => refuse("a mean, a standard deviation not below 0, and within an interval that has the mean"),
            },
            (None, None, None, None, Some(Value::Array(items)), weights, None, None) if !items.is_empty() => {
                let weights = match weights {
                    None => Some(vec![1.0; items.len()]),
                    Some(weights) => numbers(&weights).filter(|weights| {
                        weights.len() == items.len()
                            && weights.iter().all(|weight| *weight >= 0.0)
                            && weights.iter().sum::<f64>() > 0.0
                    }),
                };
                let Some(weights) = weights else { return refuse("a weight not below 0 for each choice, one above 0") };
                let items = items.into_iter().map(Self::read).collect::<Result<Vec<_>, _>>()?;
                Ok(Self::Choice(weights.into_iter().zip(items).collect()))
            }
            (None, None, None, None, None, None, Some(count), Some(of)) => {
                match count.as_u64().filter(|count| *count <= MOST_ITEMS) {
                    Some(count) => Ok(Self::Repeat(count as usize, Box::new(Self::read(of)?))),
                    None => refuse("a count from 0 to 10000 under `repeat`"),
                }
            }
            _ => refuse(FORMS),
        }
    }

    /// A value from a stream.
    pub(super) fn draw(&self, stream: &mut Stream) -> Value {
        match self {
            Self::Fixed(value) => value.clone(),
            Self::Array(items) => items.iter().map(|item| item.draw(stream)).collect(),
            Self::Table(entries) => entries.iter().map(|(key, value)| (key.clone(), value.draw(stream))).collect(),
            Self::Repeat(count, of) => (0..*count).map(|_| of.draw(stream)).collect(),
            Self::Uniform([low, high]) => (low + (high - low) * stream.unit()).into(),
            Self::LogUniform([low, high]) => (low * (high / low).powf(stream.unit())).into(),
            Self::Normal { mean, deviation, within } => {
                let mut normal = || mean + deviation * stream.normal();
                let Some([low, high]) = within else { return normal().into() };
                let inside = (0..MOST_TRIES).map(|_| normal()).find(|drawn| low <= drawn && drawn <= high);
                inside.unwrap_or_else(|| low + (high - low) * stream.unit()).into()
            }
            Self::Choice(items) => {
                let mut left = stream.unit() * items.iter().map(|(weight, _)| weight).sum::<f64>();
                let taken = items.iter().find(|(weight, _)| {
                    left -= weight;
                    left < 0.0
                });
                taken.or(items.last()).map_or(Value::Null, |(_, item)| item.draw(stream))
            }
        }
    }

    /// Values that are drawn at once, at most; an empty array or table counts as one.
    fn values(&self) -> usize {
        let sum =
            |items: &mut dyn Iterator<Item = &Self>| items.fold(0_usize, |sum, of| sum.saturating_add(of.values()));
        let values = match self {
            Self::Array(items) => sum(&mut items.iter()),
            Self::Table(entries) => sum(&mut entries.iter().map(|(_, of)| of)),
            Self::Repeat(count, of) => of.values().saturating_mul(*count),
            Self::Choice(items) => items.iter().map(|(_, of)| of.values()).max().unwrap_or(0),
            Self::Fixed(_) | Self::Uniform(_) | Self::LogUniform(_) | Self::Normal { .. } => 1,
        };
        values.max(1)
    }

    /// As [`read`](Self::read), with a limit of what is drawn.
    fn read_limited(value: Value) -> Result<Self, Refused> {
        let read = Self::read(value)?;
        match read.values() {
            0..=MOST_VALUES => Ok(read),
            values => Err((format!("{values} values"), "at most 100000 values of one key, those of `repeat` counted")),
        }
    }

    /// The least and the largest number that it can draw; of a normal distribution without bounds no bound. `None` if it draws others.
    fn range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Fixed(value) => value.as_f64().map(|value| [value; 2]),
            Self::Uniform(ends) | Self::LogUniform(ends) => Some(*ends),
            Self::Normal { within, .. } => Some(within.unwrap_or([f64::NEG_INFINITY, f64::INFINITY])),
            Self::Choice(items) => items.iter().map(|(_, item)| item.range()).reduce(|one, other| {
                let ([a, b], [c, d]) = (one?, other?);
                Some([a.min(c), b.max(d)])
            })?,
            Self::Array(_) | Self::Table(_) | Self::Repeat(..) => None,
        }
    }
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

fn pair_of(value: &Value) -> Option<[f64; 2]> {
    numbers(value)?.try_into().ok()
}

impl Amount {
    /// A number from a stream.
    pub(super) fn draw(&self, stream: &mut Stream) -> f64 {
        self.0.draw(stream).as_f64().unwrap_or_default()
    }

    /// The least and the largest number that it can draw.
    pub(super) fn range(&self) -> [f64; 2] {
        self.0.range().unwrap_or_default()
    }
}

impl<'de> Deserialize<'de> for Distribution {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let refused = |(found, expected): Refused| D::Error::invalid_value(Unexpected::Other(&found), &expected);
        Self::read_limited(Value::deserialize(from)?).map_err(refused)
    }
}

impl<'de> Deserialize<'de> for Amount {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let value = Value::deserialize(from)?;
        let found = value.to_string();
        let refused = |found: String, expected| D::Error::invalid_value(Unexpected::Other(&found), &expected);
        let read = Distribution::read(value).map_err(|(found, expected)| refused(found, expected))?;
        match read.range() {
            Some(_) => Ok(Self(read)),
            None => Err(refused(found, "a number, or a distribution of numbers")),
        }
    }
}

impl JsonSchema for Distribution {
    fn schema_name() -> Cow<'static, str> {
        "Distribution".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["string", "number", "boolean", "array", "object"] })
    }
}

impl JsonSchema for Amount {
    fn schema_name() -> Cow<'static, str> {
        "Amount".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["number", "object"] })
    }
}

/// A value as TOML has it.
pub(super) fn toml_text(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => format!("{:?}", number.as_f64().unwrap_or_default()),
        Value::Array(items) => format!("[{}]", items.iter().map(toml_text).collect::<Vec<_>>().join(", ")),
        Value::Object(entries) => {
            let entry =
                |(key, value): (&String, &Value)| format!("{} = {}", Value::from(key.as_str()), toml_text(value));
            format!("{{ {} }}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
        // TOML has JSON's texts, numbers and flags; nothing that was read is null
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{Distribution, toml_text};
    use crate::numerics::random::Stream;
    use serde_json::{Value, json};

    fn read(value: Value) -> Distribution {
        Distribution::read(value).unwrap()
    }

    fn drawn(value: Value, count: usize) -> Vec<Value> {
        let (distribution, mut stream) = (read(value), Stream::new(3, [0; 3]));
        (0..count).map(|_| distribution.draw(&mut stream)).collect()
    }

    fn numbers(value: Value) -> Vec<f64> {
        drawn(value, 4000).iter().filter_map(Value::as_f64).collect()
    }

    #[test]
    fn numbers_are_spread_as_named() {
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let uniform = numbers(json!({ "uniform": [-1.0, 3.0] }));
        assert!(uniform.iter().all(|x| (-1.0..=3.0).contains(x)) && (mean(&uniform) - 1.0).abs() < 0.06);
        for [low, high] in [[1e-6, 1e-4], [-1e-4, -1e-6]] {
            let logs: Vec<f64> =
                numbers(json!({ "log_uniform": [low, high] })).iter().map(|x| x.abs().log10()).collect();
            assert!(logs.iter().all(|x| (-6.0..=-4.0).contains(x)) && (mean(&logs) + 5.0).abs() < 0.03);
        }
        let normal = numbers(json!({ "normal": [270, 15], "within": [250, 300] }));
        assert!(normal.iter().all(|x| (250.0..=300.0).contains(x)));
        // so narrow that the normal distribution is even there
        let narrow = numbers(json!({ "normal": [0.0, 1e9], "within": [0.0, 1e-3] }));
        assert!(narrow.iter().all(|x| (0.0..=1e-3).contains(x)) && (mean(&narrow) - 5e-4).abs() < 5e-5);
        let weighted = numbers(json!({ "choice": [1, { "uniform": [5.0, 6.0] }], "weights": [3, 1] }));
        let ones = weighted.iter().filter(|x| **x < 2.0).count() as f64;
        assert!((ones / 4000.0 - 0.75).abs() < 0.03 && weighted.iter().any(|x| *x > 5.0));
    }

    #[test]
    fn arrays_and_tables_hold_what_is_drawn() {
        let value =
            json!([{ "on": "outer", "order": { "choice": [2, 3] } }, { "repeat": 3, "of": { "uniform": [0, 1] } }]);
        let first = &drawn(value, 1)[0];
        assert_eq!(first[0]["on"], "outer");
        assert!([2, 3].contains(&first[0]["order"].as_i64().unwrap()));
        assert_eq!(first[1].as_array().unwrap().len(), 3);
        let text = toml_text(&json!({ "a b": [1, 1.0, 1e-7, "x \"y\"", true], "c": { "d": -2.5 } }));
        assert_eq!(text, r#"{ "a b" = [1, 1.0, 1e-7, "x \"y\"", true], "c" = { "d" = -2.5 } }"#);
    }

    #[test]
    fn what_is_no_distribution_is_refused() {
        for (value, expected) in [
            (json!({ "uniform": [3, 1] }), "two numbers, the lower one first"),
            (json!({ "uniform": [1] }), "two numbers, the lower one first"),
            (json!({ "log_uniform": [0, 1] }), "two numbers of one sign"),
            (json!({ "log_uniform": [-1, 1] }), "two numbers of one sign"),
            (json!({ "normal": [0, -1] }), "a mean, a standard deviation"),
            (json!({ "normal": [0, 1], "within": [1, 2] }), "a mean, a standard deviation"),
            (json!({ "choice": [] }), "one of { uniform"),
            (json!({ "choice": [1, 2], "weights": [1] }), "a weight not below 0"),
            (json!({ "choice": [1], "weights": [0] }), "a weight not below 0"),
            (json!({ "uniform": [1, 2], "normal": [1, 2] }), "one of { uniform"),
            (json!({ "uniform": [1, 2], "within": [1, 2] }), "one of { uniform"),
            (json!({ "uniform": [1, 2], "mean": 1 }), "one of { uniform"),
            (json!({ "repeat": 2 }), "one of { uniform"),
            (json!({ "repeat": -1, "of": 1 }), "a count from 0"),
            (json!([{ "uniform": [3, 1] }]), "two numbers, the lower one first"),
            ((0..60).fold(json!(1), |of, _| json!({ "repeat": 2, "of": of })), "at most 100000 values"),
            (json!({ "repeat": 10000, "of": { "repeat": 11, "of": [] } }), "at most 100000 values"),
        ] {
            let (_, found) = Distribution::read_limited(value.clone()).unwrap_err();
            assert!(found.starts_with(expected), "{value}: {found}");
        }
    }
}
