//! Butterworth filters: low-, high- and band-pass, without phase shift or causal.

use crate::numerics::Brief;
use std::f64::consts::PI;

use realfft::num_complex::Complex;

use super::SignalError;
use super::band_limit::odd_extension;
use crate::numerics::series::TimeSeries;

/// Order of a filter unless another is asked for. Forward and backward together it acts like order 8.
pub const DEFAULT_ORDER: usize = 4;

/// Largest order offered: second-order sections stay accurate well beyond, nobody needs more.
const LARGEST_ORDER: usize = 12;

/// Lowest edge in cycles per sample: coefficients of a section lose f^2 of their digits, (pi 1e-6)^2 leaves five.
const LOWEST_EDGE: f64 = 1e-6;

/// Narrowest band in cycles per sample: 1e-16 of rounding in a pole that is 1e-9 from the unit circle leaves six digits.
const NARROWEST_BAND: f64 = 1e-9;

/// What a filter lets pass. Edges lie between zero and half the sampling rate, Hz; the gain there is 1/sqrt(2) of a
/// causal run, 1/2 of one forward and backward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilterBand {
    /// What lies below the cut-off.
    LowPass {
        /// Cut-off, Hz.
        cut_off_hz: f64,
    },
    /// What lies above the cut-off.
    HighPass {
        /// Cut-off, Hz.
        cut_off_hz: f64,
    },
    /// What lies between two edges.
    BandPass {
        /// Lower edge, Hz.
        from_hz: f64,
        /// Upper edge, Hz, above the lower one.
        to_hz: f64,
    },
}

/// Digital Butterworth filter by the bilinear transform, gain
///
/// |H|^2 = 1 / (1 + r^(2 order)),  w = tan(pi f step),
///
/// r = w / w_c (low-pass), w_c / w (high-pass), (w^2 - w_1 w_2) / (w (w_2 - w_1)) (band-pass, which has 2 order poles).
/// `order` 1 to 12.
///
/// Second-order sections from the poles, never from a polynomial of the whole filter, so narrow bands and high orders stay
/// stable. Agrees with `scipy.signal.butter(order, edges, kind, fs=1/step, output="sos")` and `sosfiltfilt` or `sosfilt` to
/// rounding. Source of the equations: Oppenheim & Schafer, "Discrete-Time Signal Processing", 3rd ed., sections 6.3, 7.2
/// and 7.3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Butterworth {
    /// What passes.
    pub band: FilterBand,
    /// Order, 1 to 12.
    pub order: usize,
}

impl Butterworth {
    /// Filter of [`DEFAULT_ORDER`].
    pub fn new(band: FilterBand) -> Self {
        Self { band, order: DEFAULT_ORDER }
    }

    /// The series (unit and instants unchanged) filtered forward and backward: no phase shift, gain |H|^2.
    ///
    /// Edges: the series is extended at each end by its own odd reflection, 3 (n + 1) samples long for n poles
    /// (SciPy's rule), and each run starts from the steady state for its first value.
    ///
    /// # Errors
    /// [`SignalError`] for the order or an edge out of range, a filter without digits, and a series not longer than the
    /// extension.
    pub fn zero_phase(&self, series: &TimeSeries) -> Result<TimeSeries, SignalError> {
        let sections = self.sections(series.step_s())?;
        let poles = match self.band {
            FilterBand::BandPass { .. } => 2 * self.order,
            FilterBand::LowPass { .. } | FilterBand::HighPass { .. } => self.order,
        };
        let extension = 3 * (poles + 1);
        let samples = series.values().len();
        if samples <= extension {
            return Err(SignalError::too_short(samples, extension + 1));
        }
        let mut values = odd_extension(series.values(), extension);
        for _ in 0..2 {
            for section in &sections {
                let settled = values[0];
                section.run(&mut values, settled);
            }
            values.reverse();
        }
        Ok(series.with_values(values[extension..extension + samples].to_vec())?)
    }

    /// The series (unit and instants unchanged) filtered forward from rest: gain |H|, with the filter's phase; what comes
    /// later has no influence.
    ///
    /// # Errors
    /// As [`zero_phase`](Self::zero_phase); any length will do.
    pub fn causal(&self, series: &TimeSeries) -> Result<TimeSeries, SignalError> {
        let mut values = series.values().to_vec();
        for section in self.sections(series.step_s())? {
            section.run(&mut values, 0.0);
        }
        Ok(series.with_values(values)?)
    }

