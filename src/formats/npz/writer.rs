//! Writes arrays into an archive.
//!
//! Sparse matrices as SciPy keeps them.

use super::super::FormatError;
use super::header::header;
use crate::files::{AtomicFile, Fault, FileError};
use crate::numerics::linalg::SparseMatrix;
use std::io;
use std::io::Write;
use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

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
/// # Ok::<(), plummer::formats::FormatError>(())
/// ```
#[derive(Debug)]
pub struct NpzWriter {
    partial: PathBuf,
    archive: ZipWriter<AtomicFile>,
    names: Vec<String>,
    /// Array begun and not ended.
    incomplete: Option<String>,
}

impl NpzWriter {
    /// Begins an archive that will be called `path` once finished.
    ///
    /// # Errors
    /// [`FormatError::File`] if the temporary file cannot be made.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        let path = path.as_ref();
        let partial = AtomicFile::partial_of(path);
        let file = AtomicFile::create(path).map_err(FileError::write(&partial))?;
        Ok(Self { partial, archive: ZipWriter::new(file), names: Vec::new(), incomplete: None })
    }

    /// Writes a one-dimensional array.
    ///
    /// # Errors
    /// As `begin`.
    pub fn array<T: NpzElement>(&mut self, name: &str, values: &[T]) -> Result<(), FormatError> {
        self.whole(name, &[values.len()], values)
    }

    /// Writes a matrix of `rows` x `columns`, `values` row by row (C order).
    ///
    /// # Errors
    /// As `begin`, and [`FormatError::Refused`] unless there are rows x columns values.
    pub fn matrix<T: NpzElement>(
        &mut self,
        name: &str,
        rows: usize,
        columns: usize,
        values: &[T],
    ) -> Result<(), FormatError> {
        self.whole(name, &[rows, columns], values)
    }

    fn whole<T: NpzElement>(&mut self, name: &str, shape: &[usize], values: &[T]) -> Result<(), FormatError> {
        let mut array = self.begin(name, shape)?;
        array.extend(values)?;
        array.end()
    }

    /// Begins an array of a known shape whose values come in pieces, last index fastest (C order).
    ///
    /// # Errors
    /// [`FormatError::Refused`] for a name that is improper or taken and after an array that is incomplete,
    /// [`FormatError::File`].
    pub(crate) fn begin<T: NpzElement>(&mut self, name: &str, shape: &[usize]) -> Result<NpzArray<'_, T>, FormatError> {
        let expected = shape.iter().product();
        self.start(name, &header(T::TYPE, shape), expected * T::BYTES)?;
        let (name, shape) = (name.to_owned(), shape.to_vec());
        Ok(NpzArray { writer: self, element: PhantomData, name, shape, expected, written: 0 })
    }

    /// Writes a one-dimensional array of text (NumPy `<U`), each as long as the longest.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    pub(crate) fn texts(&mut self, name: &str, values: &[&str]) -> Result<(), FormatError> {
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
    pub(crate) fn bytes(&mut self, name: &str, value: &[u8]) -> Result<(), FormatError> {
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
    fn start(&mut self, name: &str, header: &[u8], length: usize) -> Result<(), FormatError> {
        if !is_array_name(name) {
            let rule = "array name must be letters, digits, '_', '-', '.' or spaces";
            return Err(FormatError::Refused(format!("{rule}, found \"{name}\"")));
        }
        if self.names.iter().any(|n| n == name) {
            return Err(FormatError::Refused(format!("array \"{name}\" is already in the archive")));
        }
        self.check_complete()?;
        self.names.push(name.to_owned());
        self.incomplete = Some(name.to_owned());
        // ZIP counts in 32 bits unless told otherwise.
        let bytes = header.len() as u64 + length as u64;
        let options = SimpleFileOptions::DEFAULT
            .compression_method(CompressionMethod::Stored)
            .large_file(bytes > u64::from(u32::MAX) - (1 << 16));
        let begun = self.archive.start_file(format!("{name}.npy"), options);
        begun.map_err(|error| FileError::write(&self.partial)(error.into()))?;
        self.write(header)
    }

    /// Completes the archive and gives it its name, in place of an earlier one.
    ///
    /// # Errors
    /// [`FormatError::Refused`] after an array that is incomplete, [`FormatError::File`]; the temporary file is then removed.
    pub fn finish(self) -> Result<(), FormatError> {
        self.check_complete()?;
        let finished = self.archive.finish().map_err(io::Error::from);
        let committed = finished.and_then(AtomicFile::commit);
        Ok(committed.map_err(FileError::write(&self.partial))?)
    }

    fn check_complete(&self) -> Result<(), FormatError> {
        match &self.incomplete {
            Some(name) => Err(FormatError::Refused(format!("array \"{name}\" was begun and not completed"))),
            None => Ok(()),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), FormatError> {
        let written = self.archive.write_all(bytes);
        Ok(written.map_err(FileError::write(&self.partial))?)
    }
}

/// An array that is being written piece by piece; made by `NpzWriter::begin`.
#[derive(Debug)]
#[must_use = "an array is complete only after `end`"]
pub struct NpzArray<'a, T> {
    writer: &'a mut NpzWriter,
    element: PhantomData<T>,
    name: String,
    shape: Vec<usize>,
    expected: usize,
    written: usize,
}

