//! Flexible GMRES for complex systems of which only products and an approximate real inverse are known.
//!
//! Source: Saad, A flexible inner-outer preconditioned GMRES algorithm, SIAM J. Sci. Comput. 14 (1993) 461-469,
//! algorithm 2.2. Flexible, because a factor in single precision rounds what it is given: its inverse is not linear to
//! double precision, and the preconditioned directions themselves must make up the solution.

use crate::numerics::linalg::DenseMatrix;
use faer::c64;
use rayon::prelude::*;

/// A complex vector.
#[derive(Debug, Clone)]
struct Pair {
    re: Vec<f64>,
    im: Vec<f64>,
}

impl Pair {
    /// Complex column `index` of pairs of real columns.
    fn of(x: &DenseMatrix, index: usize) -> Self {
        Self { re: x.col_as_slice(2 * index).to_vec(), im: x.col_as_slice(2 * index + 1).to_vec() }
    }

    /// `self^H other`.
    fn dot(&self, other: &Self) -> c64 {
        let real = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        c64::new(
            real(&self.re, &other.re) + real(&self.im, &other.im),
            real(&self.re, &other.im) - real(&self.im, &other.re),
        )
    }

    fn norm(&self) -> f64 {
        self.dot(self).re.sqrt()
    }

    /// `self += factor other`.
    fn add(&mut self, factor: c64, other: &Self) {
        let (a, b) = (factor.re, factor.im);
        for (entry, (re, im)) in self.re.iter_mut().zip(other.re.iter().zip(&other.im)) {
            *entry += a * re - b * im;
        }
        for (entry, (re, im)) in self.im.iter_mut().zip(other.re.iter().zip(&other.im)) {
            *entry += a * im + b * re;
        }
    }

    fn scale(&mut self, factor: f64) {
        for entry in self.re.iter_mut().chain(&mut self.im) {
            *entry *= factor;
        }
    }
}

/// Arnoldi process of one right-hand side.
struct Arnoldi {
    /// Orthonormal directions v.
    basis: Vec<Pair>,
    /// Preconditioned directions `P^-1 v`.
    directions: Vec<Pair>,
    /// Upper triangle of the rotated Hessenberg matrix, by columns.
    columns: Vec<Vec<c64>>,
    rotations: Vec<(f64, c64)>,
    /// Rotated right-hand side; its last entry is the residual's size.
    target: Vec<c64>,
}

impl Arnoldi {
    fn new(mut residual: Pair) -> Self {
        let size = residual.norm();
        residual.scale(1.0 / size);
        Self {
            basis: vec![residual],
            directions: Vec::new(),
            columns: Vec::new(),
            rotations: Vec::new(),
            target: vec![c64::new(size, 0.0)],
        }
    }

    fn residual(&self) -> f64 {
        self.target.last().map_or(0.0, |last| last.norm())
    }

    /// Takes in the newest direction and its product with the matrix.
    fn step(&mut self, direction: Pair, mut product: Pair) {
        let mut column = vec![c64::new(0.0, 0.0); self.basis.len()];
        let before = product.norm();
        // twice: what rounding left the first time, the second takes
        for _ in 0..2 {
            for (entry, v) in column.iter_mut().zip(&self.basis) {
                let part = v.dot(&product);
                product.add(-part, v);
                *entry += part;
            }
        }
        let below = product.norm();
        for (place, &(cosine, sine)) in self.rotations.iter().enumerate() {
            let (upper, lower) = (column[place], column[place + 1]);
            column[place] = upper * cosine + sine * lower;
            column[place + 1] = lower * cosine - sine.conj() * upper;
        }
        let place = column.len() - 1;
        let upper = column[place];
        let length = upper.norm().hypot(below);
        let (cosine, sine) = if length == 0.0 {
            (1.0, c64::new(0.0, 0.0))
        } else if upper.norm() == 0.0 {
            (0.0, c64::new(1.0, 0.0))
        } else {
            let phase = upper / upper.norm();
            (upper.norm() / length, phase * (below / length))
        };
        column[place] = upper * cosine + sine * below;
        let last = self.target[place];
        self.target[place] = last * cosine;
        self.target.push(-sine.conj() * last);
        self.rotations.push((cosine, sine));
        self.columns.push(column);
        self.directions.push(direction);
        // below round-off nothing new was found: the solution is in the space
        if below > f64::EPSILON * before {
            product.scale(1.0 / below);
        } else {
            product.scale(0.0);
        }
        self.basis.push(product);
    }

