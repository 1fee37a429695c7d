//! Linear-phase low-pass filters by the Kaiser window, for the decimator and for band-limiting.
//!
//! Source: J. F. Kaiser, "Nonrecursive digital filter design using the I0-sinh window function", Proc. IEEE ISCAS
//! 1974, as in Oppenheim & Schafer, "Discrete-Time Signal Processing", 3rd ed., eq. (7.75) and (7.76).

use std::f64::consts::PI;

use super::time_series::{SeriesError, check_step};

/// Symmetric (zero-phase when centred) low-pass taps h_m, m = -half ..= half, with sum h_m = 1:
///
/// h_m = 2 fc sinc(2 fc m) I0(beta sqrt(1 - (m / half)^2)) / I0(beta), fc the cut-off in cycles per sample.
///
/// Pass-band ripple and stop-band level are equal, 10^(-A/20) for an attenuation of A dB, and the gain at fc is 1/2.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KaiserLowPass {
    half_taps: Vec<f64>,
}

impl KaiserLowPass {
    /// The shortest filter for samples every `step_s` seconds that passes up to `pass_hz`, stops from `stop_hz` on
    /// and attenuates by `attenuation_db` (21 dB at least; less is raised to it).
    ///
    /// # Errors
    /// [`SeriesError`] for the step, and unless 0 < pass < stop <= 1 / (2 step).
    pub(crate) fn new(step_s: f64, pass_hz: f64, stop_hz: f64, attenuation_db: f64) -> Result<Self, SeriesError> {
        check_step(step_s)?;
        let nyquist_hz = 0.5 / step_s;
        if !(pass_hz > 0.0 && pass_hz < stop_hz && stop_hz <= nyquist_hz * (1.0 + 1e-12)) {
            return Err(SeriesError(format!(
                "low-pass edges must satisfy 0 < pass < stop <= {nyquist_hz} Hz (half the sampling rate), found pass \
                 {pass_hz} Hz, stop {stop_hz} Hz"
            )));
        }
        let attenuation_db = attenuation_db.max(21.0);
        let transition = 2.0 * PI * (stop_hz - pass_hz) * step_s;
        let half = half_length(attenuation_db, transition).ceil() as usize;
        let cut_off = 0.5 * (pass_hz + stop_hz) * step_s;
        Ok(Self::windowed(cut_off, half, beta(attenuation_db)))
    }

    /// Taps for a cut-off in cycles per sample, `half` taps on each side and the window parameter `beta`.
    pub(super) fn windowed(cut_off: f64, half: usize, beta: f64) -> Self {
        let mut half_taps: Vec<f64> = (0..=half)
            .map(|m| {
                let part = m as f64 / half.max(1) as f64;
                2.0 * cut_off * sinc(2.0 * cut_off * m as f64) * bessel_i0(beta * (1.0 - part * part).max(0.0).sqrt())
                    / bessel_i0(beta)
            })
            .collect();
        let sum = half_taps[0] + 2.0 * half_taps[1..].iter().rev().sum::<f64>();
        half_taps.iter_mut().for_each(|h| *h /= sum);
        Self { half_taps }
    }

    /// Taps on each side of the middle one: the filter has 2 half + 1 taps, and reaches half samples to each side.
    pub(crate) fn half_length(&self) -> usize {
        self.half_taps.len() - 1
    }

    /// Tap h_m, m counted from the middle; 0 outside the filter.
    pub(crate) fn tap(&self, m: isize) -> f64 {
        self.half_taps.get(m.unsigned_abs()).copied().unwrap_or(0.0)
    }
}

/// Interpolation between samples: h(x) = sinc(x) I0(beta sqrt(1 - (x / 32)^2)) / I0(beta), |x| < 32, x in samples, beta for
/// a transition from 0.4 to 0.6 of the sampling rate. What lies below 0.4 of it is interpolated within 1e-9 of its
/// amplitude (Oppenheim & Schafer eq. (7.76): 192 dB).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KaiserInterpolation {
    beta: f64,
    scale: f64,
}

/// Samples to each side that an interpolated value is made of.
const INTERPOLATION_REACH: usize = 32;

impl KaiserInterpolation {
    /// The kernel.
    pub(crate) fn new() -> Self {
        let beta = beta(attenuation_db(INTERPOLATION_REACH, 2.0 * PI * 0.2));
        Self { beta, scale: 1.0 / bessel_i0(beta) }
    }

    /// Samples to each side that a value is made of.
    pub(crate) fn reach(&self) -> f64 {
        INTERPOLATION_REACH as f64
    }

    /// h at a distance in samples.
    pub(crate) fn value(&self, distance: f64) -> f64 {
        let part = distance / self.reach();
        let inside = 1.0 - part * part;
        if inside <= 0.0 {
            return 0.0;
        }
        sinc(distance) * bessel_i0(self.beta * inside.sqrt()) * self.scale
    }
}

