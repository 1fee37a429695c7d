//! From what Rust's types say to what a TOML file can hold, in words for its writer.

use serde_json::{Map, Value};

/// TOML has no null, and descriptions are in words.
pub(super) fn tidy(value: &mut Value) {
    in_words(value, "absent");
    without_nulls(value);
}

/// `format` names types of Rust, and descriptions are written for readers of the library, where `none` is `None`.
pub(in crate::app) fn in_words(value: &mut Value, none: &str) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(|item| in_words(item, none)),
        Value::Object(schema) => {
            plain(schema, none);
            schema.values_mut().for_each(|part| in_words(part, none));
        }
        _ => {}
    }
}

fn without_nulls(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(without_nulls),
        Value::Object(schema) => {
            without_null(schema);
            schema.values_mut().for_each(without_nulls);
        }
        _ => {}
    }
}

fn is_null(schema: &Value) -> bool {
    schema.get("type").is_some_and(|kind| kind == "null")
}

/// `Option` is a key that may be absent.
fn without_null(schema: &mut Map<String, Value>) {
    if let Some(Value::Array(kinds)) = schema.get_mut("type") {
        kinds.retain(|kind| kind != "null");
        if let [kind] = kinds.as_slice() {
            let kind = kind.clone();
            schema.insert("type".to_owned(), kind);
        }
    }
    if schema.get("default").is_some_and(Value::is_null) {
        schema.remove("default");
    }
    let Some(Value::Array(forms)) = schema.get_mut("anyOf") else {
        return;
    };
    forms.retain(|form| !is_null(form));
    if forms.len() == 1
        && let Some(Value::Array(forms)) = schema.remove("anyOf")
    {
        schema.insert("allOf".to_owned(), Value::Array(forms));
    }
}

/// The schema of a key named `format` is an object, the keyword's value a string: only the keyword goes.
fn plain(schema: &mut Map<String, Value>, none: &str) {
    if schema.get("format").is_some_and(Value::is_string) {
        schema.remove("format");
    }
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = words(text, none);
    }
}

/// Without links and line ends; `none` in the place of `None`.
fn words(text: &str, none: &str) -> String {
    let joined = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let unlinked = joined.replace("[`", "`").replace("`]", "`");
    unlinked.replace("`None`", none)
}

#[cfg(test)]
mod tests {
    use super::tidy;
    use serde_json::json;

    #[test]
    fn what_toml_lacks_goes_and_keys_of_the_same_name_stay() {
        let mut schema = json!({
            "description": "See\n[`Case::title`]; `None`: none.",
            "properties": {
                "format": { "type": ["string", "null"], "default": null, "format": "path" },
                "default": { "anyOf": [{ "$ref": "#/definitions/A" }, { "type": "null" }] },
                "either": { "anyOf": [{ "type": "string" }, { "type": "number", "format": "double" }] },
                "both": { "type": ["string", "number"] },
            }
        });
        tidy(&mut schema);
        assert_eq!(
            schema,
            json!({
                "description": "See `Case::title`; absent: none.",
                "properties": {
                    "format": { "type": "string" },
                    "default": { "allOf": [{ "$ref": "#/definitions/A" }] },
                    "either": { "anyOf": [{ "type": "string" }, { "type": "number" }] },
                    "both": { "type": ["string", "number"] },
                }
            })
        );
    }
}
