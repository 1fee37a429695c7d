//! Sequences with known limits; a rod of linear elements and a beam of cubic ones with known frequencies.

use super::super::ModalError;
use super::*;
use crate::numerics::linalg::{DenseMatrix, symmetric_generalised_eigen};
use std::f64::consts::{PI, TAU};

fn levels(sizes: &[f64], formal_order: f64) -> MeshLevels {
    MeshLevels { sizes: sizes.to_vec(), formal_order }
}

fn law(sizes: &[f64], limit: f64, order: f64) -> Vec<f64> {
    sizes.iter().map(|h| limit + 0.7 * h.powf(order)).collect()
}

#[test]
fn three_meshes_give_limit_and_order() {
    // unlike ratios, in any order
    let sizes = [0.3, 0.1, 0.17];
    for order in [1.9, 2.0, 2.1] {
        let found = richardson(&levels(&sizes, 2.0), &law(&sizes, 440.0, order)).expect("fits");
        assert_eq!(found.behaviour, Behaviour::Asymptotic);
        // differences of 1e-2 in 440: 12 digits of them are left, and p amplifies by some tens
        assert!((found.order.expect("an order") - order).abs() < 1e-9);
        assert!((found.estimate.expect("a limit") - 440.0).abs() < 1e-10);
        let gap = found.finest - 440.0;
        assert!((found.uncertainty / gap - 1.25).abs() < 1e-6);
    }
}

#[test]
fn an_order_far_from_the_formal_one_is_distrusted() {
    let sizes = [0.1, 0.2, 0.4];
    for order in [0.8, 1.5, 3.5] {
        let found = richardson(&levels(&sizes, 2.0), &law(&sizes, 440.0, order)).expect("fits");
        assert_eq!(found.behaviour, Behaviour::Monotone);
        assert_eq!(found.safety_factor, Some(3.0));
        assert!((found.order.expect("an order") - order).abs() < 1e-8);
        let held = order.min(2.0);
        let step = law(&sizes, 440.0, order)[1] - found.finest;
        let index = 3.0 * step / (2.0_f64.powf(held) - 1.0);
        assert!((found.uncertainty / index - 1.0).abs() < 1e-6);
        let [low, high] = found.interval();
        assert!(low < 440.0 && 440.0 < high);
    }
}

#[test]
fn two_meshes_take_the_formal_order() {
    let sizes = [0.1, 0.2];
    let found = richardson(&levels(&sizes, 2.0), &law(&sizes, 440.0, 2.0)).expect("fits");
    assert_eq!((found.behaviour, found.order), (Behaviour::Unknown, None));
    assert!((found.estimate.expect("a limit") - 440.0).abs() < 1e-10);
    assert!((found.uncertainty / (found.finest - 440.0) - 3.0).abs() < 1e-6);
}

#[test]
fn many_meshes_are_fitted() {
    let sizes = [0.05, 0.1, 0.15, 0.2, 0.3];
    let exact = richardson(&levels(&sizes, 2.0), &law(&sizes, 440.0, 2.0)).expect("fits");
    assert_eq!(exact.behaviour, Behaviour::Asymptotic);
    // the order of a least-squares fit is known to the root of round-off
    assert!((exact.order.expect("an order") - 2.0).abs() < 1e-4);
    assert!((exact.estimate.expect("a limit") - 440.0).abs() < 1e-7);
    // scatter of 1e-4 widens the interval by about as much
    let mut scattered = law(&sizes, 440.0, 2.0);
    for (value, sign) in scattered.iter_mut().zip([1.0, -1.0, 1.0, -1.0, 1.0]) {
        *value += 1e-4 * sign;
    }
    let found = richardson(&levels(&sizes, 2.0), &scattered).expect("fits");
    assert!(found.uncertainty > exact.uncertainty + 5e-5, "{}", found.uncertainty);
    let [low, high] = found.interval();
    assert!(low < 440.0 && 440.0 < high);
}

#[test]
fn what_does_not_converge_is_not_extrapolated() {
    let three = levels(&[0.1, 0.2, 0.4], 2.0);
    let cases = [
        ([440.0, 441.0, 440.5], Behaviour::Oscillating, 1.0),
        ([440.0, 442.0, 443.0], Behaviour::Diverging, 3.0),
        // equal steps at equal ratios: the order is 0
        ([440.0, 441.0, 442.0], Behaviour::Diverging, 2.0),
    ];
    for (values, behaviour, range) in cases {
        let found = richardson(&three, &values).expect("fits");
        assert_eq!((found.behaviour, found.estimate), (behaviour, None), "{values:?}");
        assert!((found.uncertainty - range).abs() < 1e-12);
    }
    let settled = richardson(&three, &[440.0, 440.0 + 1e-11, 440.0]).expect("fits");
    assert_eq!((settled.behaviour, settled.estimate), (Behaviour::Settled, Some(440.0)));
    let five = levels(&[0.1, 0.2, 0.3, 0.4, 0.5], 2.0);
    let found = richardson(&five, &[440.0, 441.0, 440.5, 441.5, 440.0]).expect("fits");
    assert_eq!(found.behaviour, Behaviour::Oscillating);
    let found = richardson(&five, &[440.0, 450.0, 455.0, 457.0, 458.0]).expect("fits");
    assert_eq!(found.behaviour, Behaviour::Diverging);
}

