//! Incompatible modes make Quad4 and Hex8 bend.
//!
//! To the bilinear displacement come the bubbles `1 - xi_d^2`, one a direction, with D amplitudes each: 4 for
//! Quad4, 9 for Hex8. They take up the bending that the corners cannot show, belong to one element and are
//! condensed there. Wilson's own element fails the patch test unless it is a parallelogram; the modification of
//! Taylor, Beresford and Wilson, Int. J. Numer. Methods Eng. 10 (1976) 1211 (QM6), takes the gradients
//! `(det J_0 / det J) J_0^-T dN/dxi` with the Jacobian at the centre, so that `int grad N dV = 0` over any
//! element and a uniform stress does not drive the modes.
//!
//! The bubbles move mass too. With the amplitudes that the statics give, `a = G u`, `G = -K_aa^-1 K_au`, the mass is
//! `M_uu + M_ua G + G^T M_au + G^T M_aa G` (Guyan, AIAA Journal 3 (1965) 380). Rigid motions and uniform strains have
//! no bubbles, so that mass and moments of inertia stay those of the corners. In bending waves of wavenumber k over
//! elements of length h it takes the error of the frequency from `(k h)^2 / 8` to `(k h)^2 / 24`.

use super::ContinuumProperties;
use super::geometry::{Jacobian, Placed, diagnose};
use super::kernel::{Couplings, mirror};
use super::mass::spread;
use super::table::tables;
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;
use crate::numerics::Brief;

/// Functions of the largest element, Hex8: 8 corners and 3 bubbles.
const FUNCTIONS: usize = 11;

/// Rows of its matrices before condensation.
const ROWS: usize = 3 * FUNCTIONS;

/// Smallest pivot, as a part of the diagonal entry before elimination: the rounding of an elimination leaves
/// 1e-16 of it where nothing should be left. The bubbles of a box do not couple at all.
const SMALLEST_PIVOT: f64 = 1e-13;

/// K into `out` [dof x dof], N/m, of a Quad4 or Hex8.
pub(super) fn stiffness(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    out: &mut [f64],
) -> Result<(), ElementError> {
    match kind.dimension() {
        2 => condensed::<4, 6, 2>(kind, coords, properties, Wanted::Stiffness, out),
        _ => condensed::<8, 11, 3>(kind, coords, properties, Wanted::Stiffness, out),
    }
}

/// M into `out` [dof x dof], kg, of a Quad4 or Hex8. The entries between corners are exact for any shape, those with
/// bubbles for parallelepipeds.
pub(super) fn mass(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    out: &mut [f64],
) -> Result<(), ElementError> {
    match kind.dimension() {
        2 => condensed::<4, 6, 2>(kind, coords, properties, Wanted::Mass, out),
        _ => condensed::<8, 11, 3>(kind, coords, properties, Wanted::Mass, out),
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Wanted {
    Stiffness,
    Mass,
}

/// K or M (N D rows) of an element with N nodes and M = N + D functions.
fn condensed<const N: usize, const M: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    wanted: Wanted,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let (all, kept) = (M * D, N * D);
    let mut stiffness = [0.0; ROWS * ROWS];
    let k = &mut stiffness[..all * all];
    with_bubbles::<N, M, D>(kind, coords, &placed, properties, k)?;
    let mut mass = [0.0; ROWS * ROWS];
    let from = if wanted == Wanted::Mass {
        let m = &mut mass[..all * all];
        let sums = products::<N, M, D>(kind, &placed, properties.density * properties.thickness);
        spread(sums.as_flattened(), D, m);
        condense(k, Some(&mut *m), all, kept).map_err(|pivot| soft_modes(kind, pivot))?;
        m
    } else {
        condense(k, None, all, kept).map_err(|pivot| soft_modes(kind, pivot))?;
        k
    };
    for (to, from) in out.chunks_exact_mut(kept).zip(from.chunks_exact(all)) {
        to.copy_from_slice(&from[..kept]);
    }
    mirror(out, kept);
    Ok(())
}

/// K over corners and bubbles, and the check of the element.
fn with_bubbles<const N: usize, const M: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    placed: &Placed<N>,
    properties: &ContinuumProperties,
    k: &mut [f64],
) -> Result<(), ElementError> {
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
        return Err(diagnose::<N, D>(kind, coords, placed, table));
    }
    couplings.contract::<D>(&properties.elasticity, properties.thickness, k);
    Ok(())
}

