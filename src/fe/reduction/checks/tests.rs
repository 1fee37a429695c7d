//! A healthy superelement passes; every check fires on one that is broken in its way.

use super::{Check, RigidMotions, check_craig_bampton};
use crate::fe::assembly::SystemMatrices;
use crate::fe::reduction::samples::{both_ends, every_third, grounded_rod, rod};
use crate::fe::reduction::{
    BasisChoice, BasisSize, CharacteristicModes, CraigBampton, InterfaceReduction, InterfaceSize, craig_bampton,
};
use crate::numerics::linalg::DenseMatrix;

const NODES: usize = 30;

/// A third of the rod's highest frequency sqrt(4) / 2 pi.
const BAND_HZ: f64 = 0.1;

fn condensed(matrices: &SystemMatrices, enhanced: bool) -> CraigBampton {
    let choice = BasisChoice { size: BasisSize::Count(14), enhanced, band_hz: BAND_HZ };
    craig_bampton(matrices, &both_ends(NODES), choice, None).expect("connected")
}

fn translation() -> RigidMotions {
    RigidMotions {
        housing: DenseMatrix::from_fn(NODES, 1, |_, _| 1.0),
        interface: DenseMatrix::from_fn(2, 1, |_, _| 1.0),
    }
}

fn failing(condensed: &CraigBampton, matrices: &SystemMatrices, band_hz: f64) -> Vec<&'static str> {
    let checks = check_craig_bampton(condensed, None, matrices, &translation(), band_hz);
    let checks = checks.expect("finite");
    let bad = checks.iter().filter(|check| !check.ok());
    bad.map(|check| check.name).collect()
}

#[test]
fn a_healthy_superelement_passes() {
    for matrices in [rod(NODES), grounded_rod(NODES, 1e-3)] {
        for enhanced in [false, true] {
            let condensed = condensed(&matrices, enhanced);
            let none: [&str; 0] = [];
            assert_eq!(failing(&condensed, &matrices, BAND_HZ), none, "{enhanced}");
        }
    }
}

#[test]
fn verdicts_do_not_depend_on_units() {
    let mut matrices = rod(NODES);
    // millimetres and tonnes: stiffness N/mm, mass t
    matrices.stiffness.map_inplace(|k| 1e-3 * k);
    matrices.mass.map_inplace(|m| 1e-3 * m);
    let condensed = condensed(&matrices, true);
    let none: [&str; 0] = [];
    assert_eq!(failing(&condensed, &matrices, BAND_HZ), none);
}

/// What spoils a superelement.
type Break = fn(&mut CraigBampton);

/// What breaks, and the check that must name it; others may fire beside it.
const BREAKS: [(&str, Break); 16] = [
    ("stiffness symmetry", |c| c.superelement.stiffness[(0, 1)] *= 1.0 + 1e-9),
    ("mass symmetry", |c| c.superelement.mass[(0, 3)] *= 1.0 + 1e-9),
    ("stiffness semidefinite", |c| c.superelement.stiffness[(2, 2)] *= -1.0),
    ("mass definite", |c| c.superelement.mass[(1, 1)] = 1e-20),
    ("k_bq = 0", |c| {
        c.superelement.stiffness[(0, 4)] += 1e-7;
        c.superelement.stiffness[(4, 0)] += 1e-7;
    }),
    ("k_qq diagonal", |c| {
        c.superelement.stiffness[(3, 4)] += 1e-7;
        c.superelement.stiffness[(4, 3)] += 1e-7;
    }),
    ("m_qq = 1", |c| c.superelement.mass[(5, 5)] += 1e-7),
    ("vectors orthonormal", |c| scale(&mut c.basis.vectors, 2, 1.0 + 1e-7)),
    ("vectors diagonalise", |c| c.basis.values[1] *= 1.0 + 1e-7),
    ("constraint modes orthogonal", |c| c.substructure.constraint_modes[(3, 0)] += 1e-6),
    ("static interior", |c| c.substructure.constraint_modes[(3, 0)] += 1e-6),
    ("static interface", |c| c.superelement.stiffness[(0, 0)] += 1e-6),
    ("rigid modes", |c| c.superelement.stiffness[(1, 1)] += 1e-6),
    ("effective mass", |c| (0..14).for_each(|q| scale(&mut c.basis.vectors, q, 1.2))),
    ("rigid motions carried", |c| c.substructure.constraint_modes[(9, 1)] += 1e-6),
    ("mass properties", |c| c.superelement.mass[(0, 0)] *= 1.0 + 1e-6),
];

fn scale(matrix: &mut DenseMatrix, column: usize, factor: f64) {
    let entries = matrix.col_as_slice_mut(column).iter_mut();
    entries.for_each(|entry| *entry *= factor);
}

#[test]
fn every_check_fires() {
    let matrices = rod(NODES);
    let whole = condensed(&matrices, false);
    for (name, break_it) in BREAKS {
        let mut broken = whole.clone();
        break_it(&mut broken);
        let fired = failing(&broken, &matrices, BAND_HZ);
        assert!(fired.contains(&name), "{name}: {fired:?}");
    }
    let mut broken = whole.clone();
    // stiffness to the ground that the mesh has not
    broken.superelement.stiffness[(0, 0)] += 1e-3;
    assert!(failing(&broken, &matrices, BAND_HZ).contains(&"rigid energy"));
    assert_eq!(failing(&whole, &matrices, 0.32), ["band covered"]);
}

