//! What the modes left out give under the balls, as a few vectors more in the basis.
//!
//! The residual flexibility `G = L' (K^-1 - sum phi phi' / w^2) L` over unit forces L on the grooves, radial and axial at every node and
//! between two, has few large eigenvalues: forces that bend a ring in long waves. Their static responses join the modes kept (Craig 1981,
//! Structural Dynamics, section 11.3: residual attachment modes), so that a raceway gives way as with all modes up to a tolerance.

use super::setup::SpatialSetup;
use crate::numerics::linalg::{DenseMatrix, symmetric_eigen};
use crate::system::{Structure, StructureModes, SystemError};
use std::f64::consts::TAU;

/// What may be missing of a raceway's own flexibility, relative, times the square of the number of modes kept: 1 % with 20 modes. A
/// comparison with more modes then shows what the vectors lack too. A sound bearing needs many: its signal is what the flexibility changes by
/// from place to place.
const MISSING: f64 = 4.0;

/// The lowest `kept` modes and the static vectors that the raceways of a setup need besides, with the number of these.
///
/// # Errors
/// [`SystemError::Refused`] for a structure that is not held or rings in their plane; what the eigenvalue computation reports.
pub(crate) fn with_static_vectors(
    structure: &Structure,
    modes: &StructureModes,
    kept: usize,
    setup: &SpatialSetup,
) -> Result<(StructureModes, usize), SystemError> {
    let loads = unit_forces(structure, setup)?;
    let shapes = modes.shapes.subcols(0, kept);
    let response = structure.static_response(&loads)?;
    let parts = shapes.transpose() * &loads;
    let amplitudes =
        DenseMatrix::from_fn(kept, loads.ncols(), |mode, load| parts[(mode, load)] / modes.squared_frequencies[mode]);
    let whole = loads.transpose() * &response;
    let lacking = &whole - parts.transpose() * amplitudes;
    let n = loads.ncols();
    let spectrum = symmetric_eigen(&DenseMatrix::from_fn(n, n, |i, j| 0.5 * (lacking[(i, j)] + lacking[(j, i)])))?;
    // from the softest on, until no place lacks more than it may
    let softest: Vec<usize> = (0..n).rev().collect();
    let mut left: Vec<f64> = (0..n).map(|place| lacking[(place, place)]).collect();
    let mut count = 0;
    let missing = MISSING / (kept * kept) as f64;
    while count < n && (0..n).any(|place| left[place] > missing * whole[(place, place)]) {
        let (value, vector) = (spectrum.values[softest[count]], spectrum.vectors.col(softest[count]));
        for (left, entry) in left.iter_mut().zip(vector.iter()) {
            *left -= value * entry * entry;
        }
        count += 1;
    }
    let lowest = modes.lowest(kept);
    if count == 0 {
        return Ok((lowest, 0));
    }
    let chosen = DenseMatrix::from_fn(n, count, |row, vector| spectrum.vectors[(row, softest[vector])]);
    let basis = lowest.with_static_response(structure, f64::INFINITY, &(loads * chosen))?;
    Ok((basis, count))
}

/// Radial and axial unit forces on the grooves of all outer rings [dof x forces].
fn unit_forces(structure: &Structure, setup: &SpatialSetup) -> Result<DenseMatrix, SystemError> {
    let seats = structure.rings().seats();
    let places = seats.iter().map(|seat| 2 * seat.ring.nodes());
    let mut loads = DenseMatrix::zeros(structure.dof(), 2 * places.sum::<usize>());
    let mut column = 0;
    for (seat, own) in seats.iter().zip(&setup.bearings) {
        let arm = own.bearing.law().grooves.outer_centres - seat.ring.section().radius;
        let count = 2 * seat.ring.nodes();
        for place in 0..count {
            let rows = seat.ring.space_rows_at(TAU * place as f64 / count as f64);
            let Some(rows) = rows else {
                return Err(SystemError::Refused("a bearing in space needs a ring in space"));
            };
            let [radial, _, axial] = rows.displacement_at(arm, 0.0);
            for row in [radial, axial] {
                for (dof, value) in rows.dofs.into_iter().zip(row) {
                    loads[(seat.first + dof, column)] += value;
                }
                column += 1;
            }
        }
    }
    Ok(loads)
}
