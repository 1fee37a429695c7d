//! Thins a curve such that its spikes survive: the lowest and the highest value of each bucket stay.

/// Evenly spaced values thinned to two a bucket.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Thinned {
    /// Values; where thinned, the extremes of each bucket in the order in which they occur.
    pub(super) values: Vec<f64>,
    /// Original samples per value: 1, or half a bucket.
    pub(super) stride: f64,
}

/// Thins evenly spaced `values` to at most `most` (at least 2) by keeping the lowest and highest of each bucket, in
/// their order. Left alone if there are no more than that. A bucket without a finite value gives two gaps (NaN).
/// Abscissas are then good to a bucket: value k stands for samples near k stride.
pub(super) fn even(values: &[f64], most: usize) -> Thinned {
    let most = most.max(2);
    if values.len() <= most {
        return Thinned {
            values: values.to_vec(),
            stride: 1.0,
        };
    }
    let bucket = values.len().div_ceil(most / 2);
    let thinned = values
        .chunks(bucket)
        .flat_map(|chunk| match extremes(chunk) {
            Some((first, second)) => [chunk[first], chunk[second]],
            None => [f64::NAN, f64::NAN],
        })
        .collect();
    Thinned {
        values: thinned,
        stride: 0.5 * bucket as f64,
    }
}

/// Indices of the points that stay when `values` are thinned to at most `most`: of each bucket the lowest and the
/// highest. Points keep their own abscissas. All of them if there are no more than that.
pub(super) fn indices(values: &[f64], most: usize) -> Vec<usize> {
    let most = most.max(2);
    if values.len() <= most {
        return (0..values.len()).collect();
    }
    let bucket = values.len().div_ceil(most / 2);
    let mut kept = Vec::with_capacity(most);
    for (k, chunk) in values.chunks(bucket).enumerate() {
        if let Some((first, second)) = extremes(chunk) {
            kept.push(k * bucket + first);
            if second != first {
                kept.push(k * bucket + second);
            }
        }
    }
    kept
}

/// Places of the lowest and the highest finite value, the earlier one first.
fn extremes(chunk: &[f64]) -> Option<(usize, usize)> {
    let mut found: Option<(usize, usize)> = None;
    for (k, value) in chunk.iter().enumerate().filter(|(_, v)| v.is_finite()) {
        let (low, high) = found.get_or_insert((k, k));
        if *value < chunk[*low] {
            *low = k;
        }
        if *value > chunk[*high] {
            *high = k;
        }
    }
    found.map(|(low, high)| (low.min(high), low.max(high)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spikes_survive_in_their_order() {
        let mut values = vec![0.0; 1000];
        values[333] = 9.0;
        values[334] = -7.0;
        values[999] = 4.0;
        let thinned = even(&values, 40);
        assert_eq!(thinned.values.len(), 40);
        let at = thinned
            .values
            .iter()
            .position(|v| *v > 8.0)
            .expect("the spike");
        assert!(thinned.values[at + 1] < -6.0);
        assert!((at as f64 * thinned.stride - 333.0).abs() <= 2.0 * thinned.stride);
        assert!(thinned.values.iter().any(|v| (v - 4.0).abs() < 1e-15));
        let kept = indices(&values, 40);
        assert!(kept.len() <= 40);
        assert!([333, 334, 999].iter().all(|k| kept.contains(k)));
        assert!(kept.is_sorted());
    }

    #[test]
    fn short_curves_are_left_alone_and_gaps_stay_gaps() {
        let values = [1.0, f64::NAN, 3.0];
        assert!((even(&values, 3).stride - 1.0).abs() < 1e-15);
        assert_eq!(indices(&values, 3), [0, 1, 2]);
        let mut long = vec![1.0; 100];
        long[40..60].fill(f64::NAN);
        let thinned = even(&long, 20);
        assert_eq!(thinned.values.iter().filter(|v| v.is_nan()).count(), 4);
        assert!(indices(&long, 20).iter().all(|k| long[*k].is_finite()));
    }
}
