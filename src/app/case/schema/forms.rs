//! Parts of schemas that no type has by itself: values of several forms, keys that exclude each other.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

/// One of these words.
pub(in crate::app::case) fn words(words: &[&str]) -> Schema {
    json_schema!({ "type": "string", "enum": words })
}

/// Any text.
pub(in crate::app::case) fn text() -> Schema {
    json_schema!({ "type": "string" })
}

/// A number.
pub(in crate::app::case) fn number() -> Schema {
    json_schema!({ "type": "number" })
}

/// A whole number, 0 or more.
pub(in crate::app::case) fn whole() -> Schema {
    json_schema!({ "type": "integer", "minimum": 0 })
}

/// The table that a type is written as.
pub(in crate::app::case) fn table<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    T::json_schema(generator)
}

/// A value of any of these forms.
pub(in crate::app::case) fn any_of(forms: &[Schema]) -> Schema {
    json_schema!({ "anyOf": forms })
}

/// A table with exactly one of these keys, for `oneOf`.
pub(in crate::app::case) fn one_of(keys: &[&str]) -> Value {
    keys.iter().map(|key| json!({ "required": [key] })).collect()
}

/// A table that has all of these keys, for `not`.
pub(in crate::app::case) fn together(keys: &[&str]) -> Value {
    json!({ "required": keys })
}
