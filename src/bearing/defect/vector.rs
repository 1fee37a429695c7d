//! Plane vectors in a defect's frame: origin at the centre of the circle that carries it, axes fixed to its middle.

/// `along` the circle at the defect's middle (counter-clockwise), `outward` from its centre; m or 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vector {
    pub along: f64,
    pub outward: f64,
}

impl Vector {
    /// Unit vector from the centre at `angle` (rad) from the defect's middle.
    #[inline]
    pub(super) fn radial(angle: f64) -> Self {
        let (along, outward) = angle.sin_cos();
        Self { along, outward }
    }

    /// A quarter turn clockwise: the counter-clockwise tangent of a radial vector.
    #[inline]
    pub(super) fn tangent(self) -> Self {
        Self { along: self.outward, outward: -self.along }
    }

    /// A quarter turn counter-clockwise: the outward normal of a tangent.
    #[inline]
    pub(super) fn normal(self) -> Self {
        Self { along: -self.outward, outward: self.along }
    }

    #[inline]
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { along: factor * self.along, outward: factor * self.outward }
    }

    #[inline]
    pub(super) fn plus(self, other: Self) -> Self {
        Self { along: self.along + other.along, outward: self.outward + other.outward }
    }

    #[inline]
    pub(super) fn minus(self, other: Self) -> Self {
        Self { along: self.along - other.along, outward: self.outward - other.outward }
    }

    #[inline]
    pub(super) fn dot(self, other: Self) -> f64 {
        self.along * other.along + self.outward * other.outward
    }

    #[inline]
    pub(super) fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// Mirror image in the defect's middle.
    #[inline]
    pub(super) fn mirrored(self) -> Self {
        Self { along: -self.along, outward: self.outward }
    }
}