    /// The causal filter from rest, for samples that come one at a time every `step_s` seconds.
    ///
    /// # Errors
    /// As [`zero_phase`](Self::zero_phase).
    pub(crate) fn streaming(&self, step_s: f64) -> Result<Streaming, SignalError> {
        Ok(Streaming::of(self.sections(step_s)?))
    }

    /// Second-order sections for samples every `step_s` seconds, those with poles near the unit circle last.
    ///
    /// The low-pass of cut-off 1 rad/s has its poles at p = -exp(i pi m / (2 order)); they go to w_c p (low-pass), w_c / p
    /// (high-pass), or to both roots of s^2 - (w_2 - w_1) p s + w_1 w_2 = 0 (band-pass).
    fn sections(&self, step_s: f64) -> Result<Vec<Section>, SignalError> {
        self.check(step_s)?;
        let warped = |hz: f64| (PI * hz * step_s).tan();
        // those of the upper half plane, the one on the real axis first
        let poles = ((self.order + 1) % 2..self.order).step_by(2);
        let poles = poles.map(|m| -Complex::from_polar(1.0, PI * m as f64 / (2 * self.order) as f64));
        // a pole at s = -1 is one at z = 0, which is none
        let low_or_high = |s: Complex<f64>, sign: f64, gain: f64| match s.im == 0.0 {
            true => Section::new([s, Complex::new(-1.0, 0.0)], [1.0, sign, 0.0], 2.0 * gain),
            false => Section::new([s, s.conj()], [1.0, 2.0 * sign, 1.0], gain * gain),
        };
        Ok(match self.band {
            FilterBand::LowPass { cut_off_hz } => {
                let w = warped(cut_off_hz);
                poles.map(|p| low_or_high(p * w, 1.0, w)).collect()
            }
            FilterBand::HighPass { cut_off_hz } => {
                let w = warped(cut_off_hz);
                poles.map(|p| low_or_high(w / p, -1.0, 1.0)).collect()
            }
            FilterBand::BandPass { from_hz, to_hz } => {
                let [from, to] = [from_hz, to_hz].map(warped);
                let section = |poles| Section::new(poles, [1.0, 0.0, -1.0], to - from);
                let pairs = poles.flat_map(|p| {
                    let middle = p * (0.5 * (to - from));
                    let root = (middle * middle - from * to).sqrt();
                    let [one, other] = [middle - root, middle + root];
                    if p.im == 0.0 { vec![[one, other]] } else { vec![[one, one.conj()], [other, other.conj()]] }
                });
                pairs.map(section).collect()
            }
        })
    }

    fn check(&self, step_s: f64) -> Result<(), SignalError> {
        if self.order == 0 || self.order > LARGEST_ORDER {
            return Err(SignalError(format!("filter order must be 1 to {LARGEST_ORDER}, found {}", self.order)));
        }
        let nyquist_hz = 0.5 / step_s;
        let (lowest_hz, width_hz) = match self.band {
            FilterBand::LowPass { cut_off_hz } | FilterBand::HighPass { cut_off_hz } => {
                if !(cut_off_hz > 0.0 && cut_off_hz < nyquist_hz) {
                    return Err(SignalError::cut_off(cut_off_hz, nyquist_hz));
                }
                (cut_off_hz, cut_off_hz)
            }
            FilterBand::BandPass { from_hz, to_hz } => {
                if !(from_hz > 0.0 && from_hz < to_hz && to_hz < nyquist_hz) {
                    return Err(SignalError(format!(
                        "band must satisfy 0 < from < to < {} Hz (half the sampling rate), found {} Hz to {} Hz",
                        Brief(nyquist_hz),
                        Brief(from_hz),
                        Brief(to_hz)
                    )));
                }
                (from_hz, to_hz - from_hz)
            }
        };
        if lowest_hz * step_s < LOWEST_EDGE || width_hz * step_s < NARROWEST_BAND {
            let edges_hz = [lowest_hz, width_hz, LOWEST_EDGE / step_s, NARROWEST_BAND / step_s];
            let [lowest_hz, width_hz, least_hz, narrowest_hz] = edges_hz.map(Brief);
            return Err(SignalError(format!(
                "filter edges from {lowest_hz} Hz, {width_hz} Hz wide, leave no digits at this sampling rate: lowest edge \
                 {least_hz} Hz, narrowest band {narrowest_hz} Hz; decimate first"
            )));
        }
        Ok(())
    }
}

