//! How well the ratio of two powers is known that were measured above a floor.

use super::line_spectrum::gamma_quantile;

/// Draws of each interval. The ends of a 95 % interval scatter by 1 % of its width with as many.
const DRAWS: usize = 4000;
/// Seed of the draws: the same signals have the same interval.
const SEED: u64 = 0x5eed_0001;
/// Part of the draws beyond each end.
const TAIL: f64 = 0.025;
/// Least value of a gamma variable over its mean, so that nothing is divided by zero.
const LEAST: f64 = 1e-4;

/// A power with what is known of its scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scattered {
    /// Power, the floor's with it.
    pub(super) power: f64,
    /// Its relative variance.
    pub(super) variance: f64,
    /// Degrees of freedom that the variance was estimated with.
    pub(super) freedom: f64,
    /// Power of the floor.
    pub(super) floor: f64,
    /// Its relative variance.
    pub(super) floor_variance: f64,
}

impl Scattered {
    /// Power above the floor, 0 or more.
    pub(super) fn above(&self) -> f64 {
        (self.power - self.floor).max(0.0)
    }

    /// One power that would have been measured as this one.
    ///
    /// Measured powers are taken for gamma variables of as many degrees of freedom as their variance says, `nu = 2 / variance`, and the
    /// variance itself for a chi-square variable of `freedom` degrees: a few stretches may be alike by luck.
    fn draw(&self, random: &mut Random) -> f64 {
        let luck = gamma_quantile(0.5 * self.freedom, random.normal()).max(LEAST);
        let variance = (self.variance / luck).max(1e-12);
        let gamma = gamma_quantile(1.0 / variance, random.normal()).max(LEAST);
        let floor = self.floor * (1.0 + self.floor_variance.sqrt() * random.normal());
        self.power / gamma - floor
    }
}

/// The 95 % interval of 10 lg of the ratio of the powers above their floors, dB; an end is `None` where it has none: the earlier (the
/// later) power may be nothing at all.
pub(super) fn interval_db(now: &Scattered, earlier: &Scattered) -> [Option<f64>; 2] {
    let mut random = Random(SEED);
    let mut ratios: Vec<f64> = (0..DRAWS)
        .map(|draw| {
            let (now, earlier) = (now.draw(&mut random), earlier.draw(&mut random));
            match (now > 0.0, earlier > 0.0) {
                (true, true) => now / earlier,
                (true, false) => f64::INFINITY,
                (false, true) => 0.0,
                (false, false) if draw % 2 == 0 => f64::INFINITY,
                (false, false) => 0.0,
            }
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    let at = |part: f64| ratios[(part * (DRAWS - 1) as f64).round() as usize];
    [at(TAIL), at(1.0 - TAIL)].map(|ratio| {
        let db = 10.0 * ratio.log10();
        db.is_finite().then_some(db)
    })
}

/// Random numbers, the same each time (splitmix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A normal variable, by Box and Muller.
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }
}
