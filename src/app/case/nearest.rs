//! The names that are valid somewhere, and the one nearest to a misspelt one.

/// "did you mean `x`? keys here: a, b", without the question when nothing is near; `what` is their kind in the plural.
pub(super) fn names_help(found: &str, valid: &[&str], what: &str) -> String {
    let list = match valid {
        [] => format!("there are no {what} here"),
        valid => format!("{what} here: {}", valid.join(", ")),
    };
    match nearest(found, valid.iter().copied()) {
        Some(name) => format!("did you mean `{name}`? {list}"),
        None => list,
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