/// A filter that takes one sample at a time.
#[derive(Debug, Clone)]
pub(crate) struct Streaming(Vec<(Section, [f64; 2])>);

impl Streaming {
    fn of(sections: Vec<Section>) -> Self {
        Self(sections.into_iter().map(|section| (section, [0.0; 2])).collect())
    }

    /// A mass on a spring with a damping ratio below 1, gain 1 far below its frequency: how a sensor on its mount follows, from rest. The
    /// frequency is below half the sampling rate, Hz; the bilinear transform keeps it.
    pub(crate) fn resonance(hz: f64, damping: f64, step_s: f64) -> Self {
        let warped = (PI * hz * step_s).tan();
        let pole = warped * Complex::new(-damping, (1.0 - damping * damping).sqrt());
        Self::of(vec![Section::new([pole, pole.conj()], [1.0, 2.0, 1.0], warped * warped)])
    }

    /// A mode that passes with gain 1 at its frequency and falls to both sides; as [`resonance`](Self::resonance).
    pub(crate) fn mode(hz: f64, damping: f64, step_s: f64) -> Self {
        let warped = (PI * hz * step_s).tan();
        let pole = warped * Complex::new(-damping, (1.0 - damping * damping).sqrt());
        Self::of(vec![Section::new([pole, pole.conj()], [1.0, 0.0, -1.0], 2.0 * damping * warped)])
    }

    /// The next output.
    pub(crate) fn push(&mut self, sample: f64) -> f64 {
        self.0.iter_mut().fold(sample, |x, (section, state)| section.step(x, state))
    }
}

/// (b_0 + b_1 / z + b_2 / z^2) / (a_0 + a_1 / z + a_2 / z^2), a_0 = 1.
#[derive(Debug, Clone)]
struct Section {
    b: [f64; 3],
    a: [f64; 3],
}

impl Section {
    /// From two poles s, conjugate or real, by the bilinear transform z = (1 + s) / (1 - s).
    fn new(poles: [Complex<f64>; 2], b: [f64; 3], gain: f64) -> Self {
        let [one, other] = poles.map(|s| (1.0 + s) / (1.0 - s));
        let gain = gain / ((1.0 - poles[0]) * (1.0 - poles[1])).re;
        Self { b: b.map(|b| gain * b), a: [1.0, -(one + other).re, (one * other).re] }
    }

    /// Filters in place (direct form II, transposed) from the steady state for a value that was `held` before.
    fn run(&self, values: &mut [f64], held: f64) {
        let ([b_0, b_1, b_2], [_, a_1, a_2]) = (self.b, self.a);
        let settled = held * (b_0 + b_1 + b_2) / (1.0 + a_1 + a_2);
        let mut state = [settled - b_0 * held, b_2 * held - a_2 * settled];
        for value in values {
            *value = self.step(*value, &mut state);
        }
    }

