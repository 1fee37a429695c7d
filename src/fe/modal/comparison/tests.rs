//! Modes of a ring by hand: `cos k phi` and `sin k phi` at points on a circle, and sets made from them.

use super::super::ModalError;
use super::*;
use crate::numerics::linalg::DenseMatrix;
use std::f64::consts::TAU;

const POINTS: usize = 24;

/// Doublets k = 2, 3, ... of a ring, radial and tangential, turned by `turn` (rad), and a single mode across it last.
fn ring(doublets: usize, turn: f64, split: f64) -> ModeSet {
    let angle = |point: usize| TAU * point as f64 / POINTS as f64;
    let points = (0..POINTS).map(|p| [angle(p).cos(), angle(p).sin(), 0.0]).collect();
    let mut frequencies_hz = Vec::new();
    for k in 2..2 + doublets {
        let f = 100.0 * (k * k) as f64;
        frequencies_hz.extend([f, f * (1.0 + split)]);
    }
    frequencies_hz.push(5000.0);
    let shapes = DenseMatrix::from_fn(3 * POINTS, 2 * doublets + 1, |row, mode| {
        let (phi, k) = (angle(row / 3), (2 + mode / 2) as f64);
        if mode == 2 * doublets {
            return if row % 3 == 2 { 1.0 + 0.1 * phi } else { 0.0 };
        }
        let quarter = if mode % 2 == 0 { 0.0 } else { 0.25 * TAU };
        let w = (k * (phi - turn) - quarter).cos();
        let u = -(k * (phi - turn) - quarter).sin() / k;
        [w * phi.cos() - u * phi.sin(), w * phi.sin() + u * phi.cos(), 0.0][row % 3]
    });
    ModeSet { frequencies_hz, points, node_tags: None, shapes, directions: None }
}

/// The modes of a set in another order, each times a factor.
fn reordered(set: &ModeSet, order: &[(usize, f64)]) -> ModeSet {
    ModeSet {
        frequencies_hz: order.iter().map(|(mode, _)| set.frequencies_hz[*mode]).collect(),
        shapes: DenseMatrix::from_fn(set.shapes.nrows(), order.len(), |row, k| {
            order[k].1 * set.shapes[(row, order[k].0)]
        }),
        ..set.clone()
    }
}

fn compare(a: &ModeSet, b: &ModeSet) -> ModalComparison {
    ModalComparison::new(a, b, ComparisonOptions::default()).expect("sets that fit")
}

fn partners(found: &ModalComparison) -> Vec<(&[usize], &[usize])> {
    let pairs = found.pairs.iter();
    pairs.map(|pair| (pair.here.as_slice(), pair.there.as_slice())).collect()
}

/// The doublets of a ring turned by 30 degrees: single MAC values say nothing, the spaces are the same.
#[test]
fn turned_doublets_are_the_same() {
    let (a, b) = (ring(2, 0.0, 0.0), ring(2, TAU / 12.0, 0.0));
    let found = compare(&a, &b);
    // cos^2 of 2 x 30 degrees; 1e-12: sums over 24 points
    assert!((found.mac[(0, 0)] - 0.25).abs() < 1e-12);
    assert!(found.mac[(2, 2)] < 1e-12);
    let expected: Vec<(&[usize], &[usize])> = vec![(&[0, 1], &[0, 1]), (&[2, 3], &[2, 3]), (&[4], &[4])];
    assert_eq!(partners(&found), expected);
    for pair in &found.pairs {
        assert!((pair.mac - 1.0).abs() < 1e-12 && (pair.mean_mac - 1.0).abs() < 1e-12);
        assert_eq!(pair.frequency_difference, Some(0.0));
    }
}

/// A doublet that an imperfection splits by 1 % in one set, its modes at other angles.
#[test]
fn a_split_doublet_is_joined() {
    let (a, b) = (ring(2, 0.0, 0.0), ring(2, 0.2, 1e-2));
    for (a, b) in [(&a, &b), (&b, &a)] {
        let found = compare(a, b);
        assert_eq!(found.pairs.len(), 3, "{:?}", found.pairs);
        assert_eq!((found.pairs[0].here.len(), found.pairs[0].there.len()), (2, 2));
        assert!((found.pairs[0].mac - 1.0).abs() < 1e-12);
        let difference = found.pairs[0].frequency_difference.expect("elastic").abs();
        assert!((difference - 5e-3).abs() < 1e-4, "{difference}");
    }
}

