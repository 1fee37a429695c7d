//! Angles between the spaces that two groups of shapes span.

use crate::numerics::linalg::DenseMatrix;
use nalgebra::DMatrix;

/// Singular values below this part of the largest count as zero: shapes that the points cannot tell apart.
const RANK: f64 = 1e-8;

/// `|a . b|^2 / (a . a)(b . b)`, 0 to 1; 0 if one of them does not move.
///
/// Source: Allemang and Brown (1982).
pub(super) fn mac(a: &[f64], b: &[f64]) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    // each by its own length, so that shapes of 1e200 or 1e-200 do not overflow
    let unit = |x: &[f64]| -> Option<Vec<f64>> {
        let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let scaled: Vec<f64> = x.iter().map(|v| v / largest).collect();
        let length = dot(&scaled, &scaled).sqrt();
        (largest > 0.0).then(|| scaled.iter().map(|v| v / length).collect())
    };
    match (unit(a), unit(b)) {
        (Some(a), Some(b)) => dot(&a, &b).powi(2).min(1.0),
        _ => 0.0,
    }
}

/// An orthonormal basis of the span of some columns [rows x rank].
pub(super) fn basis(shapes: &DenseMatrix, columns: &[usize]) -> DMatrix<f64> {
    let mut a = DMatrix::from_fn(shapes.nrows(), columns.len(), |row, k| shapes[(row, columns[k])]);
    for mut column in a.column_iter_mut() {
        let largest = column.amax();
        if largest > 0.0 {
            column /= largest;
        }
    }
    let svd = a.svd(true, false);
    let largest = svd.singular_values.iter().fold(0.0_f64, |m, s| m.max(*s));
    let keep = |k: &usize| svd.singular_values[*k] > RANK * largest;
    let kept: Vec<usize> = (0..svd.singular_values.len()).filter(keep).collect();
    match svd.u {
        Some(u) => u.select_columns(&kept),
        None => DMatrix::zeros(shapes.nrows(), 0),
    }
}

/// Squared cosines of the principal angles between two spaces given by orthonormal bases, descending; as many as
/// the smaller one has dimensions. Empty if one has none.
///
/// They are the squared singular values of `Q_a^T Q_b`. Source: Bjorck and Golub (1973).
pub(super) fn squared_cosines(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Vec<f64> {
    if a.ncols() == 0 || b.ncols() == 0 {
        return Vec::new();
    }
    let values = (a.transpose() * b).singular_values();
    let mut squares: Vec<f64> = values.iter().map(|s| (s * s).min(1.0)).collect();
    squares.sort_by(|x, y| y.total_cmp(x));
    squares
}
