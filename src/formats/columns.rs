//! A run's record on disk while it grows: a file a column, nothing but its numbers, little-endian f64 row by row.
//!
//! `time_s.f64`, `shaft_x.f64`, `shaft_y.f64`, `sensor-0.f64` .., `ball_radius.f64`, `outer_force.f64`, `inner_force.f64`.
//! Read with `numpy.fromfile(path)`, the last three with `.reshape(-1, balls)`.

use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::FormatError;
use crate::files::{FileError, hex, no_link, sha256};
use crate::system::{Column, RecordLayout, RunRecord};
use sha2::{Digest, Sha256};

/// Bytes a number.
const BYTES: usize = size_of::<f64>();

/// Numbers that are read at once.
const PIECE: usize = 1 << 13;

/// The columns of one run.
#[derive(Debug)]
pub struct ColumnFiles {
    folder: PathBuf,
    /// What the columns are of.
    pub(crate) layout: RecordLayout,
    rows: usize,
    files: Vec<(Column, File)>,
    /// Of each file's rows.
    hashers: Vec<Sha256>,
}

/// What files call a column, unless it is a sensor's.
pub(crate) fn column_name(column: Column) -> Result<&'static str, usize> {
    match column {
        Column::Sensor(sensor) => Err(sensor),
        Column::Time => Ok("time_s"),
        Column::ShaftX => Ok("shaft_x"),
        Column::ShaftY => Ok("shaft_y"),
        Column::BallRadius => Ok("ball_radius"),
        Column::OuterForce => Ok("outer_force"),
        Column::InnerForce => Ok("inner_force"),
        Column::ShaftZ => Ok("shaft_z"),
        Column::TiltX => Ok("tilt_x"),
        Column::TiltY => Ok("tilt_y"),
        Column::BallAxial => Ok("ball_axial"),
        Column::OuterAngle => Ok("outer_angle"),
        Column::InnerAngle => Ok("inner_angle"),
    }
}

/// A column's file.
fn path_of(folder: &Path, column: Column) -> PathBuf {
    let name = column_name(column).map_or_else(|sensor| format!("sensor-{sensor}"), str::to_owned);
    folder.join(name + ".f64")
}

impl ColumnFiles {
    /// Begins empty columns in a folder, in the place of earlier ones.
    ///
    /// # Errors
    /// [`FormatError::File`].
    pub(crate) fn create(folder: &Path, layout: RecordLayout) -> Result<Self, FormatError> {
        Self::open(folder, layout, 0, OpenOptions::new().create(true))
    }

    /// Goes on with columns after so many rows; what is beyond them is cut off.
    ///
    /// # Errors
    /// [`FormatError::File`], [`FormatError::CutColumn`] if a column has fewer.
    pub(crate) fn resume(folder: &Path, layout: RecordLayout, rows: usize) -> Result<Self, FormatError> {
        Self::open(folder, layout, rows, &mut OpenOptions::new())
    }

    fn open(folder: &Path, layout: RecordLayout, rows: usize, options: &mut OpenOptions) -> Result<Self, FormatError> {
        let (mut files, mut hashers) = (Vec::new(), Vec::new());
        for column in layout.columns() {
            let path = path_of(folder, column);
            let failed = |source| FileError::Open { path: path.clone(), source };
            no_link(&path).map_err(failed)?;
            let expected = (rows * column.width(layout.balls) * BYTES) as u64;
            let mut file = match options.read(true).write(true).open(&path) {
                Err(error) if rows > 0 && error.kind() == ErrorKind::NotFound => {
                    return Err(FormatError::CutColumn { path, expected, found: 0 });
                }
                opened => opened.map_err(failed)?,
            };
            let found = file.metadata().map_err(failed)?.len();
            if found < expected {
                return Err(FormatError::CutColumn { path, expected, found });
            }
            file.set_len(expected).map_err(failed)?;
            hashers.push(sha256(&file).map_err(failed)?);
            file.seek(SeekFrom::End(0)).map_err(failed)?;
            files.push((column, file));
        }
        Ok(Self { folder: folder.to_owned(), layout, rows, files, hashers })
    }

    /// Rows written.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// SHA-256 of the rows of all columns, 64 hexadecimal digits.
    pub(crate) fn digest(&self) -> String {
        let mut all = Sha256::new();
        self.hashers.iter().for_each(|hasher| all.update(hasher.clone().finalize()));
        hex(all)
    }

    /// Appends rows of the same sensors and balls.
    ///
    /// # Errors
    /// [`FormatError::File`].
    pub(crate) fn append(&mut self, rows: &RunRecord) -> Result<(), FormatError> {
        let places = 0..rows.rows();
        let mut bytes = Vec::new();
        for ((column, file), hasher) in self.files.iter_mut().zip(&mut self.hashers) {
            let values = &rows.column(*column)[column.places(&places, self.layout.balls)];
            bytes.clear();
            bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
            hasher.update(&bytes);
            let written = file.write_all(&bytes);
            written.map_err(FileError::write(&path_of(&self.folder, *column)))?;
        }
        self.rows += places.len();
        Ok(())
    }

    /// Brings everything to the disk.
    ///
    /// # Errors
    /// [`FormatError::File`].
    pub(crate) fn sync(&self) -> Result<(), FormatError> {
        for (column, file) in &self.files {
            // with its length
            let synced = file.sync_data();
            synced.map_err(FileError::write(&path_of(&self.folder, *column)))?;
        }
        Ok(())
    }

