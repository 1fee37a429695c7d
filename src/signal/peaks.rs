//! Peaks of a spectrum, located between the bins.

use serde::Serialize;

/// A local maximum of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peak {
    /// Its frequency, Hz, by the parabola through the highest bin and its neighbours.
    pub frequency_hz: f64,
    /// Its amplitude on that parabola, in the spectrum's unit.
    pub amplitude: f64,
}

/// All local maxima of a spectrum on equally spaced frequencies (both slices of the same length; the longer one is
/// cut), in order of frequency. With bins a_(m-1) < a_m >= a_(m+1) the maximum lies
/// d = (a_(m-1) - a_(m+1)) / (2 (a_(m-1) - 2 a_m + a_(m+1))) bins beside bin m, and is a_m - d (a_(m-1) - a_(m+1)) / 4
/// high. The first and the last bin are no maxima.
pub fn local_maxima(frequency_hz: &[f64], amplitude: &[f64]) -> Vec<Peak> {
    frequency_hz
        .windows(3)
        .zip(amplitude.windows(3))
        .filter(|(_, a)| a[0] < a[1] && a[1] >= a[2])
        .map(|(f, a)| {
            let slope = a[0] - a[2];
            let shift = 0.5 * slope / (a[0] - 2.0 * a[1] + a[2]);
            Peak { frequency_hz: f[1] + shift * 0.5 * (f[2] - f[0]), amplitude: a[1] - 0.25 * slope * shift }
        })
        .collect()
}

/// The highest local maximum with |f - `wanted_hz`| <= `within` `wanted_hz` (relative: 0.03 for 3 %), or `None` if
/// the spectrum has no maximum there: a slope towards a line outside is not a peak.
pub fn peak_near(frequency_hz: &[f64], amplitude: &[f64], wanted_hz: f64, within: f64) -> Option<Peak> {
    let reach = within * wanted_hz.abs();
    let is_near = |f: f64| (f - wanted_hz).abs() <= reach;
    // One bin more on each side, for a maximum whose highest bin lies just outside.
    let bin = frequency_hz.get(1)? - frequency_hz.first()?;
    let first = frequency_hz.partition_point(|f| *f < wanted_hz - reach - 2.0 * bin);
    let end = frequency_hz.partition_point(|f| *f <= wanted_hz + reach + 2.0 * bin);
    local_maxima(frequency_hz.get(first..end)?, amplitude.get(first..end.min(amplitude.len()))?)
        .into_iter()
        .filter(|p| is_near(p.frequency_hz))
        .max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis() -> Vec<f64> {
        (0..400).map(|m| f64::from(m) * 0.25).collect()
    }

    /// Two parabolic humps, at 20.1 (height 3) and 55.06 Hz (height 5), zero elsewhere.
    fn humps() -> Vec<f64> {
        let hump = |f: f64, at: f64, height: f64| (height - (f - at).powi(2)).max(0.0);
        axis().iter().map(|f| hump(*f, 20.1, 3.0) + hump(*f, 55.06, 5.0)).collect()
    }

    #[test]
    fn parabola_is_found_exactly() {
        let peaks = local_maxima(&axis(), &humps());
        assert_eq!(peaks.len(), 2);
        for (peak, (f, a)) in peaks.iter().zip([(20.1, 3.0), (55.06, 5.0)]) {
            assert!((peak.frequency_hz - f).abs() < 1e-12);
            assert!((peak.amplitude - a).abs() < 1e-12);
        }
    }

    #[test]
    fn search_stays_inside_and_ignores_slopes() {
        let near = |f, within| peak_near(&axis(), &humps(), f, within).map(|p| p.frequency_hz);
        let close = |found: Option<f64>, f: f64| found.is_some_and(|x| (x - f).abs() < 1e-9);
        assert!(close(near(55.0, 0.03), 55.06));
        assert!(close(near(40.0, 0.6), 55.06));
        assert!(close(near(20.1, 1e-6), 20.1));
        // 54 Hz +- 1.5 % ends at 54.8 Hz, on the slope below the maximum.
        assert_eq!(near(54.0, 0.015), None);
        assert_eq!(near(80.0, 0.1), None);
        assert_eq!(near(1000.0, 0.1), None);
        assert_eq!(peak_near(&[], &[], 10.0, 0.1), None);
    }

    #[test]
    fn a_flat_top_is_one_peak() {
        let f: Vec<f64> = (0..5).map(f64::from).collect();
        let peaks = local_maxima(&f, &[0.0, 1.0, 1.0, 0.0, 0.0]);
        assert_eq!(peaks.len(), 1);
        assert!((peaks[0].frequency_hz - 1.5).abs() < 1e-12);
    }
}
