//! `Decimator`: takes a signal one sample at a time at the integrator's step and gives it at the output rate, free of
//! what would alias, without delay and without keeping the signal.
//!
//! Linear-phase low-pass filters by the Kaiser window, for the decimator and for band-limiting.
//!
//! Source: J. F. Kaiser, "Nonrecursive digital filter design using the I0-sinh window function", Proc. IEEE ISCAS
//! 1974, as in Oppenheim & Schafer, "Discrete-Time Signal Processing", 3rd ed., eq. (7.75) and (7.76).

use super::time_series::{SeriesError, check_step};
use crate::numerics::Brief;
use std::f64::consts::PI;
use std::sync::Arc;

/// Output intervals by which an output's last input lies after it; the filter reaches as far to each side.
pub const HALF_LENGTH_OUTPUTS: usize = 14;

/// Outputs that one input contributes to: 14 before it, 14 at or after it.
const ACCUMULATORS: usize = 2 * HALF_LENGTH_OUTPUTS;

/// Share of the output rate up to which signals pass unchanged; above it they fade, and what folds back is added.
pub const PASSED: f64 = 0.4;

/// Transition band from 0.4 to 0.6 of the output rate, in radians per output interval.
const TRANSITION: f64 = 2.0 * PI * 0.2;

/// Sixth-order central second difference, weights at 0, +-1, +-2, +-3 (Fornberg 1988, Math. Comp. 51, table 1).
/// The three-point rule is short by (omega dt)^2 / 12, 6e-3 at the pass-band edge for a ratio of 10; this one by
/// (omega dt)^6 / 560.
const SECOND_DIFFERENCE: [f64; 4] = [-49.0 / 18.0, 1.5, -0.15, 1.0 / 90.0];

/// Reach of [`SECOND_DIFFERENCE`] to each side, in samples.
const STENCIL: usize = SECOND_DIFFERENCE.len() - 1;

/// Streaming anti-alias decimator by a whole ratio M.
///
/// Output k belongs to the instant k M dt exactly (the filter is symmetric and its delay removed):
///
/// y_k = sum_n h_(n - kM) x_n
///
/// with h a Kaiser low-pass of at most 28 M taps: gain 1 within 1e-4 up to 0.4 of the output rate, below -80 dB from
/// 0.6 of the output rate on (what lies between 0.5 and 0.6 folds to 0.4 .. 0.5). For M = 1 the signal passes
/// unchanged. Input n = 0 is the start, and output 0 belongs to it.
///
/// Before the start the signal is zero ([`new`](Self::new)), or the displacement has its first value
/// (`second_derivative`). Output k is complete, and handed out, when input
/// (k + 14) M - 1 has been pushed: to get the output at the last instant of a run, go on for
/// [`HALF_LENGTH_OUTPUTS`] output intervals.
///
/// Cost: 28 multiply-adds an input, no allocation. Clones share the taps: clone a fresh one for each channel.
///
/// ```
/// use plummer::numerics::series::Decimator;
/// let mut decimator = Decimator::new(50)?;
/// let outputs: Vec<f64> = (0..50 * 30).filter_map(|_| decimator.push(2.0)).collect();
/// assert_eq!(outputs.len(), 30 - 14 + 1);
/// assert!((outputs[16] - 2.0).abs() < 1e-3);
/// # Ok::<(), plummer::numerics::series::SeriesError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Decimator {
    /// Taps by phase: row p (p = n mod M) holds h_(p + 13 M), h_(p + 12 M), ..., h_(p - 14 M).
    taps: Arc<[[f64; ACCUMULATORS]]>,
    /// Whether the first value, known from the first push on, is subtracted, which changes no derivative: the signal was that
    /// before its start, else zero.
    from_first: bool,
    first_value: Option<f64>,
    phase: usize,
    /// Partial sums of the outputs floor(n / M) - 13 ..= floor(n / M) + 14.
    accumulators: [f64; ACCUMULATORS],
    /// Whole output intervals pushed.
    intervals: u64,
}

/// All that a decimator remembers, for a checkpoint: restoring it goes on bit by bit as if nothing had happened.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct DecimatorState {
    /// Inputs pushed since the last whole output interval, 0 .. M-1.
    pub phase: usize,
    /// Whole output intervals pushed.
    pub intervals: u64,
    /// Partial sums of the outputs under way, in the unit of the output.
    pub accumulators: Vec<f64>,
    /// First displacement, where the decimator differentiates and has been given one.
    pub first_value: Option<f64>,
}

