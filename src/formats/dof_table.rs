//! Which row of a matrix is which degree of freedom.
//!
//! | column | what it is |
//! |---|---|
//! | `row` | the matrix's row from 0, as NumPy and SciPy count |
//! | `mtx_row` | the same from 1, as Matrix Market files count |
//! | `body` | `housing`, `ring`, `centre`, `interface` or `modal` |
//! | `node` | gmsh's tag of a housing's node; a ring's node, a centre node, an interface coordinate or a mode from 0 |
//! | `direction` | `x`, `y`, `z`, `radial`, `tangential`, `axial`; rotations `about_x`, `about_y`, `about_z`; `generalised` |
//! | `unit` | of the degree of freedom: `m`, `rad`, or `generalised` |
//! | `x_m`, `y_m`, `z_m` | the node's position in the mesh's axes; empty where it has none |
//! | `axis_x`, `axis_y`, `axis_z` | unit vector along or about which it moves, in the mesh's axes; empty where it has none |

use std::io::Write;
use std::path::Path;

use super::npz::npz_labels;
use super::{FormatError, NpzWriter};
use crate::files::{FileError, write_atomic};

const COLUMNS: [&str; 12] =
    ["row", "mtx_row", "body", "node", "direction", "unit", "x_m", "y_m", "z_m", "axis_x", "axis_y", "axis_z"];

/// Where a node belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DofBody {
    /// To the mesh of the housing.
    Housing,
    /// To a bearing's outer ring.
    Ring,
    /// To the centre node of a bore; these are numbered from 0.
    Centre,
    /// To none that is known: an interface coordinate of a superelement, numbered from 0.
    Interface,
    /// To none: the amplitude of a superelement's mode, numbered from 0.
    Modal,
}

/// What a degree of freedom is. Those of a housing are along the mesh's axes, or along those of the bore where a sliding
/// ring sits; those of a ring are along and about the bearing's axes, those of a centre node along and about the mesh's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DofDirection {
    /// Displacement along x, y or z (0, 1, 2).
    Along(usize),
    /// Displacement along the radial, tangential or axial direction (0, 1, 2) of the bore.
    Polar(usize),
    /// Rotation about x, y or z (0, 1, 2), right-handed.
    About(usize),
    /// A coordinate whose unit is that of its shape, such as the amplitude of a mode.
    Generalised,
}

/// One degree of freedom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DofLabel {
    /// Where its node belongs.
    pub body: DofBody,
    /// The node: gmsh's tag; or a ring's node, counted on over several rings, a centre node, an interface coordinate or a mode, from 0.
    pub node: u64,
    /// What it is.
    pub direction: DofDirection,
    /// The node's position in the mesh's axes, m; NaN where it has none or it is not known.
    pub position: [f64; 3],
    /// Unit vector along or about which it moves, in the mesh's axes; NaN where it has none or it is not known.
    pub axis: [f64; 3],
}

impl DofBody {
    /// Its name in the files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Housing => "housing",
            Self::Ring => "ring",
            Self::Centre => "centre",
            Self::Interface => "interface",
            Self::Modal => "modal",
        }
    }

    /// The body of this name, if there is one.
    pub(crate) fn of_name(name: &str) -> Option<Self> {
        let all = [Self::Housing, Self::Ring, Self::Centre, Self::Interface, Self::Modal];
        all.into_iter().find(|body| body.name() == name)
    }
}

