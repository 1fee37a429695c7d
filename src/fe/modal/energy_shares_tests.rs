use super::super::samples::{Cells, Solved, block_round_a_ring, description, ring_for_block, ringed, solve, support};
use super::*;
use crate::fe::material::Material;
use crate::fe::model::{
    Connection, Constraint, Fit, HousingDescription, Link, PointMass, RingSupport, SpringShare, SpringStiffness,
    SupportShare,
};
use crate::numerics::linalg::{SparseMatrix, sparse_times_dense};

/// Two blocks of unlike stiffness on springs, linked by springs, with a mass on top; `tied` as one.
fn blocks(dimension: usize, tied: bool) -> (Cells, Solved) {
    let up = |z: i32| if dimension == 2 { [0, z, 0] } else { [0, 0, z] };
    let to = |x: i32, z: i32| if dimension == 2 { [x, z, 0] } else { [x, 2, z] };
    let cells = Cells::new(dimension, [0.03, 0.02, 0.025])
        .block("foot", 0, up(0), to(3, 2))
        .block("lid", 1, up(2), to(3, 4))
        .block("extra", 1, up(4), to(1, 5))
        .face("under", 0, up(0), to(3, 0))
        .face("seat", 0, up(2), to(3, 2))
        .face("cover", 1, up(2), to(3, 2))
        .points("top", 1, &[up(5)]);
    let stiffness = SpringStiffness::Global([2e8, 1e8, 3e8]);
    let ground = |share| crate::fe::model::HousingSupport { share, ..support("under", Constraint::Spring(stiffness)) };
    let between = ["cover", "seat"].map(str::to_owned);
    let connection = match tied {
        true => Connection::Tie,
        false => Connection::Spring(stiffness, SupportShare::PerGroup),
    };
    let mut all = HousingDescription {
        supports: vec![ground(SupportShare::PerGroup)],
        links: vec![Link { between, connection }],
        masses: vec![PointMass { group: "top".to_owned(), mass: 0.5 }],
        ..description(&cells, &["foot", "lid", "extra"], 1.0)
    };
    all.parts[1].material = Material::new(7e10, 0.33, 2700.0).expect("aluminium").into();
    let solved = solve(&cells.mesh, all);
    (cells, solved)
}

fn shares(cells: &Cells, solved: &Solved) -> EnergyShares {
    let rigid = solved.rigid_modes;
    EnergyShares::new(Some((&cells.mesh, &solved.model, &solved.shapes)), None, rigid).expect("modes of this model")
}

/// Parts and springs together hold all of the energy, and that is the eigenvalue.
#[test]
fn shares_add_up_to_the_eigenvalue() {
    for (dimension, tied) in [(2, false), (3, false), (2, true), (3, true)] {
        let (cells, solved) = blocks(dimension, tied);
        let found = shares(&cells, &solved);
        assert_eq!(found.parts, ["foot", "lid", "extra"]);
        let links: &[&str] = if tied { &["under"] } else { &["under", "cover - seat"] };
        assert_eq!(found.springs, links);
        assert_eq!(found.masses, ["top"]);
        for (mode, shares) in found.modes.iter().enumerate() {
            let strain = shares.strain.as_ref().expect("held by springs");
            let kinetic = shares.kinetic.as_ref().expect("mass");
            // the modes satisfy their equation to 1e-12 or so
            let eigenvalue = solved.eigenvalues[mode];
            let error = shares.doubled_strain / eigenvalue - 1.0;
            assert!(error.abs() < 1e-10, "{dimension} {tied} {mode} {error:e}");
            assert!((shares.doubled_kinetic - 1.0).abs() < 1e-10);
            let sum: f64 = strain.parts.iter().chain(&strain.springs).sum();
            assert!((sum - 1.0).abs() < 1e-14, "{sum}");
            let sum: f64 = kinetic.parts.iter().chain(&kinetic.masses).sum();
            assert!((sum - 1.0).abs() < 1e-14, "{sum}");
            // each part is a group of its own here
            assert_eq!(strain.parts, strain.groups);
            assert_eq!(kinetic.parts, kinetic.groups);
            let all = strain.parts.iter().chain(&strain.springs);
            assert!(all.chain(&kinetic.parts).all(|share| *share > -1e-14));
        }
    }
}

