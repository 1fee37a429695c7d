//! Pieces of sentences: lists, lengths, directions.

use crate::report::{Fact, given};

/// A fact with several values, one after the other; none without values.
pub(super) fn listed(name: &str, values: impl IntoIterator<Item = String>) -> Option<Fact> {
    let values: Vec<String> = values.into_iter().collect();
    (!values.is_empty()).then(|| Fact::new(name, values.join("; ")))
}

/// Words in a row: "x", "x and y", "x, y and z".
pub(super) fn and(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// A length, m: in mm, below a tenth of it in µm.
pub(super) fn length(metres: f64) -> String {
    if metres == 0.0 || metres.abs() >= 1e-4 {
        format!("{} mm", given(1e3 * metres))
    } else {
        format!("{} \u{b5}m", given(1e6 * metres))
    }
}

/// "along +y", or the components.
pub(super) fn direction_words(vector: &[f64]) -> String {
    let mut along = vector.iter().zip(["x", "y", "z"]).filter(|(part, _)| **part != 0.0);
    match (along.next(), along.next()) {
        (Some((part, axis)), None) => format!("along {}{axis}", if *part > 0.0 { "+" } else { "\u{2212}" }),
        _ => {
            let parts: Vec<String> = vector.iter().map(|part| given(*part)).collect();
            format!("along ({})", parts.join(", "))
        }
    }
}
