//! Small systems of equations, solved again and again in the same memory.

/// Triangular factors of a dense square matrix with its rows exchanged, `P A = L U` (Golub and Van Loan, Matrix Computations,
/// 4th ed., section 3.4).
///
/// For orders of some tens inside a loop: nothing is allocated once the largest order was there.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SmallLu {
    order: usize,
    /// [order x order] by rows: U, below its diagonal L without its ones.
    factors: Vec<f64>,
    /// Row that was exchanged with each.
    exchanged: Vec<usize>,
}

impl SmallLu {
    /// Gives a matrix of zeros [order x order], by rows, to be filled; then [`Self::factorise`].
    pub(crate) fn fill(&mut self, order: usize) -> &mut [f64] {
        self.order = order;
        self.factors.clear();
        self.factors.resize(order * order, 0.0);
        &mut self.factors
    }

    /// Factorises what was filled in. Gives whether it could: not if a pivot is zero or not a number.
    #[must_use]
    pub(crate) fn factorise(&mut self) -> bool {
        let n = self.order;
        self.exchanged.clear();
        for k in 0..n {
            let size = |row: usize| self.factors[row * n + k].abs();
            let pivot = (k..n).fold(k, |best, row| if size(row) > size(best) { row } else { best });
            // neither zero nor what is not a number
            let is_pivot = size(pivot) > 0.0 && size(pivot).is_finite();
            if !is_pivot {
                return false;
            }
            self.exchanged.push(pivot);
            let (above, below) = self.factors.split_at_mut((k + 1) * n);
            let row = &mut above[k * n..];
            if pivot > k {
                row.swap_with_slice(&mut below[(pivot - k - 1) * n..(pivot - k) * n]);
            }
            for other in below.chunks_exact_mut(n) {
                let factor = other[k] / row[k];
                other[k] = factor;
                if factor != 0.0 {
                    for (other, value) in other[k + 1..].iter_mut().zip(&row[k + 1..]) {
                        *other -= factor * value;
                    }
                }
            }
        }
        true
    }

    /// Overwrites `b` \[order\] by `A^-1 b`, after [`Self::factorise`].
    pub(crate) fn solve_in_place(&self, b: &mut [f64]) {
        let n = self.order;
        for (k, &pivot) in self.exchanged.iter().enumerate() {
            b.swap(k, pivot);
        }
        for k in 0..n {
            let row = &self.factors[k * n..k * n + k];
            let known: f64 = row.iter().zip(&*b).map(|(l, x)| l * x).sum();
            b[k] -= known;
        }
        for k in (0..n).rev() {
            let row = &self.factors[k * n + k..(k + 1) * n];
            let known: f64 = row[1..].iter().zip(&b[k + 1..]).map(|(u, x)| u * x).sum();
            b[k] = (b[k] - known) / row[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_exchanged_where_a_pivot_is_zero() {
        let a = [[0.0, 2.0, 1.0], [1.0, -1.0, 0.5], [3.0, 0.0, -2.0]];
        let x = [1.0, -2.0, 4.0];
        let mut lu = SmallLu::default();
        // the second time in memory that was used
        for _ in 0..2 {
            lu.fill(3).copy_from_slice(a.as_flattened());
            assert!(lu.factorise());
            let mut b = a.map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum::<f64>());
            lu.solve_in_place(&mut b);
            for (found, expected) in b.iter().zip(&x) {
                // some round-offs of numbers near 10
                assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_and_what_is_not_a_number_are_refused() {
        let mut lu = SmallLu::default();
        lu.fill(2).copy_from_slice(&[1.0, 2.0, 2.0, 4.0]);
        assert!(!lu.factorise());
        lu.fill(2).copy_from_slice(&[f64::NAN, 2.0, 2.0, 4.0]);
        assert!(!lu.factorise());
    }
}