/// Window parameter for an attenuation of at least 21 dB (Oppenheim & Schafer eq. (7.75)).
pub(super) fn beta(attenuation_db: f64) -> f64 {
    if attenuation_db > 50.0 {
        0.1102 * (attenuation_db - 8.7)
    } else {
        let above = (attenuation_db - 21.0).max(0.0);
        0.5842 * above.powf(0.4) + 0.078_86 * above
    }
}

/// Taps on each side for a transition band in radians per sample (Oppenheim & Schafer eq. (7.76): 2 half = M).
fn half_length(attenuation_db: f64, transition: f64) -> f64 {
    0.5 * (attenuation_db - 7.95) / (2.285 * transition)
}

/// Attenuation in dB that `half` taps on each side give over a transition band in radians per sample; the inverse of
/// [`half_length`].
pub(super) fn attenuation_db(half: usize, transition: f64) -> f64 {
    7.95 + 2.0 * half as f64 * 2.285 * transition
}

/// sin(pi x) / (pi x), exactly zero at the whole numbers other than 0.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-9 {
        1.0
    } else if (x - x.round()).abs() < 1e-12 * x.abs() {
        0.0
    } else {
        (PI * x).sin() / (PI * x)
    }
}

/// Modified Bessel function I0(x) = sum ((x/2)^k / k!)^2; all terms positive, so no cancellation.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut sum, mut term) = (1.0, 1.0);
    let mut k = 1.0;
    while term > 1e-17 * sum {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gain at `cycles_per_sample` = frequency x step: h_0 + 2 sum h_m cos(2 pi f m). Real: the phase is zero.
    fn gain(filter: &KaiserLowPass, cycles_per_sample: f64) -> f64 {
        filter.half_taps[0]
            + 2.0
                * filter.half_taps[1..]
                    .iter()
                    .zip(1..)
                    .map(|(h, m)| h * (2.0 * PI * cycles_per_sample * f64::from(m)).cos())
                    .sum::<f64>()
    }

    #[test]
    fn bessel_agrees_with_scipy() {
        // scipy.special.i0
        assert!((bessel_i0(8.0) / 427.564_115_721_804_74 - 1.0).abs() < 1e-14);
        assert!((bessel_i0(0.5) / 1.063_483_370_741_323_4 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn taps_agree_with_scipy_firwin() {
        // scipy.signal.firwin(101, 0.25, window=('kaiser', 7.857)): cut-off 0.25 of Nyquist = 0.125 cycles a sample.
        let filter = KaiserLowPass::windowed(0.125, 50, 7.857);
        for (m, scipy) in [(0, 0.250_004_117_455_459_6), (1, 0.224_752_644_122_944_46), (-2, 0.158_225_576_007_225)] {
            assert!((filter.tap(m) - scipy).abs() < 1e-14, "tap {m}");
        }
    }

    #[test]
    fn ripple_and_stop_band_are_as_asked() {
        // 100 kHz, pass 40 kHz, stop 44 kHz, 80 dB; Kaiser's formula is an estimate, 10 % allowed.
        let filter = KaiserLowPass::new(1e-5, 40e3, 44e3, 80.0).expect("a valid design");
        let allowed = 1.1e-4;
        for k in 0..=400 {
            let f = 0.4 * f64::from(k) / 400.0;
            assert!((gain(&filter, f) - 1.0).abs() < allowed, "pass band at {f}");
            let f = 0.44 + 0.06 * f64::from(k) / 400.0;
            assert!(gain(&filter, f).abs() < allowed, "stop band at {f}");
        }
        assert!((gain(&filter, 0.42) - 0.5).abs() < 1e-3);
        assert!((gain(&filter, 0.0) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn interpolation_keeps_its_stated_error() {
        let kernel = KaiserInterpolation::new();
        for f in [0.0, 0.11, 0.25, 0.37, 0.4] {
            let wave = |t: f64| (2.0 * PI * f * t + 0.3).cos();
            for place in [0.0, 0.013, 0.5, 0.77] {
                let taps = (-33..=33).map(f64::from);
                let found: f64 = taps.map(|n| wave(n) * kernel.value(place - n)).sum();
                assert!((found - wave(place)).abs() < 1e-9, "{f}, {place}: {found}");
            }
        }
        assert!(kernel.value(-32.5).abs() <= 0.0);
    }

    #[test]
    fn edges_out_of_order_are_refused() {
        let message = |pass, stop| KaiserLowPass::new(0.25, pass, stop, 80.0).expect_err("must fail").to_string();
        assert_eq!(
            message(1.5, 2.5),
            "low-pass edges must satisfy 0 < pass < stop <= 2 Hz (half the sampling rate), \
             found pass 1.5 Hz, stop 2.5 Hz"
        );
        assert!(message(1.5, 1.0).starts_with("low-pass edges"));
        assert!(message(0.0, 1.5).starts_with("low-pass edges"));
        assert!(KaiserLowPass::new(0.0, 1.0, 2.0, 80.0).is_err());
    }
}
