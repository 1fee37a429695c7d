//! The balls of one bearing side by side: constants, and results of the last evaluation.

use super::damage::DamagedRace;
use super::groove_lanes::{Felt, GrooveLaw};
use super::setup::BearingInPlace;
use crate::bearing::RotationCursor;
use crate::fe::model::RingSeat;
use crate::numerics::lanes::{self, LANES, Lanes};
use crate::system::StructureModes;
use crate::system::raceway::RacewayTable;
use std::f64::consts::TAU;

/// One bearing in the hot loop.
#[derive(Debug, Clone)]
pub(super) struct BearingBalls {
    pub count: usize,
    pub groups: Vec<BallGroup>,
    pub inner: GrooveLaw,
    pub outer: GrooveLaw,
    /// Radial and axial displacement of the outer groove's centre by kept modes.
    pub rows: [RacewayTable; 2],
    /// Radius rho_o of the circle of the outer groove's centres, m.
    pub base: f64,
    /// Distance from the axis at which a ball touches the outer race, m.
    pub race_radius: f64,
    /// Inner groove's centre at rest against the outer one, radial and axial, m.
    pub gap: [f64; 2],
    /// 1 / mass of a ball, 1/kg.
    pub mobility: f64,
    /// M_g = this times cage speed squared times the sine of the outer contact angle, N m s^2.
    pub gyroscopic: f64,
    /// Friction over M_g at inner and outer race, 1/m.
    pub friction: [f64; 2],
    /// Defects of the inner and the outer race.
    pub damage: [Option<DamagedRace>; 2],
    /// Tangential displacement of the outer race by kept modes, where it has defects.
    pub tangential: Option<RacewayTable>,
    pub cursor: RotationCursor,
    /// Speed of the cage, rad/s, and ball 0 in turns.
    pub cage_speed: f64,
    pub turn: f64,
}

/// Some of the balls. What fills up the last group touches nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct BallGroup {
    /// Cosine and sine of the angle from the first ball, and that angle in turns.
    pub spacing: [Lanes; 2],
    pub spacing_turns: Lanes,
    /// Minus infinity for what fills up the group, m.
    pub oversize: Lanes,
    /// Cosine and sine of the azimuth, and the azimuth in turns.
    pub direction: [Lanes; 2],
    pub turn: Lanes,
    /// Radial and axial place from the outer groove's centre at rest, m, and rates, m/s.
    pub place: [Lanes; 2],
    pub rate: [Lanes; 2],
    /// Rows of the outer groove's centre, radial and axial \[groups of modes\] a ball.
    pub rows: [Vec<[Lanes; LANES]>; 2],
    /// Displacement of the outer groove's centre under each ball, radial and axial, m.
    pub moved: [Lanes; 2],
    /// Contacts, their damping left out.
    pub outer: Felt,
    pub inner: Felt,
    /// Rates of both penetrations, m/s.
    pub approach: [Lanes; 2],
    /// Force on the outer race, radial and axial, N, friction included.
    pub on_outer: [Lanes; 2],
    /// Force of the inner ring on each ball along x, y, z, N.
    pub from_inner: [Lanes; 3],
    /// Normal forces with damping, inner and outer, N.
    pub loads: [Lanes; 2],
}

impl BearingBalls {
    /// The balls of a bearing whose ring is `seat`, on the lowest `kept` modes.
    pub(crate) fn new(own: &BearingInPlace, seat: &RingSeat, modes: &StructureModes, kept: usize) -> Self {
        let law = own.bearing.law();
        let count = own.bearing.balls();
        let column = |f: &dyn Fn(usize) -> f64, rest: f64| {
            let values: Vec<f64> = (0..count).map(f).collect();
            lanes::filled(&values, rest)
        };
        let turns = column(&|j| j as f64 / count as f64, 0.0);
        let oversizes = column(&|_| 0.0, f64::NEG_INFINITY);
        let arm = law.grooves.outer_centres - seat.ring.section().radius;
        let rows = [0, 2].map(|component| RacewayTable::along_groove(seat, modes, kept, arm, component));
        let damage = DamagedRace::both(&own.bearing, own.contact_damping);
        let at_race = own.bearing.geometry().outer_race_radius() - seat.ring.section().radius;
        let groups = rows[0].groups;
        let blank = || vec![[[0.0; LANES]; LANES]; groups];
        let balls = turns.into_iter().zip(oversizes).map(|(spacing_turns, oversize)| BallGroup {
            spacing: [spacing_turns.map(|turn| (TAU * turn).cos()), spacing_turns.map(|turn| (TAU * turn).sin())],
            spacing_turns,
            oversize,
            rows: [blank(), blank()],
            ..BallGroup::default()
        });
        Self {
            count,
            groups: balls.collect(),
            inner: GrooveLaw::new(&law.inner, own.contact_damping),
            outer: GrooveLaw::new(&law.outer, own.contact_damping),
            rows,
            base: law.grooves.outer_centres,
            race_radius: law.grooves.outer_centres + law.grooves.seats[1],
            gap: [law.grooves.radial_gap, law.grooves.axial_gap],
            mobility: 1.0 / law.mass,
            gyroscopic: 0.1 * law.mass * law.diameter * law.pitch_diameter,
            friction: law.race_control.shares().map(|share| share / law.diameter),
            tangential: damage[1].is_some().then(|| RacewayTable::along_groove(seat, modes, kept, at_race, 1)),
            damage,
            cursor: RotationCursor::default(),
            cage_speed: 0.0,
            turn: 0.0,
        }
    }

    /// Contact angles of the balls at a race that lies on this side of them, rad.
    pub(crate) fn angles(&self, of: impl Fn(&BallGroup) -> &Felt, side: f64) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |j| {
            let felt = of(&self.groups[j / LANES]);
            let touches = felt.load[j % LANES] > 0.0;
            let along = if touches { felt.gradient } else { felt.normal };
            let [r, z] = along.map(|component| side * component[j % LANES]);
            z.atan2(r)
        })
    }

    /// What each ball has of something.
    pub(crate) fn all(&self, of: impl Fn(&BallGroup) -> &Lanes) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |j| of(&self.groups[j / LANES])[j % LANES])
    }
}
