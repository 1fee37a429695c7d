//! Motion: past dents, of the scene turned, by independent integrators.

use super::*;

/// A dent beside the balls' path changes nothing, one on it does.
#[test]
fn a_ball_beside_a_dent_misses_it() {
    let run = |place: Option<f64>| {
        let (structure, mut setup) = pair(300.0);
        let modes = structure.modes().unwrap();
        let own = &mut setup.bearings[0];
        if let Some(place) = place {
            let across = Some(AcrossGroove { place, width: 2e-4 });
            own.bearing = dented(&own.bearing, &[(Race::Outer, FIRST + 0.03)], across);
        }
        let rest = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
        let mut system = system(&structure, &modes, &setup);
        let start = system.state_at(0.0, &rest, &modes);
        let method = Method::ExponentialAdams { tolerance: None };
        states(&mut system, start, method, 1e-7, 1, 500).swap_remove(1).y
    };
    // balls run at 15 degrees and more, 0.28 mm from the bottom towards +z
    let [whole, beside, on] = [None, Some(-2.8e-4), Some(2.8e-4)].map(run);
    let apart = |other: &[f64]| whole.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // an approach's rate that is not used may be rounded otherwise, nothing else
    assert!(apart(&beside) < 1e-20, "{:e}", apart(&beside));
    assert!(apart(&on) > 1e-8, "{:e}", apart(&on));
}

/// The whole scene turned about the axis by the angle between two nodes of a ring: results turn with it.
#[test]
fn results_turn_with_the_scene() {
    let (structure, setup) = pair(300.0);
    let modes = structure.modes().unwrap();
    let turn = TAU / 24.0;
    let turned = |[x, y]: [f64; 2]| [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()];
    let mut other = setup.clone();
    let [gx, gy] = turned([setup.gravity[0], setup.gravity[1]]);
    other.gravity = [gx, gy, 0.0];
    let [x, y] = turned([1.0, -6.0]);
    let [a, b] = turned([0.01, 0.02]);
    other.shaft.loads[0].profile = LoadProfile::constant([x, y, 12.0, a, b]);
    other.shaft.unbalances[0].angle += turn;
    for own in &mut other.bearings {
        own.cage = cage(own.bearing.geometry(), FIRST + turn, 300.0);
    }
    let gravity = [gx, gy];
    let rings = structure.rings().seats().iter().map(|seat| (seat.label.clone(), seat.ring.clone(), seat.frame));
    let other_structure = Structure::ring_alone(Rings::new(rings.collect()).unwrap(), gravity);
    let other_modes = other_structure.modes().unwrap();
    let run = |structure: &Structure, modes: &StructureModes, setup: &SpatialSetup| {
        let rest = SpatialEquilibrium::find(structure, setup, &SpatialCondition::at(setup, 0.0)).unwrap();
        let mut system = system(structure, modes, setup);
        let start = system.state_at(0.0, &rest, modes);
        let method = Method::ExponentialAdams { tolerance: None };
        let found = states(&mut system, start, method, 1e-7, 1, 2000);
        (rest, found[1].y[modes.count()..].to_vec())
    };
    let ((rest, one), (other_rest, two)) =
        (run(&structure, &modes, &setup), run(&other_structure, &other_modes, &other));
    for (own, other) in rest.bearings.iter().flatten().zip(other_rest.bearings.iter().flatten()) {
        for race in 0..2 {
            // both searches end at 1e-11 of the load
            assert!((own.load[race] - other.load[race]).abs() < 1e-10, "{own:?} {other:?}");
        }
    }
    let near = |a: f64, b: f64, scale: f64| assert!((a - b).abs() < 1e-9 * scale, "{a:e} {b:e}");
    for first in [0, 3] {
        let [x, y] = turned([one[first], one[first + 1]]);
        near(two[first], x, 1e-6);
        near(two[first + 1], y, 1e-6);
    }
    for (a, b) in one[5..].iter().zip(&two[5..]) {
        // places from the groove's centre, of the size of a play
        near(*a, *b, 1e-6);
    }
}

