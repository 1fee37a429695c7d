//! Integrals of functions at equal intervals as they come: Gregory's formula.

use crate::numerics::ode::{Snapshot, SnapshotError, SnapshotReader};

/// Loads, rotation, modal damping, contact damping, blending.
pub(super) const FLOWS: usize = 5;

/// Values at either end that the corrections take.
const ENDS: usize = 4;

/// Of a value at an end and its differences inwards: what the sum of all values has too much (Hildebrand, Introduction to
/// Numerical Analysis, 2nd ed., 5.9).
const GREGORY: [f64; ENDS] = [1.0 / 2.0, -1.0 / 12.0, 1.0 / 24.0, -19.0 / 720.0];

/// Sums of [`FLOWS`] functions.
#[derive(Debug, Clone, Default)]
pub(super) struct Integral {
    sums: [f64; FLOWS],
    /// Sum of all magnitudes.
    pub magnitude: f64,
    first: Vec<[f64; FLOWS]>,
    /// Newest last.
    last: Vec<[f64; FLOWS]>,
}

impl Integral {
    /// Takes the next values.
    pub(crate) fn add(&mut self, values: &[f64; FLOWS]) {
        for (sum, value) in self.sums.iter_mut().zip(values) {
            *sum += value;
            self.magnitude += value.abs();
        }
        if self.first.len() < ENDS {
            self.first.push(*values);
        }
        if self.last.len() == ENDS {
            self.last.remove(0);
        }
        self.last.push(*values);
    }

    /// Integrals with so much between two values.
    pub(crate) fn of(&self, step: f64) -> [f64; FLOWS] {
        std::array::from_fn(|flow| {
            let first: Vec<f64> = self.first.iter().map(|values| values[flow]).collect();
            let last: Vec<f64> = self.last.iter().rev().map(|values| values[flow]).collect();
            step * (self.sums[flow] - beyond(first) - beyond(last))
        })
    }

    pub(crate) fn remember(&self, snapshot: &mut Snapshot) {
        snapshot.numbers(&self.sums);
        snapshot.number(self.magnitude);
        snapshot.numbers(self.first.as_flattened());
        snapshot.numbers(self.last.as_flattened());
    }

    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    pub(crate) fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError> {
        snapshot.numbers_into("sums of powers", &mut self.sums)?;
        self.magnitude = snapshot.number()?;
        self.first = snapshot.numbers()?.as_chunks().0.to_vec();
        self.last = snapshot.numbers()?.as_chunks().0.to_vec();
        Ok(())
    }
}

/// What a sum has too much at an end, from the values there inwards.
fn beyond(mut values: Vec<f64>) -> f64 {
    let mut sum = 0.0;
    for weight in GREGORY.into_iter().take(values.len()) {
        sum += weight * values[0];
        for place in 1..values.len() {
            values[place - 1] = values[place] - values[place - 1];
        }
        values.pop();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_integrated_exactly_however_few_values() {
        for intervals in [3_u32, 4, 9] {
            let mut integral = Integral::default();
            for place in 0..=intervals {
                let x = f64::from(place) / f64::from(intervals);
                integral.add(&[1.0, x, x * x, x * x * x, 0.0]);
            }
            let found = integral.of(1.0 / f64::from(intervals));
            for (power, found) in (1_u32..5).zip(found) {
                // round-off of ten terms
                assert!((found - 1.0 / f64::from(power)).abs() < 1e-14, "{power}");
            }
        }
    }
}
