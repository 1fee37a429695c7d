//! Damping of housing and ring as the case gives it.

use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::fe::reduction::frf::{ModalBasis, ModalDamping, ReducedSystem};
use crate::numerics::linalg::DenseMatrix;

/// The damping of a case; none without `[damping]`.
///
/// # Errors
/// [`ComputeError::Input`] for ratios that drive some modes.
pub(crate) fn damping(case: &Case) -> Result<ModalDamping, ComputeError> {
    let damping = match &case.damping {
        None => ModalDamping::Uniform(0.0),
        Some(case::Damping::Modal(ratio)) => ModalDamping::Uniform(*ratio),
        Some(case::Damping::Rayleigh { alpha, beta }) => ModalDamping::Rayleigh { alpha: *alpha, beta: *beta },
        Some(case::Damping::Ratios([first, second])) => {
            ModalDamping::rayleigh_through((first.frequency_hz, first.ratio), (second.frequency_hz, second.ratio))
        }
    };
    match damping {
        ModalDamping::Rayleigh { alpha, beta } if alpha < 0.0 || beta < 0.0 => Err(ComputeError::wrong(format!(
            "damping: these values mean alpha = {alpha:.4e} 1/s and beta = {beta:.4e} s; a negative coefficient drives some modes: bring the two ratios closer together, or use damping.modal"
        ))),
        admissible => Ok(admissible),
    }
}

/// Time integration has no structural damping; a loss factor of a part in use must not be passed over.
///
/// # Errors
/// [`ComputeError::Input`].
pub(crate) fn refuse_structural_damping(case: &Case) -> Result<(), ComputeError> {
    match case.lossy_part() {
        None => Ok(()),
        Some((material, loss_factor)) => Err(ComputeError::wrong(format!(
            "materials.{material}: loss_factor = {loss_factor} is structural damping, which has a meaning for harmonic motion alone (frf); a run steps through time: leave the key out and give [damping]"
        ))),
    }
}

/// Alpha of a case's `C = alpha M + beta K`, 1/s; zero for damping mode by mode.
///
/// # Errors
/// As [`damping`].
pub(crate) fn mass_damping(case: &Case) -> Result<f64, ComputeError> {
    Ok(match damping(case)? {
        ModalDamping::Rayleigh { alpha, .. } => alpha,
        _ => 0.0,
    })
}

/// Viscous damping matrix [n x n] of matrices k and m with the case's damping, N s/m.
///
/// # Errors
/// As [`damping`], and what the dense eigenvalue solver reports.
pub(crate) fn viscous_matrix(case: &Case, k: &DenseMatrix, m: &DenseMatrix) -> Result<DenseMatrix, ComputeError> {
    Ok(match damping(case)? {
        ModalDamping::Rayleigh { alpha, beta } => m * faer::Scale(alpha) + k * faer::Scale(beta),
        ModalDamping::Uniform(ratio) if ratio <= 0.0 => DenseMatrix::zeros(k.nrows(), k.ncols()),
        ratios => {
            let system = ReducedSystem::new(k.clone(), m.clone())?;
            ModalBasis::new(&system)?.viscous_matrix(&system, &ratios)?
        }
    })
}