impl DofDirection {
    /// Its name in the files.
    pub fn name(self) -> &'static str {
        let (names, axis) = match self {
            Self::Along(axis) => (["x", "y", "z"], axis),
            Self::Polar(axis) => (["radial", "tangential", "axial"], axis),
            Self::About(axis) => (["about_x", "about_y", "about_z"], axis),
            Self::Generalised => (["generalised"; 3], 0),
        };
        names.get(axis).copied().unwrap_or("none")
    }

    /// Unit of the degree of freedom.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Along(_) | Self::Polar(_) => "m",
            Self::About(_) => "rad",
            Self::Generalised => "generalised",
        }
    }

    /// Its number in the files: x, y, z are 1, 2, 3 and the rotations about them 4, 5, 6, as Nastran has them; radial,
    /// tangential and axial are 7, 8, 9; what is neither is 0.
    pub fn component(self) -> i64 {
        let (first, axis) = match self {
            Self::Along(axis) => (1, axis),
            Self::About(axis) => (4, axis),
            Self::Polar(axis) => (7, axis),
            Self::Generalised => return 0,
        };
        if axis < 3 { first + axis as i64 } else { 0 }
    }

    /// The direction of this number, if there is one.
    pub(crate) fn of_component(component: i64) -> Option<Self> {
        let component = usize::try_from(component).ok()?;
        Some(match component {
            0 => Self::Generalised,
            1..=3 => Self::Along(component - 1),
            4..=6 => Self::About(component - 4),
            7..=9 => Self::Polar(component - 7),
            _ => return None,
        })
    }
}

impl DofLabel {
    /// The amplitude of a superelement's mode, counted from 0.
    pub fn modal(mode: u64) -> Self {
        let [position, axis] = [[f64::NAN; 3]; 2];
        Self { body: DofBody::Modal, node: mode, direction: DofDirection::Generalised, position, axis }
    }

    /// Coordinate `coordinate` (0 to 5: displacements along x, y, z, then rotations about them) of the centre node `node`
    /// at `position`.
    pub fn centre(node: u64, coordinate: usize, position: [f64; 3]) -> Self {
        let axis = coordinate % 3;
        let direction = if coordinate < 3 { DofDirection::Along(axis) } else { DofDirection::About(axis) };
        let axis = std::array::from_fn(|own| if own == axis { 1.0 } else { 0.0 });
        Self { body: DofBody::Centre, node, direction, position, axis }
    }

    /// An interface coordinate of which only the number, from 0, is known.
    pub fn interface(number: u64) -> Self {
        Self { body: DofBody::Interface, ..Self::modal(number) }
    }
}

/// Writes the rows as CSV (RFC 4180), whole or not at all. Numbers have as many digits as give back every bit.
///
/// # Errors
/// [`FileError::Write`].
pub fn write_dofs_csv(path: &Path, rows: &[DofLabel]) -> Result<(), FileError> {
    write_atomic(path, |to| {
        write!(to, "{}\r\n", COLUMNS.join(","))?;
        for (row, label) in rows.iter().enumerate() {
            let (body, direction) = (label.body.name(), label.direction.name());
            let (node, unit) = (label.node, label.direction.unit());
            write!(to, "{row},{},{body},{node},{direction},{unit}", row + 1)?;
            for value in label.position.iter().chain(&label.axis) {
                if value.is_nan() {
                    write!(to, ",")?;
                } else {
                    write!(to, ",{value:?}")?;
                }
            }
            write!(to, "\r\n")?;
        }
        Ok(())
    })
}

