//! Constraint modes and interior vectors against the matrices that they were computed from.
//!
//! All checks of a condensed housing.

use super::super::parts::rows_of;
use super::matrices::{check_matrices, largest, pairs};
use super::{Check, CraigBampton, InterfaceReduction, ReductionError, RigidMotions};
use crate::fe::assembly::SystemMatrices;
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, sparse_times_dense, submatrix, times, transpose_times_dense};
use std::f64::consts::TAU;

/// Equations solved through a factor in double precision: its contraction is below 1e-8 for a matrix worth solving
/// with.
const STATIC: f64 = 1e-8;

/// Products of vectors against what the superelement holds: orthogonality of computed modes.
const PRODUCTS: f64 = 1e-8;

/// Name of the check that modes of the interface do not keep.
pub(super) const STATIC_INTERFACE: &str = "static interface";

/// Interface motions with which static response is tried.
const TRIALS: usize = 3;

pub(super) fn checks(condensed: &CraigBampton, matrices: &SystemMatrices, band_hz: f64) -> Vec<Check> {
    let substructure = &condensed.substructure;
    let (q, values) = (&condensed.basis.vectors, condensed.basis.values());
    let (moved, stiff) = (substructure.interior.mass_times(q), substructure.interior.stiffness_times(q));
    let gram = times(q.transpose(), moved.as_ref());
    let energy = times(q.transpose(), stiff.as_ref());
    let pairs = || pairs(q.ncols());
    let unit = |row: usize, column: usize| f64::from(u8::from(row == column));
    let coupling = coupling(condensed, matrices);
    let [interior, reaction] = statics(condensed, matrices);
    let complete = condensed.basis.complete_below.sqrt() / TAU;
    vec![
        Check::at_most(
            "vectors orthonormal",
            "largest |Q^T M_ii Q - 1|",
            largest(pairs().map(|(row, column)| gram[(row, column)] - unit(row, column))),
            PRODUCTS,
        ),
        Check::at_most(
            "vectors diagonalise",
            "largest |Q^T K_ii Q - k_qq|, relative to both diagonals",
            largest(pairs().map(|(row, column)| {
                let expected = unit(row, column) * values[row];
                (energy[(row, column)] - expected) / (values[row] * values[column]).sqrt()
            })),
            PRODUCTS,
        ),
        Check::at_most(
            "constraint modes orthogonal",
            "largest stiffness between constraint modes and interior vectors, relative to both",
            coupling,
            STATIC,
        ),
        Check::at_most(
            "static interior",
            "|K_ii x + K_ib T u| / |the same before the interior gives way|, for interface motions u without pattern",
            interior,
            STATIC,
        ),
        Check::at_most(
            STATIC_INTERFACE,
            "|reaction of the full matrices - k_bb u| / |reaction before the interior gives way|, for the same motions",
            reaction,
            STATIC,
        ),
        Check::at_least(
            "band covered",
            format!(
                "frequency up to which all fixed-interface modes are kept ({complete:.0} Hz) / top of the band ({band_hz:.0} Hz)"
            ),
            complete / band_hz,
            1.0,
        ),
    ]
}

/// `Q^T (K_ii Psi + K_ib T)` in units of the energies of both.
fn coupling(condensed: &CraigBampton, matrices: &SystemMatrices) -> f64 {
    let substructure = &condensed.substructure;
    let partition = &substructure.partition;
    let (q, values) = (&condensed.basis.vectors, condensed.basis.values());
    if q.ncols() == 0 {
        return 0.0;
    }
    let k_ib = submatrix(&matrices.stiffness, &partition.interior, &partition.driven);
    let stiff = substructure.interior.stiffness_times(q);
    let product = times(stiff.transpose(), substructure.constraint_modes.as_ref())
        + transpose_times_dense(&partition.tie, &transpose_times_dense(&k_ib, q)).transpose();
    // k_bb of a free body on one node is round-off of what it was summed from
    let typical = substructure.made_of.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let entries = (0..product.ncols()).flat_map(|column| {
        let product = &product;
        (0..product.nrows()).map(move |row| product[(row, column)] / (values[row] * typical).sqrt())
    });
    largest(entries)
}

/// Residual of the interior and of the reaction for some interface motions, by the full matrices.
fn statics(condensed: &CraigBampton, matrices: &SystemMatrices) -> [f64; 2] {
    let substructure = &condensed.substructure;
    let partition = &substructure.partition;
    let interface = substructure.interface_dof();
    let u = DenseMatrix::from_fn(interface, TRIALS, |row, column| {
        // irrational steps: no motion is a pattern of the interface
        ((row + 1) as f64 * (1.0 + column as f64 * 0.414_213_562)).sin()
    });
    let coordinates = faer::concat![[u.as_ref()], [DenseMatrix::zeros(condensed.basis.count(), TRIALS)]];
    let k: &SparseMatrix = &matrices.stiffness;
    let x = condensed.field(&coordinates, k.rows());
    // forces on the free interior, and the reaction, of motions
    let forces = |x: &DenseMatrix| {
        let force = sparse_times_dense(k, x);
        let inside = condensed.interior_of(&force);
        let reaction = transpose_times_dense(&partition.tie, &rows_of(&force, &partition.driven));
        [substructure.interior.working(&inside), reaction + substructure.interior.lifted(&inside)]
    };
    let [residual, reaction] = forces(&x);
    let expected = condensed.superelement.stiffness.subrows(0, interface) * &coordinates;
    // the reaction of a free body may be zero; that of its interface alone is not
    let mut start = x;
    let lifted = substructure.interior.lift(0, interface).map(|lift| lift * &u);
    for (row, &dof) in partition.interior.iter().enumerate() {
        for column in 0..TRIALS {
            start[(dof, column)] = lifted.as_ref().map_or(0.0, |lifted| lifted[(row, column)]);
        }
    }
    let [pulled, alone] = forces(&start);
    let scale = |a: &DenseMatrix| a.norm_l2().max(f64::MIN_POSITIVE);
    [residual.norm_l2() / scale(&pulled), (&reaction - &expected).norm_l2() / scale(&alone)]
}

/// All checks of a condensed housing against the matrices that it was condensed from; of one on modes of its interface, all that
/// still hold. Static response of the interface does not, and is not among them.
///
/// # Errors
/// What the dense eigenvalue solver reports.
pub(crate) fn check_craig_bampton(
    condensed: &CraigBampton,
    reduction: Option<&InterfaceReduction>,
    matrices: &SystemMatrices,
    rigid: &RigidMotions,
    band_hz: f64,
) -> Result<Vec<Check>, ReductionError> {
    let element = reduction.map_or(&condensed.superelement, |reduced| &reduced.superelement);
    let made_of = reduction.is_none().then_some(&*condensed.substructure.made_of);
    let (of_matrices, (of_basis, of_rigid)) = rayon::join(
        || check_matrices(element, made_of),
        || rayon::join(|| checks(condensed, matrices, band_hz), || rigid.checks(condensed, reduction, matrices)),
    );
    let mut all = of_matrices?;
    all.extend(of_basis.into_iter().filter(|check| reduction.is_none() || check.name != STATIC_INTERFACE));
    all.extend(of_rigid?);
    Ok(all)
}
