//! The command from a case to its result and page.

use super::compute::{BearingResult, FACTORS, POINTS, compute_bearing, curve, geometric};
use super::doubts::doubts;
use super::report::bearing_report;
use crate::app::case::{Case, Source};
use crate::app::error::ComputeError;
use crate::app::scene::spatial::SpatialScene;
use crate::bearing::spatial::{ShaftEquilibrium, ShaftLoad};
use crate::numerics::Unwatched;
use approx::assert_relative_eq;

/// Harris's 218 bearing (see `bearing::spatial`), without weight.
const CASE: &str = "[bearing]\nballs = 16\nball_radius = 11.115e-3\ninner_race_radius = 51.394e-3\n\
    outer_race_radius = 73.866e-3\ninner_groove_radius = 11.630736e-3\nouter_groove_radius = 11.630736e-3\n\
    contact_angle_deg = 40\nball_material = \"as printed\"\nrace_material = \"as printed\"\n\
    [materials]\n\"as printed\" = { young = 207e9, poisson = 0.3, density = 7800 }\n\
    [shaft]\nmass = 1\ngravity = [0, 0]\nloads = [{ force = [0, 0, 17800] }]\n";

fn case(set: &[&str]) -> Case {
    let set = set.iter().map(|&set| set.to_owned()).collect();
    Case::from_source(Source { path: "case.toml".into(), text: CASE.to_owned(), set }).unwrap()
}

#[test]
fn a_case_gives_the_published_angle_and_load() {
    let case = case(&[]);
    let result = compute_bearing(&case, None, false, &Unwatched).unwrap();
    let balls = &result.equilibria[0].bearings[0].balls;
    // 41.5 degrees and 1679 N; the pitch diameter is the printed one within 5 um
    assert_relative_eq!(result.bearings[0].contact_angle.to_degrees(), 41.5, epsilon = 0.05);
    assert_relative_eq!(balls[0].load[0], 1679.0, epsilon = 0.5);
    assert_relative_eq!(result.bearings[0].free_contact_angle.unwrap().to_degrees(), 40.0, epsilon = 1e-9);
    // orders at the angle in force, not at none
    let ratio = 22.23 / 125.26 * result.bearings[0].contact_angle.cos();
    assert_relative_eq!(result.bearings[0].orders.cage, 0.5 * (1.0 - ratio), max_relative = 1e-6);
    assert!(result.over_speed.is_empty());
    let json = serde_json::to_value(result.summary()).unwrap();
    assert_eq!(json["bearings"][0]["thrust"], "positive");
    assert_eq!(json["equilibria"][0]["balls"].as_array().unwrap().len(), 16);
    // the curves pass through the result: factor 1 is their middle
    let middle = &result.over_load[12];
    assert_relative_eq!(middle.at, 1.0, max_relative = 1e-12);
    assert_relative_eq!(
        middle.displacement.unwrap()[2],
        result.equilibria[0].displacement.translation[2],
        max_relative = 1e-9
    );
    let report = bearing_report(&case, &result, "plummer bearing case.toml");
    let titles: Vec<&str> = report.sections.iter().map(|section| section.title.as_str()).collect();
    assert_eq!(titles, ["Inputs", "At rest", "Balls", "Rating life", "Orders", "Over the load", "Over the preload"]);
}

