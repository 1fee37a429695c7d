//! The exact flow of one damped oscillator over a step.
//!
//! Methods of equal steps with one evaluation each, which remember nothing.

use super::{Divergence, Exchange, Method, SecondOrderSystem, SnapshotError, Statistics, Stepper};
use crate::numerics::ode::LinearCoordinate;

/// Exact flow of `y'' + c y' + w^2 y = g` over a step h: for a constant g
///
/// ```text
/// y1 = position_position y + position_velocity v + response g
/// v1 = velocity_position y + velocity_velocity v + position_velocity g
/// ```
///
/// The symmetric method takes the velocity from the same two-step recursion as the position,
/// `y2 = trace y1 - determinant y0 + (1 - trace + determinant) / w^2 g1`, which gives
/// `v1 = velocity_position y + velocity_velocity v + (position_velocity - kick_after) g0 + kick_after g1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Propagator {
    /// d y1 / d y0.
    pub position_position: f64,
    /// d y1 / d v0 = s(h), s; also d v1 / d g.
    pub position_velocity: f64,
    /// d v1 / d y0 = -w^2 s(h), 1/s.
    pub velocity_position: f64,
    /// d v1 / d v0 = s'(h).
    pub velocity_velocity: f64,
    /// d y1 / d g = integral of s, s^2; `(1 - position_position) / w^2`, so an equilibrium stays.
    pub response: f64,
    /// y1 from rest under a force that grows from 0 to 1 over the step, s^2; v1 is then `response / h`.
    pub ramp: f64,
    /// y1 from rest under a force that grows with the square of time from 0 to 1, s^2; v1 is then `2 ramp / h`.
    pub square: f64,
    /// Weight of the force at the end in v1, s: `position_velocity - velocity_velocity response / position_velocity`. That
    /// at the start is the rest of `position_velocity`, so that `g = w^2 y` stays; without spring and damper both are h / 2.
    pub kick_after: f64,
}

/// Smallest |s(h)| / h that divides: at a step of half a period of an undamped mode s vanishes and
/// the velocity is not defined by positions; there the weights are large but finite.
const LEAST_SINE: f64 = 1e-6;

/// Below this value of w h and c h the power series is used; above it in w h the closed forms lose
/// less than a digit to cancellation.
const SERIES_LIMIT: f64 = 0.5;

impl Propagator {
    pub(super) fn new(coordinate: LinearCoordinate, h: f64) -> Self {
        let (w2, c) = (coordinate.squared_frequency, coordinate.damping);
        let mut flow = Self::flow(w2, c, h);
        let s = flow.position_velocity;
        let divisor = if s.abs() < LEAST_SINE * (-0.5 * c * h).exp() * h {
            LEAST_SINE * (-0.5 * c * h).exp() * h.copysign(s)
        } else {
            s
        };
        flow.kick_after = s - flow.velocity_velocity * flow.response / divisor;
        flow
    }

    fn flow(w2: f64, c: f64, h: f64) -> Self {
        if w2.sqrt() * h < SERIES_LIMIT {
            let doublings = (c * h / SERIES_LIMIT).log2().ceil().max(0.0) as i32;
            let mut flow = Self::series(w2, c, h / f64::from(doublings).exp2());
            for doubling in 0..doublings {
                flow = flow.twice(w2, h / f64::from(doublings - doubling).exp2());
            }
            return flow;
        }
        let decay = (-0.5 * c * h).exp();
        let discriminant = w2 - 0.25 * c * c;
        let x = discriminant.abs().sqrt() * h;
        // cosine and sine over its argument, trigonometric below and hyperbolic above critical;
        // far above critical the decay goes into the exponents, where nothing overflows
        let (cosine, sine) = if discriminant >= 0.0 {
            (decay * x.cos(), decay * sinc(x))
        } else {
            let (slow, fast) = ((x - 0.5 * c * h).exp(), (-x - 0.5 * c * h).exp());
            let sine = if x < 1e-4 { decay * (1.0 + x * x / 6.0) } else { 0.5 * (slow - fast) / x };
            (0.5 * (slow + fast), sine)
        };
        let s = h * sine;
        let position_position = cosine + 0.5 * c * s;
        let response = (1.0 - position_position) / w2;
        let ramp = (1.0 - (s + c * response) / h) / w2;
        Self {
            position_position,
            position_velocity: s,
            velocity_position: -w2 * s,
            velocity_velocity: cosine - 0.5 * c * s,
            response,
            ramp,
            square: (1.0 - 2.0 * (response / h + c * ramp) / h) / w2,
            kick_after: 0.0,
        }
    }

