//! From the tree to types: a serde deserializer whose errors keep the key path, the place and the names.
//!
//! What the decoder can find wrong, in the words of a case file.

use super::error::{names_help, one_of};
use super::tree::{Mark, Node, Step, Value, format_path};
use serde::de;
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Deserializer, Expected, MapAccess, SeqAccess, Unexpected, Visitor};
use std::collections::btree_map;
use std::{fmt, slice};

impl Node {
    fn wrong_kind(&self, expected: &dyn Expected) -> Fault {
        Fault::wrong(self.describe(), expected).at(self.mark)
    }
}

impl<'de> Deserializer<'de> for &Node {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.value {
            Value::Text(text) => visitor.visit_str(text),
            Value::Integer(number) => visitor.visit_i64(*number),
            Value::Float(number) if number.is_finite() => visitor.visit_f64(*number),
            Value::Float(_) => Err(self.wrong_kind(&"a finite number")),
            Value::Flag(flag) => visitor.visit_bool(*flag),
            Value::Moment(_) => Err(self.wrong_kind(&visitor)),
            Value::List(items) => visitor.visit_seq(Items { items: items.iter(), index: 0 }),
            Value::Table(entries) => visitor.visit_map(Entries { entries: entries.iter(), current: None }),
        }
        .map_err(|fault| fault.at(self.mark))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _name: &'static str, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        match &self.value {
            Value::List(items) if items.len() == length => self.deserialize_any(visitor),
            _ => Err(self.wrong_kind(&format!("an array of {length}").as_str())),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match &self.value {
            Value::Table(_) => self.deserialize_any(visitor),
            _ => Err(self.wrong_kind(&"a table")),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match &self.value {
            Value::Text(text) => {
                visitor.visit_enum(StrDeserializer::<Fault>::new(text)).map_err(|fault| fault.at(self.mark))
            }
            _ => Err(self.wrong_kind(&one_of(variants).as_str())),
        }
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf
        unit unit_struct seq tuple_struct map identifier ignored_any
    }
}

struct Items<'a> {
    items: slice::Iter<'a, Node>,
    index: usize,
}

impl<'de> SeqAccess<'de> for Items<'_> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        let Some(item) = self.items.next() else {
            return Ok(None);
        };
        let step = Step::Index(self.index);
        self.index += 1;
        seed.deserialize(item).map(Some).map_err(|fault| fault.at(item.mark).under(step))
    }
}

struct Entries<'a> {
    entries: btree_map::Iter<'a, String, Node>,
    current: Option<(&'a String, &'a Node)>,
}

impl<'de> MapAccess<'de> for Entries<'_> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        self.current = self.entries.next();
        let Some((key, node)) = self.current else {
            return Ok(None);
        };
        seed.deserialize(StrDeserializer::<Fault>::new(key))
            .map(Some)
            .map_err(|fault| fault.at(node.mark).under(Step::Key(key.clone())))
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Fault> {
        let Some((key, node)) = self.current else {
            return Err(Fault::wrong("no key".to_owned(), &"a key before a value"));
        };
        seed.deserialize(node).map_err(|fault| fault.at(node.mark).under(Step::Key(key.clone())))
    }
}

/// What does not fit, and where on the way down from the root.
#[derive(Debug, Default)]
pub(super) struct Fault {
    /// From the value up to the root.
    upward: Vec<Step>,
    pub(super) mark: Option<Mark>,
    /// What is said before the key's path.
    pub(super) before: &'static str,
    /// What is said after it.
    pub(super) after: String,
    pub(super) help: Option<String>,
    /// The keys or names that are valid in the place of an unknown one.
    pub(super) valid: &'static [&'static str],
}

impl Fault {
    pub(super) fn wrong(found: String, expected: &dyn Expected) -> Self {
        Self { after: format!(": found {found}, expected {}", plain(&expected.to_string())), ..Self::default() }
    }

    /// Notes the place, unless a deeper one is known.
    pub(super) fn at(mut self, mark: Mark) -> Self {
        self.mark.get_or_insert(mark);
        self
    }

    pub(super) fn under(mut self, step: Step) -> Self {
        self.upward.push(step);
        self
    }

    /// Returns the path from the root down.
    pub(super) fn key(&self) -> String {
        let steps: Vec<Step> = self.upward.iter().rev().cloned().collect();
        format_path(&steps)
    }
}

/// Puts serde's names of kinds into words of a case file.
fn plain(expected: &str) -> String {
    match expected {
        "f64" => "a number",
        "usize" | "u64" => "a whole number, 0 or more",
        "a boolean" => "true or false",
        "a sequence" => "an array",
        "a map" => "a table",
        "path string" => "a string",
        other if other.starts_with("struct ") => "a table",
        other => other,
    }
    .to_owned()
}

fn describe(found: &Unexpected<'_>) -> String {
    match found {
        Unexpected::Bool(flag) => flag.to_string(),
        Unexpected::Unsigned(number) => number.to_string(),
        Unexpected::Signed(number) => number.to_string(),
        Unexpected::Float(number) => number.to_string(),
        Unexpected::Str(text) => format!("\"{text}\""),
        Unexpected::Seq => "an array".to_owned(),
        Unexpected::Map => "a table".to_owned(),
        Unexpected::Other(text) => (*text).to_owned(),
        other => other.to_string(),
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}`{}`{}", self.before, self.key(), self.after)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::wrong(message.to_string(), &"a value of this key")
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::wrong(describe(&found), expected)
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::wrong(describe(&found), expected)
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::wrong(format!("an array of {length}"), expected)
    }

    fn unknown_variant(found: &str, valid: &'static [&'static str]) -> Self {
        let after = format!(" is \"{found}\", expected {}", one_of(valid));
        Self { after, help: Some(names_help(found, valid, "names")), valid, ..Self::default() }
    }

    fn unknown_field(found: &str, valid: &'static [&'static str]) -> Self {
        Self { before: "unknown key ", help: Some(names_help(found, valid, "keys")), valid, ..Self::default() }
    }

    fn missing_field(key: &'static str) -> Self {
        Self { after: format!(" lacks the required key `{key}`"), ..Self::default() }
    }
}
