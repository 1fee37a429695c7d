//! The lowest eigenpairs of a sparse symmetric problem, with a residual for each.

use super::complete::{BEYOND, basis_size, complete_pairs};
use super::{
    DenseMatrix, LinalgError, SparseCholesky, SparseMatrix, sparse_times_dense,
    symmetric_generalised_eigen,
};

/// Largest order that is solved densely: below it the dense solver is faster and needs no shift.
const DENSE_LIMIT: usize = 60;

/// Largest relative residual of a mode. Those of rigid modes are a ratio of round-off to the shift's
/// term; a frequency's relative error is below the square of it.
const LARGEST_RESIDUAL: f64 = 1e-5;

/// How to find the lowest modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EigenOptions {
    /// Number of eigenpairs, at least 1.
    pub count: usize,
    /// Shift sigma in 1/s^2; `K - sigma M` must be positive definite: zero for a supported
    /// structure, negative for a free one.
    pub shift: f64,
}

/// The lowest eigenpairs of `K x = lambda M x`.
#[derive(Debug, Clone)]
pub struct EigenPairs {
    /// Eigenvalues lambda = (2 pi f)^2, 1/s^2, ascending, length count.
    pub values: Vec<f64>,
    /// Eigenvectors [n x count], `x^T M x = 1`.
    pub vectors: DenseMatrix,
    /// `||K x - lambda M x|| / (||K x|| + |lambda - sigma| ||M x||)` of every pair.
    pub residuals: Vec<f64>,
}

/// The `options.count` eigenpairs of `K x = lambda M x` nearest above the shift.
///
/// `factor` is the factorisation of `K - sigma M`: whoever made it for something else shares it.
///
/// # Errors
/// [`LinalgError::TooManyModes`] if count exceeds the order; [`LinalgError::Residual`] for a mode that
/// does not satisfy its equation; what ARPACK reports.
pub fn lowest_eigenpairs(
    k: &SparseMatrix,
    m: &SparseMatrix,
    factor: &SparseCholesky,
    options: EigenOptions,
) -> Result<EigenPairs, LinalgError> {
    let order = k.rows();
    let EigenOptions { count, shift } = options;
    if count == 0 || count > order {
        return Err(LinalgError::TooManyModes {
            asked: count,
            available: order,
        });
    }
    let asked = count + BEYOND;
    let (values, vectors) = if order <= DENSE_LIMIT || basis_size(asked) > order {
        dense_pairs(k, m, count)?
    } else {
        complete_pairs(
            k,
            m,
            factor,
            EigenOptions {
                count: asked,
                shift,
            },
        )?
        .lowest(count)
    };
    let residuals = residuals(k, m, &values, &vectors, shift);
    let too_large = |residual: &f64| residual.is_nan() || *residual > LARGEST_RESIDUAL;
    let bad = residuals.iter().position(too_large);
    if let Some(mode) = bad {
        return Err(LinalgError::Residual {
            mode,
            residual: residuals[mode],
            limit: LARGEST_RESIDUAL,
        });
    }
    Ok(EigenPairs {
        values,
        vectors,
        residuals,
    })
}

fn dense_pairs(
    k: &SparseMatrix,
    m: &SparseMatrix,
    count: usize,
) -> Result<(Vec<f64>, DenseMatrix), LinalgError> {
    let identity = DenseMatrix::identity(k.rows(), k.rows());
    let spectrum = symmetric_generalised_eigen(
        &sparse_times_dense(k, &identity),
        &sparse_times_dense(m, &identity),
    )?;
    Ok((
        spectrum.values[..count].to_vec(),
        spectrum.vectors.subcols(0, count).to_owned(),
    ))
}

