//! Pairs of modes, or of clusters of them, that belong together.
//!
//! Which row goes with which column so that the sum of what they are worth is largest.
//!
//! Modes whose frequencies are so close that only the space that they span means something, and angles between such spaces.

use super::super::error::{ModalError, check_value};
use super::points::{ModeSet, PointMatch, matched_points};
use crate::numerics::linalg::DenseMatrix;
use nalgebra::DMatrix;
use serde::Serialize;

/// What counts as the same point, as one frequency and as one mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComparisonOptions {
    /// Distance up to which points are one, over the diagonal of the box of the first set's points; > 0.
    pub point_tolerance: f64,
    /// Relative gap up to which neighbouring frequencies of a set form a cluster; 0 to 1.
    pub cluster_gap: f64,
    /// Smallest MAC of a pair; 0 to 1. Modes without a partner of this are unpaired.
    pub least_mac: f64,
}

impl Default for ComparisonOptions {
    /// A thousandth of the size, a thousandth of the frequency, MAC 0.5: orthogonal shapes of one set have at most
    /// one partner above one half.
    fn default() -> Self {
        Self { point_tolerance: 1e-3, cluster_gap: 1e-3, least_mac: 0.5 }
    }
}

/// Modes of two sets that belong together: one and one, or a cluster and its like.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModePair {
    /// Modes of the first set, by frequency.
    pub here: Vec<usize>,
    /// Modes of the second set, by frequency.
    pub there: Vec<usize>,
    /// (there - here) / here of the mean frequencies; `None` if the first set's is zero.
    pub frequency_difference: Option<f64>,
    /// Squared cosine of the largest principal angle between the two spaces, 0 to 1: the MAC for one mode each.
    pub mac: f64,
    /// Mean squared cosine of the principal angles, 0 to 1.
    pub mean_mac: f64,
}

/// Two sets of modes compared.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalComparison {
    /// Which points were compared.
    pub points: PointMatch,
    /// MAC of every mode of the first set with every one of the second [first x second], 0 to 1.
    pub mac: DenseMatrix,
    /// What belongs together, by frequency of the first set.
    pub pairs: Vec<ModePair>,
    /// Modes of the first set without a partner, by frequency.
    pub unpaired_here: Vec<usize>,
    /// Modes of the second set without a partner, by frequency.
    pub unpaired_there: Vec<usize>,
}

impl ModalComparison {
    /// Compares `second` with `first`, in the displacements at their common points (unweighted). The first set is known in
    /// space; of the second each point may have one direction alone, along which both are compared then.
    ///
    /// Of clusters with unlike numbers of modes the smaller is compared with its projection on the larger one.
    /// Sources: Allemang and Brown (1982) for MAC, Bjorck and Golub (1973) for the principal angles.
    ///
    /// # Errors
    /// [`ModalError::Shape`] for lists that do not fit, [`ModalError::Invalid`] for values that are no numbers and options,
    /// [`ModalError::TooFewPoints`] for fewer than three common points.
    pub fn new(first: &ModeSet, second: &ModeSet, options: ComparisonOptions) -> Result<Self, ModalError> {
        first.check()?;
        second.check()?;
        options.check()?;
        let tolerance = options.point_tolerance * first.diagonal();
        let points = matched_points(first, second, tolerance)?;
        let here = Side::new(first, &points, 0, second);
        let there = Side::new(second, &points, 1, second);
        let mac = DenseMatrix::from_fn(here.shapes.ncols(), there.shapes.ncols(), |a, b| {
            mac(here.shapes.col_as_slice(a), there.shapes.col_as_slice(b))
        });
        // what is one cluster on one side and several on the other is joined there
        let [own, other] = [&here, &there].map(|side| clusters(side.frequencies_hz, options.cluster_gap));
        let other = join_like(&there, other, &here, &own, options.least_mac);
        let own = join_like(&here, own, &there, &other, options.least_mac);
        let [own_bases, other_bases] = [(&here, &own), (&there, &other)].map(|(side, clusters)| {
            let of = |cluster: &Vec<usize>| basis(&side.shapes, cluster);
            clusters.iter().map(of).collect::<Vec<_>>()
        });
        let cosines: Vec<Vec<Vec<f64>>> =
            own_bases.iter().map(|a| other_bases.iter().map(|b| squared_cosines(a, b)).collect()).collect();
        let worth: Vec<Vec<f64>> =
            cosines.iter().map(|row| row.iter().map(|c| worth(c, options.least_mac)).collect()).collect();
        let partner = assignment(&worth);
        let mut pairs = Vec::new();
        let mut taken = vec![false; other.len()];
        let mut unpaired_here = Vec::new();
        for (cluster, (modes, partner)) in own.iter().zip(&partner).enumerate() {
            let Some(partner) = *partner else {
                unpaired_here.extend_from_slice(modes);
                continue;
            };
            taken[partner] = true;
            let squares = &cosines[cluster][partner];
            let [from, to] = [here.mean(modes), there.mean(&other[partner])];
            pairs.push(ModePair {
                here: modes.clone(),
                there: other[partner].clone(),
                frequency_difference: (from > 0.0).then(|| (to - from) / from),
                mac: squares.last().copied().unwrap_or(0.0),
                mean_mac: squares.iter().sum::<f64>() / squares.len().max(1) as f64,
            });
        }
        let alone = other.iter().zip(taken).filter(|(_, taken)| !taken);
        Ok(Self {
            points,
            mac,
            pairs,
            unpaired_here,
            unpaired_there: alone.flat_map(|(modes, _)| modes.iter().copied()).collect(),
        })
    }
}

