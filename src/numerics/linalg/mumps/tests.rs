use super::super::dense::pseudo_random;
use super::super::factor::{Factor, LARGEST_CONTRACTION, Numbers as OfFactor};
use super::super::{Ordering, Plan, TripletBuilder};
use super::*;
use std::sync::Arc;

const WAYS: [Way; 3] = [Way::InCore, Way::LowRank, Way::OutOfCore];

/// Cube of unit springs between its points, each of them held by one more, less sigma: `3 + ...` in three directions.
fn cube(edge: usize, sigma: f64) -> SymmetricMatrix {
    let place = |x: usize, y: usize, z: usize| x + edge * (y + edge * z);
    let mut a = TripletBuilder::new(edge.pow(3), edge.pow(3));
    for z in 0..edge {
        for y in 0..edge {
            for x in 0..edge {
                let own = place(x, y, z);
                a.add(own, own, 6.0 - sigma);
                let further = [(x + 1, y, z), (x, y + 1, z), (x, y, z + 1)];
                for (x, y, z) in further.into_iter().filter(|&(x, y, z)| x.max(y).max(z) < edge) {
                    a.add(own, place(x, y, z), -1.0);
                    a.add(place(x, y, z), own, -1.0);
                }
            }
        }
    }
    let a = a.build();
    let ordering = Ordering::of(&a).expect("an order");
    SymmetricMatrix::permuted(&a, &ordering)
}

/// Eigenvalues of the cube below sigma, from those of a chain of `edge` points.
fn below(edge: usize, sigma: f64) -> usize {
    let chain = |j: usize| 2.0 - 2.0 * ((j + 1) as f64 * std::f64::consts::PI / (edge + 1) as f64).cos();
    let all = (0..edge.pow(3)).map(|j| chain(j % edge) + chain(j / edge % edge) + chain(j / edge / edge));
    all.filter(|value| *value < sigma).count()
}

#[test]
fn every_way_counts_the_eigenvalues_of_a_cube() {
    for sigma in [0.0, 0.17, 0.61, 3.1] {
        let a = cube(14, sigma);
        for way in WAYS {
            for double in [false, true] {
                let numbers = Numbers::new(&a, Kind::Indefinite, way, double).expect("regular");
                assert_eq!(numbers.negative(), below(14, sigma), "{way} {sigma}");
                let plan = Arc::new(Plan::of(&a).expect("analysed"));
                let factor = Factor::measured(&plan, &a, OfFactor::Mumps(Box::new(numbers)));
                assert!(factor.contraction < LARGEST_CONTRACTION, "{way} {sigma}: {:e}", factor.contraction);
                assert_eq!(factor.is_double(), double);
            }
        }
    }
}

#[test]
fn many_right_hand_sides_are_solved_for() {
    let a = cube(9, 0.0);
    let x = pseudo_random(a.order(), 41, 3);
    for way in WAYS {
        for (double, limit) in [(false, 1e-3), (true, 1e-12)] {
            let mut y = a.times(x.as_ref());
            Numbers::new(&a, Kind::Definite, way, double).expect("definite").solve(y.as_mut());
            let error = (&y - &x).norm_max();
            assert!(error < limit, "{way} {double}: {error:e}");
        }
    }
}

#[test]
fn what_cannot_be_factorised_is_told() {
    let indefinite = Numbers::new(&cube(5, 2.0), Kind::Definite, Way::InCore, true);
    assert!(matches!(indefinite, Err(LinalgError::NotPositiveDefinite { order: 125, .. })), "{indefinite:?}");
    for (failure, words) in [
        (Failure(-90, 0), "MUMPS_OOC_TMPDIR"),
        (Failure(-13, -2000), "8.0 GB more of memory"),
        (Failure(-13, 260_000), "2 MB more of memory"),
        (Failure(-9, 7), "free memory"),
        (Failure(0, 0), "expected 5.5"),
    ] {
        let text = told(failure, 8, Way::OutOfCore).to_string();
        assert!(text.contains("8 x 8") && text.contains(words), "{text}");
    }
}

