//! Cuts a signal to the band in which two methods are compared.
//!
//! How far two signals are apart.

use super::SignalError;
use super::fourier::{fast_length, forward, inverse};
use crate::numerics::series::{KaiserLowPass, TimeSeries, root_mean_square};

/// Stop-band level and pass-band ripple, dB.
const ATTENUATION_DB: f64 = 80.0;

/// Begin of the stop band over the end of the pass band.
const STOP_OVER_PASS: f64 = 1.1;

/// The series (unit and instants unchanged) without what lies above `up_to_hz`: a symmetric Kaiser low-pass, so no
/// phase shift; gain 1 within 1e-4 up to `up_to_hz`, below -80 dB from 1.1 `up_to_hz` (or half the sampling rate, if
/// that is lower) on. 0 < `up_to_hz` < 1 / (2 step).
///
/// Edges: the series is extended by its odd reflection, 2 x_0 - x_k; the first and last [`band_limit_edge_s`] seconds
/// depend on that. The same input gives the same output bit by bit on one machine.
///
/// # Errors
/// [`SignalError`] for the cut-off, or if the series is not longer than the filter reaches to one side.
pub fn band_limit(series: &TimeSeries, up_to_hz: f64) -> Result<TimeSeries, SignalError> {
    limited(series, up_to_hz, odd_extension)
}

/// [`band_limit`] for a series that is zero before its start, as accelerations of a run from rest are. A reflection would
/// turn what lies above the band at the first sample into a step in the band. Beyond the end the series goes on mirrored, x_k, for the
/// same reason.
///
/// # Errors
/// As [`band_limit`].
pub fn band_limit_from_rest(series: &TimeSeries, up_to_hz: f64) -> Result<TimeSeries, SignalError> {
    limited(series, up_to_hz, |x, length| extended(x, length, |_| 0.0, |v| v))
}

/// The values with `length` more (fewer than there are) at each end, by their odd reflection, 2 x_0 - x_k.
pub(super) fn odd_extension(x: &[f64], length: usize) -> Vec<f64> {
    let (first, last) = (x[0], x[x.len() - 1]);
    extended(x, length, |v| 2.0 * first - v, |v| 2.0 * last - v)
}

/// The same where `before` and `after` make the value beyond an end of the one as far inside.
fn extended(x: &[f64], length: usize, before: impl Fn(f64) -> f64, after: impl Fn(f64) -> f64) -> Vec<f64> {
    let before = x[1..=length].iter().rev().map(|v| before(*v));
    let after = x[x.len() - 1 - length..x.len() - 1].iter().rev().map(|v| after(*v));
    before.chain(x.iter().copied()).chain(after).collect()
}

/// The filtered series; `extend` makes the values with as many more at each end as the filter reaches.
fn limited(
    series: &TimeSeries,
    up_to_hz: f64,
    extend: impl Fn(&[f64], usize) -> Vec<f64>,
) -> Result<TimeSeries, SignalError> {
    let filter = filter(series.step_s(), up_to_hz)?;
    let (x, half) = (series.values(), filter.half_length());
    let samples = x.len();
    if samples <= half {
        return Err(SignalError::too_short(samples, half + 1));
    }
    let extended = extend(x, half);
    // Circular convolution: the middle part reaches `half` to each side, never round the end.
    let points = fast_length(extended.len());
    let mut taps = vec![0.0; points];
    for m in -(half as isize)..=half as isize {
        taps[m.rem_euclid(points as isize) as usize] = filter.tap(m);
    }
    let mut bins = forward(&extended, points)?;
    for (bin, gain) in bins.iter_mut().zip(forward(&taps, points)?) {
        *bin *= gain.re;
    }
    let filtered = inverse(bins, points)?;
    Ok(series.with_values(filtered[half..half + samples].to_vec())?)
}

/// Length of the stretch at each end of a band-limited series that depends on the extension beyond the ends, s: the
/// reach of the filter, about 25 / `up_to_hz` seconds for `up_to_hz` well below half the sampling rate.
///
/// # Errors
/// [`SignalError`] for a cut-off out of range.
pub fn band_limit_edge_s(step_s: f64, up_to_hz: f64) -> Result<f64, SignalError> {
    Ok(filter(step_s, up_to_hz)?.half_length() as f64 * step_s)
}