    /// The flow over twice the step h.
    fn twice(self, w2: f64, h: f64) -> Self {
        let s = self.position_velocity;
        let response = self.response * (1.0 + self.position_position) + s * s;
        let position_velocity = s * (self.position_position + self.velocity_velocity);
        Self {
            position_position: 1.0 - w2 * response,
            position_velocity,
            velocity_position: -w2 * position_velocity,
            velocity_velocity: self.velocity_velocity * self.velocity_velocity - w2 * s * s,
            response,
            // half the ramp, then the other half on top of a constant half
            ramp: 0.5 * (self.position_position * self.ramp + s * self.response / h + self.response + self.ramp),
            // a quarter of the square, then a quarter of all three
            square: 0.25
                * (self.position_position * self.square
                    + 2.0 * s * self.ramp / h
                    + self.response
                    + 2.0 * self.ramp
                    + self.square),
            kick_after: 0.0,
        }
    }

    /// Power series of s with s(0) = 0, s'(0) = 1, s'' = -c s' - w^2 s.
    fn series(w2: f64, c: f64, h: f64) -> Self {
        // terms a_k h^k of s; a_(k+2) (k+1)(k+2) = -c (k+1) a_(k+1) - w^2 a_k
        let (mut before, mut term) = (0.0, h);
        let (mut s, mut slope, mut integral) = (h, 1.0, 0.5 * h * h);
        let (mut ramp, mut square) = (h * h / 6.0, h * h / 12.0);
        for k in 1..24 {
            let order = f64::from(k);
            let next = -(c * h * term + w2 * h * h * before / order) / (order + 1.0);
            (before, term) = (term, next);
            s += next;
            slope += (order + 1.0) * next / h;
            integral += next * h / (order + 2.0);
            ramp += next * h / ((order + 2.0) * (order + 3.0));
            square += 2.0 * next * h / ((order + 2.0) * (order + 3.0) * (order + 4.0));
        }
        Self {
            position_position: 1.0 - w2 * integral,
            position_velocity: s,
            velocity_position: -w2 * s,
            velocity_velocity: slope,
            response: integral,
            ramp,
            square,
            kick_after: 0.0,
        }
    }
}

fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}

/// Such a method with the count of its steps.
#[derive(Debug)]
pub(super) struct OneEvaluation {
    method: Method,
    h: f64,
    linear: Vec<LinearCoordinate>,
    /// Of the exponential method and of splitting.
    flow: Vec<Propagator>,
    /// Of the explicit Newmark method: 1 / (1 + h c / 2) for every coordinate.
    implicit_damping: Vec<f64>,
    /// Velocities that the force is evaluated with.
    predicted: Vec<f64>,
    /// The new force, or velocities in the middle of the step.
    between: Vec<f64>,
    steps: u64,
}

impl OneEvaluation {
    /// The exponential method, the explicit Newmark method or splitting by steps of `h` (s), before its first step.
    pub(super) fn new(system: &impl SecondOrderSystem, method: Method, h: f64) -> Self {
        let linear = system.linear().to_vec();
        let zeros = vec![0.0; linear.len()];
        Self {
            method,
            h,
            flow: linear.iter().map(|&coordinate| Propagator::new(coordinate, h)).collect(),
            implicit_damping: linear.iter().map(|coordinate| 1.0 / (1.0 + 0.5 * h * coordinate.damping)).collect(),
            linear,
            predicted: zeros.clone(),
            between: zeros,
            steps: 0,
        }
    }

    /// Exponential velocity Verlet: the linear part exact, the force held over the step.
    ///
    /// ```text
    /// y1 = E_yy y0 + E_yv v0 + P g0
    /// v1 = E_vy y0 + E_vv v0 + a g0 + b g1,      g1 = g(t1, y1, v*)
    /// ```
    ///
    /// The weights a and b make the positions follow Gautschi's two-step recursion, which without
    /// damping is `y2 - 2 cos(h w) y1 + y0 = (2 sin(h w / 2) / w)^2 g1`: symmetric in time, so that no
    /// energy creeps in or out through modes that the step does not resolve (Hairer, Lubich, Wanner,
    /// Geometric Numerical Integration, 2nd ed., XIII.1.2). Interpolating the force linearly for the
    /// velocity instead lags behind in such modes and drove the shaft: 31 % wrong after 10 ms of the
    /// smooth scene at h = 2.5e-8 s in all modes. Holding the force keeps `g = w^2 y` exactly, which
    /// impulse splitting does not. v* is the velocity under the held force; it enters through contact
    /// damping alone. With w = 0 this is the velocity Verlet method.
    fn exponential<S: SecondOrderSystem>(&mut self, system: &mut S, t1: f64, [y, v, g]: [&mut [f64]; 3]) {
        for i in 0..self.flow.len() {
            let p = &self.flow[i];
            let (y0, v0, g0) = (y[i], v[i], g[i]);
            y[i] = p.position_position * y0 + p.position_velocity * v0 + p.response * g0;
            self.predicted[i] = p.velocity_position * y0 + p.velocity_velocity * v0 + p.position_velocity * g0;
        }
        system.force_into(t1, y, &self.predicted, &mut self.between);
        for i in 0..self.flow.len() {
            let p = &self.flow[i];
            // the prediction holds g0 over the whole step with the weight a + b
            v[i] = self.predicted[i] + p.kick_after * (self.between[i] - g[i]);
            g[i] = self.between[i];
        }
    }

