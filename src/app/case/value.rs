//! Reading one key of a case.

use super::Case;
use super::error::{CaseError, names_help};
use super::tree::{Step, format_path, parse_path};
use serde_json::Value;

impl Case {
    /// Returns the value of a key such as `bearing.defects[0].depth`, defaults filled in; a table for a section. An item of an array is
    /// reached by `[0]` or `.0`.
    ///
    /// # Errors
    /// [`CaseError`] for a key that the case does not have, with the keys that stand there.
    pub fn value(&self, key: &str) -> Result<Value, CaseError> {
        let steps = parse_path(key).ok_or_else(|| {
            CaseError::new(format!(
                "found the key path `{key}`, expected names joined by dots, e.g. `bearing.defects[0].depth`"
            ))
        })?;
        let whole = serde_json::to_value(self)
            .map_err(|error| CaseError::new(format!("the case cannot be written as JSON: {error}")))?;
        let mut value = &whole;
        for (depth, step) in steps.iter().enumerate() {
            let name = match step {
                Step::Key(name) => name.clone(),
                Step::Index(index) => index.to_string(),
            };
            let pointer = format!("/{}", name.replace('~', "~0").replace('/', "~1"));
            value = value.pointer(&pointer).ok_or_else(|| {
                let known: Vec<&str> = match value {
                    Value::Object(table) => table.keys().map(String::as_str).collect(),
                    _ => Vec::new(),
                };
                let found = match value {
                    Value::Array(items) => format!(", an array of {}", items.len()),
                    _ => String::new(),
                };
                let what = format!("the case has no `{}`{found}", format_path(&steps[..=depth]));
                CaseError::new(what).with_help((!known.is_empty()).then(|| names_help(&name, &known, "keys")))
            })?;
        }
        Ok(value.clone())
    }
}

#[cfg(test)]
mod tests {
    use crate::app::case::Case;

    #[test]
    fn a_key_has_its_value_and_a_missing_one_names_those_beside_it() {
        let case = Case::example("tadina2011/outer-dent", &["bearing.defects[0].depth=2e-5"]);
        assert_eq!(case.value("bearing.defects[0].depth").unwrap(), 2e-5);
        assert_eq!(case.value("bearing.defects.0.depth").unwrap(), 2e-5);
        assert_eq!(case.value("condense.enhanced").unwrap(), true);
        let section = case.value("shaft").unwrap();
        assert_eq!(section["mass"], 0.15);
        let wrong = |key: &str| {
            let error = case.value(key).unwrap_err();
            format!("{error}; {}", error.help().unwrap_or_default())
        };
        assert!(wrong("bearing.bals").starts_with("the case has no `bearing.bals`; did you mean `balls`? keys here: "));
        assert_eq!(wrong("bearing.defects[3]"), "the case has no `bearing.defects[3]`, an array of 1; ");
        assert!(wrong("a..b").starts_with("found the key path `a..b`"));
    }
}
