//! The balls side by side: what does not change of them, where they are, and what acts on them.

use super::bearing_setup::BearingSetup;
use super::inner::InnerGap;
use crate::numerics::lanes::{self, LANES, Lanes};
use std::f64::consts::TAU;

/// All balls of a bearing, in groups of [`LANES`].
#[derive(Debug, Clone)]
pub(super) struct Balls {
    pub count: usize,
    pub groups: Vec<BallGroup>,
    /// Number of each ball's flat.
    pub flat: Vec<Option<usize>>,
    /// Bounds of the kept modes' radial displacement along the raceway.
    pub mode_bounds: Vec<Lanes>,
    /// Bound of what the weight adds, m.
    pub weight_bound: f64,
}

/// Some of the balls: constants, and results of the last evaluation. What fills up the last group touches nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct BallGroup {
    /// Cosine and sine of the angle from the first ball.
    pub spacing: [Lanes; 2],
    /// That angle in turns, 0 to 1.
    pub spacing_turns: Lanes,
    /// How much larger than nominal the radius is, m; minus infinity for what fills up the group.
    pub oversize: Lanes,
    /// Cosine and sine.
    pub direction: [Lanes; 2],
    /// Angle in turns, 0 to 1.
    pub turn: Lanes,
    /// Displacement s, m, and its rate, m/s.
    pub displacement: Lanes,
    pub displacement_rate: Lanes,
    /// Displacement relative to the outer race, without the residual's part, m; minus infinity where it cannot be reached.
    pub gap: Lanes,
    /// Radial rows of the balls that are near, the others' stale \[groups of modes\]; never anything but finite numbers.
    pub rows: Vec<[Lanes; LANES]>,
    /// With a static residual: displacement of the race by the forces (m), displacement for a ball's own force (m/N), what
    /// contact damping multiplies with, force (N) and its derivative by the displacement (N/m) on the displaced race.
    pub displaced: Lanes,
    pub own: Lanes,
    pub damping: Lanes,
    pub law: [Lanes; 2],
    /// What of a change of its law a ball's force takes, as the race gives way to it alone.
    pub yields: Lanes,
    /// With it and contact damping: velocity towards the race of the kept modes, and of the race by the changing forces, m/s; rate of
    /// the force by the motion along waves or damage, N/s.
    pub approach: Lanes,
    pub yielding: Lanes,
    pub growth: Lanes,
    /// Velocity towards the outer race, m/s, and of the race by kept modes and turning where the contacts are damped.
    pub rate: Lanes,
    pub race_rate: Lanes,
    /// Displacement of the outer race along increasing angle under a ball on waves or damage, m, and its rate as the ball moves
    /// along, m/s; of other balls stale.
    pub shift: Lanes,
    pub shift_rate: Lanes,
    /// Force on the outer race, N.
    pub outer_radial: Lanes,
    pub outer_tangential: Lanes,
    /// Sum of contact force magnitudes, N.
    pub outer_magnitude: Lanes,
    /// Where the balls stand to the inner race; distances and normals of balls that are far from it are stale.
    pub inner: InnerGap<Lanes>,
    /// Sum of contact force magnitudes, N.
    pub inner_force: Lanes,
    /// Force on the inner race, N.
    pub on_inner: [Lanes; 2],
}

impl Balls {
    /// The balls of a bearing on so many groups of modes, without the bounds.
    pub(super) fn new(setup: &BearingSetup, mode_groups: usize) -> Self {
        let count = setup.balls();
        let columns = |f: &dyn Fn(usize) -> f64, rest: f64| {
            let values: Vec<f64> = (0..count).map(f).collect();
            lanes::filled(&values, rest)
        };
        let turns = columns(&|j| j as f64 / count as f64, 0.0);
        let oversizes = columns(&|j| setup.oversize(j), f64::NEG_INFINITY);
        let groups = turns.into_iter().zip(oversizes);
        Self {
            groups: groups
                .map(|(spacing_turns, oversize)| BallGroup {
                    spacing: [
                        spacing_turns.map(|turn| (TAU * turn).cos()),
                        spacing_turns.map(|turn| (TAU * turn).sin()),
                    ],
                    spacing_turns,
                    oversize,
                    gap: [f64::NEG_INFINITY; LANES],
                    rows: vec![[[0.0; LANES]; LANES]; mode_groups],
                    ..BallGroup::default()
                })
                .collect(),
            flat: (0..count).map(|ball| setup.spin(ball, 0.0).map(|(flat, _)| flat)).collect(),
            mode_bounds: Vec::new(),
            weight_bound: 0.0,
            count,
        }
    }

    /// What ball `j` has of something.
    #[inline]
    pub(super) fn get(&self, j: usize, of: impl Fn(&BallGroup) -> &Lanes) -> f64 {
        of(&self.groups[j / LANES])[j % LANES]
    }

    /// Gives ball `j` a value of something.
    #[inline]
    pub(super) fn set(&mut self, j: usize, of: impl Fn(&mut BallGroup) -> &mut Lanes, value: f64) {
        of(&mut self.groups[j / LANES])[j % LANES] = value;
    }

    /// What each ball has of something.
    pub(super) fn all(&self, of: impl Fn(&BallGroup) -> &Lanes) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |j| self.get(j, &of))
    }

    /// Unit vector towards ball `j` from the bearing's centre.
    #[inline]
    pub(super) fn direction_of(&self, j: usize) -> [f64; 2] {
        let group = &self.groups[j / LANES];
        group.direction.map(|component| component[j % LANES])
    }

    /// Where ball `j` stands to the inner race.
    #[inline]
    pub(super) fn inner_gap(&self, j: usize) -> InnerGap {
        self.groups[j / LANES].inner.get(j % LANES)
    }
}
