//! The law `f(h) = f_0 + c h^p` through three values or past more of them.

/// Orders that are looked for. Below the first a sequence does not converge to speak of.
const ORDERS: [f64; 2] = [0.05, 20.0];

/// Steps of a bisection or of a golden section: each leaves 0.5 or 0.62 of the range.
const STEPS: usize = 80;

/// A law and how well it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Law {
    /// p.
    pub order: f64,
    /// f_0.
    pub limit: f64,
    /// Standard deviation of the values from the law; 0 for three values.
    pub deviation: f64,
    /// Distance of the finest value from the law.
    pub finest: f64,
}

/// Order p of three values at sizes h_1 < h_2 < h_3, from `(f_3 - f_2) / (f_2 - f_1) = (h_3^p - h_2^p) / (h_2^p - h_1^p)`;
/// `None` if there is none between 0.05 and 20.
///
/// The right side rises with p, from `ln(h_3/h_2) / ln(h_2/h_1)` at 0. Source: Roache (1994), for any ratio of sizes.
pub(super) fn order_of_three(h: [f64; 3], f: [f64; 3]) -> Option<f64> {
    let ratio = (f[2] - f[1]) / (f[1] - f[0]);
    let excess = |p: f64| {
        let [a, b] = [h[1] / h[0], h[2] / h[1]].map(|r: f64| p * r.ln());
        // (h_3^p - h_2^p) / (h_2^p - h_1^p), with h_2^p taken out
        b.exp_m1() / -(-a).exp_m1() - ratio
    };
    let [mut low, mut high] = ORDERS;
    if !ratio.is_finite() || excess(low) > 0.0 || excess(high) < 0.0 {
        return None;
    }
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(0.5 * (low + high))
}

/// The limit that a given order leaves between the two finest values: `f_1 + (f_1 - f_2) / ((h_2/h_1)^p - 1)`.
pub(super) fn limit_of_two(h: [f64; 2], f: [f64; 2], order: f64) -> f64 {
    f[0] + (f[0] - f[1]) / (order * (h[1] / h[0]).ln()).exp_m1()
}

/// Weighted least squares past four values or more, weights 1/h so that fine meshes count more (Eca and Hoekstra 2014).
/// `None` if the best order lies at the end of the range.
pub(super) fn law_past_many(h: &[f64], f: &[f64]) -> Option<Law> {
    let error = |order: f64| with_order(h, f, order).1;
    let [mut low, mut high] = ORDERS;
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..STEPS {
        let [a, b] = [high - golden * (high - low), low + golden * (high - low)];
        if error(a) < error(b) {
            high = b;
        } else {
            low = a;
        }
    }
    let order = 0.5 * (low + high);
    let margin = 1e-3;
    if order < ORDERS[0] + margin || order > ORDERS[1] - margin {
        return None;
    }
    let (law, _) = with_order(h, f, order);
    law.limit.is_finite().then_some(law)
}

/// The best law of a given order, and the weighted sum of its squares.
pub(super) fn with_order(h: &[f64], f: &[f64], order: f64) -> (Law, f64) {
    let finest = h.iter().copied().fold(f64::INFINITY, f64::min);
    let base = f.first().copied().unwrap_or(0.0);
    let terms = || h.iter().zip(f).map(|(h, f)| (finest / h, (order * (h / finest).ln()).exp(), f - base));
    let total: f64 = terms().map(|(weight, ..)| weight).sum();
    let mean_x = terms().map(|(weight, x, _)| weight * x).sum::<f64>() / total;
    let mean_y = terms().map(|(weight, _, y)| weight * y).sum::<f64>() / total;
    let xx: f64 = terms().map(|(weight, x, _)| weight * (x - mean_x).powi(2)).sum();
    let xy: f64 = terms().map(|(w, x, y)| w * (x - mean_x) * (y - mean_y)).sum();
    let slope = xy / xx;
    let at_zero = mean_y - slope * mean_x;
    let squares: f64 = terms().map(|(w, x, y)| w * (y - at_zero - slope * x).powi(2)).sum();
    let freedom = f.len().saturating_sub(3).max(1) as f64;
    let law = Law {
        order,
        limit: base + at_zero,
        deviation: (squares / total * f.len() as f64 / freedom).sqrt(),
        finest: (at_zero + slope).abs(),
    };
    (law, squares)
}
