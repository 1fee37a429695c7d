//! Modes of a condensed housing with what is attached to its interface, and how far they miss their equations.

use super::{InteriorBasis, ReductionError, Substructure};
use crate::numerics::linalg::{DenseMatrix, SymmetricSpectrum, symmetric_generalised_eigen};

/// What is attached to an interface: a bearing's ring with its springs.
#[derive(Debug, Clone, Copy)]
pub struct Attached<'a> {
    /// Stiffness [interface x interface], N/m.
    pub stiffness: &'a DenseMatrix,
    /// Mass [interface x interface], kg.
    pub mass: &'a DenseMatrix,
}

/// k_bb and m_bb of a housing with what is attached [interface x interface].
pub(super) fn interface_matrices(substructure: &Substructure, attached: Option<Attached<'_>>) -> [DenseMatrix; 2] {
    let with = |own: &DenseMatrix, more: Option<&DenseMatrix>| match more {
        Some(more) => own + more,
        None => own.clone(),
    };
    [
        with(substructure.stiffness(), attached.map(|part| part.stiffness)),
        with(substructure.mass(), attached.map(|part| part.mass)),
    ]
}

/// Matrices k, m [order x order] of a basis: the interface first, then the amplitudes of the interior's vectors.
pub(super) fn reduced_matrices(
    substructure: &Substructure,
    basis: &InteriorBasis,
    attached: Option<Attached<'_>>,
) -> [DenseMatrix; 2] {
    let interface = substructure.interface_dof();
    let order = interface + basis.count();
    let [k_bb, m_bb] = interface_matrices(substructure, attached);
    let (values, m_qb) = (basis.values(), basis.participation());
    let stiffness = DenseMatrix::from_fn(order, order, |row, column| {
        match (row.checked_sub(interface), column.checked_sub(interface)) {
            (None, None) => k_bb[(row, column)],
            (Some(mode), Some(other)) if mode == other => values[mode],
            _ => 0.0,
        }
    });
    let mass = DenseMatrix::from_fn(order, order, |row, column| {
        match (row.checked_sub(interface), column.checked_sub(interface)) {
            (None, None) => m_bb[(row, column)],
            (Some(mode), None) => m_qb[(mode, column)],
            (None, Some(mode)) => m_qb[(mode, row)],
            (Some(mode), Some(other)) => f64::from(u8::from(mode == other)),
        }
    });
    [stiffness, mass]
}

/// All modes of a condensed housing with what is attached to it.
pub(super) fn coupled_modes(
    substructure: &Substructure,
    basis: &InteriorBasis,
    attached: Option<Attached<'_>>,
) -> Result<SymmetricSpectrum, ReductionError> {
    let [k, m] = reduced_matrices(substructure, basis, attached);
    Ok(symmetric_generalised_eigen(&k, &m)?)
}

/// Inertia of the interior per unit of squared frequency, `A u_b + M_ii Q eta` [interior x k], of motions of the condensed
/// housing [order x k].
pub(super) fn interior_inertia(
    substructure: &Substructure,
    basis: &InteriorBasis,
    coordinates: &DenseMatrix,
) -> DenseMatrix {
    let interface = substructure.interface_dof();
    let amplitudes = coordinates.subrows(interface, basis.count());
    substructure.follow(&coordinates.subrows(0, interface).to_owned())
        + substructure.mass_times(&(basis.vectors() * amplitudes))
}

/// What the interior's equations lack, for modes `chosen` of `modes` [interior x chosen]:
///
/// ```text
/// r = lambda (M_ib u_b + M_ii u_i) - (K_ib u_b + K_ii u_i)     with u_i = Psi u_b + Q eta
///   = lambda (A u_b + M_ii Q eta) - K_ii Q eta
/// ```
///
/// The interface's equations hold exactly. `K_ii^-1 r` is what the interior would move further: the residual vector.
pub(super) fn interior_residuals(
    substructure: &Substructure,
    basis: &InteriorBasis,
    modes: &SymmetricSpectrum,
    chosen: &[usize],
) -> DenseMatrix {
    let coordinates =
        DenseMatrix::from_fn(modes.vectors.nrows(), chosen.len(), |row, column| modes.vectors[(row, chosen[column])]);
    let mut residual = interior_inertia(substructure, basis, &coordinates);
    let amplitudes = coordinates.subrows(substructure.interface_dof(), basis.count());
    let stiff = substructure.stiffness_times(&(basis.vectors() * amplitudes));
    for (column, &mode) in chosen.iter().enumerate() {
        let lambda = modes.values[mode];
        let stiff = stiff.col_as_slice(column);
        for (entry, stiff) in residual.col_as_slice_mut(column).iter_mut().zip(stiff) {
            *entry = lambda * *entry - stiff;
        }
    }
    residual
}
