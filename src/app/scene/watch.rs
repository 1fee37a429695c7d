//! Where a computation tells how far it is.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where a computation tells how far it is.
pub trait Watch {
    /// A stage begins.
    fn stage(&self, name: &str);
    /// Part of the stage that is done, 0 to 1; the first is where it begins.
    fn fraction(&self, done: f64);
    /// A mesh was read, and this was its content.
    fn read(&self, _file: &MeshDigest) {}
}

/// Watches nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn stage(&self, _name: &str) {}
    fn fraction(&self, _done: f64) {}
}

/// A file that a case rests on, mostly a mesh, and the SHA-256 of its bytes (FIPS 180-4), as `sha256sum` prints it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct MeshDigest {
    /// The file, as the case names it from where the program was called.
    pub path: PathBuf,
    /// 64 hexadecimal digits.
    pub sha256: String,
}