/// `density int N_a N_b` over corners and bubbles.
fn products<const N: usize, const M: usize, const D: usize>(
    kind: ElementKind,
    placed: &Placed<N>,
    density: f64,
) -> [[f64; M]; M] {
    let table = &tables(kind).mass;
    let mut sums = [[0.0; M]; M];
    let given = table.points.iter().zip(table.derivatives::<N>().chunks_exact(D)).zip(table.values::<N>());
    for ((point, rows), corners) in given {
        let determinant = Jacobian::new::<N, D>(&placed.coords, rows).determinant();
        let factor = density * point.weight * determinant;
        let values: [f64; M] = std::array::from_fn(|a| match a.checked_sub(N) {
            None => corners[a],
            Some(d) => 1.0 - point.natural[d] * point.natural[d],
        });
        for (row, right) in sums.iter_mut().zip(values) {
            for (sum, left) in row.iter_mut().zip(values) {
                *sum += left * right * factor;
            }
        }
    }
    sums
}

/// Incompatible modes without stiffness of their own; the pivot should be positive, N/m.
pub(super) fn soft_modes(kind: ElementKind, pivot: f64) -> ElementError {
    ElementError(format!(
        "the incompatible modes of the {} element have no stiffness (pivot {} N/m): use the plain formulation",
        kind.name(),
        Brief(pivot)
    ))
}

/// Static condensation of the last rows, one amplitude after the other, on the upper triangle: `K_uu - K_ua K_aa^-1 K_au`
/// and, of a mass, `G^T M G` over corners and bubbles. `Err(pivot)` if `K_aa` is not positive definite.
fn condense(k: &mut [f64], mut m: Option<&mut [f64]>, rows: usize, kept: usize) -> Result<(), f64> {
    let mut diagonal = [0.0; ROWS];
    for (i, entry) in diagonal[..rows].iter_mut().enumerate() {
        *entry = k[i * rows + i];
    }
    for last in (kept..rows).rev() {
        let (before, rest) = k.split_at_mut(last * rows);
        let pivot = rest[last];
        if !(pivot > SMALLEST_PIVOT * diagonal[last] && pivot > 0.0) {
            return Err(pivot);
        }
        if let Some(m) = m.as_deref_mut() {
            let (before, follower) = m.split_at_mut(last * rows);
            for (j, column) in before.chunks_exact_mut(rows).enumerate() {
                let follows = -rest[j] / pivot;
                for (i, entry) in column[..=j].iter_mut().enumerate() {
                    let other = -rest[i] / pivot;
                    *entry += follower[i] * follows + other * (follower[j] + follower[last] * follows);
                }
            }
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
        assert_eq!(condense(&mut k, None, 3, 2), Ok(()));
        assert!((k[0] - 1.2).abs() < 1e-15 && (k[3] + 1.2).abs() < 1e-15);
    }

    /// A massless link at the middle of two equal springs carries half the motion of each end: a mass m on it gives m / 4
    /// to each entry; one of c between it and the first end gives `2 c / 2` to that end and c / 2 between the ends.
    #[test]
    fn a_mass_goes_with_what_carries_it() {
        let mut k = [1.0, 0.0, -1.0, 0.0, 1.0, -1.0, -1.0, -1.0, 2.0];
        let (m, c) = (8.0, 3.0);
        let mut mass = [0.0, 0.0, c, 0.0, 0.0, 0.0, c, 0.0, m];
        assert_eq!(condense(&mut k, Some(&mut mass), 3, 2), Ok(()));
        assert_eq!([mass[0], mass[3], mass[4]], [m / 4.0 + c, m / 4.0 + c / 2.0, m / 4.0]);
    }

    #[test]
    fn an_indefinite_block_is_refused_with_its_pivot() {
        let mut k = [1.0, 0.5, 0.5, -2.0];
        assert_eq!(condense(&mut k, None, 2, 1), Err(-2.0));
        let mut k = [1.0, 0.0, 0.0, f64::NAN];
        assert!(condense(&mut k, None, 2, 1).is_err());
    }
}