/// A stiff block on a soft spring: all strain energy in the spring, all kinetic energy by mass.
#[test]
fn a_block_on_a_spring() {
    let cells = Cells::new(3, [0.1; 3])
        .block("left", 0, [0; 3], [1, 1, 1])
        .block("right", 0, [1, 0, 0], [3, 1, 1])
        .points("all", 0, &[[0, 0, 0], [3, 0, 0], [0, 1, 0], [3, 1, 1], [0, 0, 1]]);
    let soft = Constraint::Spring(SpringStiffness::Global([1e3; 3]));
    let description =
        HousingDescription { supports: vec![support("all", soft)], ..description(&cells, &["left", "right"], 1.0) };
    let solved = solve(&cells.mesh, description);
    let found = shares(&cells, &solved);
    let translations = found.modes[..6].iter();
    for shares in translations {
        let strain = shares.strain.as_ref().expect("on a spring");
        // the block is 1e6 times stiffer
        assert!((strain.springs[0] - 1.0).abs() < 1e-5, "{strain:?}");
    }
    let sum: f64 = (0..6).map(|mode| found.modes[mode].kinetic.as_ref().map_or(0.0, |k| k.parts[1])).sum();
    // by the moments of a bar of three cubes of which two are the right part: three translations and the turn
    // about x with 2/3 each, the turns about y and z with (1.1667 + 0.1667) / (2.25 + 0.25); 1e-5 as above
    assert!((sum / (8.0 / 3.0 + 16.0 / 15.0) - 1.0).abs() < 1e-5, "{sum}");
}

#[test]
fn rigid_modes_have_no_shares_of_strain() {
    let cells = Cells::new(3, [0.1; 3]).block("b", 0, [0; 3], [2, 2, 1]);
    let solved = solve(&cells.mesh, description(&cells, &["b"], 1.0));
    let found = shares(&cells, &solved);
    for (mode, shares) in found.modes.iter().enumerate() {
        assert_eq!(shares.strain.is_none(), mode < 6, "{mode}");
        assert!(shares.kinetic.is_some());
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let cells = Cells::new(3, [0.01; 3]).block("b", 0, [0; 3], [12, 12, 8]);
    let model = HousingModel::new(&cells.mesh, description(&cells, &["b"], 1.0)).expect("a model");
    let shapes = DenseMatrix::from_fn(model.dof(), 3, |dof, mode| (0.37 * (dof + 1) as f64 * (mode + 1) as f64).sin());
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| EnergyShares::new(Some((&cells.mesh, &model, &shapes)), None, 0))
            .expect("shares")
    };
    let one = on(1);
    for threads in [2, 3, 8] {
        let several = on(threads);
        for (a, b) in one.modes.iter().zip(&several.modes) {
            assert_eq!(a.doubled_strain.to_bits(), b.doubled_strain.to_bits());
            assert_eq!(a.doubled_kinetic.to_bits(), b.doubled_kinetic.to_bits());
        }
        assert_eq!(one, several);
    }
}

#[test]
fn modes_of_another_model_are_refused() {
    let (cells, solved) = blocks(2, false);
    let shapes = DenseMatrix::zeros(3, 1);
    let found = EnergyShares::new(Some((&cells.mesh, &solved.model, &shapes)), None, 0);
    assert!(matches!(found, Err(ModalError::Shape { .. })));
}

