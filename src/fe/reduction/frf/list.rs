//! Frequencies at which a response is worth computing.

use super::band::check_band;
use super::error::{FrfError, check_coefficients, wrong_frequency};

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
