//! The exact flow of coordinates side by side over one step.

use super::super::propagator::Propagator;
use crate::numerics::lanes::{LANES, Lanes, each, fused};
use crate::numerics::ode::LinearCoordinate;

/// Exact flow of a group of coordinates over a step, under a constant force and one that grows to it: what [`Propagator`] says
/// of one.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct GroupFlow {
    pub position_position: Lanes,
    pub position_velocity: Lanes,
    pub velocity_position: Lanes,
    pub velocity_velocity: Lanes,
    pub response: Lanes,
    pub ramp: Lanes,
    pub square: Lanes,
    /// The last three over the step, s: velocity under a force that grows, half of it under one that grows with the square, a third
    /// under one with the cube.
    pub over: [Lanes; 3],
}

/// The flow of all coordinates over a step.
#[derive(Debug)]
pub(super) struct Flow {
    /// s.
    pub step: f64,
    /// Groups of coordinates that are held, then of free ones.
    pub groups: Vec<GroupFlow>,
}

/// Largest phase squared by which a spring turns in a step; what is beyond stays in the force.
const LARGEST_PHASE: f64 = 4.0;

/// Terms of the series in the phase squared x: the first one left out is below 1e-9 at the largest, and 1e-13 of it at half the
/// phase.
const TERMS: usize = 7;

/// `(-1)^k / (2 k + 3)!` and `2 (-1)^k / (2 k + 4)!`, highest k first.
const SERIES: [[f64; 2]; TERMS] = series();

const fn series() -> [[f64; 2]; TERMS] {
    let mut out = [[0.0; 2]; TERMS];
    let (mut factorial, mut sign, mut k) = (1.0, 1.0, 0);
    while k < TERMS {
        factorial *= if k == 0 { 2.0 } else { (2 * k + 2) as f64 };
        factorial *= (2 * k + 3) as f64;
        let odd = sign / factorial;
        out[TERMS - 1 - k] = [odd, 2.0 * odd / (2 * k + 4) as f64];
        sign = -sign;
        k += 1;
    }
    out
}

impl Flow {
    /// Of `held` coordinates and the free ones behind them over `step` (s).
    pub(super) fn new(coordinates: &[LinearCoordinate], held: usize, step: f64) -> Self {
        let (held, free) = coordinates.split_at(held);
        let groups = held.chunks(LANES).chain(free.chunks(LANES));
        Self { step, groups: groups.map(|group| GroupFlow::new(group, step)).collect() }
    }
}

impl GroupFlow {
    fn new(coordinates: &[LinearCoordinate], step: f64) -> Self {
        let mut flow = Self::default();
        for (l, &coordinate) in coordinates.iter().enumerate() {
            let one = Propagator::new(coordinate, step);
            flow.position_position[l] = one.position_position;
            flow.position_velocity[l] = one.position_velocity;
            flow.velocity_position[l] = one.velocity_position;
            flow.velocity_velocity[l] = one.velocity_velocity;
            flow.response[l] = one.response;
            flow.ramp[l] = one.ramp;
            flow.square[l] = one.square;
            for (over, of) in flow.over.iter_mut().zip([one.response, one.ramp, one.square]) {
                over[l] = of / step;
            }
        }
        flow
    }

    /// Of free coordinates under springs k (1/s^2) that are in the force: what they do where the step begins is in it already.
    /// Gives back the springs that were stepped.
    #[inline(always)]
    pub(super) fn on_springs(step: f64, springs: &Lanes) -> (Self, Lanes) {
        let most = LARGEST_PHASE / (step * step);
        let springs = each(|l| if springs[l] < most { springs[l] } else { most });
        let x = each(|l| springs[l] * step * step);
        let mut sums = SERIES[0].map(|last| [last; LANES]);
        for terms in &SERIES[1..] {
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum = each(|l| fused(sum[l], x[l], *term));
            }
        }
        // responses to the line and to the square over those without a spring, and to 1 from the latter
        let [sine, bend] = sums;
        let cosine = each(|l| fused(-0.5 * x[l], bend[l], 0.5));
        let over = [cosine, sine, bend].map(|sum| each(|l| step * sum[l]));
        let [response, ramp, square] = over.map(|over| each(|l| step * over[l]));
        let flow = Self {
            position_position: [1.0; LANES],
            position_velocity: each(|l| step * (1.0 - x[l] * sine[l])),
            velocity_position: [0.0; LANES],
            velocity_velocity: each(|l| 1.0 - x[l] * cosine[l]),
            response,
            ramp,
            square,
            over,
        };
        (flow, springs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spring_in_the_force_is_stepped_like_one_beside_it() {
        let step = 1e-6;
        for phase in [0.0, 1e-3, 0.3, 1.0, 1.9] {
            let k = (phase / step) * (phase / step);
            let (flow, kept) = GroupFlow::on_springs(step, &[k, 0.0, k, 0.0]);
            assert!((kept[0] - k).abs() <= f64::EPSILON * k);
            let beside = Propagator::new(LinearCoordinate { squared_frequency: k, damping: 0.0 }, step);
            let (y, v, g): (f64, f64, f64) = (2e-6, 1.5, 3e6);
            let inside = g - k * y;
            let place = y + flow.position_velocity[2] * v + flow.response[2] * inside;
            let rate = flow.velocity_velocity[2] * v + flow.position_velocity[2] * inside;
            let expected = beside.position_position * y + beside.position_velocity * v + beside.response * g;
            let expected_rate =
                beside.velocity_position * y + beside.velocity_velocity * v + beside.position_velocity * g;
            // the first term that the series leaves out, phase^14 / 16!, and round-off; of terms of at most 5e-6 and, for the
            // velocity, 4 and phase^2 of 1.5
            let left_out = 2.0 * phase.powi(14) / 2.0e13 + 1e-13;
            assert!((place - expected).abs() < 5e-6 * left_out, "{phase}");
            assert!((rate - expected_rate).abs() < 8.0 * left_out, "{phase}");
            let near = |found: f64, expected: f64| {
                assert!((found / expected - 1.0).abs() < left_out + 1e-12, "{phase}");
            };
            near(flow.ramp[0], beside.ramp);
            near(flow.square[0], beside.square);
        }
    }

    #[test]
    fn what_turns_too_far_in_a_step_stays_in_the_force() {
        let (flow, kept) = GroupFlow::on_springs(2.0, &[100.0, 0.5, 1.0, 0.0]);
        assert!((kept[0] - 1.0).abs() < 1e-15 && (kept[1] - 0.5).abs() < 1e-15);
        // 4^8 / 16!, the first term that the series leaves out
        assert!((flow.velocity_velocity[0] - 2.0_f64.cos()).abs() < 4e-9);
    }
}
