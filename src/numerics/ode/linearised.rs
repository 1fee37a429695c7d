//! A system's small motions about a state: its linear part, and the force by its tangent there.
//!
//! ```text
//! y_i'' + damping_i y_i' + squared_frequency_i y_i = sum_k left_ki (position_k . y + velocity_k . y')
//! ```
//!
//! A method steps this as it steps the system itself, so that what it does to small motions needs no formula of its own.

use super::tangent::dot;
use crate::numerics::ode::{LinearCoordinate, SecondOrderSystem, State, Tangent};
use std::ops::Range;

/// A system linearised at a state; its coordinates are the distances from there.
#[derive(Debug, Clone)]
pub struct Linearised {
    linear: Vec<LinearCoordinate>,
    /// What the force is by the tangent.
    pub(super) tangent: Tangent,
    /// Where the rows of each term are not zero: left, position, velocity.
    filled: Vec<[Range<usize>; 3]>,
    /// What each coordinate weighs beside a mode of unit mass, as far as the terms tell: a force that acts on both along what it
    /// depends on has `position_i / left_i` in proportion to the masses. 1 where none does.
    pub(super) masses: Vec<f64>,
    /// What each coordinate meets of the force as a spring of its own.
    springs: Vec<f64>,
}

impl Linearised {
    /// The small motions of `system` about `state`; of what its tangent leaves out nothing is known.
    pub fn new<S: SecondOrderSystem>(system: &mut S, state: &State) -> Self {
        let mut tangent = Tangent::new(state.y.len());
        system.tangent_into(state.t, &state.y, &state.v, &mut tangent);
        let filled = (0..tangent.terms).map(|term| {
            let rows = [tangent.left(term), tangent.position(term), tangent.velocity(term)];
            rows.map(filled)
        });
        let linear = system.linear().to_vec();
        let [mut springs, mut sizes] = [0, 1].map(|_| vec![0.0; linear.len()]);
        system.own_springs_into(&mut springs, &mut sizes);
        Self { springs, filled: filled.collect(), masses: masses(&linear, &tangent), linear, tangent }
    }
}

impl SecondOrderSystem for Linearised {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, _t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        g.fill(0.0);
        for (term, [left, position, velocity]) in self.filled.iter().enumerate() {
            let at =
                |row: &[f64], values: &[f64], filled: &Range<usize>| dot(&row[filled.clone()], &values[filled.clone()]);
            let factor = at(self.tangent.position(term), y, position) + at(self.tangent.velocity(term), v, velocity);
            let pairs = g[left.clone()].iter_mut();
            for (g, left) in pairs.zip(&self.tangent.left(term)[left.clone()]) {
                *g += factor * left;
            }
        }
    }

    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        tangent.clone_from(&self.tangent);
    }

    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        springs.copy_from_slice(&self.springs);
        sizes.fill(0.0);
    }
}

fn masses(linear: &[LinearCoordinate], tangent: &Tangent) -> Vec<f64> {
    let mut masses = vec![1.0; linear.len()];
    for term in 0..tangent.terms {
        let (left, position) = (tangent.left(term), tangent.position(term));
        let modes = (0..linear.len()).filter(|&i| linear[i].squared_frequency > 0.0);
        // the mode that the force moves most
        let most = modes.max_by(|&a, &b| left[a].abs().total_cmp(&left[b].abs()));
        let Some(stiffness) = most.map(|mode| position[mode] / left[mode]) else {
            continue;
        };
        for (i, mass) in masses.iter_mut().enumerate() {
            let found = position[i] / left[i] / stiffness;
            if linear[i].squared_frequency <= 0.0 && found > 0.0 && found.is_finite() {
                *mass = found;
            }
        }
    }
    masses
}

/// From the first value that is not zero to the last.
fn filled(row: &[f64]) -> Range<usize> {
    let is_filled = |value: &f64| *value != 0.0;
    let first = row.iter().position(is_filled).unwrap_or(0);
    let end = row.iter().rposition(is_filled).map_or(0, |last| last + 1);
    first..end
}
