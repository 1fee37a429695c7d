//! Balls without inertia: each stands where its contacts, its weight and the centrifugal load balance.
//!
//! With p the overlap with the outer race, f its force and `own` the residual flexibility there, a ball stands at
//!
//! ```text
//! s(p) = p + own f(p) + what the race has moved      m (rho w^2 + g . e) + F_i(s) n . e - f(p) = 0
//! ```
//!
//! in which the left-hand side falls with p wherever a contact holds the ball. A ball that its load presses outwards
//! stands on the outer race, one that is pressed inwards on the inner race; without any load it touches the outer one. In
//! passing from one to the other it jumps through the play, while both forces are zero.

use super::super::coupled::CoupledSystem;
use super::super::inner::InnerGap;
use super::super::race::RaceForce;
use super::with_residual::{MAX_SWEEPS, SWEEP_TOLERANCE};
use crate::bearing::RotationState;
use crate::numerics::lanes::LANES;

/// Force out of balance in units of the forces, at which a ball stands: far below any integration error.
const BALANCE: f64 = 1e-12;

/// Evaluations for one ball, far more than it takes: bisection alone reaches the last digit.
const MAX_EVALUATIONS: usize = 120;

/// Least distance that is tried for enclosing, m.
const LEAST_WIDTH: f64 = 1e-12;

/// What else than its own overlap decides where a ball stands.
struct Seat<'a> {
    shaft: &'a RotationState,
    /// Of the inner race, m.
    centre: [f64; 2],
    /// Position without overlap, m.
    place: f64,
    /// Displacement of the race under the ball for its own force, m/N.
    own: f64,
    /// Weight along the radius vector, N.
    weight: f64,
    /// m w^2, N/m.
    spin: f64,
}

/// Forces on a ball at one overlap.
struct Balance {
    /// Position s, m.
    position: f64,
    outer: RaceForce,
    /// Overlap with the undamaged inner race, m.
    inner_overlap: f64,
    /// Force outwards, N, and its derivative by the overlap, N/m.
    excess: f64,
    slope: f64,
    /// Forces that are balanced, N.
    size: f64,
}

impl Balance {
    fn stands(&self) -> bool {
        self.excess.abs() <= BALANCE * self.size
    }
}

impl CoupledSystem {
    /// Puts every ball where it stands, its outer force included; `centre` is that of the inner race, m.
    ///
    /// With residual flexibility the balls are taken in turns until their forces do not change.
    pub(super) fn settle_balls(&mut self, centre: [f64; 2], shaft: &RotationState, cage: &RotationState) {
        let (mass, gravity) = (self.setup.geometry.ball_mass(), self.setup.gravity);
        for group in &mut self.balls.groups {
            group.outer_radial = [0.0; LANES];
        }
        // displacements of the race, before they are overwritten by overlaps
        let sweeps = if self.residual.is_some() { MAX_SWEEPS } else { 1 };
        for j in 0..self.balls.count {
            self.work.under[j] = -self.balls.get(j, |ball| &ball.gap);
        }
        for _ in 0..sweeps {
            let (mut change, mut largest): (f64, f64) = (0.0, 0.0);
            for j in 0..self.balls.count {
                let (own, others) = self.residual_shares(j);
                let [x, y] = self.balls.direction_of(j);
                let seat = Seat {
                    shaft,
                    centre,
                    place: self.work.under[j] + others,
                    own,
                    weight: mass * (gravity[0] * x + gravity[1] * y),
                    spin: mass * cage.speed * cage.speed,
                };
                let before = self.balls.get(j, |ball| &ball.outer_radial);
                let (overlap, balance) = self.settle(j, &seat);
                self.balls.set(j, |ball| &mut ball.gap, overlap);
                self.balls.set(j, |ball| &mut ball.displacement, balance.position);
                self.keep_outer(j, &balance.outer);
                change = change.max((balance.outer.radial - before).abs());
                largest = largest.max(balance.outer.radial.abs());
            }
            if change <= SWEEP_TOLERANCE * largest {
                return;
            }
        }
        if self.residual.is_some() {
            // the balls did not settle
            for group in &mut self.balls.groups {
                group.outer_radial = [f64::NAN; LANES];
            }
        }
    }

