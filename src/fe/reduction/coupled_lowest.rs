//! The lowest modes of a condensed housing with what is attached, on all characteristic modes of its interface.
//!
//! In these coordinates the interface is a diagonal of ones and squared frequencies; only the interior's vectors, few of them,
//! border it:
//!
//! ```text
//! K + s M = | diag(kappa + s)   B^T |        C - B diag(kappa + s)^-1 B^T        of the order of the border
//!           | B                 C   |
//! ```
//!
//! so that a solve costs (interface x border), and subspace iteration (Bathe, Finite Element Procedures (1996), section
//! 11.6) gives the lowest modes of an interface of thousands of coordinates at once. The whole dense eigenvalue problem
//! takes minutes there, each time that the basis changes. Rigid motions stand in the border, as the ground may hold what is
//! attached.

use super::interior_basis::with_amplitudes;
use super::parts::symmetric;
use super::{CharacteristicModes, InteriorBasis, ReductionError};
use crate::numerics::linalg::{DenseCholesky, DenseMatrix, SymmetricSpectrum, congruent, symmetric_eigen};

/// Shift beside the lowest fixed-interface eigenvalue: below the elastic modes, and far from round-off.
const SHIFT: f64 = 1e-3;

/// Vectors that are iterated beside as many as twice those wanted.
const GUARD: usize = 8;

/// Vectors of the start that are no unit vectors: with these no mode is left out for its symmetry.
const MIXED: usize = 4;

/// Change of an eigenvalue in an iteration, relative, at which it has converged. With as many vectors beyond as wanted ones,
/// what is left is smaller.
const CONVERGED: f64 = 1e-13;

/// Squared length of a combination of vectors beside the longest, below which it is round-off.
const DEPENDENT: f64 = 1e-13;

/// Iterations at most; ten are usual. What has not converged then is as good as Ritz values are: from above.
const ITERATIONS: usize = 100;

/// An interface in its characteristic modes, ready for bases of the interior.
pub(super) struct CoupledProblem<'a> {
    interface: &'a CharacteristicModes,
    /// Stiffness of the rigid motions against all modes [rigid x modes]: zero unless the ground holds what is attached.
    stiffness: DenseMatrix,
}

/// Matrices on the modes beyond the rigid motions (inner), and on these and the interior's vectors (border).
struct Bordered {
    /// Diagonal of the inner stiffness.
    kappa: Vec<f64>,
    /// K and M between border and inner [border x inner].
    across: [DenseMatrix; 2],
    /// K and M of the border.
    border: [DenseMatrix; 2],
}

impl<'a> CoupledProblem<'a> {
    pub(super) fn new(interface: &'a CharacteristicModes) -> Self {
        let rigid = interface.vectors.subcols(0, interface.rigid);
        let held = rigid.transpose() * &interface.stiffness * &interface.vectors;
        Self { interface, stiffness: held }
    }

    /// The lowest `count` modes in coordinates of the interface and the basis, or all if there are fewer.
    ///
    /// # Errors
    /// What the dense solvers report.
    pub(super) fn lowest(&self, basis: &InteriorBasis, count: usize) -> Result<SymmetricSpectrum, ReductionError> {
        let (rigid, q) = (self.interface.rigid, basis.count());
        let inner = self.interface.count() - rigid;
        let driven = &basis.participation * &self.interface.vectors;
        let unit = DenseMatrix::identity(rigid, rigid);
        let own = [self.stiffness.subcols(0, rigid), unit.as_ref()];
        let problem = Bordered {
            kappa: self.interface.values[rigid..].to_vec(),
            across: [
                faer::concat![[self.stiffness.subcols(rigid, inner)], [DenseMatrix::zeros(q, inner)]],
                faer::concat![[DenseMatrix::zeros(rigid, inner)], [driven.subcols(rigid, inner)]],
            ],
            border: with_amplitudes(own, basis, driven.subcols(0, rigid)),
        };
        let found = problem.lowest(count, SHIFT * basis.lowest_value())?;
        // back from modes of the interface to its coordinates
        let part = |first: usize, count: usize| found.vectors.subrows(first, count);
        let moved = &self.interface.vectors * faer::concat![[part(inner, rigid)], [part(0, inner)]];
        let vectors = faer::concat![[moved], [part(inner + rigid, q)]];
        Ok(SymmetricSpectrum { values: found.values, vectors })
    }
}

impl Bordered {
    fn order(&self) -> usize {
        self.kappa.len() + self.border[0].nrows()
    }