    /// Hands the numbers of some rows of a column to `take`, piece by piece. Rows that are not there are left out.
    ///
    /// # Errors
    /// [`FormatError::File`] and what `take` returns.
    pub(crate) fn read<E: From<FormatError>>(
        &self,
        column: Column,
        rows: Range<usize>,
        mut take: impl FnMut(&[f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let path = path_of(&self.folder, column);
        let failed = |source| FormatError::from(FileError::read(&path)(source));
        let rows = rows.start.min(self.rows)..rows.end.min(self.rows);
        let places = column.places(&rows, self.layout.balls);
        let mut file = File::open(&path).map_err(failed)?;
        let first = (places.start * BYTES) as u64;
        file.seek(SeekFrom::Start(first)).map_err(failed)?;
        let mut left = places.len();
        let mut bytes = vec![0; BYTES * PIECE.min(left)];
        while left > 0 {
            bytes.truncate(BYTES * left);
            file.read_exact(&mut bytes).map_err(failed)?;
            let values: Vec<f64> = bytes.as_chunks().0.iter().map(|number| f64::from_le_bytes(*number)).collect();
            left -= values.len();
            take(&values)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows from one number to another, each column told by its own offset.
    fn rows(range: Range<u32>) -> RunRecord {
        let mut record = RunRecord::blank(layout());
        for row in range.map(f64::from) {
            record.time_s.push(row);
            record.shaft_x.push(row + 0.1);
            record.shaft_y.push(row + 0.2);
            record.sensors[0].1.push(row + 0.3);
            record.sensors[1].1.push(row + 0.4);
            for (offset, table) in
                [(0.5, &mut record.ball_radius), (0.6, &mut record.outer_force), (0.7, &mut record.inner_force)]
            {
                table.extend([row + offset, -row - offset]);
            }
        }
        record
    }

    fn read(files: &ColumnFiles, range: Range<usize>) -> RunRecord {
        let mut record = RunRecord::blank(files.layout.clone());
        for column in files.layout.columns() {
            let mut values = Vec::new();
            files
                .read(column, range.clone(), |piece| {
                    values.extend_from_slice(piece);
                    Ok::<(), FormatError>(())
                })
                .unwrap();
            match column {
                Column::Time => record.time_s = values,
                Column::ShaftX => record.shaft_x = values,
                Column::ShaftY => record.shaft_y = values,
                Column::Sensor(sensor) => record.sensors[sensor].1 = values,
                Column::BallRadius => record.ball_radius = values,
                Column::OuterForce => record.outer_force = values,
                Column::InnerForce => record.inner_force = values,
                other => panic!("{other:?}"),
            }
        }
        record
    }

    fn layout() -> RecordLayout {
        RecordLayout { sensors: vec!["P1".to_owned(), "P2".to_owned()], balls: 2, in_space: false }
    }

    #[test]
    fn rows_come_back_whole_or_in_part() {
        let folder = tempfile::tempdir().unwrap();
        let mut files = ColumnFiles::create(folder.path(), layout()).unwrap();
        // more than one piece
        let most = PIECE as u32 + 100;
        files.append(&rows(0..7)).unwrap();
        files.append(&rows(7..most)).unwrap();
        assert_eq!(files.rows(), most as usize);
        assert_eq!(read(&files, 0..usize::MAX / 64), rows(0..most));
        assert_eq!(read(&files, 5..9), rows(5..9));
        // goes on at the end after reading
        files.append(&rows(most..most + 3)).unwrap();
        assert_eq!(read(&files, most as usize - 2..most as usize + 9), rows(most - 2..most + 3));
        // another run begins anew
        let anew = ColumnFiles::create(folder.path(), layout()).unwrap();
        assert_eq!(read(&anew, 0..10), rows(0..0));
    }

    #[test]
    fn rows_after_a_checkpoint_are_cut_and_missing_ones_refused() {
        let folder = tempfile::tempdir().unwrap();
        let mut files = ColumnFiles::create(folder.path(), layout()).unwrap();
        files.append(&rows(0..9)).unwrap();
        files.sync().unwrap();
        drop(files);
        let mut files = ColumnFiles::resume(folder.path(), layout(), 6).unwrap();
        files.append(&rows(6..8)).unwrap();
        assert_eq!(read(&files, 0..100), rows(0..8));
        let digest = files.digest();
        drop(files);
        let again = || ColumnFiles::resume(folder.path(), layout(), 8).unwrap();
        assert_eq!(again().digest(), digest);
        let path = folder.path().join("sensor-1.f64");
        let mut bytes = std::fs::read(&path).unwrap();
        bytes[17] ^= 1;
        std::fs::write(&path, &bytes).unwrap();
        assert_ne!(again().digest(), digest);
        let files = again();
        drop(files);
        let error = ColumnFiles::resume(folder.path(), layout(), 9).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!(
                "{} has 64 bytes: expected at least 72 of the rows that the checkpoint counts",
                folder.path().join("time_s.f64").display()
            )
        );
        std::fs::remove_file(folder.path().join("shaft_y.f64")).unwrap();
        let error = ColumnFiles::resume(folder.path(), layout(), 3).unwrap_err();
        assert!(matches!(error, FormatError::CutColumn { found: 0, .. }), "{error}");
    }
}
