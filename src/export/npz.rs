//! NumPy `.npz` archives of named arrays of f64, stored without compression.
//!
//! Format: a ZIP archive with one `NAME.npy` an array; each a header (NumPy "NPY format", version 1.0: magic,
//! version, header length, Python dictionary with descr, fortran_order, shape) followed by the values, little-endian.
//! Read back with `numpy.load(path)["NAME"]`.

mod error;
mod header;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

pub use error::NpzError;
use header::header;

/// Writes an archive under a temporary name (`NAME.npz.partial` beside the target) and renames it in
/// [`finish`](Self::finish); dropped before that, it removes the temporary file and leaves an earlier archive alone.
/// The same arrays give the same bytes.
///
/// ```
/// use plummer::export::NpzWriter;
/// let path = std::env::temp_dir().join("plummer-doc.npz");
/// let mut npz = NpzWriter::create(&path)?;
/// npz.array("time_s", &[0.0, 0.5, 1.0])?;
/// npz.matrix("ball_radius", 2, 3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?;
/// npz.finish()?;
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), plummer::export::NpzError>(())
/// ```
#[derive(Debug)]
pub struct NpzWriter {
    path: PathBuf,
    partial: PathBuf,
    /// `None` only after `finish`.
    archive: Option<ZipWriter<BufWriter<File>>>,
    names: Vec<String>,
    /// Array begun and not ended.
    incomplete: Option<String>,
}

/// An array that is being written piece by piece; made by [`NpzWriter::begin`].
#[derive(Debug)]
#[must_use = "an array is complete only after `end`"]
pub struct NpzArray<'a> {
    writer: &'a mut NpzWriter,
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
        let path = path.as_ref().to_owned();
        let mut partial = path.clone().into_os_string();
        partial.push(".partial");
        let partial = PathBuf::from(partial);
        let file = File::create(&partial).map_err(|source| NpzError::Io {
            path: partial.clone(),
            source,
        })?;
        Ok(Self {
            path,
            partial,
            archive: Some(ZipWriter::new(BufWriter::with_capacity(1 << 18, file))),
            names: Vec::new(),
            incomplete: None,
        })
    }

    /// Writes a one-dimensional array.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    pub fn array(&mut self, name: &str, values: &[f64]) -> Result<(), NpzError> {
        let mut array = self.begin(name, &[values.len()])?;
        array.extend(values)?;
        array.end()
    }

    /// Writes a matrix of `rows` x `columns`, `values` row by row (C order).
    ///
    /// # Errors
    /// As [`begin`](Self::begin), and [`NpzError::Shape`] unless there are rows x columns values.
    pub fn matrix(
        &mut self,
        name: &str,
        rows: usize,
        columns: usize,
        values: &[f64],
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
    pub fn begin(&mut self, name: &str, shape: &[usize]) -> Result<NpzArray<'_>, NpzError> {
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
        let expected: usize = shape.iter().product();
        let header = header(shape);
        // ZIP counts in 32 bits unless told otherwise.
        let bytes = header.len() as u64 + 8 * expected as u64;
        let options = SimpleFileOptions::DEFAULT
            .compression_method(CompressionMethod::Stored)
            .large_file(bytes > u64::from(u32::MAX) - (1 << 16));
        let path = self.partial.clone();
        self.archive()?
            .start_file(format!("{name}.npy"), options)
            .map_err(|source| NpzError::Archive { path, source })?;
        self.write(&header)?;
        Ok(NpzArray {
            writer: self,
            name: name.to_owned(),
            shape: shape.to_vec(),
            expected,
            written: 0,
        })
    }

    /// Completes the archive and gives it its name, in place of an earlier one.
    ///
    /// # Errors
    /// [`NpzError::Incomplete`], [`NpzError::Io`], [`NpzError::Archive`]; the temporary file is then removed.
    pub fn finish(mut self) -> Result<(), NpzError> {
        self.check_complete()?;
        let partial = self.partial.clone();
        let io_error = |source| NpzError::Io {
            path: partial.clone(),
            source,
        };
        if let Some(archive) = self.archive.take() {
            let completed = archive
                .finish()
                .map_err(|source| NpzError::Archive {
                    path: partial.clone(),
                    source,
                })
                .and_then(|buffer| buffer.into_inner().map_err(|e| io_error(e.into_error())))
                .and_then(|file| file.sync_all().map_err(io_error));
            let renamed =
                completed.and_then(|()| fs::rename(&partial, &self.path).map_err(io_error));
            if renamed.is_err() {
                // The first error is the one to tell.
                let _ = fs::remove_file(&partial);
            }
            return renamed;
        }
        Ok(())
    }

    fn check_complete(&self) -> Result<(), NpzError> {
        match &self.incomplete {
            Some(name) => Err(NpzError::Incomplete { name: name.clone() }),
            None => Ok(()),
        }
    }

    fn archive(&mut self) -> Result<&mut ZipWriter<BufWriter<File>>, NpzError> {
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

impl Drop for NpzWriter {
    fn drop(&mut self) {
        if let Some(archive) = self.archive.take() {
            drop(archive);
            // Nothing to tell anybody from here; a left-over carries no valid name.
            let _ = fs::remove_file(&self.partial);
        }
    }
}

impl NpzArray<'_> {
    /// Writes the next values.
    ///
    /// # Errors
    /// [`NpzError::Shape`] if there are more than the shape holds, [`NpzError::Io`].
    pub fn extend(&mut self, values: &[f64]) -> Result<(), NpzError> {
        self.written += values.len();
        if self.written > self.expected {
            return Err(self.shape_error());
        }
        let mut bytes = [0_u8; 8 * 512];
        for piece in values.chunks(512) {
            for (slot, value) in bytes.chunks_exact_mut(8).zip(piece) {
                slot.copy_from_slice(&value.to_le_bytes());
            }
            self.writer.write(&bytes[..8 * piece.len()])?;
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
        npz.array("nothing", &[]).expect("empty array");
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
