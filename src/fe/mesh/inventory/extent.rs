//! Where the nodes are.

use schemars::JsonSchema;
use serde::Serialize;

/// Smallest box with sides along the axes that holds all nodes, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct BoundingBox {
    /// Lower corner, m.
    pub min: [f64; 3],
    /// Upper corner, m.
    pub max: [f64; 3],
}

impl BoundingBox {
    /// Extent of the points; the origin if there are none.
    pub(crate) fn of(mut points: impl Iterator<Item = [f64; 3]>) -> Self {
        let first = points.next().unwrap_or_default();
        let mut found = Self { min: first, max: first };
        points.for_each(|point| found.add(point));
        found
    }

    /// Grows until it holds the point.
    pub(super) fn add(&mut self, point: [f64; 3]) {
        for (axis, value) in point.into_iter().enumerate() {
            self.min[axis] = self.min[axis].min(value);
            self.max[axis] = self.max[axis].max(value);
        }
    }

    /// Lengths of the sides, m, >= 0.
    pub fn extent(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.max[axis] - self.min[axis])
    }

    /// Length of the diagonal, m, >= 0.
    pub(crate) fn diagonal(&self) -> f64 {
        let [x, y, z] = self.extent();
        x.hypot(y).hypot(z)
    }
}
