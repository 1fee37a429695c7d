//! What every reduction of a housing starts from, computed once: one factorisation of K_ii, the constraint modes and
//! the interface's matrices.
//!
//! With b the driven degrees of freedom, i the interior and T the map from the interface coordinates to the
//! displacements that they drive (Craig and Bampton, AIAA Journal 6 (1968) 1313-1319, with the tie folded in):
//!
//! ```text
//! Psi  = -K_ii^-1 K_ib T                                    constraint modes, statically exact
//! A    = M_ib T + M_ii Psi                                  inertia of the interior that follows the interface
//! k_bb = T^T K_bb T + (K_ib T)^T Psi
//! m_bb = T^T M_bb T + (M_ib T)^T Psi + Psi^T A
//! ```
//!
//! Interface coordinates that are means `W u` of the interior (see [`MeanTie`](crate::fe::model::MeanTie)) are held with the
//! interface: their constraint modes are the motions of least strain energy with `W Psi = 1`, and `k_bb` has what holds them,
//!
//! ```text
//! k_bb = T^T K_bb T + (K_ib T)^T Psi + Psi^T (K_ib T + K_ii Psi)
//! ```
//!
//! whose error is of second order in that of Psi. The reaction of the means alone would have it of first order, and of a free body,
//! whose rigid motions cost nothing, there is nothing else.

use super::ReductionError;
use super::interior::Interior;
use super::parts::{add_columns, columns_of, dense, symmetric};
use crate::fe::assembly::SystemMatrices;
use crate::fe::model::HousingPartition;
use crate::numerics::linalg::{
    DenseMatrix, EigenPairs, SparseMatrix, congruence, sparse_times_dense, submatrix, times, transpose_times_dense,
};
use crate::numerics::{Unwatched, Watch};
use faer::{MatMut, MatRef};
use rayon::prelude::*;
use std::ops::Range;

/// Interface coordinates that are handled at once: their products with the interior stay small beside the constraint
/// modes.
const BLOCK: usize = 32;

/// Diagonal of k_bb, over what it is summed from, that is its round-off: a body that nothing holds along a coordinate has none. The
/// sums of ten thousand nodes leave 1e-15.
const ROUND_OFF: f64 = 1e-13;

/// A housing split into interface and interior, with the factor of its interior.
#[derive(Debug, Clone)]
pub struct Substructure {
    /// How the degrees of freedom were split.
    pub(crate) partition: HousingPartition,
    /// K_ii and M_ii with the factor, and what holds the interior.
    pub(super) interior: Interior,
    /// M_ib T [interior x interface].
    mass_ib: SparseMatrix,
    /// Constraint modes Psi [interior x interface].
    pub(super) constraint_modes: DenseMatrix,
    stiffness: DenseMatrix,
    /// Stiffness of each interface coordinate before the interior gives way, N/m: what k_bb is summed from. Of a free body on one
    /// node k_bb is nothing but its round-off.
    pub(super) made_of: Vec<f64>,
    /// m_bb [interface x interface], kg.
    pub(super) mass: DenseMatrix,
}

impl Substructure {
    /// Splits a housing and condenses it statically.
    ///
    /// # Errors
    /// [`ReductionError::Refused`] for no interior and for no interface, [`ReductionError::FloatingInterior`] if K_ii
    /// is singular, [`ReductionError::SoftInterior`] if it nearly is.
    pub fn new(matrices: &SystemMatrices, partition: &HousingPartition) -> Result<Self, ReductionError> {
        Self::watched(matrices, partition, &Unwatched)
    }