    /// Adds to `x` what the directions make of the residual.
    fn correct(&self, x: &mut Pair) {
        let count = self.columns.len();
        let mut factors = self.target[..count].to_vec();
        for place in (0..count).rev() {
            let pivot = self.columns[place][place];
            if pivot.norm() == 0.0 {
                factors[place] = c64::new(0.0, 0.0);
                continue;
            }
            let factor = factors[place] / pivot;
            factors[place] = factor;
            for (row, entry) in factors.iter_mut().enumerate().take(place) {
                *entry -= factor * self.columns[place][row];
            }
        }
        for (&factor, direction) in factors.iter().zip(&self.directions) {
            x.add(factor, direction);
        }
    }
}

/// Relative residual `|f - Z x| / |f|` that is aimed at.
pub(super) const TOLERANCE: f64 = 1e-12;

/// Directions kept before a restart.
const DIRECTIONS: usize = 40;

/// Restarts.
const RESTARTS: usize = 6;

/// A solution.
#[derive(Debug)]
pub(super) struct Iterated {
    /// Complex columns as pairs of real ones [n x 2k].
    pub x: DenseMatrix,
    /// `|f - Z x| / |f|` of each, computed from x.
    pub residuals: Vec<f64>,
    /// Products made for each.
    pub iterations: Vec<usize>,
}

/// Solves `Z X = F`; complex columns are pairs of real ones [n x 2k]. `multiply` is Z, `precondition` approximates its
/// inverse.
pub(super) fn solve(
    f: &DenseMatrix,
    multiply: impl Fn(&DenseMatrix) -> DenseMatrix,
    precondition: impl Fn(&mut DenseMatrix),
) -> Iterated {
    let count = f.ncols() / 2;
    let norms: Vec<f64> = (0..count).map(|index| Pair::of(f, index).norm()).collect();
    let mut x = DenseMatrix::zeros(f.nrows(), f.ncols());
    let mut residuals: Vec<f64> = norms.iter().map(|&n| f64::from(u8::from(n > 0.0))).collect();
    let mut iterations = vec![0; count];
    let mut remainders = f.clone();
    let mut active: Vec<usize> = (0..count).filter(|&index| norms[index] > 0.0).collect();
    for _ in 0..=RESTARTS {
        if active.is_empty() {
            break;
        }
        let mut processes: Vec<Arnoldi> =
            active.iter().map(|&index| Arnoldi::new(Pair::of(&remainders, index))).collect();
        let goals: Vec<f64> = active.iter().map(|&index| 0.5 * TOLERANCE * norms[index]).collect();
        for _ in 0..DIRECTIONS {
            let mut running: Vec<(usize, &mut Arnoldi)> = processes
                .iter_mut()
                .enumerate()
                .filter(|(place, process)| process.residual() > goals[*place])
                .collect();
            if running.is_empty() {
                break;
            }
            let newest: Vec<&Pair> = running.iter().filter_map(|(_, process)| process.basis.last()).collect();
            let mut directions = joined(&newest);
            precondition(&mut directions);
            let products = multiply(&directions);
            running.par_iter_mut().enumerate().for_each(|(place, (_, process))| {
                process.step(Pair::of(&directions, place), Pair::of(&products, place));
            });
            for (place, _) in &running {
                iterations[active[*place]] += 1;
            }
        }
        for (process, &index) in processes.iter().zip(&active) {
            let mut own = Pair::of(&x, index);
            process.correct(&mut own);
            x.col_as_slice_mut(2 * index).copy_from_slice(&own.re);
            x.col_as_slice_mut(2 * index + 1).copy_from_slice(&own.im);
        }
        remainders = f - multiply(&x);
        active.retain(|&index| {
            let before = residuals[index];
            residuals[index] = Pair::of(&remainders, index).norm() / norms[index];
            // a correction that does not halve the residual has met round-off
            residuals[index] > TOLERANCE && residuals[index] < 0.5 * before
        });
    }
    Iterated { x, residuals, iterations }
}

/// Complex vectors as pairs of columns.
fn joined(pairs: &[&Pair]) -> DenseMatrix {
    let rows = pairs.first().map_or(0, |pair| pair.re.len());
    let mut whole = DenseMatrix::zeros(rows, 2 * pairs.len());
    for (index, pair) in pairs.iter().enumerate() {
        whole.col_as_slice_mut(2 * index).copy_from_slice(&pair.re);
        whole.col_as_slice_mut(2 * index + 1).copy_from_slice(&pair.im);
    }
    whole
}
