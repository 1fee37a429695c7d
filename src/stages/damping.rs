//! Damping of housing and ring as the case gives it.

use super::StageError;
use crate::case::{self, Case};
use crate::system::ModeDamping;

/// The damping of a case; none without `[damping]`.
///
/// # Errors
/// [`StageError::NegativeDamping`] for ratios that drive some modes.
pub(super) fn damping(case: &Case) -> Result<ModeDamping, StageError> {
    let damping = match &case.damping {
        None => ModeDamping::Modal(0.0),
        Some(case::Damping::Modal(ratio)) => ModeDamping::Modal(*ratio),
        Some(case::Damping::Rayleigh { alpha, beta }) => ModeDamping::Rayleigh {
            alpha: *alpha,
            beta: *beta,
        },
        Some(case::Damping::Ratios([first, second])) => ModeDamping::rayleigh_through(
            (first.frequency_hz, first.ratio),
            (second.frequency_hz, second.ratio),
        ),
    };
    match damping {
        ModeDamping::Rayleigh { alpha, beta } if alpha < 0.0 || beta < 0.0 => {
            Err(StageError::NegativeDamping { alpha, beta })
        }
        admissible => Ok(admissible),
    }
}
