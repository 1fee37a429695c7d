//! The ridge of a scalogram: the frequency of the strongest line over time.

use super::{Peak, Scalogram};

impl Scalogram {
    /// For each instant the highest local maximum over frequency with its neighbours within `from_hz` to `to_hz`, or `None`
    /// where there is none (the amplitude rises towards one of the limits). Between the frequencies of the axis by the
    /// parabola of log amplitude over 1 / f, which is exact for a tone but for the wavelet's small mean correction.
    pub fn ridge(&self, from_hz: f64, to_hz: f64) -> Vec<Option<Peak>> {
        let first = self.frequency_hz.partition_point(|f| *f < from_hz);
        let end = self.frequency_hz.partition_point(|f| *f <= to_hz);
        let rows: Vec<&[f64]> = (first..end).map(|index| self.row(index)).collect();
        let hz = self.frequency_hz.get(first..end).unwrap_or_default();
        let at = |instant: usize| {
            let is_top = |k: &usize| {
                let middle = rows[*k][instant];
                rows[k - 1][instant] < middle && middle >= rows[k + 1][instant]
            };
            let last = rows.len().saturating_sub(1);
            let highest = (1..last).filter(is_top).max_by(|a, b| rows[*a][instant].total_cmp(&rows[*b][instant]))?;
            let around = |k: usize| (1.0 / hz[k], rows[k][instant]);
            Some(top(around(highest - 1), around(highest), around(highest + 1)))
        };
        (0..self.time_s.len()).map(at).collect()
    }
}

/// Vertex of the parabola through ln a at three places u = 1 / f; the middle point where an amplitude is zero.
fn top(left: (f64, f64), middle: (f64, f64), right: (f64, f64)) -> Peak {
    let rise = |a: (f64, f64), b: (f64, f64)| (b.1 / a.1).ln() / (b.0 - a.0);
    let (before, after) = (rise(left, middle), rise(middle, right));
    let curvature = (after - before) / (right.0 - left.0);
    // slope at u is before + curvature (2 u - u_left - u_middle)
    let shift = 0.5 * (left.0 + middle.0 - before / curvature) - middle.0;
    if !shift.is_finite() {
        return Peak { frequency_hz: 1.0 / middle.0, amplitude: middle.1 };
    }
    Peak { frequency_hz: 1.0 / (middle.0 + shift), amplitude: middle.1 * (-curvature * shift * shift).exp() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gaussian_over_period_is_found_exactly() {
        let frequency_hz = vec![90.0, 96.0, 101.0, 107.0, 120.0, 140.0];
        let value = |f: &f64| 3.0 * (-40.0 * (100.0 / f - 1.0_f64).powi(2)).exp();
        let scalogram = Scalogram {
            time_s: vec![0.0],
            amplitude: frequency_hz.iter().map(value).collect(),
            cone_s: vec![0.0; 6],
            frequency_hz,
            unit: "m".into(),
            cycles: 6.0,
        };
        let found = scalogram.ridge(80.0, 150.0)[0].expect("a maximum");
        assert!((found.frequency_hz - 100.0).abs() < 1e-9, "{found:?}");
        assert!((found.amplitude - 3.0).abs() < 1e-12, "{found:?}");
        assert!(scalogram.ridge(95.0, 110.0)[0].is_some());
        // rises to the edge, or too few frequencies
        assert_eq!(scalogram.ridge(105.0, 150.0), [None]);
        assert_eq!(scalogram.ridge(99.0, 108.0), [None]);
        assert_eq!(scalogram.ridge(200.0, 100.0), [None]);
    }

    #[test]
    fn zeros_do_no_harm() {
        let peak = top((3.0, 0.0), (2.0, 1.0), (1.0, 0.0));
        assert!((peak.frequency_hz - 0.5).abs() < 1e-15 && (peak.amplitude - 1.0).abs() < 1e-15);
    }
}
