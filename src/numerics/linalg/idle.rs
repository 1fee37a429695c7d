//! Eigenproblems of two semidefinite matrices that share motions without stiffness and mass: a ring with more nodes than
//! the bore that follows it has motions that move nothing of the housing.

use super::{DenseMatrix, LinalgError, SymmetricSpectrum, symmetric_eigen, symmetric_generalised_eigen};

/// Eigenvalues of `k + s m` and singular values of `k`, scaled to a unit diagonal, up to which a motion is idle. Round-off
/// of a condensed stiffness is 1e-13 to 1e-12 of its diagonal.
const IDLE: f64 = 1e-11;

/// A basis [n x r] of the motions that `k` or `m` [n x n] act on, orthonormal in coordinates that are scaled to a unit
/// diagonal of `|k| + s |m|`; `None` if that is all motions. Negative eigenvalues beyond round-off count as acting, also
/// where stiffness and mass cancel.
///
/// # Errors
/// [`LinalgError::DenseEigen`] for values that are not finite.
pub(crate) fn acting_motions(k: &DenseMatrix, m: &DenseMatrix) -> Result<Option<DenseMatrix>, LinalgError> {
    let order = k.nrows();
    let shift = balance(k, m);
    let scale: Vec<f64> = (0..order)
        .map(|row| match k[(row, row)].abs() + shift * m[(row, row)].abs() {
            diagonal if diagonal > 0.0 => diagonal.sqrt().recip(),
            _ => 1.0,
        })
        .collect();
    let scaled = |a: &DenseMatrix| {
        DenseMatrix::from_fn(order, order, |row, column| {
            0.5 * scale[row] * (a[(row, column)] + a[(column, row)]) * scale[column]
        })
    };
    let spectrum = symmetric_eigen(&scaled(&(k + m * faer::Scale(shift))))?;
    let (acting, silent): (Vec<usize>, Vec<usize>) = (0..order).partition(|&place| spectrum.values[place].abs() > IDLE);
    let columns = |places: &[usize]| {
        DenseMatrix::from_fn(order, places.len(), |row, column| spectrum.vectors[(row, places[column])])
    };
    let (acting, silent) = (columns(&acting), columns(&silent));
    let cancelling = cancelling(&scaled(k), &silent)?;
    let first = acting.ncols();
    if first + cancelling.ncols() == order {
        return Ok(None);
    }
    Ok(Some(DenseMatrix::from_fn(order, first + cancelling.ncols(), |row, column| {
        scale[row]
            * match column.checked_sub(first) {
                None => acting[(row, column)],
                Some(further) => cancelling[(row, further)],
            }
    })))
}

/// Of motions that `k + s m` does not act on [n x c] those that `k` acts on: there the two cancel.
fn cancelling(k: &DenseMatrix, silent: &DenseMatrix) -> Result<DenseMatrix, LinalgError> {
    if silent.ncols() == 0 {
        return Ok(silent.clone());
    }
    let failed = |_| LinalgError::DenseEigen { order: k.nrows() };
    let of_k = (k * silent).thin_svd().map_err(failed)?;
    let values = of_k.S().column_vector().iter();
    let count = values.filter(|value| **value > IDLE).count();
    // singular values descend
    Ok(silent * of_k.V().subcols(0, count))
}

/// [`symmetric_generalised_eigen`] for `k` and `m` that may both be singular in the same directions: there are as many
/// eigenpairs as motions that one of them acts on.
///
/// # Errors
/// As [`symmetric_generalised_eigen`].
pub(crate) fn acting_generalised_eigen(k: &DenseMatrix, m: &DenseMatrix) -> Result<SymmetricSpectrum, LinalgError> {
    let Some(basis) = acting_motions(k, m)? else {
        return symmetric_generalised_eigen(k, m);
    };
    let of_basis = symmetric_generalised_eigen(&congruent(k, &basis), &congruent(m, &basis))?;
    Ok(SymmetricSpectrum { vectors: &basis * of_basis.vectors, values: of_basis.values })
}

