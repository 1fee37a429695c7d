//! Files told apart by their content.

use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::open;

/// A file that a case rests on, mostly a mesh, and the SHA-256 of its bytes (FIPS 180-4), as `sha256sum` prints it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FileDigest {
    /// The file, as the case names it from where the program was called.
    pub path: PathBuf,
    /// 64 hexadecimal digits.
    pub sha256: String,
}

impl FileDigest {
    /// The digest of a file.
    ///
    /// # Errors
    /// What the system says when the file cannot be read.
    pub fn of_file(path: &Path) -> io::Result<Self> {
        Ok(Self { path: path.to_owned(), sha256: hex(sha256(open(path)?)?) })
    }

    /// The digest of a file's content that is at hand.
    #[must_use]
    pub(crate) fn of_bytes(path: &Path, bytes: &[u8]) -> Self {
        Self { path: path.to_owned(), sha256: hex(Sha256::new_with_prefix(bytes)) }
    }
}

/// SHA-256 (FIPS 180-4) of what a reader gives, to which more can be added.
///
/// # Errors
/// What the system says.
pub fn sha256(reader: impl io::Read) -> io::Result<Sha256> {
    let mut hasher = Sha256::new();
    let mut reader = BufReader::with_capacity(1 << 16, reader);
    loop {
        let piece = reader.fill_buf()?;
        if piece.is_empty() {
            return Ok(hasher);
        }
        hasher.update(piece);
        let read = piece.len();
        reader.consume(read);
    }
}

/// A digest as 64 hexadecimal digits, as `sha256sum` prints it.
pub fn hex(hasher: Sha256) -> String {
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
