//! Files for MBDyn, read by a reader of the tests that follows the manual.

use std::fs;
use std::path::Path;

use super::super::SuperelementRecord;
use super::*;
use crate::formats::superelement::samples::{dense, record};
use crate::formats::{DofBody, DofDirection, DofLabel, FieldRecovery, FormatError};
use crate::numerics::linalg::DenseMatrix;

/// Words of a record, without comments and without the headings of shapes.
fn words(text: &str, record: usize) -> Option<Vec<String>> {
    let begin = text.find(&format!("** RECORD GROUP {record},"))?;
    let lines = text[begin..].lines().skip(1);
    let lines = lines.take_while(|line| !line.starts_with("** RECORD") && !line.starts_with("** END"));
    let lines = lines.filter(|line| !line.starts_with("**"));
    let words = lines.flat_map(|line| line.split_ascii_whitespace().map(str::to_owned));
    Some(words.collect())
}

fn numbers(text: &str, record: usize) -> Vec<f64> {
    let words = words(text, record).unwrap();
    words.iter().map(|word| word.parse().unwrap()).collect()
}

/// Displacements and rotations along and about x, y, z of nodes.
fn labels(points: &[(u64, [f64; 3])]) -> Vec<DofLabel> {
    let unit = |axis: usize| [0, 1, 2].map(|own| if own == axis { 1.0 } else { 0.0 });
    let of = |&(node, position): &(u64, [f64; 3])| {
        let label =
            move |direction, axis| DofLabel { body: DofBody::Housing, node, direction, position, axis: unit(axis) };
        let along = (0..3).map(move |axis| label(DofDirection::Along(axis), axis));
        along.chain((0..3).map(move |axis| label(DofDirection::About(axis), axis)))
    };
    points.iter().flat_map(of).collect()
}

/// Two rigid bodies of 2 and 3 kg whose centres are at the two nodes, a spring of six stiffnesses between the motions of
/// the second body and those that the first one gives it there, and an oscillator as a mode.
fn free_body() -> SuperelementRecord {
    let (a, b) = ([0.25, -0.5, 1.0], [0.75, 0.5, 0.5]);
    let arm: [f64; 3] = [0, 1, 2].map(|i| b[i] - a[i]);
    let relative = DenseMatrix::from_fn(6, 13, |row, column| {
        let turned = match (row, column) {
            // w x arm
            (0, 4) => arm[2],
            (0, 5) => -arm[1],
            (1, 3) => -arm[2],
            (1, 5) => arm[0],
            (2, 3) => arm[1],
            (2, 4) => -arm[0],
            _ => 0.0,
        };
        let own = f64::from(column == row + 6);
        own - f64::from(column == row) - turned
    });
    let springs = [1e6, 2e6, 3e6, 4e5, 5e5, 6e5];
    let scaled = DenseMatrix::from_fn(6, 13, |i, j| springs[i] * relative[(i, j)]);
    let mut stiffness = relative.transpose() * scaled;
    stiffness[(12, 12)] = 1e8;
    let masses = [2.0, 2.0, 2.0, 0.02, 0.03, 0.04, 3.0, 3.0, 3.0, 0.05, 0.06, 0.07, 1.0];
    let mass = DenseMatrix::from_fn(13, 13, |i, j| if i == j { masses[i] } else { 0.0 });
    let damping = DenseMatrix::from_fn(13, 13, |i, j| 1e-5 * stiffness[(i, j)]);
    let mut record = SuperelementRecord::of_matrices(stiffness, mass, labels(&[(11, a), (12, b)])).unwrap();
    record.damping = Some(damping);
    record
}

fn written(record: &SuperelementRecord) -> (MbdynSummary, String) {
    written_from(record, MbdynReference::Floating)
}

fn written_from(record: &SuperelementRecord, reference: MbdynReference) -> (MbdynSummary, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("housing.fem");
    let summary = write_mbdyn_fem(&path, record, reference).unwrap();
    (summary, fs::read_to_string(&path).unwrap())
}