fn filter(step_s: f64, up_to_hz: f64) -> Result<KaiserLowPass, SignalError> {
    let nyquist_hz = 0.5 / step_s;
    if !(up_to_hz > 0.0 && up_to_hz < nyquist_hz) {
        return Err(SignalError::cut_off(up_to_hz, nyquist_hz));
    }
    let stop_hz = f64::min(STOP_OVER_PASS * up_to_hz, nyquist_hz);
    Ok(KaiserLowPass::new(step_s, up_to_hz, stop_hz, ATTENUATION_DB)?)
}

/// Part of a step by which the instants of two compared series may differ.
const INSTANT_TOLERANCE_STEPS: f64 = 1e-6;

/// Relative difference rms(a - b) / rms(b) of `a` against the reference `b`, dimensionless; means are not removed.
/// Both must have the same unit and the same instants (to a millionth of a step): compare signals of two methods
/// band-limited, at the very same instants.
///
/// # Errors
/// [`SignalError`] for series that differ in instants or unit, and for a reference that is zero throughout.
pub fn relative_difference(a: &TimeSeries, b: &TimeSeries) -> Result<f64, SignalError> {
    let apart = (a.start_s() - b.start_s()).abs().max((a.end_s() - b.end_s()).abs());
    // round-off counts where time has its origin far away
    let most = INSTANT_TOLERANCE_STEPS * b.step_s() + 4.0 * f64::EPSILON * b.end_s().abs();
    if a.values().len() != b.values().len() || apart > most {
        let [first, second] = [a, b].map(|x| (x.values().len(), x.start_s(), x.step_s()));
        return Err(SignalError(format!(
            "series are not sampled at the same instants: {} samples from {} s every {} s against {} from {} s every {} s",
            first.0, first.1, first.2, second.0, second.1, second.2
        )));
    }
    if a.unit() != b.unit() {
        let message = format!("series have different units: \"{}\" against \"{}\"", a.unit(), b.unit());
        return Err(SignalError(message));
    }
    let reference = b.rms();
    if reference <= 0.0 {
        return Err(SignalError::zero_reference());
    }
    let difference: Vec<f64> = a.values().iter().zip(b.values()).map(|(a, b)| a - b).collect();
    Ok(root_mean_square(&difference) / reference)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn tone(f: f64, samples: usize) -> TimeSeries {
        let values = (0..samples).map(|k| (2.0 * PI * f * k as f64 * 1e-5 + 0.3).sin()).collect();
        TimeSeries::new(0.0, 1e-5, "m/s^2", values).expect("a valid series")
    }

    /// Largest |a - b| away from the edges.
    fn worst(a: &TimeSeries, b: &[f64], edge_s: f64) -> f64 {
        let edge = (edge_s / a.step_s()).round() as usize;
        let inside = edge..a.values().len() - edge;
        let pairs = a.values()[inside.clone()].iter().zip(&b[inside]);
        pairs.fold(0.0, |w, (a, b)| w.max((a - b).abs()))
    }

    #[test]
    fn passes_below_and_stops_above() {
        for (up_to, samples) in [(40e3, 4001), (1e3, 20_000), (48e3, 4000)] {
            let edge = band_limit_edge_s(1e-5, up_to).expect("a valid band");
            for part in [0.01, 0.5, 0.9, 1.0] {
                let x = tone(part * up_to, samples);
                let y = band_limit(&x, up_to).expect("filter");
                assert!(worst(&y, x.values(), edge) < 1.1e-4, "{up_to} Hz, {part}");
            }
            let stop = f64::min(1.1 * up_to, 50e3);
            for f in [stop, 0.5 * (stop + 50e3)] {
                let y = band_limit(&tone(f, samples), up_to).expect("filter");
                assert!(worst(&y, &vec![0.0; samples], edge) < 1.1e-4, "{f} Hz of {up_to}");
            }
        }
    }

    #[test]
    fn agrees_with_direct_convolution() {
        let values: Vec<f64> = (0..300_u64).map(|k| ((k * k * 31) % 97) as f64 - 48.0).collect();
        let x = TimeSeries::new(0.0, 1e-5, "N", values.clone()).expect("a valid series");
        let y = band_limit(&x, 30e3).expect("filter");
        let filter = filter(1e-5, 30e3).expect("filter");
        let half = filter.half_length();
        let at = |k: isize| {
            let last = values.len() as isize - 1;
            if k < 0 {
                2.0 * values[0] - values[(-k) as usize]
            } else if k > last {
                2.0 * values[last as usize] - values[(2 * last - k) as usize]
            } else {
                values[k as usize]
            }
        };
        for n in [0, 1, 17, 150, 298, 299] {
            let direct: f64 = (-(half as isize)..=half as isize).map(|m| filter.tap(m) * at(n - m)).sum();
            assert!((y.values()[n as usize] - direct).abs() < 1e-11, "sample {n}");
        }
        assert_eq!(y, band_limit(&x, 30e3).expect("filter"));
    }

    /// A tone above the band that begins at the start is nothing in the band but where it begins; its reflection about a first
    /// sample that is not zero is a step there.
    #[test]
    fn a_start_from_rest_brings_no_step_into_the_band() {
        let values = (0..4000).map(|k| (2.0 * PI * 40e3 * f64::from(k) * 1e-5).cos());
        let x = TimeSeries::new(0.0, 1e-5, "m/s^2", values.collect()).expect("a valid series");
        let first = |y: TimeSeries| y.values()[0].abs();
        let reflected = first(band_limit(&x, 2e3).expect("filter"));
        let from_rest = first(band_limit_from_rest(&x, 2e3).expect("filter"));
        assert!((reflected - 1.0).abs() < 1e-3, "{reflected}");
        // half of the filter's weight at the one sample that has no partner: 2.1 kHz of 100 kHz
        assert!(from_rest < 0.03, "{from_rest}");
        let edge = band_limit_edge_s(1e-5, 2e3).expect("a valid band");
        let [a, b] = [band_limit(&x, 2e3), band_limit_from_rest(&x, 2e3)].map(Result::unwrap);
        assert!(worst(&a, b.values(), edge) < 1e-12);
    }

    #[test]
    fn a_straight_line_passes_up_to_its_ends() {
        let values = (0..500).map(|k| 3.0 + 0.01 * f64::from(k)).collect();
        let x = TimeSeries::new(0.0, 1e-5, "m", values).expect("a valid series");
        let y = band_limit(&x, 20e3).expect("filter");
        assert!(worst(&y, x.values(), 0.0) < 1e-12);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |series: &TimeSeries, f| band_limit(series, f).expect_err("must fail").to_string();
        let series = TimeSeries::new(0.0, 0.25, "m", vec![0.0; 30]).expect("a valid series");
        assert_eq!(message(&series, 2.0), "cut-off must lie between 0 and 2 Hz (half the sampling rate), found 2 Hz");
        assert_eq!(message(&series, 0.5), "series has 30 samples, the filter or transform needs at least 202");
    }
}

