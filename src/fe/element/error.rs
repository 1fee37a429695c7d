//! What can be wrong with one element.

use thiserror::Error;

/// An element whose matrices cannot be computed. The caller knows its tag and adds it.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ElementError {
    /// The Jacobian determinant is negative everywhere.
    #[error(
        "the {kind} element is inverted: {} (Jacobian determinant {determinant:.6e} m^{dimension} at {}); {}",
        cause(*dimension), place(position, *dimension), remedy(*dimension)
    )]
    Inverted {
        /// Name of the element kind.
        kind: &'static str,
        /// 2 (plane) or 3 (solid).
        dimension: usize,
        /// The determinant closest to zero, m^2 or m^3.
        determinant: f64,
        /// Where it was found, m.
        position: [f64; 3],
    },
    /// The Jacobian determinant is zero or changes its sign inside the element.
    #[error(
        "the {kind} element is degenerate or folded: Jacobian determinant {determinant:.6e} m^{dimension} at \
         {}, natural coordinates {}; it must be positive everywhere",
        place(position, *dimension), natural_place(natural, *dimension)
    )]
    Degenerate {
        /// Name of the element kind.
        kind: &'static str,
        /// 2 (plane) or 3 (solid).
        dimension: usize,
        /// The smallest determinant, m^2 or m^3.
        determinant: f64,
        /// Where in the element, natural coordinates.
        natural: [f64; 3],
        /// Where in the model, m.
        position: [f64; 3],
    },
    /// An edge whose nodes coincide, or a surface whose nodes lie on a line.
    #[error("the {kind} {} has no {}", surface_place(*dimension, position), surface_size(*dimension))]
    NoSize {
        /// Name of the edge or surface kind.
        kind: &'static str,
        /// 1 (edge) or 2 (surface).
        dimension: usize,
        /// Its first node, m.
        position: [f64; 3],
    },
    /// A coordinate that is infinite or not a number.
    #[error("node {node} of the {kind} element has the coordinates ({x}, {y}, {z}) m: expected finite numbers",
        x = position[0], y = position[1], z = position[2])]
    NotFinite {
        /// Name of the element kind.
        kind: &'static str,
        /// Which node of the element, from 0.
        node: usize,
        /// Its coordinates, m.
        position: [f64; 3],
    },
    /// An extent beyond anything that can be computed with.
    #[error("the {kind} element measures {size:e} m: expected at most {largest:e} m")]
    TooLarge {
        /// Name of the element kind.
        kind: &'static str,
        /// Largest distance of a node from the first, along an axis, m.
        size: f64,
        /// What is accepted, m.
        largest: f64,
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
    /// A point or a line where a plane element or a solid is needed.
    #[error("a {kind} element has neither area nor volume")]
    NoContinuum {
        /// Name of the element kind.
        kind: &'static str,
    },
    /// A point or a solid where an edge or a face is needed.
    #[error("a {kind} element is neither an edge nor a face")]
    NoSurface {
        /// Name of the element kind.
        kind: &'static str,
    },
    /// An output buffer of the wrong length.
    #[error("the matrix of a {kind} element has {order} x {order} entries, the buffer holds {found}")]
    BufferLength {
        /// Name of the element kind.
        kind: &'static str,
        /// Rows and columns needed.
        order: usize,
        /// Length found.
        found: usize,
    },
    /// Plane properties for a solid element, or the other way round.
    #[error("the {kind} element needs {} properties, found {} ones", family(*dimension), family(5 - *dimension))]
    Dimension {
        /// Name of the element kind.
        kind: &'static str,
        /// 2 (plane) or 3 (solid).
        dimension: usize,
    },
    /// A thickness that is no thickness.
    #[error("thickness must be positive and finite, found {value} m")]
    Thickness {
        /// The value found, m.
        value: f64,
    },
    /// An orthotropic material that the plane does not cut along its axes.
    #[error(
        "the material axis z must be normal to the plane of the mesh, (0, 0, 1) or (0, 0, -1), found ({:.6}, {:.6}, {:.6})",
        axis[0], axis[1], axis[2]
    )]
    MaterialAxis {
        /// The material axis z in mesh coordinates.
        axis: [f64; 3],
    },
    /// Incompatible modes without stiffness of their own.
    #[error(
        "the incompatible modes of the {kind} element have no stiffness (pivot {pivot:.6e} N/m): use the plain formulation"
    )]
    Condensation {
        /// Name of the element kind.
        kind: &'static str,
        /// The pivot that should be positive, N/m.
        pivot: f64,
    },
}

fn cause(dimension: usize) -> &'static str {
    match dimension {
        2 => "its nodes run clockwise",
        _ => "its nodes are numbered inside out",
    }
}

fn remedy(dimension: usize) -> &'static str {
    match dimension {
        2 => "reverse its surface in gmsh (a group of the mesh whose elements all run so is turned)",
        _ => "the mesh was mirrored or the node order is not gmsh's",
    }
}

fn place(position: &[f64; 3], dimension: usize) -> String {
    let [x, y, z] = position;
    match dimension {
        2 => format!("({x:.6e}, {y:.6e}) m"),
        _ => format!("({x:.6e}, {y:.6e}, {z:.6e}) m"),
    }
}

fn natural_place(natural: &[f64; 3], dimension: usize) -> String {
    let [xi, eta, zeta] = natural;
    match dimension {
        2 => format!("({xi:.3}, {eta:.3})"),
        _ => format!("({xi:.3}, {eta:.3}, {zeta:.3})"),
    }
}

fn surface_place(dimension: usize, position: &[f64; 3]) -> String {
    let what = if dimension == 1 { "edge" } else { "surface" };
    format!("{what} at {}", place(position, 3))
}

fn surface_size(dimension: usize) -> &'static str {
    if dimension == 1 { "length" } else { "area" }
}

fn family(dimension: usize) -> &'static str {
    if dimension == 2 { "plane" } else { "solid" }
}
