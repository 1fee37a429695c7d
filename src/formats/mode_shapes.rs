//! Mode shapes as other programs give and take them.

use std::collections::HashSet;

use crate::files::Fault;

/// Frequencies and shapes of some modes at some points, from a calculation or a measurement.
///
/// Units: frequencies in Hz, points in m, shapes in any unit (a shape is known up to a factor). Directions are those of
/// the points' own axes x, y, z.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeShapes {
    /// Frequency of each mode, Hz, >= 0.
    pub frequencies_hz: Vec<f64>,
    /// Label of each point, each once, if they have labels.
    pub node_tags: Option<Vec<u64>>,
    /// Coordinates (x, y, z) of each point, m, if they are known.
    pub points: Option<Vec<[f64; 3]>>,
    /// Displacements of each mode: (u_x, u_y, u_z) of the first point, of the second, ...
    pub shapes: Vec<Vec<f64>>,
    /// The one direction in which each point was measured, of length 1; its displacements are along it. A point stands there
    /// once for each of its directions. `None`: displacements are known in space.
    pub directions: Option<Vec<[f64; 3]>>,
}

impl ModeShapes {
    /// Number of points.
    pub fn count_points(&self) -> usize {
        let tags = self.node_tags.as_ref().map(Vec::len);
        let points = self.points.as_ref().map(Vec::len);
        tags.or(points).or(self.shapes.first().map(|shape| shape.len() / 3)).unwrap_or(0)
    }

    /// Number of modes.
    pub fn count_modes(&self) -> usize {
        self.frequencies_hz.len()
    }

    /// Checks that the lengths fit each other and that every number is one. Every reader of this module has checked
    /// what it returns, every writer checks what it is given.
    ///
    /// # Errors
    /// [`Fault`], the first that is found.
    pub fn check(&self) -> Result<(), Fault> {
        let (modes, points) = (self.count_modes(), self.count_points());
        let found = format_args!("{modes} modes at {points} points");
        Fault::unless(modes > 0 && points > 0, "at least one mode at one point", found)?;
        let shapes = self.shapes.len();
        let expected = format!("a shape for each of {modes} frequencies");
        Fault::unless(shapes == modes, expected, format_args!("{shapes} shapes"))?;
        self.check_points(points)?;
        for (index, &found) in self.frequencies_hz.iter().enumerate() {
            if !(found.is_finite() && found >= 0.0) {
                let expected = format!("a frequency >= 0 Hz for mode {}", index + 1);
                return Err(Fault::new(expected, found));
            }
        }
        for (index, shape) in self.shapes.iter().enumerate() {
            let mode = index + 1;
            if shape.len() != 3 * points {
                let expected = format!("{} values in mode {mode} (three a point)", 3 * points);
                return Err(Fault::new(expected, shape.len()));
            }
            if let Some(place) = shape.iter().position(|value| !value.is_finite()) {
                let found = format!("{} at point {}", shape[place], place / 3 + 1);
                let expected = format!("finite displacements in mode {mode}");
                return Err(Fault::new(expected, found));
            }
        }
        Ok(())
    }

    fn check_points(&self, count: usize) -> Result<(), Fault> {
        if let Some(points) = &self.points {
            let found = format_args!("{} points and {count} labels", points.len());
            Fault::unless(points.len() == count, "as many points as labels", found)?;
            let values = points.as_flattened();
            if let Some(place) = values.iter().position(|value| !value.is_finite()) {
                let found = format!("{} at point {}", values[place], place / 3 + 1);
                return Err(Fault::new("finite coordinates", found));
            }
        }
        let mut seen = HashSet::new();
        let mut tags = self.node_tags.iter().flatten().enumerate();
        if let Some(directions) = &self.directions {
            let found = format_args!("{} directions at {count} points", directions.len());
            Fault::unless(directions.len() == count, "a direction a point", found)?;
            let mut seen = HashSet::new();
            // of opposite ones one is enough
            let mut twice = tags.find(|&(row, tag)| !seen.insert((tag, directions[row].map(|x| x.abs().to_bits()))));
            return match twice.take() {
                Some((_, tag)) => Err(Fault::new("each direction of a node once", format!("node {tag} twice in one"))),
                None => Ok(()),
            };
        }
        match tags.find(|&(_, &tag)| !seen.insert(tag)) {
            Some((_, tag)) => Err(Fault::new("each node once", format!("node {tag} twice"))),
            None => Ok(()),
        }
    }
}

