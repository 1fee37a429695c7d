//! Edges of plane elements: how much length each node stands for.

use super::quadrature::GAUSS_4;
use crate::element::ElementError;

/// An edge of a plane element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EdgeKind {
    /// Two nodes, straight.
    Line2,
    /// Two ends and a middle node, gmsh's order; may be curved.
    Line3,
}

impl EdgeKind {
    /// Name as in reports and errors.
    pub fn name(self) -> &'static str {
        match self {
            Self::Line2 => "Line2",
            Self::Line3 => "Line3",
        }
    }

    /// Number of nodes.
    pub fn nodes(self) -> usize {
        match self {
            Self::Line2 => 2,
            Self::Line3 => 3,
        }
    }

    /// Shape functions and derivatives at xi in [-1, 1]; zero beyond the edge's nodes.
    fn shapes(self, xi: f64) -> ([f64; 3], [f64; 3]) {
        match self {
            Self::Line2 => ([0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0], [-0.5, 0.5, 0.0]),
            Self::Line3 => (
                [0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi],
                [xi - 0.5, xi + 0.5, -2.0 * xi],
            ),
        }
    }
}

/// Tributary lengths `w_i = int N_i ds`, m, one a node: a stiffness or load per metre times `w_i` is what
/// node i receives. Their sum is the length of the edge.
///
/// `coords`: one (x, y) a node in gmsh's order, m. Four Gauss points: exact for a straight edge with its
/// middle node between the ends (L/6, L/6, 4L/6), converged to 1e-8 for arcs up to 20 degrees.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates, coordinates that are not finite, or an edge
/// without length.
pub fn edge_weights(kind: EdgeKind, coords: &[[f64; 2]]) -> Result<Vec<f64>, ElementError> {
    if coords.len() != kind.nodes() {
        return Err(ElementError::NodeCount {
            kind: kind.name(),
            expected: kind.nodes(),
            found: coords.len(),
        });
    }
    let mut weights = vec![0.0; kind.nodes()];
    for gauss in &GAUSS_4 {
        let (values, derivatives) = kind.shapes(gauss.at);
        let mut tangent = [0.0; 2];
        for (node, derivative) in coords.iter().zip(derivatives) {
            tangent[0] += derivative * node[0];
            tangent[1] += derivative * node[1];
        }
        let length = gauss.weight * tangent[0].hypot(tangent[1]);
        for (weight, value) in weights.iter_mut().zip(values) {
            *weight += length * value;
        }
    }
    let position = coords.first().copied().unwrap_or_default();
    let total: f64 = weights.iter().sum();
    let bad = |node: &[f64; 2]| !(node[0].is_finite() && node[1].is_finite());
    if let Some(node) = coords.iter().position(bad) {
        return Err(ElementError::NotFinite {
            kind: kind.name(),
            node,
            position: coords[node],
        });
    }
    if total > 0.0 {
        Ok(weights)
    } else {
        Err(ElementError::NoLength {
            kind: kind.name(),
            position,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Outcome = Result<(), ElementError>;

    #[test]
    fn straight_edges_have_the_textbook_weights() -> Outcome {
        let two = edge_weights(EdgeKind::Line2, &[[0.0, 0.0], [3.0, 4.0]])?;
        let three = edge_weights(EdgeKind::Line3, &[[0.0, 0.0], [3.0, 4.0], [1.5, 2.0]])?;
        let expected = [5.0 / 6.0, 5.0 / 6.0, 20.0 / 6.0];
        assert!(two.iter().all(|w| (w - 2.5).abs() < 1e-15));
        assert!(
            three
                .iter()
                .zip(expected)
                .all(|(w, e)| (w - e).abs() < 1e-14)
        );
        Ok(())
    }

    /// Reference: arc length of the parabola through the nodes, `y = h (1 - (x/c)^2)`,
    /// `L = sqrt(c^2 + 4 h^2) + c^2 / (2 h) asinh(2 h / c)`.
    #[test]
    fn curved_edge_has_the_length_of_its_parabola() -> Outcome {
        let half_angle = 10.0_f64.to_radians();
        let (sin, cos) = half_angle.sin_cos();
        let nodes = [[sin, cos], [-sin, cos], [0.0, 1.0]];
        let weights = edge_weights(EdgeKind::Line3, &nodes)?;
        let (c, h) = (sin, 1.0 - cos);
        let length = c.hypot(2.0 * h) + c * c / (2.0 * h) * (2.0 * h / c).asinh();
        let total: f64 = weights.iter().sum();
        assert!((total / length - 1.0).abs() < 1e-8, "{total} {length}");
        assert!((weights[0] / weights[1] - 1.0).abs() < 1e-14);
        Ok(())
    }

    #[test]
    fn every_rule_fires_with_its_message() {
        let message = |coords: &[[f64; 2]]| match edge_weights(EdgeKind::Line2, coords) {
            Ok(weights) => format!("accepted: {weights:?}"),
            Err(error) => error.to_string(),
        };
        assert_eq!(
            message(&[[0.0, 0.0]]),
            "a Line2 element has 2 nodes, found 1"
        );
        assert_eq!(
            message(&[[0.5, 0.25], [0.5, 0.25]]),
            "the Line2 edge at (5.000000e-1, 2.500000e-1) m has no length"
        );
        assert_eq!(
            message(&[[0.0, 0.0], [f64::NAN, 0.0]]),
            "node 1 of the Line2 element has the coordinates (NaN, 0) m: expected finite numbers"
        );
    }
}
