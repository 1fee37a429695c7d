//! Modes of a structure with everything that proves them.

use crate::numerics::Told;
use crate::numerics::linalg::{DenseMatrix, EigenProblem, EigenTimes, FactorChoice, LinalgError, symmetric_eigen};
use schemars::JsonSchema;
use serde::Serialize;
use std::f64::consts::TAU;

/// Error bounds below which an eigenvalue counts as zero: the bound itself is an estimate.
const ZERO: f64 = 4.0;

/// Eigenvalues up to so many times their bound are computed again from the energies of elements. Those beyond have
/// four digits of their own, and mix with the ones below by a ten-thousandth at most.
const NEAR_ZERO: f64 = 1e4;

/// Part of a frequency, of a rigid mode of the first elastic one's, above which an error bound leaves the mode unknown.
const UNKNOWN: f64 = 0.1;

/// Which modes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ModeRange {
    /// The lowest so many, at least 1.
    Count(usize),
    /// The lowest so many, at least 1, or all if there are fewer.
    #[serde(rename = "count")]
    AtMost(usize),
    /// All below a frequency in Hz, > 0.
    UpToHz(f64),
    /// All between two frequencies in Hz, 0 <= low < high.
    BandHz([f64; 2]),
}

impl ModeRange {
    /// In words, with the key of the case file.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Count(count) | Self::AtMost(count) => {
                format!("among the lowest {count} (count)")
            }
            Self::UpToHz(hz) => format!("up to {hz} Hz (up_to_hz)"),
            Self::BandHz([low, high]) => format!("from {low} to {high} Hz (band_hz)"),
        }
    }
}

/// The proof that no mode is missing: Sylvester's law of inertia at one or two shifts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct FrequencyCount {
    /// Frequency above which was counted, Hz; `None`: from zero.
    pub above_hz: Option<f64>,
    /// Frequency below which was counted, Hz.
    pub below_hz: f64,
    /// Modes that exist there, from the signs of the pivots of `K - sigma M`.
    pub counted: usize,
    /// Modes that were found there.
    pub found: usize,
}

/// Modes Phi of `K phi = lambda M phi`, mass-normalised, with what is known of their accuracy.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ModalBasis {
    /// Eigenvalues lambda, 1/s^2, ascending.
    #[serde(skip)]
    pub eigenvalues: Vec<f64>,
    /// Frequencies `sqrt(lambda) / 2 pi`, Hz, ascending; zero for an eigenvalue that round-off made negative.
    pub frequencies_hz: Vec<f64>,
    /// How far each frequency may be from that of the same matrices in exact arithmetic, Hz.
    pub error_bounds_hz: Vec<f64>,
    /// Modes without strain energy: those whose energy `phi^T K phi = lambda` is zero within four times its error
    /// bound. They come first. How small an energy can be told from zero depends on how it was summed.
    pub rigid_modes: usize,
    /// `|K phi - lambda M phi|` relative to its terms.
    pub residuals: Vec<f64>,
    /// Shapes [n x count], `Phi^T M Phi = 1`.
    #[serde(skip)]
    pub shapes: DenseMatrix,
    /// Largest entry of `Phi^T M Phi - 1`.
    pub orthogonality: f64,
    /// The proof that no mode is missing.
    pub count_check: FrequencyCount,
    /// Shift of the factorisation, 1/s^2.
    pub shift: f64,
    /// Who factorised, if not plummer itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factor: Option<FactorChoice>,
    /// Wall time of the eigenvalue computation, s.
    #[serde(rename = "eigen_s")]
    pub times: EigenTimes,
    /// How far each eigenvalue may be from that of the same matrices in exact arithmetic, 1/s^2.
    #[serde(skip)]
    bounds: Vec<f64>,
    /// Part of the bound that is round-off of `phi^T K phi`, 1/s^2.
    #[serde(skip)]
    rounding: Vec<f64>,
}

impl ModalBasis {
    /// The modes of a problem.
    ///
    /// # Errors
    /// [`LinalgError`] of factorisation, iteration or proof.
    pub fn of(problem: &EigenProblem, range: ModeRange) -> Result<Self, LinalgError> {
        Self::told(problem, range, &|_| {})
    }