#[test]
fn sign_scale_and_order_do_not_matter() {
    let a = ring(2, 0.0, 1e-2);
    let b = reordered(&a, &[(4, -3.0), (0, 1e-9), (3, -1.0), (1, 1e9), (2, 2.0)]);
    let found = compare(&a, &b);
    let expected: Vec<(&[usize], &[usize])> =
        vec![(&[0], &[1]), (&[1], &[3]), (&[2], &[4]), (&[3], &[2]), (&[4], &[0])];
    assert_eq!(partners(&found), expected);
    assert!(found.pairs.iter().all(|pair| (pair.mac - 1.0).abs() < 1e-12));
    assert!(found.unpaired_here.is_empty() && found.unpaired_there.is_empty());
}

#[test]
fn a_missing_mode_leaves_its_partner_alone() {
    let a = ring(2, 0.0, 1e-2);
    let b = reordered(&a, &[(0, 1.0), (2, 1.0), (3, 1.0), (4, 1.0)]);
    let found = compare(&a, &b);
    assert_eq!(found.pairs.len(), 4);
    assert_eq!((found.unpaired_here, found.unpaired_there), (vec![1], vec![]));
    let back = compare(&b, &a);
    assert_eq!((back.unpaired_here, back.unpaired_there), (vec![], vec![1]));
    // of a cluster one mode is found: it lies in the cluster, whose numbers tell
    let found = compare(&ring(2, 0.3, 0.0), &b);
    assert_eq!((found.pairs[0].here.len(), found.pairs[0].there.len()), (2, 1));
    assert!((found.pairs[0].mac - 1.0).abs() < 1e-12);
}

/// A shape that the other set has not, at the frequency of one that it has.
#[test]
fn a_wrong_mode_is_unpaired() {
    let a = ring(2, 0.0, 1e-2);
    let mut b = a.clone();
    for row in 0..3 * POINTS {
        b.shapes[(row, 2)] = if row % 3 == 2 { (2.5 * row as f64).sin() } else { 0.0 };
    }
    let found = compare(&a, &b);
    assert_eq!((found.unpaired_here, found.unpaired_there), (vec![2], vec![2]));
    // and with any limit above what it has
    let least_mac = 1.0;
    let none = ModalComparison::new(
        &a,
        &compare_noise(&a, 0.05),
        ComparisonOptions { least_mac, ..ComparisonOptions::default() },
    );
    assert!(none.expect("sets that fit").pairs.is_empty());
}

fn compare_noise(set: &ModeSet, amplitude: f64) -> ModeSet {
    let mut state = 3_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        amplitude * (2.0 * f64::from(state) / f64::from(u32::MAX) - 1.0)
    };
    let mut noisy = set.clone();
    for mode in 0..set.shapes.ncols() {
        for row in 0..set.shapes.nrows() {
            noisy.shapes[(row, mode)] += random();
        }
    }
    noisy
}

/// Noise of 5 % of the amplitude: `1 - MAC` is about its share of the square, 0.05^2 / 3 over 0.35.
#[test]
fn noise_lowers_the_mac_by_its_square() {
    let a = ring(2, 0.0, 1e-2);
    let found = compare(&a, &compare_noise(&a, 0.05));
    assert_eq!(found.pairs.len(), 5);
    for pair in &found.pairs {
        assert!(pair.mac > 0.99 && pair.mac < 0.9999, "{}", pair.mac);
    }
}

/// Five sensors, placed to a tenth of a millimetre, one of them where there is no node.
#[test]
fn a_few_sensors_find_their_modes() {
    let a = ring(2, 0.0, 1e-2);
    let places = [0, 5, 9, 14, 20];
    let mut points: Vec<[f64; 3]> = places.iter().map(|&p| a.points[p]).collect();
    points.iter_mut().for_each(|point| point[2] += 1e-4);
    points.push([9.0, 9.0, 9.0]);
    let b = ModeSet {
        points,
        shapes: DenseMatrix::from_fn(18, 5, |row, mode| {
            places.get(row / 3).map_or(7.0, |p| a.shapes[(3 * p + row % 3, mode)])
        }),
        ..a.clone()
    };
    let found = compare(&a, &b);
    assert_eq!((found.points.by, found.points.alone), (MatchedBy::Place, [POINTS - 5, 1]));
    assert!((found.points.largest_distance - 1e-4).abs() < 1e-12);
    let expected: Vec<(&[usize], &[usize])> =
        vec![(&[0], &[0]), (&[1], &[1]), (&[2], &[2]), (&[3], &[3]), (&[4], &[4])];
    assert_eq!(partners(&found), expected);
    assert!(found.pairs.iter().all(|pair| (pair.mac - 1.0).abs() < 1e-12));
    let two = ModeSet { points: b.points[..2].to_vec(), shapes: b.shapes.subrows(0, 6).to_owned(), ..b };
    let refused = ModalComparison::new(&a, &two, ComparisonOptions::default());
    assert!(matches!(refused, Err(ModalError::TooFewPoints { matched: 2, .. })));
}

