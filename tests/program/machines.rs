//! A shaft in several bearings: runs from the case to the verdict, loaded modes, and what is refused.

use plummer::app::case::{AskedRun, Case};
use plummer::app::commands::modes::compute_modes;
use plummer::app::commands::run::{Machine, RunEnd, RunResult, compute_run};
use plummer::numerics::Unwatched;
use std::path::{Path, PathBuf};

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name)
}

fn load(name: &str, set: &[&str]) -> Result<Case, String> {
    let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
    Case::load(example(name), &set).map_err(|error| error.to_string())
}

const SPINDLE: &str = "machines/spindle.toml";

/// Of a short run; keys come last that say otherwise.
fn run(set: &[&str]) -> RunResult {
    let set = [&["analysis.envelope=[]"], set].concat();
    compute_run(&load(SPINDLE, &set).unwrap(), &Unwatched).unwrap()
}

fn refusal(name: &str, set: &[&str]) -> String {
    let case = match load(name, set) {
        Ok(case) => case,
        Err(error) => return error,
    };
    match case.asked_run("`run`") {
        Err(error) => error.to_string(),
        Ok(_) => compute_run(&case, &Unwatched).unwrap_err().to_string(),
    }
}

/// Every shipped case of one bearing that nothing loads along its axis keeps the model in the plane.
#[test]
fn the_plane_is_chosen_where_it_is_enough() {
    for name in
        ["tadina2011/outer-dent.toml", "scenes/smooth.toml", "housings/end_shield.toml", "housings/pillow_block.toml"]
    {
        assert!(matches!(load(name, &[]).unwrap().asked_run("`run`"), Ok(AskedRun::InPlane(_))), "{name}");
    }
    let reason = |set: &[&str]| match load("housings/end_shield.toml", set).unwrap().asked_run("`run`") {
        Ok(AskedRun::InSpace(spatial, _)) => spatial.reason,
        other => panic!("{other:?}"),
    };
    let inertia = "shaft.transverse_inertia=1e-5";
    assert!(reason(&[inertia, "shaft.loads=[{force=[0,0,5]}]"]).starts_with("`shaft.loads[0]` is a force along z"));
    assert!(reason(&[inertia, "bearing.contact_angle_deg=15"]).starts_with("`bearing.contact_angle_deg`"));
    assert!(reason(&[inertia, "shaft.centre=1e-3"]).starts_with("`shaft.centre`"));
}

/// Thrust, preload, moment, unbalance and a dent do their work, and steps add none.
#[test]
fn energy_adds_up_in_two_bearings() {
    let keys = [
        "transient.end=4e-3",
        "transient.modes=60",
        "analysis.energy=true",
        "transient.method=exponential-adams",
        "transient.tolerance=1e-7",
        "transient.step=2.5e-8",
    ];
    let result = run(&keys);
    assert!(matches!(result.simulation.end, RunEnd::Complete));
    let energy = result.simulation.energy.unwrap();
    println!("{:e} of {:e} J", energy.error(), energy.exchanged_j);
    // 1.6e-6, and 3.4e-5 in twice the step, where the loads' work is the same to ten digits: the sum of powers over the steps errs where a
    // ball enters the dent
    assert!(energy.error().abs() < 1e-5, "{:e}", energy.error());
}

/// The shaft of the run rests where it starts: without speed and unbalance nothing moves.
#[test]
fn what_rests_stays_at_rest_in_any_number_of_modes() {
    for modes in ["transient.modes=40", "transient.modes=120"] {
        let set = [modes, "transient.end=1e-3", "speed.profile=[{time=0,hz=0}]", "shaft.unbalances=[]"];
        let result = run(&set);
        let loudest = result.simulation.record.sensors.iter().flat_map(|(_, values)| values);
        let loudest = loudest.fold(0.0_f64, |most, value| most.max(value.abs()));
        println!("{modes}: {loudest:e} m/s^2");
        // the search ends at forces of 1e-9 N on grams
        assert!(loudest < 1e-5, "{modes}: {loudest}");
    }
}

/// Two bearings of one size, one of which has a name.
#[test]
fn bearings_have_labels_orders_and_verdicts_of_their_own() {
    let set = [
        "transient.end=2e-3",
        "transient.modes=40",
        "bearings.1.label='rear'",
        "analysis.envelope=[{from=0.5e-3,to=1.5e-3}]",
    ];
    let result = run(&set);
    let Machine::InSpace(machine) = &result.machine else { panic!("in the plane") };
    let orders = &machine.scene.orders;
    // N (1 - gamma cos a) / 2 between the free angle of 15 degrees and the 19 of the thrust
    for order in orders.iter().map(|orders| orders.outer) {
        let at = |degrees: f64| 3.5 * (1.0 - 2.0 / 7.5105 * degrees.to_radians().cos());
        assert!(order > at(15.0) && order < at(20.0), "{order}");
    }
    // two milliseconds are too short for a ball to come to the dent, which says nothing of it
    assert_eq!(machine.damage, [None, Some(0.0)]);
    assert_eq!(result.windows.len(), 4);
    let labels: Vec<_> = result.windows.iter().map(|window| window.bearing.as_deref().unwrap()).collect();
    assert_eq!(labels, ["A", "A", "rear", "rear"]);
    assert!(result.warnings.iter().any(|text| text.starts_with("bearings A and rear strike at the same orders")));
    assert_eq!(result.simulation.record.balls, 14);
}

