//! The analytic Morlet wavelet, calibrated to read amplitudes at exact frequencies.

use std::f64::consts::PI;

/// Distance from a Gaussian's centre, in standard deviations, beyond which it is below 1e-16: sqrt(2 ln 1e16).
pub(super) const REACH: f64 = 8.6;

/// Morlet wavelet of w0 = `cycles` with its mean removed, given by its response to a tone. With nu = f' / f the tone's
/// frequency over the wavelet's,
///
/// Psi(nu) = 2 g(w_p nu) / g(w_p),  g(w) = exp(-(w - w0)^2 / 2) - exp(-(w0^2 + w^2) / 2) for w > 0, else 0,
///
/// and w_p = w0 / (1 - exp(-w0 w_p)) where g is largest: the response is largest at the very frequency that names the
/// wavelet, and 2 there, so that A cos(2 pi f t) gives magnitude A. (With w_p = w0, as often seen, or with another scale's
/// frequency a tone is read off its place, more so the fewer the cycles.) The envelope is a Gaussian with a standard
/// deviation of w_p / (2 pi f) seconds, the response one of f w0 / w_p^2 hertz, about f / cycles.
///
/// Source: I. Daubechies, "Ten Lectures on Wavelets", SIAM, 1992, chapter 3; C. Torrence and G. P. Compo,
/// "A practical guide to wavelet analysis", Bull. Am. Meteorological Society 79 (1998) 61-78 (analytic form, cone of
/// influence).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Morlet {
    cycles: f64,
    peak: f64,
    scale: f64,
}

impl Morlet {
    /// Wavelet of so many cycles w0 >= 2.
    pub(super) fn new(cycles: f64) -> Self {
        // contracts by w0^2 exp(-w0^2), 0.07 at two cycles
        let peak = (0..20).fold(cycles, |w, _| cycles / (1.0 - (-cycles * w).exp()));
        let mut wavelet = Self { cycles, peak, scale: 1.0 };
        wavelet.scale = 2.0 / wavelet.shape(peak);
        wavelet
    }

    fn shape(&self, w: f64) -> f64 {
        let from_centre = w - self.cycles;
        (-0.5 * from_centre * from_centre).exp() * -(-self.cycles * w).exp_m1()
    }

    /// Psi at a tone's frequency over the wavelet's, > 0.
    pub(super) fn response(&self, ratio: f64) -> f64 {
        self.scale * self.shape(self.peak * ratio)
    }

    /// Ratios between which the response is above 1e-16 of its peak.
    pub(super) fn band(&self) -> (f64, f64) {
        let edge = |deviations: f64| (self.cycles + deviations) / self.peak;
        (edge(-REACH).max(0.0), edge(REACH))
    }

    /// Standard deviation of the envelope at a frequency, s.
    pub(super) fn deviation_s(&self, frequency_hz: f64) -> f64 {
        self.peak / (2.0 * PI * frequency_hz)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_response_is_two_and_largest_at_its_own_frequency() {
        for cycles in [2.0, 3.0, 5.0, 6.0, 20.0, 200.0] {
            let wavelet = Morlet::new(cycles);
            assert!((wavelet.response(1.0) - 2.0).abs() < 1e-14);
            // curvature is cycles^2: 1e-4 beside the peak it is lower by (1e-4 cycles)^2, the same to both sides
            let (below, above) = (wavelet.response(1.0 - 1e-4), wavelet.response(1.0 + 1e-4));
            assert!(below < 2.0 && above < 2.0, "{cycles}");
            let asymmetry = (below - above).abs() / (4.0 - below - above);
            assert!(asymmetry < 1e-3, "{cycles}: {asymmetry}");
        }
    }

    #[test]
    fn the_response_vanishes_at_zero_and_outside_its_band() {
        for cycles in [2.0, 6.0, 40.0] {
            let wavelet = Morlet::new(cycles);
            let (low, high) = wavelet.band();
            assert!(wavelet.response(high) < 2.0 * 1.1e-16, "{cycles}");
            assert!(wavelet.response(low) < 2.0 * 1.1e-16, "{cycles}");
            assert!(wavelet.response(high * (1.0 - 0.3 / (cycles + 8.6))) > 2e-16);
        }
    }
}