#[cfg(test)]
mod compare_tests {
    use super::*;

    fn series(start_s: f64, step_s: f64, unit: &str, values: &[f64]) -> TimeSeries {
        TimeSeries::new(start_s, step_s, unit, values.to_vec()).expect("a valid series")
    }

    #[test]
    fn difference_over_reference() {
        // rms((0, 1)) / rms((3, 4)) = 1 / 5: the reference is the second.
        let a = series(0.0, 0.5, "m", &[3.0, 5.0]);
        let b = series(1e-9, 0.5, "m", &[3.0, 4.0]);
        assert!((relative_difference(&a, &b).expect("comparable") - 0.2).abs() < 1e-15);
        assert!(relative_difference(&a, &a).expect("comparable") <= 0.0);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let a = series(0.0, 0.5, "m", &[3.0, 5.0]);
        let message = |b| relative_difference(&a, &b).expect_err("must fail").to_string();
        assert_eq!(
            message(series(0.25, 0.5, "m", &[1.0, 2.0])),
            "series are not sampled at the same instants: 2 samples from 0 s every 0.5 s against \
             2 from 0.25 s every 0.5 s"
        );
        assert!(message(series(0.0, 0.25, "m", &[1.0, 2.0])).starts_with("series are not sampled"));
        assert!(message(series(0.0, 0.5, "m", &[1.0])).starts_with("series are not sampled"));
        assert_eq!(message(series(0.0, 0.5, "N", &[1.0, 2.0])), "series have different units: \"m\" against \"N\"");
        assert_eq!(
            message(series(0.0, 0.5, "m", &[0.0, 0.0])),
            "relative difference needs a reference that is not zero throughout"
        );
    }
}