#[test]
fn a_held_housing_that_can_move_is_named() {
    let matrices = grounded_rod(NODES, 1e-3);
    let mut broken = condensed(&matrices, false);
    let free = condensed(&rod(NODES), false);
    broken.superelement.stiffness = free.superelement.stiffness;
    assert!(failing(&broken, &matrices, BAND_HZ).contains(&"held"));
}

#[test]
fn every_check_is_broken_here() {
    let checks = |matrices: &SystemMatrices| {
        let condensed = condensed(matrices, false);
        let checks = check_craig_bampton(&condensed, None, matrices, &translation(), BAND_HZ);
        checks.expect("finite").iter().map(|check| check.name).collect::<Vec<_>>()
    };
    let others = ["rigid energy", "band covered", "held"];
    for name in [checks(&rod(NODES)), checks(&grounded_rod(NODES, 1e-3))].concat() {
        let broken = BREAKS.iter().any(|(of, _)| *of == name) || others.contains(&name);
        assert!(broken, "{name} is never seen failing");
    }
}

#[test]
fn a_value_that_is_no_number_fails() {
    for check in [Check::at_most("a", "", f64::NAN, 1.0), Check::at_least("a", "", f64::NAN, 1.0)] {
        assert!(!check.ok());
    }
    assert!(Check::at_most("a", "", 1.0, 1.0).ok() && Check::at_least("a", "", 1.0, 1.0).ok());
}

/// Names of the checks of the rod on five modes of its ten interface nodes, and whether they pass, after something was
/// done to it.
fn on_modes(matrices: &SystemMatrices, change: impl FnOnce(&mut InterfaceReduction)) -> Vec<(&'static str, bool)> {
    let choice = BasisChoice { size: BasisSize::Count(14), enhanced: false, band_hz: BAND_HZ };
    let condensed = craig_bampton(matrices, &every_third(NODES), choice, None).expect("connected");
    let rigid = RigidMotions { interface: DenseMatrix::from_fn(10, 1, |_, _| 1.0), ..translation() };
    let free = rigid.free_interface(&condensed, matrices).expect("finite");
    let modes = CharacteristicModes::of(&condensed.substructure, None, &free).expect("finite");
    let reduction = InterfaceReduction::new(&condensed, &modes, InterfaceSize::Count(5));
    let mut reduction = reduction.expect("enough");
    change(&mut reduction);
    let checks = check_craig_bampton(&condensed, Some(&reduction), matrices, &rigid, BAND_HZ);
    let checks = checks.expect("finite");
    checks.iter().map(|check| (check.name, check.ok())).collect()
}

#[test]
fn a_reduced_interface_keeps_all_checks_but_statics() {
    for matrices in [rod(NODES), grounded_rod(NODES, 1e-3)] {
        let found = on_modes(&matrices, |_| {});
        let bad: Vec<_> = found.iter().filter(|(_, ok)| !ok).collect();
        assert!(bad.is_empty(), "{bad:?}");
        let names = |(name, _): &(&'static str, bool)| *name;
        let condensed = condensed(&matrices, false);
        let all = check_craig_bampton(&condensed, None, &matrices, &translation(), BAND_HZ);
        let expected = all.expect("finite");
        let expected = expected.iter().map(|check| check.name);
        assert_eq!(
            found.iter().map(names).collect::<Vec<_>>(),
            expected.filter(|name| *name != "static interface").collect::<Vec<_>>()
        );
    }
}

#[test]
fn checks_of_a_reduced_interface_fire() {
    type Break = fn(&mut InterfaceReduction);
    let breaks: [(&str, Break); 10] = [
        ("stiffness symmetry", |r| r.superelement.stiffness[(1, 2)] += 1e-6),
        ("mass symmetry", |r| r.superelement.mass[(0, 6)] += 1e-6),
        ("stiffness semidefinite", |r| r.superelement.stiffness[(2, 2)] *= -1.0),
        ("mass definite", |r| r.superelement.mass[(1, 1)] = 1e-20),
        ("k_bq = 0", |r| {
            r.superelement.stiffness[(1, 7)] += 1e-6;
            r.superelement.stiffness[(7, 1)] += 1e-6;
        }),
        ("m_qq = 1", |r| r.superelement.mass[(6, 6)] += 1e-7),
        ("rigid modes", |r| r.superelement.stiffness[(0, 0)] += 1e-6),
        ("rigid motions carried", |r| r.transform[(4, 0)] += 1e-5),
        ("rigid energy", |r| r.superelement.stiffness[(0, 0)] += 1e-3),
        ("mass properties", |r| r.superelement.mass[(0, 0)] *= 1.0 + 1e-6),
    ];
    for (name, break_it) in breaks {
        let found = on_modes(&rod(NODES), break_it);
        assert!(found.contains(&(name, false)), "{name}: {found:?}");
    }
}
