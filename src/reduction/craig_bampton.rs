//! The reduction itself: one factorisation of K_ii for constraint modes and fixed-interface modes.
//!
//! With b the interface, i the interior, T the map from interface coordinates to the displacements
//! it drives (Craig and Bampton, AIAA Journal 6 (1968) 1313-1319, with the tie folded in):
//!
//! ```text
//! Psi = -K_ii^-1 K_ib T                                     constraint modes, statically exact
//! K_ii Phi = M_ii Phi Lambda, Phi^T M_ii Phi = 1            fixed-interface modes
//! k = [[T^T K_bb T + (K_ib T)^T Psi, 0], [0, Lambda]]
//! m = [[T^T (M_bb T + M_bi Psi) + Psi^T (M_ib T + M_ii Psi), sym], [Phi^T (M_ib T + M_ii Psi), 1]]
//! ```
//!
//! Static interface response is exact; frequencies converge from above.

use super::Superelement;
use crate::assembly::SystemMatrices;
use crate::linalg::{
    DenseMatrix, EigenPairs, EigenProblem, LinalgError, SparseCholesky, SparseMatrix,
    sparse_times_dense, submatrix, transpose_times_dense,
};
use crate::model::HousingPartition;
use std::f64::consts::TAU;
use thiserror::Error;

/// How many fixed-interface modes are kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FixedModeSelection {
    /// The lowest so many.
    Count(usize),
    /// All up to a frequency, Hz.
    UpTo(f64),
}

/// A reduction that cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ReductionError {
    /// The interior can move while the interface is held.
    #[error(
        "part of the housing is not connected to the ring: with the bore held it can still move ({interior} interior degrees of freedom); check that the mesh is in one piece and its nodes are merged"
    )]
    FloatingInterior {
        /// Number of interior degrees of freedom.
        interior: usize,
    },
    /// Nothing left to reduce.
    #[error("the housing has no node besides those of the bore")]
    NoInterior,
    /// A linear algebra step failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

/// Condenses a housing on the interface of `partition`.
///
/// # Errors
/// [`ReductionError::FloatingInterior`] if K_ii is singular; what the eigenvalue iteration reports.
pub fn craig_bampton(
    matrices: &SystemMatrices,
    partition: &HousingPartition,
    selection: FixedModeSelection,
) -> Result<Superelement, ReductionError> {
    let (k, m) = (&matrices.stiffness, &matrices.mass);
    let (b, i) = (&partition.driven, &partition.interior);
    if i.is_empty() {
        return Err(ReductionError::NoInterior);
    }
    let (k_ii, m_ii) = (submatrix(k, i, i), submatrix(m, i, i));
    let floating = |error| match error {
        LinalgError::NotPositiveDefinite { .. } | LinalgError::NearlySingular { .. } => {
            ReductionError::FloatingInterior { interior: i.len() }
        }
        other => other.into(),
    };
    let factor = SparseCholesky::new(&k_ii).map_err(floating)?;
    let tie = dense(&partition.tie);
    let driven_k = sparse_times_dense(&submatrix(k, i, b), &tie);
    let mut constraint_modes = &driven_k * faer::Scale(-1.0);
    factor.solve_columns(&mut constraint_modes)?;
    let pairs = fixed_interface_modes(&k_ii, &m_ii, &factor, selection)?;
    let (q, phi) = (pairs.0.len(), &pairs.1);
    let bb = |matrix: &SparseMatrix| {
        tie.transpose() * sparse_times_dense(&submatrix(matrix, b, b), &tie)
    };
    let k_bb = bb(k) + driven_k.transpose() * &constraint_modes;
    // inertia of the interior when the interface moves and the interior follows statically
    let m_ib = submatrix(m, i, b);
    let follow = sparse_times_dense(&m_ib, &tie) + sparse_times_dense(&m_ii, &constraint_modes);
    let m_bb = bb(m)
        + tie.transpose() * transpose_times_dense(&m_ib, &constraint_modes)
        + constraint_modes.transpose() * &follow;
    let m_qb = phi.transpose() * &follow;
    let interface = tie.ncols();
    let entry =
        |bb: &DenseMatrix, row: usize, column: usize| 0.5 * (bb[(row, column)] + bb[(column, row)]);
    let order = interface + q;
    let stiffness = DenseMatrix::from_fn(order, order, |row, column| {
        match (row.checked_sub(interface), column.checked_sub(interface)) {
            (None, None) => entry(&k_bb, row, column),
            (Some(mode), Some(other)) if mode == other => pairs.0[mode],
            _ => 0.0,
        }
    });
    let mass = DenseMatrix::from_fn(order, order, |row, column| {
        match (row.checked_sub(interface), column.checked_sub(interface)) {
            (None, None) => entry(&m_bb, row, column),
            (Some(mode), None) => m_qb[(mode, column)],
            (None, Some(mode)) => m_qb[(mode, row)],
            (Some(mode), Some(other)) => f64::from(u8::from(mode == other)),
        }
    });
    Ok(Superelement::new(
        partition.clone(),
        stiffness,
        mass,
        constraint_modes,
        phi.clone(),
        &matrices.weight,
    ))
}

