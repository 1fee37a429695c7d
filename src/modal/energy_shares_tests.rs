use super::super::rigid_modes;
use super::super::samples::{Cells, Solved, description, solve, support};
use super::*;
use crate::material::Material;
use crate::model::{
    Connection, Constraint, HousingDescription, Link, PointMass, SpringStiffness, SupportShare,
};

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
    let ground = |share| crate::model::HousingSupport {
        share,
        ..support("under", Constraint::Spring(stiffness))
    };
    let between = ["cover", "seat"].map(str::to_owned);
    let connection = match tied {
        true => Connection::Tie,
        false => Connection::Spring(stiffness, SupportShare::PerGroup),
    };
    let mut all = HousingDescription {
        supports: vec![ground(SupportShare::PerGroup)],
        links: vec![Link {
            between,
            connection,
        }],
        masses: vec![PointMass {
            group: "top".to_owned(),
            mass: 0.5,
        }],
        ..description(&cells, &["foot", "lid", "extra"], 1.0)
    };
    all.parts[1].material = Material::new(7e10, 0.33, 2700.0).expect("aluminium").into();
    let solved = solve(&cells.mesh, all);
    (cells, solved)
}

fn shares(cells: &Cells, solved: &Solved) -> EnergyShares {
    let rigid = rigid_modes(&solved.matrices.stiffness, &solved.shapes).expect("shapes fit");
    EnergyShares::new(&cells.mesh, &solved.model, &solved.shapes, rigid)
        .expect("modes of this model")
}

/// Parts and springs together hold all of the energy, and that is the eigenvalue.
#[test]
fn shares_add_up_to_the_eigenvalue() {
    for (dimension, tied) in [(2, false), (3, false), (2, true), (3, true)] {
        let (cells, solved) = blocks(dimension, tied);
        let found = shares(&cells, &solved);
        assert_eq!(found.parts, ["foot", "lid", "extra"]);
        let links: &[&str] = if tied {
            &["under"]
        } else {
            &["under", "cover - seat"]
        };
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
        .points(
            "all",
            0,
            &[[0, 0, 0], [3, 0, 0], [0, 1, 0], [3, 1, 1], [0, 0, 1]],
        );
    let soft = Constraint::Spring(SpringStiffness::Global([1e3; 3]));
    let description = HousingDescription {
        supports: vec![support("all", soft)],
        ..description(&cells, &["left", "right"], 1.0)
    };
    let solved = solve(&cells.mesh, description);
    let found = shares(&cells, &solved);
    let translations = found.modes[..6].iter();
    for shares in translations {
        let strain = shares.strain.as_ref().expect("on a spring");
        // the block is 1e6 times stiffer
        assert!((strain.springs[0] - 1.0).abs() < 1e-5, "{strain:?}");
    }
    let sum: f64 = (0..6)
        .map(|mode| {
            found.modes[mode]
                .kinetic
                .as_ref()
                .map_or(0.0, |k| k.parts[1])
        })
        .sum();
    // by the moments of a bar of three cubes of which two are the right part: three translations and the turn
    // about x with 2/3 each, the turns about y and z with (1.1667 + 0.1667) / (2.25 + 0.25); 1e-5 as above
    assert!(
        (sum / (8.0 / 3.0 + 16.0 / 15.0) - 1.0).abs() < 1e-5,
        "{sum}"
    );
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
    let shapes = DenseMatrix::from_fn(model.dof(), 3, |dof, mode| {
        (0.37 * (dof + 1) as f64 * (mode + 1) as f64).sin()
    });
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| EnergyShares::new(&cells.mesh, &model, &shapes, 0))
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
    let found = EnergyShares::new(&cells.mesh, &solved.model, &shapes, 0);
    assert!(matches!(found, Err(ModalError::Shape { .. })));
}