    /// The same; `told` hears which part is found.
    ///
    /// # Errors
    /// As [`ModalBasis::of`].
    pub(crate) fn told(problem: &EigenProblem, range: ModeRange, told: Told<'_>) -> Result<Self, LinalgError> {
        let pairs = match range {
            ModeRange::Count(count) => problem.lowest_told(count, told),
            ModeRange::AtMost(count) => problem.lowest_told(count.min(problem.order()).max(1), told),
            ModeRange::UpToHz(high) => problem.below(squared(high), told),
            ModeRange::BandHz([low, high]) => problem.between(squared(low), squared(high), told),
        }?;
        let check = pairs.count_check;
        let mut basis = Self {
            rigid_modes: 0,
            frequencies_hz: Vec::new(),
            error_bounds_hz: Vec::new(),
            eigenvalues: pairs.values,
            residuals: pairs.residuals,
            shapes: pairs.vectors,
            orthogonality: pairs.orthogonality,
            count_check: FrequencyCount {
                above_hz: check.above.map(hz),
                below_hz: hz(check.below),
                counted: check.counted,
                found: check.found,
            },
            shift: pairs.shift,
            factor: problem.factor_choice(),
            times: pairs.times,
            bounds: pairs.bounds,
            rounding: pairs.rounding,
        };
        basis.judge();
        Ok(basis)
    }

    /// The modes of a problem with those near zero [sharpened](Self::sharpen): their whole space is computed where the range cuts it, for
    /// a part of it is a mixture of all. What lies beyond the range is left out then, and rigid modes of a range from above zero.
    /// `products` gives `Phi^T K Phi` [count x count] of shapes Phi [n x count] without assembling K.
    ///
    /// # Errors
    /// [`LinalgError`] of factorisation, iteration or proof, and what `products` reports.
    pub(crate) fn sharpened<E: From<LinalgError>>(
        problem: &EigenProblem,
        range: ModeRange,
        products: impl FnOnce(&DenseMatrix) -> Result<DenseMatrix, E>,
        told: Told<'_>,
    ) -> Result<Self, E> {
        let near = hz(NEAR_ZERO * problem.rounding_of_zero());
        let computed = match range {
            ModeRange::UpToHz(high) | ModeRange::BandHz([_, high]) if high < near => ModeRange::UpToHz(near),
            ModeRange::BandHz([low, high]) if low < near => ModeRange::UpToHz(high),
            _ => range,
        };
        let mut basis = Self::told(problem, computed, told)?;
        let counted = basis.count_check.counted;
        if basis.near_zero() == basis.count()
            && matches!(range, ModeRange::Count(count) | ModeRange::AtMost(count) if count < counted)
        {
            basis = Self::told(problem, ModeRange::Count(counted), told)?;
        }
        basis.sharpen(products)?;
        basis.keep(range);
        Ok(basis)
    }

    /// Leaves out what lies beyond a range.
    fn keep(&mut self, range: ModeRange) {
        let lies_in = |mode: &usize| {
            let (value, bound) = (self.eigenvalues[*mode], self.bounds[*mode]);
            match range {
                ModeRange::Count(count) | ModeRange::AtMost(count) => *mode < count,
                ModeRange::UpToHz(high) => value - bound <= squared(high),
                ModeRange::BandHz([low, high]) => {
                    let begins = low <= 0.0 || *mode >= self.rigid_modes && value + bound >= squared(low);
                    begins && value - bound <= squared(high)
                }
            }
        };
        let kept: Vec<usize> = (0..self.count()).filter(lies_in).collect();
        if kept.len() == self.count() {
            return;
        }
        let numbers = [&mut self.eigenvalues, &mut self.bounds, &mut self.rounding, &mut self.residuals];
        for numbers in numbers {
            *numbers = kept.iter().map(|&mode| numbers[mode]).collect();
        }
        let shapes = &self.shapes;
        self.shapes = DenseMatrix::from_fn(shapes.nrows(), kept.len(), |row, mode| shapes[(row, kept[mode])]);
        self.judge();
    }

    /// What follows from eigenvalues and bounds.
    fn judge(&mut self) {
        let both = || self.eigenvalues.iter().zip(&self.bounds);
        let zero = |(value, bound): &(&f64, &f64)| value.abs() <= ZERO * **bound;
        self.rigid_modes = both().filter(zero).count();
        // the larger of both sides; near zero that is the square root of the bound
        self.error_bounds_hz = both()
            .map(|(&value, &bound)| {
                let (low, high) = (hz(value - bound), hz(value + bound));
                (high - hz(value)).max(hz(value) - low)
            })
            .collect();
        self.frequencies_hz = self.eigenvalues.iter().map(|&value| hz(value)).collect();
    }