/// Eigenvalues and vectors [interior x count] with the interface held.
fn fixed_interface_modes(
    k_ii: &SparseMatrix,
    m_ii: &SparseMatrix,
    factor: &SparseCholesky,
    selection: FixedModeSelection,
) -> Result<(Vec<f64>, DenseMatrix), ReductionError> {
    let of_pairs = |pairs: EigenPairs| (pairs.values, pairs.vectors);
    let problem = || EigenProblem::with_factor(k_ii, m_ii, factor);
    Ok(match selection {
        FixedModeSelection::Count(0) => (Vec::new(), DenseMatrix::zeros(k_ii.rows(), 0)),
        FixedModeSelection::Count(count) => of_pairs(problem()?.lowest(count)?),
        FixedModeSelection::UpTo(hz) => of_pairs(problem()?.below((TAU * hz).powi(2))?),
    })
}

/// A sparse matrix with all its zeros.
fn dense(sparse: &SparseMatrix) -> DenseMatrix {
    let mut full = DenseMatrix::zeros(sparse.rows(), sparse.cols());
    for (column, entries) in sparse.outer_iterator().enumerate() {
        for (row, &value) in entries.iter() {
            full[(row, column)] = value;
        }
    }
    full
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::{TripletBuilder, symmetric_generalised_eigen};

    /// Rod of unit springs and masses, free at both ends.
    fn rod(nodes: usize) -> SystemMatrices {
        let (mut k, mut m) = (
            TripletBuilder::new(nodes, nodes),
            TripletBuilder::new(nodes, nodes),
        );
        for node in 0..nodes {
            m.add(node, node, 1.0);
            if node + 1 < nodes {
                for (row, column, value) in [(0, 0, 1.0), (1, 1, 1.0), (0, 1, -1.0), (1, 0, -1.0)] {
                    k.add(node + row, node + column, value);
                }
            }
        }
        SystemMatrices {
            stiffness: k.build(),
            mass: m.build(),
            weight: DenseMatrix::zeros(nodes, 2),
            total_mass: nodes as f64,
        }
    }

    fn partition(nodes: usize) -> HousingPartition {
        let mut tie = TripletBuilder::new(1, 1);
        tie.add(0, 0, 1.0);
        HousingPartition {
            driven: vec![0],
            interior: (1..nodes).collect(),
            tie: tie.build(),
        }
    }

    #[test]
    fn all_modes_kept_is_the_full_model() {
        let rod = rod(12);
        let reduced =
            craig_bampton(&rod, &partition(12), FixedModeSelection::Count(11)).expect("connected");
        let found = symmetric_generalised_eigen(reduced.stiffness(), reduced.mass()).expect("free");
        let full =
            symmetric_generalised_eigen(&dense(&rod.stiffness), &dense(&rod.mass)).expect("free");
        for mode in 0..12 {
            let error = (found.values[mode] - full.values[mode]).abs();
            assert!(error < 1e-11, "{mode}: {error:e}");
        }
    }

    #[test]
    fn frequencies_converge_from_above() {
        let rod = rod(40);
        let full =
            symmetric_generalised_eigen(&dense(&rod.stiffness), &dense(&rod.mass)).expect("free");
        let mut before = f64::INFINITY;
        for kept in [0, 2, 5, 10] {
            let reduced = craig_bampton(&rod, &partition(40), FixedModeSelection::Count(kept))
                .expect("connected");
            let modes =
                symmetric_generalised_eigen(reduced.stiffness(), reduced.mass()).expect("free");
            // the rigid mode is exact, so is static response: k_bb of a free rod is zero
            assert!(modes.values[0].abs() < 1e-12);
            if kept > 0 {
                let error = modes.values[1] - full.values[1];
                assert!(error > -1e-13 && error < before);
                before = error;
            }
        }
        // ten of 39 modes: the loop shows that the error falls, this how far
        assert!(
            before < 3e-4 * full.values[1],
            "{:e}",
            before / full.values[1]
        );
    }

    #[test]
    fn a_loose_piece_is_named() {
        let rod = rod(10);
        let loose = HousingPartition {
            interior: vec![5, 6, 7],
            ..partition(10)
        };
        // nodes 5 to 7 hang on nothing once 4 and 8 are neither driven nor interior: held by them
        assert!(craig_bampton(&rod, &loose, FixedModeSelection::Count(1)).is_ok());
        let mut springs = TripletBuilder::new(10, 10);
        springs.add(0, 0, 1.0);
        let nothing = SystemMatrices {
            stiffness: springs.build(),
            ..rod
        };
        let error = craig_bampton(&nothing, &partition(10), FixedModeSelection::Count(1))
            .expect_err("no stiffness");
        assert_eq!(error, ReductionError::FloatingInterior { interior: 9 });
    }

    #[test]
    fn a_cut_off_frequency_keeps_what_is_below() {
        let rod = rod(60);
        // fixed-free rod of 59 masses: lambda_j = 4 sin^2((2j - 1) pi / (2 (2n + 1)))
        let limit: f64 = 0.5;
        let exact = (1..=59)
            .filter(|j| {
                let angle = f64::from(2 * j - 1) * std::f64::consts::PI / (2.0 * 119.0);
                2.0 * angle.sin() <= limit
            })
            .count();
        let reduced = craig_bampton(&rod, &partition(60), FixedModeSelection::UpTo(limit / TAU))
            .expect("connected");
        assert_eq!(reduced.fixed_interface_modes(), exact);
    }
}
