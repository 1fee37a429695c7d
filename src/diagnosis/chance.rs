//! What noise alone does to a spectrum: probabilities of peaks over a local median, of several together, and of the largest
//! in a search.
//!
//! The bins of noise's spectrum are complex normal numbers, so that their power is exponentially distributed, whatever its
//! level; bins 1 / T apart are independent.

/// Peaks of a spectrum of length T without a taper: upcrossings per natural bin 1 / T, `T_eff / T = sqrt(4 pi var(t)) / T =
/// sqrt(4 pi / 12)`. Source: R. V. Baluev, Mon. Not. R. Astron. Soc. 385 (2008) 1279.
const UPCROSSINGS: f64 = 1.023_326_707_946_488_5;

/// Natural logarithm of the probability that a bin's power is above `ratio` times the median of `neighbours` (odd) others:
///
/// `P = prod_(i=0..k) (n - i) / (n - i + ratio)`, n = `neighbours` = 2 k + 1.
///
/// The median of n exponential variables is the sum of k + 1 exponential ones with rates n, n - 1, ..., n - k (Renyi); P is its
/// Laplace transform. So the uncertainty of a floor from few bins is in it.
#[must_use]
pub fn log_exceedance(ratio: f64, neighbours: usize) -> f64 {
    let lowest = neighbours - neighbours / 2;
    let rates = lowest..=neighbours;
    -rates.map(|rate| (ratio / rate as f64).ln_1p()).sum::<f64>()
}

/// Natural logarithm of the probability that `count` >= 1 independent exponential variables add up to more than `sum` >= 0:
/// `exp(-s) sum_(j < count) s^j / j!` (Fisher's combination of probabilities, s = -sum ln p).
#[must_use]
pub fn log_gamma_tail(count: usize, sum: f64) -> f64 {
    let mut term = 1.0;
    let mut series = 1.0;
    for j in 1..count {
        term *= sum / j as f64;
        series += term;
    }
    series.ln() - sum
}

/// Probability that the best of a search is as good as `sum` by chance. At each place of the search `count` bins are
/// added up as in [`log_gamma_tail`]; from end to end they move by `bins` natural bins (root mean square over them).
///
/// `P = 1 - (1 - p) exp(-tau)`, p that of one place, `tau = 1.023 bins s^(count - 1/2) exp(-s) / (count - 1)!` the expected number of
/// upcrossings (Rice; for one bin Baluev's formula). An upper bound where upcrossings come in groups.
#[must_use]
pub fn search_probability(count: usize, sum: f64, bins: f64) -> f64 {
    let place = log_gamma_tail(count, sum).exp();
    let factorial: f64 = (1..count).map(|j| (j as f64).ln()).sum();
    let crossings = UPCROSSINGS * bins * ((count as f64 - 0.5) * sum.ln() - sum - factorial).exp();
    // 1 - (1 - p) exp(-tau) without cancellation
    (place - (1.0 - place) * (-crossings).exp_m1()).clamp(0.0, 1.0)
}

/// Probability that the best of `trials` independent ones is as good as one of probability `chance`, `1 - (1 - p)^n`; an upper
/// bound where they depend on each other as spectra of one signal do.
#[must_use]
pub fn any_of(chance: f64, trials: usize) -> f64 {
    // without cancellation
    -(trials as f64 * (-chance).ln_1p()).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that are as good as random: splitmix64, then the exponential distribution.
    struct Random(u64);

    impl Random {
        fn exponential(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            let unit = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
            -(1.0 - unit).ln()
        }
    }

    #[test]
    fn a_peak_over_the_median_is_as_rare_as_it_is_said_to_be() {
        let mut random = Random(7);
        for (neighbours, ratio) in [(17, 3.0), (25, 5.0), (5, 2.0)] {
            let draws = 100_000;
            let mut above = 0;
            for _ in 0..draws {
                let mut others: Vec<f64> = (0..neighbours).map(|_| random.exponential()).collect();
                others.sort_by(f64::total_cmp);
                above += usize::from(random.exponential() > ratio * others[neighbours / 2]);
            }
            let expected = log_exceedance(ratio, neighbours).exp();
            let found = f64::from(u32::try_from(above).unwrap()) / f64::from(draws);
            // four standard deviations of the count
            let scatter = 4.0 * (expected / f64::from(draws)).sqrt();
            assert!(
                (found - expected).abs() < scatter,
                "{neighbours}: {found} against {expected}"
            );
        }
        // many neighbours: the exponential distribution, whose median is ln 2
        let limit = log_exceedance(5.0, 100_001) / (-5.0 * 2.0_f64.ln());
        assert!((limit - 1.0).abs() < 1e-4, "{limit}");
    }

    #[test]
    fn sums_have_the_gamma_distribution() {
        // scipy.stats.gamma.sf(s, k), SciPy 1.17.1
        for (count, sum, expected) in [
            (1, 2.0, 0.135_335_283_236_612_7),
            (3, 7.5, 0.020_256_715_056_664_39),
            (8, 20.0, 0.000_778_590_082_507_362),
        ] {
            let found = log_gamma_tail(count, sum).exp();
            assert!((found / expected - 1.0).abs() < 1e-9, "{count}: {found}");
        }
        assert!(log_gamma_tail(8, 2000.0).is_finite());
    }

    #[test]
    fn the_best_of_several_is_likelier() {
        assert!((any_of(0.5, 3) - 0.875).abs() < 1e-15);
        assert!((any_of(1e-300, 4) / 4e-300 - 1.0).abs() < 1e-12);
        assert!((any_of(1.0, 2) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_search_is_more_likely_to_find_something_the_wider_it_is() {
        let at = |bins| search_probability(3, 12.0, bins);
        let place = log_gamma_tail(3, 12.0).exp();
        assert!((at(0.0) / place - 1.0).abs() < 1e-12);
        assert!(at(1.0) > at(0.1) && at(10.0) > 5.0 * at(1.0));
        assert!((at(1e9) - 1.0).abs() < 1e-12);
        assert!(search_probability(8, 900.0, 10.0) < 1e-300);
    }
}
