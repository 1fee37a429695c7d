//! Eigenpairs in a band by shift-invert Lanczos (ARPACK) from its middle.

use super::arpack::shift_invert;
use super::{DenseMatrix, Factor, LinalgError, SymmetricMatrix, SymmetricSpectrum};

/// Searches in a row that may find nothing new in the band.
const IDLE: usize = 2;

/// Size of the Lanczos basis for so many pairs.
pub(super) fn largest_basis(count: usize) -> usize {
    (2 * count + 1).max(20)
}

/// The `count` pairs that lie between `low` and `high`, by counts at both ends. A single-vector iteration sees one
/// vector of a repeated eigenvalue and meets the others through round-off, late or never; those that are missing are
/// looked for with the known ones taken out.
///
/// # Errors
/// [`LinalgError::Iteration`] for missing modes, or what ARPACK reports.
pub(super) fn between(
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
    (sigma, factor): &(f64, Factor),
    [low, high]: [f64; 2],
    count: usize,
) -> Result<SymmetricSpectrum, LinalgError> {
    let order = stiffness.order();
    let inside = |pair: &(f64, Vec<f64>)| pair.0 > low && pair.0 < high;
    let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
    let (mut known, mut idle) = (0, 0);
    while known < count && idle < IDLE {
        let missing = count - known;
        let (values, vectors) = shift_invert(
            [order, missing, largest_basis(missing).min(order)],
            *sigma,
            |b, y| {
                let mut column = DenseMatrix::from_fn(order, 1, |row, _| b[row]);
                factor.solve(column.as_mut());
                y.copy_from_slice(column.col_as_slice(0));
                remove(&found, mass, y);
            },
            |x, y| product(mass, x, y),
        )?;
        let vectors = vectors.chunks_exact(order).map(<[f64]>::to_vec);
        // those outside are taken out as well: from a place beside the middle they are nearer than the far end
        found.extend(values.into_iter().zip(vectors));
        let before = std::mem::replace(&mut known, found.iter().filter(|pair| inside(pair)).count());
        idle = if known > before { 0 } else { idle + 1 };
    }
    if known != count {
        return Err(LinalgError::missing_modes(high, count, known));
    }
    found.retain(inside);
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let vectors = DenseMatrix::from_fn(order, count, |row, mode| found[mode].1[row]);
    Ok(SymmetricSpectrum { values: found.into_iter().map(|pair| pair.0).collect(), vectors })
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
