//! Where a computation tells how far it is.

use crate::files::FileDigest;
use std::path::Path;

/// Where a computation tells how far it is.
pub trait Watch {
    /// A stage begins.
    fn stage(&self, name: &str);
    /// Part of the stage that is done, 0 to 1; the first is where it begins.
    fn fraction(&self, done: f64);
    /// A mesh was read, and this was its content.
    fn read(&self, _file: &FileDigest) {}
    /// The folder that keeps what took long for the next computation, if there is one.
    fn cache(&self) -> Option<&Path> {
        None
    }
    /// What came from there, or did not, in a sentence.
    fn reuse(&self, _sentence: String) {}
}

/// Watches nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn stage(&self, _name: &str) {}
    fn fraction(&self, _done: f64) {}
}
