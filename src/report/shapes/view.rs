//! A structure with its mode shapes as plain data, checked and brought down to what is seen of it.

use serde::{Deserialize, Serialize};

use super::super::{ReportError, significant, svg};
use super::camera::{UpAxis, diagonal};

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
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
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

impl ShapeMode {
    /// The frequency as it is printed.
    pub(in crate::report) fn frequency(&self) -> String {
        format!("{} Hz", significant(self.frequency_hz, 7))
    }
}

impl ModeShapeView {
    /// A view with nothing in it yet, z up, displacements of 6 % of the size.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), amplitude: 0.06, ..Self::default() }
    }

    /// Checks that there is a surface, that every index points at something, and that all numbers are finite.
    ///
    /// # Errors
    /// [`ReportError`] that names the first that is wrong.
    pub fn check(&self) -> Result<(), ReportError> {
        let extent = diagonal(&self.points);
        if self.triangles.is_empty() || extent <= 0.0 {
            return Err(ReportError(format!("shape \"{}\" has no surface with an extent", self.title)));
        }
        let number = |what: &str| ReportError(format!("shape \"{}\": {what} is not a number in range", self.title));
        if !extent.is_finite() || !self.points.iter().flatten().all(|v| v.is_finite()) {
            return Err(number("a coordinate"));
        }
        if !(self.amplitude > 0.0 && self.amplitude <= 1.0) {
            return Err(number("the amplitude"));
        }
        self.check_indices()?;
        for mode in &self.modes {
            let [found, expected] = [mode.displacement.len(), self.points.len()];
            if found != expected {
                let (view, mode) = (&self.title, &mode.label);
                return Err(ReportError(format!(
                    "shape \"{view}\": mode \"{mode}\" has {found} displacements for {expected} points"
                )));
            }
            let finite = mode.displacement.iter().flatten().all(|v| v.is_finite());
            if !finite || !mode.frequency_hz.is_finite() {
                return Err(number(&format!("mode \"{}\"", mode.label)));
            }
        }
        Ok(())
    }

    fn check_indices(&self) -> Result<(), ReportError> {
        let within = |what: &'static str, index: usize, count: usize| {
            if index < count {
                return Ok(());
            }
            Err(ReportError(format!("shape \"{}\": {what} is {index}, there are {count}", self.title)))
        };
        let points = self.points.len();
        for triangle in &self.triangles {
            for corner in triangle.corners {
                within("corner of a triangle", corner, points)?;
            }
            within("group of a triangle", triangle.group, self.groups.len())?;
        }
        for end in self.edges.iter().chain(&self.outline).flatten() {
            within("end of an edge", *end, points)?;
        }
        for point in self.lines.iter().flat_map(|line| &line.points) {
            within("point of a line", *point, points)?;
        }
        Ok(())
    }

    /// The view without the points that nothing of it uses, such as those inside a solid. Its figures are the same. A view with
    /// an index that points at nothing stays as it is; [`check`](Self::check) names the index.
    pub(crate) fn without_unused_points(mut self) -> Self {
        let mut used = vec![false; self.points.len()];
        let corners = self.triangles.iter().flat_map(|triangle| triangle.corners);
        let ends = self.edges.iter().chain(&self.outline).flatten().copied();
        let lines = self.lines.iter().flat_map(|line| line.points.iter().copied());
        for point in corners.chain(ends).chain(lines) {
            match used.get_mut(point) {
                Some(used) => *used = true,
                None => return self,
            }
        }
        let mut place = Vec::with_capacity(used.len());
        let mut next = 0;
        for &used in &used {
            place.push(next);
            next += usize::from(used);
        }
        keep(&mut self.points, &used);
        for mode in &mut self.modes {
            keep(&mut mode.displacement, &used);
        }
        let corners = self.triangles.iter_mut().flat_map(|t| &mut t.corners);
        let ends = self.edges.iter_mut().chain(&mut self.outline).flatten();
        let lines = self.lines.iter_mut().flat_map(|line| &mut line.points);
        for point in corners.chain(ends).chain(lines) {
            *point = place[*point];
        }
        self
    }
}