#[test]
fn preload_speed_and_what_does_not_count() {
    // a constant force adds to the load, a displacement holds the ring
    let loads = "shaft.loads=[{force=[0,0,10000]}]";
    let force = compute_bearing(&case(&[loads, "bearing.preload.force=7800"]), None, false, &Unwatched).unwrap();
    assert_relative_eq!(force.load.force[2], 17_800.0);
    let none = "shaft.loads=[{force=[0,0]}]";
    let set = format!("bearing.preload.displacement={}", force.equilibria[0].displacement.translation[2]);
    let held = compute_bearing(&case(&[none, &set]), None, false, &Unwatched).unwrap();
    assert_relative_eq!(held.equilibria[0].holding_load[2], 17_800.0, max_relative = 1e-8);
    let error = compute_bearing(&case(&["bearing.preload.displacement=1e-5"]), None, false, &Unwatched).unwrap_err();
    assert!(
        error.is_input() && error.to_string().starts_with("bearing.preload.displacement: found beside a load along z")
    );
    // the highest speed of the profile, either way, or another one
    let profile = "speed.profile=[{time=0,rpm=0},{time=1,rpm=-10000},{time=2,rpm=500}]";
    let fast = case(&[profile, "bearing.slip=0.1", "shaft.unbalance=1e-6"]);
    let result = compute_bearing(&fast, None, true, &Unwatched).unwrap();
    assert_relative_eq!(result.speed_rpm, -10_000.0, max_relative = 1e-12);
    assert_relative_eq!(result.time_s, 1.0);
    assert_eq!(result.over_speed.len(), 25);
    let said = result.doubts.join("\n");
    assert!(said.contains("bearing.slip does not count") && said.contains("shaft.unbalance does not count"), "{said}");
    let slow = compute_bearing(&fast, Some(100.0), true, &Unwatched).unwrap();
    assert_relative_eq!(slow.speed_rpm, 100.0, max_relative = 1e-12);
    // a load that pushes the rings apart cannot be computed
    let error = compute_bearing(&case(&["bearing.thrust=negative"]), None, true, &Unwatched).unwrap_err();
    assert!(!error.is_input(), "{error}");
}

/// By hand (NumPy) for 16 balls of 1679 N at 40 degrees: C 101 643 N, its inner grooves being wider than 0.52 D; 1832 million revolutions.
#[test]
fn the_life_is_that_of_the_ball_loads() {
    let result = compute_bearing(&case(&[]), Some(1000.0), true, &Unwatched);
    let life = compute_bearing(&case(&[]), None, false, &Unwatched).unwrap().bearings[0].life.unwrap();
    assert_relative_eq!(life.load_rating_n, 101_643.0, max_relative = 1e-4);
    // the load of a ball is 1679 N within 0.5 N
    assert_relative_eq!(life.life_mrev.unwrap(), 1831.9, max_relative = 1e-3);
    assert!(life.life_h.is_none());
    // with speed hours, and at the curve's middle the same life
    let result = result.unwrap();
    let [mrev, hours] =
        [result.bearings[0].life.unwrap().life_mrev.unwrap(), result.bearings[0].life.unwrap().life_h.unwrap()];
    assert_relative_eq!(hours, 1e6 * mrev / 60_000.0, max_relative = 1e-12);
    assert_relative_eq!(result.over_load[12].life.unwrap(), mrev, max_relative = 1e-6);
    assert!(result.over_load[24].life.unwrap() < 2e-3 * mrev);
    // half the load rating is that of 8 million revolutions
    for (thrust, told) in [("90e3", false), ("130e3", true)] {
        let set = format!("shaft.loads=[{{force=[0,0,{thrust}]}}]");
        let result = compute_bearing(&case(&[&set]), None, true, &Unwatched).unwrap();
        assert_eq!(result.bearings[0].life.unwrap().life_mrev.unwrap() < 8.0, told);
        assert_eq!(result.doubts.iter().any(|doubt| doubt.contains("above half the load rating")), told);
    }
    // no steel, no life
    let hybrid =
        compute_bearing(&case(&["bearing.ball_material=\"silicon nitride\""]), None, true, &Unwatched).unwrap();
    assert!(hybrid.bearings[0].life.is_none() && hybrid.over_load.iter().all(|point| point.life.is_none()));
    let said = hybrid.doubts.join("\n");
    assert!(said.contains("no rating life, ISO 281 does not hold: effective modulus of the inner contact"), "{said}");
    let page = bearing_report(&case(&[]), &hybrid, "plummer bearing case.toml").to_html().unwrap();
    assert!(!page.contains("L10r"));
}

/// A deep groove bearing with tight grooves and play, loaded by these newtons downwards, its tilt held.
fn tight(load: f64) -> (Case, Result<BearingResult, ComputeError>) {
    let text = format!(
        "[bearing]\nballs = 9\nball_radius = 3.5e-3\ninner_race_radius = 15.5e-3\nouter_race_radius = 22.51e-3\n\
         inner_groove_radius = 3.535e-3\nouter_groove_radius = 3.535e-3\nradial_play = 6e-5\n\
         [shaft]\nmass = 1\ngravity = [0, 0]\nloads = [{{ force = [0, -{load}, 0] }}]\n"
    );
    let case = Case::from_source(Source { path: "case.toml".into(), text, set: Vec::new() }).unwrap();
    let result = compute_bearing(&case, None, true, &Unwatched);
    (case, result)
}

