//! Whether the parts of a view fit together.

use super::ModeShapeView;
use crate::report::ReportError;

impl ModeShapeView {
    /// Checks that there is a surface, that every index points at something, and that all numbers are finite.
    ///
    /// # Errors
    /// [`ReportError::EmptyShape`], [`ReportError::ShapeIndex`], [`ReportError::ShapeLength`] or
    /// [`ReportError::ShapeNumber`].
    pub fn check(&self) -> Result<(), ReportError> {
        let extent = extent(&self.points);
        if self.triangles.is_empty() || extent <= 0.0 {
            return Err(ReportError::EmptyShape {
                view: self.title.clone(),
            });
        }
        let number = |what: &str| ReportError::ShapeNumber {
            view: self.title.clone(),
            what: what.to_owned(),
        };
        if !extent.is_finite() || !self.points.iter().flatten().all(|v| v.is_finite()) {
            return Err(number("a coordinate"));
        }
        if !(self.amplitude > 0.0 && self.amplitude <= 1.0) {
            return Err(number("the amplitude"));
        }
        self.check_indices()?;
        for mode in &self.modes {
            if mode.displacement.len() != self.points.len() {
                return Err(ReportError::ShapeLength {
                    view: self.title.clone(),
                    mode: mode.label.clone(),
                    found: mode.displacement.len(),
                    expected: self.points.len(),
                });
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
            Err(ReportError::ShapeIndex {
                view: self.title.clone(),
                what,
                index,
                count,
            })
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
}

/// Diagonal of the bounding box; minus infinity without points.
fn extent(points: &[[f64; 3]]) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    if points.is_empty() {
        return f64::NEG_INFINITY;
    }
    let sum: f64 = (0..3).map(|axis| (high[axis] - low[axis]).powi(2)).sum();
    sum.sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::samples::cube;
    use super::*;

    fn message(change: impl Fn(&mut ModeShapeView)) -> String {
        let mut view = cube(2, 1);
        change(&mut view);
        view.check().expect_err("must fail").to_string()
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        assert!(cube(2, 1).check().is_ok());
        for (found, expected) in [
            (
                message(|v| v.triangles.clear()),
                "shape \"Cube\" has no surface with an extent",
            ),
            (
                message(|v| v.points.iter_mut().for_each(|p| *p = [1.0; 3])),
                "shape \"Cube\" has no surface with an extent",
            ),
            (
                message(|v| v.triangles[3].corners[1] = 26),
                "shape \"Cube\": corner of a triangle is 26, there are 26",
            ),
            (
                message(|v| v.triangles[3].group = 7),
                "shape \"Cube\": group of a triangle is 7, there are 2",
            ),
            (
                message(|v| v.outline.push([0, 99])),
                "shape \"Cube\": end of an edge is 99, there are 26",
            ),
            (
                message(|v| v.lines[0].points[0] = 26),
                "shape \"Cube\": point of a line is 26, there are 26",
            ),
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
            (
                message(|v| v.points[3][1] = f64::INFINITY),
                "shape \"Cube\": a coordinate is not a number in range",
            ),
            (
                message(|v| v.amplitude = 0.0),
                "shape \"Cube\": the amplitude is not a number in range",
            ),
        ] {
            assert_eq!(found, expected);
        }
    }
}