/// Tags count as long as they mean the same places; a renumbered mesh is matched by place.
#[test]
fn tags_are_believed_if_places_agree() {
    let tagged = |set: ModeSet, tags: Vec<u64>| ModeSet { node_tags: Some(tags), ..set };
    let tags: Vec<u64> = (1..=POINTS as u64).collect();
    let a = tagged(ring(1, 0.0, 1e-2), tags.clone());
    // points in another order, with their tags
    let mut b = a.clone();
    b.points.reverse();
    b.node_tags = Some(tags.iter().rev().copied().collect());
    b.shapes = DenseMatrix::from_fn(3 * POINTS, 3, |row, mode| a.shapes[(3 * (POINTS - 1 - row / 3) + row % 3, mode)]);
    let found = compare(&a, &b);
    assert_eq!((found.points.by, found.points.alone), (MatchedBy::Tag, [0, 0]));
    assert!(found.pairs.iter().all(|pair| (pair.mac - 1.0).abs() < 1e-12));
    // the same points with the tags of others
    b.node_tags = Some(tags);
    let found = compare(&a, &b);
    assert_eq!((found.points.by, found.points.alone), (MatchedBy::Place, [0, 0]));
    assert!(found.pairs.iter().all(|pair| (pair.mac - 1.0).abs() < 1e-12));
}

/// Six modes without stiffness, mixed as the solver left them, are one pair.
#[test]
fn rigid_modes_are_compared_as_a_space() {
    let points: Vec<[f64; 3]> = (0..12).map(|p| [f64::from(p % 3), f64::from(p / 3 % 2), f64::from(p / 6)]).collect();
    let r = super::super::rigid_motions(&points, 3, [0.5; 3]);
    let mixed = DenseMatrix::from_fn(36, 6, |row, mode| {
        (0..6).map(|k| r[(row, k)] * ((3 * k + 7 * mode * mode) as f64).sin()).sum()
    });
    let set = |shapes: DenseMatrix, noise: f64| ModeSet {
        frequencies_hz: (0..6).map(|k| noise * f64::from(k)).chain([900.0]).collect(),
        points: points.clone(),
        node_tags: None,
        directions: None,
        shapes: DenseMatrix::from_fn(
            36,
            7,
            |row, mode| {
                if mode < 6 { shapes[(row, mode)] } else { (row as f64).cos() }
            },
        ),
    };
    let found = compare(&set(r, 0.0), &set(mixed, 1e-4));
    assert_eq!(found.pairs.len(), 2);
    assert_eq!((found.pairs[0].here.len(), found.pairs[0].there.len()), (6, 6));
    assert!((found.pairs[0].mac - 1.0).abs() < 1e-10, "{}", found.pairs[0].mac);
    assert_eq!(found.pairs[0].frequency_difference, None);
}

#[test]
fn sets_that_make_no_sense_are_refused() {
    let a = ring(1, 0.0, 1e-2);
    let mut missing = a.clone();
    missing.frequencies_hz.pop();
    let mut nan = a.clone();
    nan.shapes[(4, 1)] = f64::NAN;
    let mut negative = a.clone();
    negative.frequencies_hz[0] = -1.0;
    let refusal = |set: &ModeSet| ModalComparison::new(&a, set, ComparisonOptions::default()).expect_err("refused");
    assert!(matches!(refusal(&missing), ModalError::Shape { .. }));
    assert_eq!(refusal(&nan).to_string(), "displacement 4: expected a finite number, found NaN");
    assert_eq!(refusal(&negative).to_string(), "frequency: expected zero or more, found -1");
    let options = ComparisonOptions { least_mac: 2.0, ..ComparisonOptions::default() };
    let refused = ModalComparison::new(&a, &a, options).expect_err("refused");
    assert_eq!(refused.to_string(), "least_mac: expected 0 to 1, found 2");
}
