//! Files that a user named, read: regular ones alone, since a device or a pipe could fill the memory or never answer. Folders for
//! results, made: no symbolic links, since these could lead elsewhere.

mod atomic;
mod digest;
mod error;

pub(crate) use atomic::{AtomicFile, write_atomic};
pub use digest::{FileDigest, hex, sha256};
pub use error::{Fault, FileError, Place};

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Opens a regular file.
///
/// # Errors
/// What the system says; [`io::ErrorKind::InvalidInput`] for a folder, a device or a pipe.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    let kind = fs::metadata(path)?.file_type();
    if kind.is_file() {
        return File::open(path);
    }
    let found = if kind.is_dir() { "a folder" } else { "a device or a pipe" };
    Err(io::Error::new(io::ErrorKind::InvalidInput, format!("expected a file, found {found}")))
}

/// The content of a regular file.
///
/// # Errors
/// As [`open`].
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::Read::read_to_end(&mut open(path)?, &mut bytes)?;
    Ok(bytes)
}

/// The content of a regular file.
///
/// # Errors
/// [`FileError::Read`].
pub(crate) fn bytes_of(path: &Path) -> Result<Vec<u8>, FileError> {
    read(path).map_err(FileError::read(path))
}

/// The text of a regular file, UTF-8.
///
/// # Errors
/// As [`open`], and [`io::ErrorKind::InvalidData`] for what is not UTF-8.
pub(crate) fn read_text(path: &Path) -> io::Result<String> {
    io::read_to_string(open(path)?)
}

/// Removes a file, or the link in its place, if there is one.
///
/// # Errors
/// What the system says.
pub(crate) fn remove(path: &Path) -> io::Result<()> {
    fs::remove_file(path).or_else(|error| if error.kind() == io::ErrorKind::NotFound { Ok(()) } else { Err(error) })
}

/// Checks that no symbolic link stands at a path; nothing may.
///
/// # Errors
/// [`io::ErrorKind::InvalidInput`] for a link.
pub(crate) fn no_link(path: &Path) -> io::Result<()> {
    if path.is_symlink() {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "expected no symbolic link, which could lead out of the folder for results",
        ));
    }
    Ok(())
}

/// Makes the folder `name`, and those between, below the folder `root`.
///
/// # Errors
/// What the system says; [`io::ErrorKind::InvalidInput`] if one of them is a symbolic link.
pub(crate) fn make_below(root: &Path, name: &Path) -> io::Result<PathBuf> {
    let mut path = root.to_owned();
    for part in name {
        path.push(part);
        no_link(&path)?;
    }
    fs::create_dir_all(&path)?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::{make_below, read, read_text};
    use std::path::Path;

    #[test]
    fn files_are_read_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.txt");
        std::fs::write(&file, "2 µm").unwrap();
        assert_eq!(read_text(&file).unwrap(), "2 µm");
        assert_eq!(read(&file).unwrap(), "2 µm".as_bytes());
        let told = |path: &Path| read(path).unwrap_err().to_string();
        assert_eq!(told(folder.path()), "expected a file, found a folder");
        let device = Path::new("/dev/zero");
        assert_eq!(told(device), "expected a file, found a device or a pipe");
        assert!(told(&folder.path().join("b")).starts_with("No such file"));
        std::fs::write(&file, b"\xff").unwrap();
        assert!(read_text(&file).is_err());
    }

    #[test]
    fn folders_are_made_through_no_link() {
        let folder = tempfile::tempdir().unwrap();
        let (root, elsewhere) = (folder.path().join("out"), folder.path().join("elsewhere"));
        std::fs::create_dir_all(&elsewhere).unwrap();
        let made = make_below(&root, Path::new("a/b")).unwrap();
        assert!(made.is_dir() && made == root.join("a/b"));
        std::os::unix::fs::symlink(&elsewhere, root.join("c")).unwrap();
        for name in ["c", "c/d"] {
            let error = make_below(&root, Path::new(name)).unwrap_err();
            assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
        }
        assert_eq!(elsewhere.read_dir().unwrap().count(), 0);
    }
}