#[test]
fn files_are_in_a_folder_and_gone_with_the_factor() {
    let factor = MumpsFactor::<f32>::new(&cube(9, 0.0), Kind::Indefinite, Way::OutOfCore).expect("regular");
    let path = factor.on_disk.as_ref().expect("a folder").0.path().to_owned();
    // beside the one that names the machine
    assert!(std::fs::read_dir(&path).expect("it is there").count() > 1);
    drop(factor);
    assert!(!path.exists());
}

#[test]
fn a_solve_that_failed_is_told_by_its_factor() {
    let a = cube(9, 0.0);
    let numbers = MumpsFactor::<f32>::new(&a, Kind::Indefinite, Way::OutOfCore).expect("regular");
    assert_eq!(numbers.check(), Ok(()));
    // what MUMPS says of a file that it cannot read
    numbers.failure.set(told(Failure(-90, 0), a.order(), Way::OutOfCore)).expect("none failed");
    let plan = Arc::new(Plan::of(&a).expect("analysed"));
    let factor = Factor::measured(&plan, &a, OfFactor::Mumps(Box::new(Numbers::Single(numbers))));
    let failed = factor.check().expect_err("a solve failed").to_string();
    assert!(failed.contains("MUMPS_OOC_TMPDIR"), "{failed}");
}

/// Files that something changes or removes between two solves.
#[test]
fn files_that_are_damaged_or_gone_are_told() {
    let a = cube(14, 0.0);
    let damage = |path: &std::path::Path| {
        let length = std::fs::metadata(path).expect("a file").len() as usize;
        std::fs::write(path, vec![0x3f; length]).expect("writable");
    };
    let removal = |path: &std::path::Path| std::fs::remove_file(path).expect("a file");
    let ways = [(damage as fn(&std::path::Path), "are damaged"), (removal, "are gone")];
    for (does, words) in ways {
        for double in [false, true] {
            let numbers = Numbers::new(&a, Kind::Indefinite, Way::OutOfCore, double).expect("regular");
            let folder = match &numbers {
                Numbers::Single(factor) => &factor.on_disk.as_ref().expect("files").0,
                Numbers::Double(factor) => &factor.on_disk.as_ref().expect("files").0,
            };
            let mut b = pseudo_random(a.order(), 3, 5);
            for _ in 0..3 {
                numbers.solve(b.as_mut());
                assert_eq!(numbers.check(), Ok(()));
            }
            for entry in std::fs::read_dir(folder.path()).expect("a folder").flatten() {
                does(&entry.path());
            }
            numbers.solve(b.as_mut());
            let failed = numbers.check().expect_err("no factor").to_string();
            assert!(failed.contains(words) && failed.contains("set MUMPS_OOC_TMPDIR"), "{failed}");
            assert!(b[(0, 0)].is_nan());
        }
    }
}

#[test]
fn analysis_by_scotch_is_made_safe() {
    assert!(ffi::low_rank_is_safe());
}

#[test]
fn blocks_are_runs_of_one_pattern() {
    // unknowns 0 and 1 of one node beside 2; a diagonal that is not stored
    let a = SymmetricMatrix {
        offsets: vec![0, 3, 5, 5],
        rows: vec![0, 1, 2, 1, 2],
        values: vec![2.0, 1.0, 1.0, 2.0, 1.0],
        followers: None,
    };
    // the last column has no row below that the one before has not
    assert_eq!(blocks(&a), [1, 4]);
    let chain = SymmetricMatrix {
        offsets: vec![0, 2, 4, 5],
        rows: vec![0, 1, 1, 2, 2],
        values: vec![2.0, -1.0, 2.0, -1.0, 2.0],
        followers: None,
    };
    assert_eq!(blocks(&chain), [1, 2, 4]);
}
