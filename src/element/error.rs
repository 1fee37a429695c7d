//! What can be wrong with one element.

use thiserror::Error;

/// An element whose matrices cannot be computed. The caller knows its tag and adds it.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ElementError {
    /// The Jacobian determinant is negative everywhere: the nodes run clockwise.
    #[error(
        "the {kind} element is inverted: its nodes run clockwise (Jacobian determinant \
         {determinant:.6e} m^2 at ({x:.6e}, {y:.6e}) m); reverse the surface in gmsh",
        x = position[0], y = position[1]
    )]
    Inverted {
        /// Name of the element kind.
        kind: &'static str,
        /// The determinant closest to zero, m^2.
        determinant: f64,
        /// Where it was found, m.
        position: [f64; 2],
    },
    /// The Jacobian determinant is zero or changes its sign inside the element.
    #[error(
        "the {kind} element is degenerate or folded: Jacobian determinant {determinant:.6e} m^2 at \
         ({x:.6e}, {y:.6e}) m, natural coordinates ({xi:.3}, {eta:.3}); it must be positive everywhere",
        x = position[0], y = position[1], xi = natural[0], eta = natural[1]
    )]
    Degenerate {
        /// Name of the element kind.
        kind: &'static str,
        /// The smallest determinant, m^2.
        determinant: f64,
        /// Where in the element, natural coordinates.
        natural: [f64; 2],
        /// Where in the model, m.
        position: [f64; 2],
    },
    /// An edge whose nodes coincide.
    #[error("the {kind} edge at ({x:.6e}, {y:.6e}) m has no length", x = position[0], y = position[1])]
    NoLength {
        /// Name of the edge kind.
        kind: &'static str,
        /// Its first node, m.
        position: [f64; 2],
    },
    /// A coordinate that is infinite or not a number.
    #[error("node {node} of the {kind} element has the coordinates ({x}, {y}) m: expected finite numbers",
        x = position[0], y = position[1])]
    NotFinite {
        /// Name of the element kind.
        kind: &'static str,
        /// Which node of the element, from 0.
        node: usize,
        /// Its coordinates, m.
        position: [f64; 2],
    },
    /// A number of coordinates that does not fit the kind.
    #[error("a {kind} element has {expected} nodes, found {found}")]
    NodeCount {
        /// Name of the element kind.
        kind: &'static str,
        /// Nodes of the kind.
        expected: usize,
        /// Coordinates given.
        found: usize,
    },
    /// An output matrix of the wrong shape.
    #[error(
        "the matrix of a {kind} element is {expected} x {expected}, the buffer is {rows} x {columns}"
    )]
    BufferShape {
        /// Name of the element kind.
        kind: &'static str,
        /// Rows and columns needed.
        expected: usize,
        /// Rows found.
        rows: usize,
        /// Columns found.
        columns: usize,
    },
    /// A thickness that is no thickness.
    #[error("thickness must be positive and finite, found {value} m")]
    Thickness {
        /// The value found, m.
        value: f64,
    },
}
