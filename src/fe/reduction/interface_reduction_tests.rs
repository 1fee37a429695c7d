use super::*;
use crate::fe::reduction::interior_basis::coupled_modes;
use crate::fe::reduction::samples::{every_third, grounded_rod, rod, train};
use crate::fe::reduction::{BasisChoice, BasisSize, ErrorEstimate, craig_bampton};
use crate::numerics::linalg::DenseCholesky;
use std::f64::consts::TAU;

const NODES: usize = 60;
const INTERFACE: usize = 20;

fn condensed(held: bool) -> CraigBampton {
    let matrices = match held {
        true => grounded_rod(NODES, 0.1),
        false => rod(NODES),
    };
    let choice = BasisChoice { size: BasisSize::Count(8), enhanced: false, band_hz: 0.1 };
    craig_bampton(&matrices, &every_third(NODES), choice, None).expect("connected")
}

fn none() -> DenseMatrix {
    DenseMatrix::zeros(INTERFACE, 0)
}

fn translation() -> DenseMatrix {
    DenseMatrix::from_fn(INTERFACE, 1, |_, _| 1.0)
}

fn with<'a>([stiffness, mass]: &'a [DenseMatrix; 2]) -> Option<Attached<'a>> {
    Some(Attached { stiffness, mass })
}

fn reduced(
    condensed: &CraigBampton,
    attached: Option<Attached<'_>>,
    rigid: &DenseMatrix,
    kept: usize,
) -> InterfaceReduction {
    let modes = CharacteristicModes::of(&condensed.substructure, attached, rigid).expect("finite");
    InterfaceReduction::new(condensed, &modes, InterfaceSize::Count(kept)).expect("enough")
}

fn whole(condensed: &CraigBampton, attached: Option<Attached<'_>>) -> Vec<f64> {
    let modes = coupled_modes(&condensed.substructure, &condensed.basis, attached);
    modes.expect("definite").values
}

#[test]
fn all_modes_kept_change_nothing() {
    let parts = train(INTERFACE, 5.0, 0.3, 0.0);
    for held in [false, true] {
        let condensed = condensed(held);
        let rigid = if held { none() } else { translation() };
        for attached in [None, with(&parts)] {
            let all = reduced(&condensed, attached, &rigid, 1000);
            assert_eq!((all.kept(), all.next), (INTERFACE, None));
            let found = all.coupled_values(attached).expect("definite");
            for (found, expected) in found.iter().zip(whole(&condensed, attached)) {
                // the solver inverts with a shift of 1e-4 of the smallest k_ii / m_ii: the highest values keep eleven digits
                assert!((found - expected).abs() < 1e-11, "{held}: {found} {expected}");
            }
            let modes = CharacteristicModes::of(&condensed.substructure, attached, &rigid);
            assert!(modes.expect("finite").lost_flexibility(INTERFACE).largest < 1e-12);
        }
    }
}

#[test]
fn errors_fall_with_every_mode_kept() {
    let parts = train(INTERFACE, 5.0, 0.3, 0.0);
    let condensed = condensed(false);
    let expected = whole(&condensed, with(&parts));
    let mut before = [f64::INFINITY; 6];
    for kept in 7..=INTERFACE {
        let values =
            reduced(&condensed, with(&parts), &translation(), kept).coupled_values(with(&parts)).expect("definite");
        for mode in 1..6 {
            let error = values[mode] / expected[mode] - 1.0;
            // from above, but for round-off
            assert!(error > -1e-12, "{kept} {mode}: {error:e}");
            assert!(error < before[mode] + 1e-12, "{kept} {mode}: {error:e}");
            before[mode] = error;
        }
        if kept == 7 {
            assert!(before[5] > 1e-4, "nothing to fall: {before:?}");
        }
    }
}

#[test]
fn the_rise_of_an_estimate_is_that_of_the_frequencies() {
    let condensed = condensed(false);
    let estimate = ErrorEstimate::of(&condensed.substructure, &condensed.basis, None, 0.08).expect("converges");
    let few = reduced(&condensed, None, &translation(), 5);
    let (raised, rises) = estimate.raised(&condensed.basis, &few.coupled_values(None).expect("definite"));
    let (old, new) = (whole(&condensed, None), few.coupled_values(None).expect("definite"));
    assert_eq!(raised.modes.len(), estimate.modes.len());
    assert!(raised.modes.len() > 5 && rises[0] == 0.0);
    // the rod has more modes in the band than these coordinates below its top
    assert!(raised.out_of_band > estimate.out_of_band);
    for mode in 1..raised.modes.len() {
        let rise = (new[mode] / old[mode]).sqrt() - 1.0;
        // one subtraction of roots
        assert!((rises[mode] - rise).abs() < 1e-12, "{mode}");
        assert!((raised.modes[mode].frequency_hz - new[mode].sqrt() / TAU).abs() < 1e-12);
        let both = (1.0 + rise) * (1.0 + estimate.modes[mode].relative_error) - 1.0;
        assert!((raised.modes[mode].relative_error - both).abs() < 1e-12);
    }
}

