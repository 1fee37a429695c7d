//! The lowest eigenpairs by a block Krylov space with the factor's inverse, then by Davidson's correction.
//!
//! The factor F of `K - sigma M` is taken for what it is, an approximation. A block Krylov space of `F^-1 M` (Golub and
//! Underwood 1977) holds the wanted vectors about as well as F is exact; Rayleigh-Ritz with K and M themselves, and
//! corrections `F^-1 (K x - lambda M x)` (Davidson, J. Comput. Phys. 17 (1975) 87-94), take them to the accuracy of K and M.
//! Blocks load the factor once for all their vectors: eight together cost 1.5 to 2.9 times one alone.

use super::basis::{Basis, Columns, copy, norms, tall_times, times};
use super::dense::pseudo_random;
use super::{DenseMatrix, Factor, LinalgError, SymmetricMatrix, SymmetricSpectrum, symmetric_eigen};
use crate::numerics::Told;
use faer::Accum;
use faer::prelude::*;
use rayon::prelude::*;

/// Vectors that the Krylov space grows by.
const BLOCK: usize = 8;

/// Vectors that are corrected at once.
const CORRECTED: usize = 32;

/// Step of a wanted pair, `|F^-1 (K x - lambda M x)|` in the norm of M, at which it has converged: about the angle to
/// the eigenvector; the eigenvalue is right to its square.
const CONVERGED: f64 = 1e-7;

/// Relative residual `|K x - lambda M x|` at which a wanted pair has converged, in Euclidean norms: stiff directions,
/// which weigh little in the norm of M, are converged as well.
const SMALL_RESIDUAL: f64 = 1e-6;

/// Energy of a wanted pair's residual, `r^T F^-1 r`, relative to `lambda - sigma`, at which it has converged: the
/// relative error of its eigenvalue, but for a factor from the gap.
const SMALL_ENERGY: f64 = 1e-13;

/// The step for the pairs beyond, whose values are needed to a few digits.
const GUARD_CONVERGED: f64 = 1e-2;

/// Change of an eigenvalue, relative to its distance from the shift, after which a converged pair is looked at again:
/// another one has come below it.
const CHANGED: f64 = 1e-7;

/// Change of an eigenvalue that is round-off of the dense solver, in units of that of `K x`: up to five were seen.
const DRIFT: f64 = 32.0;

/// Corrections after which the iteration gives up; three to five are usual.
const CORRECTIONS: usize = 100;

/// Round-off of a residual in units of eps times the highest eigenvalue, below which no correction brings it.
const ROUNDING: f64 = 16.0;

/// Largest `K_ii / M_ii`: about a third of the highest eigenvalue.
pub(super) fn largest_ratio(stiffness: &SymmetricMatrix, mass: &SymmetricMatrix) -> f64 {
    let ratios = stiffness.diagonal().into_iter().zip(mass.diagonal());
    ratios.map(|(stiffness, mass)| stiffness / mass).filter(|ratio| ratio.is_finite()).fold(0.0, f64::max)
}

/// Round-off of `K x` for a unit x, in the norm of M, 1/s^2.
pub(super) fn round_off(stiffness: &SymmetricMatrix, mass: &SymmetricMatrix) -> f64 {
    ROUNDING * f64::EPSILON * largest_ratio(stiffness, mass)
}

/// A search for the lowest eigenpairs of `K x = lambda M x`.
pub(super) struct Search<'p> {
    stiffness: &'p SymmetricMatrix,
    mass: &'p SymmetricMatrix,
    basis: Basis<'p>,
    /// `V^T K V`, upper left part.
    projected: DenseMatrix,
    /// Pairs that must converge.
    wanted: usize,
    /// These and those beyond.
    pursued: usize,
    krylov: usize,
    /// Round-off of `K x` for a unit x, in the norm of M, 1/s^2.
    pub round_off: f64,
    /// Shift sigma of the factor, 1/s^2.
    pub shift: f64,
    /// Largest of the last steps of wanted pairs, as an angle.
    pub largest_step: f64,
    /// Seeds used so far: every new block starts elsewhere.
    started: u64,
    /// Values at which the pursued pairs have converged.
    done: Vec<Option<f64>>,
    told: Told<'p>,
    /// Three blocks of vectors [n x CORRECTED] that every step overwrites: new memory would cost more than some of the
    /// products (a page fault for each 4 KiB).
    blocks: [Columns; 3],
}

