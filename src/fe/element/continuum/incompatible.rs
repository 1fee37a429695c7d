//! Incompatible modes make Quad4 and Hex8 bend.
//!
//! To the bilinear displacement come the bubbles `1 - xi_d^2`, one a direction, with D amplitudes each: 4 for
//! Quad4, 9 for Hex8. They take up the bending that the corners cannot show, belong to one element and are
//! condensed there. Wilson's own element fails the patch test unless it is a parallelogram; the modification of
//! Taylor, Beresford and Wilson, Int. J. Numer. Methods Eng. 10 (1976) 1211 (QM6), takes the gradients
//! `(det J_0 / det J) J_0^-T dN/dxi` with the Jacobian at the centre, so that `int grad N dV = 0` over any
//! element and a uniform stress does not drive the modes.
//!
//! The amplitudes follow the nodes as in statics, `a = T u`, and move with their mass: Guyan, AIAA J. 3 (1965) 380.

use super::ContinuumProperties;
use super::geometry::{Jacobian, Placed, diagnose};
use super::kernel::{Couplings, mirror};
use super::table::tables;
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;
use crate::numerics::Brief;

/// Degrees of freedom of the largest element, Hex8, and with the amplitudes of its bubbles.
const MOST_KEPT: usize = 24;
const MOST_ROWS: usize = 33;
/// Entries of its matrix before condensation.
const ENTRIES: usize = MOST_ROWS * MOST_ROWS;

/// Smallest pivot, as a part of the diagonal entry before elimination: the rounding of an elimination leaves
/// 1e-16 of it where nothing should be left. The bubbles of a box do not couple at all.
const SMALLEST_PIVOT: f64 = 1e-13;

/// How far the bubbles move in the mass, over how far they move in the stiffness. In a bending wave of wave number k,
/// elements of length h have `1 + (k h)^2 / 12` of the right stiffness, and the right mass at 1. At 3/2 they have as much too
/// much mass, and the frequency is right to fourth order.
const IN_MASS: f64 = 1.5;

/// Edge over a height across a plate from which on the bubble along it moves less in the mass, down to as far as in the
/// stiffness. Fourth order needs 3/2, but in stacks of flat elements six modes of seven were up to 30 % too low by it (measured).
const LONG_IN_PLATE: f64 = 2.0;

/// The same over other heights, by the third power. In a flat layer on a held face bubbles move in the stiffness as the layer
/// cannot. With all of their mass its lowest frequency was 51 % too low at an edge of 3 heights, and 7 % too high so (measured
/// on steel plates).
const LONG: f64 = 1.5;

/// K (N D rows, N/m) of an element with N nodes and M = N + D functions.
pub(super) fn incompatible_stiffness<const N: usize, const M: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let condensed = Condensed::new::<N, M, D>(kind, coords, properties)?;
    let (all, kept) = (M * D, N * D);
    for (column, from) in condensed.0.chunks_exact(all).take(kept).enumerate() {
        out[column * kept..][..kept].copy_from_slice(&from[..kept]);
    }
    mirror(out, kept);
    Ok(())
}

/// `M_uu + M_ua T + T^T M_au + T^T M_aa T` (N D rows, kg), with the mass of the bubbles as far as they move in it.
pub(super) fn incompatible_mass<const N: usize, const M: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    across_plate: [bool; 3],
    out: &mut [f64],
) -> Result<(), ElementError> {
    let condensed = Condensed::new::<N, M, D>(kind, coords, properties)?;
    let functions = function_mass::<N, M, D>(kind, coords, properties, across_plate)?;
    let kept = N * D;
    let follow = condensed.follow(kept, M * D);
    // momentum of every function, a row a component of it, by unit velocities of the nodes
    let mut momentum = [[0.0; MOST_KEPT]; MOST_ROWS];
    for (a, mass) in functions.iter().enumerate() {
        for i in 0..D {
            let to = &mut momentum[a * D + i];
            for b in 0..N {
                to[b * D + i] = mass[b];
            }
            for d in 0..D {
                for (to, from) in to.iter_mut().zip(&follow[d * D + i]) {
                    *to += mass[N + d] * from;
                }
            }
        }
    }
    let (of_nodes, of_bubbles) = momentum.split_at(kept);
    for column in 0..kept {
        for row in 0..=column {
            let bubbles = follow.iter().zip(of_bubbles).take(D * D);
            let moved: f64 = bubbles.map(|(follow, momentum)| follow[row] * momentum[column]).sum();
            out[column * kept + row] = of_nodes[row][column] + moved;
        }
    }
    mirror(out, kept);
    Ok(())
}

