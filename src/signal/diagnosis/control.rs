//! How good a comb is by chance, measured on the signal itself: the same comb at orders at which nothing is known to strike.

/// Orders at which the comb is tried.
const CONTROLS: u32 = 400;
/// They lie within this factor of the part's own order, to each side.
const SPREAD: f64 = 2.0;
/// And no nearer to it than this part of it, or twice the reach of its search.
const NEAREST: f64 = 0.03;
/// Fewest controls that a distribution is taken from.
const FEWEST: usize = 40;

/// Distribution of the best score of a search by chance: Gumbel's, since it is the largest of many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ByChance {
    /// Most likely score.
    mode: f64,
    /// Scale.
    pub(super) scale: f64,
}

impl ByChance {
    /// From the scores at control orders: the quartiles decide, so that a few of them that meet lines of something else do not.
    /// `None` for fewer than 40.
    pub(super) fn of(mut scores: Vec<f64>) -> Option<Self> {
        if scores.len() < FEWEST {
            return None;
        }
        scores.sort_by(f64::total_cmp);
        let quantile = |part: f64| scores[(part * (scores.len() - 1) as f64).round() as usize];
        // F = exp(-exp(-z)): z = -ln(-ln F)
        let place = |part: f64| -(-f64::ln(part)).ln();
        let scale = (quantile(0.75) - quantile(0.25)) / (place(0.75) - place(0.25));
        let scale = scale.max(1e-6);
        Some(Self { mode: quantile(0.5) - place(0.5) * scale, scale })
    }

    /// Probability of a score as good or better, in the best of so many searches.
    pub(super) fn probability(&self, score: f64, searches: f64) -> f64 {
        let expected = searches * (-(score - self.mode) / self.scale).exp();
        -(-expected).exp_m1()
    }
}

/// Control orders over the part's own.
pub(super) fn factors(relative_reach: f64) -> impl Iterator<Item = f64> {
    let gap = NEAREST.max(2.0 * relative_reach);
    let span = 2.0 * SPREAD.ln();
    (0..CONTROLS).filter_map(move |control| {
        let part = (f64::from(control) + 0.5) / f64::from(CONTROLS);
        let factor = (span * (part - 0.5)).exp();
        ((factor - 1.0).abs() >= gap).then_some(factor)
    })
}
