//! Small random changes of a start.

use crate::numerics::ode::State;

/// Changes every coordinate and velocity by a part of itself: `y (1 + size u)`, u evenly distributed in -1 to 1 and
/// independent, from a generator begun with `seed` and the number of the run.
pub(crate) fn perturb(state: &mut State, size: f64, seed: u64, run: usize) {
    let mut random = Random::new(seed, run as u64);
    for value in state.y.iter_mut().chain(&mut state.v) {
        *value *= 1.0 + size * random.between_minus_one_and_one();
    }
}

/// SplitMix64 (Steele, Lea and Flood 2014): every seed gives a good sequence, and runs need no order.
struct Random {
    state: u64,
}

impl Random {
    fn new(seed: u64, run: u64) -> Self {
        let mut seeded = Self { state: seed };
        let begin = seeded.next();
        let mut random = Self { state: begin ^ run.wrapping_mul(0x2545_f491_4f6c_dd1d) };
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between_minus_one_and_one(&mut self) -> f64 {
        // 53 bits: every double in [0, 1) that is a multiple of 2^-53
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        2.0 * unit - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn perturbed(size: f64, seed: u64, run: usize) -> State {
        let mut state = State { t: 1.0, y: vec![2.0; 500], v: vec![-3.0; 500] };
        perturb(&mut state, size, seed, run);
        state
    }

    #[test]
    fn changes_are_relative_even_and_their_own() {
        let state = perturbed(1e-3, 1, 0);
        let parts = |values: &[f64], of: f64| -> Vec<f64> { values.iter().map(|v| (v / of - 1.0) / 1e-3).collect() };
        let changes = [parts(&state.y, 2.0), parts(&state.v, -3.0)].concat();
        assert!(changes.iter().all(|u| u.abs() <= 1.0 + 1e-9));
        let mean = changes.iter().sum::<f64>() / 1000.0;
        let square = changes.iter().map(|u| u * u).sum::<f64>() / 1000.0;
        // of 1000 even numbers: 0 and 1/3, within four standard errors, 0.018 and 0.0094
        assert!(mean.abs() < 0.073, "{mean}");
        assert!((square - 1.0 / 3.0).abs() < 0.038, "{square}");
    }

    #[test]
    fn the_same_numbers_give_the_same_state_and_others_another() {
        assert_eq!(perturbed(1e-3, 1, 5), perturbed(1e-3, 1, 5));
        assert_ne!(perturbed(1e-3, 1, 5), perturbed(1e-3, 1, 6));
        assert_ne!(perturbed(1e-3, 1, 5), perturbed(1e-3, 2, 5));
    }
}
