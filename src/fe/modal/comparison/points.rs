//! Modes at points, and which points of two sets are one.

use super::super::error::{ModalError, check_count, check_finite, check_value};
use crate::numerics::linalg::DenseMatrix;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::HashMap;

/// Fewest common points: three that are not in line tell six rigid motions apart.
const LEAST_POINTS: usize = 3;

/// Modes with their shapes at some points.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeSet {
    /// Frequency of each mode, Hz, >= 0, in any order.
    pub frequencies_hz: Vec<f64>,
    /// Where the shapes are known (x, y, z), m; both sets in one frame.
    pub points: Vec<[f64; 3]>,
    /// Mesh tag of each point, if they are nodes of a mesh.
    pub node_tags: Option<Vec<u64>>,
    /// Displacements (x, y, z) of each point [3 points x modes], any scale; zero for a component that a plane model
    /// has not.
    pub shapes: DenseMatrix,
    /// The one direction of each point in which its shapes are known, of length 1; displacements are along it. A point is
    /// there once for each of its directions. `None`: shapes are known in space.
    pub directions: Option<Vec<[f64; 3]>>,
}

/// How points were found to be the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MatchedBy {
    /// By the mesh's tags; all common ones agree in place.
    Tag,
    /// By place: each is the nearest to the other.
    Place,
}

/// Points that two sets have in common.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PointMatch {
    /// How they were found.
    pub by: MatchedBy,
    /// Index in the first set and in the second.
    pub pairs: Vec<[usize; 2]>,
    /// Points of the first and of the second set that are in no pair.
    pub alone: [usize; 2],
    /// Largest distance of a pair, m.
    pub largest_distance: f64,
}

impl ModeSet {
    /// Lists of the right length, finite numbers, frequencies that are not negative.
    pub(super) fn check(&self) -> Result<(), ModalError> {
        let count = self.frequencies_hz.len();
        check_count("columns of the mode shapes", count, self.shapes.ncols())?;
        check_count("rows of the mode shapes", 3 * self.points.len(), self.shapes.nrows())?;
        if let Some(tags) = &self.node_tags {
            check_count("node tags", self.points.len(), tags.len())?;
        }
        if let Some(directions) = &self.directions {
            check_count("directions", self.points.len(), directions.len())?;
            check_finite("direction", directions.as_flattened())?;
        }
        check_finite("coordinate", self.points.as_flattened())?;
        check_finite("frequency", &self.frequencies_hz)?;
        let mut frequencies = self.frequencies_hz.iter();
        frequencies.try_for_each(|&hz| check_value("frequency", "zero or more", hz, hz >= 0.0))?;
        (0..count).try_for_each(|mode| check_finite("displacement", self.shapes.col(mode).iter()))
    }

    /// Diagonal of the box round the points, m.
    pub(crate) fn diagonal(&self) -> f64 {
        let side = |axis: usize| {
            let along = self.points.iter().map(|point| point[axis]);
            let (low, high) =
                along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            if low <= high { high - low } else { 0.0 }
        };
        side(0).hypot(side(1)).hypot(side(2))
    }
}

/// The points that two sets have in common, up to `tolerance` (m) apart: by tag if both have tags and all tags that
/// both know lie within the tolerance, otherwise by place.
///
/// # Errors
/// [`ModalError::TooFewPoints`].
pub(super) fn matched_points(first: &ModeSet, second: &ModeSet, tolerance: f64) -> Result<PointMatch, ModalError> {
    let by_tag = tagged_pairs(first, second).filter(|pairs| {
        pairs.len() >= LEAST_POINTS && pairs.iter().all(|&pair| distance(first, second, pair) <= tolerance)
    });
    let (by, pairs) = match by_tag {
        Some(pairs) => (MatchedBy::Tag, pairs),
        None => (MatchedBy::Place, nearest_pairs(first, second, tolerance)),
    };
    let [own, other] = [first.points.len(), second.points.len()];
    let alone_here = own - pairs.len();
    if pairs.len() < LEAST_POINTS {
        return Err(ModalError::TooFewPoints {
            matched: pairs.len(),
            least: LEAST_POINTS,
            first: own,
            second: other,
            tolerance,
        });
    }
    let pairs = if second.directions.is_some() { at_all_directions(second, &pairs) } else { pairs };
    let distances = pairs.iter().map(|&pair| distance(first, second, pair));
    Ok(PointMatch {
        by,
        alone: [alone_here, other - pairs.len()],
        largest_distance: distances.fold(0.0, f64::max),
        pairs,
    })
}