/// Balls opposite the load would have to stand on the far side of their grooves.
#[test]
fn a_contact_beyond_ninety_degrees_is_no_result() {
    let error = tight(8000.0).1.unwrap_err();
    // nothing is wrong with a key: it was computed
    assert!(
        !error.is_input() && error.to_string().contains("expected less than 90: no groove reaches so far"),
        "{error}"
    );
}

/// Plots without points are left out of the page of a bearing that nothing loads.
#[test]
fn a_bearing_without_load_has_a_page() {
    let (case, result) = tight(0.0);
    let page = bearing_report(&case, &result.unwrap(), "plummer bearing case.toml").to_html().unwrap();
    assert!(page.contains("Ball loads") && !page.contains("Contact angles"));
}

/// A 6204 that a mass of so many kg loads, ball 0 under the load.
fn light(mass: f64, set: &[&str]) -> Case {
    let text = format!("bearing = \"6204\"\n[shaft]\nmass = {mass}\n");
    let set = set.iter().map(|&set| set.to_owned()).collect();
    Case::from_source(Source { path: "case.toml".into(), text, set }).unwrap()
}

fn rest(case: &Case) -> ShaftEquilibrium {
    let (shaft, load) = SpatialScene::build(case, None, false).unwrap().shaft().unwrap();
    shaft.equilibrium(&load).unwrap()
}

/// Between its mirror images in x and in z the shaft stands on a saddle. It rests beside it, where a second ball just touches.
#[test]
fn a_light_radial_load_has_a_stable_equilibrium() {
    let found = rest(&light(1.0, &[]));
    assert!(found.is_stable() && found.residual_n < 1e-9, "{found:?}");
    let [x, y, z] = found.displacement.translation.map(|part| 1e6 * part);
    assert_relative_eq!(x.abs(), 1.487, epsilon = 5e-4);
    assert_relative_eq!(y, -7.426, epsilon = 5e-4);
    assert_relative_eq!(z.abs(), 51.55, epsilon = 5e-3);
}

/// Curves over the load have every point, and no jump to a mirror image.
#[test]
fn curves_follow_one_branch() {
    let case = light(1.0, &[]);
    let scene = SpatialScene::build(&case, None, false).unwrap();
    let (_, load) = scene.shaft().unwrap();
    let points = curve(&geometric(FACTORS), POINTS / 2, rest(&case).displacement, |factor| {
        Ok((scene.clone(), ShaftLoad { force: load.force.map(|part| factor * part), ..load }))
    });
    let points = points.unwrap();
    for axis in [0, 2] {
        let along: Option<Vec<f64>> = points.iter().map(|point| Some(point.displacement?[axis])).collect();
        let along = along.unwrap_or_else(|| panic!("a gap in {points:?}"));
        // heavy loads leave x = 0 as the only place
        assert!(along.iter().all(|place| place * along[12].signum() > -1e-12), "axis {axis}: {along:?}");
    }
}

/// Light thrust holds the bearing's sphere little, but it does hold it.
#[test]
fn light_thrust_holds_every_direction() {
    for thrust in ["1e-2", "1e-4", "1e-6"] {
        let thrust = format!("shaft.loads=[{{force=[0,0,{thrust}]}}]");
        let found = rest(&light(1.0, &["shaft.gravity=[0,0]", &thrust]));
        assert_eq!(found.directions_loose, 0, "{thrust}: {found:?}");
    }
    // without any load nothing is held
    assert_eq!(rest(&light(1.0, &["shaft.gravity=[0,0]"])).directions_loose, 5);
}

