//! The JSON Schema of the case file, from the types that it is read into: what an editor completes and checks by.
//!
//! Draft 07, which editors of TOML know. Kinds of values, names of keys and options, required keys and keys that exclude each
//! other are in it; ranges and what needs the mesh are for the reader. Whatever the reader takes, the schema takes.
//!
//! **Limitations**: a whole number written as `7.0` is one for JSON Schema, and none for the reader.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use super::Case;

impl Case {
    /// Returns the JSON Schema (draft 07) of a case file as read from TOML, its paths not resolved.
    #[must_use]
    pub fn schema() -> Value {
        file_schema::<Self>("case file of plummer")
    }
}

/// The JSON Schema (draft 07) of a TOML file with a title.
pub(in crate::app) fn file_schema<T: JsonSchema>(title: &str) -> Value {
    let generator = SchemaSettings::draft07().into_generator();
    let mut schema = generator.into_root_schema_for::<T>().to_value();
    tidy(&mut schema);
    if let Some(root) = schema.as_object_mut() {
        root.insert("title".to_owned(), title.into());
    }
    schema
}

/// One of these words.
pub(super) fn words(words: &[&str]) -> Schema {
    json_schema!({ "type": "string", "enum": words })
}

/// Any text.
pub(super) fn text() -> Schema {
    json_schema!({ "type": "string" })
}

/// A number.
pub(super) fn number() -> Schema {
    json_schema!({ "type": "number" })
}

/// A whole number, 0 or more.
pub(super) fn whole() -> Schema {
    json_schema!({ "type": "integer", "minimum": 0 })
}

/// The table that a type is written as.
pub(super) fn table<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    T::json_schema(generator)
}

/// A value of one of these forms, for `read_as`.
pub(super) fn forms(forms: Vec<Schema>) -> impl FnOnce(&mut SchemaGenerator) -> Schema {
    move |_| any_of(&forms)
}

/// A value of one of these forms, or a table.
pub(super) fn or_table<T: JsonSchema>(forms: Vec<Schema>) -> impl FnOnce(&mut SchemaGenerator) -> Schema {
    move |generator| any_of(&[forms, vec![table::<T>(generator)]].concat())
}

/// A value of any of these forms.
pub(super) fn any_of(forms: &[Schema]) -> Schema {
    json_schema!({ "anyOf": forms })
}

/// A table with exactly one of these keys, for `oneOf`.
pub(super) fn one_of(keys: &[&str]) -> Value {
    keys.iter().map(|key| json!({ "required": [key] })).collect()
}

/// A table that has all of these keys, for `not`.
pub(super) fn together(keys: &[&str]) -> Value {
    json!({ "required": keys })
}

/// TOML has no null, and descriptions are in words.
fn tidy(value: &mut Value) {
    in_words(value, "absent");
    in_each(value, &without_null);
}

/// `format` names types of Rust, and descriptions are written for readers of the library, where `none` is `None`.
pub(in crate::app) fn in_words(value: &mut Value, none: &str) {
    in_each(value, &|schema| plain(schema, none));
}

/// Changes every object in a value, from the outside in.
fn in_each(value: &mut Value, change: &impl Fn(&mut Map<String, Value>)) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(|item| in_each(item, change)),
        Value::Object(schema) => {
            change(schema);
            schema.values_mut().for_each(|part| in_each(part, change));
        }
        _ => {}
    }
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
    forms.retain(|form| form.get("type").is_none_or(|kind| kind != "null"));
    if forms.len() == 1
        && let Some(Value::Array(forms)) = schema.remove("anyOf")
    {
        schema.insert("allOf".to_owned(), Value::Array(forms));
    }
}

/// Without links and line ends, `none` in the place of `None`. The schema of a key named `format` is an object, the keyword's value
/// a string: only the keyword goes.
fn plain(schema: &mut Map<String, Value>, none: &str) {
    if schema.get("format").is_some_and(Value::is_string) {
        schema.remove("format");
    }
    if let Some(Value::String(text)) = schema.get_mut("description") {
        let joined = text.split_whitespace().collect::<Vec<_>>().join(" ");
        *text = joined.replace("[`", "`").replace("`]", "`").replace("`None`", none);
    }
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
