//! Impacts that belong to no part of the bearing: another bearing, a wrong speed.

use std::f64::consts::TAU;

use super::cage::one_ball_differs;
use super::*;

/// The one place of impacts that belong to no part.
fn alone(found: &Diagnosis) -> &UnexplainedImpacts {
    assert_eq!(named(found), [], "{:#?}", found.faults);
    let [impacts] = &found.unexplained[..] else {
        panic!("{:#?}", found.unexplained);
    };
    impacts
}

#[test]
fn impacts_that_belong_to_no_part_are_said() {
    let values = struck(4.4, steady, 2.2, |_| 1.0);
    let found = judged(&with_noise(&values, 0.15, 21), steady, &bearing(), 0.01);
    let impacts = alone(&found);
    // the search has a place every tenth of the resolution, and a tooth counts up to half a bin away
    assert!((impacts.order - 2.2).abs() < 0.15 / 64.0, "{impacts:?}");
    assert!(impacts.harmonics_seen >= 4);
    let sentence = found.sentence();
    assert!(sentence.starts_with("impacts at 55.00 Hz belong to no part. Check bearing"), "{sentence}");
}

/// Harmonics fall off, and every second event is a little stronger: lines halfway are weak, and half of the order is not said.
#[test]
fn weak_lines_halfway_are_no_fundamental() {
    let (order, mut noise) = (2.2, Noise(7));
    let values = signal(4.4, steady, |_, turns| {
        let line = |k: f64| (TAU * k * order * turns).cos();
        let falling: f64 = (1..=5).map(|k| 0.5 * 0.5_f64.powi(k - 1) * line(f64::from(k))).sum();
        let halfway = 0.045 * (line(0.5) + line(1.5) + line(2.5));
        (1.0 + falling + halfway) * noise.normal()
    });
    let found = judged(&values, steady, &bearing(), 0.01);
    let impacts = alone(&found);
    assert!((impacts.order - order).abs() < 0.01, "{impacts:?}");
}

/// The ball of another bearing, whose cage turns slower by a tenth.
#[test]
fn the_cage_of_another_bearing_is_said() {
    let cage = 0.9 * bearing().cage;
    let found = judged(&one_ball_differs(6.0, cage, 0.3, 31), steady, &bearing(), 0.01);
    let impacts = alone(&found);
    // half of the resolution of 150 revolutions at the second harmonic
    assert!((impacts.order - cage).abs() < 0.5 / 150.0 / 2.0, "{impacts:?}");
    let quiet = judged(&one_ball_differs(6.0, cage, 0.0, 32), steady, &bearing(), 0.01);
    assert_eq!(quiet.unexplained, []);
}

/// Something that strikes at a half or a third of a part's order has that part's harmonics among its own, and what strikes at twice the
/// cage's order has every second harmonic of the cage.
#[test]
fn impacts_at_a_fraction_or_multiple_of_a_parts_order_name_no_part() {
    let orders = bearing();
    let of = [
        (orders.outer, 3.0),
        (orders.inner, 3.0),
        (orders.cage, 3.0),
        (orders.inner, 0.5),
        (orders.cage, 0.5),
        (orders.cage, 1.0 / 3.0),
        // 1.4 % beside the order of the ball
        (orders.outer, 0.75),
    ];
    for (order, parts) in of {
        let signal = with_noise(&struck(8.0, steady, order / parts, |_| 2.0), 0.1, 81);
        let found = judged(&signal, steady, &orders, 0.01);
        assert!(named(&found).is_empty(), "{order} / {parts}: {found:#?}");
    }
}
