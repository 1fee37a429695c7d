//! Which matrix is factorised: K itself, K with a shift below zero, or one from the middle of a band.

use super::super::{EigenProblem, Factor, FactorMemory, Kind, LinalgError, SymmetricMatrix};
use std::sync::Arc;

/// Shift for a structure that can move freely, in units of the smallest `K_ii / M_ii`: far below the first elastic
/// eigenvalue of a mesh worth computing, far above the round-off of a rigid motion.
const FREE_SHIFT: f64 = -1e-4;

/// Smallest distance of a shift from a rigid motion, in units of the round-off of `K x`: the factor's contraction is
/// about its reciprocal.
pub(super) const FIRM: f64 = 1e6;

/// Entries of a factor above which `L B L^T` is faster than `L L^T`, definite or not (9.1 s against 11.1 s for 2.1e8
/// entries; 0.7 s against 0.5 s for 2.1e7).
const LARGE: usize = 1 << 26;

impl EigenProblem {
    /// Factor in the middle of a band, or beside it.
    pub(super) fn middle_factor(&self, low: f64, high: f64) -> Result<(f64, Factor), LinalgError> {
        let mut failed = LinalgError::no_gap(1);
        for place in [0.5, 0.47, 0.53, 0.44] {
            let sigma = low + place * (high - low);
            let shifted = self.stiffness.shifted(sigma, &self.mass);
            match Factor::double(&self.symbolic, &shifted, Kind::Indefinite) {
                Ok(factor) => return Ok((sigma, factor)),
                Err(error) => failed = error,
            }
        }
        Err(failed)
    }

    /// Factor of K, or of K less a shift below zero if K is not positive definite.
    pub(super) fn definite_factor(&self) -> Result<(f64, Arc<Factor>), LinalgError> {
        if let Some(factor) = self.factor.as_ref().filter(|factor| factor.is_sharp()) {
            let light = factor.lightened(&self.stiffness).map(Arc::new);
            return Ok((0.0, light.unwrap_or_else(|| Arc::clone(factor))));
        }
        let attempt = |sigma: f64| -> Result<(f64, Arc<Factor>), LinalgError> {
            let shifted = self.stiffness.shifted(sigma, &self.mass);
            let factor = self.definite(&shifted, sigma != 0.0)?;
            Ok((sigma, Arc::new(factor)))
        };
        let mut tried = attempt(0.0);
        if let Ok((_, factor)) = &tried
            && !factor.is_sharp()
        {
            tried = Err(LinalgError::NearlySingular { order: self.order(), contraction: factor.contraction });
        }
        let first = self.free_shift();
        for larger in [1.0, 1e2, 1e4] {
            match tried {
                Err(LinalgError::Factorisation { .. }) | Ok(_) => break,
                Err(_) => tried = attempt(larger * first),
            }
        }
        tried
    }

    /// Factor of a matrix that must be positive definite, in double precision only where it was asked for before.
    pub(super) fn definite(&self, a: &SymmetricMatrix, thorough: bool) -> Result<Factor, LinalgError> {
        let factorise = if thorough { Factor::new } else { Factor::quick };
        let large = self.symbolic.len_val() > LARGE;
        let kind = if large { Kind::Indefinite } else { Kind::Definite };
        let factor = factorise(&self.symbolic, a, kind, FactorMemory::default())?;
        match factor.negative() {
            0 => Ok(factor),
            negative => Err(LinalgError::Refused(format!(
                "the {0} x {0} matrix is not positive definite: {negative} of its eigenvalues are negative",
                a.order()
            ))),
        }
    }

    /// A shift below all eigenvalues.
    pub(super) fn free_shift(&self) -> f64 {
        let (k, m) = (self.stiffness.diagonal(), self.mass.diagonal());
        let smallest = k
            .iter()
            .zip(&m)
            .map(|(k, m)| k / m)
            .filter(|ratio| ratio.is_finite() && *ratio > 0.0)
            .fold(f64::INFINITY, f64::min);
        if smallest.is_finite() { FREE_SHIFT * smallest } else { -1.0 }
    }
}