impl Decimator {
    /// Decimator by `ratio` M >= 1: one output every M inputs, in the unit of the input. Zero before the start.
    ///
    /// # Errors
    /// [`SeriesError`] for a ratio of zero.
    pub fn new(ratio: usize) -> Result<Self, SeriesError> {
        let filter = low_pass(ratio, 0)?;
        Ok(Self::from_taps(ratio, false, |m| filter.tap(m)))
    }

    /// Decimator that is given a displacement every `dt` seconds and gives its second derivative, band-limited like
    /// [`new`](Self::new): y_k = sum_n g_(n - kM) x_n, g the second difference of h (seven points) over dt^2. Output in
    /// the unit of the input per s^2. Before the start the displacement is its first value (velocity zero).
    ///
    /// Gain -omega^2 within 1e-4 over the pass band for M >= 6; for M = 5 within 2e-4, M = 4 3e-4, M = 3 1e-3, M = 2
    /// 1e-2, M = 1 0.18 at the pass-band edge, where the difference rule runs out.
    ///
    /// # Errors
    /// [`SeriesError`] for a ratio of zero, and unless `dt` is positive and finite.
    pub(crate) fn second_derivative(ratio: usize, dt: f64) -> Result<Self, SeriesError> {
        check_step(dt)?;
        let filter = low_pass(ratio, STENCIL)?;
        Ok(Self::from_taps(ratio, true, |m| {
            let both_sides: f64 = (1..=STENCIL)
                .rev()
                .map(|s| {
                    let s_signed = s as isize;
                    SECOND_DIFFERENCE[s] * (filter.tap(m - s_signed) + filter.tap(m + s_signed))
                })
                .sum();
            (both_sides + SECOND_DIFFERENCE[0] * filter.tap(m)) / (dt * dt)
        }))
    }

    fn from_taps(ratio: usize, from_first: bool, tap: impl Fn(isize) -> f64) -> Self {
        let ratio = ratio as isize;
        let first = HALF_LENGTH_OUTPUTS as isize - 1;
        let taps = (0..ratio).map(|phase| std::array::from_fn(|i| tap(phase + (first - i as isize) * ratio))).collect();
        Self { taps, from_first, first_value: None, phase: 0, accumulators: [0.0; ACCUMULATORS], intervals: 0 }
    }

    /// Takes the next input (at n dt, n counted from 0). Returns output k = 0, 1, 2, ... (at k M dt) on the push that
    /// completes it, input (k + 14) M - 1.
    #[inline]
    pub fn push(&mut self, value: f64) -> Option<f64> {
        let value = if self.from_first { value - *self.first_value.get_or_insert(value) } else { value };
        for (sum, tap) in self.accumulators.iter_mut().zip(&self.taps[self.phase]) {
            *sum += tap * value;
        }
        self.phase += 1;
        if self.phase < self.taps.len() {
            return None;
        }
        self.phase = 0;
        self.intervals += 1;
        let complete = self.accumulators[0];
        self.accumulators.copy_within(1.., 0);
        self.accumulators[ACCUMULATORS - 1] = 0.0;
        (self.intervals >= HALF_LENGTH_OUTPUTS as u64).then_some(complete)
    }

    /// What the decimator remembers, for a checkpoint.
    pub(crate) fn state(&self) -> DecimatorState {
        DecimatorState {
            phase: self.phase,
            intervals: self.intervals,
            accumulators: self.accumulators.to_vec(),
            first_value: self.first_value,
        }
    }

    /// This decimator (same ratio, same kind, same dt) in a remembered state.
    ///
    /// # Errors
    /// [`SeriesError`] if the state has another number of accumulators or a phase beyond the ratio.
    pub(crate) fn with_state(mut self, state: &DecimatorState) -> Result<Self, SeriesError> {
        if state.phase >= self.taps.len() {
            return Err(SeriesError(format!(
                "saved decimator state does not fit: phase {} in the state, ratio {} in the decimator",
                state.phase,
                self.taps.len()
            )));
        }
        self.accumulators = state.accumulators.as_slice().try_into().map_err(|_| {
            SeriesError(format!(
                "saved decimator state does not fit: {} accumulators in the state, {ACCUMULATORS} in the decimator",
                state.accumulators.len()
            ))
        })?;
        self.phase = state.phase;
        self.intervals = state.intervals;
        self.first_value = state.first_value.filter(|_| self.from_first);
        Ok(self)
    }
}

