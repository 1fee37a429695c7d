//! The table of a sweep as arrays.

use std::path::Path;

use super::SweepResult;
use super::result::Values;
use crate::formats::{FormatError, NpzWriter};

/// Writes `sweep.npz`: an array a column of the table, one entry a point, by the column's name (numbers as f64, NaN where there
/// is none; texts as `<U`), `point` (the numbers, i64), and `shape`, the lengths of the axes: `a[name].reshape(a["shape"])` has
/// an index an axis.
///
/// # Errors
/// [`FormatError`] when the file cannot be written; an earlier one is then as it was.
pub(crate) fn write_sweep_npz(path: &Path, result: &SweepResult) -> Result<(), FormatError> {
    let mut archive = NpzWriter::create(path)?;
    let whole = |number: usize| i64::try_from(number).unwrap_or(i64::MAX);
    let axes = result.plan.axes.iter();
    let shape: Vec<i64> = axes.map(|axis| whole(axis.values.len())).collect();
    archive.array("shape", &shape)?;
    let points = result.points.iter();
    let numbers: Vec<i64> = points.map(|point| whole(point.point.number)).collect();
    archive.array("point", &numbers)?;
    for column in result.columns() {
        let name = array_name(&column.name);
        match &column.values {
            Values::Numbers(numbers) => archive.array(&name, numbers)?,
            Values::Texts(texts) => {
                let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
                archive.texts(&name, &texts)?;
            }
        }
    }
    archive.finish()
}

/// Without what the name of an array cannot have.
fn array_name(name: &str) -> String {
    let allowed = |letter: char| letter.is_alphanumeric() || "_-. ".contains(letter);
    let plain = |letter: char| if allowed(letter) { letter } else { '_' };
    name.chars().map(plain).collect()
}

#[cfg(test)]
mod tests {
    use super::super::result::tests::four;
    use super::write_sweep_npz;
    use crate::formats::NpzReader;

    #[test]
    fn every_column_is_an_array() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sweep.npz");
        write_sweep_npz(&path, &four()).unwrap();
        let mut read = NpzReader::open(&path).unwrap();
        assert_eq!(read.i64("shape").unwrap().values, [2, 2]);
        assert_eq!(read.i64("point").unwrap().values, [1, 2, 3, 4]);
        assert_eq!(read.f64("ring.nodes").unwrap().values, [36.0, 36.0, 72.0, 72.0]);
        let first = read.f64("frequency.1").unwrap().values;
        assert_eq!(first[..2], [8200.5, 8100.0]);
        assert!(first[2].is_nan() && first[3].is_nan());
        assert_eq!(read.texts("state").unwrap().values, ["done", "bad answer", "failed", "not computed"]);
        let element = read.texts("ring.element").unwrap().values;
        assert_eq!(element[1], "raveendranath");
    }
}
