//! The band of a signal whose envelope is taken.

use std::fmt;

use serde::Serialize;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};

use super::schema::{any_of, words};

/// The word for a band that the signal decides.
const KURTOGRAM: &str = "kurtogram";

/// The band of a signal whose envelope is taken: `[from, to]` or `"kurtogram"`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EnvelopeBand {
    /// The most impulsive band of each window.
    Kurtogram,
    /// From here to there, Hz; 0 < from < to, below half the sampling rate.
    #[serde(untagged)]
    Between([f64; 2]),
}

impl<'de> Deserialize<'de> for EnvelopeBand {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(BandVisitor)
    }
}

impl schemars::JsonSchema for EnvelopeBand {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "EnvelopeBand".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let edges = generator.subschema_for::<[f64; 2]>();
        any_of(&[edges, words(&[KURTOGRAM])])
    }
}

struct BandVisitor;

impl<'de> Visitor<'de> for BandVisitor {
    type Value = EnvelopeBand;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("[from, to] in Hz or \"kurtogram\"")
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
        match word {
            KURTOGRAM => Ok(EnvelopeBand::Kurtogram),
            _ => Err(E::unknown_variant(word, &[KURTOGRAM])),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let mut edges = Vec::new();
        while let Some(edge) = items.next_element()? {
            edges.push(edge);
        }
        <[f64; 2]>::try_from(edges)
            .map(EnvelopeBand::Between)
            .map_err(|edges| de::Error::invalid_length(edges.len(), &self))
    }
}

#[cfg(test)]
mod tests {
    use super::EnvelopeBand;
    use crate::app::case::tests::{FULL, read};

    /// [`FULL`] with a band in the place of its high-pass.
    fn band(text: &str) -> Result<Option<EnvelopeBand>, String> {
        let full = FULL.replace("high_pass_hz = 5000", &format!("band_hz = {text}"));
        let case = read(&full, &[]).map_err(|error| error.to_string())?;
        // the echo that results carry reads back
        let again = serde_json::to_string(&case.analysis).map_err(|error| error.to_string())?;
        assert!(again.contains("\"band_hz\":"), "{again}");
        let again: crate::app::case::Analysis = serde_json::from_str(&again).map_err(|error| error.to_string())?;
        assert_eq!(again, case.analysis);
        Ok(case.analysis.band_hz)
    }

    #[test]
    fn a_band_is_two_edges_or_a_word() {
        const FORMS: &str = "expected [from, to] in Hz or \"kurtogram\"";
        let between = Some(EnvelopeBand::Between([2000.0, 9000.0]));
        assert_eq!(band("[2000, 9e3]"), Ok(between));
        assert_eq!(band("\"kurtogram\""), Ok(Some(EnvelopeBand::Kurtogram)));
        for (text, found) in [
            ("\"kurtgram\"", "`analysis.band_hz` is \"kurtgram\", expected `kurtogram`".to_owned()),
            ("5000", format!("`analysis.band_hz`: found 5000, {FORMS}")),
            ("true", format!("`analysis.band_hz`: found true, {FORMS}")),
            ("[1, 2, 3]", format!("`analysis.band_hz`: found an array of 3, {FORMS}")),
            ("[1]", format!("`analysis.band_hz`: found an array of 1, {FORMS}")),
        ] {
            let error = band(text).unwrap_err();
            assert!(error.ends_with(&found), "{text}: {error}");
        }
    }

    #[test]
    fn a_band_lies_below_half_the_rate_and_takes_the_place_of_the_high_pass() {
        for (text, expected) in [
            ("[0, 9e3]", "`analysis.band_hz[0]`: found 0, expected a number above 0"),
            ("[9e3, 9e3]", "`analysis.band_hz[1]`: found 9000, expected more than the lowest frequency (9000)"),
            ("[2e3, 5e4]", "`analysis.band_hz[1]`: found 50000, expected below half of `transient.output_hz` (50000)"),
            (
                "\"kurtogram\"\nhigh_pass_hz = 5000",
                "`analysis.band_hz`: found beside `analysis.high_pass_hz`, expected one of the two",
            ),
        ] {
            let error = band(text).unwrap_err();
            assert!(error.ends_with(expected), "{text}: {error}");
        }
    }
}