/// `B^T A B`, exactly symmetric.
pub(crate) fn congruent(a: &DenseMatrix, basis: &DenseMatrix) -> DenseMatrix {
    let product = basis.transpose() * (a * basis);
    DenseMatrix::from_fn(product.nrows(), product.ncols(), |row, column| {
        0.5 * (product[(row, column)] + product[(column, row)])
    })
}

/// Factor of the mass that makes it as large as the stiffness: the geometric mean of the diagonals' ratios.
fn balance(k: &DenseMatrix, m: &DenseMatrix) -> f64 {
    let logarithms =
        (0..k.nrows()).map(|i| (k[(i, i)] / m[(i, i)]).abs().ln()).filter(|logarithm| logarithm.is_finite());
    let (count, sum) = logarithms.fold((0_u32, 0.0), |(n, sum), value| (n + 1, sum + value));
    match count {
        0 => 1.0,
        count => (sum / f64::from(count)).exp(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of two masses on a spring to the ground, seen through three coordinates of which two move the same mass.
    fn seen(t: &DenseMatrix) -> [DenseMatrix; 2] {
        let k = DenseMatrix::from_fn(2, 2, |i, j| [[3e8, -1e8], [-1e8, 1e8]][i][j]);
        let m = DenseMatrix::from_fn(2, 2, |i, j| [[2.0, 0.0], [0.0, 0.5]][i][j]);
        [t.transpose() * k * t, t.transpose() * m * t]
    }

    #[test]
    fn idle_motions_are_left_out_and_frequencies_stay() {
        let unit = DenseMatrix::identity(2, 2);
        let [k, m] = seen(&unit);
        assert!(acting_motions(&k, &m).unwrap().is_none());
        let expected = symmetric_generalised_eigen(&k, &m).unwrap().values;
        // units of millimetres and radians beside each other
        let t = DenseMatrix::from_fn(2, 3, |i, j| [[1.0, 3e-3, 0.0], [0.0, 0.0, 7e2]][i][j]);
        let [k, m] = seen(&t);
        let basis = acting_motions(&k, &m).unwrap().unwrap();
        assert_eq!((basis.nrows(), basis.ncols()), (3, 2));
        let found = acting_generalised_eigen(&k, &m).unwrap();
        assert_eq!(found.values.len(), 2);
        for (mode, (found, expected)) in found.values.iter().zip(&expected).enumerate() {
            // round-off of a congruence
            assert!((found / expected - 1.0).abs() < 1e-12, "{mode}");
        }
        let moved = &m * &found.vectors;
        let gram = found.vectors.transpose() * moved;
        for (i, j) in [(0, 0), (0, 1), (1, 1)] {
            let unit = f64::from(u8::from(i == j));
            assert!((gram[(i, j)] - unit).abs() < 1e-12, "{i} {j}");
        }
    }
    /// Stiffness and mass of which the sum vanishes are not nothing.
    #[test]
    fn what_cancels_acts() {
        let one = |value: f64| DenseMatrix::from_fn(1, 1, |_, _| value);
        for value in [1.0, -1.0, 1e9] {
            assert!(acting_motions(&one(value), &one(-value)).unwrap().is_none());
        }
        assert_eq!(acting_motions(&one(0.0), &one(0.0)).unwrap().unwrap().ncols(), 0);
        // a pair that pushes and pulls, and beside it a motion of nothing
        let with = |a: [[f64; 2]; 2]| DenseMatrix::from_fn(3, 3, |i, j| if i < 2 && j < 2 { a[i][j] } else { 0.0 });
        let (k, m) = (with([[1.0, 1.0], [1.0, 1.0]]), with([[-1.0, -1.0], [-1.0, 3.0]]));
        let basis = acting_motions(&k, &m).unwrap().unwrap();
        assert_eq!(basis.ncols(), 2);
        assert!((0..2).all(|column| basis[(2, column)].abs() < 1e-15));
    }
}
