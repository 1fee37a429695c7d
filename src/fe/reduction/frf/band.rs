//! Means over a band, and variants ranked by them.
//!
//! Frequencies at which a response is worth computing.

use super::error::{FrfError, check_coefficients, check_frequencies, wrong_frequency};
use super::system::same;
use schemars::JsonSchema;
use serde::Serialize;

/// A band on a list of frequencies: weights of the trapezoidal rule, with straight lines to the band's ends.
#[derive(Debug)]
pub(super) struct Window {
    /// Place in the list and weight, Hz.
    weights: Vec<(usize, f64)>,
    width: f64,
}

impl Window {
    /// # Errors
    /// [`FrfError`] if the frequencies, ascending, do not reach the band's ends.
    pub(super) fn new(frequencies_hz: &[f64], band_hz: [f64; 2]) -> Result<Self, FrfError> {
        let [low, high] = check_band(band_hz)?;
        check_frequencies(frequencies_hz)?;
        let [first, last] = [frequencies_hz.first(), frequencies_hz.last()].map(|hz| hz.copied().unwrap_or(f64::NAN));
        if !(first <= low && high <= last) {
            return Err(FrfError(format!(
                "the band {low} Hz to {high} Hz is not covered by the response, which goes from {first} Hz to {last} Hz"
            )));
        }
        let mut weights = Vec::new();
        for (place, pair) in frequencies_hz.windows(2).enumerate() {
            let (start, end) = (pair[0].max(low), pair[1].min(high));
            if start < end {
                // the part's middle decides how its area is shared between both ends
                let middle = (0.5 * (start + end) - pair[0]) / (pair[1] - pair[0]);
                weights.push((place, (end - start) * (1.0 - middle)));
                weights.push((place + 1, (end - start) * middle));
            }
        }
        Ok(Self { weights, width: high - low })
    }

    /// Integral of values at the list's places over the band, Hz times their unit.
    pub(super) fn integral(&self, value: impl Fn(usize) -> f64) -> f64 {
        let parts = self.weights.iter();
        parts.map(|&(place, weight)| weight * value(place)).sum()
    }
}

pub(super) fn check_band([low, high]: [f64; 2]) -> Result<[f64; 2], FrfError> {
    if low >= 0.0 && low < high && high.is_finite() {
        return Ok([low, high]);
    }
    Err(FrfError(format!("a band goes from a frequency of zero or more to a higher one, found {low} Hz to {high} Hz")))
}

/// A variant's response over frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandVariant<'a> {
    /// Its name.
    pub name: &'a str,
    /// Frequencies, ascending, Hz.
    pub frequencies_hz: &'a [f64],
    /// `|H|` at each, any unit.
    pub magnitudes: &'a [f64],
}

/// A variant's place among others.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RankedVariant {
    /// Its name.
    pub name: String,
    /// Its place in the list given.
    #[serde(skip)]
    pub index: usize,
    /// Energy mean of `|H|` over the band, in dB above the reference.
    pub mean_db: f64,
    /// How far above the quietest, dB.
    pub above_quietest_db: f64,
}

/// Mean square of `|H|` over a band, `int |H|^2 df / (high - low)`, by the trapezoidal rule on a list of any spacing.
///
/// # Errors
/// [`FrfError`].
pub(crate) fn energy_mean(frequencies_hz: &[f64], magnitudes: &[f64], band_hz: [f64; 2]) -> Result<f64, FrfError> {
    same("number of magnitudes", frequencies_hz.len(), magnitudes.len())?;
    let window = Window::new(frequencies_hz, band_hz)?;
    Ok(window.integral(|place| magnitudes[place] * magnitudes[place]) / window.width)
}

/// Variants by their energy mean over a band, `10 log10(mean |H|^2 / reference^2)`, the quietest first; equal ones in the
/// order given. `reference` in the unit of H, > 0.
///
/// # Errors
/// As [`energy_mean`]; [`FrfError`] for the reference.
pub(crate) fn rank_in_band(
    variants: &[BandVariant<'_>],
    band_hz: [f64; 2],
    reference: f64,
) -> Result<Vec<RankedVariant>, FrfError> {
    if !(reference > 0.0 && reference.is_finite()) {
        return Err(FrfError(format!("the reference of a level must be positive and finite, found {reference}")));
    }
    let mut ranked = Vec::with_capacity(variants.len());
    for (index, variant) in variants.iter().enumerate() {
        let mean = energy_mean(variant.frequencies_hz, variant.magnitudes, band_hz)?;
        ranked.push(RankedVariant {
            name: variant.name.to_owned(),
            index,
            mean_db: 10.0 * (mean / (reference * reference)).log10(),
            above_quietest_db: 0.0,
        });
    }
    ranked.sort_by(|a, b| a.mean_db.total_cmp(&b.mean_db));
    if let Some(quietest) = ranked.first().map(|first| first.mean_db) {
        for variant in &mut ranked {
            // a variant that does not move at all is as quiet as itself
            if variant.mean_db > quietest {
                variant.above_quietest_db = variant.mean_db - quietest;
            }
        }
    }
    Ok(ranked)
}

/// A resonance to be resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// Natural frequency, Hz.
    pub frequency_hz: f64,
    /// Damping ratio zeta, >= 0: the half-power bandwidth is `2 zeta f`. Without damping there is none, and no refinement.
    pub ratio: f64,
}

