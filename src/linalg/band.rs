//! Eigenpairs in a band by a block Lanczos space of the inverse from its middle.
//!
//! `A = F^-1 M`, F the factor of `K - sigma M`, is symmetric in the product of M, and its eigenvalues `1 / (lambda - sigma)` are the
//! largest in magnitude where lambda is nearest. The space grows by blocks, for which the factor is loaded once, and is projected by full
//! orthogonalisation (Grimes, Lewis, Simon, SIAM J. Matrix Anal. Appl. 15 (1994) 228-272). A space that is full is cut down to its
//! best Ritz vectors (thick restart: Wu, Simon, SIAM J. Matrix Anal. Appl. 22 (2000) 602-616).

use super::basis::{Basis, times};
use super::factor::Factor;
use super::lowest::Ritz;
use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError, SymmetricSpectrum, pseudo_random, symmetric_eigen};
use faer::Accum;
use faer::linalg::matmul::matmul;
use faer::prelude::*;
use std::ops::Range;

/// Vectors that the space grows by.
const BLOCK: usize = 8;

/// Blocks between two looks at the Ritz pairs.
const LOOK: usize = 3;

/// Residual of a Ritz pair of A, relative to its value, at which it has converged. Eigenvalues converge with its square, and the
/// residuals of the equation itself are verified afterwards.
const TOLERANCE: f64 = 1e-10;

/// New spaces in a row that may find nothing new in the band.
const IDLE: usize = 2;

/// Looks after which the iteration gives up; modal problems need two to ten.
const LOOKS: usize = 200;

/// Size of the largest space for so many pairs.
pub(super) fn largest_basis(count: usize) -> usize {
    3 * count + 8 * BLOCK
}

/// The `count` pairs that lie between `low` and `high`, by counts at both ends. A block sees as many vectors of a repeated eigenvalue
/// as it has; where pairs are missing although all that are seen have converged, a new space is begun beside them.
///
/// # Errors
/// [`LinalgError::MissingModes`], [`LinalgError::DenseEigen`].
pub(super) fn between(
    mass: &SymmetricMatrix,
    (sigma, factor): &(f64, Factor),
    [low, high]: [f64; 2],
    count: usize,
) -> Result<Ritz, LinalgError> {
    let mut space = Space::new(mass, factor, largest_basis(count));
    let mut next = 2 * count + 4 * BLOCK;
    let (mut known, mut complete, mut idle) = (0, 0, 0);
    for _ in 0..LOOKS {
        let mut grows = true;
        while grows && space.done < next && space.has_room() {
            grows = space.grow()?;
        }
        let spectrum = space.ritz()?;
        let value = |place: usize| sigma + spectrum.values[place].recip();
        let inside: Vec<usize> = (0..space.done)
            .filter(|&place| value(place) > low && value(place) < high)
            .collect();
        let converged = |place: &usize| {
            space.residual(&spectrum, *place) <= TOLERANCE * spectrum.values[*place].abs()
        };
        let open = inside.iter().filter(|place| !converged(place)).count();
        known = inside.len() - open;
        if open == 0 && known == count {
            return Ok(space.pairs(&spectrum, inside, value));
        }
        if !grows {
            break;
        }
        if !space.has_room() {
            if open > 0 {
                let waiting = space.basis.size() - space.done;
                let kept = space.best(&spectrum, &inside, count + count / 2 + BLOCK);
                space.restart(&spectrum, &kept, waiting);
            } else {
                // what is missing is no part of this space: a new one beside the known pairs
                idle = if known > complete { 0 } else { idle + 1 };
                if idle == IDLE {
                    break;
                }
                complete = known;
                space.restart(&spectrum, &inside, 0);
            }
        }
        next = space.done + (LOOK * BLOCK).max(count / 4);
    }
    Err(LinalgError::MissingModes {
        below_hz: high.max(0.0).sqrt() / std::f64::consts::TAU,
        counted: count,
        found: known,
    })
}

/// A space V, `V^T M V = 1`, and the projection of A on its first vectors.
struct Space<'p> {
    mass: &'p SymmetricMatrix,
    factor: &'p Factor,
    basis: Basis<'p>,
    /// `V^T M A V` of the vectors whose images are known, upper left part.
    projected: DenseMatrix,
    /// Number of these vectors; those behind them are still to be multiplied.
    done: usize,
    /// Which of them were multiplied last: the images of the others lie in the space.
    last: Range<usize>,
    /// Products in M of what the images of the last ones have outside the space.
    outside: DenseMatrix,
    /// Seeds used so far: every new block starts elsewhere.
    started: u64,
    /// Blocks of vectors that every step overwrites.
    blocks: [DenseMatrix; 3],
}

impl<'p> Space<'p> {
    fn new(mass: &'p SymmetricMatrix, factor: &'p Factor, room: usize) -> Self {
        let order = mass.order();
        let room = room.min(order);
        Self {
            mass,
            factor,
            basis: Basis::new(mass, room),
            projected: DenseMatrix::zeros(room, room),
            done: 0,
            last: 0..0,
            outside: DenseMatrix::zeros(0, 0),
            started: 0,
            blocks: [(); 3].map(|()| DenseMatrix::zeros(order, BLOCK)),
        }
    }

