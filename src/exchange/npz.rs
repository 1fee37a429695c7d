//! NumPy `.npz` archives of named arrays: written without compression, read with and without.
//!
//! Written are arrays of f64, i32, i64, text and a string of bytes, and sparse matrices as SciPy has them; read are arrays
//! of f64 and i64. Format: a ZIP archive with one `NAME.npy` an array; each a header (NumPy "NPY format", version 1.0: magic,
//! version, header length, Python dictionary with descr, fortran_order, shape) followed by the values, little-endian.
//! Read back with `numpy.load(path)["NAME"]`.

mod element;
mod error;
mod header;
mod modes;
mod read_error;
mod reader;
#[cfg(test)]
mod reader_tests;
mod sparse;

use std::io::{self, Write};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

pub use element::NpzElement;
pub use error::NpzError;
use header::header;
pub use modes::{read_modes_npz, write_modes_npz};
pub use read_error::NpzReadError;
pub use reader::{NpzReader, NpzValues};
pub use sparse::write_sparse_npz;

use super::AtomicFile;

/// Writes an archive under a temporary name (`NAME.npz.partial` beside the target) and renames it in
/// [`finish`](Self::finish); dropped before that, it removes the temporary file and leaves an earlier archive alone.
/// The same arrays give the same bytes.
///
/// ```
/// use plummer::exchange::NpzWriter;
/// let path = std::env::temp_dir().join("plummer-doc.npz");
/// let mut npz = NpzWriter::create(&path)?;
/// npz.array("time_s", &[0.0, 0.5, 1.0])?;
/// npz.matrix("ball_radius", 2, 3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?;
/// npz.finish()?;
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), plummer::exchange::NpzError>(())
/// ```
#[derive(Debug)]
pub struct NpzWriter {
    partial: PathBuf,
    /// `None` only after `finish`.
    archive: Option<ZipWriter<AtomicFile>>,
    names: Vec<String>,
    /// Array begun and not ended.
    incomplete: Option<String>,
}

/// An array that is being written piece by piece; made by [`NpzWriter::begin`].
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
        Ok(NpzArray {
            writer: self,
            element: PhantomData,
            name: name.to_owned(),
            shape: shape.to_vec(),
            expected,
            written: 0,
        })
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
        let allowed = |c: char| c.is_alphanumeric() || "_-. ".contains(c);
        if name.is_empty() || !name.chars().all(allowed) {
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

    fn write(&mut self, bytes: &[u8]) -> Result<(), NpzError> {
        let path = self.partial.clone();
        self.archive()?
            .write_all(bytes)
            .map_err(|source| NpzError::Io { path, source })
    }
}

