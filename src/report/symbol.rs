//! Symbols at the points of a curve.

use super::plot::Symbol;

/// Half the size of a filled symbol, and of one that goes around another, pixels.
const FILLED: f64 = 3.5;
const AROUND: f64 = 7.0;

impl Symbol {
    /// Path data around the origin, `l` its half size in pixels; the script of the page puts the same at its points.
    pub(super) fn path(self) -> String {
        let (l, m) = (FILLED, AROUND);
        let wide = 1.25 * l;
        match self {
            Self::Dot => circle(l),
            Self::Diamond => format!("M0 -{wide}L{wide} 0L0 {wide}L-{wide} 0Z"),
            Self::Square => format!("M-{l} -{l}H{l}V{l}H-{l}Z"),
            Self::Triangle => format!("M0 -{wide}L{wide} {l}H-{wide}Z"),
            Self::Ring => circle(m),
            Self::Frame => format!("M-{m} -{m}H{m}V{m}H-{m}Z"),
        }
    }

    /// Whether it goes around a point instead of covering it.
    pub(super) fn is_open(self) -> bool {
        matches!(self, Self::Ring | Self::Frame)
    }
}

fn circle(r: f64) -> String {
    format!("M-{r} 0A{r} {r} 0 1 1 {r} 0A{r} {r} 0 1 1 -{r} 0Z")
}