/// A linear grid and how finely resonances are resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrequencyGrid {
    /// Lowest and highest frequency, Hz.
    pub band_hz: [f64; 2],
    /// Equal intervals over the band, >= 1.
    pub intervals: usize,
    /// Points in a half-power bandwidth, >= 1; the resonance is one of them, an even number has both half-power points.
    pub points_a_bandwidth: usize,
    /// Bandwidths resolved on each side of a resonance, >= 0. At three the response is down to 1/6 of the peak.
    pub reach: f64,
}

/// Spacing below which two frequencies are one, relative.
const SAME: f64 = 1e-9;

/// The grid's frequencies and, round each resonance, the resonance itself and equal steps of its half-power bandwidth;
/// ascending, each once, all within the band.
///
/// # Errors
/// [`FrfError`] of a resonance.
pub(crate) fn frequency_list(grid: &FrequencyGrid, resonances: &[Resonance]) -> Result<Vec<f64>, FrfError> {
    let [low, high] = check_band(grid.band_hz)?;
    for (what, value) in
        [("the number of intervals", grid.intervals), ("the number of points in a bandwidth", grid.points_a_bandwidth)]
    {
        if value == 0 {
            return Err(FrfError(format!("{what} must be one or more, found 0")));
        }
    }
    if !(grid.reach >= 0.0 && grid.reach.is_finite()) {
        return Err(FrfError(format!("the reach in bandwidths must be zero or more and finite, found {}", grid.reach)));
    }
    let step = (high - low) / grid.intervals as f64;
    let mut list: Vec<f64> = (0..grid.intervals).map(|place| low + place as f64 * step).collect();
    list.push(high);
    for resonance in resonances {
        list.extend(around(grid, resonance)?);
    }
    list.retain(|hz| (low..=high).contains(hz));
    list.sort_by(f64::total_cmp);
    list.dedup_by(|next, before| *next - *before <= SAME * *next);
    // the band's own end stays, whatever lay just below it
    if let Some(last) = list.last_mut() {
        *last = high;
    }
    Ok(list)
}