impl ComparisonOptions {
    fn check(&self) -> Result<(), ModalError> {
        let options = [
            ("point_tolerance", self.point_tolerance),
            ("cluster_gap", self.cluster_gap),
            ("least_mac", self.least_mac),
        ];
        let check = |(name, found)| check_value(name, "0 to 1", found, (0.0..=1.0).contains(&found));
        options.into_iter().try_for_each(check)
    }
}

/// A set at the common points.
struct Side<'s> {
    frequencies_hz: &'s [f64],
    shapes: DenseMatrix,
}

impl<'s> Side<'s> {
    /// Its displacements at the common points; where the `second` set is known in one direction a point, along that.
    fn new(set: &'s ModeSet, points: &PointMatch, side: usize, second: &ModeSet) -> Self {
        let rows = 3 * points.pairs.len();
        let shapes = DenseMatrix::from_fn(rows, set.shapes.ncols(), |row, mode| {
            let pair = points.pairs[row / 3];
            let at = |axis: usize| set.shapes[(3 * pair[side] + axis, mode)];
            let Some(directions) = &second.directions else {
                return at(row % 3);
            };
            let direction = directions[pair[1]];
            direction[row % 3] * (0..3).map(|axis| direction[axis] * at(axis)).sum::<f64>()
        });
        Self { frequencies_hz: &set.frequencies_hz, shapes }
    }

    fn mean(&self, modes: &[usize]) -> f64 {
        let sum: f64 = modes.iter().map(|&mode| self.frequencies_hz[mode]).sum();
        sum / modes.len().max(1) as f64
    }
}

/// Joins clusters of `side` that lie in one cluster of the other: by at least `least` in every direction.
fn join_like(side: &Side, clusters: Vec<Vec<usize>>, to: &Side, among: &[Vec<usize>], least: f64) -> Vec<Vec<usize>> {
    let several: Vec<Option<DMatrix<f64>>> =
        among.iter().map(|cluster| (cluster.len() > 1).then(|| basis(&to.shapes, cluster))).collect();
    let home = |cluster: &Vec<usize>| {
        let own = basis(&side.shapes, cluster);
        let inside = several.iter().map(|larger| {
            let larger = larger.as_ref().filter(|larger| larger.ncols() > own.ncols())?;
            squared_cosines(&own, larger).last().copied()
        });
        let best = inside.enumerate().max_by(|a, b| {
            let [a, b] = [a, b].map(|x| x.1.unwrap_or(-1.0));
            a.total_cmp(&b)
        });
        best.filter(|best| best.1.is_some_and(|mac| mac >= least)).map(|best| best.0)
    };
    let homes: Vec<Option<usize>> = clusters.iter().map(home).collect();
    let sizes: Vec<usize> = among.iter().map(Vec::len).collect();
    joined(clusters, &homes, &sizes)
}

/// Sum of the squared cosines, which counts modes explained; nothing if one direction of the smaller space is not in
/// the other.
fn worth(squares: &[f64], least: f64) -> f64 {
    squares.last().filter(|smallest| **smallest >= least).map_or(0.0, |_| squares.iter().sum())
}

