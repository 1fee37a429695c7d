//! How far computed eigenvalues may be from the true ones.

use super::basis::{norms, times};
use super::{DenseMatrix, EigenPairs, Factor, SymmetricMatrix, SymmetricSpectrum};
use faer::ColMut;
use faer::prelude::*;
use rayon::prelude::*;

/// Relative gap below which eigenvalues belong to one cluster, whose vectors are judged together.
const CLUSTER: f64 = 1e-3;

/// Round-off of `x^T K x` in units of eps times the scatter of its terms: an entry of K is a sum over thirty elements,
/// each a sum over its integration points. Two orders of assembly of the same solid differ by a twentieth of it.
pub(super) const ROUNDING: f64 = 32.0;

impl EigenPairs {
    /// Judges the first `count` of the pairs; `factor` is that of `K - sigma M`. Count and times are left to the caller, the
    /// vectors in the order of the factor. The values are Rayleigh quotients `x^T K x / x^T M x`: the eigenvalues with no more
    /// round-off than K itself brings.
    ///
    /// With r the residual and F the factor, `s = |F^-1 r|_M` is the relative residual of the inverse problem: an
    /// eigenvalue lies within `|lambda - sigma| s` (Parlett, The Symmetric Eigenvalue Problem, theorem 4.5.1). With
    /// sigma below all eigenvalues the error of a Rayleigh quotient is `sum c_j^2 (lambda_j - lambda)` over the foreign
    /// parts `c_j v_j` of x, and `r^T F^-1 r = sum c_j^2 (lambda_j - lambda)^2 / (lambda_j - sigma)`: it is at most
    /// `r^T F^-1 r (lambda_j - sigma) / |lambda_j - lambda|` for the nearest other eigenvalue `lambda_j`; of a cluster all
    /// residuals count together. The error of F enters by its contraction c, as a factor `1 / (1 - c)`.
    pub(super) fn judged(
        stiffness: &SymmetricMatrix,
        mass: &SymmetricMatrix,
        factor: &Factor,
        sigma: f64,
        ritz: &SymmetricSpectrum,
        count: usize,
    ) -> Self {
        let x = ritz.vectors.subcols(0, count);
        let stiff = stiffness.times(x);
        let heavy = mass.times(x);
        let mut steps = stiff.clone();
        let of_mode = |(mode, mut step): (usize, ColMut<'_, f64>)| -> (f64, f64) {
            let (x, stiff, heavy) = (x.col(mode), stiff.col(mode), heavy.col(mode));
            let quotient = x.transpose() * stiff;
            let value: f64 = quotient / (x.transpose() * heavy);
            step.rb_mut().iter_mut().zip(heavy.iter()).for_each(|(entry, product)| *entry -= value * product);
            let scale = stiff.norm_l2() + (value - sigma).abs() * heavy.norm_l2();
            (value, step.norm_l2() / scale)
        };
        let judged = steps.par_col_iter_mut().enumerate().map(of_mode);
        let (mut values, residuals): (Vec<f64>, Vec<f64>) = judged.unzip();
        values.extend_from_slice(&ritz.values[count..]);
        let remainders = steps.clone();
        factor.solve(steps.as_mut());
        let inexact = 1.0 / (1.0 - factor.contraction);
        let lengths: Vec<f64> = norms(steps.as_ref(), mass.times(steps.as_ref()).as_ref())
            .into_iter()
            .map(|length| length * inexact)
            .collect();
        let energy = |mode: usize| inexact * (remainders.col(mode).transpose() * steps.col(mode));
        let energies: Vec<f64> = (0..count).map(energy).collect();
        let scatters = stiffness.energy_scatters(x).into_iter();
        let rounding: Vec<f64> = scatters.map(|scatter| ROUNDING * f64::EPSILON * scatter).collect();
        let bounds = bounds(&values, &lengths, &energies, sigma)
            .into_iter()
            .zip(&rounding)
            .map(|(bound, rounding)| bound + rounding)
            .collect();
        let mut gram = times(x.transpose(), heavy.as_ref());
        gram -= DenseMatrix::identity(count, count);
        values.truncate(count);
        Self {
            values,
            vectors: x.to_owned(),
            residuals,
            bounds,
            rounding,
            orthogonality: gram.norm_max(),
            shift: sigma,
            ..Self::none(0, 0.0)
        }
    }
}

/// The smaller of the two bounds for each of the first pairs; `values` may go on beyond them.
fn bounds(values: &[f64], lengths: &[f64], energies: &[f64], sigma: f64) -> Vec<f64> {
    let from = |place: usize| (values[place] - sigma).abs();
    let below_all = values.first().is_none_or(|&lowest| sigma < lowest);
    (0..lengths.len())
        .map(|mode| {
            let linear = from(mode) * lengths[mode];
            let cluster = cluster(values, sigma, mode);
            let (first, last) = (cluster[0], cluster[1]);
            if !below_all || last >= lengths.len() {
                return linear;
            }
            let energy: f64 = energies[first..=last].iter().map(|energy| energy.abs()).sum();
            let below = first.checked_sub(1).map(|other| (other, first));
            let above = (last + 1 < values.len()).then_some((last + 1, last));
            let factor = |(other, nearest): (usize, usize)| from(other) / (values[other] - values[nearest]).abs();
            let factors = [below, above].into_iter().flatten().map(factor);
            linear.min(energy * factors.fold(1.0, f64::max))
        })
        .collect()
}

/// First and last place of the cluster that a value belongs to.
fn cluster(values: &[f64], sigma: f64, mode: usize) -> [usize; 2] {
    let from = |place: usize| (values[place] - sigma).abs();
    let together = |low: usize| (values[low + 1] - values[low]).abs() <= CLUSTER * from(low).max(from(low + 1));
    let first = (0..mode).rev().take_while(|&low| together(low)).last();
    let last = (mode..values.len() - 1).take_while(|&low| together(low)).last();
    [first.unwrap_or(mode), last.map_or(mode, |low| low + 1)]
}
