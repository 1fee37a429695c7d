//! Hertz stiffness of a ball on a race as a function of the in-plane curvature, from a table, and how it fades where the
//! profile comes to be curved like the roller.
//!
//! The argument is the relative curvature in the rolling plane, `A = κ_ball + κ_race`, convex positive, a defect
//! on either included; across it stays `1/ρ_b − 1/r_groove`. Elliptic integrals are evaluated at
//! the nodes only; between them k is a cubic Hermite polynomial in ln A. k falls with A: the sharper the
//! curvature, the smaller the patch.

use super::circles::Circles;
use super::rim::smoothstep;
use crate::bearing::error::BearingError;
use crate::bearing::hertz::{self, PrincipalCurvatures};

/// Intervals of the table. Over a ratio of 2600 in A the largest relative error measured on the source's
/// bearing is 8e-7 with 20, 3e-9 with 80; a bearing with closer grooves has room.
const INTERVALS: usize = 80;

/// Least in-plane relative curvature, as a fraction of the undamaged pair's: close to conformity Hertz theory would
/// give a patch of any length. The weight of a fading contact is 0.003 there.
const LEAST_RELATIVE: f64 = 0.01;

/// Greatest, likewise: an edge of a nanometre's radius on the source's ball. k is held beyond.
const MOST_RELATIVE: f64 = 1e6;

/// Half step, in ln A, of the difference that gives the slope at a node: its own error is 1e-9.
const SLOPE_STEP: f64 = 1e-4;

/// A node: k and `dk/d ln A` times the interval.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    value: f64,
    rise: f64,
}

/// k(A) for one bearing, scaled to the race's own stiffness.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CurvatureStiffness {
    least: f64,
    most: f64,
    /// Relative curvature across the rolling direction, 1/m.
    across: f64,
    log_least: f64,
    per_log: f64,
    nodes: Vec<Node>,
}

impl CurvatureStiffness {
    /// Table for A from [`LEAST_RELATIVE`] of the undamaged pair's up to `most` (1/m), at most [`MOST_RELATIVE`] times
    /// the pair's, at `race`, such that k of the undamaged pair `circles` is its own, computed or given.
    ///
    /// # Errors
    /// [`BearingError`] if Hertz theory refuses a node.
    pub(super) fn new(circles: &Circles, most: f64) -> Result<Self, BearingError> {
        Self::over(circles, [LEAST_RELATIVE * circles.relative, most])
    }

    /// The same for [`Self::of_pair`] with curvatures up to `most` (1/m).
    ///
    /// # Errors
    /// [`BearingError`] if Hertz theory refuses a node.
    pub(super) fn for_pairs(circles: &Circles, most: f64) -> Result<Self, BearingError> {
        let least = circles.across.min(LEAST_RELATIVE * circles.relative);
        Self::over(circles, [least, most / LEAST_RELATIVE])
    }

    fn over(circles: &Circles, [least, most]: [f64; 2]) -> Result<Self, BearingError> {
        let across = circles.across;
        let most = most.min(MOST_RELATIVE * circles.relative);
        let step = (most / least).ln() / INTERVALS as f64;
        let mut nodes = Vec::with_capacity(INTERVALS + 1);
        for i in 0..=INTERVALS {
            let log = least.ln() + step * i as f64;
            let value = per_modulus(across, log.exp())?;
            let above = per_modulus(across, (log + SLOPE_STEP).exp())?;
            let below = per_modulus(across, (log - SLOPE_STEP).exp())?;
            nodes.push(Node { value, rise: (above - below) / (2.0 * SLOPE_STEP) * step });
        }
        let mut table = Self { least, most, across, log_least: least.ln(), per_log: 1.0 / step, nodes };
        let scale = circles.stiffness / table.at(circles.relative);
        for node in &mut table.nodes {
            node.value *= scale;
            node.rise *= scale;
        }
        Ok(table)
    }

    /// k at relative curvature `curvature` (1/m), held at the ends of the table; N/m^{3/2}.
    #[inline]
    pub(super) fn at(&self, curvature: f64) -> f64 {
        let place = (curvature.clamp(self.least, self.most).ln() - self.log_least) * self.per_log;
        let index = (place as usize).min(INTERVALS - 1);
        let x = place - index as f64;
        let (from, to) = (self.nodes[index], self.nodes[index + 1]);
        let y = 1.0 - x;
        (from.value * (1.0 + 2.0 * x) + from.rise * x) * (y * y) + (to.value * (1.0 + 2.0 * y) - to.rise * y) * (x * x)
    }

    /// k of two relative principal curvatures (1/m, in any order), N/m^{3/2}; the lesser counts as no less than
    /// [`LEAST_RELATIVE`] of the groove's. It is that of the curvatures `c` times as large times `sqrt(c)`.
    #[inline]
    pub(super) fn of_pair(&self, [one, other]: [f64; 2]) -> f64 {
        let less = one.min(other).max(LEAST_RELATIVE * self.across);
        let ratio = self.across / less;
        self.at(one.max(other).max(less) * ratio) * ratio.sqrt()
    }
}

/// Hertz stiffness of a ball on a race over the effective modulus, at relative curvatures `across` the rolling direction
/// and `curvature` in it (1/m).
///
/// # Errors
/// [`BearingError`] for a curvature that is zero or negative: the surfaces conform.
pub(super) fn per_modulus(across: f64, curvature: f64) -> Result<f64, BearingError> {
    let bodies = PrincipalCurvatures { plane_1: across, plane_2: curvature };
    let contact = hertz::stiffness(bodies, PrincipalCurvatures::flat(), 1.0);
    contact.map(|contact| contact.stiffness).map_err(|error| BearingError(format!("contact on the defect: {error}")))
}

