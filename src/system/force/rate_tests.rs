//! The rates that damping goes by against central differences of the overlaps that the forces see.

use super::super::bearing_setup::{BallsInertia, BearingSetup, Formulation};
use super::super::coupled::{CoupledSystem, ModeSelection};
use super::super::race::{Damage, RacePlace, SAME_TOUCH, Touch};
use super::tangent_tests::{Asked, damped, dented, flat, measured, preloaded, wavy};
use crate::bearing::Race;
use crate::bearing::defect::{CurvatureReading, DentShape, RaceDefect, SurfaceDent};
use crate::numerics::ode::{SecondOrderSystem, State};
use std::f64::consts::PI;

/// Overlap (m) and rate (m/s) of every contact that presses, race by race and ball by ball, with what damage the ball feels there.
type Pressing = Vec<(Race, usize, Damage, Vec<[f64; 2]>)>;

fn pressing(system: &mut CoupledSystem, State { t, y, v }: &State) -> Pressing {
    let mut force = vec![0.0; y.len()];
    system.force_into(*t, y, v, &mut force);
    let (modes, shaft) = (system.modes, system.setup.cage.shaft().motion(*t));
    let centre = [v[modes], v[modes + 1]];
    let mut found = Vec::new();
    for j in 0..system.balls.count {
        let displaced = match &system.residual {
            Some(_) => system.balls.get(j, |ball| &ball.displaced),
            None => 0.0,
        };
        let overlap = system.balls.get(j, |ball| &ball.gap) - displaced;
        let (damage, place) = system.outer_place(j, overlap);
        let contacts = system.outer.overlaps(damage, &place);
        found.push((Race::Outer, j, damage, contacts));
        let gap = system.balls.inner_gap(j);
        let moving = system.velocity_on_inner(j, &gap, v[modes + 2 + j], centre);
        let (damage, place) = system.inner_place(j, &gap, moving, &shaft);
        let contacts = system.inner.overlaps(damage, &place);
        found.push((Race::Inner, j, damage, contacts));
    }
    for (.., contacts) in &mut found {
        contacts.retain(|[overlap, _]| *overlap > 0.0);
    }
    found
}

/// Largest error of the rates along the motion of a state at constant velocities, differences taken over twice `moment` (s), in
/// units of the largest rate on a race; on both races of the balls that feel damage or waves, and of the others.
fn errors(asked: Asked, moment: f64) -> [f64; 2] {
    let wavy = !asked.setup.waves.is_empty();
    let (mut system, state) = asked.moving();
    let [before, now, after] = [-moment, 0.0, moment].map(|time| {
        let moved = state.y.iter().zip(&state.v).map(|(y, v)| y + time * v);
        let moved = State { t: state.t + time, y: moved.collect(), v: state.v.clone() };
        pressing(&mut system, &moved)
    });
    let (mut errors, mut largest, mut uneven) = ([0.0_f64; 2], 0.0_f64, 0);
    for (((race, ball, damage, now), before), after) in now.iter().zip(&before).zip(&after) {
        assert_eq!([now.len(); 2], [before.3.len(), after.3.len()], "{race:?} {ball}");
        let feels = *damage != Damage::None || wavy;
        uneven += if feels { now.len() } else { 0 };
        for (([_, rate], [less, _]), [more, _]) in now.iter().zip(&before.3).zip(&after.3) {
            let expected = (more - less) / (2.0 * moment);
            largest = largest.max(expected.abs());
            let error = &mut errors[usize::from(!feels)];
            *error = error.max((rate - expected).abs());
        }
    }
    assert!(uneven > 0, "nothing is felt");
    errors.map(|error| error / largest)
}

/// Every kind of contact, ball 0 on it.
fn kinds() -> Vec<(String, BearingSetup)> {
    let mut kinds = Vec::new();
    for (race, asides) in [(Race::Outer, [0.01, 0.075]), (Race::Inner, [0.02, 0.13])] {
        for (place, aside) in ["floor", "rim"].into_iter().zip(asides) {
            kinds.push((format!("{place}, {race:?}"), dented(race, aside)));
        }
        kinds.push((format!("measured, {race:?}"), measured(race, 0.02)));
        kinds.push((format!("surface, {race:?}"), surface(race, 0.03)));
    }
    kinds.push(("flat, outside".into(), flat(0.03)));
    kinds.push(("flat, inside".into(), flat(0.03 + PI)));
    kinds.push(("waves".into(), wavy(preloaded())));
    kinds.push(("waves and dent".into(), wavy(dented(Race::Outer, 0.01))));
    kinds.push(("waves and inner dent".into(), wavy(dented(Race::Inner, 0.02))));
    kinds.push(("waves and flat".into(), wavy(flat(0.03))));
    let oversizes: Vec<f64> = (0..7).map(|ball| 1e-7 * f64::from(7 - ball)).collect();
    for (kind, setup) in kinds.clone() {
        let setup = BearingSetup { oversizes: oversizes.clone(), ..setup };
        kinds.push((format!("{kind}, larger balls"), setup));
    }
    kinds
}

