//! The two precisions in which a factor is computed and kept.

/// A precision.
pub(super) trait Precision: faer::traits::RealField + Copy + Default {
    /// Values in a register of 32 bytes.
    const REGISTER: usize;
    /// The nearest value.
    fn rounded(value: f64) -> Self;
    /// The value in double precision.
    fn exact(self) -> f64;
    /// `self factor + term`, rounded once.
    fn fused(self, factor: Self, term: Self) -> Self;
}

impl Precision for f32 {
    const REGISTER: usize = 8;
    #[inline(always)]
    fn rounded(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn exact(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }
}

impl Precision for f64 {
    const REGISTER: usize = 4;
    #[inline(always)]
    fn rounded(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn exact(self) -> f64 {
        self
    }
    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }
}