impl<T: NpzElement> NpzArray<'_, T> {
    /// Writes the next values.
    ///
    /// # Errors
    /// [`FormatError::Refused`] if there are more than the shape holds, [`FormatError::File`].
    pub(crate) fn extend(&mut self, values: &[T]) -> Result<(), FormatError> {
        self.written += values.len();
        if self.written > self.expected {
            return Err(self.shape_error());
        }
        let mut bytes = Vec::with_capacity(512 * T::BYTES);
        for piece in values.chunks(512) {
            bytes.clear();
            for &value in piece {
                value.extend_bytes(&mut bytes);
            }
            self.writer.write(&bytes)?;
        }
        Ok(())
    }

    /// Ends the array.
    ///
    /// # Errors
    /// [`FormatError::Refused`] if values are missing.
    pub(crate) fn end(self) -> Result<(), FormatError> {
        if self.written == self.expected {
            self.writer.incomplete = None;
            Ok(())
        } else {
            Err(self.shape_error())
        }
    }

    fn shape_error(&self) -> FormatError {
        let Self { name, shape, expected, written, .. } = self;
        FormatError::Refused(format!("array \"{name}\" of shape {shape:?} takes {expected} values, found {written}"))
    }
}

/// A number that an array may hold.
pub trait NpzElement: Copy + sealed::Sealed {
    /// NumPy's name of the type.
    const TYPE: &'static str;
    /// Bytes a number.
    const BYTES: usize;

    /// Appends the number, little-endian.
    fn extend_bytes(self, bytes: &mut Vec<u8>);
}

mod sealed {
    /// No other types: their names and bytes belong together.
    pub trait Sealed {}
}

macro_rules! element {
    ($number:ty, $name:literal) => {
        impl sealed::Sealed for $number {}

        impl NpzElement for $number {
            const TYPE: &'static str = $name;
            const BYTES: usize = size_of::<$number>();

            fn extend_bytes(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
        }
    };
}

element!(f32, "<f4");
element!(f64, "<f8");
element!(i32, "<i4");
element!(i64, "<i8");

/// Labels as an archive's whole numbers have them.
///
/// # Errors
/// [`Fault`] for labels beyond them.
pub(in crate::formats) fn npz_labels(labels: impl Iterator<Item = u64>) -> Result<Vec<i64>, Fault> {
    let beyond = |label| Fault::new(format!("labels up to {}", i64::MAX), label);
    labels.map(|label| i64::try_from(label).map_err(|_| beyond(label))).collect()
}

/// Writes a sparse matrix that `scipy.sparse.load_npz` reads: `indices`, `indptr`, `format`, `shape`, `data`. Indices have
/// 32 bits where that is enough, as SciPy's own.
///
/// # Errors
/// [`FormatError`] when the file cannot be written.
pub fn write_sparse_npz(path: &Path, matrix: &SparseMatrix) -> Result<(), FormatError> {
    let mut npz = NpzWriter::create(path)?;
    let (rows, columns) = matrix.shape();
    let offsets = matrix.indptr();
    let offsets = offsets.raw_storage();
    let largest = rows.max(columns).max(matrix.nnz());
    if largest <= i32::MAX as usize {
        indices::<i32>(&mut npz, matrix.indices(), offsets, |index| index as i32)?;
    } else {
        indices::<i64>(&mut npz, matrix.indices(), offsets, |index| index as i64)?;
    }
    npz.bytes("format", if matrix.is_csc() { b"csc" } else { b"csr" })?;
    npz.array("shape", &[rows as i64, columns as i64])?;
    npz.array("data", matrix.data())?;
    npz.finish()
}

fn indices<T: NpzElement>(
    npz: &mut NpzWriter,
    indices: &[usize],
    offsets: &[usize],
    narrow: impl Fn(usize) -> T,
) -> Result<(), FormatError> {
    for (name, values) in [("indices", indices), ("indptr", offsets)] {
        let mut array = npz.begin::<T>(name, &[values.len()])?;
        for piece in values.chunks(4096) {
            let piece: Vec<T> = piece.iter().map(|&index| narrow(index)).collect();
            array.extend(&piece)?;
        }
        array.end()?;
    }
    Ok(())
}
