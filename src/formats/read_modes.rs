//! Mode shapes from a file of any format that the program reads.

use std::path::Path;

use super::{FormatError, ModeShapes};
use super::{read_modes_csv, read_modes_frd, read_modes_npz, read_modes_uff};
use crate::files::Fault;

/// Reads mode shapes; the ending of the file's name tells its format: `.npz`, `.csv`, `.uff`, `.unv` or `.frd` (which does not
/// say its unit of length, and is taken to be in m).
///
/// # Errors
/// [`FormatError::Data`] for another ending, and what the reader of the format says.
pub fn read_mode_shapes(path: &Path) -> Result<ModeShapes, FormatError> {
    read_mode_shapes_in(path, 1.0)
}

/// The same, `metres` being the unit of length of a file that does not say its own, m.
pub(crate) fn read_mode_shapes_in(path: &Path, metres: f64) -> Result<ModeShapes, FormatError> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    match ending.unwrap_or_default().to_lowercase().as_str() {
        "npz" => read_modes_npz(path),
        "csv" => read_modes_csv(path),
        "uff" | "unv" => read_modes_uff(path),
        "frd" => read_modes_frd(path, metres),
        _ => {
            let expected = "a file of mode shapes (.npz, .csv, .uff, .unv or .frd)";
            Err(Fault::new(expected, path.display()).into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::mode_shapes::samples::two_modes;
    use super::super::{write_modes_csv, write_modes_npz, write_modes_uff};
    use super::*;

    #[test]
    fn the_ending_picks_the_format() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        write_modes_npz(&at("a.npz"), &two_modes()).unwrap();
        write_modes_csv(&at("a.CSV"), &two_modes()).unwrap();
        write_modes_uff(&at("a.unv"), "a", &two_modes()).unwrap();
        write_modes_uff(&at("a.uff"), "a", &two_modes()).unwrap();
        for name in ["a.npz", "a.CSV", "a.unv", "a.uff"] {
            let modes = read_mode_shapes(&at(name)).unwrap();
            assert_eq!(modes.node_tags, two_modes().node_tags, "{name}");
        }
        let error = read_mode_shapes(Path::new("a.op2")).unwrap_err().to_string();
        assert_eq!(error, "expected a file of mode shapes (.npz, .csv, .uff, .unv or .frd), found a.op2");
    }
}