/// The column of each row, or none where no pair is worth anything; no column twice. `worth[row][column] >= 0`.
///
/// Hungarian method with potentials, O(n^3). Taking the best pair first, and so on, is the same as long as no shape is
/// like two others; with few points shapes are alike, and then the best pair may cost two others more than it is
/// worth. Source: Kuhn, The Hungarian method for the assignment problem, Naval Research Logistics Quarterly 2
/// (1955) 83-97.
pub(super) fn assignment(worth: &[Vec<f64>]) -> Vec<Option<usize>> {
    let rows = worth.len();
    let columns = worth.iter().map(Vec::len).max().unwrap_or(0);
    let size = rows.max(columns);
    let value =
        |row: usize, column: usize| -> f64 { worth.get(row).and_then(|row| row.get(column)).copied().unwrap_or(0.0) };
    // least cost over a square filled up with zeros; row 0 and column 0 stand for "none yet"
    let (mut row_price, mut column_price) = (vec![0.0; size + 1], vec![0.0; size + 1]);
    let mut row_of = vec![0_usize; size + 1];
    for row in 1..=size {
        row_of[0] = row;
        let mut column = 0;
        let mut reach = vec![f64::INFINITY; size + 1];
        let mut from = vec![0_usize; size + 1];
        let mut visited = vec![false; size + 1];
        // a path that changes partners alternately, until a column is free
        while row_of[column] != 0 {
            visited[column] = true;
            let current = row_of[column];
            let (mut step, mut next) = (f64::INFINITY, 0);
            for other in (1..=size).filter(|&other| !visited[other]) {
                let slack = -value(current - 1, other - 1) - row_price[current] - column_price[other];
                if slack < reach[other] {
                    (reach[other], from[other]) = (slack, column);
                }
                if reach[other] < step {
                    (step, next) = (reach[other], other);
                }
            }
            if next == 0 {
                break; // worths that are not finite: leave the row without a partner
            }
            for other in 0..=size {
                if visited[other] {
                    row_price[row_of[other]] += step;
                    column_price[other] -= step;
                } else {
                    reach[other] -= step;
                }
            }
            column = next;
        }
        while column != 0 {
            let before = from[column];
            row_of[column] = row_of[before];
            column = before;
        }
    }
    let mut found = vec![None; rows];
    for (column, &row) in row_of.iter().enumerate().skip(1) {
        if row > 0 && value(row - 1, column - 1) > 0.0 {
            found[row - 1] = Some(column - 1);
        }
    }
    found
}

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
    use super::assignment;

    #[test]
    fn the_best_pair_is_given_up_for_two_good_ones() {
        // best first takes 0.9 and is left with 0.0
        let worth = [vec![0.9, 0.8], vec![0.8, 0.0]];
        assert_eq!(assignment(&worth), [Some(1), Some(0)]);
    }

    #[test]
    fn what_is_worth_nothing_stays_alone() {
        let worth = [vec![0.0, 0.7, 0.0], vec![0.0, 0.6, 0.0]];
        assert_eq!(assignment(&worth), [Some(1), None]);
        assert!(assignment(&[]).is_empty());
        assert_eq!(assignment(&[vec![], vec![]]), [None, None]);
    }

    /// Against all orders of five rows.
    #[test]
    fn no_order_is_worth_more() {
        fn best(worth: &[Vec<f64>], used: &mut Vec<bool>) -> f64 {
            let Some((row, rest)) = worth.split_first() else {
                return 0.0;
            };
            let mut largest = 0.0_f64;
            for column in 0..row.len() {
                if !used[column] {
                    used[column] = true;
                    largest = largest.max(row[column] + best(rest, used));
                    used[column] = false;
                }
            }
            largest
        }
        let mut state = 7_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state) / f64::from(u32::MAX)
        };
        for _ in 0..200 {
            let worth: Vec<Vec<f64>> = (0..5).map(|_| (0..6).map(|_| random()).collect()).collect();
            let found = assignment(&worth);
            let sum: f64 = found.iter().zip(&worth).filter_map(|(column, row)| column.map(|column| row[column])).sum();
            assert!((sum - best(&worth, &mut vec![false; 6])).abs() < 1e-12);
        }
    }
}

#[cfg(test)]
mod subspace_tests {
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
