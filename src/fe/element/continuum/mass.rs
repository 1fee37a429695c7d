//! Mass matrices and the measure.

use nalgebra::DMatrix;

use super::geometry::{Jacobian, Placed, diagnose};
use super::incompatible::incompatible_mass;
use super::kernel::mirror;
use super::stiffness::{check_length, check_properties};
use super::table::{Table, for_kind, tables};
use super::{ContinuumProperties, Formulation, MAX_NODES};
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;

/// Points whose shape functions are summed together; as in the stiffness.
const BLOCK: usize = 8;

/// Mass `M = rho int N^T N dV` (solid) or `rho t int N^T N dA` (plane), kg, into `out` (dof x dof, symmetric, column
/// by column, both triangles; whatever it held is replaced).
///
/// Degrees of freedom as in [`stiffness_into`](super::stiffness_into). Consistent and integrated exactly for any geometry
/// (`ElementKind::rules`), so that frequencies converge from above; with incompatible modes, which move with the nodes, they
/// need not: how much the modes move depends on whether it is `across_plate`, with free faces near by, by
/// natural direction. A rigid motion has
/// the kinetic energy of the continuum in any case. Source: Bathe, Finite Element Procedures
/// (1996), equation 4.20.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates or buffer shape, properties of the other dimension,
/// coordinates that are not finite, or an element that is inverted, degenerate or folded.
pub(crate) fn mass_into(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    formulation: Formulation,
    across_plate: [bool; 3],
    out: &mut [f64],
) -> Result<(), ElementError> {
    check_properties(kind, properties)?;
    check_length(kind, kind.dof(), out)?;
    match kind {
        ElementKind::Quad4 if formulation.bubbles(kind) => {
            incompatible_mass::<4, 6, 2>(kind, coords, properties, across_plate, out)
        }
        ElementKind::Hex8 if formulation.bubbles(kind) => {
            incompatible_mass::<8, 11, 3>(kind, coords, properties, across_plate, out)
        }
        _ => {
            let (nodes, d, rows) = (kind.nodes(), kind.dimension(), kind.dof());
            let mut nodal = [0.0; MAX_NODES * MAX_NODES];
            let nodal = &mut nodal[..nodes * nodes];
            nodal_mass_into(kind, coords, properties, nodal)?;
            out.fill(0.0);
            for (pair, value) in nodal.iter().enumerate() {
                let (column, row) = (pair / nodes * d, pair % nodes * d);
                for i in 0..d {
                    out[(column + i) * rows + row + i] = *value;
                }
            }
            Ok(())
        }
    }
}

/// `mass_into` a new matrix, of an element alone.
///
/// # Errors
/// As `mass_into`.
pub fn mass(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    formulation: Formulation,
) -> Result<DMatrix<f64>, ElementError> {
    let mut out = DMatrix::zeros(kind.dof(), kind.dof());
    mass_into(kind, coords, properties, formulation, [true; 3], out.as_mut_slice())?;
    Ok(out)
}

/// The mass of compatible elements between the nodes, kg [nodes x nodes]: the same for each component of a displacement,
/// which components do not couple.
///
/// # Errors
/// As `mass_into`.
pub(crate) fn nodal_mass_into(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    out: &mut [f64],
) -> Result<(), ElementError> {
    check_properties(kind, properties)?;
    check_length(kind, kind.nodes(), out)?;
    let density = properties.density * properties.thickness;
    for_kind!(kind, nodal_mass(kind, coords, density, out))
}

/// `int N_a N_b dA` (m^2) or `int N_a N_b dV` (m^3) [nodes x nodes]: the consistent mass of unit density and thickness.
///
/// # Errors
/// As [`measure`].
pub(crate) fn measure_matrix(kind: ElementKind, coords: &[[f64; 3]]) -> Result<DMatrix<f64>, ElementError> {
    let mut out = DMatrix::zeros(kind.nodes(), kind.nodes());
    for_kind!(kind, nodal_mass(kind, coords, 1.0, out.as_mut_slice()))?;
    Ok(out)
}

