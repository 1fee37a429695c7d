//! Many pairs: the spectrum is cut into slices, the eigenvalues below every cut are counted, and each slice is solved
//! from its middle (Grimes, Lewis, Simon, SIAM J. Matrix Anal. Appl. 15 (1994) 228-272).
//!
//! One search for all of them would need a space three times as large, in which the round-off of the highest Ritz values
//! hides the lowest ones: of 1029 degrees of freedom it found 100 pairs at once, and 150 never.

use super::super::basis::times;
use super::super::{CountCheck, DenseMatrix, EigenPairs, EigenProblem, EigenTimes, LinalgError, band};
use super::cuts::{ABOVE, Cut, check_of};
use crate::numerics::Told;
use std::time::Instant;

/// Pairs that a slice should have.
const SLICE: usize = 64;

/// Most pairs of a slice, unless they are so close that there is no place to cut.
const MOST: usize = 3 * SLICE / 2;

/// Fewest, unless no more are wanted: each slice costs two factorisations.
const FEWEST: usize = SLICE / 4;

/// Length of a slice that is not cut again, relative to where it begins.
const SHORTEST: f64 = 1e-5;

/// Share of a slice's end that its last value must reach, or the middle is moved towards it.
const FAR: f64 = 0.25;

/// Places tried for a cut.
const TRIES: usize = 40;

/// Pairs searched for at once before slices.
pub(super) const FIRST: usize = 32;

/// Largest product of two vectors of different slices: they are right to the root of the residuals' tolerance; one found
/// twice leaves 1.
const LARGEST_COUPLING: f64 = 1e-4;

impl EigenProblem {
    /// The `count` lowest pairs: the first by one search, which knows rigid motions, those beyond slice by slice.
    pub(super) fn lowest_in_slices(&self, count: usize, told: Told<'_>) -> Result<EigenPairs, LinalgError> {
        // the gap behind the first pairs may lie some pairs further: these are asked for too. A search that ends in a crowd takes more,
        // until it ends behind it
        let mut asked = FIRST;
        let mut cut: Option<Cut> = None;
        let (first, start) = loop {
            let first = self.lowest_at_once(asked, &|part| told(part * asked as f64 / count as f64))?;
            let check = first.count_check;
            let own = (check.below, check.counted);
            let closed = |cut: &Cut| {
                let last = first.values.last();
                cut.1 == first.values.len() && last.is_some_and(|last| *last < cut.0)
            };
            if let Some(cut) = [Some(own), cut].into_iter().flatten().find(closed) {
                break (first, cut);
            }
            asked = if own.1 > asked {
                cut = Some(own);
                own.1
            } else {
                asked + 1 + asked / 8
            };
            if asked > count {
                return Err(LinalgError::no_gap(count));
            }
        };
        let (slices, end) = self.slices(start, count, None, told)?;
        let parts = std::iter::once(first).chain(slices).collect();
        let mut pairs = self.joined(parts)?;
        pairs.count_check = CountCheck::from_lowest(end.0, end.1, pairs.values.len());
        pairs.keep(0..count);
        Ok(pairs)
    }

    /// Whether a slice may be too large for the problem's order.
    pub(super) fn is_too_small_for_slices(&self) -> bool {
        band::largest_basis(MOST) > self.order()
    }

    /// The pairs from one cut on, slice by slice, until `wanted` eigenvalues of the problem lie below the last cut, which
    /// is returned too. With `end` that is the last cut, and its count is `wanted`.
    ///
    /// # Errors
    /// [`LinalgError::TooManyModes`] if the problem has fewer; what factorisation and iteration report.
    pub(super) fn slices(
        &self,
        start: Cut,
        wanted: usize,
        end: Option<f64>,
        told: Told<'_>,
    ) -> Result<(Vec<EigenPairs>, Cut), LinalgError> {
        let mut slices = Vec::new();
        let mut low = start;
        while low.1 < wanted {
            told(low.1 as f64 / wanted as f64);
            let started = Instant::now();
            let high = self.next_cut(low, wanted, end)?;
            let elapsed = started.elapsed().as_secs_f64();
            if high.1 > low.1 {
                let mut pairs = self.slice(low, high)?;
                pairs.times.count += elapsed;
                slices.push(pairs);
            }
            low = high;
        }
        Ok((slices, low))
    }