/// A dent with a width, its middle `aside` (rad) of ball 0.
fn surface(race: Race, aside: f64) -> BearingSetup {
    let sound = dented(race, aside);
    let RaceDefect::Dent(dent) = &sound.race_defects[0] else {
        unreachable!("a dent in the plane");
    };
    let shape = DentShape { width: Some(0.6e-3), depth: 0.5e-6, curvature: CurvatureReading::Total, ..*dent.shape() };
    let dent = SurfaceDent::new(&sound.geometry, race, shape, sound.stiffness).unwrap();
    BearingSetup { race_defects: vec![RaceDefect::SurfaceDent(dent)], ..sound }
}

/// Without the race's own velocity along itself the errors on the outer race are 1e-4 (floor) to 1.5e-2 (rim).
#[test]
fn rates_are_those_of_the_overlaps() {
    let mut all_below = true;
    for (kind, setup) in kinds() {
        // overlaps of 3e-7 m are right to 1e-17, differences over 2e-8 s to 1e-9 m/s of 0.1 to 1
        let found = errors(Asked::of(damped(setup)), 1e-8);
        println!("{kind}: {found:?}");
        all_below &= found.iter().all(|error| *error < 1e-8);
    }
    assert!(all_below);
}

/// The residual's motion is known as far as `dF/dt` is: damping's own part is left out of it, which a damping of 1e-6 of the usual
/// shows, and how a rim turns the normals and changes the stiffness.
#[test]
fn with_a_residual_rates_are_those_of_the_overlaps() {
    let mut all_below = true;
    for (kind, setup) in kinds() {
        for (damping, bound) in [(2e-6, 5e-6), (2.0, 6e-5)] {
            // its arc is hardly longer than an overlap
            let bound = if kind.starts_with("rim, Outer") { 5e-4 } else { bound };
            let asked =
                Asked { residual: true, ..Asked::of(BearingSetup { contact_damping: damping, ..setup.clone() }) };
            let found = errors(asked, 1e-7);
            println!("{kind}, {damping}: {found:?}");
            all_below &= found.iter().all(|error| *error < bound);
        }
    }
    assert!(all_below);
}

/// Without the way between the two the difference is all of what the force changes by.
#[test]
fn what_a_ball_touches_gives_the_force_next_to_where_it_was_found() {
    let (mut pressed, mut all_below) = (0, true);
    for (kind, setup) in kinds() {
        let (mut system, state) = Asked::of(damped(setup)).moving();
        pressing(&mut system, &state);
        let (damage, place) = system.outer_place(0, system.balls.get(0, |ball| &ball.gap));
        let race = &system.outer;
        let mut touch = Touch::default();
        race.touch_into(damage, &place, &mut touch);
        let here = race.force(damage, &place);
        for moved in [-1.0, 1.0].map(|way| way * SAME_TOUCH * system.setup.geometry.ball_radius()) {
            let [penetration, rate] = [place.penetration + moved, 1.01 * place.rate];
            let found = race.force_by(&touch, penetration, rate);
            let expected = race.force(damage, &RacePlace { penetration, rate, ..place });
            let [change, error] = [here.radial, found.radial].map(|force| (force - expected.radial).abs());
            pressed += usize::from(change > 0.0);
            println!("{kind}: {error:e} of {change:e} N");
            all_below &= error <= 1e-2 * change && (found.tangential - expected.tangential).abs() <= 1e-2 * change;
        }
    }
    // ball 0 carries load in all
    assert!(all_below && pressed > 30, "{pressed}");
}

#[test]
fn balls_without_inertia_feel_no_rates() {
    for (kind, setup) in kinds() {
        let light = BearingSetup { balls_inertia: BallsInertia::QuasiStatic, ..setup };
        let (mut system, State { t, y, v }) = Asked::of(light).moving();
        let mut forces = [0.0, 1.0].map(|_| vec![0.0; y.len()]);
        let rest = vec![0.0; v.len()];
        for (force, v) in forces.iter_mut().zip([&rest, &v]) {
            system.force_into(t, &y, v, force);
        }
        let [at_rest, moving] = forces;
        assert_eq!(format!("{at_rest:?}"), format!("{moving:?}"), "{kind}");
    }
}

/// The source's equations have the ball's own velocity along the race.
#[test]
fn printed_leaves_the_race_out_of_the_velocity_along_it() {
    let setup = BearingSetup { formulation: Formulation::Printed, ..damped(dented(Race::Outer, 0.075)) };
    let asked = Asked { modes: ModeSelection::All, ..Asked::of(setup) };
    let (mut system, state) = asked.moving();
    pressing(&mut system, &state);
    let (damage, place) = system.outer_place(0, system.balls.get(0, |ball| &ball.gap));
    assert!(damage != Damage::None);
    let speed = system.setup.cage.motion(0.0).speed;
    assert!((place.along - system.radius(0) * speed).abs() < 1e-15);
}
