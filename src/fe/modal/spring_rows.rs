//! Springs on several displacements as single springs, each on one combination of them.

use nalgebra::DMatrix;

/// Part of its own stiffness that a component of a spring must have left beside those before, to be a spring of its own.
const OWN_STIFFNESS: f64 = 1e-12;

/// A single spring: energy `stiffness (factors . u)^2 / 2`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpringRow {
    /// N/m, > 0.
    pub stiffness: f64,
    /// Factors of the displacements; the largest is 1.
    pub factors: Vec<f64>,
}

/// Single springs whose sum is a positive semidefinite S [n x n].
///
/// Cholesky's factor with the component that has most of its own stiffness left as the next pivot: a soft spring
/// across a stiff one is found however soft it is. Source: Higham, Accuracy and Stability of Numerical Algorithms
/// (2002), section 10.3.
pub(super) fn spring_rows(stiffness: &DMatrix<f64>) -> Vec<SpringRow> {
    let mut left = stiffness.clone();
    let n = left.nrows().min(left.ncols());
    let share = |left: &DMatrix<f64>, i: usize| {
        let own = stiffness[(i, i)];
        if own > 0.0 { left[(i, i)] / own } else { 0.0 }
    };
    let mut rows = Vec::new();
    for _ in 0..n {
        let best = (0..n).max_by(|&i, &j| share(&left, i).total_cmp(&share(&left, j)));
        let Some(pivot) = best.filter(|&pivot| share(&left, pivot) > OWN_STIFFNESS) else {
            break;
        };
        let own = left[(pivot, pivot)];
        let row: Vec<f64> = (0..n).map(|j| left[(pivot, j)]).collect();
        for i in 0..n {
            for j in 0..n {
                left[(i, j)] -= row[i] * row[j] / own;
            }
        }
        let largest = row.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        rows.push(SpringRow {
            stiffness: largest * (largest / own),
            factors: row.into_iter().map(|x| x / largest).collect(),
        });
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::spring_rows;
    use nalgebra::DMatrix;

    #[test]
    fn a_soft_spring_beside_a_stiff_one_is_found() {
        let k = DMatrix::from_diagonal(&nalgebra::dvector![1e9, 0.0, 1e-6]);
        let rows = spring_rows(&k);
        assert_eq!(rows.len(), 2);
        // a spring along (1, 1): one row, whatever the rounding
        let k = DMatrix::from_element(2, 2, 0.1 + 0.2);
        let rows = spring_rows(&k);
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].factors, [1.0, 1.0]);
        assert!(spring_rows(&DMatrix::zeros(3, 3)).is_empty());
    }

    #[test]
    fn single_springs_add_up_to_the_whole() {
        let shape = DMatrix::from_fn(5, 3, |i, j| {
            // the last component, which is taken first, has least of it
            ((i + 1) as f64 * (j + 2) as f64).sin() / (1.0 + i as f64).powi(2)
        });
        let k = 1e8 * &shape * shape.transpose();
        let rows = spring_rows(&k);
        assert_eq!(rows.len(), 3);
        let sum = DMatrix::from_fn(5, 5, |i, j| {
            rows.iter().map(|row| row.stiffness * row.factors[i] * row.factors[j]).sum::<f64>()
        });
        // round-off of three subtractions
        assert!((sum - &k).amax() < 1e-14 * k.amax());
    }
}
