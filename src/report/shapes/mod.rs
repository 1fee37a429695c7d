//! A meshed structure in space and its mode shapes: a view to turn and animate in the browser, and pictures of the same
//! for print.
//!
//! The data go one way: [`ModeShapeView`] is checked, brought down to the points that its surface uses, thinned where
//! the page would grow too large, packed for the script, and drawn as SVG without hidden surfaces.

mod camera;
mod check;
mod cluster;
mod depth;
mod features;
mod pack;
mod palette;
mod picture;
mod stills;
mod surface;
mod unused;

use serde::{Deserialize, Serialize};

pub(super) use pack::{Packed, compressed, pack};
pub(super) use stills::{Still, bar as colour_bar, mesh_picture, stills};
pub(super) use surface::Surface;

/// Direction that points up in the standard views.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum UpAxis {
    /// y up; the front view looks along -z.
    Y,
    /// z up; the front view looks along +y.
    #[default]
    Z,
}

/// Which figures a view makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum ShapeFigures {
    /// The mesh with its groups, then the mode shapes.
    #[default]
    MeshAndModes,
    /// The mode shapes alone.
    Modes,
    /// The mesh with its groups alone, as a still picture.
    Mesh,
}

/// A part of the structure with a name and a colour of its own.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShapeGroup {
    /// Name in the legend.
    pub name: String,
    /// Colour, an index into the page's colours for groups; begins again after the last.
    pub colour: usize,
}

/// A triangle of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShapeTriangle {
    /// Its corners: indices into [`ModeShapeView::points`].
    pub corners: [usize; 3],
    /// Its group: an index into [`ModeShapeView::groups`].
    pub group: usize,
}

/// A thick line through points of the structure that moves with it, such as a bearing ring.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShapeLine {
    /// Name in the legend.
    pub name: String,
    /// Its points in order: indices into [`ModeShapeView::points`].
    pub points: Vec<usize>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

/// A mode shape.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ShapeMode {
    /// Name in the list ("1").
    pub label: String,
    /// Eigenfrequency, Hz.
    pub frequency_hz: f64,
    /// What kind of motion it is, or a remark; may be empty.
    pub note: String,
    /// Displacement of each point, (points) x 3, in any unit: each mode is shown to its own largest.
    pub displacement: Vec<[f64; 3]>,
}

/// A structure with mode shapes, to look at. Lengths are in metres.
///
/// ```
/// use plummer::report::{ModeShapeView, ShapeGroup, ShapeMode, ShapeTriangle};
/// let view = ModeShapeView {
///     points: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
///     groups: vec![ShapeGroup { name: "plate".into(), colour: 0 }],
///     triangles: vec![ShapeTriangle { corners: [0, 1, 2], group: 0 }],
///     modes: vec![ShapeMode {
///         label: "1".into(),
///         frequency_hz: 12.5,
///         note: "bending".into(),
///         displacement: vec![[0.0; 3], [0.0, 0.0, 1.0], [0.0; 3]],
///     }],
///     ..ModeShapeView::new("Plate")
/// };
/// assert!(view.check().is_ok());
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModeShapeView {
    /// What is shown; the caption starts with it.
    pub title: String,
    /// Caption of the mode shapes; `None`: the title.
    pub caption: Option<String>,
    /// Coordinates, m; more points than the surface uses may stand here.
    pub points: Vec<[f64; 3]>,
    /// Parts with a name.
    pub groups: Vec<ShapeGroup>,
    /// The surface; nothing inside the structure.
    pub triangles: Vec<ShapeTriangle>,
    /// Edges of the elements on the surface; empty: the triangles' own edges.
    pub edges: Vec<[usize; 2]>,
    /// Edges of the structure, drawn as its undeformed outline too; empty: found where the surface has a kink of more
    /// than 30 degrees, ends, or meets another group.
    pub outline: Vec<[usize; 2]>,
    /// Thick lines.
    pub lines: Vec<ShapeLine>,
    /// Mode shapes, the one shown first in front.
    pub modes: Vec<ShapeMode>,
    /// Largest displacement shown, as a part of the size of the structure (diagonal of its bounding box): above 0 up
    /// to 1.
    pub amplitude: f64,
    /// Direction that points up.
    pub up: UpAxis,
    /// Which figures are made.
    pub figures: ShapeFigures,
}

impl ModeShapeView {
    /// A view with nothing in it yet, z up, displacements of 6 % of the size.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            caption: None,
            points: Vec::new(),
            groups: Vec::new(),
            triangles: Vec::new(),
            edges: Vec::new(),
            outline: Vec::new(),
            lines: Vec::new(),
            modes: Vec::new(),
            amplitude: 0.06,
            up: UpAxis::default(),
            figures: ShapeFigures::default(),
        }
    }
}

/// An entry of the legend.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(super) struct LegendEntry {
    name: String,
    colour: String,
    line: bool,
}

/// Names and colours of groups and lines, as all pictures show them.
pub(super) fn legend(view: &ModeShapeView) -> Vec<LegendEntry> {
    let groups = view.groups.iter().map(|group| LegendEntry {
        name: group.name.clone(),
        colour: palette::hex(palette::group(group.colour)),
        line: false,
    });
    let lines = view.lines.iter().map(|line| LegendEntry {
        name: line.name.clone(),
        colour: palette::hex(palette::LINE),
        line: true,
    });
    groups.chain(lines).collect()
}

#[cfg(test)]
pub(crate) mod samples;