/// Vectors of the largest basis for so many pairs: two full blocks of corrections fit beside the Krylov space. With room
/// for one, a restart in the middle cost two more corrections (solids of 60 000 and 240 000 degrees of freedom).
pub(super) fn largest_basis(pursued: usize) -> usize {
    krylov_size(pursued) + 2 * CORRECTED
}

/// Size of the Krylov space: smaller ones need more corrections, larger ones cost more than they save (measured on solids
/// of 60 000 degrees of freedom, 20 and 41 modes).
fn krylov_size(pursued: usize) -> usize {
    3 * pursued + 2 * BLOCK
}

impl<'p> Search<'p> {
    /// Prepares a search for `wanted` pairs and a rough idea of `beyond` more; `shift` is that of the factor. `told` hears its half
    /// while the space grows, as many solutions as the corrections take, and then the share of the wanted pairs that have converged.
    pub(super) fn new(
        stiffness: &'p SymmetricMatrix,
        mass: &'p SymmetricMatrix,
        shift: f64,
        [wanted, beyond]: [usize; 2],
        told: Told<'p>,
    ) -> Self {
        let pursued = wanted + beyond;
        let room = largest_basis(pursued);
        Self {
            stiffness,
            mass,
            basis: Basis::new(mass, room),
            projected: DenseMatrix::zeros(room, room),
            wanted,
            pursued,
            krylov: krylov_size(pursued),
            round_off: round_off(stiffness, mass),
            shift,
            largest_step: 0.0,
            started: 0,
            done: vec![None; pursued],
            told,
            blocks: [(); 3].map(|()| Columns::new(mass.order(), CORRECTED)),
        }
    }

    /// Lets the space grow by a block Krylov sequence from new vectors: once at the beginning, and again when pairs
    /// turn out to be missing.
    ///
    /// # Errors
    /// [`LinalgError::DenseEigen`].
    pub(super) fn explore(&mut self, factor: &Factor) -> Result<(), LinalgError> {
        if self.basis.size + 2 * BLOCK > self.krylov {
            self.restart(self.pursued)?;
        }
        let before = self.basis.size;
        self.started += 1;
        let start = pseudo_random(self.mass.order(), BLOCK, self.started);
        self.mass.times_into(start.as_ref(), self.blocks[0].first(BLOCK));
        let mut width = BLOCK;
        while self.basis.size < self.krylov {
            let [block, product, _] = &mut self.blocks;
            let mut block = block.first(width);
            (self.told)(0.5 * self.basis.size as f64 / self.krylov as f64);
            factor.solve(block.rb_mut());
            factor.check()?;
            self.mass.times_into(block.rb(), product.first(width));
            width = self.extend(width)?;
            if width == 0 {
                break;
            }
            let [block, product, _] = &mut self.blocks;
            copy(block.first(width), product.first(width).rb());
        }
        self.project(before);
        Ok(())
    }

    /// Adds the first columns of the first block; the second holds their products with M, and in the end those of what was
    /// added.
    fn extend(&mut self, width: usize) -> Result<usize, LinalgError> {
        let [block, product, spare] = &mut self.blocks;
        self.basis.extend(block.first(width), product.first(width), spare.first(width))
    }