    fn lowest(&self, count: usize, shift: f64) -> Result<SymmetricSpectrum, ReductionError> {
        let order = self.order();
        let width = (2 * count + GUARD + MIXED).min(order);
        let mut x = self.start(width);
        let scale: Vec<f64> = self.kappa.iter().map(|k| (k + shift).recip()).collect();
        let across = &self.across[0] + &self.across[1] * faer::Scale(shift);
        let scaled =
            DenseMatrix::from_fn(across.nrows(), across.ncols(), |row, column| across[(row, column)] * scale[column]);
        let schur = &self.border[0] + &self.border[1] * faer::Scale(shift) - &scaled * across.transpose();
        let schur = DenseCholesky::new(&schur)?;
        let mut before = vec![f64::INFINITY; width];
        for _ in 0..ITERATIONS {
            // (K + s M)^-1 M x, the border first
            let moved = self.times(1, &x);
            let (inner, border) = self.split(&moved);
            let of_border = schur.solve(&(border - &scaled * &inner));
            let rest = inner - across.transpose() * &of_border;
            let rest = DenseMatrix::from_fn(rest.nrows(), rest.ncols(), |row, mode| scale[row] * rest[(row, mode)]);
            let y = faer::concat![[rest], [of_border]];
            let [k, m] = [0, 1].map(|which| symmetric(&(y.transpose() * self.times(which, &y))));
            let normal = orthonormal(&m)?;
            let ritz = symmetric_eigen(&symmetric(&congruent(&k, &normal)))?;
            x = y * (normal * ritz.vectors);
            let wanted = count.min(ritz.values.len());
            let done = (0..wanted).all(|mode| {
                let (was, is) = (before[mode] + shift, ritz.values[mode] + shift);
                (was - is).abs() <= CONVERGED * is
            });
            before = ritz.values;
            if done {
                break;
            }
        }
        let wanted = count.min(before.len());
        before.truncate(wanted);
        Ok(SymmetricSpectrum { values: before, vectors: x.subcols(0, wanted).to_owned() })
    }

    /// Unit vectors of the softest coordinates, and a few of all.
    fn start(&self, width: usize) -> DenseMatrix {
        let (inner, order) = (self.kappa.len(), self.order());
        let value = |place: usize| match place.checked_sub(inner) {
            None => self.kappa[place],
            Some(row) => self.border[0][(row, row)],
        };
        let mut places: Vec<usize> = (0..order).collect();
        places.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
        let units = if width == order { order } else { width.saturating_sub(MIXED) };
        let mut x = DenseMatrix::from_fn(order, width, |row, column| match column < units {
            true => 0.0,
            // irrational steps: no pattern
            false => ((row + 1) as f64 * (1.0 + column as f64 * 0.414_213_562)).sin(),
        });
        for (column, &place) in places.iter().take(units).enumerate() {
            x[(place, column)] = 1.0;
        }
        x
    }

    /// K (0) or M (1) times vectors.
    fn times(&self, which: usize, x: &DenseMatrix) -> DenseMatrix {
        let (inner, border) = self.split(x);
        let (across, own) = (&self.across[which], &self.border[which]);
        let above = across.transpose() * &border;
        let below = across * &inner + own * &border;
        let inner = DenseMatrix::from_fn(above.nrows(), above.ncols(), |row, column| {
            let diagonal = if which == 0 { self.kappa[row] } else { 1.0 };
            diagonal * inner[(row, column)] + above[(row, column)]
        });
        faer::concat![[inner], [below]]
    }

    fn split(&self, x: &DenseMatrix) -> (DenseMatrix, DenseMatrix) {
        let inner = self.kappa.len();
        (x.subrows(0, inner).to_owned(), x.subrows(inner, x.nrows() - inner).to_owned())
    }
}

/// Combinations V of vectors with the Gram matrix m, `V^T m V = 1` [n x kept]. Beside rigid motions all vectors of a first
/// step look alike: what is round-off of their differences is left out, high modes that nobody wants.
fn orthonormal(m: &DenseMatrix) -> Result<DenseMatrix, ReductionError> {
    let lengths: Vec<f64> = (0..m.nrows()).map(|i| m[(i, i)].sqrt()).collect();
    let scaled =
        DenseMatrix::from_fn(m.nrows(), m.ncols(), |row, column| m[(row, column)] / (lengths[row] * lengths[column]));
    let gram = symmetric_eigen(&scaled)?;
    let longest = gram.values.last().copied().unwrap_or(0.0);
    let kept: Vec<usize> = (0..gram.values.len()).filter(|&place| gram.values[place] > DEPENDENT * longest).collect();
    Ok(DenseMatrix::from_fn(m.nrows(), kept.len(), |row, column| {
        gram.vectors[(row, kept[column])] / (gram.values[kept[column]].sqrt() * lengths[row])
    }))
}

#[cfg(test)]
#[path = "coupled_lowest_tests.rs"]
mod tests;
