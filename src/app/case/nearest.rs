//! The names that are valid somewhere, and the one nearest to a misspelt one.

/// The names that are valid somewhere.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choices {
    /// The one nearest in spelling to what was found, if any is near.
    pub nearest: Option<String>,
    /// All of them.
    pub valid: Vec<String>,
}

impl Choices {
    /// Collects the valid names and picks the one nearest to what was found.
    pub(super) fn new(found: &str, valid: Vec<String>) -> Self {
        Self { nearest: nearest(found, valid.iter().map(String::as_str)), valid }
    }

    /// "did you mean `x`? keys here: a, b", without the question when nothing is near.
    pub(super) fn help(&self, what: &str) -> String {
        let list = match self.valid.as_slice() {
            [] => format!("there are no {what} here"),
            valid => format!("{what} here: {}", valid.join(", ")),
        };
        match &self.nearest {
            Some(name) => format!("did you mean `{name}`? {list}"),
            None => list,
        }
    }
}

/// Returns the candidate that differs from `found` by the fewest edits, if any is near enough to be meant.
///
/// Edits are insertions, deletions, substitutions and swaps of neighbours, letter case ignored. Near enough: at most
/// one edit and one more for every three letters of `found`. Equal distances: the first candidate.
fn nearest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let wanted = found.to_lowercase();
    let limit = 1 + wanted.chars().count() / 3;
    candidates
        .into_iter()
        .map(|candidate| {
            let edits = strsim::damerau_levenshtein(&wanted, &candidate.to_lowercase());
            (edits, candidate)
        })
        .filter(|&(edits, _)| edits <= limit)
        .min_by_key(|&(edits, _)| edits)
        .map(|(_, candidate)| candidate.to_owned())
}

#[cfg(test)]
mod tests {
    use super::nearest;

    const KEYS: [&str; 4] = ["balls", "ball_radius", "ball_mass", "first_ball_deg"];

    #[test]
    fn a_swap_a_gap_and_a_case_are_forgiven() {
        assert_eq!(nearest("ball_raduis", KEYS).as_deref(), Some("ball_radius"));
        assert_eq!(nearest("Ball", KEYS).as_deref(), Some("balls"));
        assert_eq!(nearest("BALL_MASS", KEYS).as_deref(), Some("ball_mass"));
    }

    #[test]
    fn a_far_name_has_no_neighbour() {
        assert_eq!(nearest("temperature", KEYS), None);
        assert_eq!(nearest("", KEYS), None);
    }
}
