//! How the structure moves under the balls.

use crate::numerics::linalg::DenseMatrix;
use crate::system::{BearingSetup, Structure};

/// Rows of the race's displacement at the balls, as columns [dof x 2 balls]: radial, then
/// tangential at the raceway, for each ball.
pub(in crate::system) fn contact_rows(
    structure: &Structure,
    setup: &BearingSetup,
    angles: &[f64],
) -> DenseMatrix {
    let ring = structure.ring();
    let arm = setup.raceway_arm(ring.section().radius);
    let mut columns = DenseMatrix::zeros(structure.dof(), 2 * angles.len());
    for (j, &angle) in angles.iter().enumerate() {
        let rows = ring.rows_at(angle);
        let tangential = rows.tangential_at(arm);
        for k in 0..6 {
            columns[(rows.dofs[k], 2 * j)] += rows.radial[k];
            columns[(rows.dofs[k], 2 * j + 1)] += tangential[k];
        }
    }
    columns
}
