//! Characteristic constraint modes: the motions of an interface by what they cost, softest first.
//!
//! ```text
//! (k_bb + k_a) r = lambda (m_bb + m_a) r          r^T (m_bb + m_a) r = 1
//! ```
//!
//! k_a, m_a are of what is attached (a bearing's ring): an interface moves as the coupled structure lets it, not as the
//! housing alone would. The interface condensed statically has these modes (Castanier, Tan and Pierre, AIAA Journal 39
//! (2001) 1182-1187).
//!
//! Rigid motions that nothing holds come first, as they are, and the modes are those of the motions orthogonal to them. Where
//! nothing holds what is attached either, these are the modes at zero themselves; where something does, the modes
//! alone would hold no rigid motion, and the condensed housing would be tied to the ground.

use super::interior_basis::{Attached, interface_matrices};
use super::parts::normalised;
use super::{ReductionError, Substructure};
use crate::numerics::linalg::{DenseMatrix, symmetric_generalised_eigen};
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Squared length of a combination of rigid motions beside the longest, below which it is dependent on the others.
const DEPENDENT: f64 = 1e-12;

/// How many modes of an interface are kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InterfaceSize {
    /// So many, rigid motions among them.
    Count(usize),
    /// Those up to a frequency, Hz.
    UpTo(f64),
}

/// All characteristic constraint modes of an interface.
#[derive(Debug, Clone)]
pub struct CharacteristicModes {
    /// Squared frequencies, 1/s^2, ascending; 0 of the rigid motions.
    pub(super) values: Vec<f64>,
    /// [interface x modes].
    pub(super) vectors: DenseMatrix,
    /// m_bb + m_a [interface x interface], kg.
    pub(super) mass: DenseMatrix,
    /// k_bb + k_a [interface x interface], N/m.
    pub(super) stiffness: DenseMatrix,
    /// How many of the first ones are rigid motions.
    pub(super) rigid: usize,
}

/// Share of the interface's static flexibility that kept modes lack.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LostFlexibility {
    /// The largest of all coordinates, 0 to 1.
    pub largest: f64,
    /// Their mean.
    pub mean: f64,
}

impl CharacteristicModes {
    /// Modes of the interface of a housing with what is attached; `rigid` are the motions of the interface
    /// [interface x r] with which the housing moves as a rigid body and that nothing holds: all of them.
    ///
    /// # Errors
    /// What the dense eigenvalue solver reports.
    pub(crate) fn of(
        substructure: &Substructure,
        attached: Option<Attached<'_>>,
        rigid: &DenseMatrix,
    ) -> Result<Self, ReductionError> {
        let [stiffness, mass] = interface_matrices(substructure, attached);
        let normal = normalised(&(rigid.transpose() * (&mass * rigid)), DEPENDENT)?;
        let rigid = rigid * normal;
        let spectrum = symmetric_generalised_eigen(&without(&stiffness, &mass, &rigid), &mass)?;
        let count = rigid.ncols();
        // a motion without mass has an infinite value; it moves nothing of the interior
        let finite = spectrum.values.partition_point(|value| value.is_finite()).max(count);
        let vectors = faer::concat![[rigid, spectrum.vectors.subcols(count, finite - count)]];
        let mut values = spectrum.values;
        values.truncate(finite);
        values[..count].fill(0.0);
        Ok(Self { values, vectors, mass, stiffness, rigid: count })
    }

    /// Number of modes.
    pub(crate) fn count(&self) -> usize {
        self.values.len()
    }

    /// Frequency of a mode, Hz; `None` beyond the last.
    pub(crate) fn frequency_hz(&self, mode: usize) -> Option<f64> {
        let value = self.values.get(mode)?;
        Some(value.max(0.0).sqrt() / TAU)
    }

    /// How many modes a size keeps; all if it asks for more than there are.
    ///
    /// # Errors
    /// [`ReductionError::Refused`] for fewer than the rigid motions, or none.
    pub(crate) fn kept(&self, size: InterfaceSize) -> Result<usize, ReductionError> {
        let asked = match size {
            InterfaceSize::Count(count) => count.min(self.count()),
            InterfaceSize::UpTo(hz) => {
                let value = (TAU * hz).powi(2);
                self.values.partition_point(|&found| found <= value)
            }
        };
        let least = self.rigid.max(1);
        if asked < least {
            let first_hz = self.frequency_hz(0).unwrap_or(f64::INFINITY);
            return Err(ReductionError::Refused(format!(
                "{asked} modes of the interface are kept, expected at least {least}: rigid motions that nothing holds, or else one (the first has {first_hz:.0} Hz)"
            )));
        }
        Ok(asked)
    }

    /// What the first `kept` modes lack of the interface's flexibility under a unit load on each coordinate, rigid motions
    /// taken out of all: `1 - sum_kept (r_j^2 / lambda) / sum_all (r_j^2 / lambda)`.
    pub(crate) fn lost_flexibility(&self, kept: usize) -> LostFlexibility {
        let interface = self.vectors.nrows();
        let flexibility = |row: usize, end: usize| -> f64 {
            let modes = (self.rigid..end).filter(|&mode| self.values[mode] > 0.0);
            let part = |mode| self.vectors[(row, mode)] * self.vectors[(row, mode)] / self.values[mode];
            modes.map(part).sum()
        };
        let lost = |row: usize| {
            let all = flexibility(row, self.count());
            if all > 0.0 { (1.0 - flexibility(row, kept) / all).max(0.0) } else { 0.0 }
        };
        let lost: Vec<f64> = (0..interface).map(lost).collect();
        LostFlexibility {
            largest: lost.iter().copied().fold(0.0, f64::max),
            mean: lost.iter().sum::<f64>() / interface.max(1) as f64,
        }
    }
}

/// `P^T K P` with `P = 1 - V V^T M`: the stiffness of motions that are orthogonal to V, none of V.
fn without(stiffness: &DenseMatrix, mass: &DenseMatrix, v: &DenseMatrix) -> DenseMatrix {
    if v.ncols() == 0 {
        return stiffness.clone();
    }
    let (moved, stiff) = (mass * v, stiffness * v);
    let own = v.transpose() * &stiff;
    // K - (K V) (M V)^T - (M V) (K V)^T + (M V) (V^T K V) (M V)^T
    let one_side = &stiff - &moved * (own * faer::Scale(0.5));
    let product = &one_side * moved.transpose();
    stiffness - (&product + product.transpose())
}
