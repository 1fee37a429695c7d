//! The JSON Schema of the case file, from the types that it is read into: what an editor completes and checks by.
//!
//! Draft 07, which editors of TOML know. Kinds of values, names of keys and options, required keys and keys that exclude each
//! other are in it; ranges and what needs the mesh are for the reader. Whatever the reader takes, the schema takes.
//!
//! **Limitations**: a whole number written as `7.0` is one for JSON Schema, and none for the reader.

mod forms;
mod tidy;

pub(in crate::app) use tidy::in_words;

pub(super) use forms::{any_of, number, one_of, table, text, together, whole, words};

use schemars::generate::SchemaSettings;
use serde_json::Value;

use super::Case;

impl Case {
    /// Returns the JSON Schema (draft 07) of a case file as read from TOML, its paths not resolved.
    #[must_use]
    pub fn schema() -> Value {
        let generator = SchemaSettings::draft07().into_generator();
        let mut schema = generator.into_root_schema_for::<Self>().to_value();
        tidy::tidy(&mut schema);
        if let Some(root) = schema.as_object_mut() {
            root.insert("title".to_owned(), "case file of plummer".into());
        }
        schema
    }
}
