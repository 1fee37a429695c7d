//! Modes whose frequencies are so close that only the space that they span means something, and angles between such spaces.

use crate::numerics::linalg::DenseMatrix;
use nalgebra::DMatrix;

/// Singular values below this part of the largest count as zero: shapes that the points cannot tell apart.
const RANK: f64 = 1e-8;

/// `|a . b|^2 / (a . a)(b . b)`, 0 to 1; 0 if one of them does not move.
///
/// Source: Allemang and Brown (1982).
pub(super) fn mac(a: &[f64], b: &[f64]) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    // each by its own length, so that shapes of 1e200 or 1e-200 do not overflow
    let unit = |x: &[f64]| -> Option<Vec<f64>> {
        let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let scaled: Vec<f64> = x.iter().map(|v| v / largest).collect();
        let length = dot(&scaled, &scaled).sqrt();
        (largest > 0.0).then(|| scaled.iter().map(|v| v / length).collect())
    };
    match (unit(a), unit(b)) {
        (Some(a), Some(b)) => dot(&a, &b).powi(2).min(1.0),
        _ => 0.0,
    }
}

/// An orthonormal basis of the span of some columns [rows x rank].
pub(super) fn basis(shapes: &DenseMatrix, columns: &[usize]) -> DMatrix<f64> {
    let mut a = DMatrix::from_fn(shapes.nrows(), columns.len(), |row, k| shapes[(row, columns[k])]);
    for mut column in a.column_iter_mut() {
        let largest = column.amax();
        if largest > 0.0 {
            column /= largest;
        }
    }
    let svd = a.svd(true, false);
    let largest = svd.singular_values.iter().fold(0.0_f64, |m, s| m.max(*s));
    let keep = |k: &usize| svd.singular_values[*k] > RANK * largest;
    let kept: Vec<usize> = (0..svd.singular_values.len()).filter(keep).collect();
    svd.u.map_or_else(|| DMatrix::zeros(shapes.nrows(), 0), |u| u.select_columns(&kept))
}

/// Squared cosines of the principal angles between two spaces given by orthonormal bases, descending; as many as
/// the smaller one has dimensions. Empty if one has none.
///
/// They are the squared singular values of `Q_a^T Q_b`. Source: Bjorck and Golub (1973).
pub(super) fn squared_cosines(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Vec<f64> {
    if a.ncols() == 0 || b.ncols() == 0 {
        return Vec::new();
    }
    let values = (a.transpose() * b).singular_values();
    let mut squares: Vec<f64> = values.iter().map(|s| (s * s).min(1.0)).collect();
    squares.sort_by(|x, y| y.total_cmp(x));
    squares
}

/// Ratio of frequencies below which one counts as zero beside the next. A list from a measurement or another program has
/// neither energies nor bounds; round-off leaves 1e-7 and less of the first elastic frequency.
const ZERO: f64 = 1e-5;

/// Lists of modes, by ascending frequency, in which each follows the one before within the relative gap. Modes without
/// stiffness (zero, or round-off beside the next frequency) are one cluster, whatever their gaps.
pub(super) fn clusters(frequencies_hz: &[f64], gap: f64) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..frequencies_hz.len()).collect();
    order.sort_by(|&a, &b| frequencies_hz[a].total_cmp(&frequencies_hz[b]));
    let ascending = |place: usize| frequencies_hz[order[place]];
    let without = |&count: &usize| ascending(count - 1) < ZERO * ascending(count);
    let rigid = (1..order.len()).rfind(without).unwrap_or(0);
    let mut found: Vec<Vec<usize>> = Vec::new();
    for (place, &mode) in order.iter().enumerate() {
        let joins = place > 0 && {
            let [before, own] = [order[place - 1], mode].map(|mode| frequencies_hz[mode]);
            place < rigid || (place != rigid && own - before <= gap * own)
        };
        match found.last_mut().filter(|_| joins) {
            Some(cluster) => cluster.push(mode),
            None => found.push(vec![mode]),
        }
    }
    found
}

/// Joins those of `clusters` that lie in one and the same cluster of the other set: a doublet that imperfections have split
/// there and not here. `home` gives the cluster of the other set in which a cluster lies, and `sizes` the number
/// of modes of those.
pub(super) fn joined(clusters: Vec<Vec<usize>>, home: &[Option<usize>], sizes: &[usize]) -> Vec<Vec<usize>> {
    let mut found: Vec<(Option<usize>, Vec<usize>)> = Vec::new();
    for (cluster, &home) in clusters.into_iter().zip(home) {
        let room = home.and_then(|home| sizes.get(home)).copied().unwrap_or(0);
        let mate = found
            .iter_mut()
            .find(|(other, modes)| home.is_some() && *other == home && modes.len() + cluster.len() <= room);
        match mate {
            Some((_, modes)) => modes.extend(cluster),
            None => found.push((home, cluster)),
        }
    }
    found.into_iter().map(|(_, modes)| modes).collect()
}

#[cfg(test)]
mod tests {
    use super::{clusters, joined};

    #[test]
    fn close_modes_are_one_cluster() {
        let found = clusters(&[500.2, 100.0, 100.05, 100.1, 500.0, 300.0], 1e-3);
        assert_eq!(found, [vec![1, 2, 3], vec![5], vec![4, 0]]);
        assert_eq!(clusters(&[1.0, 2.0], 0.0), [[0], [1]]);
        assert!(clusters(&[], 1e-3).is_empty());
    }

    #[test]
    fn modes_without_stiffness_are_one_cluster() {
        let found = clusters(&[1e-4, 3e-5, 0.0, 812.0, 900.0], 1e-3);
        assert_eq!(found, [vec![2, 1, 0], vec![3], vec![4]]);
        assert_eq!(clusters(&[0.0, 0.0], 1e-3), [[0, 1]]);
    }

    #[test]
    fn parts_of_a_doublet_are_joined() {
        let clusters = vec![vec![0], vec![1], vec![2], vec![3]];
        let home = [Some(0), Some(0), Some(1), Some(0)];
        let found = joined(clusters, &home, &[2, 1]);
        assert_eq!(found, [vec![0, 1], vec![2], vec![3]]);
    }
}
