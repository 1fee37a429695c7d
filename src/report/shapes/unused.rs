//! A view without what is not seen.

use super::ModeShapeView;

impl ModeShapeView {
    /// The view without the points that nothing of it uses, such as those inside a solid. Its figures are the same. A view with
    /// an index that points at nothing stays as it is; [`check`](Self::check) names the index.
    #[must_use]
    pub fn without_unused_points(mut self) -> Self {
        let mut used = vec![false; self.points.len()];
        let corners = self.triangles.iter().flat_map(|triangle| triangle.corners);
        let ends = self.edges.iter().chain(&self.outline).flatten().copied();
        let lines = self
            .lines
            .iter()
            .flat_map(|line| line.points.iter().copied());
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

/// Keeps the entries of used points; those past the last point stay.
fn keep<T>(entries: &mut Vec<T>, used: &[bool]) {
    let mut index = 0;
    entries.retain(|_| {
        index += 1;
        used.get(index - 1).copied().unwrap_or(true)
    });
}

#[cfg(test)]
mod tests {
    use super::super::ShapeFigures;
    use super::super::samples::cube;
    use crate::report::{Report, Section};

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
