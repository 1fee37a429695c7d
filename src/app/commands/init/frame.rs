//! The bearing's frame in the mesh: where its angle 0 and its "up" point.

use nalgebra::Vector3;

/// Directions of a bearing in the mesh's axes, unit vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Directions {
    /// Along the shaft.
    pub axis: [f64; 3],
    /// The bearing's x, its angle 0.
    pub zero: [f64; 3],
    /// The bearing's y, against gravity.
    pub up: [f64; 3],
}

/// Angle (rad) below which a fitted axis counts as one of the mesh's: gmsh writes 16 digits, a drawing is not skewed by less.
const SNAP: f64 = 1e-6;

impl Directions {
    /// Up is the mesh's y, as gmsh's models have it, or its z for a shaft along y.
    pub(crate) fn of(axis: [f64; 3]) -> Self {
        let mut axis = Vector3::from(axis).normalize();
        for place in 0..3 {
            let mut unit = Vector3::zeros();
            unit[place] = axis[place].signum();
            if (axis - unit).norm() < SNAP {
                axis = unit;
            }
        }
        let upwards = if axis.y.abs() > 0.9 { Vector3::z() } else { Vector3::y() };
        let up = (upwards - axis * axis.dot(&upwards)).normalize();
        // without negative zeros
        let plain = |vector: Vector3<f64>| -> [f64; 3] { vector.map(|part| part + 0.0).into() };
        Self { axis: plain(axis), zero: plain(up.cross(&axis)), up: plain(up) }
    }
}

#[cfg(test)]
mod tests {
    use super::Directions;
    use crate::fe::model::RingFrame;

    #[test]
    fn the_frame_that_the_case_makes_has_its_y_upwards() {
        for (axis, up) in [
            ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
            ([1.0, 0.0, 1e-8], [0.0, 1.0, 0.0]),
            ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.6, 0.0, 0.8], [0.0, 1.0, 0.0]),
        ] {
            let found = Directions::of(axis);
            let frame = RingFrame::new([0.0; 3], found.axis, found.zero).unwrap();
            let y = frame.vector_to_mesh([0.0, 1.0, 0.0]);
            for place in 0..3 {
                assert!((y[place] - up[place]).abs() < 1e-12, "{axis:?}: {y:?}");
                assert!((y[place] - found.up[place]).abs() < 1e-12, "{axis:?}: {y:?}");
            }
        }
        let snapped = Directions::of([1.0, 0.0, 1e-8]).axis;
        assert_eq!(snapped.map(f64::to_bits), [1.0_f64, 0.0, 0.0].map(f64::to_bits));
        let kept = Directions::of([1.0, 0.0, 1e-4]).axis;
        assert!(kept[2] > 9e-5);
    }
}