/// The angles follow the centrifugal force; the cage's orders are those of the highest speed, which is told with the speed itself.
#[test]
fn orders_that_a_run_up_changes_are_told() {
    let told = |hz: &str| {
        let speed = format!("speed.profile=[{{time=0,hz=50}},{{time=1e-4,hz={hz}}}]");
        run(&["transient.end=1e-4", "transient.modes=12", &speed]).warnings.join("\n")
    };
    let fast = told("12e3");
    let sentence = "cage and verdicts go by the contact angles at the highest speed, BPFO";
    assert!(fast.contains(sentence) && fast.contains("those at the start of the run make it"), "{fast}");
    assert!(fast.contains("no ball bearing of 0.0075105 m mean diameter runs as fast"), "{fast}");
    let slow = told("60");
    assert!(!slow.contains(sentence) && !slow.contains("runs as fast"), "{slow}");
}

/// Gyroscopic moments split the shaft's modes into forward and backward ones.
#[test]
fn a_turning_shaft_has_forward_and_backward_modes() {
    let modes = |hz: &str| {
        let speed = format!("speed.profile=[{{time=0,hz={hz}}}]");
        // a wheel, which a fast shaft stiffens
        let set = [&*speed, "modes.linearise='static'", "shaft.polar_inertia=1.5e-5", "shaft.unbalances=[]"];
        let result = compute_modes(&load(SPINDLE, &set).unwrap(), &Unwatched).unwrap();
        let modes = result.base.loaded.unwrap().modes;
        modes.into_iter().filter(|mode| mode.shaft_share > 0.5).collect::<Vec<_>>()
    };
    let (still, fast) = (modes("0"), modes("500"));
    assert!(still.len() >= 5 && still.iter().all(|mode| mode.whirl.is_none()));
    let whirls = |sign: f64| fast.iter().filter(|mode| sign * mode.whirl.unwrap_or(0.0) > 0.3).count();
    assert!(whirls(1.0) >= 1 && whirls(-1.0) >= 1, "{fast:?}");
    assert!(fast.iter().all(|mode| mode.damping_ratio.is_some_and(|ratio| ratio > 0.0)));
}

#[test]
fn what_a_shaft_in_space_cannot_have_is_refused_with_its_key() {
    let without = "shaft={mass=0.05}";
    assert!(refusal(SPINDLE, &[without]).contains("shaft.transverse_inertia: found none"));
    let off = "bearings.1.ring.tie.centre=[1e-6,0,27.5e-3]";
    assert!(refusal(SPINDLE, &[off]).contains("bearings[1].ring.tie.centre"), "{}", refusal(SPINDLE, &[off]));
    let turned = "bearings.1.ring.tie.zero_deg=[0,1,0]";
    assert!(refusal(SPINDLE, &[turned]).contains("bearings[1].ring.tie.zero_deg"));
    let wave = "bearings.0.bearing.waviness=[{on='outer',order=9,amplitude=1e-7}]";
    assert!(refusal(SPINDLE, &[wave]).contains("bearings[0].bearing.waviness"));
    assert!(refusal(SPINDLE, &["shaft.polar_inertia=1"]).contains("shaft.polar_inertia"));
    let torn = refusal(SPINDLE, &["speed.profile=[{time=0,rpm=1e7}]"]);
    assert!(torn.starts_with("bearings[0].bearing.inner_groove_radius: the contact of a ball"), "{torn}");
    assert!(torn.contains("at the highest speed"), "{torn}");
    let crushed = refusal(SPINDLE, &["shaft.loads=[{force=[0,-2e4,15],at=-8e-3}]"]);
    assert!(crushed.starts_with("bearings[0].bearing.inner_groove_radius: the contact of a ball"), "{crushed}");
    // both bearings would hold +z: nothing holds the preload
    let tandem = refusal(SPINDLE, &["bearings.1.bearing.thrust='positive'"]);
    assert!(
        tandem.contains("bearings[0].bearing.preload") && tandem.contains("all hold thrust the same way"),
        "{tandem}"
    );
    let single = ["shaft.transverse_inertia=1e-5", "bearing.preload={displacement=1e-6}"];
    assert!(refusal("housings/end_shield.toml", &single).contains("bearing.preload"));
    let in_plane = ["shaft.transverse_inertia=1e-5", "shaft.loads=[{force=[0,0,5]}]"];
    assert!(
        refusal("scenes/smooth.toml", &in_plane).contains("ring in space"),
        "{}",
        refusal("scenes/smooth.toml", &in_plane)
    );
}
