//! Where a computation tells how far it is.

use crate::files::FileDigest;
use std::path::Path;

/// Where a computation tells how far it is, also from another thread.
pub trait Watch: Sync {
    /// A stage begins.
    fn stage(&self, name: &str);
    /// Part of the stage that is done, 0 to 1; the first is where it begins.
    fn fraction(&self, done: f64);
    /// What a user should know meanwhile, in a sentence.
    fn note(&self, _sentence: &str) {}
    /// A mesh was read, and this was its content.
    fn read(&self, _file: &FileDigest) {}
    /// The folder that keeps what took long for the next computation, if there is one.
    fn cache(&self) -> Option<&Path> {
        None
    }
    /// What came from there, or did not, in a sentence.
    fn reuse(&self, _sentence: String) {}
}

/// Where a search tells which part of it is done, 0 to 1.
pub(crate) type Told<'a> = &'a (dyn Fn(f64) + Sync);

/// Watches nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn stage(&self, _name: &str) {}
    fn fraction(&self, _done: f64) {}
}
