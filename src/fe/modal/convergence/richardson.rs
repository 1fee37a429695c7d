//! Richardson's extrapolation with the grid convergence index as uncertainty.

use super::super::ModalError;
use super::super::error::{check_count, check_finite};
use super::fit::{Law, law_past_many, limit_of_two, order_of_three};
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
/// [`ModalError::TooFewMeshes`], [`ModalError::SameSize`], [`ModalError::Shape`] for another number of values,
/// [`ModalError::NotFinite`], [`ModalError::Option`] for a size or an order that is not positive.
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
        let positive = |name, found: f64| match found > 0.0 && found.is_finite() {
            true => Ok(()),
            false => Err(ModalError::Option { name, expected: "a positive number", found }),
        };
        positive("formal order", self.formal_order)?;
        self.sizes.iter().try_for_each(|&size| positive("mesh size", size))?;
        if self.sizes.len() < 2 {
            return Err(ModalError::TooFewMeshes { found: self.sizes.len() });
        }
        let mut order: Vec<usize> = (0..self.sizes.len()).collect();
        order.sort_by(|&a, &b| self.sizes[a].total_cmp(&self.sizes[b]));
        for pair in order.windows(2) {
            let [finer, coarser] = [self.sizes[pair[0]], self.sizes[pair[1]]];
            if coarser < LEAST_RATIO * finer {
                return Err(ModalError::SameSize { finer, coarser });
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
        match law {
            None => self.without_limit(Behaviour::Diverging, high - low),
            Some(law) => self.by_law(law),
        }
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