/// Area (m^2) of a plane element or volume (m^3) of a solid one, exact for straight and curved edges.
///
/// `coords` as for `stiffness_into`.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates, coordinates that are not finite, or an element that is
/// inverted, degenerate or folded.
pub fn measure(kind: ElementKind, coords: &[[f64; 3]]) -> Result<f64, ElementError> {
    for_kind!(kind, size(kind, coords))
}

fn nodal_mass<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    density: f64,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let tables = tables(kind);
    if placed.straight && kind.is_simplex() {
        let determinant = constant_determinant::<N, D>(kind, coords, &placed)?;
        for (entry, natural) in out.iter_mut().zip(&tables.natural_mass) {
            *entry = density * determinant * natural;
        }
        return Ok(());
    }
    let table = if placed.straight { &tables.straight_mass } else { &tables.mass };
    integrate::<N, D>(kind, coords, &placed, density, table, out)
}

/// `density int N_a N_b` by the points of a table, and the check of the element.
pub(super) fn integrate<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    placed: &Placed<N>,
    density: f64,
    table: &Table,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let mut sums = [[0.0; N]; N];
    let mut smallest = placed.smallest_at_nodes::<D>(kind);
    let rows = table.derivatives::<N>().chunks(BLOCK * D);
    let values = table.values::<N>().chunks(BLOCK);
    for ((points, rows), values) in table.points.chunks(BLOCK).zip(rows).zip(values) {
        let mut weighted = [[0.0; N]; BLOCK];
        let given = points.iter().zip(rows.chunks_exact(D)).zip(values);
        for (((point, rows), values), weighted) in given.zip(&mut weighted) {
            let determinant = Jacobian::new::<N, D>(&placed.coords, rows).determinant();
            smallest = smallest.min(determinant);
            let factor = density * point.weight * determinant;
            *weighted = values.map(|value| value * factor);
        }
        for b in 0..N {
            let mut row = sums[b];
            for (left, right) in values.iter().zip(&weighted) {
                for a in 0..N {
                    row[a] += left[a] * right[b];
                }
            }
            sums[b] = row;
        }
    }
    if !placed.accepts(kind, smallest) {
        return Err(diagnose::<N, D>(kind, coords, placed, table));
    }
    out.copy_from_slice(sums.as_flattened());
    mirror(out, N);
    Ok(())
}

fn size<const N: usize, const D: usize>(kind: ElementKind, coords: &[[f64; 3]]) -> Result<f64, ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let table = &tables(kind).mass;
    let natural: f64 = table.points.iter().map(|point| point.weight).sum();
    if placed.straight && kind.is_simplex() {
        return Ok(natural * constant_determinant::<N, D>(kind, coords, &placed)?);
    }
    let mut smallest = placed.smallest_at_nodes::<D>(kind);
    let mut sum = 0.0;
    let rows = table.derivatives::<N>().chunks_exact(D);
    for (point, rows) in table.points.iter().zip(rows) {
        let determinant = Jacobian::new::<N, D>(&placed.coords, rows).determinant();
        smallest = smallest.min(determinant);
        sum += point.weight * determinant;
    }
    if placed.accepts(kind, smallest) { Ok(sum) } else { Err(diagnose::<N, D>(kind, coords, &placed, table)) }
}

/// The determinant of a straight triangle or tetrahedron, the same everywhere.
fn constant_determinant<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    placed: &Placed<N>,
) -> Result<f64, ElementError> {
    let nodes = &tables(kind).nodes;
    let first = &nodes.derivatives::<N>()[..D];
    let determinant = Jacobian::new::<N, D>(&placed.coords, first).determinant();
    if placed.accepts(kind, determinant) { Ok(determinant) } else { Err(diagnose::<N, D>(kind, coords, placed, nodes)) }
}
