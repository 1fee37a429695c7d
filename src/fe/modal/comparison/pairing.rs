//! Pairs of modes, or of clusters of them, that belong together.

use super::super::error::{ModalError, check_value};
use super::assignment::assignment;
use super::points::{ModeSet, PointMatch, matched_points};
use super::subspace::{basis, clusters, joined, mac, squared_cosines};
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
    /// Compares `second` with `first`, in the displacements at their common points (unweighted).
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
        let here = Side::new(first, &points, 0);
        let there = Side::new(second, &points, 1);
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
    fn new(set: &'s ModeSet, points: &PointMatch, side: usize) -> Self {
        let rows = 3 * points.pairs.len();
        let shapes = DenseMatrix::from_fn(rows, set.shapes.ncols(), |row, mode| {
            set.shapes[(3 * points.pairs[row / 3][side] + row % 3, mode)]
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
