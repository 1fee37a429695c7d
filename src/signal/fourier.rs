//! Real Fourier transforms of any length with typed errors; the one place that talks to the library.

use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

use super::SignalError;

/// Most points that a transform may have: 2^28, 2 GiB of samples.
pub(super) const MOST_POINTS: usize = 1 << 28;

/// A transform of one length, planned once for many signals.
pub(crate) struct Forward(Arc<dyn RealToComplex<f64>>);

impl Forward {
    /// Transform over `points` N.
    pub(crate) fn new(points: usize) -> Self {
        Self(RealFftPlanner::new().plan_fft_forward(points))
    }

    /// Spectrum X_m = sum_n x_n exp(-2 pi i m n / N), m = 0 ..= N/2, of x padded with zeros to N (cut if longer). Not
    /// scaled.
    pub(crate) fn transform(&self, values: impl IntoIterator<Item = f64>) -> Result<Vec<Complex<f64>>, SignalError> {
        let mut input = self.0.make_input_vec();
        for (slot, value) in input.iter_mut().zip(values) {
            *slot = value;
        }
        let mut output = self.0.make_output_vec();
        let points = self.0.len();
        self.0.process(&mut input, &mut output).map_err(|source| SignalError::transform(points, source))?;
        Ok(output)
    }
}

/// [`Forward`] for one signal.
pub(super) fn forward(values: &[f64], points: usize) -> Result<Vec<Complex<f64>>, SignalError> {
    Forward::new(points).transform(values.iter().copied())
}

/// Inverse of [`forward`], scaled by 1/N: N real values from N/2 + 1 bins. The imaginary parts of the bins at zero
/// and at half the rate, which a real signal does not have, are dropped.
pub(super) fn inverse(mut bins: Vec<Complex<f64>>, points: usize) -> Result<Vec<f64>, SignalError> {
    if let Some(zero) = bins.first_mut() {
        zero.im = 0.0;
    }
    if points.is_multiple_of(2)
        && let Some(nyquist) = bins.last_mut()
    {
        nyquist.im = 0.0;
    }
    let plan = RealFftPlanner::<f64>::new().plan_fft_inverse(points);
    let mut output = plan.make_output_vec();
    plan.process(&mut bins, &mut output).map_err(|source| SignalError::transform(points, source))?;
    let scale = 1.0 / points as f64;
    output.iter_mut().for_each(|v| *v *= scale);
    Ok(output)
}

/// Smallest even N >= `needed` whose prime factors are 2, 3 and 5: lengths that transform fast.
pub(crate) fn fast_length(needed: usize) -> usize {
    let mut best = needed.max(2).next_power_of_two();
    let mut fives = 1;
    while fives < best {
        let mut threes = fives;
        while threes < best {
            let twos = needed.div_ceil(threes).max(2).next_power_of_two();
            best = best.min(threes * twos);
            threes *= 3;
        }
        fives *= 5;
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fast_lengths_are_the_smallest() {
        // Against a search by hand of even 5-smooth numbers.
        for (needed, expected) in [(1, 2), (7, 8), (11, 12), (13, 16), (17, 18), (97, 100), (401, 432)] {
            assert_eq!(fast_length(needed), expected, "needed {needed}");
        }
        let smooth = |mut n: usize| {
            for p in [2, 3, 5] {
                while n.is_multiple_of(p) {
                    n /= p;
                }
            }
            n == 1
        };
        for needed in (2..5000_usize).step_by(37) {
            let expected = (needed..).find(|n| n.is_multiple_of(2) && smooth(*n));
            assert_eq!(Some(fast_length(needed)), expected, "needed {needed}");
        }
    }

    #[test]
    fn inverse_gives_the_signal_back() {
        for points in [9, 10, 97] {
            let x: Vec<f64> = (0..points).map(|k| ((k * k) as f64 * 0.7).sin()).collect();
            let back = inverse(forward(&x, points).expect("forward"), points).expect("inverse");
            for (a, b) in x.iter().zip(&back) {
                assert!((a - b).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn one_bin_of_a_small_transform() {
        // x = 1, 2, 3: X_1 = 1 + 2 exp(-2 pi i / 3) + 3 exp(-4 pi i / 3) = -3/2 + i sqrt(3)/2.
        let bins = forward(&[1.0, 2.0, 3.0], 3).expect("forward");
        assert!((bins[1].re + 1.5).abs() < 1e-15);
        assert!((bins[1].im - 0.75_f64.sqrt()).abs() < 1e-15);
    }
}
