//! Stiffness matrices.

use nalgebra::DMatrix;

use super::geometry::{Placed, diagnose};
use super::incompatible::incompatible_stiffness;
use super::kernel::Couplings;
use super::table::{Table, for_kind, tables};
use super::{ContinuumProperties, Formulation, Integration};
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;

/// Stiffness `K = int B^T D B dV` (solid) or `t int B^T D B dA` (plane), N/m, into `out` (dof x dof, symmetric,
/// column by column, both triangles; whatever it held is replaced).
///
/// `B` (6 x dof or 3 x dof) gives the strains, `D` (6 x 6 or 3 x 3) the elasticity, t the thickness. Degrees of
/// freedom node by node: (u_x, u_y, u_z) of node 0, of node 1, ...; without u_z in the plane. `coords`: one
/// (x, y, z) a node in gmsh's order, m; plane elements lie in xy and z is not read. Force components that hold
/// the element in a given displacement are `K u`; a rigid motion needs none. Source: Bathe, Finite Element
/// Procedures (1996), equation 4.19; rules: `ElementKind::rules`.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates or buffer shape, properties of the other dimension,
/// coordinates that are not finite, or an element that is inverted, degenerate or folded.
pub(crate) fn stiffness_into(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    formulation: Formulation,
    out: &mut [f64],
) -> Result<(), ElementError> {
    check_properties(kind, properties)?;
    check_length(kind, kind.dof(), out)?;
    match kind {
        ElementKind::Quad4 if formulation.bubbles(kind) => {
            incompatible_stiffness::<4, 6, 2>(kind, coords, properties, out)
        }
        ElementKind::Hex8 if formulation.bubbles(kind) => {
            incompatible_stiffness::<8, 11, 3>(kind, coords, properties, out)
        }
        _ => {
            let integration = formulation.integration;
            for_kind!(kind, compatible(kind, coords, properties, integration, out))
        }
    }
}

/// `stiffness_into` a new matrix.
///
/// # Errors
/// As `stiffness_into`.
pub fn stiffness(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    formulation: Formulation,
) -> Result<DMatrix<f64>, ElementError> {
    let mut out = DMatrix::zeros(kind.dof(), kind.dof());
    stiffness_into(kind, coords, properties, formulation, out.as_mut_slice())?;
    Ok(out)
}

fn compatible<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    integration: Integration,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let tables = tables(kind);
    let four = kind == ElementKind::Tet10 && integration == Integration::FourPoint;
    let table = if placed.straight || four { &tables.straight_stiffness } else { &tables.stiffness };
    integrate::<N, D>(kind, coords, &placed, properties, table, out)
}

/// The integral by the points of a table, and the check of the element.
pub(super) fn integrate<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    placed: &Placed<N>,
    properties: &ContinuumProperties,
    table: &Table,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let mut couplings = Couplings::<N>::zeros();
    let mut smallest = couplings.integrate::<N, D>(&placed.coords, table, None);
    if !(kind.is_simplex() && placed.straight) {
        smallest = smallest.min(placed.smallest_at_nodes::<D>(kind));
    }
    if !placed.accepts(kind, smallest) {
        return Err(diagnose::<N, D>(kind, coords, placed, table));
    }
    couplings.contract::<D>(&properties.elasticity, properties.thickness, out);
    Ok(())
}

/// Plane properties for plane elements, solid ones for solids.
pub(super) fn check_properties(kind: ElementKind, properties: &ContinuumProperties) -> Result<(), ElementError> {
    if properties.dimension == kind.dimension() {
        Ok(())
    } else {
        let [needed, found] = if kind.dimension() == 2 { ["plane", "solid"] } else { ["solid", "plane"] };
        Err(ElementError(format!("the {} element needs {needed} properties, found {found} ones", kind.name())))
    }
}

/// The buffer holds a square matrix of `order` rows.
pub(super) fn check_length(kind: ElementKind, order: usize, out: &[f64]) -> Result<(), ElementError> {
    if out.len() == order * order {
        Ok(())
    } else {
        Err(ElementError(format!(
            "the matrix of a {} element has {order} x {order} entries, the buffer holds {}",
            kind.name(),
            out.len()
        )))
    }
}