/// An entry of the legend.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(in crate::report) struct LegendEntry {
    name: String,
    colour: String,
    line: bool,
}

/// Names and colours of groups and lines, as all pictures show them.
pub(in crate::report) fn legend(view: &ModeShapeView) -> Vec<LegendEntry> {
    let entry = |name: &String, colour, line| LegendEntry { name: name.clone(), colour: svg::hex(colour), line };
    let groups = view.groups.iter().map(|group| entry(&group.name, svg::group(group.colour), false));
    let lines = view.lines.iter().map(|line| entry(&line.name, svg::LINE, true));
    groups.chain(lines).collect()
}

/// Keeps the entries of used points; those past the last point stay.
fn keep<T>(entries: &mut Vec<T>, used: &[bool]) {
    let mut used = used.iter();
    entries.retain(|_| used.next().copied().unwrap_or(true));
}

#[cfg(test)]
mod tests {
    use super::super::samples::cube;
    use super::*;
    use crate::report::{Report, Section};

    fn message(change: impl Fn(&mut ModeShapeView)) -> String {
        let mut view = cube(2, 1);
        change(&mut view);
        view.check().expect_err("must fail").to_string()
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        assert!(cube(2, 1).check().is_ok());
        for (found, expected) in [
            (message(|v| v.triangles.clear()), "shape \"Cube\" has no surface with an extent"),
            (
                message(|v| v.points.iter_mut().for_each(|p| *p = [1.0; 3])),
                "shape \"Cube\" has no surface with an extent",
            ),
            (message(|v| v.triangles[3].corners[1] = 26), "shape \"Cube\": corner of a triangle is 26, there are 26"),
            (message(|v| v.triangles[3].group = 7), "shape \"Cube\": group of a triangle is 7, there are 2"),
            (message(|v| v.outline.push([0, 99])), "shape \"Cube\": end of an edge is 99, there are 26"),
            (message(|v| v.lines[0].points[0] = 26), "shape \"Cube\": point of a line is 26, there are 26"),
            (
                message(|v| {
                    v.modes[0].displacement.pop();
                }),
                "shape \"Cube\": mode \"1\" has 25 displacements for 26 points",
            ),
            (
                message(|v| v.modes[0].displacement[3][1] = f64::NAN),
                "shape \"Cube\": mode \"1\" is not a number in range",
            ),
            (message(|v| v.points[3][1] = f64::INFINITY), "shape \"Cube\": a coordinate is not a number in range"),
            (message(|v| v.amplitude = 0.0), "shape \"Cube\": the amplitude is not a number in range"),
        ] {
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn the_page_is_the_same() {
        let mut view = cube(4, 2);
        view.figures = ShapeFigures::MeshAndModes;
        let lean = view.clone();
        // points within, in front, between and behind
        let up = |from: usize| move |k: &mut usize| *k += usize::from(*k >= from);
        for from in [0, 7, view.points.len()] {
            view.points.insert(from, [0.5; 3]);
            for mode in &mut view.modes {
                mode.displacement.insert(from, [1e3; 3]);
            }
            let corners = view.triangles.iter_mut().flat_map(|t| &mut t.corners);
            corners.for_each(up(from));
            let ends = view.edges.iter_mut().chain(&mut view.outline).flatten();
            ends.for_each(up(from));
            let lines = view.lines.iter_mut().flat_map(|line| &mut line.points);
            lines.for_each(up(from));
        }
        let page = |view| {
            let report = Report::new("t", "c", "0").section(Section::new("S").shapes(view));
            report.to_html().expect("a valid report")
        };
        assert_eq!(view.points.len(), lean.points.len() + 3);
        let with = page(view.clone());
        let without = view.without_unused_points();
        assert_eq!(without, lean);
        assert!(page(without) == with);
    }

    #[test]
    fn a_wrong_index_is_left_to_the_check() {
        let mut view = cube(2, 1);
        view.points.push([9.0; 3]);
        view.edges.push([0, 1000]);
        let same = view.clone().without_unused_points();
        assert_eq!(same, view);
        assert!(same.check().is_err());
    }
}