impl<T: NpzElement> NpzArray<'_, T> {
    /// Writes the next values.
    ///
    /// # Errors
    /// [`NpzError::Shape`] if there are more than the shape holds, [`NpzError::Io`].
    pub fn extend(&mut self, values: &[T]) -> Result<(), NpzError> {
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
    /// [`NpzError::Shape`] if values are missing.
    pub fn end(self) -> Result<(), NpzError> {
        if self.written == self.expected {
            self.writer.incomplete = None;
            Ok(())
        } else {
            Err(self.shape_error())
        }
    }

    fn shape_error(&self) -> NpzError {
        NpzError::Shape {
            name: self.name.clone(),
            shape: self.shape.clone(),
            expected: self.expected,
            found: self.written,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::{self, File};
    use std::io::Read;

    /// A directory of its own for each test, removed at the end.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(name: &str) -> Self {
            let path =
                std::env::temp_dir().join(format!("plummer-npz-{name}-{}", std::process::id()));
            fs::create_dir_all(&path).expect("temporary directory");
            Self(path)
        }

        fn files(&self) -> Vec<String> {
            let mut names: Vec<String> = fs::read_dir(&self.0)
                .expect("readable")
                .map(|e| e.expect("entry").file_name().to_string_lossy().into_owned())
                .collect();
            names.sort();
            names
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    /// Shape, order and values of one array, by an independent reader.
    fn read(path: &Path, name: &str) -> (Vec<u64>, npyz::Order, Vec<f64>) {
        let mut archive = zip::ZipArchive::new(File::open(path).expect("file")).expect("zip");
        let mut entry = archive.by_name(&format!("{name}.npy")).expect("entry");
        assert_eq!(entry.compression(), CompressionMethod::Stored);
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes).expect("entry is readable");
        let npy = npyz::NpyFile::new(&bytes[..]).expect("npy");
        (
            npy.shape().to_vec(),
            npy.order(),
            npy.into_vec().expect("f64"),
        )
    }

    #[test]
    fn arrays_come_back_bit_by_bit() {
        let scratch = Scratch::new("back");
        let path = scratch.0.join("signals.npz");
        let time: Vec<f64> = (0..1500).map(|k| f64::from(k) * 1e-5).collect();
        let matrix = [1.5, -0.0, f64::MIN_POSITIVE, 4e300, f64::INFINITY, 6.0];
        let mut npz = NpzWriter::create(&path).expect("create");
        npz.array("time_s", &time).expect("array");
        npz.matrix("ball radius.1", 2, 3, &matrix).expect("matrix");
        npz.array::<f64>("nothing", &[]).expect("empty array");
        let mut pieces = npz.begin("pieces", &[7, 100]).expect("begin");
        for piece in time[..700].chunks(33) {
            pieces.extend(piece).expect("piece");
        }
        pieces.end().expect("all there");
        npz.finish().expect("finish");
        assert_eq!(scratch.files(), ["signals.npz"]);
        assert_eq!(
            read(&path, "time_s"),
            (vec![1500], npyz::Order::C, time.clone())
        );
        let (shape, order, values) = read(&path, "ball radius.1");
        assert_eq!((shape, order), (vec![2, 3], npyz::Order::C));
        assert!(
            values
                .iter()
                .zip(&matrix)
                .all(|(a, b)| a.to_bits() == b.to_bits())
        );
        assert_eq!(read(&path, "nothing").0, [0]);
        assert_eq!(
            read(&path, "pieces"),
            (vec![7, 100], npyz::Order::C, time[..700].to_vec())
        );
    }

    #[test]
    fn an_unfinished_archive_leaves_the_earlier_one_alone() {
        let scratch = Scratch::new("unfinished");
        let path = scratch.0.join("signals.npz");
        let write = |value: f64| {
            let mut npz = NpzWriter::create(&path).expect("create");
            npz.array("x", &[value]).expect("array");
            npz
        };
        write(1.0).finish().expect("finish");
        let abandoned = write(2.0);
        assert_eq!(scratch.files(), ["signals.npz", "signals.npz.partial"]);
        drop(abandoned);
        assert_eq!(scratch.files(), ["signals.npz"]);
        assert_eq!(read(&path, "x").2, [1.0]);
        write(3.0).finish().expect("finish");
        assert_eq!(read(&path, "x").2, [3.0]);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let scratch = Scratch::new("errors");
        let mut npz = NpzWriter::create(scratch.0.join("e.npz")).expect("create");
        let mut other = NpzWriter::create(scratch.0.join("o.npz")).expect("create");
        let message = |r: Result<(), NpzError>| r.expect_err("must fail").to_string();
        assert_eq!(
            message(npz.array("a/b", &[1.0])),
            "array name must be letters, digits, '_', '-', '.' or spaces, found \"a/b\""
        );
        assert!(message(npz.array("", &[1.0])).starts_with("array name"));
        npz.array("x", &[1.0]).expect("array");
        assert_eq!(
            message(npz.array("x", &[1.0])),
            "array \"x\" is already in the archive"
        );
        assert_eq!(
            message(npz.matrix("m", 2, 2, &[1.0; 3])),
            "array \"m\" of shape [2, 2] takes 4 values, found 3"
        );
        assert_eq!(
            message(npz.array("n", &[1.0])),
            "array \"m\" was begun and not completed"
        );
        assert_eq!(
            message(other.matrix("n", 2, 2, &[1.0; 5])),
            "array \"n\" of shape [2, 2] takes 4 values, found 5"
        );
        drop(other);
        assert_eq!(
            message(npz.finish()),
            "array \"m\" was begun and not completed"
        );
        assert!(scratch.files().is_empty());
        let nowhere = scratch.0.join("missing").join("e.npz");
        let found = NpzWriter::create(&nowhere)
            .expect_err("no such directory")
            .to_string();
        assert!(found.starts_with(&format!("cannot write {}.partial: ", nowhere.display())));
    }
}