    /// Completes `V^T K V` from a vector on: many at once, so that the basis is read once for all of them. Overwrites the
    /// last block.
    fn project(&mut self, from: usize) {
        let size = self.basis.size;
        for begin in (from..size).step_by(CORRECTED) {
            let width = CORRECTED.min(size - begin);
            let (vectors, mut stiff) = (self.basis.vectors(), self.blocks[2].first(width));
            let new = vectors.subcols(begin, width);
            self.stiffness.times_into(new, stiff.rb_mut());
            let known = vectors.subcols(0, begin + width);
            let rows = times(known.transpose(), stiff.rb());
            for column in 0..width {
                for row in 0..begin + width {
                    let value = match row.checked_sub(begin) {
                        None => rows[(row, column)],
                        Some(new) => 0.5 * (rows[(row, column)] + rows[(begin + column, new)]),
                    };
                    self.projected[(row, begin + column)] = value;
                    self.projected[(begin + column, row)] = value;
                }
            }
        }
    }

    /// Eigenvalues and combinations of the space, ascending.
    fn ritz(&self) -> Result<SymmetricSpectrum, LinalgError> {
        let size = self.basis.size;
        symmetric_eigen(&self.projected.as_ref().submatrix(0, 0, size, size).to_owned())
    }

    /// The Ritz value at a place.
    ///
    /// # Errors
    /// [`LinalgError::TooManyModes`] if the space is smaller, which then is that of all motions with mass.
    pub(super) fn value(&self, place: usize) -> Result<f64, LinalgError> {
        let values = self.ritz()?.values;
        values.get(place).copied().ok_or(LinalgError::TooManyModes { asked: place + 1, available: values.len() })
    }

    /// Keeps the space of the lowest Ritz vectors.
    fn restart(&mut self, kept: usize) -> Result<(), LinalgError> {
        let spectrum = self.ritz()?;
        let kept = kept.min(self.basis.size);
        self.basis.rotate(spectrum.vectors.subcols(0, kept));
        self.projected.fill(0.0);
        for place in 0..kept {
            self.projected[(place, place)] = spectrum.values[place];
        }
        Ok(())
    }

    /// Corrects the Ritz pairs once; returns the values of all that are pursued.
    ///
    /// # Errors
    /// [`LinalgError::DenseEigen`].
    pub(super) fn approach(&mut self, factor: &Factor) -> Result<Vec<f64>, LinalgError> {
        self.correct(factor)?;
        let mut values = self.ritz()?.values;
        values.truncate(self.pursued);
        Ok(values)
    }

    /// Corrects the Ritz pairs until they have converged; their vectors [n x pursued] are M-orthonormal.
    ///
    /// # Errors
    /// [`LinalgError::Iteration`], [`LinalgError::DenseEigen`].
    pub(super) fn converge(&mut self, factor: &Factor) -> Result<SymmetricSpectrum, LinalgError> {
        for _ in 0..CORRECTIONS {
            if let Some(pairs) = self.correct(factor)? {
                return Ok(pairs);
            }
        }
        let converged = self.done[..self.wanted].iter().flatten().count();
        Err(LinalgError::not_converged(self.wanted, converged, CORRECTIONS))
    }

    /// Adds a correction of every pair that has not converged, or returns all of them if there is none.
    ///
    /// # Errors
    /// [`LinalgError::DenseEigen`], [`LinalgError::Library`].
    fn correct(&mut self, factor: &Factor) -> Result<Option<SymmetricSpectrum>, LinalgError> {
        let spectrum = self.ritz()?;
        let pursued = self.pursued.min(self.basis.size);
        let changed = (0..pursued).find(|&place| {
            let value = spectrum.values[place];
            // a rigid motion's value is all round-off, and changes with every step
            let same = CHANGED * (value - self.shift).abs() + DRIFT * self.round_off;
            let apart = |before: f64| (value - before).abs() > same;
            place < self.wanted && self.done[place].is_some_and(apart)
        });
        if let Some(first) = changed {
            self.done[first..].fill(None);
        }
        let chosen: Vec<usize> = (0..pursued).filter(|&place| self.done[place].is_none()).take(CORRECTED).collect();
        if chosen.is_empty() {
            let vectors = times(self.basis.vectors(), spectrum.vectors.subcols(0, pursued));
            let values = spectrum.values[..pursued].to_vec();
            return Ok(Some(SymmetricSpectrum { values, vectors }));
        }
        let steps = self.steps(&spectrum, &chosen, factor);
        factor.check()?;
        let mut open = Vec::new();
        self.largest_step = 0.0;
        for (column, &place) in chosen.iter().enumerate() {
            let [length, residual, energy] = steps[column];
            if place < self.wanted {
                self.largest_step = self.largest_step.max(length);
            }
            let floor = self.round_off / (spectrum.values[place] - self.shift).abs();
            let converged = if place < self.wanted {
                length <= CONVERGED.max(floor)
                    && residual <= SMALL_RESIDUAL.max(floor)
                    && energy <= SMALL_ENERGY.max(floor * floor)
            } else {
                length <= GUARD_CONVERGED
            };
            if converged {
                self.done[place] = Some(spectrum.values[place]);
            } else {
                open.push(column);
            }
        }
        let converged = self.done[..self.wanted].iter().flatten().count();
        (self.told)(0.5 + 0.5 * converged as f64 / self.wanted as f64);
        self.keep(&open);
        if open.len() > self.basis.room() {
            self.restart((3 * self.pursued / 2).min(self.basis.size))?;
        }

        let before = self.basis.size;
        self.extend(open.len())?;
        self.project(before);

        Ok(None)
    }