/// Writes the rows as a NumPy archive, whole or not at all: `body`, `node`, `direction` \[rows\], `position_m` and `axis`
/// \[rows x 3\], NaN where a row has none.
///
/// # Errors
/// [`FormatError::File`] when the file cannot be written, [`FormatError::Data`] for labels beyond i64.
pub fn write_dofs_npz(path: &Path, rows: &[DofLabel]) -> Result<(), FormatError> {
    let nodes = npz_labels(rows.iter().map(|row| row.node))?;
    let texts = |text: fn(&DofLabel) -> &'static str| rows.iter().map(text).collect::<Vec<_>>();
    let vectors = |vector: fn(&DofLabel) -> [f64; 3]| rows.iter().map(vector).collect::<Vec<_>>();
    let mut npz = NpzWriter::create(path)?;
    npz.texts("body", &texts(|row| row.body.name()))?;
    npz.array("node", &nodes)?;
    npz.texts("direction", &texts(|row| row.direction.name()))?;
    npz.matrix("position_m", rows.len(), 3, vectors(|row| row.position).as_flattened())?;
    npz.matrix("axis", rows.len(), 3, vectors(|row| row.axis).as_flattened())?;
    npz.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::NpzReader;

    fn rows() -> [DofLabel; 3] {
        let label = DofLabel {
            body: DofBody::Housing,
            node: 120_000,
            direction: DofDirection::Polar(1),
            position: [0.1, -2e-7, 1.0 / 3.0],
            axis: [0.0, 1.0, 0.0],
        };
        [
            label,
            DofLabel { direction: DofDirection::Along(2), axis: [0.6, -0.8, 0.0], ..label },
            DofLabel { body: DofBody::Ring, node: 0, direction: DofDirection::About(0), ..label },
        ]
    }

    #[test]
    fn the_table_says_which_row_is_what() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dofs.csv");
        write_dofs_csv(&path, &rows()).unwrap();
        let expected = "row,mtx_row,body,node,direction,unit,x_m,y_m,z_m,axis_x,axis_y,axis_z\r\n\
            0,1,housing,120000,tangential,m,0.1,-2e-7,0.3333333333333333,0.0,1.0,0.0\r\n\
            1,2,housing,120000,z,m,0.1,-2e-7,0.3333333333333333,0.6,-0.8,0.0\r\n\
            2,3,ring,0,about_x,rad,0.1,-2e-7,0.3333333333333333,0.0,1.0,0.0\r\n";
        assert_eq!(std::fs::read_to_string(&path).unwrap(), expected);
        let error = write_dofs_csv(&folder.path().join("no/dofs.csv"), &rows()).unwrap_err();
        assert!(matches!(error, FileError::Write { path, .. } if path.ends_with("no/dofs.csv")));
    }

    #[test]
    fn a_row_without_a_place_has_empty_cells() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dofs.csv");
        write_dofs_csv(&path, &[DofLabel::modal(4), DofLabel::interface(7)]).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let lines: Vec<&str> = text.split("\r\n").skip(1).collect();
        let expected =
            ["0,1,modal,4,generalised,generalised,,,,,,", "1,2,interface,7,generalised,generalised,,,,,,", ""];
        assert_eq!(lines, expected);
    }

    #[test]
    fn directions_and_bodies_have_numbers_and_names() {
        for component in 0..10 {
            let direction = DofDirection::of_component(component).unwrap();
            assert_eq!(direction.component(), component);
        }
        assert_eq!(DofDirection::of_component(5), Some(DofDirection::About(1)));
        assert_eq!(DofDirection::of_component(9), Some(DofDirection::Polar(2)));
        assert_eq!(DofDirection::of_component(10), None);
        assert_eq!(DofDirection::of_component(-1), None);
        for name in ["housing", "ring", "centre", "interface", "modal"] {
            assert_eq!(DofBody::of_name(name).unwrap().name(), name);
        }
        assert_eq!(DofBody::of_name("shaft"), None);
    }

    #[test]
    fn the_archive_says_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dofs.npz");
        write_dofs_npz(&path, &rows()).unwrap();
        let mut npz = NpzReader::open(&path).unwrap();
        assert_eq!(npz.i64("node").unwrap().values, [120_000, 120_000, 0]);
        let axis = npz.f64("axis").unwrap();
        assert_eq!(axis.shape, [3, 3]);
        assert_eq!(axis.values[3..6], [0.6, -0.8, 0.0]);
        let position = npz.f64("position_m").unwrap().values;
        assert_eq!(position[..3], rows()[0].position);
        let beyond = DofLabel { node: u64::MAX, ..rows()[0] };
        let error = write_dofs_npz(&path, &[beyond]).unwrap_err();
        assert!(error.to_string().ends_with("found 18446744073709551615"));
    }
}
