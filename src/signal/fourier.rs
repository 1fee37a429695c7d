//! Real Fourier transforms of any length with typed errors; the one place that talks to the library.
//!
//! Window functions: sums of cosines, periodic.

use super::SignalError;
use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};
use serde::Serialize;
use std::f64::consts::PI;
use std::sync::Arc;

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

/// Window w_k = sum_j (-1)^j a_j cos(2 pi j k / n), k = 0 .. n-1 (periodic, as spectra want it, not symmetric), equal to
/// `scipy.signal.get_window(name, n)`. Source: F. J. Harris, "On the use of windows for harmonic analysis with the
/// discrete Fourier transform", Proc. IEEE 66 (1978) 51-83; the flat top's coefficients are those of SciPy (D'Antona and
/// Ferrero, "Digital Signal Processing for Measurement Systems", 2006).
///
/// | window | main lobe, bins | noise bandwidth, bins | highest side lobe |
/// |---|---|---|---|
/// | boxcar | 1 | 1 | 0.22 |
/// | Hann | 2 | 1.5 | 0.027 |
/// | Hamming | 2 | 1.36 | 0.0074 |
/// | Blackman | 3 | 1.73 | 0.0012 |
/// | flat top | 5 | 3.77 | 2e-5 |
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WindowFunction {
    /// Ones: the finest resolution, the strongest leakage.
    #[default]
    Boxcar,
    /// Raised cosine; side lobes fall by 18 dB an octave.
    Hann,
    /// Raised cosine on a pedestal, with the lowest first side lobe of two terms.
    Hamming,
    /// Three terms.
    Blackman,
    /// Five terms: a line between two bins reads its amplitude to 0.1 %.
    FlatTop,
}

impl WindowFunction {
    /// a_0, a_1, ...
    fn terms(self) -> &'static [f64] {
        match self {
            Self::Boxcar => &[1.0],
            Self::Hann => &[0.5, 0.5],
            Self::Hamming => &[0.54, 0.46],
            Self::Blackman => &[0.42, 0.5, 0.08],
            Self::FlatTop => &[0.215_578_95, 0.416_631_58, 0.277_263_158, 0.083_578_947, 0.006_947_368],
        }
    }

    /// The window's n samples.
    pub fn samples(self, n: usize) -> Vec<f64> {
        let value = |k: usize| {
            let terms = self.terms().iter().enumerate();
            let cosines = terms.map(|(j, a)| {
                let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
                sign * a * (2.0 * PI * (j * k % n) as f64 / n as f64).cos()
            });
            cosines.sum()
        };
        (0..n).map(value).collect()
    }

    /// Distance from the main lobe's peak to its first zero in natural bins, 1 / duration: lines closer than that are
    /// not separated, however finely the spectrum is padded.
    pub(crate) fn main_lobe_bins(self) -> f64 {
        self.terms().len() as f64
    }

    /// Most that a line shows at a distance of so many natural bins, relative to its own height: 1 within the main lobe,
    /// |sum_j (-1)^j a_j d / (d^2 - j^2)| / (pi a_0) at d beyond it (the transform of the cosines with its sine at 1).
    pub fn leakage(self, bins: f64) -> f64 {
        let d = bins.abs();
        if d < self.main_lobe_bins() {
            return 1.0;
        }
        let terms = self.terms().iter().enumerate();
        let sum: f64 = terms
            .map(|(j, a)| {
                let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
                sign * a * d / (d * d - (j * j) as f64)
            })
            .sum();
        sum.abs() / (PI * self.terms()[0])
    }
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

#[cfg(test)]
mod window_function_tests {
    use super::*;

    const ALL: [WindowFunction; 5] = [
        WindowFunction::Boxcar,
        WindowFunction::Hann,
        WindowFunction::Hamming,
        WindowFunction::Blackman,
        WindowFunction::FlatTop,
    ];

    /// |sum w exp(-2 pi i k d / n)| / sum w.
    fn response(window: WindowFunction, n: usize, d: f64) -> f64 {
        let (mut re, mut im, mut sum) = (0.0, 0.0, 0.0);
        for (k, w) in window.samples(n).into_iter().enumerate() {
            let angle = 2.0 * PI * k as f64 * d / n as f64;
            re += w * angle.cos();
            im += w * angle.sin();
            sum += w;
        }
        f64::hypot(re, im) / sum
    }

    #[test]
    fn the_main_lobe_ends_where_stated() {
        for window in ALL {
            let lobe = window.main_lobe_bins();
            assert!(response(window, 500, lobe) < 1e-14, "{window:?}");
            // no zero before it: with the rounded coefficients of the flat top the least is 2e-5
            let steps = (1..100).map(|k| lobe * f64::from(k) / 100.0);
            let least = steps.fold(1.0, |w: f64, d| w.min(response(window, 500, d)));
            assert!(least > 1e-6, "{window:?}: {least:e}");
        }
    }

    #[test]
    fn leakage_is_a_bound_that_is_reached() {
        for window in ALL {
            for k in 0..50 {
                let d = window.main_lobe_bins() + 0.673 * f64::from(k);
                let found = response(window, 20_000, d);
                // the sums over 20 000 samples differ from the integrals by (d / n)^2 of them
                assert!(found < window.leakage(d) * (1.0 + 1e-4) + 1e-8, "{window:?} {d}");
            }
            let half = 20.5;
            let reached = response(window, 20_000, half) / window.leakage(half);
            assert!((reached - 1.0).abs() < 0.01, "{window:?}: {reached}");
            assert!((window.leakage(0.5) - 1.0).abs() < 1e-15);
        }
    }
}
