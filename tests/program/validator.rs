//! A validator for the keywords of JSON Schema (draft 07) that the schema of the case file uses.

use serde_json::{Map, Value};

/// Keywords that say nothing about validity.
const ANNOTATIONS: [&str; 6] = ["$schema", "definitions", "description", "title", "default", "$comment"];

/// Checks values against a schema; a keyword that it does not know is an error.
pub struct Validator<'a> {
    root: &'a Value,
}

impl<'a> Validator<'a> {
    pub fn new(root: &'a Value) -> Self {
        Self { root }
    }

    /// The first thing that is wrong with the value, and where.
    pub fn check(&self, value: &Value) -> Result<(), String> {
        self.at(self.root, value, "")
    }

    fn at(&self, schema: &Value, value: &Value, path: &str) -> Result<(), String> {
        let keywords = match schema {
            Value::Bool(true) => return Ok(()),
            Value::Bool(false) => return Err(format!("{path}: nothing is valid here")),
            Value::Object(keywords) => keywords,
            other => return Err(format!("{path}: {other} is no schema")),
        };
        keywords.iter().try_for_each(|(keyword, rule)| {
            if ANNOTATIONS.contains(&keyword.as_str()) {
                return Ok(());
            }
            self.keyword(keywords, keyword, rule, value, path)
        })
    }

    fn keyword(
        &self,
        all: &Map<String, Value>,
        keyword: &str,
        rule: &Value,
        value: &Value,
        path: &str,
    ) -> Result<(), String> {
        let wrong = |what: String| Err(format!("{path}: {what}"));
        let list = || rule.as_array().into_iter().flatten();
        let valid = |schema: &&Value| self.at(schema, value, path).is_ok();
        let object = value.as_object();
        let array = value.as_array();
        let limit = rule.as_u64().unwrap_or(0) as usize;
        let holds = match keyword {
            "$ref" => {
                let pointer = rule.as_str().and_then(|text| text.strip_prefix('#'));
                let target = pointer.and_then(|pointer| self.root.pointer(pointer));
                let target = target.ok_or_else(|| format!("{path}: no {rule}"))?;
                return self.at(target, value, path);
            }
            "type" => match rule {
                Value::Array(kinds) => kinds.iter().any(|kind| is_a(value, kind)),
                kind => is_a(value, kind),
            },
            "enum" => list().any(|option| option == value),
            "const" => rule == value,
            "minimum" => value.as_f64().is_none_or(|number| number >= rule.as_f64().unwrap()),
            "minItems" => array.is_none_or(|items| items.len() >= limit),
            "maxItems" => array.is_none_or(|items| items.len() <= limit),
            "maxProperties" => object.is_none_or(|entries| entries.len() <= limit),
            "required" => object.is_none_or(|entries| list().all(|key| entries.contains_key(key.as_str().unwrap()))),
            "dependencies" => object.is_none_or(|entries| {
                let rules = rule.as_object().unwrap().iter();
                let mut asked = rules.filter(|(key, _)| entries.contains_key(*key));
                asked.all(|(_, needed)| {
                    let mut needed = needed.as_array().unwrap().iter();
                    needed.all(|key| entries.contains_key(key.as_str().unwrap()))
                })
            }),
            "items" => {
                let mut items = array.into_iter().flatten().enumerate();
                return items.try_for_each(|(index, item)| self.at(rule, item, &format!("{path}[{index}]")));
            }
            "properties" => {
                let mut given = object.into_iter().flatten();
                return given.try_for_each(|(key, entry)| match rule.get(key) {
                    Some(schema) => self.at(schema, entry, &format!("{path}.{key}")),
                    None => Ok(()),
                });
            }
            "additionalProperties" => {
                let known = |key: &str| all.get("properties").is_some_and(|known| known.get(key).is_some());
                let mut others = object.into_iter().flatten().filter(|(key, _)| !known(key));
                return others.try_for_each(|(key, entry)| self.at(rule, entry, &format!("{path}.{key}")));
            }
            "not" => !valid(&rule),
            "allOf" => return list().try_for_each(|schema| self.at(schema, value, path)),
            "anyOf" => list().any(|schema| valid(&schema)),
            "oneOf" => list().filter(valid).count() == 1,
            other => {
                return wrong(format!("the keyword {other} is not known to this validator"));
            }
        };
        if holds { Ok(()) } else { wrong(format!("{value} breaks {keyword}: {rule}")) }
    }
}

fn is_a(value: &Value, kind: &Value) -> bool {
    match kind.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract().abs() < f64::MIN_POSITIVE),
        "null" => value.is_null(),
        other => panic!("{other} is no kind"),
    }
}
