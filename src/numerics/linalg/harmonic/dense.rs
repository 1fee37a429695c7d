//! Dense complex systems, solved with a measure of what round-off may change.

use crate::numerics::linalg::dense::{pseudo_random, run_sequentially};
use crate::numerics::linalg::{ComplexMatrix, LinalgError};
use faer::c64;
use faer::prelude::Solve;

/// Solution of a dense complex system.
#[derive(Debug, Clone)]
pub struct ComplexSolution {
    /// x [n x p].
    pub x: ComplexMatrix,
    /// Largest relative error that round-off leaves in a known vector, `|e - Z^-1 (Z e)| / |e|`, in units that make the
    /// diagonal of Z one: about the unit round-off times the condition of Z.
    pub uncertainty: f64,
}

/// Solves `Z X = F`, Z [n x n] complex and regular, F [n x p], by LU with partial pivots and a step of refinement. Rows
/// and columns are scaled to a unit diagonal, so that unknowns of different units do each other no harm.
///
/// # Errors
/// [`LinalgError::Shape`]. A singular matrix is no error: its uncertainty is.
pub(crate) fn complex_solve(z: &ComplexMatrix, f: &ComplexMatrix) -> Result<ComplexSolution, LinalgError> {
    run_sequentially();
    let order = z.nrows();
    for (what, found) in [("columns of Z", z.ncols()), ("loads", f.nrows())] {
        if found != order {
            return Err(LinalgError::Shape { what, expected: order, found });
        }
    }
    let scale: Vec<f64> = (0..order)
        .map(|row| match z[(row, row)].norm() {
            0.0 => 1.0,
            size => size.sqrt().recip(),
        })
        .collect();
    let scaled = ComplexMatrix::from_fn(order, order, |row, column| z[(row, column)] * (scale[row] * scale[column]));
    let known = pseudo_random(order, 1, 0);
    let known = ComplexMatrix::from_fn(order, 1, |row, _| c64::new(known[(row, 0)], 0.0));
    let answer = &scaled * &known;
    let loads = ComplexMatrix::from_fn(order, f.ncols() + 1, |row, column| {
        if column < f.ncols() { f[(row, column)] * scale[row] } else { answer[(row, 0)] }
    });
    let factor = scaled.partial_piv_lu();
    let mut x = factor.solve(&loads);
    let size = known.norm_l2();
    let error = (x.subcols(f.ncols(), 1) - &known).norm_l2();
    x += factor.solve(&loads - &scaled * &x);
    let uncertainty = if size > 0.0 { error / size } else { 0.0 };
    Ok(ComplexSolution {
        x: ComplexMatrix::from_fn(order, f.ncols(), |row, column| x[(row, column)] * scale[row]),
        uncertainty: if uncertainty.is_finite() { uncertainty } else { f64::INFINITY },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of very different units: the solution is right to each row's own round-off.
    #[test]
    fn units_do_no_harm() {
        let units = [1.0, 1e8, 1e-6, 1e3];
        let plain = |i: usize, j: usize| {
            c64::new(1.0 / (1 + i + 2 * j) as f64, 0.1 * (i + j) as f64) + if i == j { 2.0 } else { 0.0 }
        };
        let z = ComplexMatrix::from_fn(4, 4, |i, j| plain(i, j) * (units[i] * units[j]));
        let exact = |row: usize| c64::new(row as f64 + 1.0, -0.5) * (1.0 / units[row]);
        let f = ComplexMatrix::from_fn(4, 1, |row, _| (0..4).map(|j| z[(row, j)] * exact(j)).sum());
        let found = complex_solve(&z, &f).expect("square");
        for (row, unit) in units.iter().enumerate() {
            let error = (found.x[(row, 0)] - exact(row)).norm() * unit;
            // condition below 20
            assert!(error < 1e-13, "{row}: {error:e}");
        }
        assert!(found.uncertainty < 1e-14);
    }

    #[test]
    fn a_singular_matrix_is_uncertain() {
        // exactly singular; with a condition of 1e14 round-off takes most of sixteen digits; regular
        let cases = [(4.0, [1e-3, f64::INFINITY]), (4.0 + 1e-13, [1e-6, 1.0]), (4.01, [0.0, 1e-12])];
        for (corner, limits) in cases {
            let z = ComplexMatrix::from_fn(2, 2, |i, j| c64::new([[1.0, 2.0], [2.0, corner]][i][j], 0.0));
            let found = complex_solve(&z, &ComplexMatrix::zeros(2, 1)).expect("square");
            assert!((limits[0]..=limits[1]).contains(&found.uncertainty), "{:e}", found.uncertainty);
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let error = complex_solve(&ComplexMatrix::zeros(3, 3), &ComplexMatrix::zeros(2, 1));
        let message = error.map(|_| ()).expect_err("shape").to_string();
        assert_eq!(message, "loads: expected 3 rows, found 2");
    }
}