    fn step(&self, x: f64, [first, second]: &mut [f64; 2]) -> f64 {
        let ([b_0, b_1, b_2], [_, a_1, a_2]) = (self.b, self.a);
        let y = b_0 * x + *first;
        *first = b_1 * x - a_1 * y + *second;
        *second = b_2 * x - a_2 * y;
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::{items, load, numbers, worst};

    fn high_pass(cut_off_hz: f64) -> Butterworth {
        Butterworth::new(FilterBand::HighPass { cut_off_hz })
    }

    #[test]
    fn agrees_with_scipy_with_its_edges() {
        let reference = load("butterworth");
        let x = numbers(&reference["x"]);
        let size = x.iter().fold(0.0, |w: f64, v| w.max(v.abs()));
        let series = TimeSeries::new(0.0, 1.0, "m/s^2", x).expect("a valid series");
        let at: Vec<usize> = numbers(&reference["at"]).iter().map(|k| *k as usize).collect();
        let cases = items(&reference["cases"]);
        assert_eq!(cases.len(), 68);
        for case in cases {
            let edges = numbers(&case["edges"]);
            let band = match case["kind"].as_str().expect("a kind") {
                "lowpass" => FilterBand::LowPass { cut_off_hz: edges[0] },
                "highpass" => FilterBand::HighPass { cut_off_hz: edges[0] },
                _ => FilterBand::BandPass { from_hz: edges[0], to_hz: edges[1] },
            };
            let order = case["order"].as_u64().expect("an order") as usize;
            let filter = Butterworth { band, order };
            for (name, y) in [
                ("zero_phase", filter.zero_phase(&series).expect("a valid filter")),
                ("causal", filter.causal(&series).expect("a valid filter")),
            ] {
                let found: Vec<f64> = at.iter().map(|k| y.values()[*k]).collect();
                let expected = numbers(&case[name]);
                let apart = found.iter().zip(&expected);
                let apart = apart.fold(0.0, |w: f64, (a, b)| w.max((a - b).abs()));
                // 1e-10 of the signal: rounding of either side, largest for the lowest cut-off
                assert!(apart < 1e-10 * size, "{name}, {filter:?}: {apart:e}");
            }
        }
    }

    /// |H| at f cycles per sample.
    fn gain(sections: &[Section], f: f64) -> f64 {
        let delay = Complex::from_polar(1.0, -2.0 * PI * f);
        let at = |c: &[f64; 3]| (delay * c[2] + c[1]) * delay + c[0];
        sections.iter().map(|s| (at(&s.b) / at(&s.a)).norm()).product()
    }

    /// Butterworth gain after the bilinear transform, from the definition.
    fn expected(band: FilterBand, order: usize, f: f64) -> f64 {
        let w = |f: f64| (PI * f).tan();
        let ratio = match band {
            FilterBand::LowPass { cut_off_hz } => w(f) / w(cut_off_hz),
            FilterBand::HighPass { cut_off_hz } => w(cut_off_hz) / w(f),
            FilterBand::BandPass { from_hz, to_hz } => {
                (w(f) * w(f) - w(from_hz) * w(to_hz)) / (w(f) * (w(to_hz) - w(from_hz)))
            }
        };
        1.0 / (1.0 + ratio.powi(2 * order as i32)).sqrt()
    }

    #[test]
    fn the_gain_is_that_of_the_definition() {
        let bands = [
            FilterBand::LowPass { cut_off_hz: 0.1 },
            FilterBand::HighPass { cut_off_hz: 0.1 },
            FilterBand::BandPass { from_hz: 1e-4, to_hz: 0.45 },
            FilterBand::BandPass { from_hz: 0.1, to_hz: 0.2 },
            FilterBand::BandPass { from_hz: 0.15, to_hz: 0.1501 },
        ];
        for band in bands {
            for order in 1..=12 {
                let sections = Butterworth { band, order }.sections(1.0).expect("a valid filter");
                for f in [1.1e-4, 0.02, 0.1, 0.14, 0.15, 0.15003, 0.1501, 0.2, 0.4, 0.47] {
                    let (found, wanted) = (gain(&sections, f), expected(band, order, f));
                    // rounding of the coefficients, 1e-16, over the square of the lowest edge, (pi 1e-4)^2 = 1e-7,
                    // and of the expectation
                    let allowed = 1e-8 * wanted + 1e-15;
                    assert!((found - wanted).abs() < allowed, "{band:?} order {order} at {f}: {found:e}, {wanted:e}");
                }
            }
        }
    }

    #[test]
    fn poles_stay_inside_the_circle_in_the_narrowest_band() {
        for order in 1..=12 {
            for from_hz in [1e-3, 0.123, 0.49] {
                let band = FilterBand::BandPass { from_hz, to_hz: from_hz + 1.01e-9 };
                let sections = Butterworth { band, order }.sections(1.0).expect("a valid filter");
                assert_eq!(sections.len(), order);
                // z^2 + a1 z + a2: inside for a2 < 1 and |a1| < 1 + a2
                for s in &sections {
                    assert!(s.a[2] < 1.0 && s.a[1].abs() < 1.0 + s.a[2], "{s:?}");
                }
            }
        }
    }

    #[test]
    fn passes_high_frequencies_without_phase_and_stops_low_ones() {
        let tone = |f: f64| {
            let values = (0..20_000).map(|k| (2.0 * PI * f * k as f64 * 1e-5).cos()).collect();
            TimeSeries::new(0.0, 1e-5, "m/s^2", values).expect("a valid series")
        };
        let middle = |s: &TimeSeries| s.window(0.05, 0.15).expect("inside");
        let filtered = |f| middle(&high_pass(5e3).zero_phase(&tone(f)).expect("filter"));
        assert!(worst(filtered(20e3).values(), middle(&tone(20e3)).values()) < 1e-4);
        assert!((filtered(5e3).rms() * 2.0_f64.sqrt() - 0.5).abs() < 1e-9);
        assert!(filtered(500.0).peak() < 1e-7);
    }

    #[test]
    fn a_narrow_band_keeps_its_line_and_dies_out() {
        // 1e-4 of its centre, order 12: a burst of noise rings and decays, with no growth from rounding.
        let band = FilterBand::BandPass { from_hz: 0.2, to_hz: 0.20002 };
        let filter = Butterworth { band, order: 12 };
        let mut values = vec![0.0; 2_000_000];
        values[0] = 1.0;
        let impulse = TimeSeries::new(0.0, 1.0, "N", values).expect("a valid series");
        let answer = filter.causal(&impulse).expect("filter");
        let largest = |from, to| answer.window(from, to).expect("inside").peak();
        // slowest pole: decay pi 2e-5 sin(pi / 24) = 8.2e-6 a sample, e^-8 over a million
        assert!(largest(1e6, 2e6) < 0.02 * largest(0.0, 1e6));
        assert!(largest(1.9e6, 2e6) < 1e-5 * largest(0.0, 1e6));
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let series = TimeSeries::new(0.0, 0.25, "m", vec![0.0; 15]).expect("a valid series");
        let message = |band, order| {
            let filter = Butterworth { band, order };
            let error = filter.zero_phase(&series).expect_err("must fail").to_string();
            if !error.starts_with("series") {
                let causal = filter.causal(&series).expect_err("must fail");
                assert_eq!(error, causal.to_string());
            }
            error
        };
        let high = |cut_off_hz| FilterBand::HighPass { cut_off_hz };
        let low = |cut_off_hz| FilterBand::LowPass { cut_off_hz };
        let between = |from_hz, to_hz| FilterBand::BandPass { from_hz, to_hz };
        let cut_off = "cut-off must lie between 0 and 2 Hz (half the sampling rate), found";
        assert_eq!(message(high(2.0), 4), format!("{cut_off} 2 Hz"));
        assert_eq!(message(low(f64::NAN), 4), format!("{cut_off} NaN Hz"));
        assert_eq!(message(low(-1.0), 4), format!("{cut_off} -1 Hz"));
        let edges = "band must satisfy 0 < from < to < 2 Hz (half the sampling rate), found";
        assert_eq!(message(between(1.0, 1.0), 4), format!("{edges} 1 Hz to 1 Hz"));
        assert_eq!(message(between(0.0, 1.0), 4), format!("{edges} 0 Hz to 1 Hz"));
        assert_eq!(message(between(1.0, 2.0), 4), format!("{edges} 1 Hz to 2 Hz"));
        assert_eq!(
            message(between(1.0, 1.000000001), 4),
            "filter edges from 1 Hz, 1e-9 Hz wide, leave no digits at this sampling rate: lowest edge 4e-6 Hz, narrowest \
             band 4e-9 Hz; decimate first"
        );
        assert!(message(high(1e-6), 4).starts_with("filter edges from 1e-6 Hz"));
        assert_eq!(message(high(1.0), 0), "filter order must be 1 to 12, found 0");
        assert_eq!(message(high(1.0), 13), "filter order must be 1 to 12, found 13");
        assert_eq!(message(high(1.0), 4), "series has 15 samples, the filter or transform needs at least 16");
        assert_eq!(message(between(0.5, 1.0), 2), "series has 15 samples, the filter or transform needs at least 16");
        let longer = TimeSeries::new(0.0, 0.25, "m", vec![0.0; 16]).expect("a valid series");
        assert!(high_pass(1.0).zero_phase(&longer).is_ok());
    }
}