/// Fraction of the way from the race's curvature to the ball's at which the contact begins to
/// fade; at the ball's curvature it is gone. A choice: a ball rests on rim and floor together where the
/// floor has covered less than half of that way, so that the fade is met only when the rim carries more.
pub const FLOOR_FADE: f64 = 0.7;

/// Weight of a contact by the profile's concave curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fade {
    /// Concave curvature at which the contact is gone, 1/m.
    gone: f64,
    /// Range of curvature over which it fades, 1/m.
    width: f64,
}

impl Fade {
    /// Gone `early` (1/m) before the roller's own curvature.
    pub(super) fn new(circles: &Circles, early: f64) -> Self {
        let roller = circles.roller_curvature();
        Self { gone: roller - early, width: (1.0 - FLOOR_FADE) * (roller - circles.carrier_concavity()) }
    }

    /// Whether a profile of this concave curvature is touched at all.
    pub(super) fn touchable(&self, concavity: f64) -> bool {
        concavity < self.gone
    }

    /// 1 where the profile is flat enough, 0 where it is curved like the roller.
    #[inline]
    pub(super) fn weight(&self, concavity: f64) -> f64 {
        smoothstep((self.gone - concavity) / self.width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::samples::{source_bearing, source_stiffness};
    use crate::bearing::{ContactStiffness, Race};
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn circles(stiffness: ContactStiffness) -> Circles {
        Circles::race(&source_bearing(), Race::Outer, stiffness)
    }

    fn table_of(stiffness: ContactStiffness) -> CurvatureStiffness {
        CurvatureStiffness::new(&circles(stiffness), 21_000.0).unwrap()
    }

    fn table() -> CurvatureStiffness {
        table_of(source_stiffness())
    }

    fn direct(curvature: f64) -> f64 {
        let modulus = hertz::effective_modulus([206e9; 2], [0.3; 2]).unwrap();
        per_modulus(circles(source_stiffness()).across, curvature).unwrap() * modulus
    }

    #[test]
    fn race_itself_and_a_given_stiffness() {
        let race = 1e3 - 1.0 / 4.7565e-3;
        assert_relative_eq!(table().at(race), source_stiffness().outer(), max_relative = 1e-14);
        let given = table_of(ContactStiffness::given(1e9, 3.867e9).unwrap());
        assert_relative_eq!(given.at(race), 3.867e9, max_relative = 1e-14);
        let ratio = given.at(5e3) / table().at(5e3);
        assert_relative_eq!(ratio, 3.867e9 / source_stiffness().outer(), max_relative = 1e-12);
    }

    #[test]
    fn a_conforming_pair_is_refused() {
        let across = Circles::race(&source_bearing(), Race::Inner, source_stiffness()).across;
        let refused = per_modulus(across, 0.0);
        assert!(refused.unwrap_err().to_string().starts_with("contact on the defect: curvature difference"));
        let refused = per_modulus(across, -50.0);
        assert!(refused.unwrap_err().to_string().starts_with("contact on the defect: curvature sum"));
    }

    #[test]
    fn table_falls_and_is_held_at_its_ends() {
        let table = table();
        let k: Vec<f64> = (0..4000).map(|i| table.at(8.0 * (f64::from(i) / 500.0).exp())).collect();
        assert!(k.windows(2).all(|pair| pair[1] <= pair[0]));
        assert_relative_eq!(table.at(-50.0), table.at(7.8));
        assert_relative_eq!(table.at(1e9), table.at(21_000.0));
    }

    /// However sharp an edge is asked for, k stays positive and finite.
    #[test]
    fn the_sharpest_edge_is_a_nanometre() {
        let of = |most: f64| {
            let circles = circles(source_stiffness());
            CurvatureStiffness::new(&circles, most).unwrap()
        };
        let at_limit = of(1e9).at(1e9);
        assert!(at_limit > 0.0);
        for most in [1e12, 1e300, f64::INFINITY] {
            for curvature in [1e2, 1e5, 1e8, 1e30, f64::INFINITY] {
                assert!(of(most).at(curvature) >= 0.999 * at_limit);
            }
        }
    }

    /// Any two curvatures, in either order, from the one table; below a hundredth of the groove's the lesser is held.
    #[test]
    fn pairs_agree_with_hertz() {
        let circles = circles(source_stiffness());
        let table = CurvatureStiffness::for_pairs(&circles, 21_000.0).unwrap();
        let modulus = hertz::effective_modulus([206e9; 2], [0.3; 2]).unwrap();
        let least = LEAST_RELATIVE * (1e3 - 1.0 / 1.07e-3);
        for one in [1.0, 20.0, 65.0, 790.0, 21_000.0] {
            for other in [0.1, 3.0, 65.0, 400.0, 20_000.0] {
                let bodies = PrincipalCurvatures { plane_1: one, plane_2: f64::max(other, least) };
                let direct = hertz::stiffness(bodies, PrincipalCurvatures::flat(), modulus).unwrap();
                // 80 intervals over a ratio of 3e5
                assert_relative_eq!(table.of_pair([one, other]), direct.stiffness, max_relative = 2e-7);
                assert_relative_eq!(table.of_pair([other, one]), table.of_pair([one, other]));
            }
        }
    }

    proptest! {
        #[test]
        fn agrees_with_hertz_to_1e_8(log in 8f64.ln()..21_000f64.ln()) {
            let (table, curvature) = (table(), log.exp());
            prop_assert!((table.at(curvature) / direct(curvature) - 1.0).abs() < 1e-8);
        }
    }
}
