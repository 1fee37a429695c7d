use super::super::{LinalgError, TripletBuilder};
use super::*;

/// Free chains along three axes, `cells` masses each and all of them coupled: eigenvalues are sums of three of
/// `4 sin^2(j pi / 2 cells)`, most of them threefold or sixfold, and the lowest is zero.
fn lattice(cells: usize) -> (EigenProblem, Vec<f64>) {
    let order = cells.pow(3);
    let mut k = TripletBuilder::new(order, order);
    let mut m = TripletBuilder::new(order, order);
    for row in 0..order {
        m.add(row, row, 1.0);
        for stride in [1, cells, cells * cells] {
            if row / stride % cells + 1 < cells {
                for (a, b, value) in [
                    (row, row, 1.0),
                    (row + stride, row + stride, 1.0),
                    (row, row + stride, -1.0),
                    (row + stride, row, -1.0),
                ] {
                    k.add(a, b, value);
                }
            }
        }
    }
    let one = |j: usize| 4.0 * (std::f64::consts::PI * j as f64 / (2 * cells) as f64).sin().powi(2);
    let mut exact: Vec<f64> =
        (0..order).map(|n| one(n % cells) + one(n / cells % cells) + one(n / cells / cells)).collect();
    exact.sort_by(f64::total_cmp);
    (EigenProblem::new(&k.build(), &m.build()).expect("an order"), exact)
}

fn assert_exact(pairs: &EigenPairs, exact: &[f64], what: &str) {
    assert_eq!(pairs.values.len(), exact.len(), "{what}");
    for (value, expected) in pairs.values.iter().zip(exact) {
        // residuals of 1e-5 leave 1e-10 of an eigenvalue; the highest is 12
        assert!((value - expected).abs() < 1e-9 * expected + 1e-12, "{what}: {value} {expected}");
    }
    let check = pairs.count_check;
    assert!(check.counted == check.found && check.found >= exact.len(), "{what}: {check:?}");
    assert!(pairs.orthogonality < 1e-10, "{what}: {:e}", pairs.orthogonality);
}

#[test]
fn any_number_of_pairs() {
    let (problem, exact) = lattice(11);
    for count in [1, 3, 4, 40, 101, 170, 400, 443, 700, 1331] {
        let pairs = problem.lowest(count).expect("found");
        assert_exact(&pairs, &exact[..count], &count.to_string());
    }
}

/// One search, slices, slices of a band: each tells a share of the pairs that rises from near 0; a slice when it begins.
#[test]
fn the_share_that_is_found_is_told() {
    let (problem, exact) = lattice(11);
    let shares = std::sync::Mutex::new(Vec::new());
    let told = |part| shares.lock().unwrap().push(part);
    let looked: [&dyn Fn() -> Result<EigenPairs, LinalgError>; 3] =
        [&|| problem.lowest_told(40, &told), &|| problem.lowest_told(120, &told), &|| {
            problem.between(1.01, exact[220], &told)
        }];
    for (which, look) in looked.iter().enumerate() {
        look().expect("found");
        let told = std::mem::take(&mut *shares.lock().unwrap());
        assert!(told.len() > 1 && told[0] < 0.1 && told.last().is_some_and(|last| *last > 0.2), "{which}: {told:?}");
        assert!(told.iter().all(|part| (0.0..=1.0).contains(part)), "{which}: {told:?}");
        // sixfold eigenvalues: what is missing is looked for again
        assert!(told.windows(2).filter(|pair| pair[1] < pair[0]).count() <= 3, "{which}: {told:?}");
    }
}