    /// Whether there is room for what a step and new vectors add.
    fn has_room(&self) -> bool {
        self.basis.room() >= 2 * BLOCK || self.projected.nrows() == self.mass.order()
    }

    /// Multiplies the newest vectors, or new ones if there are none, and adds what their images have outside the space; `false` if
    /// nothing is outside.
    fn grow(&mut self) -> Result<bool, LinalgError> {
        if self.done == self.basis.size() {
            self.enrich()?;
        }
        let (begin, size) = (self.done, self.basis.size());
        let width = size - begin;
        if width == 0 {
            return Ok(false);
        }
        let [image, heavy, spare] = &mut self.blocks;
        let mut image = image.as_mut().subcols_mut(0, width);
        let mut heavy = heavy.as_mut().subcols_mut(0, width);
        let vectors = self.basis.vectors();
        self.mass
            .times_into(vectors.subcols(begin, width), image.rb_mut());
        self.factor.solve(image.rb_mut());
        self.mass.times_into(image.rb(), heavy.rb_mut());
        let along = times(vectors.transpose(), heavy.rb());
        for column in 0..width {
            for row in 0..size {
                let value = match row.checked_sub(begin) {
                    None => along[(row, column)],
                    Some(new) => 0.5 * (along[(row, column)] + along[(begin + column, new)]),
                };
                self.projected[(row, begin + column)] = value;
                self.projected[(begin + column, row)] = value;
            }
        }
        matmul(
            image.rb_mut(),
            Accum::Add,
            vectors,
            along.as_ref(),
            -1.0,
            faer::Par::Seq,
        );
        self.mass.times_into(image.rb(), heavy.rb_mut());
        self.outside = times(image.rb().transpose(), heavy.rb());
        (self.done, self.last) = (size, begin..size);
        let spare = spare.as_mut().subcols_mut(0, width);
        self.basis.extend(image, heavy, spare)?;
        Ok(true)
    }

    /// Adds new vectors.
    fn enrich(&mut self) -> Result<(), LinalgError> {
        self.started += 1;
        let start = pseudo_random(self.mass.order(), BLOCK, self.started);
        let [image, heavy, spare] = &mut self.blocks;
        let [mut image, mut heavy, spare] =
            [image, heavy, spare].map(|block| block.as_mut().subcols_mut(0, BLOCK));
        self.mass.times_into(start.as_ref(), image.rb_mut());
        self.factor.solve(image.rb_mut());
        self.mass.times_into(image.rb(), heavy.rb_mut());
        self.basis.extend(image, heavy, spare)?;
        Ok(())
    }

    fn ritz(&self) -> Result<SymmetricSpectrum, LinalgError> {
        let part = self
            .projected
            .as_ref()
            .submatrix(0, 0, self.done, self.done);
        symmetric_eigen(&part.to_owned())
    }

    /// `|A x - value x|` of a Ritz pair in the norm of M.
    fn residual(&self, spectrum: &SymmetricSpectrum, place: usize) -> f64 {
        let part = spectrum
            .vectors
            .col(place)
            .subrows(self.last.start, self.last.len());
        let square: f64 = part.transpose() * (&self.outside * part);
        square.max(0.0).sqrt()
    }

    /// These places and so many of the largest values in magnitude, ascending.
    fn best(&self, spectrum: &SymmetricSpectrum, inside: &[usize], largest: usize) -> Vec<usize> {
        let size = |place: &usize| spectrum.values[*place].abs();
        let mut kept: Vec<usize> = (0..self.done).collect();
        kept.sort_by(|a, b| size(b).total_cmp(&size(a)));
        kept.truncate(largest);
        kept.extend(inside);
        kept.sort_unstable();
        kept.dedup();
        kept
    }

    /// Keeps these Ritz vectors, and so many of the vectors that are still to be multiplied: all, or none where these pairs have
    /// converged and lie in the space alone.
    fn restart(&mut self, spectrum: &SymmetricSpectrum, kept: &[usize], waiting: usize) {
        let turn =
            DenseMatrix::from_fn(
                self.basis.size(),
                kept.len() + waiting,
                |row, column| match (row.checked_sub(self.done), column.checked_sub(kept.len())) {
                    (None, None) => spectrum.vectors[(row, kept[column])],
                    (Some(row), Some(column)) if row == column => 1.0,
                    _ => 0.0,
                },
            );
        self.basis.rotate(turn.as_ref());
        self.projected.fill(0.0);
        for (place, &old) in kept.iter().enumerate() {
            self.projected[(place, place)] = spectrum.values[old];
        }
        self.done = kept.len();
    }

    /// Ritz pairs by ascending value.
    fn pairs(
        &self,
        spectrum: &SymmetricSpectrum,
        mut places: Vec<usize>,
        value: impl Fn(usize) -> f64,
    ) -> Ritz {
        places.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
        let turn = DenseMatrix::from_fn(self.done, places.len(), |row, mode| {
            spectrum.vectors[(row, places[mode])]
        });
        let vectors = self.basis.vectors().subcols(0, self.done);
        Ritz {
            values: places.iter().map(|&place| value(place)).collect(),
            vectors: times(vectors, turn.as_ref()),
        }
    }
}