/// Parts, ring and springs together hold all of it; ring and housing have what their own matrices say, uncoupled.
#[test]
fn a_ring_has_its_share() {
    for (dimension, fit) in [(2, Fit::Bonded), (3, Fit::Bonded), (2, Fit::Sliding), (3, Fit::Sliding)] {
        let (cells, frame) = block_round_a_ring(dimension);
        let cells = cells.block("lid", 0, [2, 0, 0], [4, 2, 2]).points("top", 0, &[[4, 1, 0]]);
        let springs = Constraint::Spring(SpringStiffness::Global([2e8, 1e8, 3e8]));
        let all = HousingDescription {
            frame,
            supports: vec![support("top", springs)],
            masses: vec![PointMass { group: "top".to_owned(), mass: 3.0 }],
            ..description(&cells, &["body", "lid"], 1.0)
        };
        let mut ring = ring_for_block(dimension);
        let support =
            RingSupport { from: 0.1, to: 3.0, spring: [3e7, 2e7, 1e7], share: SpringShare::Total, offset: 2e-3 };
        ring.add_support(&support).expect("nodes there");
        let solved = ringed(&cells.mesh, all, ring, fit, 12);
        let (model, basis) = (&solved.model, &solved.basis);
        let (shapes, of_ring) = (&solved.housing, &solved.of_ring);
        let found =
            EnergyShares::new(Some((&cells.mesh, model, shapes)), Some((&solved.rings, of_ring)), basis.rigid_modes);
        let found = found.expect("modes of this model");
        assert_eq!(found.springs, ["top", "ring supports"]);
        let own = |k: &DenseMatrix, mode: usize| -> f64 {
            let x = of_ring.col(mode);
            x.transpose() * (k * x)
        };
        let stiff = sparse_times_dense(&solved.matrices.stiffness, shapes);
        let heavy = sparse_times_dense(&solved.matrices.mass, shapes);
        for (mode, shares) in found.modes.iter().enumerate().skip(basis.rigid_modes) {
            let strain = shares.strain.as_ref().expect("elastic");
            let kinetic = shares.kinetic.as_ref().expect("mass");
            let of_parts = strain.parts.iter().chain(&strain.springs);
            let sum: f64 = of_parts.sum::<f64>() + strain.ring.expect("a ring");
            assert!((sum - 1.0).abs() < 1e-14, "{sum}");
            let of_parts = kinetic.parts.iter().chain(&kinetic.masses);
            let sum: f64 = of_parts.sum::<f64>() + kinetic.ring.expect("a ring");
            assert!((sum - 1.0).abs() < 1e-14, "{sum}");
            // the frequency of the coupled problem, within its bound: K's round-off is felt in the lowest ones
            let hz = basis.frequencies_hz[mode];
            let difference = (shares.doubled_strain.sqrt() / std::f64::consts::TAU - hz).abs();
            let allowed = basis.error_bounds_hz[mode] + 1e-10 * hz;
            assert!(difference < allowed, "{dimension} {fit:?} {mode}: {difference:e} of {hz} Hz, allowed {allowed:e}");
            assert!((shares.doubled_kinetic - 1.0).abs() < 1e-10);
            // matrices of ring and of housing by themselves, springs included; their round-off is that of their entries
            let close = |share: f64, energy: f64, whole: f64, entries: f64| {
                let difference = (share * whole - energy).abs();
                assert!(
                    difference < 1e-10 * whole + 64.0 * f64::EPSILON * entries,
                    "{dimension} {fit:?} {mode}: {difference:e} of {whole:e}, {entries:e}"
                );
            };
            let ring_entries = |k: &DenseMatrix| k.norm_max() * of_ring.col(mode).squared_norm_l2();
            let housing_entries = |k: &SparseMatrix| {
                let largest = k.data().iter().fold(0.0_f64, |k, value| k.max(value.abs()));
                largest * shapes.col(mode).squared_norm_l2()
            };
            let (k, m) = (solved.rings.stiffness(), solved.rings.mass());
            let (strain_sum, kinetic_sum) = (shares.doubled_strain, shares.doubled_kinetic);
            let share = strain.ring.expect("a ring") + strain.springs[1];
            close(share, own(k, mode), strain_sum, ring_entries(k));
            let share = kinetic.ring.expect("a ring");
            close(share, own(m, mode), kinetic_sum, ring_entries(m));
            let (k, m) = (&solved.matrices.stiffness, &solved.matrices.mass);
            let share: f64 = strain.parts.iter().sum::<f64>() + strain.springs[0];
            let energy = shapes.col(mode).transpose() * stiff.col(mode);
            close(share, energy, strain_sum, housing_entries(k));
            let share: f64 = kinetic.parts.iter().sum::<f64>() + kinetic.masses[0];
            let energy = shapes.col(mode).transpose() * heavy.col(mode);
            close(share, energy, kinetic_sum, housing_entries(m));
        }
        // the ring is not for show
        let most = found.modes.iter().filter_map(|mode| mode.strain.as_ref()?.ring);
        assert!(most.fold(0.0, f64::max) > 0.05);
        let other =
            EnergyShares::new(Some((&cells.mesh, model, shapes)), Some((&solved.rings, &DenseMatrix::zeros(5, 12))), 0);
        assert!(matches!(other, Err(ModalError::Shape { .. })));
    }
}
