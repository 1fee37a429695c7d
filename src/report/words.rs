//! Sizes, masses and counts as one says them: "120 x 80 x 30 mm", "0.62 kg", "1 path".

use super::number::trimmed;

/// Sides (m) of a box in the one unit that suits the longest, those of length zero left out; up to 4 digits each.
pub(crate) fn size_in_words(sides: [f64; 3]) -> String {
    let longest = sides.into_iter().fold(0.0, f64::max);
    let (unit, metres) = match longest {
        10.0.. => ("m", 1.0),
        1e-3.. => ("mm", 1e-3),
        _ => ("µm", 1e-6),
    };
    let sides = sides.into_iter().filter(|side| *side > 1e-9 * longest);
    let sides: Vec<String> = sides.map(|side| trimmed(side / metres, 4)).collect();
    format!("{} {unit}", sides.join(" x "))
}

/// A mass (kg) in kg, or in t or g where it is far from one, with at most so many digits.
pub(crate) fn mass_in_words(kilograms: f64, digits: usize) -> String {
    let (unit, kilogram) = match kilograms {
        1e4.. => ("t", 1e-3),
        0.1.. => ("kg", 1.0),
        1e-6.. => ("g", 1e3),
        _ => ("kg", 1.0),
    };
    format!("{} {unit}", trimmed(kilograms * kilogram, digits))
}

/// "1 path", "2 paths", "3 frequencies".
pub(crate) fn counted(count: usize, what: &str) -> String {
    match (count, what.strip_suffix('y')) {
        (1, _) => format!("1 {what}"),
        (_, Some(stem)) => format!("{count} {stem}ies"),
        (_, None) => format!("{count} {what}s"),
    }
}

/// Lines of at most so many characters, of a word at least each.
pub(crate) fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = &mut lines[0];
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= most {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.insert(0, word.to_owned());
        }
    }
    lines.reverse();
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_as_long_as_they_may_be() {
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(wrapped("one two three", 6), ["one", "two", "three"]);
        assert_eq!(wrapped("one  extraordinary µ-word", 6), ["one", "extraordinary", "µ-word"]);
        assert_eq!(wrapped("", 6), [""]);
    }

    #[test]
    fn sizes_and_masses_are_said() {
        for (sides, words) in [
            ([0.12, 0.08, 0.03], "120 x 80 x 30 mm"),
            ([0.018, 0.018, 0.0], "18 x 18 mm"),
            ([1.2345, 0.5, 1e-3], "1234 x 500 x 1 mm"),
            ([120.0, 80.0, 0.5], "120 x 80 x 0.5 m"),
            ([1.2e-4, 8e-5, 3e-5], "120 x 80 x 30 µm"),
        ] {
            assert_eq!(size_in_words(sides), words);
        }
        for (mass, words) in [
            (0.62, "0.62 kg"),
            (0.0345, "34.5 g"),
            (1250.0, "1250 kg"),
            (6.3e8, "630\u{202f}000 t"),
            (6e-13, "6·10⁻¹³ kg"),
        ] {
            assert_eq!(mass_in_words(mass, 3), words);
        }
        let words = [counted(1, "path"), counted(2, "path"), counted(3, "frequency")];
        assert_eq!(words, ["1 path", "2 paths", "3 frequencies"]);
    }
}
