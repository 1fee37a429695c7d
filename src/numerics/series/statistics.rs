//! Figures that sum a signal up: mean, RMS, peak, kurtosis.

use super::TimeSeries;

impl TimeSeries {
    /// Mean value, in the series' unit; the mean of what a first pass left is added, so that the rounding of a long
    /// sum (1e-11 of the mean for 3e5 samples) does not show.
    pub(crate) fn mean(&self) -> f64 {
        let samples = self.values().len() as f64;
        let first = self.values().iter().sum::<f64>() / samples;
        first + self.values().iter().map(|v| v - first).sum::<f64>() / samples
    }

    /// Root mean square of the values as they are, the mean NOT removed: sqrt(1/n sum x_k^2), in the series' unit.
    pub fn rms(&self) -> f64 {
        root_mean_square(self.values())
    }

    /// Largest absolute value, the mean NOT removed, in the series' unit.
    pub(crate) fn peak(&self) -> f64 {
        self.values().iter().fold(0.0, |peak, v| v.abs().max(peak))
    }

    /// Kurtosis after Pearson, mean removed, biased (no small-sample correction):
    /// (1/n sum (x - mean)^4) / (1/n sum (x - mean)^2)^2; dimensionless, >= 1. A normal distribution has 3, a
    /// sinusoid 1.5; repeated impacts of a local defect drive it well above 3. Equal to
    /// `scipy.stats.kurtosis(x, fisher=False)`.
    ///
    /// `None` for a constant signal, whose scatter is zero within rounding.
    pub(crate) fn kurtosis(&self) -> Option<f64> {
        let mean = self.mean();
        let samples = self.values().len() as f64;
        let moment = |power: i32| self.values().iter().map(|v| (v - mean).powi(power)).sum::<f64>() / samples;
        let variance = moment(2);
        // Rounding of the mean alone leaves about (epsilon |mean|)^2 of variance.
        let rounding = (4.0 * f64::EPSILON * self.peak()).powi(2);
        (variance > rounding).then(|| moment(4) / (variance * variance))
    }
}

/// sqrt(1/n sum x_k^2) of a slice; 0 for an empty one.
pub(crate) fn root_mean_square(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.0, 1e-3, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn sinusoid_with_offset() {
        // 20 whole periods: mean 0.5, RMS sqrt(0.25 + 2^2 / 2), peak 2.5, kurtosis 3/2 whatever the offset.
        let x = series((0..1000).map(|k| 0.5 + 2.0 * (2.0 * PI * 0.02 * k as f64).cos()).collect());
        assert!((x.mean() - 0.5).abs() < 1e-13);
        assert!((x.rms() - 2.25_f64.sqrt()).abs() < 1e-13);
        assert!((x.peak() - 2.5).abs() < 1e-13);
        assert!((x.kurtosis().expect("not constant") - 1.5).abs() < 1e-12);
    }

    #[test]
    fn kurtosis_agrees_with_scipy_and_is_three_for_normal() {
        // scipy.stats.kurtosis([1, 2, 2, 3, 9, -4, 0.5], fisher=False)
        let x = series(vec![1.0, 2.0, 2.0, 3.0, 9.0, -4.0, 0.5]);
        let scipy = 3.291_140_518_499_667;
        assert!((x.kurtosis().expect("not constant") - scipy).abs() < 1e-12);
        // Sum of 12 uniform numbers: kurtosis 3 - 6/5/12 = 2.9; the scatter of the estimate is sqrt(24/n) = 0.011.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let x = series((0..200_000).map(|_| (0..12).map(|_| uniform()).sum()).collect());
        assert!((x.kurtosis().expect("not constant") - 2.9).abs() < 0.04);
    }

    #[test]
    fn constant_signal_has_no_kurtosis() {
        assert_eq!(series(vec![0.1; 300_001]).kurtosis(), None);
        assert_eq!(series(vec![0.0; 7]).kurtosis(), None);
    }
}
