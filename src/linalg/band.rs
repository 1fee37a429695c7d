//! Eigenpairs in a band by shift-invert Lanczos (ARPACK) from its middle.

use super::arpack::{Request, shift_invert};
use super::factor::Factor;
use super::lowest::Ritz;
use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError};

/// Restarts after which the iteration gives up; modal problems need two to ten.
const MAX_RESTARTS: usize = 300;

/// Relative tolerance of the Ritz values. Eigenvalues converge with its square, and the residuals are verified
/// afterwards; tolerance zero costs 2.7 times the solves for nothing.
const TOLERANCE: f64 = 1e-10;

/// How often missing pairs are looked for.
const ROUNDS: usize = 6;

/// Size of the Lanczos basis for so many pairs.
pub(super) fn largest_basis(count: usize) -> usize {
    (2 * count + 1).max(20)
}

/// The `count` pairs that lie between `low` and `high`, by counts at both ends. A single-vector iteration sees one
/// vector of a repeated eigenvalue and meets the others through round-off, late or never; those that are missing are
/// looked for with the known ones taken out.
///
/// # Errors
/// [`LinalgError::MissingModes`], or what ARPACK reports.
pub(super) fn between(
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
    (sigma, factor): &(f64, Factor),
    [low, high]: [f64; 2],
    count: usize,
) -> Result<Ritz, LinalgError> {
    let order = stiffness.order();
    let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
    for _ in 0..ROUNDS {
        let missing = count - found.len();
        let request = Request {
            order,
            count: missing,
            basis: largest_basis(missing).min(order),
            shift: *sigma,
            tolerance: TOLERANCE,
            max_restarts: MAX_RESTARTS,
        };
        let pairs = shift_invert(
            request,
            |b, y| {
                let mut column = DenseMatrix::from_fn(order, 1, |row, _| b[row]);
                factor.solve(column.as_mut());
                y.copy_from_slice(column.col_as_slice(0));
                remove(&found, mass, y);
                Ok(())
            },
            |x, y| product(mass, x, y),
        )?;
        let vectors = pairs.vectors.chunks_exact(order).map(<[f64]>::to_vec);
        let inside = pairs.values.into_iter().zip(vectors);
        let before = found.len();
        found.extend(inside.filter(|(value, _)| *value > low && *value < high));
        if found.len() == count {
            break;
        }
        if found.len() == before {
            return Err(LinalgError::MissingModes {
                below_hz: high.max(0.0).sqrt() / std::f64::consts::TAU,
                counted: count,
                found: before,
            });
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    if found.len() != count {
        return Err(LinalgError::MissingModes {
            below_hz: high.max(0.0).sqrt() / std::f64::consts::TAU,
            counted: count,
            found: found.len(),
        });
    }
    let vectors = DenseMatrix::from_fn(order, count, |row, mode| found[mode].1[row]);
    Ok(Ritz {
        values: found.into_iter().map(|pair| pair.0).collect(),
        vectors,
    })
}

/// Takes from `y` what lies along the known vectors, in the product of the mass.
fn remove(found: &[(f64, Vec<f64>)], mass: &SymmetricMatrix, y: &mut [f64]) {
    if found.is_empty() {
        return;
    }
    let mut heavy = vec![0.0; y.len()];
    product(mass, y, &mut heavy);
    for (_, vector) in found {
        let along: f64 = vector.iter().zip(&heavy).map(|(a, b)| a * b).sum();
        for (entry, component) in y.iter_mut().zip(vector) {
            *entry -= along * component;
        }
    }
}

fn product(a: &SymmetricMatrix, x: &[f64], y: &mut [f64]) {
    let x = faer::MatRef::from_column_major_slice(x, x.len(), 1);
    y.copy_from_slice(a.times(x).col_as_slice(0));
}