    /// The same; `watch` is told of factorisation and constraint modes.
    ///
    /// # Errors
    /// As [`Substructure::new`].
    pub(super) fn watched(
        matrices: &SystemMatrices,
        partition: &HousingPartition,
        watch: &dyn Watch,
    ) -> Result<Self, ReductionError> {
        let (k, m) = (&matrices.stiffness, &matrices.mass);
        let (b, i, tie) = (&partition.driven, &partition.interior, &partition.tie);
        if i.is_empty() {
            return Err(ReductionError::Refused(
                "the interface takes every free displacement of the housing, so that nothing is left to condense: expected an interface of fewer nodes, or a finer mesh"
                    .to_owned(),
            ));
        }
        if tie.cols() == 0 {
            let what = "the interface has no free degree of freedom: every one of its nodes is fixed or tied";
            return Err(ReductionError::Refused(what.to_owned()));
        }
        watch.stage("factor");
        let driven = |a: &SparseMatrix| dense(&congruence(&submatrix(a, b, b), tie));
        let of_interface = || {
            let [stiffness_ib, mass_ib] = [k, m].map(|a| (&submatrix(a, i, b) * tie).to_csc());
            ([stiffness_ib, mass_ib], [driven(k), driven(m)], DenseMatrix::zeros(i.len(), tie.cols()))
        };
        let (interior, of_interface) = rayon::join(|| Interior::new(matrices, partition), of_interface);
        let ([stiffness_ib, mass_ib], [stiffness, mass], constraint_modes) = of_interface;
        let mut substructure = Self {
            made_of: (0..tie.cols()).map(|row| stiffness[(row, row)]).collect(),
            stiffness,
            mass,
            constraint_modes,
            partition: partition.clone(),
            interior: interior?,
            mass_ib,
        };
        if let Some(choice) = substructure.interior.factor_choice() {
            watch.note(&choice.sentence());
        }
        watch.stage("constraint modes");
        substructure.condense_statically(&stiffness_ib, watch)?;
        Ok(substructure)
    }

    fn condense_statically(&mut self, stiffness_ib: &SparseMatrix, watch: &dyn Watch) -> Result<(), ReductionError> {
        let order = self.interface_dof();
        let blocks: Vec<Range<usize>> =
            (0..order).step_by(BLOCK).map(|first| first..order.min(first + BLOCK)).collect();
        // no more at once than there are threads: each takes the memory of some blocks
        let mut all = std::mem::replace(&mut self.constraint_modes, DenseMatrix::zeros(0, 0));
        for together in blocks.chunks(rayon::current_num_threads()) {
            let (first, last) = (together[0].start, together[together.len() - 1].end);
            watch.fraction(first as f64 / order as f64);
            let to = all.as_mut().subcols_mut(first, last - first).par_col_chunks_mut(BLOCK);
            let modes = together.par_iter().zip(to).map(|(block, mut to)| {
                let (modes, made_of) = self.modes(stiffness_ib, block)?;
                to.copy_from(&modes);
                Ok((modes, made_of))
            });
            let modes: Vec<(DenseMatrix, Vec<f64>)> = modes.collect::<Result<_, ReductionError>>()?;
            let of_modes = together.par_iter().zip(&modes).map(|(block, (modes, _))| {
                let known = all.subcols(0, block.end).transpose();
                self.of_modes(stiffness_ib, block, modes, known)
            });
            let matrices: Vec<[DenseMatrix; 2]> = of_modes.collect();
            for ((block, (_, made_of)), [k, m]) in together.iter().zip(modes).zip(matrices) {
                self.made_of[block.clone()].iter_mut().zip(made_of).for_each(|(sum, more)| *sum += more);
                if self.interior.holds_means() {
                    add_mirrored(&mut self.stiffness, block.start, &k);
                } else {
                    add_block(self.stiffness.subcols_mut(block.start, block.len()), k.as_ref());
                }
                add_mirrored(&mut self.mass, block.start, &m);
            }
        }
        self.constraint_modes = all;
        self.stiffness = symmetric(&self.stiffness);
        self.mass = symmetric(&self.mass);
        self.drop_round_off();
        Ok(())
    }

    /// Constraint modes of some interface coordinates [interior x block], and what their lift adds to [`made_of`](Self::made_of).
    fn modes(
        &self,
        stiffness_ib: &SparseMatrix,
        block: &Range<usize>,
    ) -> Result<(DenseMatrix, Vec<f64>), ReductionError> {
        let mut pulled = columns_of(stiffness_ib, block.start, block.len());
        let lift = self.interior.lift(block.start, block.len());
        let mut made_of = vec![0.0; block.len()];
        if let Some(lift) = &lift {
            let stiff = self.interior.stiffness_times(lift);
            for (column, made_of) in made_of.iter_mut().enumerate() {
                let parts = (0..lift.nrows())
                    .map(|row| lift[(row, column)] * (2.0 * pulled[(row, column)] + stiff[(row, column)]));
                *made_of = parts.sum();
            }
            pulled += stiff;
        }
        pulled *= faer::Scale(-1.0);
        let mut modes = self.interior.solve(pulled)?;
        if let Some(lift) = &lift {
            modes += lift;
        }
        Ok((modes, made_of))
    }

