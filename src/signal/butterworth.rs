//! Zero-phase Butterworth high-pass: what the envelope of a defect's bursts is taken of.

use sci_rs::signal::filter::design::{
    DigitalFilter, FilterBandType, FilterOutputType, Sos, butter_dyn,
};
use sci_rs::signal::filter::sosfiltfilt_dyn;

use super::SignalError;
use crate::series::TimeSeries;

/// Order of the high-pass unless another is asked for. Forward and backward together it acts like order 8.
pub const DEFAULT_ORDER: usize = 4;

/// Largest order offered: second-order sections stay accurate well beyond, nobody needs more for an envelope.
const LARGEST_ORDER: usize = 12;

/// [`high_pass_of_order`] with [`DEFAULT_ORDER`].
///
/// # Errors
/// As [`high_pass_of_order`].
pub fn high_pass(series: &TimeSeries, cut_off_hz: f64) -> Result<TimeSeries, SignalError> {
    high_pass_of_order(series, cut_off_hz, DEFAULT_ORDER)
}

/// High-pass of the series (unit and instants unchanged) by a Butterworth filter run forward and backward: no phase
/// shift, gain |H|^2 with |H|^2 = 1 / (1 + (w_c / w)^(2 order)) on the bilinear frequency scale w = tan(pi f step), so
/// 1/2 at the cut-off 0 < `cut_off_hz` < 1 / (2 step); `order` 1 to 12.
///
/// Edges: the series is extended at each end by its own odd reflection, 3 (order + 1) samples long
/// (SciPy's rule), and each run starts from the steady state for its first value. Agrees with
/// `scipy.signal.sosfiltfilt(butter(order, f, 'highpass', fs=..., output='sos'), x)` to rounding; the design and the
/// two runs are those of the `sci-rs` library.
///
/// # Errors
/// [`SignalError::CutOff`], [`SignalError::Order`], [`SignalError::TooShort`] if the series is not longer than the
/// extension.
pub fn high_pass_of_order(
    series: &TimeSeries,
    cut_off_hz: f64,
    order: usize,
) -> Result<TimeSeries, SignalError> {
    if order == 0 || order > LARGEST_ORDER {
        return Err(SignalError::Order {
            order,
            largest: LARGEST_ORDER,
        });
    }
    let nyquist_hz = 0.5 * series.rate_hz();
    if !(cut_off_hz > 0.0 && cut_off_hz < nyquist_hz) {
        return Err(SignalError::CutOff {
            cut_off_hz,
            nyquist_hz,
        });
    }
    let extension = 3 * (order + 1);
    let samples = series.values().len();
    if samples <= extension {
        return Err(SignalError::TooShort {
            samples,
            needed: extension + 1,
        });
    }
    let sections = sections(cut_off_hz, order, series.rate_hz())?;
    let filtered = sosfiltfilt_dyn(series.values().iter(), &sections);
    Ok(series.with_values(filtered)?)
}

