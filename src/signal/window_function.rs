//! Window functions: sums of cosines, periodic.

use std::f64::consts::PI;

use serde::Serialize;

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
    pub fn main_lobe_bins(self) -> f64 {
        self.terms().len() as f64
    }

    /// Equivalent noise bandwidth n sum w^2 / (sum w)^2 in natural bins, 1 / duration (for n above twice the number of
    /// terms).
    pub fn noise_bandwidth_bins(self) -> f64 {
        let terms = self.terms();
        let cosines: f64 = terms[1..].iter().map(|a| 0.5 * a * a).sum();
        1.0 + cosines / (terms[0] * terms[0])
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
    fn noise_bandwidth_is_that_of_the_samples() {
        for window in ALL {
            let w = window.samples(400);
            let (sum, squares): (f64, f64) = (w.iter().sum(), w.iter().map(|w| w * w).sum());
            let expected = 400.0 * squares / (sum * sum);
            assert!((window.noise_bandwidth_bins() / expected - 1.0).abs() < 1e-13);
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