    /// Modes of which nothing is known, as their bounds are of the order of the frequencies: round-off of the stiffness hides
    /// them. Without an elastic mode beside them those are all rigid ones, if there are more than the `free` motions of the model.
    pub(crate) fn unknown(&self, free: Option<usize>) -> Vec<usize> {
        let first = self.frequencies_hz.get(self.rigid_modes).copied();
        let is_unknown = |(mode, (frequency, bound)): (usize, (&f64, &f64))| match first {
            Some(first) => *bound > UNKNOWN * if mode < self.rigid_modes { first } else { *frequency },
            None => free.is_some_and(|free| self.rigid_modes > free),
        };
        let modes = self.frequencies_hz.iter().zip(&self.error_bounds_hz).enumerate();
        modes.filter(|mode| is_unknown(*mode)).map(|(mode, _)| mode).collect()
    }

    /// Computes the modes again that the matrices cannot tell from rigid ones, from strain energies that were summed
    /// without assembling K. `products` gives `Phi^T K Phi` [count x count] of shapes Phi [n x count].
    ///
    /// An entry of K is a sum over elements, rounded: of a rigid motion it leaves `rho`, about eps times the stiffest
    /// eigenvalue, where zero should be. On a support softer than that, all modes look alike and are mixed. Their space
    /// is right, though: the modes are found in it by the energies of the elements. What rounding has mixed in
    /// from other modes has an energy of `rho^2 / lambda` at most, lambda the next eigenvalue (second order, as for any
    /// Rayleigh quotient), and this takes the place of rho in the bound.
    ///
    /// # Errors
    /// What `products` reports, and [`LinalgError`] if it has numbers that are not finite.
    pub fn sharpen<E: From<LinalgError>>(
        &mut self,
        products: impl FnOnce(&DenseMatrix) -> Result<DenseMatrix, E>,
    ) -> Result<(), E> {
        let count = self.near_zero();
        if count == 0 {
            return Ok(());
        }
        let space = self.shapes.subcols(0, count).to_owned();
        let energies = products(&space)?;
        if energies.nrows() != count || energies.ncols() != count {
            return Err(LinalgError::Shape {
                what: "energies of the modes",
                expected: count,
                found: energies.nrows().min(energies.ncols()),
            }
            .into());
        }
        let finite = |column| energies.col_as_slice(column).iter().all(|e: &f64| e.is_finite());
        if !(0..count).all(finite) {
            return Err(LinalgError::DenseEigen { order: count }.into());
        }
        let found = symmetric_eigen(&energies)?;
        let largest = |values: &[f64]| values.iter().take(count).copied().fold(0.0, f64::max);
        let rounding = largest(&self.rounding);
        let residual = largest(&self.residuals);
        let others = (self.bounds.iter().zip(&self.rounding).take(count))
            .map(|(bound, rounding)| bound - rounding)
            .fold(0.0, f64::max);
        let mixed = rounding * (rounding / self.next_after(count).max(rounding)).min(1.0);
        let dense = count as f64 * f64::EPSILON * energies.norm_max();
        let turned = &space * &found.vectors;
        for (mode, value) in found.values.into_iter().enumerate().take(count) {
            self.eigenvalues[mode] = value;
            self.rounding[mode] = mixed + dense;
            self.bounds[mode] = others + mixed + dense;
            self.residuals[mode] = residual;
            self.shapes.col_as_slice_mut(mode).copy_from_slice(turned.col_as_slice(mode));
        }
        self.judge();
        Ok(())
    }

    /// How many of the first eigenvalues the matrices do not tell well from zero.
    fn near_zero(&self) -> usize {
        let near = |(value, bound): &(&f64, &f64)| value.abs() <= NEAR_ZERO * **bound;
        let both = self.eigenvalues.iter().zip(&self.bounds);
        both.take_while(near).count()
    }

    /// An eigenvalue that all after the first `count` reach, 1/s^2; zero if nothing is known of them.
    fn next_after(&self, count: usize) -> f64 {
        let check = self.count_check;
        match self.eigenvalues.get(count) {
            Some(&next) => next,
            None if check.above_hz.is_none() && check.found == count => squared(check.below_hz),
            None => 0.0,
        }
    }

    /// Number of modes.
    pub fn count(&self) -> usize {
        self.eigenvalues.len()
    }
}

fn squared(hz: f64) -> f64 {
    (TAU * hz).powi(2)
}

fn hz(eigenvalue: f64) -> f64 {
    eigenvalue.max(0.0).sqrt() / TAU
}

#[cfg(test)]
#[path = "basis_tests.rs"]
mod tests;
