//! Small problems: all eigenpairs by the dense solver.

use super::count::CountCheck;
use super::lowest::Ritz;
use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError, symmetric_generalised_eigen};

/// The `count` lowest of all eigenpairs.
///
/// # Errors
/// [`LinalgError::TooManyModes`] if fewer have mass; what the dense solver reports.
pub(super) fn all_pairs(
    k: &SymmetricMatrix,
    m: &SymmetricMatrix,
    count: usize,
) -> Result<(Ritz, CountCheck), LinalgError> {
    let spectrum = symmetric_generalised_eigen(&dense(k), &dense(m))?;
    let available = spectrum
        .values
        .iter()
        .take_while(|value| value.is_finite())
        .count();
    if count > available {
        return Err(LinalgError::TooManyModes {
            asked: count,
            available,
        });
    }
    let values = spectrum.values[..available].to_vec();
    let below = match values.get(count) {
        Some(next) => 0.5 * (values[count - 1] + next),
        None => 2.0 * values[count - 1].abs(),
    };
    let counted = values.iter().filter(|value| **value < below).count();
    let check = CountCheck {
        above: None,
        below,
        counted,
        found: counted,
    };
    let vectors = spectrum.vectors.subcols(0, available).to_owned();
    Ok((Ritz { values, vectors }, check))
}

/// Both triangles of a matrix, zeros and all.
fn dense(a: &SymmetricMatrix) -> DenseMatrix {
    let mut full = DenseMatrix::zeros(a.order(), a.order());
    for column in 0..a.order() {
        for (row, value) in a.column(column) {
            full[(row, column)] = value;
            full[(column, row)] = value;
        }
    }
    full
}
