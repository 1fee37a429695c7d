//! The matrices of a harmonic problem and the product with `Z`.

use super::super::basis::times;
use super::super::{DenseMatrix, HarmonicError, LinalgError, Ordering, SparseMatrix, SymmetricMatrix};

/// Damping of a harmonic problem: `w C + K_s` with `C = alpha M + beta K + C_v + C_m`. All parts add up; the default is none.
#[derive(Debug, Clone, Copy, Default)]
pub struct HarmonicDamping<'a> {
    /// Mass-proportional, 1/s, >= 0.
    pub alpha: f64,
    /// Stiffness-proportional, s, >= 0.
    pub beta: f64,
    /// Viscous matrix `C_v` [n x n], N s/m, symmetric positive semidefinite, both triangles stored.
    pub viscous: Option<&'a SparseMatrix>,
    /// Structural matrix `K_s` [n x n], N/m (sum of loss factor times stiffness), symmetric positive semidefinite, both
    /// triangles stored.
    pub structural: Option<&'a SparseMatrix>,
    /// Damping `C_m` of each motion by itself, as of modes.
    pub motions: Option<MotionDamping<'a>>,
}

/// Damping `M Phi diag(c) Phi^T M` of motions Phi that are orthonormal in the mass.
#[derive(Debug, Clone, Copy)]
pub struct MotionDamping<'a> {
    /// Phi [n x m], `Phi^T M Phi = 1`, over the rows that are kept.
    pub shapes: &'a DenseMatrix,
    /// c \[m\], 1/s, >= 0: `2 zeta w` of a mode.
    pub rates: &'a [f64],
}

/// K, M and damping in the order in which they are factorised.
#[derive(Debug, Clone)]
pub(super) struct HarmonicMatrices {
    pub stiffness: SymmetricMatrix,
    pub mass: SymmetricMatrix,
    alpha: f64,
    beta: f64,
    viscous: Option<SymmetricMatrix>,
    structural: Option<SymmetricMatrix>,
    /// S with `C_m = S S^T` [n x m].
    motions: Option<DenseMatrix>,
}

impl HarmonicMatrices {
    pub(super) fn new(
        k: &SparseMatrix,
        m: &SparseMatrix,
        damping: &HarmonicDamping<'_>,
        ordering: &Ordering,
    ) -> Result<Self, HarmonicError> {
        for (name, value) in [("alpha", damping.alpha), ("beta", damping.beta)] {
            if !(value >= 0.0 && value.is_finite()) {
                let what = format!("the damping coefficient {name} must be zero or more and finite, found {value}");
                return Err(HarmonicError::Input(what));
            }
        }
        let fits = |what, matrix: &SparseMatrix| match matrix.rows().min(matrix.cols()) {
            found if found == k.rows() && found == matrix.rows().max(matrix.cols()) => Ok(()),
            found => Err(LinalgError::Shape { what, expected: k.rows(), found }),
        };
        fits("mass", m)?;
        let permuted = |what, matrix: Option<&SparseMatrix>| match matrix {
            // a matrix of zeros is no damping
            Some(matrix) if matrix.data().iter().any(|&value| value != 0.0) => {
                fits(what, matrix)?;
                Ok::<_, LinalgError>(Some(SymmetricMatrix::permuted(matrix, ordering)))
            }
            _ => Ok(None),
        };
        let mass = SymmetricMatrix::permuted(m, ordering);
        let motions = damping.motions.map(|motions| spread(motions, &mass, ordering)).transpose()?;
        let motions = motions.filter(|motions| motions.ncols() > 0);
        Ok(Self {
            stiffness: SymmetricMatrix::permuted(k, ordering),
            mass,
            motions,
            alpha: damping.alpha,
            beta: damping.beta,
            viscous: permuted("viscous damping", damping.viscous)?,
            structural: permuted("structural damping", damping.structural)?,
        })
    }

    /// Whether anything dissipates at this frequency, rad/s.
    pub(super) fn is_damped(&self, omega: f64) -> bool {
        let viscous = self.alpha > 0.0 || self.beta > 0.0 || self.viscous.is_some() || self.motions.is_some();
        self.structural.is_some() || (viscous && omega > 0.0)
    }

    /// `K - w^2 M` for a squared frequency, 1/s^2.
    pub(super) fn real(&self, squared: f64) -> SymmetricMatrix {
        self.stiffness.shifted(squared, &self.mass)
    }

    /// `Z X`; complex columns are pairs of real ones: real parts in even columns, imaginary parts in odd ones [n x 2k].
    pub(super) fn times(&self, omega: f64, x: &DenseMatrix) -> DenseMatrix {
        let mut product = self.stiffness.times(x.as_ref());
        let heavy = self.mass.times(x.as_ref());
        let lossy = self.damping_times(omega, x, &product, &heavy);
        let squared = omega * omega;
        for column in 0..x.ncols() {
            let from = heavy.col_as_slice(column);
            for (entry, mass) in product.col_as_slice_mut(column).iter_mut().zip(from) {
                *entry -= squared * mass;
            }
            // i (a + i b) = -b + i a
            let (other, sign) = if column % 2 == 0 { (column + 1, -1.0) } else { (column - 1, 1.0) };
            let from = lossy.col_as_slice(other);
            for (entry, loss) in product.col_as_slice_mut(column).iter_mut().zip(from) {
                *entry += sign * loss;
            }
        }
        product
    }

