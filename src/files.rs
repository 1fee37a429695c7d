//! Reading files that a user named: regular ones alone. A device or a pipe in their place could fill the memory or never answer.

use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Opens a regular file.
///
/// # Errors
/// What the system says; [`io::ErrorKind::InvalidInput`] for a folder, a device or a pipe.
pub fn open(path: &Path) -> io::Result<File> {
    let kind = fs::metadata(path)?.file_type();
    if kind.is_file() {
        return File::open(path);
    }
    let found = if kind.is_dir() {
        "a folder"
    } else {
        "a device or a pipe"
    };
    Err(io::Error::new(
        io::ErrorKind::InvalidInput,
        format!("expected a file, found {found}"),
    ))
}

/// The content of a regular file.
///
/// # Errors
/// As [`open`].
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::Read::read_to_end(&mut open(path)?, &mut bytes)?;
    Ok(bytes)
}

/// The text of a regular file, UTF-8.
///
/// # Errors
/// As [`open`], and [`io::ErrorKind::InvalidData`] for what is not UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    io::read_to_string(open(path)?)
}

#[cfg(test)]
mod tests {
    use super::{read, read_text};
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
}
