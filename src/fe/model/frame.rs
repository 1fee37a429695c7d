//! Where the bearing sits in the mesh.

use nalgebra::{Matrix3, Vector3};

/// The bearing's frame in the mesh's axes: x along the angle 0, y at 90 degrees, z along the axis of rotation.
///
/// Local components of a vector are `turn v`, a point's are `turn (p - centre)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingFrame {
    centre: Vector3<f64>,
    /// Rows: the frame's unit vectors in the mesh's axes.
    turn: Matrix3<f64>,
}

impl Default for RingFrame {
    /// The mesh's own frame.
    fn default() -> Self {
        Self { centre: Vector3::zeros(), turn: Matrix3::identity() }
    }
}

impl RingFrame {
    /// The frame at `centre` (m) with the axis of rotation along `axis` and the angle 0 along the part of
    /// `zero` across it; lengths do not matter. `None` if `zero` lies along the axis or one of them vanishes.
    pub fn new(centre: [f64; 3], axis: [f64; 3], zero: [f64; 3]) -> Option<Self> {
        let unit = |v: Vector3<f64>| v.try_normalize(f64::MIN_POSITIVE);
        let z = unit(Vector3::from(axis))?;
        let zero = unit(Vector3::from(zero))?;
        // directions nearer than a millionth of a radian count as one
        let x = (zero - z * z.dot(&zero)).try_normalize(1e-6)?;
        let y = z.cross(&x);
        Some(Self {
            centre: Vector3::from(centre),
            turn: Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]),
        })
    }

    /// Centre of the ring in the mesh's axes, m.
    pub fn centre(&self) -> [f64; 3] {
        self.centre.into()
    }

    /// Unit vector of the axis of rotation in the mesh's axes.
    pub fn axis(&self) -> [f64; 3] {
        self.turn.row(2).transpose().into()
    }

    /// A point (m, mesh axes) in the frame.
    pub fn point(&self, point: [f64; 3]) -> [f64; 3] {
        (self.turn * (Vector3::from(point) - self.centre)).into()
    }

    /// A vector with components in the mesh's axes, in the frame.
    pub fn vector(&self, vector: [f64; 3]) -> [f64; 3] {
        (self.turn * Vector3::from(vector)).into()
    }

    /// A vector with components in the frame, in the mesh's axes.
    pub(crate) fn vector_to_mesh(&self, vector: [f64; 3]) -> [f64; 3] {
        (self.turn.transpose() * Vector3::from(vector)).into()
    }

    /// A point of the frame (m) in the mesh's axes.
    pub(crate) fn point_to_mesh(&self, point: [f64; 3]) -> [f64; 3] {
        (self.turn.transpose() * Vector3::from(point) + self.centre).into()
    }

    /// Unit vectors (radial, tangential, axial) at a point (m, mesh axes), in the mesh's axes as rows; radial
    /// is the frame's x on the axis itself.
    pub(crate) fn polar_axes(&self, point: [f64; 3]) -> [[f64; 3]; 3] {
        let [x, y, _] = self.point(point);
        let (sin, cos) = y.atan2(x).sin_cos();
        [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]].map(|v| self.vector_to_mesh(v))
    }
}

#[cfg(test)]
mod tests {
    use super::RingFrame;

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14)
    }

    #[test]
    fn components_of_a_frame_along_y() {
        let frame = RingFrame::new([1.0, 2.0, 3.0], [0.0, 2.0, 0.0], [0.0, 5.0, 1.0]).expect("a frame");
        // z' = y, x' = z, so y' = z' x x' = y x z = x
        assert!(near(frame.point([1.5, 2.25, 3.125]), [0.125, 0.5, 0.25]));
        assert!(near(frame.vector_to_mesh([0.0, 1.0, 0.0]), [1.0, 0.0, 0.0]));
        assert!(near(frame.axis(), [0.0, 1.0, 0.0]));
        assert!(near(frame.point_to_mesh([0.125, 0.5, 0.25]), [1.5, 2.25, 3.125]));
        let [radial, tangential, axial] = frame.polar_axes([2.0, 7.0, 3.0]);
        assert!(near(radial, [1.0, 0.0, 0.0]));
        assert!(near(tangential, [0.0, 0.0, -1.0]));
        assert!(near(axial, [0.0, 1.0, 0.0]));
    }

    #[test]
    fn a_zero_along_the_axis_makes_no_frame() {
        assert!(RingFrame::new([0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, -2.0]).is_none());
        assert!(RingFrame::new([0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]).is_none());
    }
}
