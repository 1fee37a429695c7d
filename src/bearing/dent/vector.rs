//! Plane vectors in the dent's frame: origin at the race's centre, axes fixed to the dent's middle.

/// `along` the race at the dent's middle (counter-clockwise), `outward` from the race's centre; m or 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vector {
    pub along: f64,
    pub outward: f64,
}

impl Vector {
    /// Unit vector from the race's centre at `angle` (rad) from the dent's middle.
    #[inline]
    pub fn radial(angle: f64) -> Self {
        let (along, outward) = angle.sin_cos();
        Self { along, outward }
    }

    /// A quarter turn clockwise: the counter-clockwise tangent of a radial vector.
    #[inline]
    pub fn tangent(self) -> Self {
        Self {
            along: self.outward,
            outward: -self.along,
        }
    }

    /// A quarter turn counter-clockwise: the outward normal of a tangent.
    #[inline]
    pub fn normal(self) -> Self {
        Self {
            along: -self.outward,
            outward: self.along,
        }
    }

    #[inline]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            along: factor * self.along,
            outward: factor * self.outward,
        }
    }

    #[inline]
    pub fn plus(self, other: Self) -> Self {
        Self {
            along: self.along + other.along,
            outward: self.outward + other.outward,
        }
    }

    #[inline]
    pub fn minus(self, other: Self) -> Self {
        Self {
            along: self.along - other.along,
            outward: self.outward - other.outward,
        }
    }

    #[inline]
    pub fn dot(self, other: Self) -> f64 {
        self.along * other.along + self.outward * other.outward
    }

    #[inline]
    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// Mirror image in the dent's middle.
    #[inline]
    pub fn mirrored(self) -> Self {
        Self {
            along: -self.along,
            outward: self.outward,
        }
    }
}
