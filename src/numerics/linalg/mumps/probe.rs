//! Whether a factor on disk still is what was written.

use super::super::DenseMatrix;
use super::ffi::Real;
use std::sync::OnceLock;

/// How many times more a solution may miss its answer than the first one did, which missed it by round-off alone.
const WORSE: f64 = 100.0;

/// A right-hand side whose solution is known, solved for beside every other one.
pub(super) struct Probe<T> {
    answer: DenseMatrix,
    side: Vec<T>,
    /// By how much the first solution missed the answer.
    missed: OnceLock<f64>,
}

impl<T: Real> Probe<T> {
    /// `answer` [n x 1] and the matrix times it.
    pub(super) fn new(answer: DenseMatrix, side: Vec<f64>) -> Self {
        Self { answer, side: side.into_iter().map(T::of).collect(), missed: OnceLock::new() }
    }

    /// The right-hand side.
    pub(super) fn side(&self) -> impl Iterator<Item = T> {
        self.side.iter().copied()
    }

    /// Whether a solution misses the answer no more than the first one did, but for round-off.
    pub(super) fn holds(&self, solution: &[T]) -> bool {
        let answer = self.answer.col_as_slice(0);
        let missed: f64 = solution.iter().zip(answer).map(|(found, answer)| (found.value() - answer).powi(2)).sum();
        let first = *self.missed.get_or_init(|| missed.sqrt());
        // what is no number does not hold
        missed.sqrt() <= WORSE * first
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_misses_the_answer_by_more_than_round_off_does_not_hold() {
        let answer = DenseMatrix::from_fn(2, 1, |row, _| row as f64 + 1.0);
        let probe = Probe::<f32>::new(answer, vec![3.0, 4.0]);
        assert_eq!(probe.side().collect::<Vec<_>>(), [3.0, 4.0]);
        assert!(probe.holds(&[1.0, 2.000_001]));
        assert!(probe.holds(&[1.000_002, 2.0]));
        for damaged in [[1.0, 2.01], [f32::NAN, 2.0], [f32::INFINITY, 2.0], [0.0, 0.0]] {
            assert!(!probe.holds(&damaged), "{damaged:?}");
        }
    }
}