    /// Pairs one behind the other, of which each slice is orthogonal by itself.
    ///
    /// What a pair j has of another slice's pair i is taken out to first order, `x_i' (K - l_j M) x_j / (l_j - l_i)`: then the vectors are
    /// orthogonal in mass and in stiffness.
    pub(super) fn joined(&self, parts: Vec<EigenPairs>) -> Result<EigenPairs, LinalgError> {
        let slices: Vec<usize> =
            parts.iter().enumerate().flat_map(|(slice, part)| part.values.iter().map(move |_| slice)).collect();
        let mut pairs = EigenPairs::one_behind_the_other(parts, self.order());
        let coupling = |vectors: &DenseMatrix| {
            let heavy = self.mass_times(vectors);
            let gram = times(vectors.transpose(), heavy.as_ref());
            gram - DenseMatrix::identity(vectors.ncols(), vectors.ncols())
        };
        let (values, count) = (&pairs.values, pairs.values.len());
        let mass = coupling(&pairs.vectors);
        if mass.norm_max() > LARGEST_COUPLING {
            let last = values.last().copied().unwrap_or(0.0);
            return Err(CountCheck::from_lowest(last, count, count - 1).missing());
        }
        let stiff = self.stiffness_times(&pairs.vectors);
        let stiff = times(pairs.vectors.transpose(), stiff.as_ref());
        let foreign = DenseMatrix::from_fn(count, count, |i, j| {
            let apart = values[j] - values[i];
            if slices[i] != slices[j] && apart.abs() > SHORTEST * values[j].abs() {
                (stiff[(i, j)] - values[j] * mass[(i, j)]) / apart
            } else if i < j {
                // of one slice, or too close to part the two: orthogonal in mass alone
                -mass[(i, j)]
            } else {
                0.0
            }
        });
        pairs.vectors += times(pairs.vectors.as_ref(), foreign.as_ref());
        for (mode, residual) in pairs.residuals.iter_mut().enumerate() {
            *residual += foreign.col(mode).norm_l2();
        }
        pairs.orthogonality = coupling(&pairs.vectors).norm_max();
        Ok(pairs)
    }

    /// The pairs between two cuts, from a factor in the middle.
    fn slice(&self, low: Cut, high: Cut) -> Result<EigenPairs, LinalgError> {
        let count = high.1 - low.1;
        let mut times = EigenTimes::default();
        let mut reach = high.0;
        let (middle, ritz) = loop {
            let started = Instant::now();
            let middle = self.middle_factor(low.0, reach)?;
            times.factor += started.elapsed().as_secs_f64();
            let started = Instant::now();
            let ends = [low.0, high.0];
            let ritz = band::between(&self.stiffness, &self.mass, &middle, ends, count);
            // a factor that fails makes no pairs, whatever the iteration says of that
            middle.1.check()?;
            let ritz = ritz?;
            times.iterate += started.elapsed().as_secs_f64();
            // seen from far above all pairs look alike
            match ritz.values.last() {
                Some(&last) if last < FAR * reach => reach = 2.0 * last,
                _ => break (middle, ritz),
            }
        };
        let started = Instant::now();
        let (sigma, factor) = middle;
        let pairs = EigenPairs::judged(&self.stiffness, &self.mass, &factor, sigma, &ritz, count);
        factor.check()?;
        times.iterate += started.elapsed().as_secs_f64();
        self.finished(pairs, check_of(low, high), times)
    }

    /// Where the next slice ends.
    fn next_cut(&self, low: Cut, wanted: usize, end: Option<f64>) -> Result<Cut, LinalgError> {
        let left = wanted - low.1;
        if let (true, Some(end)) = (left <= MOST, end) {
            return Ok((end, wanted));
        }
        let aim = if left <= MOST { left } else { SLICE };
        // eigenvalues grow about as their number; of three dimensions as its power 2/3
        let mut step = match end {
            Some(end) => (end - low.0) * aim as f64 / left as f64,
            None => low.0.abs() * aim as f64 / low.1.max(1) as f64,
        };
        let (mut few, mut many) = (low, None);
        for _ in 0..TRIES {
            let value = low.0 + step;
            if end.is_some_and(|end| value >= end) {
                return Ok((end.unwrap_or(value), wanted));
            }
            let cut = self.count_near(value, ABOVE)?;
            let found = cut.1.saturating_sub(low.1);
            if found > MOST && step > SHORTEST * low.0.abs() {
                many = Some(cut.0);
            } else if found < FEWEST && cut.1 < wanted && many.is_none_or(|many| many - few.0 > SHORTEST * few.0.abs())
            {
                few = cut;
                if value > self.above_all() {
                    return Err(LinalgError::TooManyModes { asked: wanted, available: cut.1 });
                }
            } else {
                return Ok(cut);
            }
            let factor = aim as f64 / found.max(1) as f64;
            step = match many {
                Some(many) => {
                    let within = [few.0 - low.0, many - low.0];
                    let tenth = 0.1 * (within[1] - within[0]);
                    (step * factor).clamp(within[0] + tenth, within[1] - tenth)
                }
                None => step * factor.clamp(1.5, 4.0),
            };
        }
        Err(LinalgError::no_gap(wanted))
    }
}