#[test]
fn slices_of_a_band_and_ends_on_eigenvalues() {
    let (problem, exact) = lattice(11);
    let below = |value: f64| exact.iter().filter(|&&one| one < value).count();
    for [low, high] in [[1.01, 1.11], [0.51, 4.03], [3.02, 12.5], [11.01, 1e300]] {
        let pairs = problem.between(low, high, &|_| {}).expect("found");
        assert_exact(&pairs, &exact[below(low)..below(high)], &format!("{low} {high}"));
    }
    for low in [0.0, 1e-20, -1.0] {
        let pairs = problem.between(low, 0.51, &|_| {}).expect("found");
        assert_exact(&pairs, &exact[..below(0.51)], &low.to_string());
        assert!(pairs.count_check.above.is_none());
    }
    // the first three are equal, and all within the band that they begin
    let pairs = problem.between(exact[1], exact[4], &|_| {}).expect("found");
    assert_exact(&pairs, &exact[1..below(exact[4] * (1.0 + 1e-9))], "on eigenvalues");
    for high in [0.0, 1e-20] {
        assert_exact(&problem.below(high, &|_| {}).expect("found"), &exact[..1], "zero");
    }
    assert!(problem.between(20.0, 30.0, &|_| {}).expect("none").values.is_empty());
    assert!(problem.between(1e200, 1e300, &|_| {}).expect("none").values.is_empty());
}

#[test]
fn modes_that_fill_the_memory_are_refused() {
    let (problem, _) = lattice(3);
    assert!(problem.find_room(27).is_ok());
    // 2^40 blocks of 27 rows: 10^15 bytes
    let refused = problem.find_room(1 << 40);
    let wanted = "modes of 27 degrees of freedom take at least";
    assert!(matches!(&refused, Err(LinalgError::Refused(what)) if what.contains(wanted)), "{refused:?}");
}

/// A hundred equal chains: the wanted pair is one of a hundred, and none lies below them.
#[test]
fn a_crowd_without_end_is_counted_before_it() {
    let order = 100 * 60;
    let (mut k, mut m) = (TripletBuilder::new(order, order), TripletBuilder::new(order, order));
    for row in 0..order {
        m.add(row, row, 1.0);
        k.add(row, row, 2.0);
        if row % 60 + 1 < 60 {
            k.add(row, row + 1, -1.0);
            k.add(row + 1, row, -1.0);
        }
    }
    let problem = EigenProblem::new(&k.build(), &m.build()).expect("an order");
    let pairs = problem.lowest(3).expect("found");
    let first = 4.0 * (std::f64::consts::PI / 122.0).sin().powi(2);
    assert!(pairs.values.iter().all(|value| (value / first - 1.0).abs() < 1e-9), "{:?}", pairs.values);
    let check = pairs.count_check;
    assert_eq!((check.counted, check.found), (0, 0));
    assert!(check.below < first && check.below > 0.0);
}

/// Mass and stiffness 10^299 apart: the message speaks of them, not of degrees of freedom.
#[test]
fn no_frequency_at_all() {
    let order = 300;
    let (mut k, mut m) = (TripletBuilder::new(order, order), TripletBuilder::new(order, order));
    for row in 0..order {
        k.add(row, row, 2e299);
        m.add(row, row, 1.0);
        if row > 0 {
            k.add(row, row - 1, -1e299);
            k.add(row - 1, row, -1e299);
        }
    }
    let found = EigenProblem::new(&k.build(), &m.build()).expect("an order").lowest(2);
    assert!(matches!(found, Err(LinalgError::NoFrequency { order: 300, .. })), "{found:?}");
}

/// Three hundred equal pairs of masses, with the eigenvalues 1 and 3: a gap behind the crowd is found, and the crowd is not taken whole.
#[test]
fn a_crowd_before_a_gap_is_counted_before_it() {
    let order = 600;
    let (mut k, mut m) = (TripletBuilder::new(order, order), TripletBuilder::new(order, order));
    for row in 0..order {
        m.add(row, row, 1.0);
        k.add(row, row, 2.0);
        k.add(row, row ^ 1, -1.0);
    }
    let problem = EigenProblem::new(&k.build(), &m.build()).expect("an order");
    let pairs = problem.lowest(10).expect("found");
    assert!(pairs.values.iter().all(|value| (value - 1.0).abs() < 1e-9));
    let check = pairs.count_check;
    // counted behind it there would be 300 of both
    assert_eq!((check.counted, check.found), (0, 0));
    assert!(check.below < 1.0 && check.below > 0.99, "{}", check.below);
}
