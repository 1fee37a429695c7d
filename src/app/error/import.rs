//! Why a superelement from a file cannot take the housing's place.

use thiserror::Error;

use crate::fe::reduction::Bound;
use crate::formats::FormatError;

/// Why a superelement from a file cannot take the housing's place.
#[derive(Debug, Error)]
pub enum ImportError {
    /// A file of another kind.
    #[error("expected a file that ends in .npz or .op4")]
    Format,
    /// A file that cannot be read, or is none of a superelement.
    #[error("{0}")]
    File(#[from] FormatError),
    /// Modes of an interface in its place.
    #[error(
        "expected the ring's own coordinates, found {modes} modes of an interface of {coordinates} coordinates (array \
         \"interface_modes\"): condense without condense.interface_modes"
    )]
    InterfaceModes {
        /// How many modes.
        modes: usize,
        /// Of how many coordinates.
        coordinates: usize,
    },
    /// An interface that is not the ring's.
    #[error(
        "expected {} interface coordinates for ring.nodes = {nodes} (x, y, about_z of each) or {} (in a solid housing \
         then z, about_x, about_y of each), found {found}",
        3 * nodes, 6 * nodes
    )]
    Count {
        /// Nodes of the ring.
        nodes: usize,
        /// Interface coordinates of the file; its rows, if it does not tell them apart.
        found: usize,
    },
    /// A bore of another radius.
    #[error("ring.outer_radius is {case} m, but the superelement was condensed with {file} m (array \"outer_radius\")")]
    OuterRadius {
        /// That of the case, m.
        case: f64,
        /// That of the file, m.
        file: f64,
    },
    /// A coordinate that is not the ring's at this place.
    #[error("interface coordinate {row} (from 0): expected {expected}, found {found}")]
    Label {
        /// Which one, from 0.
        row: usize,
        /// What the ring has there.
        expected: String,
        /// What the file has there.
        found: String,
    },
    /// A node or an axis that is elsewhere.
    #[error("interface coordinate {row} (from 0), {what} of {label}: expected {expected:?}, found {found:?}")]
    Place {
        /// Which one, from 0.
        row: usize,
        /// "position" or "axis", with its unit.
        what: &'static str,
        /// The degree of freedom.
        label: String,
        /// Where the ring has it, in the file's axes.
        expected: [f64; 3],
        /// Where the file has it.
        found: [f64; 3],
    },
    /// Axes that are no frame.
    #[error("expected axes x and z of ring node 0 at right angles, found {x:?} and {z:?}")]
    Frame {
        /// That of the first coordinate.
        x: [f64; 3],
        /// That of the third.
        z: [f64; 3],
    },
    /// Springs across the plane of a plane superelement.
    #[error(
        "ring.supports[{index}].spring has a component z, expected x and y only: the superelement is plane, three motions a \
         node"
    )]
    SpringAcross {
        /// Which support, from 0.
        index: usize,
    },
    /// Matrices that are not those of a condensed housing.
    #[error(
        "check \"{name}\" ({what}): expected {} {limit:e}, found {value:e}",
        match bound { Bound::AtMost => "at most", Bound::AtLeast => "at least" }
    )]
    Check {
        /// Name of the check.
        name: &'static str,
        /// What its value is.
        what: String,
        /// The value.
        value: f64,
        /// What passes.
        limit: f64,
        /// On which side of the limit.
        bound: Bound,
    },
    /// A row that is not there.
    #[error("{name}: expected one of the rows {known}, found \"{row}\"")]
    Sensor {
        /// What stands there, with its name.
        name: String,
        /// Row that it asks for.
        row: String,
        /// Rows of the file.
        known: String,
    },
    /// Structural damping in a simulation over time.
    #[error(
        "array \"structural\" is structural damping, which has a meaning for harmonic motion alone; a run steps through time"
    )]
    StructuralDamping,
}

impl ImportError {
    /// What to do about it, where the message does not say it already.
    pub(crate) fn help(&self) -> Option<String> {
        let text = match self {
            Self::Count { .. } | Self::Label { .. } => {
                "`plummer condense` with interface = \"ring\" writes such a file: x, y, about_z of node after node, in \
                 space then z, about_x, about_y of node after node, nodes counter-clockwise from angle 0"
            }
            Self::OuterRadius { .. } => {
                "the tie to the bore is within the superelement: give its value, leave the key out, or condense again"
            }
            Self::Place { .. } => {
                "ring.sections (their radius), ring.nodes and ring.bond must be those that were condensed, or condense again"
            }
            Self::Sensor { .. } => {
                "give one of these names as `recovered`, `ring_deg` for a place on the ring, or condense again with the sensor in its case"
            }
            Self::Check { .. } => {
                "`plummer condense` of this case lists all checks; expected are Craig-Bampton matrices in SI units, modes \
                 of mass 1 after the interface"
            }
            Self::StructuralDamping => "leave the array out and give [damping]",
            _ => return None,
        };
        Some(text.to_owned())
    }
}
