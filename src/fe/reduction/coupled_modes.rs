//! Modes of a condensed housing with what is attached to its interface, and how far they miss their equations.

use super::substructure::diagonal;
use super::{InteriorBasis, ReductionError, Substructure};
use crate::numerics::linalg::{DenseMatrix, SymmetricSpectrum, symmetric_generalised_eigen};
use faer::MatRef;

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
    let (k, m) = (substructure.stiffness(), &substructure.mass);
    attached.map_or_else(|| [k.clone(), m.clone()], |part| [k + part.stiffness, m + part.mass])
}

/// Matrices k, m of an interface, on `c` coordinates [c x c], and a basis, whose amplitudes come after them; `driven` is how
/// the coordinates' accelerations drive these [q x c].
pub(super) fn with_amplitudes(
    [k_cc, m_cc]: [MatRef<'_, f64>; 2],
    basis: &InteriorBasis,
    driven: MatRef<'_, f64>,
) -> [DenseMatrix; 2] {
    let q = basis.count();
    let none = DenseMatrix::zeros(k_cc.nrows(), q);
    let unit = DenseMatrix::identity(q, q);
    [
        faer::concat![[k_cc, none], [none.transpose(), diagonal(basis.values())]],
        faer::concat![[m_cc, driven.transpose()], [driven, unit]],
    ]
}

/// Matrices k, m [order x order] of a basis: the interface first, then the amplitudes of the interior's vectors.
pub(super) fn reduced_matrices(
    substructure: &Substructure,
    basis: &InteriorBasis,
    attached: Option<Attached<'_>>,
) -> [DenseMatrix; 2] {
    let [k_bb, m_bb] = interface_matrices(substructure, attached);
    with_amplitudes([k_bb.as_ref(), m_bb.as_ref()], basis, basis.participation.as_ref())
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
        + substructure.interior.mass_times(&(&basis.vectors * amplitudes))
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
    let stiff = substructure.interior.stiffness_times(&(&basis.vectors * amplitudes));
    for (column, &mode) in chosen.iter().enumerate() {
        let lambda = modes.values[mode];
        let stiff = stiff.col_as_slice(column);
        for (entry, stiff) in residual.col_as_slice_mut(column).iter_mut().zip(stiff) {
            *entry = lambda * *entry - stiff;
        }
    }
    residual
}
