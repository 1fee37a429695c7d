//! Shape functions at the points of the rules, evaluated once a kind, and the code made for its numbers of nodes and
//! directions.

use std::sync::OnceLock;

use super::QuadraturePoint;
use super::shape::{shape, shape_values};
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;

/// `function::<N, D>(...)` for the N nodes and D displacements a node of a kind: loops of known length, which
/// the compiler unrolls and vectorises. Points and lines are an error.
macro_rules! for_kind {
    ($kind:expr, $function:ident($($argument:expr),* $(,)?)) => {{
        use $crate::fe::mesh::ElementKind as Kind;
        match $kind {
            Kind::Tri3 => $function::<3, 2>($($argument),*),
            Kind::Tri6 => $function::<6, 2>($($argument),*),
            Kind::Quad4 => $function::<4, 2>($($argument),*),
            Kind::Quad8 => $function::<8, 2>($($argument),*),
            Kind::Quad9 => $function::<9, 2>($($argument),*),
            Kind::Tet4 => $function::<4, 3>($($argument),*),
            Kind::Tet10 => $function::<10, 3>($($argument),*),
            Kind::Hex8 => $function::<8, 3>($($argument),*),
            Kind::Hex20 => $function::<20, 3>($($argument),*),
            Kind::Hex27 => $function::<27, 3>($($argument),*),
            Kind::Wedge6 => $function::<6, 3>($($argument),*),
            Kind::Wedge15 => $function::<15, 3>($($argument),*),
            Kind::Wedge18 => $function::<18, 3>($($argument),*),
            Kind::Pyramid5 => $function::<5, 3>($($argument),*),
            Kind::Pyramid13 => $function::<13, 3>($($argument),*),
            Kind::Pyramid14 => $function::<14, 3>($($argument),*),
            Kind::Point | Kind::Line2 | Kind::Line3 => Err($crate::fe::element::continuum::table::no_continuum($kind)),
        }
    }};
}

pub(super) use for_kind;

/// A point or a line where a plane element or a solid is needed.
#[cold]
pub(super) fn no_continuum(kind: ElementKind) -> ElementError {
    ElementError(format!("a {} element has neither area nor volume", kind.name()))
}

/// Shape functions of one kind at the points of one rule.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) points: Vec<QuadraturePoint>,
    /// Point by point, node by node.
    values: Vec<f64>,
    /// Point by point, direction by direction, node by node.
    derivatives: Vec<f64>,
}

impl Table {
    pub(super) fn new(kind: ElementKind, points: &[QuadraturePoint]) -> Self {
        let mut values = Vec::new();
        let mut derivatives = Vec::new();
        for point in points {
            let (of_point, at_point) = shape(kind, point.natural);
            values.extend_from_slice(&of_point[..kind.nodes()]);
            for direction in 0..kind.dimension() {
                derivatives.extend(at_point[..kind.nodes()].iter().map(|d| d[direction]));
            }
        }
        Self { points: points.to_vec(), values, derivatives }
    }

    /// `N_a`, an array a point; N must be the number of nodes.
    pub(super) fn values<const N: usize>(&self) -> &[[f64; N]] {
        self.values.as_chunks().0
    }

    /// `dN_a/dxi_d`, an array a point and direction; N must be the number of nodes.
    pub(super) fn derivatives<const N: usize>(&self) -> &[[f64; N]] {
        self.derivatives.as_chunks().0
    }
}

/// All tables of one kind.
#[derive(Debug)]
pub(super) struct Tables {
    pub(super) stiffness: Table,
    pub(super) straight_stiffness: Table,
    pub(super) mass: Table,
    pub(super) straight_mass: Table,
    /// The nodes, where the Jacobian is checked; weights have no meaning.
    pub(super) nodes: Table,
    /// The one point where the natural coordinates are zero: the centre of Quad4 and Hex8.
    pub(super) centre: Table,
    /// `int N_a N_b` over the natural element, column by column: times the Jacobian of a straight
    /// triangle or tetrahedron it is the mass.
    pub(super) natural_mass: Vec<f64>,
}

static TABLES: [OnceLock<Tables>; ElementKind::COUNT] = [const { OnceLock::new() }; ElementKind::COUNT];

/// The tables of a kind, made at the first call.
pub(super) fn tables(kind: ElementKind) -> &'static Tables {
    TABLES[kind as usize].get_or_init(|| Tables::new(kind))
}

impl Tables {
    fn new(kind: ElementKind) -> Self {
        let unweighted = |&natural: &[f64; 3]| QuadraturePoint { natural, weight: 0.0 };
        let nodes: Vec<_> = kind.natural_nodes().iter().map(unweighted).collect();
        let mut natural_mass = vec![0.0; kind.nodes() * kind.nodes()];
        for point in kind.mass_rule().points() {
            let values = shape_values(kind, point.natural);
            let products =
                values[..kind.nodes()].iter().flat_map(|b| values[..kind.nodes()].iter().map(move |a| a * b));
            for (entry, product) in natural_mass.iter_mut().zip(products) {
                *entry += point.weight * product;
            }
        }
        let [[stiffness, straight_stiffness], [mass, straight_mass]] =
            kind.rules().map(|rules| rules.map(|rule| Table::new(kind, rule.points())));
        Self {
            stiffness,
            straight_stiffness,
            mass,
            straight_mass,
            nodes: Table::new(kind, &nodes),
            centre: Table::new(kind, &[unweighted(&[0.0; 3])]),
            natural_mass,
        }
    }
}
