//! Vectors in space, and from where a structure is looked at: standard views and the parallel projection of points.

use serde::{Deserialize, Serialize};

/// A vector in space.
pub(super) type Vector = [f64; 3];

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The vector of length 1, or as it is if it has none.
pub(super) fn unit(a: Vector) -> Vector {
    let length = magnitude(&a);
    if length > 0.0 { a.map(|v| v / length) } else { a }
}

/// The length of a vector.
pub(super) fn magnitude(d: &Vector) -> f64 {
    dot(*d, *d).sqrt()
}

/// Lowest and highest coordinates; zero without points.
pub(super) fn bounds(points: &[Vector]) -> (Vector, Vector) {
    let Some(first) = points.first() else {
        return ([0.0; 3], [0.0; 3]);
    };
    points.iter().fold((*first, *first), |(low, high), p| {
        (std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k])))
    })
}

/// Diagonal of the box round the points; zero without points.
pub(super) fn diagonal(points: &[Vector]) -> f64 {
    let (low, high) = bounds(points);
    magnitude(&minus(high, low))
}

/// Direction that points up in the standard views.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum UpAxis {
    /// y up; the front view looks along -z.
    Y,
    /// z up; the front view looks along +y.
    #[default]
    Z,
}

/// Right, up and towards the viewer: three unit vectors, right-handed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Camera {
    pub(super) right: Vector,
    pub(super) up: Vector,
    pub(super) back: Vector,
}

/// Names of the standard views, the isometric one first.
pub(super) const NAMES: [&str; 4] = ["iso", "front", "side", "top"];

impl Camera {
    fn looking(back: Vector, right: Vector) -> Self {
        let (back, right) = (unit(back), unit(right));
        Self { right, up: cross(back, right), back }
    }

    /// The standard views, in the order of [`NAMES`].
    pub(super) fn standard(up: UpAxis) -> [Self; 4] {
        let x = [1.0, 0.0, 0.0];
        let (front, high) = match up {
            UpAxis::Z => ([0.0, -1.0, 0.0], [0.0, 0.0, 1.0]),
            UpAxis::Y => ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
        };
        let corner: Vector = std::array::from_fn(|k| x[k] + front[k] + high[k]);
        [
            Self::looking(corner, minus(x, front)),
            Self::looking(front, x),
            Self::looking(x, front.map(|v| -v)),
            Self::looking(high, x),
        ]
    }

    /// Which standard view suits a structure: across it if it is flat, else the isometric one.
    pub(super) fn best(views: &[Self; 4], low: Vector, high: Vector) -> usize {
        let size = minus(high, low);
        let diagonal = magnitude(&size);
        let flat = |camera: &Self| {
            let depth: f64 = (0..3).map(|k| (camera.back[k] * size[k]).abs()).sum();
            depth < 1e-3 * diagonal
        };
        (1..4).find(|k| flat(&views[*k])).unwrap_or(0)
    }

    /// Right, up, and towards the viewer, of a point.
    pub(super) fn project(&self, point: Vector) -> Vector {
        [dot(self.right, point), dot(self.up, point), dot(self.back, point)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_views_are_right_handed_and_upright() {
        for (up, axis) in [(UpAxis::Z, 2), (UpAxis::Y, 1)] {
            for (name, camera) in NAMES.iter().zip(Camera::standard(up)) {
                let off = minus(cross(camera.right, camera.up), camera.back);
                assert!(dot(off, off) < 1e-24, "{name}");
                assert!((dot(camera.up, camera.up) - 1.0).abs() < 1e-12, "{name}");
                // Up is up, except where one looks down on it.
                assert_eq!(camera.up[axis] > 0.1, *name != "top", "{name}");
                // x never points left.
                assert!(camera.right[0] > -1e-12, "{name}");
            }
        }
    }

    #[test]
    fn the_isometric_view_shortens_the_axes_alike() {
        let iso = Camera::standard(UpAxis::Z)[0];
        for axis in 0..3 {
            let mut e = [0.0; 3];
            e[axis] = 1.0;
            let [u, v, _] = iso.project(e);
            // sqrt(2/3), the ratio of the isometric projection
            assert!((u.hypot(v) - (2.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        }
    }

    #[test]
    fn flat_structures_are_looked_at_across() {
        let choose = |up, high| Camera::best(&Camera::standard(up), [0.0; 3], high);
        assert_eq!(choose(UpAxis::Z, [1.0, 2.0, 0.0]), 3);
        assert_eq!(choose(UpAxis::Y, [1.0, 2.0, 0.0]), 1);
        assert_eq!(choose(UpAxis::Z, [1.0, 0.0, 3.0]), 1);
        assert_eq!(choose(UpAxis::Z, [1.0, 2.0, 0.1]), 0);
    }
}
