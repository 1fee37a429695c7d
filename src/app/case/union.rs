//! Values that take one of several forms in the file: a word, a number or a table; one of several keys.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Unexpected, Visitor};

/// The error of a table that lacks a key which its other keys need.
pub(super) fn missing<E: de::Error>(key: &'static str) -> E {
    E::missing_field(key)
}

/// The keys of a form by their names, and whether each is given.
macro_rules! given {
    ($form:ident: $($key:ident),+) => {
        [$((stringify!($key), $form.$key.is_some())),+]
    };
}
pub(super) use given;

/// The error for another kind of value, or a combination of keys that excludes itself.
pub(super) fn mismatch<E: de::Error>(found: impl AsRef<str>, expected: &'static str) -> E {
    E::invalid_value(Unexpected::Other(found.as_ref()), &expected)
}

/// The one value that several keys give; `expected` says which keys there are.
pub(super) fn exactly_one<T, E: de::Error>(
    values: impl IntoIterator<Item = Option<T>>,
    expected: &'static str,
) -> Result<T, E> {
    let mut given = values.into_iter().flatten();
    match (given.next(), given.next()) {
        (Some(value), None) => Ok(value),
        (None, _) => Err(mismatch("none of them", expected)),
        _ => Err(mismatch("several", expected)),
    }
}

/// Refuses the first of these keys that is given beside something that excludes it.
pub(super) fn none_beside<E: de::Error>(keys: &[(&str, bool)], other: &str, expected: &'static str) -> Result<(), E> {
    match keys.iter().find(|(_, given)| *given) {
        Some((key, _)) => Err(mismatch(format!("`{key}` beside {other}"), expected)),
        None => Ok(()),
    }
}

/// Reads a type by way of the type that mirrors its form in the file: what serde derives for flattened and untagged types loses the
/// place of an error, the path of its key and the names that are valid there. The function makes the value, or refuses the form: another
/// kind of value, keys that exclude each other or need another. The type's schema is that of the form, or what the third argument
/// returns for a form whose type does not say it.
macro_rules! read_as {
    ($type:ty, $form:ty, |$value:ident| $read:expr) => {
        crate::app::case::union::read_as!($type, $form, crate::app::case::schema::table::<$form>, |$value| $read);
    };
    ($type:ty, $form:ty, $schema:expr, |$value:ident| $read:expr) => {
        impl schemars::JsonSchema for $type {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($type).into()
            }

            fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $schema(generator)
            }
        }

        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                let $value = <$form as serde::Deserialize>::deserialize(from)?;
                $read
            }
        }
    };
}
pub(super) use read_as;

/// Reads and writes a type by way of its form: as [`read_as`], and `From<Type>`.
macro_rules! written_as {
    ($type:ty, $form:ty, $($read:tt)+) => {
        crate::app::case::union::read_as!($type, $form, $($read)+);

        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                serde::Serialize::serialize(&<$form>::from(self.clone()), to)
            }
        }
    };
}
pub(super) use written_as;

/// A value whose kind decides what it means; `T` is the table's type.
#[derive(Debug, serde::Serialize)]
#[serde(untagged)]
pub(super) enum Loose<T> {
    Word(String),
    Whole(usize),
    Number(f64),
    Table(T),
    /// A kind that no key of this sort takes, named.
    Other(String),
}

impl<T> Loose<T> {
    /// The error for a form that the key does not take; it takes these words.
    pub(super) fn mismatch<E: de::Error>(self, valid: &'static [&'static str], expected: &'static str) -> E {
        let found = match self {
            Self::Word(found) if !valid.is_empty() => return E::unknown_variant(&found, valid),
            Self::Word(word) => format!("\"{word}\""),
            Self::Whole(number) => number.to_string(),
            Self::Number(number) => number.to_string(),
            Self::Table(_) => "a table".to_owned(),
            Self::Other(kind) => kind,
        };
        mismatch(found, expected)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Loose<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(LooseVisitor(PhantomData))
    }
}

struct LooseVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for LooseVisitor<T> {
    type Value = Loose<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a word, a number or a table")
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
        Ok(Loose::Word(word.to_owned()))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Self::Value, E> {
        // a negative number is refused whatever its last digits
        Ok(usize::try_from(number).map_or(Loose::Number(number as f64), Loose::Whole))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Self::Value, E> {
        // Beyond 2^53 no key has a use for it.
        Ok(usize::try_from(number).map_or(Loose::Number(number as f64), Loose::Whole))
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Self::Value, E> {
        Ok(Loose::Number(number))
    }

    fn visit_bool<E: de::Error>(self, flag: bool) -> Result<Self::Value, E> {
        Ok(Loose::Other(flag.to_string()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, _items: A) -> Result<Self::Value, A::Error> {
        Ok(Loose::Other("an array".to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(entries)).map(Loose::Table)
    }
}

/// The table of a [`Loose`] value that takes none: whatever is in it, the value is refused as a table.
#[derive(Debug, serde::Deserialize)]
pub(super) struct NoTable {}

// A number, or three for the directions; what a key says of it is in the schema, not this.
#[derive(Debug, Clone, Copy, PartialEq, schemars::JsonSchema)]
#[schemars(inline, untagged)]
pub(super) enum OneOrThree {
    One(f64),
    Three([f64; 3]),
}

impl<'de> Deserialize<'de> for OneOrThree {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(OneOrThreeVisitor)
    }
}

struct OneOrThreeVisitor;

impl<'de> Visitor<'de> for OneOrThreeVisitor {
    type Value = OneOrThree;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a number or an array of three")
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Self::Value, E> {
        Ok(OneOrThree::One(number as f64))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Self::Value, E> {
        Ok(OneOrThree::One(number as f64))
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Self::Value, E> {
        Ok(OneOrThree::One(number))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = items.next_element()? {
            numbers.push(number);
        }
        <[f64; 3]>::try_from(numbers)
            .map(OneOrThree::Three)
            .map_err(|numbers| de::Error::invalid_length(numbers.len(), &self))
    }
}