fn around(grid: &FrequencyGrid, resonance: &Resonance) -> Result<Vec<f64>, FrfError> {
    let Resonance { frequency_hz: centre, ratio } = *resonance;
    if !(centre >= 0.0 && centre.is_finite()) {
        return Err(wrong_frequency(centre));
    }
    check_coefficients(&[("ratio", ratio)])?;
    let step = 2.0 * ratio * centre / grid.points_a_bandwidth as f64;
    if step <= SAME * centre {
        return Ok(Vec::new());
    }
    // rounded up: the reach asked for is covered
    let steps = (grid.reach * grid.points_a_bandwidth as f64).ceil() as i64;
    Ok((-steps..=steps).map(|place| centre + place as f64 * step).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `|H|^2 = f` is a straight line: the rule is exact on any spacing, whatever ends the band has.
    #[test]
    fn a_straight_line_is_integrated_exactly() {
        let list = [0.0, 0.5, 3.0, 3.5, 10.0];
        let magnitudes: Vec<f64> = list.iter().map(|f: &f64| f.sqrt()).collect();
        for [low, high] in [[0.0, 10.0], [0.5, 3.5], [1.0, 2.0], [0.2, 9.0]] {
            let found = energy_mean(&list, &magnitudes, [low, high]).expect("covered");
            assert!((found - 0.5 * (low + high)).abs() < 1e-14, "{low} {high} {found}");
        }
    }

    #[test]
    fn variants_are_ranked_by_their_level() {
        let fine: Vec<f64> = (0..=100).map(f64::from).collect();
        let flat = |level: f64| vec![level; fine.len()];
        let (quiet, loud) = (flat(2e-3), flat(2e-2));
        // half of the band at 2e-2, half at nothing: 3 dB below loud, whatever the spacing
        let coarse = [0.0, 10.0, 55.0, 55.0 + 1e-9, 100.0];
        let half = [0.02, 0.02, 0.02, 0.0, 0.0];
        let variant = |name, frequencies_hz, magnitudes| BandVariant { name, frequencies_hz, magnitudes };
        let variants =
            [variant("loud", &fine[..], &loud[..]), variant("half", &coarse, &half), variant("quiet", &fine, &quiet)];
        let ranked = rank_in_band(&variants, [10.0, 100.0], 1e-3).expect("covered");
        let names: Vec<&str> = ranked.iter().map(|one| one.name.as_str()).collect();
        assert_eq!(names, ["quiet", "half", "loud"]);
        let exact = [20.0 * 2f64.log10(), 20.0 * 20f64.log10() - 10.0 * 2f64.log10()];
        for (found, exact) in ranked.iter().zip(exact) {
            // the step is a billionth of a hertz wide
            assert!((found.mean_db - exact).abs() < 1e-9, "{found:?}");
        }
        assert!((ranked[2].above_quietest_db - 20.0).abs() < 1e-12);
        assert_eq!(ranked[2].index, 0);
    }

    #[test]
    fn each_rule_fires() {
        let message = |list: &[f64], magnitudes: &[f64], band| {
            energy_mean(list, magnitudes, band).map_or_else(|error| error.to_string(), |x| x.to_string())
        };
        let one = [1.0; 3];
        assert_eq!(
            message(&[1.0, 2.0, 3.0], &one, [1.0, 4.0]),
            "the band 1 Hz to 4 Hz is not covered by the response, which goes from 1 Hz to 3 Hz"
        );
        assert_eq!(
            message(&[1.0, 2.0, 3.0], &one, [2.0, 2.0]),
            "a band goes from a frequency of zero or more to a higher one, found 2 Hz to 2 Hz"
        );
        assert_eq!(message(&[1.0, 3.0, 2.0], &one, [1.0, 2.0]), "frequencies must ascend, found 2 Hz after 3 Hz");
        assert_eq!(message(&[1.0, 2.0], &one, [1.0, 2.0]), "number of magnitudes: expected 2, found 3");
        let error = rank_in_band(&[], [0.0, 1.0], 0.0).expect_err("reference");
        assert_eq!(error.to_string(), "the reference of a level must be positive and finite, found 0");
    }
}

#[cfg(test)]
mod list_tests {
    use super::*;

    fn grid(band_hz: [f64; 2], intervals: usize) -> FrequencyGrid {
        FrequencyGrid { band_hz, intervals, points_a_bandwidth: 4, reach: 3.0 }
    }

    #[test]
    fn a_resonance_is_resolved_and_the_grid_is_kept() {
        let one = [Resonance { frequency_hz: 333.0, ratio: 0.01 }];
        let list = frequency_list(&grid([0.0, 1000.0], 10), &one).expect("in range");
        assert!(list.windows(2).all(|pair| pair[0] < pair[1]));
        let has = |hz: f64| list.iter().any(|own| (own - hz).abs() < 1e-9);
        for place in 0..=10 {
            assert!(has(100.0 * f64::from(place)));
        }
        // bandwidth 6.66 Hz: half-power points at 0.5 and the last at three of it
        for at in [0.0, 0.25, -0.25, 0.5, -0.5, 3.0, -3.0] {
            assert!(has(333.0 + 6.66 * at), "{at}");
        }
        assert_eq!(list.len(), 11 + 25);
    }

    #[test]
    fn points_outside_and_points_twice_are_left_out() {
        let resonances = [(995.0, 0.01), (995.0, 0.01), (500.0, 0.0), (0.0, 0.02), (5000.0, 0.001)]
            .map(|(frequency_hz, ratio)| Resonance { frequency_hz, ratio });
        let list = frequency_list(&grid([900.0, 1000.0], 1), &resonances).expect("in range");
        // 19.9 Hz a bandwidth, steps of 4.975: from 935.3 to 999.975
        assert_eq!(list.len(), 2 + 14);
        assert!((list[0] - 900.0).abs() < 1e-12 && (list[15] - 1000.0).abs() < 1e-12);
        assert!((list[1] - 935.3).abs() < 1e-9, "{list:?}");
    }

    #[test]
    fn each_rule_fires() {
        let good = grid([0.0, 10.0], 5);
        let message = |grid: FrequencyGrid, frequency_hz: f64, ratio: f64| {
            let one = [Resonance { frequency_hz, ratio }];
            frequency_list(&grid, &one).map_or_else(|error| error.to_string(), |list| format!("{list:?}"))
        };
        let broken = FrequencyGrid { intervals: 0, ..good };
        assert_eq!(message(broken, 1.0, 0.1), "the number of intervals must be one or more, found 0");
        let broken = FrequencyGrid { points_a_bandwidth: 0, ..good };
        assert_eq!(message(broken, 1.0, 0.1), "the number of points in a bandwidth must be one or more, found 0");
        let broken = FrequencyGrid { reach: f64::NAN, ..good };
        assert_eq!(message(broken, 1.0, 0.1), "the reach in bandwidths must be zero or more and finite, found NaN");
        assert_eq!(
            message(grid([3.0, 2.0], 5), 1.0, 0.1),
            "a band goes from a frequency of zero or more to a higher one, found 3 Hz to 2 Hz"
        );
        assert_eq!(message(good, -1.0, 0.1), "a frequency must be zero or more and finite, found -1 Hz");
        assert_eq!(
            message(good, 1.0, -0.1),
            "the damping coefficient ratio must be zero or more and finite, found -0.1"
        );
    }
}
