//! Incompatible modes: what makes Quad4 and Hex8 bend.
//!
//! To the bilinear displacement come the bubbles `1 - xi_d^2`, one a direction, with D amplitudes each: 4 for
//! Quad4, 9 for Hex8. They take up the bending that the corners cannot show, belong to one element and are
//! condensed there. Wilson's own element fails the patch test unless it is a parallelogram; the modification of
//! Taylor, Beresford and Wilson, Int. J. Numer. Methods Eng. 10 (1976) 1211 (QM6), takes the gradients
//! `(det J_0 / det J) J_0^-T dN/dxi` with the Jacobian at the centre, so that `int grad N dV = 0` over any
//! element and a uniform stress does not drive the modes.

use super::geometry::{Jacobian, Placed, diagnose};
use super::kernel::{Centre, Couplings, mirror};
use super::table::tables;
use super::{ContinuumKind, ContinuumProperties};
use crate::fe::element::ElementError;

/// Entries of the largest matrix before condensation: Hex8, 8 + 3 functions.
const ENTRIES: usize = 33 * 33;

/// Smallest pivot, as a part of the diagonal entry before elimination: the rounding of an elimination leaves
/// 1e-16 of it where nothing should be left. The bubbles of a box do not couple at all.
const SMALLEST_PIVOT: f64 = 1e-13;

/// K (N D rows) of an element with N nodes and M = N + D functions.
pub(super) fn stiffness<const N: usize, const M: usize, const D: usize>(
    kind: ContinuumKind,
    coords: &[[f64; 3]],
    properties: &ContinuumProperties,
    out: &mut [f64],
) -> Result<(), ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let tables = tables(kind);
    let jacobian = Jacobian::new::<N, D>(&placed.coords, tables.centre.derivatives::<N>());
    let (centre, at_centre) = Centre::new(jacobian);
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
    couplings.contract::<D>(properties.elasticity(), properties.thickness(), full);
    condense(full, all, kept).map_err(|pivot| ElementError::Condensation { kind: kind.name(), pivot })?;
    for (column, from) in full.chunks_exact(all).take(kept).enumerate() {
        out[column * kept..][..kept].copy_from_slice(&from[..kept]);
    }
    mirror(out, kept);
    Ok(())
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