fn refused(record: &SuperelementRecord) -> String {
    refused_from(record, MbdynReference::Floating)
}

fn refused_from(record: &SuperelementRecord, reference: MbdynReference) -> String {
    let error = write_mbdyn_fem(Path::new("no/such.fem"), record, reference).unwrap_err();
    error.to_string()
}

#[test]
fn a_free_body_has_its_inertia_and_no_rigid_modes() {
    let record = free_body();
    let (summary, text) = written(&record);
    assert_eq!(summary.frequency_hz.len(), 7);
    assert_eq!(words(&text, 1).unwrap(), ["REV0", "2", "7", "0", "0", "0"]);
    assert_eq!(words(&text, 2).unwrap(), ["11", "12"]);
    let coordinates: Vec<f64> = (5..8).flat_map(|group| numbers(&text, group)).collect();
    assert_eq!(coordinates, [0.25, 0.75, -0.5, 0.5, 1.0, 0.5]);
    // two bodies: c = (2 a + 3 b) / 5; moments of both about it
    let found = numbers(&text, 12);
    let mut expected = vec![5.0, 0.55, 0.1, 0.7];
    let (arms, mass) = ([[-0.3, -0.6, 0.3], [0.2, 0.4, -0.2]], [2.0, 3.0]);
    let own = [0.07, 0.09, 0.11];
    for i in 0..3 {
        for j in 0..3 {
            let mut moment = if i == j { own[i] } else { 0.0 };
            for (arm, mass) in arms.iter().zip(mass) {
                let square: f64 = arm.iter().map(|part| part * part).sum();
                moment += mass * (if i == j { square } else { 0.0 } - arm[i] * arm[j]);
            }
            expected.push(moment);
        }
    }
    assert_eq!(found.len(), 13);
    for (found, expected) in found.iter().zip(&expected) {
        // sums of a dozen products of numbers up to 10
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
    assert!((summary.mass.unwrap() - 5.0).abs() < 1e-14);
    assert!(text.ends_with("** END OF FILE\n"));
}

#[test]
#[allow(clippy::float_cmp)] // written as 1 and 0
fn modes_diagonalise_mass_and_stiffness_and_shapes_belong_to_them() {
    let record = free_body();
    let (summary, text) = written(&record);
    let modes = 7;
    let square = |group: usize| {
        let values = numbers(&text, group);
        assert_eq!(values.len(), modes * modes);
        move |i: usize, j: usize| values[modes * i + j]
    };
    let (mass, stiffness, damping) = (square(9), square(10), square(13));
    // shapes [mode][node][motion]; the nodes' motions are the interface coordinates, and without the mode of the
    // oscillator they are all that moves
    let shapes = numbers(&text, 8);
    assert_eq!(shapes.len(), modes * 12);
    let headings: Vec<&str> = text.lines().filter(|line| line.contains("MODE SHAPE #")).collect();
    assert_eq!(headings[6], "** NORMAL MODE SHAPE # 7");
    let product = |matrix: &DenseMatrix, i: usize, j: usize| -> f64 {
        let (left, right) = (&shapes[12 * i..], &shapes[12 * j..]);
        let entry = |row: usize, column: usize| left[row] * matrix[(row, column)] * right[column];
        (0..12).flat_map(|row| (0..12).map(move |column| entry(row, column))).sum()
    };
    let mut oscillators = 0;
    for i in 0..modes {
        let frequency = summary.frequency_hz[i];
        let eigenvalue = (std::f64::consts::TAU * frequency).powi(2);
        assert!((stiffness(i, i) / eigenvalue - 1.0).abs() < 1e-14);
        for j in 0..modes {
            assert_eq!(mass(i, j), f64::from(i == j));
            assert!(i == j || stiffness(i, j) == 0.0);
            // proportional to the stiffness; rounding of the largest eigenvalue, 1e8
            let expected = if i == j { 1e-5 * eigenvalue } else { 0.0 };
            assert!((damping(i, j) - expected).abs() < 1e-8, "{i} {j} {}", damping(i, j));
        }
        if shapes[12 * i..][..12].iter().all(|part| part.abs() < 1e-9) {
            oscillators += 1;
            continue;
        }
        for j in 0..i {
            // the solver's accuracy: eps times the largest eigenvalue against its shift
            assert!(product(&record.mass, i, j).abs() < 1e-10);
        }
        let modal_mass = product(&record.mass, i, i);
        // sums of 144 products, each rounded
        assert!((modal_mass - 1.0).abs() < 1e-13, "{i} {modal_mass}");
        let modal_stiffness = product(&record.stiffness, i, i);
        assert!((modal_stiffness / eigenvalue - 1.0).abs() < 1e-12);
    }
    assert_eq!(oscillators, 1);
}

/// With the first body held the second one's frequencies are those of its springs to the first.
/// Stiffness of a free body on one node is round-off, without equal signs left and right of a motion.
#[test]
fn a_free_body_on_one_node_is_written() {
    let round_off =
        |row: usize, column: usize| if row.max(column) < 6 { 1e-6 * ((row * column) as f64).sin() } else { 0.0 };
    let with = |stiffness: f64| {
        let stiffness = DenseMatrix::from_fn(7, 7, |row, column| match (row, column) {
            (6, 6) => 1e8,
            (1, 1) => stiffness,
            _ => round_off(row, column),
        });
        let masses = [2.0, 2.0, 2.0, 0.02, 0.03, 0.04, 1.0];
        let mass = DenseMatrix::from_fn(7, 7, |i, j| if i == j { masses[i] } else { 0.0 });
        SuperelementRecord::of_matrices(stiffness, mass, labels(&[(11, [0.0; 3])])).unwrap()
    };
    let (summary, _) = written(&with(1e-6));
    assert!((summary.mass.unwrap() - 2.0).abs() < 1e-14);
    // held to the ground
    assert!(refused(&with(1e6)).contains("found 5 rigid motions"), "{}", refused(&with(1e6)));
}

#[test]
fn a_node_that_is_held_does_not_move_in_the_shapes() {
    let record = free_body();
    let node = |node: u64| MbdynReference::Node { body: DofBody::Housing, node };
    let (summary, text) = written_from(&record, node(11));
    let mut squares = [1e6 / 3.0, 2e6 / 3.0, 3e6 / 3.0, 4e5 / 0.05, 5e5 / 0.06, 6e5 / 0.07, 1e8];
    squares.sort_by(f64::total_cmp);
    assert_eq!(summary.frequency_hz.len(), 7);
    for (found, square) in summary.frequency_hz.iter().zip(squares) {
        let expected = f64::sqrt(square) / std::f64::consts::TAU;
        // a diagonal problem: a few roundings
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
    }
    for shape in numbers(&text, 8).chunks_exact(12) {
        assert_eq!(shape[..6], [0.0; 6]);
    }
    assert!((summary.mass.unwrap() - 5.0).abs() < 1e-14);
    assert_eq!(
        refused_from(&record, node(13)),
        "expected six coordinates of the interface at housing node 13, which is to be held, found 0"
    );
}

/// Centre nodes have names, as nodes of the mesh have numbers, and one of them may be held.
#[test]
fn centre_nodes_are_nodes_of_their_own() {
    let mut record = free_body();
    for (row, label) in record.interface.iter_mut().enumerate() {
        *label = DofLabel::centre(row as u64 / 6, row % 6, label.position);
    }
    let (summary, text) = written_from(&record, MbdynReference::Node { body: DofBody::Centre, node: 1 });
    assert_eq!(words(&text, 2).unwrap(), ["centre0", "centre1"]);
    assert_eq!(summary.nodes, 2);
    for shape in numbers(&text, 8).chunks_exact(12) {
        assert_eq!(shape[6..], [0.0; 6]);
    }
}

/// A node of the field moves by its rows, without rotations; one that the interface has too is there once.
#[test]
fn nodes_of_the_field_come_after_those_of_the_interface() {
    let mut record = free_body();
    let recovery = DenseMatrix::from_fn(6, 13, |i, j| if i >= 3 { f64::from(j == i - 3) } else { 9.0 });
    record.field =
        Some(FieldRecovery { node_tags: vec![12, 77], positions: vec![[0.75, 0.5, 0.5], [0.25, -0.5, 1.0]], recovery });
    let (summary, text) = written(&record);
    assert_eq!(summary.nodes, 3);
    assert_eq!(words(&text, 2).unwrap(), ["11", "12", "77"]);
    let shapes = numbers(&text, 8);
    for shape in shapes.chunks_exact(18) {
        assert_eq!(shape[..3], shape[12..15]);
        assert_eq!(shape[15..], [0.0; 3]);
    }
}

/// Held by its interface's springs to the ground, along axes that are turned.
#[test]
fn a_held_body_has_no_inertia_and_needs_no_labels() {
    let mut record = record();
    record.field = None;
    assert_eq!(
        refused(&record),
        "expected a node with a known position and three displacements, in the interface or in the field, found none"
    );
    let stiffness = DenseMatrix::from_fn(3, 3, |i, j| if i == j { 1e6 * (i + 1) as f64 } else { 0.0 });
    let mass = DenseMatrix::from_fn(3, 3, |i, j| f64::from(i == j));
    let axes = [[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.0, 0.0, 1.0]];
    let polar = |axis: usize| DofLabel {
        body: DofBody::Ring,
        node: 0,
        direction: DofDirection::Polar(axis),
        position: [1.0, 2.0, 3.0],
        axis: axes[axis],
    };
    let record = SuperelementRecord::of_matrices(stiffness, mass, (0..3).map(polar).collect()).unwrap();
    let (summary, text) = written(&record);
    assert_eq!((summary.mass, summary.nodes), (None, 1));
    assert!(words(&text, 12).is_none() && words(&text, 13).is_none());
    assert_eq!(words(&text, 2).unwrap(), ["ring0"]);
    let shapes = numbers(&text, 8);
    for (mode, axis) in axes.iter().enumerate() {
        for (found, expected) in shapes[6 * mode..].iter().zip(axis) {
            // the mode's sign is free; rounding of the eigenvectors
            assert!((found.abs() - expected.abs()).abs() < 1e-12, "{found} {expected}");
        }
    }
}

#[test]
fn what_mbdyn_cannot_have_is_told() {
    let mut moved = free_body();
    for label in &mut moved.interface[6..] {
        label.position[0] += 0.01;
    }
    let error = refused(&moved);
    assert!(error.starts_with("expected no forces in rotation about y of a free body, found "), "{error}");
    let mut unknown = free_body();
    unknown.interface[7].position = [f64::NAN; 3];
    assert_eq!(
        refused(&unknown),
        "expected node, direction, position and axis of every interface coordinate of a free body, not known for coordinate 7"
    );
    let mut plane = record();
    plane.stiffness[(0, 0)] = 0.0;
    plane.stiffness[(0, 1)] = 0.0;
    plane.stiffness[(1, 0)] = 0.0;
    assert_eq!(refused(&plane), "expected a body that is free (6 rigid motions) or held (none), found 1 rigid motions");
    let mut wrong = record();
    wrong.modal_hz.clear();
    assert_eq!(refused(&wrong), "array \"modal_hz\": expected 2 entries, found 0");
    let error = write_mbdyn_fem(Path::new("no/such.fem"), &free_body(), MbdynReference::Floating);
    let error = error.unwrap_err();
    assert!(matches!(error, FormatError::File(_)));
    let negative = SuperelementRecord::of_matrices(
        dense(&[[1.0, 0.0], [0.0, 1.0]]),
        dense(&[[-3.0, 0.0], [0.0, 1.0]]),
        vec![DofLabel::interface(0)],
    )
    .unwrap();
    let error = refused(&negative);
    assert!(error.starts_with("the superelement's eigenvalue problem failed: "), "{error}");
}
