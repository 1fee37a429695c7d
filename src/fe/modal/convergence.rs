//! How far frequencies of a mesh are from those of an infinitely fine one, from two meshes or more.
//!
//! Richardson's extrapolation with the grid convergence index as uncertainty.

use super::error::{ModalError, check_count, check_finite, check_value};
use schemars::JsonSchema;
use serde::Serialize;

/// Safety factor where the observed order is near the formal one. Source: Roache (1994).
const SAFETY: f64 = 1.25;

/// Safety factor where it is not, or is not known. Source: Roache (1994).
const CAUTIOUS_SAFETY: f64 = 3.0;

/// How near the observed order must be to the formal one, relative. Source: Oberkampf and Roy, Verification and
/// Validation in Scientific Computing (2010), chapter 8.
const NEAR: f64 = 0.1;

/// Smallest order that an uncertainty is formed with where the observed one is far from the formal one. Source: as
/// for `NEAR`.
const LEAST_ORDER: f64 = 0.5;

/// Differences below this part of the value are round-off of an eigenvalue computation.
const ROUND_OFF: f64 = 1e-11;

/// Least ratio of the sizes of two meshes.
const LEAST_RATIO: f64 = 1.01;

/// Sizes of the meshes and what the elements promise.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshLevels {
    /// Typical element size of each mesh, any unit, > 0, in any order; at least two, 1 % apart.
    pub sizes: Vec<f64>,
    /// Order p of the frequency's error `c h^p` in a smooth body, > 0: 2 for linear elements, 4 for quadratic ones.
    /// (Eigenvalues converge with `2 (k + 1 - m)`, k the degree, m = 1: Strang and Fix, chapter 6.)
    pub formal_order: f64,
}

/// How a value changes from mesh to mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Behaviour {
    /// All values agree up to round-off.
    Settled,
    /// Two meshes: nothing can be said about it; the formal order is taken.
    Unknown,
    /// In one direction with shrinking steps, and the order is within 10 % of the formal one.
    Asymptotic,
    /// In one direction with shrinking steps, at another order: meshes too coarse, or a singularity.
    Monotone,
    /// To and fro.
    Oscillating,
    /// In one direction with steps that do not shrink.
    Diverging,
}

/// What a sequence of values says about its limit.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Convergence {
    /// Value of the finest mesh.
    pub finest: f64,
    /// Extrapolated value; `None` where there is nothing to extrapolate (oscillating, diverging).
    pub estimate: Option<f64>,
    /// Order observed; `None` for two meshes and where there is none.
    pub order: Option<f64>,
    /// The limit is expected within this of the *finest* value, same unit.
    pub uncertainty: f64,
    /// Factor in the uncertainty; `None` where that is the range of the values.
    pub safety_factor: Option<f64>,
    /// How the values behave.
    pub behaviour: Behaviour,
}

impl Behaviour {
    /// In a few words, for tables.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Settled => "the same on all meshes",
            Self::Unknown => "two meshes, order assumed",
            Self::Asymptotic => "converges at the formal order",
            Self::Monotone => "converges at another order",
            Self::Oscillating => "oscillates: not extrapolated",
            Self::Diverging => "does not converge: not extrapolated",
        }
    }
}

impl Convergence {
    /// Where the limit is expected: the finest value and the uncertainty to either side.
    pub fn interval(&self) -> [f64; 2] {
        [self.finest - self.uncertainty, self.finest + self.uncertainty]
    }
}

/// Limit of a value that was computed on several meshes, and its uncertainty.
///
/// With `f = f_0 + c h^p`: two meshes take the formal order, three give their own, more are fitted by least squares
/// with weights 1/h. The uncertainty is Roache's grid convergence index `F_s |f_1 - f_2| / ((h_2/h_1)^p - 1)`, with
/// `F_s = 1.25` where three meshes or more show an order within 10 % of the formal one, and otherwise 3 with p
/// held between 0.5 and the formal order. A fit adds its standard deviation and its distance from the finest value.
/// Values that oscillate or diverge are not extrapolated; their range is the uncertainty. Sources: Roache (1994);
/// Oberkampf and Roy (2010), chapter 8; Eca and Hoekstra (2014) for the fit.
///
/// # Errors
/// [`ModalError::Shape`] for another number of values, [`ModalError::Invalid`] for fewer than two meshes, two of one size, values
/// that are not finite, and a size or an order that is not positive.
pub fn richardson(levels: &MeshLevels, values: &[f64]) -> Result<Convergence, ModalError> {
    let order = levels.finest_first()?;
    check_count("values of a sequence of meshes", order.len(), values.len())?;
    check_finite("value on mesh", values)?;
    let h: Vec<f64> = order.iter().map(|&mesh| levels.sizes[mesh]).collect();
    let f: Vec<f64> = order.iter().map(|&mesh| values[mesh]).collect();
    Ok(Sequence { h: &h, f: &f, formal: levels.formal_order }.convergence())
}

impl MeshLevels {
    /// Whether an extrapolation can be made from these.
    ///
    /// # Errors
    /// As [`richardson`], as far as it looks at the meshes.
    pub fn check(&self) -> Result<(), ModalError> {
        self.finest_first().map(drop)
    }

