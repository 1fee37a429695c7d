//! What a sensor or a converter did to a signal: clipping, and stretches that stand still.

use super::{TimeSeries, TimeWindow};

/// Equal samples in a row at the largest or smallest value from which they are clipped: a smooth top has two at most, by rounding.
const CLIPPED_RUN: usize = 3;

impl TimeSeries {
    /// Share of the samples, 0 to 1, at the largest or the smallest value, where three in a row lie at one of them: a converter's range
    /// ends there. 0 for a constant signal.
    #[must_use]
    pub(crate) fn clipped_share(&self) -> f64 {
        let values = self.values();
        let ends = values
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &value| [value.min(low), value.max(high)]);
        if ends[0] >= ends[1] {
            return 0.0;
        }
        let at_an_end = |run: &&[f64]| ends.contains(&run[0]);
        let lengths: Vec<usize> = runs(values).filter(at_an_end).map(<[f64]>::len).collect();
        // a square wave has no row
        if !lengths.iter().any(|&length| length >= CLIPPED_RUN) {
            return 0.0;
        }
        lengths.iter().sum::<usize>() as f64 / values.len() as f64
    }

    /// The longest stretch of equal samples, s; as long as a sample where no two are equal.
    #[must_use]
    pub(crate) fn longest_still(&self) -> TimeWindow {
        let (mut begin, mut longest) = (0, (0, 1));
        for run in runs(self.values()) {
            if run.len() > longest.1 {
                longest = (begin, run.len());
            }
            begin += run.len();
        }
        let (first, count) = longest;
        TimeWindow { from: self.time_s(first), to: self.time_s(first + count) }
    }
}

/// Stretches of equal samples.
fn runs(values: &[f64]) -> impl Iterator<Item = &[f64]> {
    values.chunk_by(|a, b| a.to_bits() == b.to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(values: &[f64]) -> TimeSeries {
        TimeSeries::new(1.0, 0.5, "", values.to_vec()).unwrap()
    }

    #[allow(clippy::float_cmp)] // shares of eight samples
    #[test]
    fn clipped_samples_lie_in_a_row_at_an_end_of_the_range() {
        let share = |values: &[f64]| series(values).clipped_share();
        assert_eq!(share(&[0.0, 2.0, 2.0, 2.0, 1.0, -3.0, 0.0, -3.0]), 5.0 / 8.0);
        // two at the top are rounding, three in between no end
        assert_eq!(share(&[0.0, 2.0, 2.0, 1.0, 1.0, 1.0, -3.0, -3.0]), 0.0);
        // a square wave is none; nor is a constant
        assert_eq!(share(&[1.0, -1.0, 1.0, -1.0]), 0.0);
        assert_eq!(share(&[5.0; 8]), 0.0);
    }

    #[allow(clippy::float_cmp)] // times of halves
    #[test]
    fn the_longest_still_stretch_is_found() {
        let still = |values: &[f64]| {
            let window = series(values).longest_still();
            (window.from, window.to)
        };
        assert_eq!(still(&[1.0, 0.0, 0.0, 0.0, 2.0, 2.0]), (1.5, 3.0));
        assert_eq!(still(&[1.0, 2.0]), (1.0, 1.5));
    }
}
