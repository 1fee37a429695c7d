//! Thins a curve such that its spikes survive: the lowest and the highest value of each bucket stay.

/// Evenly spaced values thinned to two a bucket.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Thinned {
    /// Values; where thinned, the extremes of each bucket in the order in which they occur.
    pub(super) values: Vec<f64>,
    /// Original samples per value: 1, or half a bucket.
    pub(super) stride: f64,
}

/// Thins evenly spaced `values` to at most `most` (at least 2) as a [`Thinner`] does.
pub(super) fn even(values: &[f64], most: usize) -> Thinned {
    let mut thinner = Thinner::new(values.len(), most);
    thinner.push(values);
    thinner.finish()
}

/// Thins evenly spaced values that come in pieces by keeping the lowest and highest of each bucket, in their order: a signal
/// of any length takes the memory of what is kept. Left alone if there are no more values than may stay. A bucket without a
/// finite value gives two gaps (NaN). Abscissas are then good to a bucket: value k stands for samples near k stride.
#[derive(Debug, Clone)]
pub(crate) struct Thinner {
    /// Values in a bucket; 0: all stay.
    bucket: usize,
    /// Of the bucket under way.
    under_way: Vec<f64>,
    kept: Vec<f64>,
}

impl Thinner {
    /// For so many values, of which at most `most` (at least 2) stay.
    pub(crate) fn new(length: usize, most: usize) -> Self {
        let most = most.max(2);
        let bucket = if length <= most { 0 } else { length.div_ceil(most / 2) };
        Self { bucket, under_way: Vec::with_capacity(bucket), kept: Vec::with_capacity(length.min(most)) }
    }

    /// Takes the next values.
    pub(crate) fn push(&mut self, values: &[f64]) {
        if self.bucket == 0 {
            self.kept.extend_from_slice(values);
            return;
        }
        let mut rest = values;
        while !rest.is_empty() {
            let room = self.bucket - self.under_way.len();
            let (next, later) = rest.split_at(room.min(rest.len()));
            self.under_way.extend_from_slice(next);
            rest = later;
            if self.under_way.len() == self.bucket {
                self.close();
            }
        }
    }

    fn close(&mut self) {
        let bucket = &self.under_way;
        self.kept.extend(match extremes(bucket) {
            Some((first, second)) => [bucket[first], bucket[second]],
            None => [f64::NAN, f64::NAN],
        });
        self.under_way.clear();
    }

    /// What stays.
    pub(super) fn finish(mut self) -> Thinned {
        if !self.under_way.is_empty() {
            self.close();
        }
        Thinned { values: self.kept, stride: if self.bucket == 0 { 1.0 } else { 0.5 * self.bucket as f64 } }
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
        let at = thinned.values.iter().position(|v| *v > 8.0).expect("the spike");
        assert!(thinned.values[at + 1] < -6.0);
        assert!((at as f64 * thinned.stride - 333.0).abs() <= 2.0 * thinned.stride);
        assert!(thinned.values.iter().any(|v| (v - 4.0).abs() < 1e-15));
        let kept = indices(&values, 40);
        assert!(kept.len() <= 40);
        assert!([333, 334, 999].iter().all(|k| kept.contains(k)));
        assert!(kept.is_sorted());
    }

    #[test]
    fn pieces_make_no_difference() {
        let values: Vec<f64> = (0..1003).map(|k| f64::from(k * k % 97)).collect();
        for most in [2, 40, 333, 2000] {
            let whole = even(&values, most);
            for piece in [1, 7, 50, 1003] {
                let mut thinner = Thinner::new(values.len(), most);
                values.chunks(piece).for_each(|piece| thinner.push(piece));
                assert_eq!(thinner.finish(), whole, "{most} {piece}");
            }
        }
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
