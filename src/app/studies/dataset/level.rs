//! Where the random numbers of a value come from: its level, the number of the machine, bearing or signal, and its name.

use crate::numerics::random::Stream;
use sha2::{Digest, Sha256};

/// What draws a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    Machine,
    Specimen,
    Signal,
}

/// The random numbers of a name at a place.
pub(super) fn stream(seed: u64, level: Level, index: usize, name: &str) -> Stream {
    let digest = Sha256::digest(name.as_bytes());
    let word = u32::from_le_bytes([digest[0], digest[1], digest[2], digest[3]]);
    // numbers beyond 32 bits are refused with the specification
    Stream::new(seed, [level as u32, index as u32, word])
}

/// A key with `[0]` as `.0`.
pub(super) fn plain_key(key: &str) -> String {
    key.replace('[', ".").replace(']', "")
}