    /// Explicit Newmark (beta = 0, gamma = 1/2): central differences, the source paper's method.
    ///
    /// ```text
    /// y1 = y0 + h v0 + h^2/2 a0
    /// (1 + h/2 c) v1 = v0 + h/2 a0 + h/2 (g1 - w^2 y1)
    /// ```
    ///
    /// The damping acts on the new velocity (`M + h/2 C` factored once, here diagonal), so the limit
    /// is `h < 2 / w` whatever the damping; with lagged damping stiffness-proportional damping would
    /// lower it. In modal coordinates the method is the same as in nodal ones, step by step: it
    /// commutes with a change of basis.
    fn newmark_explicit<S: SecondOrderSystem>(&mut self, system: &mut S, t1: f64, [y, v, g]: [&mut [f64]; 3]) {
        let h = self.h;
        for i in 0..self.linear.len() {
            let LinearCoordinate { squared_frequency, damping } = self.linear[i];
            let a = g[i] - damping * v[i] - squared_frequency * y[i];
            self.between[i] = v[i] + 0.5 * h * a;
            self.predicted[i] = v[i] + h * a;
            y[i] += h * self.between[i];
        }
        system.force_into(t1, y, &self.predicted, g);
        for i in 0..self.linear.len() {
            let pull = g[i] - self.linear[i].squared_frequency * y[i];
            v[i] = self.implicit_damping[i] * (self.between[i] + 0.5 * h * pull);
        }
    }

    /// Impulse splitting: half a kick by the force, the exact flow of the linear part, half a kick.
    ///
    /// ```text
    /// v0' = v0 + h/2 g(t0, y0, v0)      (y1, v1') = exp(h L) (y0, v0')      v1 = v1' + h/2 g(t1, y1, v1')
    /// ```
    ///
    /// Second order, symmetric without damping, and the method that fails here (Verlet-I, r-RESPA: Hairer, Lubich, Wanner,
    /// Geometric Numerical Integration, 2nd ed., XIII.1.3): between the kicks a coordinate with `g = w^2 y` moves, so that its
    /// equilibrium is not kept. What it keeps is `g = (2 w / h) tan(h w / 2) y`: between a large contact force and a large spring
    /// force the place of balance is wrong by `(h w)^2 / 12`, and at `h w = pi` no force moves it.
    fn splitting<S: SecondOrderSystem>(&self, system: &mut S, t1: f64, [y, v, g]: [&mut [f64]; 3]) {
        let half = 0.5 * self.h;
        for (i, p) in self.flow.iter().enumerate() {
            let (y0, v0) = (y[i], v[i] + half * g[i]);
            y[i] = p.position_position * y0 + p.position_velocity * v0;
            v[i] = p.velocity_position * y0 + p.velocity_velocity * v0;
        }
        system.force_into(t1, y, v, g);
        for (v, g) in v.iter_mut().zip(g.iter()) {
            *v += half * g;
        }
    }
}