    /// The meshes by size, finest first.
    fn finest_first(&self) -> Result<Vec<usize>, ModalError> {
        let positive =
            |name, found: f64| check_value(name, "a positive number", found, found > 0.0 && found.is_finite());
        positive("formal order", self.formal_order)?;
        self.sizes.iter().try_for_each(|&size| positive("mesh size", size))?;
        if self.sizes.len() < 2 {
            let found = self.sizes.len();
            let what = format!("{found} meshes: an estimate of the discretisation error needs at least 2");
            return Err(ModalError::Invalid(what));
        }
        let mut order: Vec<usize> = (0..self.sizes.len()).collect();
        order.sort_by(|&a, &b| self.sizes[a].total_cmp(&self.sizes[b]));
        for pair in order.windows(2) {
            let [finer, coarser] = [self.sizes[pair[0]], self.sizes[pair[1]]];
            if coarser < LEAST_RATIO * finer {
                let what =
                    format!("two meshes have sizes {finer:e} and {coarser:e}: expected them to differ by 1 % at least");
                return Err(ModalError::Invalid(what));
            }
        }
        Ok(order)
    }
}

/// Values by size, finest first; two at least.
struct Sequence<'a> {
    h: &'a [f64],
    f: &'a [f64],
    formal: f64,
}

impl Sequence<'_> {
    fn convergence(&self) -> Convergence {
        let (low, high) = self.f.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &f| (l.min(f), h.max(f)));
        let size = low.abs().max(high.abs());
        if high - low <= ROUND_OFF * size {
            return Convergence {
                estimate: Some(self.f[0]),
                ..self.without_limit(Behaviour::Settled, ROUND_OFF * size)
            };
        }
        if self.f.len() == 2 {
            return self.by_two(self.formal, Behaviour::Unknown, None);
        }
        // steps towards the finest mesh; those of round-off have no direction
        let steps = self.f.windows(2).map(|pair| pair[0] - pair[1]);
        let (mut up, mut down) = (false, false);
        for step in steps.filter(|step| step.abs() > ROUND_OFF * size) {
            up |= step > 0.0;
            down |= step < 0.0;
        }
        if up && down {
            return self.without_limit(Behaviour::Oscillating, high - low);
        }
        let law = match (self.h, self.f) {
            (&[h1, h2, h3], &[f1, f2, f3]) => order_of_three([h1, h2, h3], [f1, f2, f3]).map(|order| Law {
                order,
                limit: limit_of_two([h1, h2], [f1, f2], order),
                deviation: 0.0,
                finest: 0.0,
            }),
            (h, f) => law_past_many(h, f),
        };
        law.map_or_else(|| self.without_limit(Behaviour::Diverging, high - low), |law| self.by_law(law))
    }

    fn by_law(&self, law: Law) -> Convergence {
        let near = (law.order / self.formal - 1.0).abs() <= NEAR;
        let around = law.deviation + law.finest;
        if near {
            return Convergence {
                finest: self.f[0],
                estimate: Some(law.limit),
                order: Some(law.order),
                uncertainty: SAFETY * (self.f[0] - law.limit).abs() + around,
                safety_factor: Some(SAFETY),
                behaviour: Behaviour::Asymptotic,
            };
        }
        let held = law.order.min(self.formal).max(LEAST_ORDER.min(self.formal));
        let mut found = self.by_two(held, Behaviour::Monotone, Some(law.order));
        found.uncertainty += around;
        found
    }

    /// From the two finest meshes at a given order, with the cautious factor.
    fn by_two(&self, order: f64, behaviour: Behaviour, observed: Option<f64>) -> Convergence {
        let limit = limit_of_two([self.h[0], self.h[1]], [self.f[0], self.f[1]], order);
        Convergence {
            finest: self.f[0],
            estimate: Some(limit),
            order: observed,
            uncertainty: CAUTIOUS_SAFETY * (self.f[0] - limit).abs(),
            safety_factor: Some(CAUTIOUS_SAFETY),
            behaviour,
        }
    }

    fn without_limit(&self, behaviour: Behaviour, uncertainty: f64) -> Convergence {
        Convergence { finest: self.f[0], estimate: None, order: None, uncertainty, safety_factor: None, behaviour }
    }
}

/// Orders that are looked for. Below the first a sequence does not converge to speak of.
const ORDERS: [f64; 2] = [0.05, 20.0];

/// Steps of a bisection or of a golden section: each leaves 0.5 or 0.62 of the range.
const STEPS: usize = 80;

/// A law and how well it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Law {
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
fn order_of_three(h: [f64; 3], f: [f64; 3]) -> Option<f64> {
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
fn limit_of_two(h: [f64; 2], f: [f64; 2], order: f64) -> f64 {
    f[0] + (f[0] - f[1]) / (order * (h[1] / h[0]).ln()).exp_m1()
}

/// Weighted least squares past four values or more, weights 1/h so that fine meshes count more (Eca and Hoekstra 2014).
/// `None` if the best order lies at the end of the range.
fn law_past_many(h: &[f64], f: &[f64]) -> Option<Law> {
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
fn with_order(h: &[f64], f: &[f64], order: f64) -> (Law, f64) {
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

#[cfg(test)]
mod tests;
