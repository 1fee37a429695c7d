//! Modes of a housing without ring, free or supported.

use super::{ModalBasis, ModeRange};
use crate::fe::assembly::SystemMatrices;
use crate::numerics::linalg::{EigenProblem, LinalgError};

/// The `count` lowest modes over the free degrees of freedom. Whether the housing is held need not be said.
///
/// # Errors
/// [`LinalgError`] of factorisation, iteration or proof.
pub fn housing_modes(
    matrices: &SystemMatrices,
    free_dofs: &[usize],
    count: usize,
) -> Result<ModalBasis, LinalgError> {
    let problem = EigenProblem::restricted(&matrices.stiffness, &matrices.mass, free_dofs)?;
    ModalBasis::of(&problem, ModeRange::Count(count))
}