/// Distance between two motions over the motion about the mean: the largest over shaft and balls.
fn apart(one: &[State], other: &[State], first: usize) -> f64 {
    let coordinate = |place: usize| {
        let mean = one.iter().map(|state| state.y[place]).sum::<f64>() / one.len() as f64;
        let size: f64 = one.iter().map(|state| (state.y[place] - mean).powi(2)).sum();
        let apart: f64 = one.iter().zip(other).map(|(a, b)| (a.y[place] - b.y[place]).powi(2)).sum();
        (apart / size).sqrt()
    };
    (first..one[0].y.len()).map(coordinate).fold(0.0, f64::max)
}

/// The pair at 50 Hz on 40 modes, each outer ring set against the other by `preload` (m): the states every 0.1 ms of a run whose
/// start is `kick` (m) beside the rest.
fn run_of_pair(preload: f64, kick: f64, (method, step): (Method, f64), intervals: u64) -> Vec<State> {
    let (structure, mut setup) = pair(50.0);
    for (own, sign) in setup.bearings.iter_mut().zip([-1.0, 1.0]) {
        own.contact_damping = 1.0;
        own.offset = sign * preload;
    }
    let modes = structure.modes().unwrap();
    let rest = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
    let (kept, damping) = (ModeSelection::Count(KEPT), ModalDamping::Uniform(0.01));
    let mut system = SpatialSystem::new(&structure, &modes, setup, kept, &damping).unwrap();
    let mut start = system.state_at(0.0, &rest, &modes);
    for (place, value) in start.y[KEPT..].iter_mut().enumerate() {
        *value += kick * (1.0 + (0.7 * place as f64).sin());
    }
    states(&mut system, start, method, step, intervals, (1e-4 / step).round() as u32)
}

const KEPT: usize = 40;

const ADAMS: (Method, f64) = (Method::ExponentialAdams { tolerance: Some(1e-6) }, 1e-7);

const DOP853: (Method, f64) = (Method::Dop853 { tolerance: 1e-10, events: true }, 1e-5);

/// By how much a kick of 1e-14 m grows.
fn growth(preload: f64, intervals: u64) -> f64 {
    let [one, other] = [0.0, 1e-14].map(|kick| run_of_pair(preload, kick, ADAMS, intervals));
    let pairs = one[intervals as usize].y[KEPT..].iter().zip(&other[intervals as usize].y[KEPT..]);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / 1e-14
}

/// Two methods that share nothing but the force. With 6 um of preload every ball carries load, and what is 1e-14 m apart stays so:
/// the scene has no chaos.
#[test]
fn independent_integrators_agree() {
    let grown = growth(6e-6, 50);
    println!("growth {grown:.1e}");
    assert!(grown < 100.0, "{grown:e}");
    let gap = apart(&run_of_pair(6e-6, 0.0, ADAMS, 50), &run_of_pair(6e-6, 0.0, DOP853, 50), KEPT);
    println!("apart {gap:.1e}");
    // over 5 ms; 1e-4 is what is asked for
    assert!(gap < 1e-6, "{gap:e}");
}

/// With 2 um four balls of the second bearing carry nothing and rattle between the races. Their motion is chaotic: methods agree for
/// a short time alone, however small their errors.
#[test]
fn balls_that_carry_nothing_are_chaotic() {
    let grown = growth(2e-6, 50);
    println!("growth {grown:.1e}");
    assert!(grown > 1e5, "{grown:e}");
    let gap = apart(&run_of_pair(2e-6, 0.0, ADAMS, 5), &run_of_pair(2e-6, 0.0, DOP853, 5), KEPT);
    println!("apart {gap:.1e}");
    // over 0.5 ms, in which what is apart has grown by a thousand
    assert!(gap < 1e-5, "{gap:e}");
}
