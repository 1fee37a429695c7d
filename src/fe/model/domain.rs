//! The natural coordinates that a face has.

use crate::fe::element::continuum::SurfaceKind;

/// The natural coordinates that a face has.
pub(super) struct Domain {
    pub dimension: usize,
    pub centre: [f64; 2],
    triangle: bool,
    pub sides: &'static [[[f64; 2]; 2]],
}

impl Domain {
    pub(super) fn of(kind: SurfaceKind) -> Self {
        const ENDS: [[[f64; 2]; 2]; 2] = [[[-1.0, 0.0]; 2], [[1.0, 0.0]; 2]];
        const TRIANGLE: [[[f64; 2]; 2]; 3] =
            [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [0.0, 1.0]], [[0.0, 1.0], [0.0, 0.0]]];
        const SQUARE: [[[f64; 2]; 2]; 4] = [
            [[-1.0, -1.0], [1.0, -1.0]],
            [[1.0, -1.0], [1.0, 1.0]],
            [[1.0, 1.0], [-1.0, 1.0]],
            [[-1.0, 1.0], [-1.0, -1.0]],
        ];
        let (dimension, triangle, sides): (_, _, &'static [_]) = match kind {
            SurfaceKind::Line2 | SurfaceKind::Line3 => (1, false, &ENDS),
            SurfaceKind::Tri3 | SurfaceKind::Tri6 => (2, true, &TRIANGLE),
            SurfaceKind::Quad4 | SurfaceKind::Quad8 => (2, false, &SQUARE),
        };
        let centre = if triangle { [1.0 / 3.0; 2] } else { [0.0; 2] };
        Self { dimension, centre, triangle, sides }
    }

    fn within(&self, [xi, eta]: [f64; 2], margin: f64) -> bool {
        if self.triangle {
            xi >= -margin && eta >= -margin && xi + eta <= 1.0 + margin
        } else {
            xi.abs() <= 1.0 + margin && eta.abs() <= 1.0 + margin
        }
    }

    /// Inside or on the boundary, but for round-off.
    pub(super) fn contains(&self, natural: [f64; 2]) -> bool {
        self.within(natural, 1e-12)
    }

    /// Not so far out that a search from there could still end inside.
    pub(super) fn near(&self, natural: [f64; 2]) -> bool {
        self.within(natural, 1.0)
    }
}