    /// `(w C + K_s) X` for real columns, with `K X` and `M X` given.
    fn damping_times(&self, omega: f64, x: &DenseMatrix, stiff: &DenseMatrix, heavy: &DenseMatrix) -> DenseMatrix {
        let (alpha, beta) = (omega * self.alpha, omega * self.beta);
        let mut sum = DenseMatrix::zeros(x.nrows(), x.ncols());
        let mut add = |factor: f64, part: &DenseMatrix| {
            if factor != 0.0 {
                for column in 0..sum.ncols() {
                    let from = part.col_as_slice(column);
                    for (entry, more) in sum.col_as_slice_mut(column).iter_mut().zip(from) {
                        *entry += factor * more;
                    }
                }
            }
        };
        add(beta, stiff);
        add(alpha, heavy);
        if let Some(viscous) = &self.viscous {
            add(omega, &viscous.times(x.as_ref()));
        }
        if let Some(motions) = &self.motions {
            add(omega, &times(motions.as_ref(), times(motions.transpose(), x.as_ref()).as_ref()));
        }
        if let Some(structural) = &self.structural {
            add(1.0, &structural.times(x.as_ref()));
        }
        sum
    }

    /// `x^H (w C + K_s) x` of each complex column \[k\], J.
    pub(super) fn dissipation(&self, omega: f64, x: &DenseMatrix) -> Vec<f64> {
        let stiff = self.stiffness.times(x.as_ref());
        let heavy = self.mass.times(x.as_ref());
        let lossy = self.damping_times(omega, x, &stiff, &heavy);
        let product = |column: usize| -> f64 {
            let entries = x.col_as_slice(column).iter();
            entries.zip(lossy.col_as_slice(column)).map(|(x, y)| x * y).sum()
        };
        (0..x.ncols() / 2).map(|pair| product(2 * pair) + product(2 * pair + 1)).collect()
    }

    /// `| |Z| |x| |`, the size of what is summed in `Z x`, of one complex column.
    pub(super) fn scatter(&self, omega: f64, re: &[f64], im: &[f64]) -> f64 {
        let x: Vec<f64> = re.iter().zip(im).map(|(a, b)| a.hypot(*b)).collect();
        let mut sum = vec![0.0; x.len()];
        let mut add = |factor: f64, matrix: &SymmetricMatrix| {
            for (column, &other) in x.iter().enumerate() {
                for (row, value) in matrix.column(column) {
                    sum[row] += factor * value.abs() * other;
                    if row != column {
                        sum[column] += factor * value.abs() * x[row];
                    }
                }
            }
        };
        add(1.0 + omega * self.beta, &self.stiffness);
        add(omega * (omega + self.alpha), &self.mass);
        if let Some(viscous) = &self.viscous {
            add(omega, viscous);
        }
        if let Some(structural) = &self.structural {
            add(1.0, structural);
        }
        if let Some(motions) = &self.motions {
            for motion in motions.col_iter() {
                let along: f64 = motion.iter().zip(&x).map(|(s, x)| s.abs() * x).sum();
                for (sum, s) in sum.iter_mut().zip(motion.iter()) {
                    *sum += omega * s.abs() * along;
                }
            }
        }
        sum.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
    }
}

/// `M Phi diag(sqrt(c))` in the factor's order, without motions that are not damped; its product with its transpose is C.
///
/// # Errors
/// [`LinalgError::Shape`]; [`HarmonicError::Input`] for rates out of range.
fn spread(
    MotionDamping { shapes, rates }: MotionDamping<'_>,
    mass: &SymmetricMatrix,
    ordering: &Ordering,
) -> Result<DenseMatrix, HarmonicError> {
    for (what, expected, found) in
        [("damped motions", mass.order(), shapes.nrows()), ("damping rates", shapes.ncols(), rates.len())]
    {
        if found != expected {
            return Err(LinalgError::Shape { what, expected, found }.into());
        }
    }
    if let Some(rate) = rates.iter().find(|rate| !(**rate >= 0.0 && rate.is_finite())) {
        return Err(HarmonicError::Input(format!("a damping rate must be zero or more and finite, found {rate} 1/s")));
    }
    let damped: Vec<usize> = (0..rates.len()).filter(|&motion| rates[motion] > 0.0).collect();
    let scaled = DenseMatrix::from_fn(shapes.nrows(), damped.len(), |row, column| {
        shapes[(row, damped[column])] * rates[damped[column]].sqrt()
    });
    Ok(mass.times(ordering.forward(&scaled).as_ref()))
}
