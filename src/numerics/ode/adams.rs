//! Exponential Adams method: the linear part exact, the force a polynomial through what is known of it, one evaluation a step.
//!
//! ```text
//! y1 = flow(y0, v0) under g0 + a x                  x = (t - t0) / h,  a = r (g0 - g_),  r = h / h_
//! v1 = flow(y0, v0) under g0 + (a + b / r) x + b x^2,                  b = (g1 - g0 - a) r / (1 + r)
//! ```
//!
//! with g_ the force a step h_ before and g1 = g(t1, y1, v*); v* is the velocity under the line of the first row and enters
//! through contact damping alone. Without spring and damper equal steps are `y1 = y0 + h v0 + h^2 (4 g0 - g_) / 6`,
//! `v1 = v0 + h (5 g1 + 8 g0 - g_) / 12`: Beeman's positions with the velocities of the Adams-Moulton method (Hairer, Norsett,
//! Wanner, Solving ODEs I, 2nd ed., III.1, III.5 and III.10), of third order. For a force `-k y` it is stable up to
//! `h sqrt(k)` = [`STABILITY_LIMIT`], with a phase error of `(h^2 k)^2 / 43` in a relative one, a four-hundredth of velocity
//! Verlet's at `h sqrt(k) = 0.07`, and it damps what it does not resolve: 1 % a step at 0.7.
//!
//! With a tolerance
//!
//! - what each free coordinate meets of the force as a spring of its own is stepped exactly: it is taken anew in every step and goes
//!   from the force to the flow;
//! - the line gives way to the parabola through one force more, and the parabola to the cubic, of fourth order, wherever that was
//!   nearer to the force in the step before: it is not where a contact begins;
//! - the time between samples is halved as often as it takes to hold what the prediction leaves out of the force below the
//!   tolerance, in units of the largest force that the coordinate has seen. A step that is halved keeps to the grid, so that every
//!   sample is the end of a step and nothing is interpolated.
//!
//! The polynomials are not symmetric in time, so energy creeps through modes whose `h w` is large: such modes are left out.

mod flow;
mod track;

use super::{Divergence, Exchange, SecondOrderSystem, SnapshotError, Statistics, Stepper};
use flow::Flow;
use track::Track;

/// Largest `h sqrt(k)` at which no solution under a force `-k y` grows: where the characteristic polynomial of the two
/// recursions has the root -1.
pub const STABILITY_LIMIT: f64 = 1.732_050_807_568_877_2;

/// How often the time between samples is halved at most.
const MOST_HALVINGS: u32 = 10;

/// A step is taken back if its error exceeds the tolerance so many times, and the next one is halved above one.
const TOO_LARGE: f64 = 2.0;

/// The error falls with the square of the step under a line and with the cube under a parabola: a step of twice the length is
/// tried below these.
const DOUBLED: [f64; 2] = [0.15, 0.08];

#[derive(Debug)]
pub(super) struct Adams {
    /// Steps of the time between samples over powers of two.
    flows: Vec<Flow>,
    tolerance: Option<f64>,
    track: Track,
    halvings: u32,
    statistics: Statistics,
}

impl Adams {
    /// Equal steps h (s), or with a `tolerance` such steps halved where it asks for it.
    pub(super) fn new(system: &impl SecondOrderSystem, h: f64, tolerance: Option<f64>) -> Self {
        let halvings = tolerance.map_or(0, |_| MOST_HALVINGS);
        let coordinates = system.linear();
        let held = track::held(coordinates);
        let flow = |halved: u32| Flow::new(coordinates, held, h / f64::from(1_u32 << halved));
        Self {
            flows: (0..=halvings).map(flow).collect(),
            tolerance,
            track: Track::new(coordinates, tolerance.is_some()),
            // nothing is known yet
            halvings,
            statistics: Statistics { evaluations: 1, ..Statistics::default() },
        }
    }

    /// Takes the step that was tried, or not, and sets how long the next one is. `error` is in units of what is allowed, `part`
    /// the end of the step in units of the shortest.
    fn judge(&mut self, error: f64, part: u32) -> bool {
        let most = self.flows.len() as u32 - 1;
        // what is not a number is no reason to go on halving
        if error > TOO_LARGE && self.halvings < most {
            self.halvings += 1;
            return false;
        }
        if error > 1.0 && self.halvings < most {
            self.halvings += 1;
        } else if error < DOUBLED[usize::from(self.track.quadratic)] && self.halvings > 0 {
            let longer = 2_u32 << (most - self.halvings);
            if part.is_multiple_of(longer) {
                self.halvings -= 1;
            }
        }
        true
    }
}

impl<S: SecondOrderSystem> Stepper<S> for Adams {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) -> Result<(), Divergence> {
        track::begin(&mut self.track, [y, v, g]);
        if self.tolerance.is_some() && self.statistics.steps == 0 {
            // the force was evaluated there before
            self.track.find_springs(system);
        }
        let whole = 1_u32 << (self.flows.len() - 1);
        let shortest = self.flows[0].step / f64::from(whole);
        let mut part = 0;
        while part < whole {
            let flow = self.halvings as usize;
            let end = part + (whole >> flow);
            self.track.predict(&self.flows[flow]);
            let t = t1 - f64::from(whole - end) * shortest;
            let error = self.track.evaluate(system, t);
            self.statistics.evaluations += 1;
            if let Some(tolerance) = self.tolerance
                && !self.judge(error / tolerance, end)
            {
                self.statistics.rejected += 1;
                continue;
            }
            self.track.accept(self.flows[flow].step, system);
            self.statistics.steps += 1;
            part = end;
        }
        self.track.end(y, v, g);
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        self.statistics
    }

    fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        self.statistics.exchange(words)?;
        let mut halvings = u64::from(self.halvings);
        words.count(&mut halvings)?;
        // a snapshot of more halvings goes on with as many as there are
        self.halvings = halvings.min(self.flows.len() as u64 - 1) as u32;
        self.track.exchange(words)
    }
}
