//! The header of a `.npy` array.

/// NPY header, version 1.0, padded with spaces to a multiple of 64 bytes and ended by a line feed.
pub(super) fn header(type_name: &str, shape: &[usize]) -> Vec<u8> {
    let sizes: String = shape.iter().map(|n| format!("{n}, ")).collect();
    // Python writes a tuple of one as "(3,)" and of two as "(2, 3)".
    let sizes = match shape {
        [one] => format!("{one},"),
        _ => sizes.trim_end_matches(", ").to_owned(),
    };
    let dictionary = format!("{{'descr': '{type_name}', 'fortran_order': False, 'shape': ({sizes}), }}");
    let prefix = 10;
    let padded = (prefix + dictionary.len() + 1).next_multiple_of(64) - prefix;
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    header.extend((padded as u16).to_le_bytes());
    header.extend(format!("{dictionary:<width$}\n", width = padded - 1).bytes());
    header
}

/// What the header of an array says.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// NumPy's name of the type.
    pub(super) type_name: String,
    /// First index fastest.
    pub(super) fortran_order: bool,
    pub(super) shape: Vec<usize>,
}

/// Reads the Python dictionary of a header; the keys may come in any order. `None` if it is none.
pub(super) fn parse(text: &[u8]) -> Option<Header> {
    let text = std::str::from_utf8(text).ok()?;
    let mut rest = text.trim().strip_prefix('{')?.strip_suffix('}')?.trim();
    let (mut type_name, mut fortran_order, mut shape) = (None, None, None);
    while !rest.is_empty() {
        let (key, after) = quoted(rest)?;
        let value = after.trim_start().strip_prefix(':')?.trim_start();
        let after = match key {
            "descr" => {
                let (name, after) = quoted(value)?;
                type_name = Some(name.to_owned());
                after
            }
            "fortran_order" => {
                let (value, after) = match value.strip_prefix("True") {
                    Some(after) => (true, after),
                    None => (false, value.strip_prefix("False")?),
                };
                fortran_order = Some(value);
                after
            }
            "shape" => {
                let (inside, after) = value.strip_prefix('(')?.split_once(')')?;
                let sizes = inside.split(',').map(str::trim);
                let sizes = sizes.filter(|size| !size.is_empty()).map(str::parse);
                shape = Some(sizes.collect::<Result<Vec<usize>, _>>().ok()?);
                after
            }
            _ => return None,
        };
        let after = after.trim_start();
        rest = match after.strip_prefix(',') {
            Some(next) => next.trim_start(),
            None if after.is_empty() => after,
            None => return None,
        };
    }
    Some(Header { type_name: type_name?, fortran_order: fortran_order?, shape: shape? })
}

/// Text in quotation marks of either kind, and what follows it.
fn quoted(text: &str) -> Option<(&str, &str)> {
    match text.strip_prefix('\'') {
        Some(text) => text.split_once('\''),
        None => text.strip_prefix('"')?.split_once('"'),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_aligned_and_exact() {
        let found = header("<f8", &[3]);
        assert_eq!(found.len() % 64, 0);
        assert!(
            found.starts_with(b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }")
        );
        assert!(found.ends_with(b" \n"));
        assert!(header("<i4", &[2, 300]).windows(19).any(|w| w == b"'shape': (2, 300), "));
    }

    #[test]
    fn headers_are_read_in_any_spelling() {
        let sample = |fortran_order, shape: &[usize]| {
            Some(Header { type_name: "<f8".to_owned(), fortran_order, shape: shape.to_vec() })
        };
        for shape in [&[][..], &[3], &[2, 300], &[2, 3, 4]] {
            assert_eq!(parse(&header("<f8", shape)[10..]), sample(false, shape));
        }
        let other = br#"{"shape":( 4 , 5 ), "fortran_order" : True,"descr":"<f8"}  "#;
        assert_eq!(parse(other), sample(true, &[4, 5]));
        for damaged in [
            "",
            "{}",
            "{'descr': '<f8', 'fortran_order': False, }",
            "{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (3,), }",
            "{'descr': '<f8', 'fortran_order': 0, 'shape': (3,), }",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (-3,), }",
            "{'descr': '<f8' 'fortran_order': False, 'shape': (3,), }",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), 'x': 1}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), 'x': }",
        ] {
            assert_eq!(parse(damaged.as_bytes()), None, "{damaged}");
        }
    }
}