#[test]
fn rigid_motions_survive() {
    let condensed = condensed(false);
    let parts = train(INTERFACE, 5.0, 0.3, 0.0);
    // they are among the softest modes; named, they are exact
    for rigid in [none(), translation()] {
        for attached in [None, with(&parts)] {
            let few = reduced(&condensed, attached, &rigid, 3);
            let values = few.coupled_values(attached).expect("definite");
            assert!(values[0].abs() < 1e-12 * values[1], "{values:?}");
            let motion = translation();
            let nearest = few.nearest(&motion);
            let back = &few.transform * &nearest;
            // round-off of solutions with k_bb
            assert!((0..INTERFACE).all(|row| (back[(row, 0)] - 1.0).abs() < 1e-9));
            let mass = nearest.transpose() * &few.superelement.mass * &nearest;
            assert!((mass[(0, 0)] / NODES as f64 - 1.0).abs() < 1e-9);
        }
    }
}

/// What is attached is held, the housing is not: the softest modes of both hold no rigid motion.
#[test]
fn rigid_motions_survive_a_ground_that_holds_what_is_attached() {
    let condensed = condensed(false);
    let parts = train(INTERFACE, 5.0, 0.3, 10.0);
    let worst = |rigid: &DenseMatrix| {
        let few = reduced(&condensed, with(&parts), rigid, 6);
        let back = &few.transform * &few.nearest(&translation());
        (0..INTERFACE).map(|row| (back[(row, 0)] - 1.0).abs()).fold(0.0, f64::max)
    };
    assert!(worst(&none()) > 1e-3);
    // round-off of products
    assert!(worst(&translation()) < 1e-12);
    let few = reduced(&condensed, with(&parts), &translation(), 6);
    let alone = few.coupled_values(None).expect("definite");
    assert!(alone[0].abs() < 1e-12 * alone[1]);
    // with its ground it is held
    assert!(few.coupled_values(with(&parts)).expect("definite")[0] > 1e-4);
}

#[test]
fn modes_with_what_is_attached_are_better_than_without() {
    let condensed = condensed(true);
    let parts = train(INTERFACE, 40.0, 2.0, 0.0);
    let expected = whole(&condensed, with(&parts));
    let error = |known: Option<Attached<'_>>| {
        let few = reduced(&condensed, known, &none(), 6);
        let values = few.coupled_values(with(&parts)).expect("definite");
        (0..4).map(|mode| values[mode] / expected[mode] - 1.0).fold(0.0, f64::max)
    };
    let (alone, together) = (error(None), error(with(&parts)));
    // heavy masses on every fifth node: found 24 times
    assert!(alone > 5.0 * together, "{alone:e} {together:e}");
}

#[test]
fn the_flexibility_lost_is_that_of_the_matrices() {
    let condensed = condensed(true);
    let substructure = &condensed.substructure;
    let modes = CharacteristicModes::of(substructure, None, &none()).expect("finite");
    let unit = DenseMatrix::identity(INTERFACE, INTERFACE);
    let all = DenseCholesky::new(substructure.stiffness()).expect("held").solve(&unit);
    let mut before = 1.0;
    for kept in [1, 4, 10, 19] {
        let r = modes.vectors.subcols(0, kept).to_owned();
        let small = congruent(substructure.stiffness(), &r);
        let inner = DenseCholesky::new(&small).expect("held").solve(&r.transpose().to_owned());
        let of_kept = &r * inner;
        let lost: Vec<f64> = (0..INTERFACE).map(|row| 1.0 - of_kept[(row, row)] / all[(row, row)]).collect();
        let found = modes.lost_flexibility(kept);
        let largest = lost.iter().copied().fold(0.0, f64::max);
        let mean = lost.iter().sum::<f64>() / INTERFACE as f64;
        // two solutions of one system
        assert!((found.largest - largest).abs() < 1e-9, "{kept}");
        assert!((found.mean - mean).abs() < 1e-9, "{kept}");
        assert!(found.mean < before && found.mean <= found.largest);
        before = found.mean;
    }
}

#[test]
fn a_frequency_keeps_the_modes_below_it() {
    let condensed = condensed(false);
    let modes = CharacteristicModes::of(&condensed.substructure, None, &translation());
    let modes = modes.expect("finite");
    let [below, above] = [3, 4].map(|mode| modes.frequency_hz(mode).expect("there"));
    let kept = modes.kept(InterfaceSize::UpTo(0.5 * (below + above)));
    assert_eq!(kept, Ok(4));
    assert_eq!(modes.rigid, 1);
}

#[test]
fn too_few_modes_are_named() {
    let condensed = condensed(true);
    let modes = CharacteristicModes::of(&condensed.substructure, None, &none()).expect("finite");
    let error = modes.kept(InterfaceSize::UpTo(1e-6)).expect_err("none");
    assert!(error.to_string().starts_with("0 modes of the interface are kept, expected at least 1"), "{error}");
    // two motions that nothing holds, as far as the caller says
    let two = DenseMatrix::from_fn(INTERFACE, 2, |row, motion| (row as f64).powi(motion as i32));
    let modes = CharacteristicModes::of(&condensed.substructure, None, &two).expect("finite");
    let error = modes.kept(InterfaceSize::Count(1)).expect_err("one of two");
    assert!(error.to_string().starts_with("1 modes of the interface are kept, expected at least 2"), "{error}");
}