/// Real part of a complex shape turned by the angle that makes its imaginary part least.
///
/// For `phi exp(-i a)` the sum of squared imaginary parts is `(sum |phi|^2 - Re(exp(-2 i a) sum phi^2)) / 2`, least at
/// `a = arg(sum phi^2) / 2`. Real shapes are left as they are.
pub(super) fn real_part(shape: &[[f64; 2]]) -> Vec<f64> {
    // so that squares neither overflow nor vanish
    let largest = shape.as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let [mut real, mut imaginary] = [0.0, 0.0];
    for [re, im] in shape {
        let (re, im) = (re / scale, im / scale);
        real += re * re - im * im;
        imaginary += 2.0 * re * im;
    }
    let (sine, cosine) = (imaginary.atan2(real) / 2.0).sin_cos();
    shape.iter().map(|[re, im]| re * cosine + im * sine).collect()
}

#[cfg(test)]
pub(super) mod samples {
    use super::ModeShapes;

    /// Two modes at three points with labels that are neither sorted nor dense.
    pub(in crate::formats) fn two_modes() -> ModeShapes {
        ModeShapes {
            frequencies_hz: vec![12.5, 1_234.567_890_123],
            node_tags: Some(vec![7, 3, 120_000]),
            points: Some(vec![[0.0, 0.1, 0.2], [1.0 / 3.0, -2e-7, 0.0], [1.0, 2.0, 3.0]]),
            shapes: vec![
                vec![1.0, 0.0, -0.5, 0.25, 1e-3, 0.0, -1.0, 2.0 / 3.0, 1e-30],
                vec![0.1, 0.2, 0.3, -0.4, 0.5, 0.6, 0.7, -0.8, 0.9],
            ],
            directions: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Spoil = fn(&mut ModeShapes);

    #[test]
    fn every_contradiction_is_told() {
        let cases: [(Spoil, &str); 9] = [
            (
                |modes| modes.frequencies_hz.clear(),
                "expected at least one mode at one point, found 0 modes at 3 points",
            ),
            (|modes| modes.frequencies_hz.push(1.0), "expected a shape for each of 3 frequencies, found 2 shapes"),
            (|modes| modes.shapes[1].push(1.0), "expected 9 values in mode 2 (three a point), found 10"),
            (
                |modes| modes.points = Some(vec![[0.0; 3]; 2]),
                "expected as many points as labels, found 2 points and 3 labels",
            ),
            (|modes| modes.node_tags = Some(vec![7, 3, 7]), "expected each node once, found node 7 twice"),
            (|modes| modes.frequencies_hz[1] = -1.0, "expected a frequency >= 0 Hz for mode 2, found -1"),
            (|modes| modes.frequencies_hz[0] = f64::NAN, "expected a frequency >= 0 Hz for mode 1, found NaN"),
            (
                |modes| modes.shapes[1][5] = f64::INFINITY,
                "expected finite displacements in mode 2, found inf at point 2",
            ),
            (
                |modes| modes.points = Some(vec![[0.0, f64::NAN, 0.0]; 3]),
                "expected finite coordinates, found NaN at point 1",
            ),
        ];
        assert_eq!(samples::two_modes().check(), Ok(()));
        for (spoil, expected) in cases {
            let mut modes = samples::two_modes();
            spoil(&mut modes);
            assert_eq!(modes.check().unwrap_err().to_string(), expected);
        }
    }
}