    /// What constraint modes add to k_bb and m_bb; `known` are those and all before, transposed. Both matrices are symmetric: of m_bb,
    /// and of k_bb where means are held, rows above the diagonal block stand for the columns beside it.
    fn of_modes(
        &self,
        stiffness_ib: &SparseMatrix,
        block: &Range<usize>,
        modes: &DenseMatrix,
        known: MatRef<'_, f64>,
    ) -> [DenseMatrix; 2] {
        let mut k = transpose_times_dense(stiffness_ib, modes);
        if self.interior.holds_means() {
            // the interior is in equilibrium but for what holds the means
            let mut holding = self.interior.stiffness_times(modes);
            add_columns(&mut holding, stiffness_ib, block.start);
            k = times(known, holding.as_ref()) + k.subrows(0, block.end);
        }
        let mut follow = self.interior.mass_times(modes);
        add_columns(&mut follow, &self.mass_ib, block.start);
        let m = times(known, follow.as_ref()) + transpose_times_dense(&self.mass_ib, modes).subrows(0, block.end);
        [k, m]
    }

    /// Makes rows and columns of k_bb zero whose diagonal is round-off: k_bb is semidefinite, so that `k_ij^2 <= k_ii k_jj`.
    fn drop_round_off(&mut self) {
        for row in 0..self.made_of.len() {
            if self.stiffness[(row, row)].abs() <= ROUND_OFF * self.made_of[row] {
                self.stiffness.row_mut(row).fill(0.0);
                self.stiffness.col_mut(row).fill(0.0);
            }
        }
    }

    /// Number of interface coordinates.
    pub fn interface_dof(&self) -> usize {
        self.partition.tie.cols()
    }

    /// Number of interior degrees of freedom, each mean that is held less by one.
    pub(crate) fn interior_dof(&self) -> usize {
        self.interior.independent()
    }

    /// k_bb [interface x interface], N/m: the housing condensed statically (Guyan, AIAA Journal 3 (1965) 380).
    pub fn stiffness(&self) -> &DenseMatrix {
        &self.stiffness
    }

    /// `K_ii^-1 R` for `R` [interior x k]; means that are held stay zero.
    ///
    /// # Errors
    /// [`LinalgError::Shape`].
    pub(crate) fn solve_interior(&self, r: DenseMatrix) -> Result<DenseMatrix, ReductionError> {
        self.interior.solve(r)
    }

    /// `A U`, the inertia of the interior that follows interface motions `U` [interface x k].
    pub(crate) fn follow(&self, u: &DenseMatrix) -> DenseMatrix {
        let interior = times(self.constraint_modes.as_ref(), u.as_ref());
        self.interior.mass_times(&interior) + sparse_times_dense(&self.mass_ib, u)
    }

    /// `A^T X` for `X` [interior x k].
    pub(crate) fn follow_transposed(&self, x: &DenseMatrix) -> DenseMatrix {
        times(self.constraint_modes.transpose(), self.interior.mass_times(x).as_ref())
            + transpose_times_dense(&self.mass_ib, x)
    }

    /// Fixed-interface modes: the lowest `count` pairs of `K_ii Phi = M_ii Phi Lambda`.
    ///
    /// # Errors
    /// What the eigenvalue iteration reports.
    pub fn lowest_modes(&self, count: usize) -> Result<EigenPairs, ReductionError> {
        self.lowest_modes_watched(count, &Unwatched)
    }

    /// The same; `watch` is told which part is found.
    pub(super) fn lowest_modes_watched(&self, count: usize, watch: &dyn Watch) -> Result<EigenPairs, ReductionError> {
        watch.stage("fixed-interface modes");
        self.interior.lowest(count, &|part| watch.fraction(part))
    }
}

/// Adds columns from `first` on down to the diagonal's block, and what they stand for beside it.
fn add_mirrored(to: &mut DenseMatrix, first: usize, columns: &DenseMatrix) {
    let width = columns.ncols();
    add_block(to.submatrix_mut(0, first, first + width, width), columns.as_ref());
    add_block(to.submatrix_mut(first, 0, width, first), columns.subrows(0, first).transpose());
}

fn add_block(mut to: MatMut<'_, f64>, block: MatRef<'_, f64>) {
    to += block;
}
