//! Stiffness matrices.
//!
//! Incompatible modes make Quad4 and Hex8 bend.
//!
//! To the bilinear displacement come the bubbles `1 - xi_d^2`, one a direction, with D amplitudes each: 4 for
//! Quad4, 9 for Hex8. They take up the bending that the corners cannot show, belong to one element and are
//! condensed there. Wilson's own element fails the patch test unless it is a parallelogram; the modification of
//! Taylor, Beresford and Wilson, Int. J. Numer. Methods Eng. 10 (1976) 1211 (QM6), takes the gradients
//! `(det J_0 / det J) J_0^-T dN/dxi` with the Jacobian at the centre, so that `int grad N dV = 0` over any
//! element and a uniform stress does not drive the modes.

use nalgebra::DMatrix;

use super::geometry::{Jacobian, Placed, diagnose};
use super::kernel::{Couplings, mirror};
use super::table::{Table, for_kind, tables};
use super::{ContinuumProperties, Formulation, Integration, LinearFormulation};
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;
use crate::numerics::Brief;

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
    match (kind, formulation.linear) {
        (ElementKind::Quad4, LinearFormulation::Incompatible) => incompatible::<4, 6, 2>(kind, coords, properties, out),
        (ElementKind::Hex8, LinearFormulation::Incompatible) => incompatible::<8, 11, 3>(kind, coords, properties, out),
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

/// Entries of the largest matrix before condensation: Hex8, 8 + 3 functions.
const ENTRIES: usize = 33 * 33;

/// Smallest pivot, as a part of the diagonal entry before elimination: the rounding of an elimination leaves
/// 1e-16 of it where nothing should be left. The bubbles of a box do not couple at all.
const SMALLEST_PIVOT: f64 = 1e-13;

/// K (N D rows) of an element with N nodes and M = N + D functions.
fn incompatible<const N: usize, const M: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let tables = tables(kind);
    let jacobian = Jacobian::new::<N, D>(&placed.coords, tables.centre.derivatives::<N>());
    let (at_centre, inverse) = jacobian.inverse();
    let centre = inverse.map(|row| row.map(|value| value * at_centre));
    let mut couplings = Couplings::<M>::zeros();
    let smallest = couplings
        .integrate::<N, D>(&placed.coords, &tables.stiffness, Some(centre))
        .min(placed.smallest_at_nodes::<D>(kind));
    if !placed.accepts(kind, smallest.min(at_centre)) {
        let table = if placed.accepts(kind, smallest) { &tables.centre } else { &tables.stiffness };
        return Err(diagnose::<N, D>(kind, coords, &placed, table));
    }
    let mut buffer = [0.0; ENTRIES];
    let (all, kept) = (M * D, N * D);
    let full = &mut buffer[..all * all];
    couplings.contract::<D>(&properties.elasticity, properties.thickness, full);
    condense(full, all, kept).map_err(|pivot| soft_modes(kind, pivot))?;
    for (column, from) in full.chunks_exact(all).take(kept).enumerate() {
        out[column * kept..][..kept].copy_from_slice(&from[..kept]);
    }
    mirror(out, kept);
    Ok(())
}

/// Incompatible modes without stiffness of their own; the pivot should be positive, N/m.
pub(super) fn soft_modes(kind: ElementKind, pivot: f64) -> ElementError {
    ElementError(format!(
        "the incompatible modes of the {} element have no stiffness (pivot {} N/m): use the plain formulation",
        kind.name(),
        Brief(pivot)
    ))
}

/// Static condensation of the last rows: `K_uu - K_ua K_aa^-1 K_au`, one amplitude after the other, on the
/// upper triangle; `Err(pivot)` if `K_aa` is not positive definite.
fn condense(k: &mut [f64], rows: usize, kept: usize) -> Result<(), f64> {
    let mut diagonal = [0.0; 33];
    for (i, entry) in diagonal[..rows].iter_mut().enumerate() {
        *entry = k[i * rows + i];
    }
    for last in (kept..rows).rev() {
        let (before, rest) = k.split_at_mut(last * rows);
        let pivot = rest[last];
        if !(pivot > SMALLEST_PIVOT * diagonal[last] && pivot > 0.0) {
            return Err(pivot);
        }
        for (j, column) in before.chunks_exact_mut(rows).enumerate() {
            let factor = rest[j] / pivot;
            for (entry, value) in column[..=j].iter_mut().zip(&rest[..=j]) {
                *entry -= factor * value;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::condense;

    /// Reference: two springs of 2 and 3 in series make 6/5 (the inner node condensed).
    #[test]
    fn condensation_of_springs_in_series() {
        let mut k = [2.0, 0.0, -2.0, 0.0, 3.0, -3.0, -2.0, -3.0, 5.0];
        assert_eq!(condense(&mut k, 3, 2), Ok(()));
        assert!((k[0] - 1.2).abs() < 1e-15 && (k[3] + 1.2).abs() < 1e-15);
    }

    #[test]
    fn an_indefinite_block_is_refused_with_its_pivot() {
        let mut k = [1.0, 0.5, 0.5, -2.0];
        assert_eq!(condense(&mut k, 2, 1), Err(-2.0));
        let mut k = [1.0, 0.0, 0.0, f64::NAN];
        assert!(condense(&mut k, 2, 1).is_err());
    }
}
