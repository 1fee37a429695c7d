//! Folders for factors out of core, removed when the factor is dropped, and when the program is interrupted.

use super::super::LinalgError;
use super::ffi::LONGEST_PATH;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::DirBuilderExt;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Those that are there.
static FOLDERS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Where they are made: MUMPS's own variable says it, or the system's.
pub(super) fn root() -> PathBuf {
    std::env::var_os("MUMPS_OOC_TMPDIR").filter(|name| !name.is_empty()).map_or_else(std::env::temp_dir, PathBuf::from)
}

/// A folder of its own for one factor.
#[derive(Debug)]
pub(super) struct Folder(PathBuf);

impl Folder {
    /// Makes one that no other user can read.
    ///
    /// # Errors
    /// [`LinalgError::Refused`] if it cannot be made, or its path is too long for MUMPS.
    pub(super) fn new() -> Result<Self, LinalgError> {
        static MADE: AtomicUsize = AtomicUsize::new(0);
        let number = MADE.fetch_add(1, Ordering::Relaxed);
        let path = root().join(format!("plummer-factor-{}-{number}", std::process::id()));
        let refused = |why: String| {
            let path = path.display();
            LinalgError::Refused(format!(
                "the folder {path} for a factor out of core cannot be used: {why}; set MUMPS_OOC_TMPDIR to a folder that can be written"
            ))
        };
        if path.as_os_str().len() > LONGEST_PATH {
            return Err(refused(format!("its name is longer than {LONGEST_PATH} bytes")));
        }
        fs::DirBuilder::new().mode(0o700).create(&path).map_err(|error| refused(error.to_string()))?;
        FOLDERS.lock().unwrap_or_else(PoisonError::into_inner).push(path.clone());
        Ok(Self(path))
    }

    /// Its path.
    pub(super) fn bytes(&self) -> &[u8] {
        self.0.as_os_str().as_bytes()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        FOLDERS.lock().unwrap_or_else(PoisonError::into_inner).retain(|path| *path != self.0);
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Removes all of them.
pub(super) fn remove_all() {
    for path in FOLDERS.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        let _ = fs::remove_dir_all(path);
    }
}