impl<S: SecondOrderSystem> Stepper<S> for OneEvaluation {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) -> Result<(), Divergence> {
        match self.method {
            Method::NewmarkExplicit => self.newmark_explicit(system, t1, [y, v, g]),
            Method::Splitting => self.splitting(system, t1, [y, v, g]),
            _ => self.exponential(system, t1, [y, v, g]),
        }
        self.steps += 1;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        // one evaluation before the first step
        Statistics { steps: self.steps, evaluations: self.steps + 1, ..Statistics::default() }
    }

    fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        words.count(&mut self.steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The flow over h must be the flow over h/2 twice, across series, trigonometric, critical and
    /// overdamped branches.
    #[test]
    fn a_step_is_two_half_steps() {
        let h = 1e-6;
        for w in [0.0, 1e3, 3e5, 6e5, 2e6, 3e7] {
            for c in [0.0, 2e3, 1.2e6, 4e6, 1e8, 5e9] {
                let coordinate = LinearCoordinate { squared_frequency: w * w, damping: c };
                let (whole, half) = (Propagator::new(coordinate, h), Propagator::new(coordinate, 0.5 * h));
                let step = |p: &Propagator, y: f64, v: f64| {
                    (
                        p.position_position * y + p.position_velocity * v + p.response * 7e9,
                        p.velocity_position * y + p.velocity_velocity * v + p.position_velocity * 7e9,
                    )
                };
                let (y, v) = (2e-4, -310.0);
                let once = step(&whole, y, v);
                let (y_half, v_half) = step(&half, y, v);
                let twice = step(&half, y_half, v_half);
                // round-off on the scale of the terms that are added
                assert!((once.0 - twice.0).abs() < 1e-14, "{w} {c}: {once:?} {twice:?}");
                assert!((once.1 - twice.1).abs() < 1e-8 * (1.0 + v.abs() + y * w), "{w} {c}");
            }
        }
    }

    /// A ramp is the mean of steps that begin one after the other: the response by quadrature over those over shorter steps.
    #[test]
    fn a_ramp_is_a_sum_of_steps() {
        let h = 1e-6;
        for (w, c) in [(0.0, 0.0), (1e3, 2e3), (3e5, 1e4), (6e5, 1.2e6), (2e6, 4e6), (3e7, 1e8), (1e3, 5e6)] {
            let at = |h: f64| {
                let coordinate = LinearCoordinate { squared_frequency: w * w, damping: c };
                Propagator::new(coordinate, h)
            };
            // Simpson's rule: 400 intervals leave (h w / 400)^4 / 180 of the largest
            let count = 400;
            let mean = |of: &dyn Fn(f64) -> f64| {
                let sum: f64 = (0..=count)
                    .map(|i| {
                        let weight = match i {
                            i if i == 0 || i == count => 1.0,
                            i if i % 2 == 1 => 4.0,
                            _ => 2.0,
                        };
                        weight * of(f64::from(i) / f64::from(count))
                    })
                    .sum();
                sum / f64::from(3 * count)
            };
            let response = |x: f64| if x > 0.0 { at(h * x).response } else { 0.0 };
            let expected = mean(&response);
            let found = at(h).ramp;
            assert!((found / expected - 1.0).abs() < 1e-6, "{w} {c}: {found} {expected}");
            // a square is the sum of ramps of twice the slope: x^2 = 2 int (x - z) dz
            let expected = mean(&|x| 2.0 * (1.0 - x) * response(x));
            let found = at(h).square;
            assert!((found / expected - 1.0).abs() < 1e-6, "{w} {c}: {found} {expected}");
        }
    }

    #[test]
    fn the_velocity_belongs_to_the_two_step_recursion() {
        // y2 = trace y1 - det y0 + (1 - trace + det) / w^2 g1, whatever g does
        for (w, c, h) in [(3e5, 2e4, 1e-6), (2e6, 0.0, 1e-6), (1e3, 5.0, 1e-6)] {
            let p = Propagator::new(LinearCoordinate { squared_frequency: w * w, damping: c }, h);
            let (y0, v0, g0, g1): (f64, f64, f64, f64) = (1e-6, 0.3, 2e6, -7e6);
            let y1 = p.position_position * y0 + p.position_velocity * v0 + p.response * g0;
            let kicks = (p.position_velocity - p.kick_after) * g0 + p.kick_after * g1;
            let v1 = p.velocity_position * y0 + p.velocity_velocity * v0 + kicks;
            let y2 = p.position_position * y1 + p.position_velocity * v1 + p.response * g1;
            let trace = p.position_position + p.velocity_velocity;
            let determinant = (-c * h).exp();
            let weight = (1.0 - trace + determinant) / (w * w);
            let recursion = trace * y1 - determinant * y0 + weight * g1;
            // round-off; the recursion's weight loses 1e-10 to cancellation at w h = 1e-3
            assert!((y2 - recursion).abs() < 1e-9 * y2.abs(), "{w} {y2} {recursion}");
        }
    }

    #[test]
    fn an_equilibrium_stays_to_the_last_bits() {
        for (w, c) in [(1e3, 10.0), (3e7, 1e8), (2e5, 1e4)] {
            let coordinate = LinearCoordinate { squared_frequency: w * w, damping: c };
            let p = Propagator::new(coordinate, 2e-7);
            let (g, y): (f64, f64) = (9.81, 9.81 / (w * w));
            assert!((p.position_position * y + p.response * g - y).abs() <= 4.0 * f64::EPSILON * y);
        }
    }
}
