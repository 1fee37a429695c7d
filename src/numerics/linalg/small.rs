//! Small problems: all eigenpairs by the dense solver.

use super::count::CountCheck;
use super::lowest::Ritz;
use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError, symmetric_generalised_eigen};

/// Gap in which it is counted, relative to the distance from the shift: equal values of one motion differ by round-off.
const SMALLEST_GAP: f64 = 1e-5;

/// The `count` lowest of all eigenpairs, counted in the first gap behind them; `shift` is below all eigenvalues.
///
/// # Errors
/// [`LinalgError::TooManyModes`] if fewer have mass; what the dense solver reports.
pub(super) fn all_pairs(
    k: &SymmetricMatrix,
    m: &SymmetricMatrix,
    count: usize,
    shift: f64,
) -> Result<(Ritz, CountCheck), LinalgError> {
    let spectrum = symmetric_generalised_eigen(&dense(k), &dense(m))?;
    let available = spectrum.values.iter().take_while(|value| value.is_finite()).count();
    if count > available {
        return Err(LinalgError::TooManyModes { asked: count, available });
    }
    let values = spectrum.values[..available].to_vec();
    let gap = |place: &usize| values[*place] - values[place - 1] > SMALLEST_GAP * (values[*place] - shift);
    let counted = (count..available).find(gap).unwrap_or(available);
    let below = match values.get(counted) {
        Some(next) => 0.5 * (values[counted - 1] + next),
        None => 2.0 * values[counted - 1].abs(),
    };
    let check = CountCheck { above: None, below, counted, found: counted };
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
