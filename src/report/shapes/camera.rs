//! From where a structure is looked at: standard views and the parallel projection of points.

use serde::Serialize;

use super::vector::{Vector, cross, dot, magnitude, minus, unit};
use super::view::UpAxis;

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