    /// Overlap at which ball `j` stands: Newton's method between two overlaps that enclose it.
    fn settle(&mut self, j: usize, seat: &Seat) -> (f64, Balance) {
        let [mut low, mut high, mut overlap] = self.enclosed(j, seat);
        let mut balance = self.balance(j, seat, overlap);
        for _ in 0..MAX_EVALUATIONS {
            // the last digit of a position on the raceway
            if balance.stands() || high - low <= 1e-19 {
                break;
            }
            if balance.excess > 0.0 {
                low = overlap;
            } else {
                high = overlap;
            }
            let newton = overlap - balance.excess / balance.slope;
            overlap = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            balance = self.balance(j, seat, overlap);
        }
        (overlap, balance)
    }

    /// Overlaps with forces outwards and inwards, and a start between them that holds on undamaged races: the overlap under
    /// the load alone, or both contacts in series.
    fn enclosed(&mut self, j: usize, seat: &Seat) -> [f64; 3] {
        let (inner, outer) = (self.setup.stiffness.inner(), self.setup.stiffness.outer());
        let under = |force: f64, stiffness: f64| (force / stiffness).cbrt().powi(2);
        let touching = -self.outer.rise;
        let free = self.balance(j, seat, touching);
        if free.stands() {
            return [touching; 3];
        }
        if free.excess > 0.0 {
            let ratio = (inner / outer).cbrt().powi(2);
            let in_series = free.inner_overlap.max(0.0) * ratio / (1.0 + ratio);
            let alone = under(free.excess, outer);
            let mut width = 1.5 * alone;
            let start = in_series.min(alone).max(under(self.load(seat).max(0.0), outer));
            while self.balance(j, seat, touching + width).excess > 0.0 && width < 1.0 {
                width *= 2.0;
            }
            [touching, touching + width, touching + start]
        } else {
            let pressed = under(-self.load(seat), inner);
            let start = touching + free.inner_overlap - pressed;
            let mut width = (touching - start).max(0.0) + pressed.max(LEAST_WIDTH);
            while self.balance(j, seat, touching - width).excess < 0.0 && width < 1.0 {
                width *= 2.0;
            }
            [touching - width, touching, start]
        }
    }

    /// Weight and centrifugal load outwards at the outer race, N.
    fn load(&self, seat: &Seat) -> f64 {
        seat.weight + seat.spin * self.inner_race.touching_radius
    }

    fn balance(&mut self, j: usize, seat: &Seat, overlap: f64) -> Balance {
        let outer = self.outer_force(j, overlap);
        let position = seat.place + overlap + seat.own * outer.radial;
        self.balls.set(j, |ball| &mut ball.displacement, position);
        let e = self.balls.direction_of(j);
        let mut gap = self.inner_race.gap(e, position, seat.centre);
        gap.penetration += self.balls.get(j, |ball| &ball.oversize);
        let inner = self.inner_force_at(j, &gap, seat.shaft);
        let n = gap.normal;
        let (along, across) = (n[0] * e[0] + n[1] * e[1], n[0] * e[1] - n[1] * e[0]);
        // on the ball, outwards
        let pushed = -(inner.radial * along + inner.tangential * across);
        let rho = self.inner_race.touching_radius + position;
        let load = seat.weight + seat.spin * rho;
        let moved = 1.0 + seat.own * outer.tangent[0];
        Balance {
            position,
            inner_overlap: gap.penetration,
            excess: load + pushed - outer.radial,
            slope: (seat.spin - inner.tangent[0] * along * along) * moved - outer.tangent[0],
            size: load.abs() + pushed.abs() + outer.radial.abs(),
            outer,
        }
    }

    /// Force of ball `j` at rest on the inner race.
    pub(super) fn inner_force_at(&self, j: usize, gap: &InnerGap, shaft: &RotationState) -> RaceForce {
        if !self.inner.irregular {
            return self.inner.plain_force(gap.penetration, 0.0);
        }
        let (damage, place) = self.inner_place(j, gap, [0.0; 2], shaft);
        self.inner.force(damage, &place)
    }
}
