//! Means over a band, and variants ranked by them.

use super::error::{FrfError, check_frequencies};
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
