//! Writes arrays into an archive.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::header::header;
use super::{NpzArray, NpzElement, NpzError};
use crate::files::AtomicFile;

/// Whether an array may be called this: letters, digits, `_`, `-`, `.` and spaces, at least one of them.
///
/// ```
/// use plummer::formats::is_array_name;
/// assert!(is_array_name("P1 oben") && !is_array_name("a/b"));
/// ```
#[must_use]
pub fn is_array_name(name: &str) -> bool {
    let allowed = |c: char| c.is_alphanumeric() || "_-. ".contains(c);
    !name.is_empty() && name.chars().all(allowed)
}

/// Writes an archive under a temporary name (`NAME.npz.partial` beside the target) and renames it in
/// [`finish`](Self::finish); dropped before that, it removes the temporary file and leaves an earlier archive alone.
/// The same arrays give the same bytes.
///
/// ```
/// use plummer::formats::NpzWriter;
/// let path = std::env::temp_dir().join("plummer-doc.npz");
/// let mut npz = NpzWriter::create(&path)?;
/// npz.array("time_s", &[0.0, 0.5, 1.0])?;
/// npz.matrix("ball_radius", 2, 3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?;
/// npz.finish()?;
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), plummer::formats::NpzError>(())
/// ```
#[derive(Debug)]
pub struct NpzWriter {
    partial: PathBuf,
    /// `None` only after `finish`.
    archive: Option<ZipWriter<AtomicFile>>,
    names: Vec<String>,
    /// Array begun and not ended.
    pub(super) incomplete: Option<String>,
}

impl NpzWriter {
    /// Begins an archive that will be called `path` once finished.
    ///
    /// # Errors
    /// [`NpzError::Io`] if the temporary file cannot be made.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, NpzError> {
        let path = path.as_ref();
        let partial = AtomicFile::partial_of(path);
        let file = AtomicFile::create(path).map_err(|source| NpzError::Io {
            path: partial.clone(),
            source,
        })?;
        Ok(Self {
            partial,
            archive: Some(ZipWriter::new(file)),
            names: Vec::new(),
            incomplete: None,
        })
    }

    /// Writes a one-dimensional array.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    pub fn array<T: NpzElement>(&mut self, name: &str, values: &[T]) -> Result<(), NpzError> {
        let mut array = self.begin(name, &[values.len()])?;
        array.extend(values)?;
        array.end()
    }

    /// Writes a matrix of `rows` x `columns`, `values` row by row (C order).
    ///
    /// # Errors
    /// As [`begin`](Self::begin), and [`NpzError::Shape`] unless there are rows x columns values.
    pub fn matrix<T: NpzElement>(
        &mut self,
        name: &str,
        rows: usize,
        columns: usize,
        values: &[T],
    ) -> Result<(), NpzError> {
        let mut array = self.begin(name, &[rows, columns])?;
        array.extend(values)?;
        array.end()
    }

    /// Begins an array of a known shape whose values come in pieces, last index fastest (C order).
    ///
    /// # Errors
    /// [`NpzError::Name`], [`NpzError::Duplicate`], [`NpzError::Incomplete`] if an earlier array is, [`NpzError::Io`],
    /// [`NpzError::Archive`].
    pub fn begin<T: NpzElement>(
        &mut self,
        name: &str,
        shape: &[usize],
    ) -> Result<NpzArray<'_, T>, NpzError> {
        let expected = shape.iter().product();
        self.start(name, &header(T::TYPE, shape), expected * T::BYTES)?;
        Ok(NpzArray::new(self, name, shape, expected))
    }

    /// Writes a one-dimensional array of text (NumPy `<U`), each as long as the longest.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    pub fn texts(&mut self, name: &str, values: &[&str]) -> Result<(), NpzError> {
        let lengths = values.iter().map(|text| text.chars().count());
        // NumPy has no text of length 0
        let length = lengths.max().unwrap_or(0).max(1);
        let head = header(&format!("<U{length}"), &[values.len()]);
        self.start(name, &head, 4 * length * values.len())?;
        for text in values {
            let padded = text.chars().map(u32::from).chain(std::iter::repeat(0));
            let bytes: Vec<u8> = padded.take(length).flat_map(u32::to_le_bytes).collect();
            self.write(&bytes)?;
        }
        self.incomplete = None;
        Ok(())
    }

    /// Writes a single string of bytes (NumPy `|S`, an array without dimensions).
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    pub fn bytes(&mut self, name: &str, value: &[u8]) -> Result<(), NpzError> {
        // NumPy has no string of length 0
        let length = value.len().max(1);
        self.start(name, &header(&format!("|S{length}"), &[]), length)?;
        let mut padded = value.to_vec();
        padded.resize(length, 0);
        self.write(&padded)?;
        self.incomplete = None;
        Ok(())
    }

    /// Begins an entry whose values, `length` bytes, will follow its header.
    fn start(&mut self, name: &str, header: &[u8], length: usize) -> Result<(), NpzError> {
        if !is_array_name(name) {
            return Err(NpzError::Name { name: name.into() });
        }
        if self.names.iter().any(|n| n == name) {
            return Err(NpzError::Duplicate { name: name.into() });
        }
        self.check_complete()?;
        self.names.push(name.to_owned());
        self.incomplete = Some(name.to_owned());
        // ZIP counts in 32 bits unless told otherwise.
        let bytes = header.len() as u64 + length as u64;
        let options = SimpleFileOptions::DEFAULT
            .compression_method(CompressionMethod::Stored)
            .large_file(bytes > u64::from(u32::MAX) - (1 << 16));
        let path = self.partial.clone();
        self.archive()?
            .start_file(format!("{name}.npy"), options)
            .map_err(|source| NpzError::Archive { path, source })?;
        self.write(header)
    }

    /// Completes the archive and gives it its name, in place of an earlier one.
    ///
    /// # Errors
    /// [`NpzError::Incomplete`], [`NpzError::Io`], [`NpzError::Archive`]; the temporary file is then removed.
    pub fn finish(mut self) -> Result<(), NpzError> {
        self.check_complete()?;
        let partial = self.partial.clone();
        let Some(archive) = self.archive.take() else {
            return Ok(());
        };
        let file = archive.finish().map_err(|source| NpzError::Archive {
            path: partial.clone(),
            source,
        })?;
        file.commit().map_err(|source| NpzError::Io {
            path: partial,
            source,
        })
    }

    fn check_complete(&self) -> Result<(), NpzError> {
        match &self.incomplete {
            Some(name) => Err(NpzError::Incomplete { name: name.clone() }),
            None => Ok(()),
        }
    }

    fn archive(&mut self) -> Result<&mut ZipWriter<AtomicFile>, NpzError> {
        let path = &self.partial;
        self.archive.as_mut().ok_or_else(|| NpzError::Io {
            path: path.clone(),
            source: io::ErrorKind::NotConnected.into(),
        })
    }

    pub(super) fn write(&mut self, bytes: &[u8]) -> Result<(), NpzError> {
        let path = self.partial.clone();
        self.archive()?
            .write_all(bytes)
            .map_err(|source| NpzError::Io { path, source })
    }
}
