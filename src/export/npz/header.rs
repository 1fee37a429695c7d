//! The header of a `.npy` array.

/// NPY header, version 1.0, padded with spaces to a multiple of 64 bytes and ended by a line feed.
pub(super) fn header(shape: &[usize]) -> Vec<u8> {
    let sizes: String = shape.iter().map(|n| format!("{n}, ")).collect();
    // Python writes a tuple of one as "(3,)" and of two as "(2, 3)".
    let sizes = match shape {
        [one] => format!("{one},"),
        _ => sizes.trim_end_matches(", ").to_owned(),
    };
    let dictionary = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({sizes}), }}");
    let prefix = 10;
    let padded = (prefix + dictionary.len() + 1).next_multiple_of(64) - prefix;
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    header.extend((padded as u16).to_le_bytes());
    header.extend(format!("{dictionary:<width$}\n", width = padded - 1).bytes());
    header
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_aligned_and_exact() {
        let found = header(&[3]);
        assert_eq!(found.len() % 64, 0);
        assert!(found.starts_with(
            b"\x93NUMPY\x01\x00\x76\x00{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }"
        ));
        assert!(found.ends_with(b" \n"));
        assert!(
            header(&[2, 300])
                .windows(19)
                .any(|w| w == b"'shape': (2, 300), ")
        );
    }
}
