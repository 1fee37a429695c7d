//! A force over time: straight lines between points, constant beyond them.

use std::cmp::Ordering;

/// Force in the bearing's plane, N.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoadProfile {
    /// Time (s) and force (N); times ascending.
    points: Vec<(f64, [f64; 2])>,
}

impl LoadProfile {
    /// The same force always.
    pub(crate) fn constant(force: [f64; 2]) -> Self {
        Self { points: vec![(0.0, force)] }
    }

    /// Through points (s, N); those that do not come after the one before are left out. Without points there is no force.
    pub(crate) fn through(points: &[(f64, [f64; 2])]) -> Self {
        let mut points = points.to_vec();
        points.dedup_by(|next, before| next.0.partial_cmp(&before.0) != Some(Ordering::Greater));
        Self { points }
    }

    /// The first time (s) after `time` at which the slope jumps; infinity if there is none.
    pub(crate) fn next_knot(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|point| point.0 <= time);
        self.points.get(after).map_or(f64::INFINITY, |point| point.0)
    }

    /// Force at `time` (s), N.
    #[inline]
    pub(crate) fn at(&self, time: f64) -> [f64; 2] {
        let after = self.points.partition_point(|point| point.0 <= time);
        match (after.checked_sub(1), self.points.get(after)) {
            (Some(before), Some((end, last))) => {
                let (start, first) = self.points[before];
                let share = (time - start) / (end - start);
                [0, 1].map(|k| first[k] + share * (last[k] - first[k]))
            }
            (Some(before), None) => self.points[before].1,
            (None, Some(&(_, first))) => first,
            (None, None) => [0.0; 2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn straight_between_points_and_constant_beyond() {
        let load = LoadProfile::through(&[(1.0, [0.0, -2.0]), (3.0, [4.0, 0.0])]);
        for (time, force) in [(0.0, [0.0, -2.0]), (1.5, [1.0, -1.5]), (3.0, [4.0, 0.0]), (9.0, [4.0, 0.0])] {
            for (found, expected) in load.at(time).into_iter().zip(force) {
                assert_relative_eq!(found, expected, epsilon = 1e-15);
            }
        }
        assert_relative_eq!(LoadProfile::constant([1.0, 2.0]).at(-7.0)[1], 2.0);
        assert_relative_eq!(LoadProfile::default().at(0.0)[0], 0.0);
        for (time, knot) in [(0.0, 1.0), (1.0, 3.0), (2.9, 3.0)] {
            assert_relative_eq!(load.next_knot(time), knot);
        }
        assert!(load.next_knot(3.0).is_infinite());
    }
}