fn residuals(
    k: &SparseMatrix,
    m: &SparseMatrix,
    values: &[f64],
    vectors: &DenseMatrix,
    shift: f64,
) -> Vec<f64> {
    let (kx, mx) = (
        sparse_times_dense(k, vectors),
        sparse_times_dense(m, vectors),
    );
    (0..values.len())
        .map(|mode| {
            let difference = kx.col(mode) - mx.col(mode) * faer::Scale(values[mode]);
            let scale =
                kx.col(mode).norm_l2() + (values[mode] - shift).abs() * mx.col(mode).norm_l2();
            difference.norm_l2() / scale
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::TripletBuilder;
    use super::*;

    /// Chain of unit masses and unit springs fixed at both ends:
    /// lambda_j = 2 - 2 cos(j pi / (n + 1)).
    fn chain(order: usize) -> (SparseMatrix, SparseMatrix) {
        let mut k = TripletBuilder::new(order, order);
        let mut m = TripletBuilder::new(order, order);
        for row in 0..order {
            k.add(row, row, 2.0);
            m.add(row, row, 1.0);
            if row + 1 < order {
                k.add(row, row + 1, -1.0);
                k.add(row + 1, row, -1.0);
            }
        }
        (k.build(), m.build())
    }

    fn lowest(order: usize, count: usize) -> Result<EigenPairs, LinalgError> {
        let (k, m) = chain(order);
        let factor = SparseCholesky::new(&k)?;
        lowest_eigenpairs(&k, &m, &factor, EigenOptions { count, shift: 0.0 })
    }

    #[test]
    fn arpack_and_the_dense_solver_find_the_chain() {
        for (order, count) in [(30, 8), (200, 8)] {
            let pairs = lowest(order, count).expect("converges");
            for (index, value) in pairs.values.iter().enumerate() {
                let angle = (index + 1) as f64 * std::f64::consts::PI / (order + 1) as f64;
                let exact = 4.0 * (0.5 * angle).sin().powi(2);
                // eigenvalues converge with the square of the tolerance 1e-10: round-off is left
                assert!(
                    (value / exact - 1.0).abs() < 1e-11,
                    "{order} {index} {value} {exact}"
                );
                assert!(pairs.residuals[index] < 1e-9);
            }
        }
    }

    /// Six equal chains beside each other: every eigenvalue six times, of which one vector sees one.
    #[test]
    fn repeated_eigenvalues_are_found_as_often_as_they_occur() {
        let (copies, length) = (6, 60);
        let (k, m) = chain(length);
        let order = copies * length;
        let beside = |one: &SparseMatrix| {
            let mut all = TripletBuilder::new(order, order);
            for copy in 0..copies {
                for (&value, (row, column)) in one.iter() {
                    all.add(copy * length + row, copy * length + column, value);
                }
            }
            all.build()
        };
        let (k, m) = (beside(&k), beside(&m));
        let factor = SparseCholesky::new(&k).expect("held at both ends");
        for count in [6, 9, 12] {
            let options = EigenOptions { count, shift: 0.0 };
            let pairs = lowest_eigenpairs(&k, &m, &factor, options).expect("converges");
            for (index, value) in pairs.values.iter().enumerate() {
                let angle = (index / copies + 1) as f64 * std::f64::consts::PI / 61.0;
                let exact = 4.0 * (0.5 * angle).sin().powi(2);
                assert!(
                    (value / exact - 1.0).abs() < 1e-11,
                    "{count} {index} {value}"
                );
            }
            let mass = sparse_times_dense(&m, &pairs.vectors);
            let gram = pairs.vectors.transpose() * mass - DenseMatrix::identity(count, count);
            assert!(gram.norm_max() < 1e-8, "{:e}", gram.norm_max());
        }
    }

    #[test]
    fn a_run_repeats_to_the_bit() {
        let (first, second) = (lowest(150, 5), lowest(150, 5));
        assert_eq!(
            first.expect("converges").values,
            second.expect("converges").values
        );
    }

    #[test]
    fn more_modes_than_degrees_of_freedom_is_an_error() {
        assert_eq!(
            lowest(5, 6).err(),
            Some(LinalgError::TooManyModes {
                asked: 6,
                available: 5
            })
        );
    }
}
