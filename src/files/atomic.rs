//! Files that are whole or not there.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::FileError;

/// A file that is written under a temporary name (`NAME.partial` beside the target) and renamed by
/// [`commit`](Self::commit). Dropped before that, it removes the temporary file and leaves an earlier file alone.
#[derive(Debug)]
pub(crate) struct AtomicFile {
    path: PathBuf,
    partial: PathBuf,
    /// `None` only after `commit`.
    file: Option<BufWriter<File>>,
}

impl AtomicFile {
    /// Begins a file that will be called `path` once committed.
    ///
    /// # Errors
    /// When `path` does not end in a name, or the temporary file cannot be made.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        if path.file_name().is_none() {
            return Err(io::ErrorKind::InvalidFilename.into());
        }
        let partial = Self::partial_of(path);
        // what an ended process left, or a link: neither is written through
        super::remove(&partial)?;
        let file = File::create_new(&partial)?;
        Ok(Self { path: path.to_owned(), partial, file: Some(BufWriter::with_capacity(1 << 18, file)) })
    }

    /// The temporary name of a file.
    pub(crate) fn partial_of(path: &Path) -> PathBuf {
        let mut partial = OsString::from(path);
        partial.push(".partial");
        partial.into()
    }

    /// Brings everything to the disk and gives the file its name, in place of an earlier one.
    ///
    /// # Errors
    /// When writing or renaming fails; the temporary file is then removed.
    pub(crate) fn commit(mut self) -> io::Result<()> {
        let Some(buffer) = self.file.take() else {
            return Ok(());
        };
        let committed = buffer
            .into_inner()
            .map_err(io::IntoInnerError::into_error)
            .and_then(|file| file.sync_all())
            .and_then(|()| fs::rename(&self.partial, &self.path));
        if committed.is_err() {
            // The first failure is the one to tell.
            let _ = fs::remove_file(&self.partial);
        }
        committed
    }

    fn file(&mut self) -> io::Result<&mut BufWriter<File>> {
        self.file.as_mut().ok_or_else(|| io::ErrorKind::NotConnected.into())
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file()?.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file()?.flush()
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.file()?.seek(place)
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            // Nothing to tell anybody from here, and nothing worth flushing; a left-over carries no valid name.
            drop(file.into_parts());
            let _ = fs::remove_file(&self.partial);
        }
    }
}

/// Writes a file by `write`, whole or not at all.
///
/// # Errors
/// [`FileError::Write`] with what `write` returns, or as [`AtomicFile::create`] and [`AtomicFile::commit`]; an earlier file
/// of this name is then as it was.
pub(crate) fn write_atomic(
    path: &Path,
    write: impl FnOnce(&mut AtomicFile) -> io::Result<()>,
) -> Result<(), FileError> {
    let written = AtomicFile::create(path).and_then(|mut file| {
        write(&mut file)?;
        file.commit()
    });
    written.map_err(FileError::write(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_failure_while_writing_leaves_the_earlier_file_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_atomic(&path, |file| file.write_all(b"first")).unwrap();
        let error = write_atomic(&path, |file| {
            file.write_all(b"second")?;
            assert_eq!(names(folder.path()), ["a.txt", "a.txt.partial"]);
            Err(io::ErrorKind::StorageFull.into())
        });
        let full = |error: &io::Error| error.kind() == io::ErrorKind::StorageFull;
        assert!(matches!(error, Err(FileError::Write { path: own, source }) if own == path && full(&source)));
        assert_eq!(names(folder.path()), ["a.txt"]);
        assert_eq!(fs::read(&path).unwrap(), b"first");
    }

    #[test]
    fn a_name_that_is_taken_by_a_folder_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::create_dir_all(path.join("inside")).unwrap();
        assert!(write_atomic(&path, |file| file.write_all(b"text")).is_err());
        assert_eq!(names(folder.path()), ["a.txt"]);
        let error = AtomicFile::create(Path::new("/")).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidFilename);
    }
}