/// Low-pass with its cut-off at half the output rate, as long as 28 outputs allow when `spare` samples are kept free
/// at each end.
fn low_pass(ratio: usize, spare: usize) -> Result<KaiserLowPass, SeriesError> {
    if ratio == 0 {
        return Err(SeriesError(format!("decimation ratio must be at least 1, found {ratio}")));
    }
    let half = HALF_LENGTH_OUTPUTS * ratio - 1 - spare;
    let attenuation = attenuation_db(half, TRANSITION / ratio as f64);
    Ok(KaiserLowPass::windowed(0.5 / ratio as f64, half, beta(attenuation)))
}

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
            let [nyquist_hz, pass_hz, stop_hz] = [nyquist_hz, pass_hz, stop_hz].map(Brief);
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

    /// Outputs 0 .. of a decimator fed with x(n), n = 0 .. inputs - 1.
    fn outputs(mut decimator: Decimator, inputs: usize, x: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..inputs).filter_map(|n| decimator.push(x(n as f64))).collect()
    }

    /// Amplitude and delay (in input samples) of a sampled sinusoid of known frequency f (cycles per input sample),
    /// by least squares on outputs k >= 30 against cos and sin of 2 pi f k M.
    fn amplitude_and_delay(y: &[f64], ratio: usize, f: f64) -> (f64, f64) {
        let (mut cc, mut cs, mut ss, mut yc, mut ys) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (k, y) in y.iter().enumerate().skip(30) {
            let (s, c) = (2.0 * PI * f * (k * ratio) as f64).sin_cos();
            cc += c * c;
            cs += c * s;
            ss += s * s;
            yc += y * c;
            ys += y * s;
        }
        let determinant = cc * ss - cs * cs;
        let (a, b) = ((yc * ss - ys * cs) / determinant, (ys * cc - yc * cs) / determinant);
        (a.hypot(b), b.atan2(a) / (2.0 * PI * f))
    }

    #[test]
    fn pass_band_gain_and_alignment() {
        for ratio in [2, 3, 10, 64, 400] {
            for part in [0.01, 0.1, 0.237, 0.333, 0.4] {
                let f = part / ratio as f64;
                let y = outputs(Decimator::new(ratio).expect("ratio"), 400 * ratio, |n| (2.0 * PI * f * n).cos());
                let (amplitude, delay) = amplitude_and_delay(&y, ratio, f);
                assert!((amplitude - 1.0).abs() < 1e-4, "M {ratio}, {part}: {amplitude}");
                assert!(delay.abs() < 1e-6, "M {ratio}, {part}: delay {delay} samples");
            }
        }
    }

    #[test]
    fn stop_band_is_below_80_db() {
        for ratio in [2, 3, 10, 64, 400] {
            for part in [0.6, 0.61, 0.7, 0.9, 1.0, 1.37, 0.49 * ratio as f64] {
                let f = f64::min(part / ratio as f64, 0.5);
                let y = outputs(Decimator::new(ratio).expect("ratio"), 200 * ratio, |n| (2.0 * PI * f * n).cos());
                let worst = y[30..].iter().fold(0.0, |w: f64, y| w.max(y.abs()));
                assert!(worst < 1e-4, "M {ratio}, {part} of the output rate: {worst:e}");
            }
        }
    }

    #[test]
    fn second_derivative_has_gain_minus_omega_squared() {
        let dt = 2e-7;
        for (ratio, allowed) in
            [(1, 0.18), (2, 1e-2), (3, 1e-3), (4, 3e-4), (5, 2e-4), (6, 1e-4), (10, 1e-4), (50, 1e-4)]
        {
            for part in [0.02, 0.1, 0.237, 0.4] {
                let f = part / ratio as f64;
                let omega = 2.0 * PI * f / dt;
                let decimator = Decimator::second_derivative(ratio, dt).expect("ratio");
                // On an offset a thousand times larger, as a static deflection is.
                let y = outputs(decimator, 400 * ratio, |n| 1e-5 + 1e-8 * (2.0 * PI * f * n).cos());
                let minus: Vec<f64> = y.iter().map(|y| -y / (omega * omega * 1e-8)).collect();
                let (amplitude, delay) = amplitude_and_delay(&minus, ratio, f);
                assert!((amplitude - 1.0).abs() < allowed, "M {ratio}, {part}: {amplitude}");
                assert!(delay.abs() < 1e-6, "M {ratio}, {part}: delay {delay} samples");
            }
        }
    }

    #[test]
    fn second_derivative_stops_what_would_alias() {
        // Acceleration of unit amplitude in the stop band comes through below 1e-4.
        let dt = 2e-7;
        for ratio in [3, 10, 50] {
            for part in [0.6, 0.75, 1.0, 1.49] {
                let f = part / ratio as f64;
                let omega = 2.0 * PI * f / dt;
                let decimator = Decimator::second_derivative(ratio, dt).expect("ratio");
                let y = outputs(decimator, 200 * ratio, |n| (2.0 * PI * f * n).cos() / (omega * omega));
                let worst = y[30..].iter().fold(0.0, |w: f64, y| w.max(y.abs()));
                assert!(worst < 1e-4, "M {ratio}, {part}: {worst:e}");
            }
        }
    }

    #[test]
    fn constant_displacement_has_no_acceleration_from_the_start_on() {
        let decimator = Decimator::second_derivative(20, 1e-8).expect("ratio");
        for y in outputs(decimator, 20 * 40, |_| 1.234e-5) {
            assert!(y.abs() <= 0.0);
        }
    }

    #[test]
    fn constant_acceleration_is_recovered() {
        // x = a t^2 / 2 from rest: the acceleration steps from 0 to a at t = 0; beyond 14 outputs the step is over.
        let (dt, ratio, a) = (1e-7, 25, 300.0);
        let decimator = Decimator::second_derivative(ratio, dt).expect("ratio");
        let y = outputs(decimator, 60 * ratio, |n| 0.5 * a * (n * dt).powi(2));
        assert!((y[0] / a - 0.5).abs() < 1e-2);
        for y in &y[15..] {
            assert!((y / a - 1.0).abs() < 1e-6, "{y}");
        }
    }

    #[test]
    fn outputs_come_when_promised() {
        let (ratio, wanted) = (7, 9);
        let mut decimator = Decimator::new(ratio).expect("ratio");
        let needed = (wanted + HALF_LENGTH_OUTPUTS) * ratio;
        let got = (0..needed - 1).filter_map(|_| decimator.push(1.0)).count();
        assert_eq!(got, wanted);
        assert!(decimator.push(1.0).is_some());
        assert_eq!(decimator.taps.len(), ratio);
    }

    #[test]
    fn ratio_one_passes_the_signal_unchanged() {
        let x = |n: f64| (0.9 * n).sin() + 0.2 * n;
        let y = outputs(Decimator::new(1).expect("ratio"), 60, x);
        for (k, y) in y.iter().enumerate() {
            assert!((y - x(k as f64)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_restored_decimator_goes_on_bit_by_bit() {
        for fresh in [Decimator::new(13), Decimator::second_derivative(13, 1e-7)] {
            let fresh = fresh.expect("ratio");
            let x = |n: usize| (n as f64 * 0.11).sin() + 0.3;
            let mut whole = fresh.clone();
            let expected: Vec<f64> = (0..900).filter_map(|n| whole.push(x(n))).collect();
            let mut before = fresh.clone();
            let mut found: Vec<f64> = (0..317).filter_map(|n| before.push(x(n))).collect();
            let mut after = fresh.with_state(&before.state()).expect("own state");
            found.extend((317..900).filter_map(|n| after.push(x(n))));
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |r: Result<Decimator, SeriesError>| r.expect_err("must fail").to_string();
        assert_eq!(message(Decimator::new(0)), "decimation ratio must be at least 1, found 0");
        assert_eq!(
            message(Decimator::second_derivative(4, -1.0)),
            "sampling step must be positive and finite, found -1 s"
        );
        let mut state = Decimator::new(5).expect("ratio").state();
        state.accumulators.pop();
        assert_eq!(
            message(Decimator::new(5).expect("ratio").with_state(&state)),
            "saved decimator state does not fit: 27 accumulators in the state, 28 in the decimator"
        );
        let mut state = Decimator::new(5).expect("ratio").state();
        state.phase = 5;
        assert_eq!(
            message(Decimator::new(5).expect("ratio").with_state(&state)),
            "saved decimator state does not fit: phase 5 in the state, ratio 5 in the decimator"
        );
    }
}

#[cfg(test)]
mod kaiser_tests {
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