/// The pairs with each direction of the second set's points: those rows have the very same place.
fn at_all_directions(second: &ModeSet, pairs: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let place = |row: usize| second.points[row].map(f64::to_bits);
    let mut rows: HashMap<[u64; 3], Vec<usize>> = HashMap::new();
    for row in 0..second.points.len() {
        rows.entry(place(row)).or_default().push(row);
    }
    let of = |&[own, other]: &[usize; 2]| rows[&place(other)].iter().map(move |&row| [own, row]).collect::<Vec<_>>();
    pairs.iter().flat_map(of).collect()
}

fn distance(first: &ModeSet, second: &ModeSet, [a, b]: [usize; 2]) -> f64 {
    apart(&first.points[a], &second.points[b])
}

fn apart(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

fn tagged_pairs(first: &ModeSet, second: &ModeSet) -> Option<Vec<[usize; 2]>> {
    let (own, other) = (first.node_tags.as_ref()?, second.node_tags.as_ref()?);
    // of a tag that occurs twice the first place counts, on both sides
    let places = |tags: &[u64]| -> HashMap<u64, usize> {
        tags.iter().enumerate().rev().map(|(place, &tag)| (tag, place)).collect()
    };
    let (own_places, other_places) = (places(own), places(other));
    let pairs = own.iter().enumerate().filter_map(|(place, tag)| {
        let once = own_places.get(tag) == Some(&place);
        other_places.get(tag).filter(|_| once).map(|&there| [place, there])
    });
    Some(pairs.collect())
}

/// Pairs of which each is the nearest to the other, in the order of the first set.
fn nearest_pairs(first: &ModeSet, second: &ModeSet, tolerance: f64) -> Vec<[usize; 2]> {
    let forth = nearest(&first.points, &second.points, tolerance);
    let back = nearest(&second.points, &first.points, tolerance);
    let pairs = forth.iter().enumerate().filter_map(|(own, other)| {
        let other = (*other)?;
        (back[other] == Some(own)).then_some([own, other])
    });
    pairs.collect()
}

/// For each point the nearest of `among` within the tolerance, by a grid of cells of that size.
fn nearest(points: &[[f64; 3]], among: &[[f64; 3]], tolerance: f64) -> Vec<Option<usize>> {
    let size = tolerance.max(f64::MIN_POSITIVE);
    // beyond 2^53 cells from the origin neighbours are not told apart: casts saturate, none is lost
    let cell = |point: &[f64; 3]| point.map(|x| (x / size).floor() as i64);
    let mut grid: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for (index, point) in among.iter().enumerate() {
        grid.entry(cell(point)).or_default().push(index);
    }
    let of = |point: &[f64; 3]| {
        let [i, j, k] = cell(point);
        let mut best: Option<(f64, usize)> = None;
        for place in 0..27_i64 {
            let [x, y, z] = [place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1];
            let neighbour = [i.saturating_add(x), j.saturating_add(y), k.saturating_add(z)];
            for &index in grid.get(&neighbour).into_iter().flatten() {
                let apart = apart(point, &among[index]);
                let nearer = best.is_none_or(|(least, first)| apart < least || (apart <= least && index < first));
                if apart <= tolerance && nearer {
                    best = Some((apart, index));
                }
            }
        }
        best.map(|(_, index)| index)
    };
    points.iter().map(of).collect()
}