#[test]
fn pressures_above_the_static_limit_are_told() {
    let told = |thrust: &str| {
        let load = format!("shaft.loads=[{{force=[0,0,{thrust}]}}]");
        let case = light(1.0, &["shaft.gravity=[0,0]", &load]);
        let scene = SpatialScene::build(&case, None, true).unwrap();
        let (shaft, load) = scene.shaft().unwrap();
        let found = shaft.equilibrium(&load).unwrap();
        let balls = &found.bearings[0].balls;
        let most = balls.iter().flat_map(|ball| ball.patch).map(|patch| patch.peak_pressure).fold(0.0, f64::max);
        let doubts = doubts(&case, &scene, &[found]);
        (most, doubts.iter().any(|doubt| doubt.contains("above 4200 MPa, the static limit of ISO 76")))
    };
    let [(low, quiet), (high, warned)] = [told("1e3"), told("1e5")];
    assert!(low < 4.2e9 && !quiet && high > 4.2e9 && warned, "{low:e} {high:e}");
}

/// Fast and light: inertia presses the balls to where the inner race has no place for them.
#[test]
fn a_ball_without_a_place_is_named() {
    let text = "[bearing]\nballs = 9\nball_radius = 3.5e-3\ninner_race_radius = 15.5e-3\n\
        outer_race_radius = 22.51e-3\ninner_groove_radius = 3.535e-3\nouter_groove_radius = 3.535e-3\nradial_play = 2e-5\n\
        [shaft]\nmass = 1\ngravity = [0, 0]\nloads = [{ force = [0, 0, 100] }]\n";
    let source = Source { path: "case.toml".into(), text: text.to_owned(), set: Vec::new() };
    let case = Case::from_source(source).unwrap();
    let (shaft, load) = SpatialScene::build(&case, Some(1e5), true).unwrap().shaft().unwrap();
    let said = shaft.equilibrium(&load).unwrap_err().to_string();
    assert!(said.contains("at 100000 rpm the ball at ") && said.contains("lower the speed"), "{said}");
}

/// Without load each bearing of a pair carries its preload; a load shifts between them, and an O arrangement holds the tilt.
#[test]
fn a_preloaded_pair_rests_in_its_preload() {
    let of = |set: &[&str]| {
        let case = Case::example("machines/spindle", &[&["shaft.gravity=[0,0]"], set].concat());
        let result = compute_bearing(&case, Some(0.0), false, &Unwatched).unwrap();
        let axial = result.equilibria[0].bearings.iter().map(|state| {
            state.balls.iter().map(|ball| ball.load[0] * ball.contact_angle[0].unwrap_or(0.0).sin()).sum::<f64>()
        });
        let axial: Vec<f64> = axial.collect();
        (case, result, axial)
    };
    let (case, result, axial) = of(&["shaft.loads=[]"]);
    // the preload is 20 N: the search ends within 1e-9 of the load
    assert_relative_eq!(axial[0], 20.0, max_relative = 1e-7);
    assert_relative_eq!(axial[1], -20.0, max_relative = 1e-7);
    let rest = &result.equilibria[0];
    assert!(rest.is_stable() && rest.directions_loose == 0);
    assert!(rest.displacement.translation.iter().all(|part| part.abs() < 1e-14), "{:?}", rest.displacement);
    assert_relative_eq!(result.bearings[1].place, 25e-3, max_relative = 1e-12);
    assert_eq!(result.bearings[0].orders, result.bearings[1].orders);
    // thrust on the shaft goes to the bearing that holds it
    let (_, _, loaded) = of(&["shaft.loads=[{force=[0,0,15]}]"]);
    assert_relative_eq!(loaded[0] + loaded[1], 15.0, max_relative = 1e-7);
    assert!(loaded[0] > 20.0 && loaded[1] > -20.0, "{loaded:?}");
    // the curve over the preload passes through the case's, and the others' preload follows the first
    let middle = &result.over_preload[result.over_preload.partition_point(|point| point.at < 20.0)];
    assert!(middle.displacement.unwrap().iter().all(|part| part.abs() < 1e-12) && !result.preload_is_displacement);
    let page = bearing_report(&case, &result, "plummer bearing spindle.toml").to_html().unwrap();
    assert!(page.contains("Balls, bearing A") && page.contains("Balls, bearing B"));
    let json = serde_json::to_value(result.summary()).unwrap();
    assert_eq!(json["equilibria"][0]["balls"][7]["bearing"], "B");
}
