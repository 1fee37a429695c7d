//! One process at a time writes into a folder.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The folders that this process holds: a lock ends with the process, however it ends.
static HELD: Mutex<Vec<(PathBuf, File)>> = Mutex::new(Vec::new());

/// Takes a folder for this process until it ends, by `flock` on the folder itself. Returns whether no other process has it.
///
/// A file system that knows no locks gives none: the folder is then taken without.
///
/// # Errors
/// What the system says when the folder cannot be opened.
pub(super) fn take(folder: &Path) -> io::Result<bool> {
    let path = folder.canonicalize()?;
    let mut held = HELD.lock().unwrap_or_else(PoisonError::into_inner);
    if held.iter().any(|(other, _)| *other == path) {
        return Ok(true);
    }
    let file = File::open(&path)?;
    match file.try_lock() {
        Ok(()) => {
            held.push((path, file));
            Ok(true)
        }
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(_)) => Ok(true),
    }
}

/// Whether another process has a folder now.
pub(super) fn is_taken(folder: &Path) -> bool {
    let Ok(file) = File::open(folder) else {
        return false;
    };
    // the lock ends with the file
    matches!(file.try_lock(), Err(TryLockError::WouldBlock))
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::{is_taken, take};

    #[test]
    fn a_folder_is_taken_once_until_its_lock_ends() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        assert!(!is_taken(path));
        // as another process would
        let other = File::open(path).unwrap();
        other.lock().unwrap();
        assert!(is_taken(path));
        assert!(!take(path).unwrap());
        drop(other);
        assert!(take(path).unwrap());
        assert!(is_taken(path));
        // what this process has it may take again, by any name
        assert!(take(&path.join(".")).unwrap());
        assert!(take(&path.join("nothing")).is_err());
    }
}