/// Second-order sections of the digital high-pass.
fn sections(cut_off_hz: f64, order: usize, rate_hz: f64) -> Result<Vec<Sos<f64>>, SignalError> {
    let design = butter_dyn::<f64>(
        order,
        vec![cut_off_hz],
        Some(FilterBandType::Highpass),
        Some(false),
        Some(FilterOutputType::Sos),
        Some(rate_hz),
    );
    match design {
        DigitalFilter::Sos(filter) => Ok(filter.sos),
        DigitalFilter::Ba(_) | DigitalFilter::Zpk(_) => {
            Err(SignalError::Design { order, cut_off_hz })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// 400 samples at 100 kHz: offset, slope, a line above and one below the cut-off, and clicks.
    fn test_series() -> TimeSeries {
        let values = (0..400)
            .map(|i| {
                let t = f64::from(i) * 1e-5;
                let click = if i % 97 == 13 { 2.0 } else { 0.0 };
                1.5 + (2.0 * PI * 7300.0 * t + 0.3).sin()
                    + 0.8 * (2.0 * PI * 900.0 * t).cos()
                    + 750.0 * t
                    + click
            })
            .collect();
        TimeSeries::new(0.0, 1e-5, "m/s^2", values).expect("a valid series")
    }

    /// Samples 0, 1, 7, 150, 200, 398, 399 of
    /// `sosfiltfilt(butter(order, fc, 'highpass', fs=1e5, output='sos'), x)`, SciPy 1.17.1, x as in `test_series`.
    const SCIPY: [(usize, f64, [f64; 7]); 7] = [
        (
            1,
            5000.0,
            [
                0.03678958851738612,
                0.3542035489602041,
                -0.29183402487926285,
                -0.024226678498702747,
                -0.575327390226485,
                -0.1255340923059265,
                -0.11664877476067637,
            ],
        ),
        (
            2,
            5000.0,
            [
                0.049783339821826256,
                0.4454009073956978,
                -0.33362708252612033,
                -0.012145801829601455,
                -0.7083908882039928,
                -0.10168000931257204,
                -0.11211777718899596,
            ],
        ),
        (
            3,
            5000.0,
            [
                0.07196190471919928,
                0.5006564128818348,
                -0.36695662438477916,
                -0.012539459136851394,
                -0.7872078628961907,
                -0.004484342483859094,
                -0.010515797195427945,
            ],
        ),
        (
            4,
            5000.0,
            [
                0.028046692330626122,
                0.48548127985060785,
                -0.3660753703771139,
                -0.012705244919019976,
                -0.8296648225829188,
                -0.1021671209329103,
                -0.12574858712886633,
            ],
        ),
        (
            5,
            5000.0,
            [
                0.033302552813759045,
                0.49871446298216493,
                -0.3696824113239068,
                -0.012610815892353189,
                -0.8511327952341089,
                -0.08624742723371975,
                -0.08043425759861123,
            ],
        ),
        (
            4,
            500.0,
            [
                0.5184724405760823,
                0.9227991194961733,
                -0.1083687648098759,
                -0.47574636117464697,
                -0.5781699522263957,
                -0.30467682671269897,
                -0.010427154975806818,
            ],
        ),
        (
            4,
            20.0,
            [
                -0.23907109753364908,
                0.15555024053305366,
                -0.933185999119877,
                -1.3975144631107437,
                -1.3729969136680662,
                -0.8124548338239352,
                -0.4960269903044541,
            ],
        ),
    ];

    #[test]
    fn agrees_with_scipy_with_its_edges() {
        let series = test_series();
        for (order, cut_off_hz, expected) in SCIPY {
            let y = high_pass_of_order(&series, cut_off_hz, order).expect("a valid filter");
            for (k, expected) in [0, 1, 7, 150, 200, 398, 399].into_iter().zip(expected) {
                let found = y.values()[k];
                // Rounding of the steady-state start grows as the cut-off falls: 1e-9 is for 20 Hz at 100 kHz.
                assert!(
                    (found - expected).abs() < 1e-9,
                    "order {order}, {cut_off_hz} Hz, sample {k}: {found} against {expected}"
                );
            }
        }
    }

    #[test]
    fn passes_high_frequencies_without_phase_and_stops_low_ones() {
        let tone = |f: f64| {
            let values = (0..20_000)
                .map(|k| (2.0 * PI * f * k as f64 * 1e-5).cos())
                .collect();
            TimeSeries::new(0.0, 1e-5, "m/s^2", values).expect("a valid series")
        };
        let middle = |s: &TimeSeries| s.window(0.05, 0.15).expect("inside");
        let high = middle(&high_pass(&tone(20e3), 5e3).expect("filter"));
        let tone_itself = middle(&tone(20e3));
        let worst = high.values().iter().zip(tone_itself.values());
        assert!(worst.fold(0.0, |w: f64, (a, b)| w.max((a - b).abs())) < 1e-4);
        let half = middle(&high_pass(&tone(5e3), 5e3).expect("filter"));
        assert!((half.rms() * 2.0_f64.sqrt() - 0.5).abs() < 1e-9);
        assert!(middle(&high_pass(&tone(500.0), 5e3).expect("filter")).peak() < 1e-7);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let series = TimeSeries::new(0.0, 0.25, "m", vec![0.0; 15]).expect("a valid series");
        let message = |f, order| {
            high_pass_of_order(&series, f, order)
                .expect_err("must fail")
                .to_string()
        };
        assert_eq!(
            message(2.0, 4),
            "cut-off must lie between 0 and 2 Hz (half the sampling rate), found 2 Hz"
        );
        assert_eq!(
            message(f64::NAN, 4),
            "cut-off must lie between 0 and 2 Hz (half the sampling rate), found NaN Hz"
        );
        assert_eq!(message(1.0, 0), "filter order must be 1 to 12, found 0");
        assert_eq!(message(1.0, 13), "filter order must be 1 to 12, found 13");
        assert_eq!(
            message(1.0, 4),
            "series has 15 samples, the filter or transform needs at least 16"
        );
        let longer = TimeSeries::new(0.0, 0.25, "m", vec![0.0; 16]).expect("a valid series");
        assert!(high_pass(&longer, 1.0).is_ok());
    }
}