#[test]
fn sequences_that_make_no_sense_are_refused() {
    let refusal = |sizes: &[f64], values: &[f64]| richardson(&levels(sizes, 2.0), values).expect_err("refused");
    let message = |sizes: &[f64], values: &[f64]| refusal(sizes, values).to_string();
    assert_eq!(message(&[0.1], &[1.0]), "1 meshes: an estimate of the discretisation error needs at least 2");
    assert!(message(&[0.1, 0.1005], &[1.0, 2.0]).starts_with("two meshes have sizes 1e-1 and 1.005e-1: expected"));
    assert!(matches!(refusal(&[0.1, 0.2], &[1.0]), ModalError::Shape { .. }));
    assert_eq!(message(&[0.1, -0.2], &[1.0, 2.0]), "mesh size: expected a positive number, found -0.2");
    assert_eq!(message(&[0.1, 0.2], &[1.0, f64::NAN]), "value on mesh 1: expected a finite number, found NaN");
}

/// Frequencies, Hz, of a chain of elements on the degrees of freedom `free`.
fn frequencies(
    elements: usize,
    per_node: usize,
    matrices: impl Fn(usize, usize) -> [f64; 2],
    fixed: &[usize],
) -> Vec<f64> {
    let order = per_node * (elements + 1);
    let (mut k, mut m) = (DenseMatrix::zeros(order, order), DenseMatrix::zeros(order, order));
    for element in 0..elements {
        for i in 0..2 * per_node {
            for j in 0..2 * per_node {
                let at = (per_node * element + i, per_node * element + j);
                let [stiffness, mass] = matrices(i, j);
                k[at] += stiffness;
                m[at] += mass;
            }
        }
    }
    let free: Vec<usize> = (0..order).filter(|dof| !fixed.contains(dof)).collect();
    let part = |a: &DenseMatrix| DenseMatrix::from_fn(free.len(), free.len(), |i, j| a[(free[i], free[j])]);
    let spectrum = symmetric_generalised_eigen(&part(&k), &part(&m)).expect("definite");
    spectrum.values.iter().map(|value| value.sqrt() / TAU).collect()
}

/// A rod of unit length and wave speed, one end fixed: `f = (2 n - 1) / 4`. Linear elements, consistent mass: order 2.
fn rod(elements: usize) -> Vec<f64> {
    let h = 1.0 / elements as f64;
    let of = |i: usize, j: usize| match i == j {
        true => [1.0 / h, h / 3.0],
        false => [-1.0 / h, h / 6.0],
    };
    frequencies(elements, 1, of, &[0])
}

/// A Bernoulli beam of unit length, EI and mass, simply supported: `f = pi n^2 / 2`. Cubic elements: order 4.
fn beam(elements: usize) -> Vec<f64> {
    let h = 1.0 / elements as f64;
    let scale = |i: usize| if i % 2 == 1 { h } else { 1.0 };
    let k = [[12.0, 6.0, -12.0, 6.0], [6.0, 4.0, -6.0, 2.0], [-12.0, -6.0, 12.0, -6.0], [6.0, 2.0, -6.0, 4.0]];
    let m =
        [[156.0, 22.0, 54.0, -13.0], [22.0, 4.0, 13.0, -3.0], [54.0, 13.0, 156.0, -22.0], [-13.0, -3.0, -22.0, 4.0]];
    let of = |i: usize, j: usize| {
        let scale = scale(i) * scale(j);
        [scale * k[i][j] / h.powi(3), scale * m[i][j] * h / 420.0]
    };
    frequencies(elements, 2, of, &[0, 2 * elements])
}

/// The known frequency lies in the interval, and the estimate is nearer to it than the finest mesh.
#[test]
fn known_frequencies_lie_in_the_interval() {
    type Structure = (fn(usize) -> Vec<f64>, f64, fn(f64) -> f64);
    let structures: [Structure; 2] = [(rod, 2.0, |n| (2.0 * n - 1.0) / 4.0), (beam, 4.0, |n| PI * n * n / 2.0)];
    for (structure, formal, exact) in structures {
        for meshes in [vec![8, 16], vec![8, 12, 16], vec![8, 16, 32], vec![6, 8, 12, 16, 24]] {
            let lists: Vec<Vec<f64>> = meshes.iter().map(|&n| structure(n)).collect();
            let sizes: Vec<f64> = meshes.iter().map(|&n| 1.0 / n as f64).collect();
            for mode in 0..4 {
                let values: Vec<f64> = lists.iter().map(|list| list[mode]).collect();
                let found = richardson(&levels(&sizes, formal), &values).expect("a sequence");
                let exact = exact(mode as f64 + 1.0);
                let [low, high] = found.interval();
                let text = format!("{meshes:?} {mode} {exact} {found:?}");
                assert!(low <= exact && exact <= high, "{text}");
                let estimate = found.estimate.expect("converges");
                // the coarsest mesh of five has 1.5 elements a half wave, and pulls the fit
                let left = (estimate - exact).abs() / (found.finest - exact).abs();
                assert!(left < 0.5, "{left} {text}");
                if meshes.len() > 2 && mode == 0 {
                    assert_eq!(found.behaviour, Behaviour::Asymptotic, "{text}");
                }
            }
        }
    }
}
