//! Shift-invert Lanczos with a proof that no mode is missing.

use super::arpack::{Request, shift_invert};
use super::eigen::EigenOptions;
use super::inertia::inertia;
use super::{DenseMatrix, LinalgError, SparseCholesky, SparseMatrix};

/// Restarts after which the iteration gives up; modal problems need two to ten.
const MAX_RESTARTS: usize = 300;

/// Relative tolerance of the Ritz values. Eigenvalues converge with its square, and the residuals
/// are verified afterwards; tolerance zero costs 2.7 times the solves for nothing.
const TOLERANCE: f64 = 1e-10;

/// Pairs asked for beyond those wanted: among them a gap is found in which to count.
pub(super) const BEYOND: usize = 4;

/// How often missing pairs are looked for.
const ROUNDS: usize = 4;

/// Where in a gap eigenvalues are counted, one after the other until no pivot vanishes.
const PLACES: [f64; 4] = [0.5, 0.41, 0.59, 0.32];

/// Pivot of `K - sigma M`, relative to the largest, below which its sign may be round-off and the count is left.
const SMALLEST_PIVOT: f64 = 1e-13;

/// Size of the Lanczos basis for so many pairs.
pub(super) fn basis_size(count: usize) -> usize {
    (2 * count + 1).max(20)
}

/// Eigenpairs in the order in which they were found, vectors column after column.
#[derive(Default)]
pub(super) struct Found {
    order: usize,
    values: Vec<f64>,
    columns: Vec<f64>,
}

impl Found {
    /// The lowest ones, ascending.
    pub fn lowest(self, count: usize) -> (Vec<f64>, DenseMatrix) {
        let ranking = self.ranking();
        let vectors = DenseMatrix::from_fn(self.order, count, |row, column| {
            self.columns[ranking[column] * self.order + row]
        });
        let values = ranking.iter().take(count);
        (values.map(|&place| self.values[place]).collect(), vectors)
    }

    fn ranking(&self) -> Vec<usize> {
        let mut ranking: Vec<usize> = (0..self.values.len()).collect();
        ranking.sort_by(|&a, &b| self.values[a].total_cmp(&self.values[b]));
        ranking
    }

    /// Takes from `y` what lies along the vectors, in the product of `m`.
    fn remove_from(&self, m: &SparseMatrix, y: &mut [f64], scratch: &mut [f64]) {
        if self.values.is_empty() {
            return;
        }
        multiply_into(m, y, scratch);
        for vector in self.columns.chunks_exact(self.order) {
            let along: f64 = vector.iter().zip(&*scratch).map(|(a, b)| a * b).sum();
            for (entry, component) in y.iter_mut().zip(vector) {
                *entry -= along * component;
            }
        }
    }
}

/// Shift-invert Lanczos with a proof: the eigenvalues below a gap near the end of those found are counted by the
/// inertia of `K - sigma M`. A single-vector iteration sees one vector of a repeated eigenvalue and meets the others
/// through round-off, late or never; those that are missing are looked for with the known ones taken out.
pub(super) fn complete_pairs(
    k: &SparseMatrix,
    m: &SparseMatrix,
    factor: &SparseCholesky,
    options: EigenOptions,
) -> Result<Found, LinalgError> {
    let order = k.rows();
    let mut found = Found {
        order,
        ..Found::default()
    };
    let mut missing = options.count;
    for round in 1..=ROUNDS {
        let request = Request {
            order,
            count: missing,
            basis: basis_size(missing),
            shift: options.shift,
            tolerance: TOLERANCE,
            max_restarts: MAX_RESTARTS,
        };
        let mut scratch = vec![0.0; order];
        let pairs = shift_invert(
            request,
            |b, y| {
                y.copy_from_slice(b);
                factor.solve_vector(y)?;
                found.remove_from(m, y, &mut scratch);
                Ok(())
            },
            |x, y| multiply_into(m, x, y),
        )?;
        found.values.extend(pairs.values);
        found.columns.extend(pairs.vectors);
        let Count {
            below_value,
            counted,
            below,
        } = found.count(k, m, options.count)?;
        if counted == below {
            return Ok(found);
        }
        if counted < below || counted > order / 2 || round == ROUNDS {
            return Err(incomplete(below_value, counted, below));
        }
        missing = counted - below;
    }
    Ok(found)
}

/// Eigenvalues below a value: how many there are, and how many were found.
struct Count {
    below_value: f64,
    counted: usize,
    below: usize,
}

fn incomplete(below_value: f64, counted: usize, found: usize) -> LinalgError {
    let below_hz = below_value.max(0.0).sqrt() / std::f64::consts::TAU;
    LinalgError::MissingModes {
        below_hz,
        counted,
        found,
    }
}

impl Found {
    /// Counts below a value in the widest gap among the last [`BEYOND`] of the `count` lowest; the value is moved
    /// when a pivot says that the count there may be round-off.
    fn count(
        &self,
        k: &SparseMatrix,
        m: &SparseMatrix,
        count: usize,
    ) -> Result<Count, LinalgError> {
        let (low, high, below) = self.gap(count);
        let mut failed = LinalgError::Factorisation {
            order: self.order,
            reason: "no shift without a vanishing pivot",
        };
        for place in PLACES {
            let below_value = low + place * (high - low);
            match inertia(&(k + &m.map(|value| -below_value * value))) {
                Ok(found) if found.smallest_pivot > SMALLEST_PIVOT => {
                    let counted = found.negative;
                    return Ok(Count {
                        below_value,
                        counted,
                        below,
                    });
                }
                Ok(_) => {}
                Err(error) => failed = error,
            }
        }
        Err(failed)
    }

    /// The widest gap among the last [`BEYOND`] of the `count` lowest values, and how many values lie below it.
    fn gap(&self, count: usize) -> (f64, f64, usize) {
        let ranking = self.ranking();
        let ascending: Vec<f64> = ranking.iter().map(|&place| self.values[place]).collect();
        let last = count.min(ascending.len()) - 1;
        let first = last - BEYOND.min(last);
        let width = |place: usize| (ascending[place + 1] - ascending[place]) / ascending[place + 1];
        let widest = (first..last).max_by(|&a, &b| width(a).total_cmp(&width(b)));
        widest.map_or(
            (ascending[last], 2.0 * ascending[last], last + 1),
            |place| (ascending[place], ascending[place + 1], place + 1),
        )
    }
}

/// `y = A x` for a symmetric `A`: each entry of `y` is one dot product with a stored column.
fn multiply_into(a: &SparseMatrix, x: &[f64], y: &mut [f64]) {
    for (entry, column) in y.iter_mut().zip(a.outer_iterator()) {
        *entry = column.iter().map(|(row, &value)| value * x[row]).sum();
    }
}