/// `rho t int N_a N_b` over the M functions, kg; those of the bubbles as far as they move in the mass.
fn function_mass<const N: usize, const M: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    across_plate: [bool; 3],
) -> Result<[[f64; M]; M], ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let tables = tables(kind);
    let centre = Jacobian::new::<N, D>(&placed.coords, tables.centre.derivatives::<N>());
    let (edges, heights) = (centre.lengths(), centre.heights());
    let least = |d: usize| {
        let others = (0..D).filter(|&e| e != d).map(|e| match (across_plate[e], heights[e] / edges[d]) {
            (true, flat) => (LONG_IN_PLATE * flat).max(1.0 / IN_MASS),
            (false, flat) => (LONG * flat).powi(3),
        });
        IN_MASS * others.fold(1.0, f64::min)
    };
    let moves: [f64; 3] = std::array::from_fn(|d| if d < D { least(d) } else { 0.0 });
    let mut sums = [[0.0; M]; M];
    let table = &tables.mass;
    let rows = table.derivatives::<N>().chunks_exact(D);
    for ((point, rows), nodes) in table.points.iter().zip(rows).zip(table.values::<N>()) {
        let determinant = Jacobian::new::<N, D>(&placed.coords, rows).determinant();
        let factor = properties.density * properties.thickness * point.weight * determinant;
        let mut values = [0.0; M];
        values[..N].copy_from_slice(nodes);
        for d in 0..D {
            values[N + d] = moves[d] * (1.0 - point.natural[d] * point.natural[d]);
        }
        for (sums, own) in sums.iter_mut().zip(values) {
            for (sum, other) in sums.iter_mut().zip(values) {
                *sum += factor * own * other;
            }
        }
    }
    Ok(sums)
}

/// The stiffness between all functions after the elimination of the bubbles' amplitudes: that of the nodes in the upper
/// triangle of the first rows, and above each amplitude's diagonal what it was eliminated by.
struct Condensed([f64; ENTRIES]);

impl Condensed {
    fn new<const N: usize, const M: usize, const D: usize>(
        kind: ElementKind,
        coords: &[[f64; 3]],
        properties: &ContinuumProperties,
    ) -> Result<Self, ElementError> {
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
        let mut matrix = [0.0; ENTRIES];
        let full = &mut matrix[..M * D * M * D];
        couplings.contract::<D>(&properties.elasticity, properties.thickness, full);
        condense(full, M * D, N * D).map_err(|pivot| soft_modes(kind, pivot))?;
        Ok(Self(matrix))
    }

    /// T: displacements of the bubbles, a row each, by unit displacements of the nodes.
    fn follow(&self, kept: usize, rows: usize) -> [[f64; MOST_KEPT]; MOST_ROWS - MOST_KEPT] {
        let mut follow = [[0.0; MOST_KEPT]; MOST_ROWS - MOST_KEPT];
        for (amplitude, last) in (kept..rows).enumerate() {
            let column = &self.0[last * rows..][..=last];
            let mut own = [0.0; MOST_KEPT];
            own[..kept].copy_from_slice(&column[..kept]);
            for (factor, before) in column[kept..last].iter().zip(&follow) {
                for (own, before) in own.iter_mut().zip(before) {
                    *own += factor * before;
                }
            }
            follow[amplitude] = own.map(|entry| -entry / column[last]);
        }
        follow
    }
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
    let mut diagonal = [0.0; MOST_ROWS];
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