    /// Corrections `F^-1 (K x - lambda M x)` of the chosen Ritz pairs: into the first block, their products with M into
    /// the second. Gives how large they are: their lengths in the norm of M, `|K x - lambda M x| / (|K x| + |lambda - sigma| |M x|)`
    /// and `r^T F^-1 r / (lambda - sigma)`.
    fn steps(&mut self, spectrum: &SymmetricSpectrum, chosen: &[usize], factor: &Factor) -> Vec<[f64; 3]> {
        let combinations = columns(&spectrum.vectors, chosen);
        let [vectors, heavy, remainders] = &mut self.blocks;
        let width = chosen.len();
        let mut vectors = vectors.first(width);
        let (mut heavy, mut remainders) = (heavy.first(width), remainders.first(width));
        tall_times(vectors.rb_mut(), Accum::Replace, self.basis.vectors(), combinations.as_ref(), 1.0);
        self.mass.times_into(vectors.rb(), heavy.rb_mut());
        self.stiffness.times_into(vectors.rb(), remainders.rb_mut());
        let pairs = remainders.rb_mut().par_col_iter_mut().zip(heavy.rb().par_col_iter()).zip(chosen);
        let residuals = pairs.map(|((mut remainder, heavy), &place)| {
            let value = spectrum.values[place];
            let scale = remainder.norm_l2() + (value - self.shift).abs() * heavy.norm_l2();
            for (entry, product) in remainder.rb_mut().iter_mut().zip(heavy.iter()) {
                *entry -= value * product;
            }
            remainder.norm_l2() / scale
        });
        let residuals: Vec<f64> = residuals.collect();
        copy(vectors.rb_mut(), remainders.rb());
        factor.solve(vectors.rb_mut());
        self.mass.times_into(vectors.rb(), heavy.rb_mut());
        let lengths = norms(vectors.rb(), heavy.rb());
        let sizes = chosen.par_iter().enumerate().map(|(column, &place)| {
            let energy: f64 = remainders.rb().col(column).transpose() * vectors.rb().col(column);
            let energy = energy.abs() / (spectrum.values[place] - self.shift).abs();
            [lengths[column], residuals[column], energy]
        });
        sizes.collect()
    }

    /// Keeps some columns of the first two blocks, ascending.
    fn keep(&mut self, kept: &[usize]) {
        for block in &mut self.blocks[..2] {
            for (place, &column) in kept.iter().enumerate() {
                if place < column {
                    let (mut to, from) = block.first(column + 1).split_at_col_mut(column);
                    to.rb_mut().col_mut(place).copy_from(from.rb().col(0));
                }
            }
        }
    }
}

/// Some columns of a matrix.
fn columns(a: &DenseMatrix, chosen: &[usize]) -> DenseMatrix {
    DenseMatrix::from_fn(a.nrows(), chosen.len(), |row, place| a[(row, chosen[place])])
}
