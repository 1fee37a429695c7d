//! What no other point beats in both.

/// Places of the points (cost, error) that none other beats: no other costs at most as much and errs at most as much, one
/// of the two less. In order of cost; of equal points the first.
pub(crate) fn pareto_front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    let key = |place: usize| points[place];
    order.sort_by(|&a, &b| {
        let ((cost_a, error_a), (cost_b, error_b)) = (key(a), key(b));
        cost_a.total_cmp(&cost_b).then(error_a.total_cmp(&error_b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&place| {
        let beaten = key(place).1 >= least;
        least = least.min(key(place).1);
        !beaten
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_none_beats_is_on_the_front() {
        let points = [
            (4.0, 1e-4),
            (1.0, 1e-1),
            (2.0, 1e-2),
            // dearer and worse than the second
            (3.0, 2e-2),
            // as dear as the second and worse
            (2.0, 5e-2),
            // dearer and as good as the first
            (5.0, 1e-4),
            // as the first
            (4.0, 1e-4),
        ];
        assert_eq!(pareto_front(&points), [1, 2, 0]);
    }

    #[test]
    fn nothing_and_one() {
        assert!(pareto_front(&[]).is_empty());
        assert_eq!(pareto_front(&[(1.0, 1.0)]), [0]);
    }
}
