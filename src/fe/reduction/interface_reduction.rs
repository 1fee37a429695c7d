//! A condensed housing on fewer coordinates than its interface has.
//!
//! ```text
//! d = R p          k_cc = R^T k_bb R     m_cc = R^T m_bb R     m_qc = m_qb R
//! ```
//!
//! with R the lowest [characteristic constraint modes](super::CharacteristicModes), `R^T (m_bb + m_a) R = 1`. Rigid motions are
//! carried, frequencies converge from above, k_qc stays zero; with all modes kept nothing changes. What is given up:
//! static response of the interface is no longer exact, and a load on few of its coordinates meets too stiff an interface.

use super::{Attached, CharacteristicModes, CraigBampton, InterfaceSize, ReductionError, Superelement};
use crate::numerics::linalg::{DenseMatrix, congruent, symmetric_generalised_eigen};

/// A superelement on characteristic constraint modes, with the way back to the interface.
#[derive(Debug, Clone)]
pub struct InterfaceReduction {
    /// The reduced matrices; their interface coordinates are amplitudes of the modes.
    pub superelement: Superelement,
    /// diag(R, 1) [order x reduced order]: coordinates with the whole interface from the reduced ones.
    pub(super) transform: DenseMatrix,
    /// `(m_bb + m_a) R` [interface x kept], kg^(1/2).
    inertia: DenseMatrix,
    /// Squared frequencies of the kept modes, 1/s^2, ascending.
    values: Vec<f64>,
    /// That of the first mode left out, 1/s^2; `None` if all are kept.
    pub(crate) next: Option<f64>,
}

impl InterfaceReduction {
    /// The superelement of a condensed housing on as many modes of its interface as `size` says.
    ///
    /// # Errors
    /// As `CharacteristicModes::kept`.
    pub fn new(
        condensed: &CraigBampton,
        modes: &CharacteristicModes,
        size: InterfaceSize,
    ) -> Result<Self, ReductionError> {
        let whole = &condensed.superelement;
        let (interface, kept) = (whole.interface_dof, modes.kept(size)?);
        let (modal, r) = (whole.modal_dof(), modes.vectors.subcols(0, kept));
        let transform = faer::concat![
            [r, DenseMatrix::zeros(interface, modal)],
            [DenseMatrix::zeros(modal, kept), DenseMatrix::identity(modal, modal)],
        ];
        let mut stiffness = congruent(&whole.stiffness, &transform);
        // rigid motions that nothing holds have no stiffness: what stands there is round-off of a sum of large terms
        for rigid in 0..modes.rigid {
            for other in 0..stiffness.ncols() {
                stiffness[(rigid, other)] = 0.0;
                stiffness[(other, rigid)] = 0.0;
            }
        }
        Ok(Self {
            superelement: Superelement {
                stiffness,
                mass: congruent(&whole.mass, &transform),
                weight: transform.transpose() * &whole.weight,
                structural: whole.structural.as_ref().map(|matrix| congruent(matrix, &transform)),
                interface_dof: kept,
            },
            inertia: &modes.mass * r,
            transform,
            values: modes.values[..kept].to_vec(),
            next: modes.values.get(kept).copied(),
        })
    }

    /// Number of modes kept.
    pub(crate) fn kept(&self) -> usize {
        self.values.len()
    }

    /// Squared frequencies of the kept modes, 1/s^2, ascending; 0 of rigid motions.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The modes R [interface x kept], kg^(-1/2).
    pub fn modes(&self) -> DenseMatrix {
        let interface = self.inertia.nrows();
        let modes = self.transform.subrows(0, interface);
        modes.subcols(0, self.kept()).to_owned()
    }

    /// Rows over the coordinates [order x k], as columns, over the reduced ones [reduced order x k].
    pub(crate) fn rows(&self, rows: &DenseMatrix) -> DenseMatrix {
        self.transform.transpose() * rows
    }

    /// Reduced coordinates [reduced order x k] that are nearest to motions of the interface [interface x k] in the norm of
    /// its mass: `p = R^T (m_bb + m_a) d`, no amplitudes of the interior.
    pub(crate) fn nearest(&self, motions: &DenseMatrix) -> DenseMatrix {
        let amplitudes = self.inertia.transpose() * motions;
        faer::concat![[amplitudes], [DenseMatrix::zeros(self.superelement.modal_dof(), motions.ncols())]]
    }

    /// Squared frequencies with what is attached, 1/s^2, ascending.
    ///
    /// # Errors
    /// What the dense eigenvalue solver reports.
    pub(crate) fn coupled_values(&self, attached: Option<Attached<'_>>) -> Result<Vec<f64>, ReductionError> {
        let (mut k, mut m) = (self.superelement.stiffness.clone(), self.superelement.mass.clone());
        if let Some(part) = attached {
            let modes = self.modes();
            for (whole, part) in [(&mut k, part.stiffness), (&mut m, part.mass)] {
                let mut interface = whole.submatrix_mut(0, 0, self.kept(), self.kept());
                interface += congruent(part, &modes);
            }
        }
        Ok(symmetric_generalised_eigen(&k, &m)?.values)
    }
}

#[cfg(test)]
#[path = "interface_reduction_tests.rs"]
mod tests;
